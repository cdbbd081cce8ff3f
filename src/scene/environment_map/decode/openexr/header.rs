//! The parts of an OpenEXR file: what its headers say of its pixels. Other attributes are skipped.

use std::io::{Read, Seek};

use exr::prelude::{ChannelDescription, Compression, SampleType, Text, Vec2};

use crate::{
    reading::{
        openexr::{Headers, MAX_NAME_BYTES},
        source::Source,
    },
    scene::environment_map::decode::error::{DecodeError, checked_size, unreadable},
};

/// Most channels of a part.
pub const MAX_CHANNELS: usize = 64;
/// Most bytes of a list of channels.
const MAX_CHANNEL_BYTES: usize = (MAX_CHANNELS + 1) * (MAX_NAME_BYTES + 17) + 1;

/// The part of a file that is read.
pub struct Part {
    /// Width and height in pixels, within the limits.
    pub size_px: [u32; 2],
    /// The y coordinate of the first row.
    pub top: i32,
    /// All channels, in the order of the file; at least R, G and B, none subsampled.
    pub channels: Vec<ChannelDescription>,
    /// Positions of R, G and B among the channels.
    pub rgb: [usize; 3],
    /// How each block is packed.
    pub compression: Compression,
    /// Width and height of a tile in pixels; `None` for rows.
    pub tile_px: Option<[u32; 2]>,
    /// The part's number in the file; `None` if it is the only one.
    pub number: Option<i32>,
    /// Position of its table of offsets in the file.
    pub table: u64,
}

/// Attributes of one part, as far as they are known.
#[derive(Default)]
struct Attributes {
    channels: Option<Vec<ChannelDescription>>,
    compression: Option<u8>,
    data_window: Option<[i32; 4]>,
    tile_px: Option<[u32; 2]>,
    kind: Option<Vec<u8>>,
    chunk_count: Option<u64>,
}

/// Reads all headers. Returns the first part with the channels R, G and B.
pub fn read(file: &mut Source<impl Read + Seek>) -> Result<Part, DecodeError> {
    file.go_to(0, "the signature")?;
    let mut headers = Headers::new(file)?;
    let mut parts: Vec<Attributes> = Vec::new();
    while let Some(attribute) = headers.next(file)? {
        parts.resize_with(parts.len().max(attribute.part + 1), Attributes::default);
        parts[attribute.part].read(file, &attribute.name, attribute.size)?;
    }
    let mut table = file.position();
    for (number, attributes) in (0..).zip(parts) {
        let chunk_count = attributes.chunk_count;
        let is_tiled = match attributes.kind.as_deref() {
            Some(kind) => kind == b"tiledimage",
            None => headers.is_tiled,
        };
        if let Some(part) = attributes.finish(is_tiled)? {
            let number = headers.is_multi_part.then_some(number);
            return Ok(Part { number, table, ..part });
        }
        if !headers.is_multi_part {
            break;
        }
        table = chunk_count
            .and_then(|count| count.checked_mul(8)?.checked_add(table))
            .ok_or_else(|| unreadable("a part does not say how many blocks it has"))?;
    }
    Err(unreadable("no part has the channels R, G and B with one sample per pixel"))
}

impl Attributes {
    fn read(
        &mut self,
        file: &mut Source<impl Read + Seek>,
        name: &[u8],
        size: u64,
    ) -> Result<(), DecodeError> {
        match name {
            b"channels" => {
                let bytes = file.bytes(size.min(MAX_CHANNEL_BYTES as u64) as usize, "channels")?;
                self.channels = Some(channels(&bytes)?);
            }
            b"compression" => self.compression = Some(file.array::<1>("compression")?[0]),
            b"dataWindow" => {
                let mut window = [0; 4];
                for side in &mut window {
                    *side = file.i32("dataWindow")?;
                }
                self.data_window = Some(window);
            }
            b"tiles" => {
                let sides = [file.i32("tiles")?, file.i32("tiles")?];
                self.tile_px = Some(sides.map(|side| u32::try_from(side).unwrap_or(0)));
            }
            b"type" => self.kind = Some(file.bytes(size.min(32) as usize, "type")?),
            b"chunkCount" => self.chunk_count = u64::try_from(file.i32("chunkCount")?).ok(),
            _ => {}
        }
        Ok(())
    }

