//! The pixels of an OpenEXR part, block by block: at any time one block is in memory.

use std::{
    io::{Read, Seek},
    panic::{AssertUnwindSafe, catch_unwind},
};

use exr::{
    math::RoundingMode,
    meta::{
        BlockDescription,
        attribute::{IntegerBounds, LevelMode, TileDescription},
        header::Header,
    },
    prelude::{Compression, LineOrder, SampleType, Text, Vec2, f16},
};
use glam::Vec3;

use super::header::Part;
use crate::{
    reading::source::Source,
    scene::environment_map::{
        decode::error::{DecodeError, MAX_SOURCE_PIXELS, unreadable},
        downsample::Downsampler,
    },
};

/// Most blocks of the largest level: one per row, or tiles of 64 × 64 pixels.
pub const MAX_BLOCKS: u64 = 8192;
/// Smallest width and height of a tile, in pixels. A block has a fixed cost, whatever its size.
pub const MIN_TILE_PX: u32 = 32;
/// Most bytes of a block's pixels.
pub const MAX_BLOCK_BYTES: u64 = 8 << 20;
/// Most bytes of all pixels together: those of the largest picture with four channels of 32 bits.
pub const MAX_PIXEL_BYTES: u64 = 16 * MAX_SOURCE_PIXELS;

/// Reads the part's pixels.
pub fn read(file: &mut Source<impl Read + Seek>, part: &Part) -> Result<Downsampler, DecodeError> {
    let layout = Layout::of(part)?;
    file.go_to(part.table, "the table of offsets")?;
    let count = layout.count[0] * layout.count[1];
    let table = file.bytes(8 * count as usize, "the table of offsets")?;
    let mut downsampler = Downsampler::new(part.size_px);
    let mut block = BlockReader { part, header: None };
    let mut packed_bytes = 0;
    for (index, offset) in (0..).zip(table.chunks_exact(8)) {
        let offset = offset.try_into().map_or(0, u64::from_le_bytes);
        if offset == 0 {
            return Err(unreadable("the file is incomplete: a block of pixels is missing"));
        }
        file.go_to(offset, "a block of pixels")?;
        let [column, row] = [index % layout.count[0], index / layout.count[0]];
        let bytes = layout.packed(file, part, [column, row])?;
        packed_bytes += bytes.len() as u64;
        // Otherwise a short file could contain the same bytes in thousands of blocks.
        if packed_bytes > file.length() {
            return Err(unreadable("blocks of pixels overlap"));
        }
        let position = [column as u32 * layout.block_px[0], row as u32 * layout.block_px[1]];
        let size = std::array::from_fn(|i| layout.block_px[i].min(part.size_px[i] - position[i]));
        block.read(bytes, position, size, &mut downsampler)?;
    }
    Ok(downsampler)
}

/// The blocks of a part.
struct Layout {
    /// Width and height of a block in pixels, at most the part's.
    block_px: [u32; 2],
    /// Blocks along both axes.
    count: [u64; 2],
    /// Bytes of a block's pixels, all channels.
    block_bytes: u64,
}

impl Layout {
    fn of(part: &Part) -> Result<Self, DecodeError> {
        let is_small = |i: usize, side: u32| side < MIN_TILE_PX.min(part.size_px[i]);
        if part.tile_px.is_some_and(|[width, height]| is_small(0, width) || is_small(1, height)) {
            return Err(unreadable(format!(
                "save the picture in rows, or in tiles of at least {MIN_TILE_PX} x {MIN_TILE_PX} pixels"
            )));
        }
        let rows = [part.size_px[0], part.compression.scan_lines_per_block() as u32];
        let sides = part.tile_px.unwrap_or(rows);
        let block_px: [u32; 2] = std::array::from_fn(|i| sides[i].min(part.size_px[i]));
        let count = std::array::from_fn(|i| part.size_px[i].div_ceil(block_px[i]).into());
        let blocks = count[0] * count[1];
        if blocks > MAX_BLOCKS {
            return Err(unreadable(format!(
                "the picture has {blocks} blocks, and at most {MAX_BLOCKS} are read: save it in rows or in larger tiles"
            )));
        }
        let sizes = part.channels.iter().map(|channel| channel.sample_type.bytes_per_sample());
        let pixel_bytes = sizes.sum::<usize>() as u64;
        let all_bytes = part.size_px.map(u64::from).iter().product::<u64>() * pixel_bytes;
        if all_bytes > MAX_PIXEL_BYTES {
            return Err(unreadable(format!(
                "the pixels have {all_bytes} bytes unpacked, and at most {MAX_PIXEL_BYTES} are read: save the picture \
                 with R, G and B alone"
            )));
        }
        let block_bytes = block_px.map(u64::from).iter().product::<u64>() * pixel_bytes;
        if block_bytes > MAX_BLOCK_BYTES {
            return Err(unreadable(format!(
                "a block of pixels has {block_bytes} bytes, and at most {MAX_BLOCK_BYTES} are read: save the picture \
                 with R, G and B alone, with the compression ZIP, or in smaller tiles"
            )));
        }
        Ok(Self { block_px, count, block_bytes })
    }