    /// The part, if it has the channels R, G and B.
    fn finish(self, is_tiled: bool) -> Result<Option<Part>, DecodeError> {
        if self.kind.is_some_and(|kind| kind.starts_with(b"deep")) {
            return Ok(None);
        }
        let Some(channels) = self.channels else { return Ok(None) };
        let index = |name: &[u8]| channels.iter().position(|one| one.name.as_slice() == name);
        let (Some(red), Some(green), Some(blue)) = (index(b"R"), index(b"G"), index(b"B")) else {
            return Ok(None);
        };
        if channels.iter().any(|channel| channel.sampling != Vec2(1, 1)) {
            return Err(unreadable(
                "a channel has fewer samples than pixels: save the picture without subsampling",
            ));
        }
        let missing = |name: &str| unreadable(format!("the header has no {name}"));
        let compression = compression(self.compression.ok_or_else(|| missing("compression"))?)?;
        let [left, top, right, bottom] =
            self.data_window.ok_or_else(|| missing("dataWindow"))?.map(i64::from);
        let side = |first: i64, last: i64| u64::try_from(last - first + 1).unwrap_or(0);
        let size_px = checked_size([side(left, right), side(top, bottom)])?;
        let tile_px = if is_tiled { self.tile_px } else { None };
        if is_tiled && tile_px.is_none_or(|sides| sides.contains(&0)) {
            return Err(unreadable("the tiles have no size"));
        }
        // The coordinate was read as an i32.
        let (top, rgb) = (top as i32, [red, green, blue]);
        Ok(Some(Part { size_px, top, channels, rgb, compression, tile_px, number: None, table: 0 }))
    }
}

/// The channels of a list: name, sample type, transfer, and sampling along both axes.
fn channels(mut bytes: &[u8]) -> Result<Vec<ChannelDescription>, DecodeError> {
    let damaged = || unreadable("the list of channels is damaged");
    let mut channels = Vec::new();
    loop {
        let end = bytes.iter().position(|byte| *byte == 0).ok_or_else(damaged)?;
        let (name, rest) = bytes.split_at(end);
        if name.is_empty() {
            return Ok(channels);
        }
        if name.len() > MAX_NAME_BYTES {
            return Err(damaged());
        }
        if channels.len() == MAX_CHANNELS {
            return Err(unreadable(format!(
                "a part has more than {MAX_CHANNELS} channels: save the picture with R, G and B alone"
            )));
        }
        let (fields, rest) = rest[1..].split_first_chunk::<16>().ok_or_else(damaged)?;
        let number = |at: usize| fields[at..].first_chunk().map(|four| i32::from_le_bytes(*four));
        let sample_type = match number(0) {
            Some(0) => SampleType::U32,
            Some(1) => SampleType::F16,
            Some(2) => SampleType::F32,
            _ => return Err(damaged()),
        };
        let sampling =
            |at| number(at).and_then(|step| usize::try_from(step).ok()).ok_or_else(damaged);
        channels.push(ChannelDescription {
            name: Text::new_or_none(String::from_utf8_lossy(name)).ok_or_else(damaged)?,
            sample_type,
            quantize_linearly: fields[4] != 0,
            sampling: Vec2(sampling(8)?, sampling(12)?),
        });
        bytes = rest;
    }
}

fn compression(number: u8) -> Result<Compression, DecodeError> {
    Ok(match number {
        0 => Compression::Uncompressed,
        1 => Compression::RLE,
        2 => Compression::ZIP1,
        3 => Compression::ZIP16,
        4 => Compression::PIZ,
        5 => Compression::PXR24,
        6 => Compression::B44,
        7 => Compression::B44A,
        8 => Compression::DWAA(None),
        9 => Compression::DWAB(None),
        _ => {
            return Err(unreadable(format!(
                "compression {number} cannot be read: save the picture with ZIP, PIZ or DWAA"
            )));
        }
    })
}