    /// Reads the packed bytes of a block, which must say that it is the one at `at`, of the largest level.
    fn packed(
        &self,
        file: &mut Source<impl Read + Seek>,
        part: &Part,
        at: [u64; 2],
    ) -> Result<Vec<u8>, DecodeError> {
        const WHAT: &str = "a block of pixels";
        let mut matches = true;
        if let Some(number) = part.number {
            matches &= file.i32(WHAT)? == number;
        }
        if part.tile_px.is_some() {
            for expected in [at[0], at[1], 0, 0] {
                matches &= i64::from(file.i32(WHAT)?) == expected as i64;
            }
        } else {
            let row = i64::from(part.top) + (at[1] * u64::from(self.block_px[1])) as i64;
            matches &= i64::from(file.i32(WHAT)?) == row;
        }
        if !matches {
            return Err(unreadable("a block of pixels is not where the table of offsets says"));
        }
        let size = file.i32(WHAT)?;
        match usize::try_from(size) {
            Ok(size) if (1..=self.block_bytes).contains(&(size as u64)) => {
                Ok(file.bytes(size, WHAT)?)
            }
            _ => Err(unreadable(format!(
                "a block of pixels has {size} bytes packed and {} unpacked",
                self.block_bytes
            ))),
        }
    }
}

/// Unpacks blocks.
struct BlockReader<'a> {
    part: &'a Part,
    /// The header of a picture of one block, of the last block's size.
    header: Option<Header>,
}

impl BlockReader<'_> {
    /// Unpacks a block, and adds its pixels, which start at `position`.
    fn read(
        &mut self,
        bytes: Vec<u8>,
        position: [u32; 2],
        size: [u32; 2],
        downsampler: &mut Downsampler,
    ) -> Result<(), DecodeError> {
        let size = Vec2(size[0] as usize, size[1] as usize);
        let header = match self.header.take().filter(|header| header.layer_size == size) {
            Some(header) => header,
            None => header_of_block(self.part, size),
        };
        let header = self.header.insert(header);
        let row_bytes = header.channels.bytes_per_pixel * size.width();
        if bytes.len() > row_bytes * size.height() {
            return Err(damaged());
        }
        if bytes.len() < row_bytes * size.height() {
            check_packed(&bytes, header)?;
        }
        let pixels = unpack(header, bytes)?;
        let mut starts = Vec::new();
        for channel in &header.channels.list {
            let start: usize = starts.iter().map(|(_, bytes, _)| bytes).sum();
            let bytes = channel.sample_type.bytes_per_sample() * size.width();
            starts.push((start, bytes, channel.sample_type));
        }
        let [red, green, blue] = self.part.rgb.map(|index| starts[index]);
        for (y, row) in (position[1]..).zip(pixels.chunks_exact(row_bytes)) {
            let value = |(start, bytes, kind): (usize, usize, SampleType), x: usize| {
                sample(&row[start..start + bytes], kind, x)
            };
            let colors = (0..size.width())
                .map(|x| Vec3::new(value(red, x), value(green, x), value(blue, x)));
            downsampler.add_row([position[0], y], colors);
        }
        Ok(())
    }
}

/// The header of a picture that is one block.
fn header_of_block(part: &Part, size: Vec2<usize>) -> Header {
    let tiles = TileDescription {
        tile_size: size,
        level_mode: LevelMode::Singular,
        rounding_mode: RoundingMode::Down,
    };
    let channels = part.channels.iter().cloned().collect();
    Header::new(Text::from("block"), size, channels).with_encoding(
        part.compression,
        BlockDescription::Tiles(tiles),
        LineOrder::Increasing,
    )
}

fn damaged() -> DecodeError {
    unreadable("a block of pixels is damaged")
}

/// Checks what the crate allocates by a packed block's own word.
fn check_packed(bytes: &[u8], header: &Header) -> Result<(), DecodeError> {
    match header.compression {
        Compression::Uncompressed => Err(damaged()),
        Compression::DWAA(_) | Compression::DWAB(_) => {
            let (numbers, _) = bytes.as_chunks::<8>();
            let numbers = numbers.first_chunk::<11>().ok_or_else(damaged)?;
            let numbers = numbers.map(u64::from_le_bytes);
            let [_, unknown, _, _, _, _, rle, rle_raw, ac, dc, _] = numbers;
            let packed = &numbers[2..6];
            let size = header.layer_size;
            let squares = size.width().div_ceil(8) * size.height().div_ceil(8);
            let squares = (squares * header.channels.list.len()) as u64;
            let unpacked = (size.area() * header.channels.bytes_per_pixel) as u64;
            let fits = packed.iter().all(|size| *size <= bytes.len() as u64)
                && unknown <= unpacked
                && rle_raw <= unpacked
                // A run takes at most two bytes for each byte.
                && rle <= 2 * unpacked
                && dc <= squares
                && ac <= 64 * squares;
            if fits { Ok(()) } else { Err(damaged()) }
        }
        _ => Ok(()),
    }
}

/// The pixels of a packed block: in each row all samples of a channel follow each other, native-endian.
///
/// A panic of the crate is an error where panics unwind; on the web it would end the page.
fn unpack(header: &Header, bytes: Vec<u8>) -> Result<Vec<u8>, DecodeError> {
    let bounds = IntegerBounds::from_dimensions(header.layer_size);
    let unpack =
        || header.compression.decompress_image_section_from_le(header, bytes, bounds, false);
    // Nothing that `unpack` may leave half done is used after a panic.
    let pixels = catch_unwind(AssertUnwindSafe(unpack))
        .map_err(|_| unreadable("a block of pixels cannot be unpacked"))?;
    pixels.map_err(unreadable)
}

/// The sample at `x` of a channel's row.
fn sample(row: &[u8], kind: SampleType, x: usize) -> f32 {
    let four = || row[4 * x..].first_chunk().copied().unwrap_or_default();
    match kind {
        SampleType::F16 => {
            f16::from_ne_bytes(row[2 * x..].first_chunk().copied().unwrap_or_default()).to_f32()
        }
        SampleType::F32 => f32::from_ne_bytes(four()),
        SampleType::U32 => u32::from_ne_bytes(four()) as f32,
    }
}
