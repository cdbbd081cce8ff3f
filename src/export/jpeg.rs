//! Streaming JPEG writer with the scene document, and reader of the scene document.
//!
//! The writer gets 8-bit sRGB rows from the top and the scene document, and writes a baseline file
//! (ITU-T T.81) with chroma at full resolution. It encodes each strip of eight rows as a picture of its
//! own and joins the strips by restart markers, after which a decoder needs nothing of what precedes. So
//! the writer holds eight rows. The document is in comments, because every tool that lists comments
//! shows it; a segment has at most 64 KiB, so a long document has several. The reader accepts
//! untrusted files.

use std::io::{Read, Seek, Write};

use image::{ExtendedColorType, codecs::jpeg::JpegEncoder};

use super::{
    ExportError, MAX_HEADER_BYTES, MAX_TEXT_BYTES, SceneTextError,
    metadata::{SCENE_KEYWORD, capped},
};
use crate::reading::source::{Source, Unreadable};

/// Default quality: no visible loss, at about a sixth of a PNG's size.
pub const DEFAULT_QUALITY: u8 = 92;

/// Rows of a strip: the side of a block, in pixels.
const STRIP_ROWS: u32 = 8;

/// Largest part of a document in a comment, in bytes: a segment has 65,533, with the part's number.
const PART_BYTES: usize = 65_000;

/// Largest number of parts of a document.
const MAX_PARTS: usize = MAX_TEXT_BYTES / PART_BYTES + 2;

/// Second bytes of markers; the first one is 0xFF.
mod marker {
    pub const SOF0: u8 = 0xC0;
    pub const SOF1: u8 = 0xC1;
    pub const SOF2: u8 = 0xC2;
    pub const RST0: u8 = 0xD0;
    pub const RST7: u8 = 0xD7;
    pub const SOI: u8 = 0xD8;
    pub const EOI: u8 = 0xD9;
    pub const SOS: u8 = 0xDA;
    pub const DRI: u8 = 0xDD;
    pub const APP0: u8 = 0xE0;
    pub const COM: u8 = 0xFE;
}

/// A JPEG being written. Dropping it before [`Self::finish`] leaves an incomplete file.
pub struct JpegStream<W: Write> {
    sink: W,
    /// 1 to 100.
    quality: u8,
    width: u32,
    rows_left: u32,
    /// The rows of the strip that is being collected.
    strip: Vec<u8>,
    strips_written: u32,
}

impl<W: Write> JpegStream<W> {
    /// Starts a picture of `size_px` and writes its header with the scene `document`.
    ///
    /// `quality` is clamped to 1 to 100.
    ///
    /// # Errors
    /// [`ExportError::Write`] from `sink`, [`ExportError::Encode`] if a side is 0 or above 65535.
    pub fn new(
        mut sink: W,
        size_px: [u32; 2],
        document: &str,
        quality: u8,
    ) -> Result<Self, ExportError> {
        let [width, height] = size_px.map(u16::try_from);
        let (Ok(width @ 1..), Ok(height @ 1..)) = (width, height) else {
            return Err(ExportError::Encode("a JPEG has sides from 1 to 65535".to_owned()));
        };
        let quality = quality.clamp(1, 100);
        // A picture of one block has all the tables.
        let block = encoded(&[0; 192], [8, 8], quality)?;
        let mut header = vec![0xFF, marker::SOI];
        for segment in Segments::of(&block) {
            let Segment { kind, content } = segment.map_err(encode)?;
            match kind {
                marker::SOF0 => {
                    // Precision, height, width, components.
                    let mut frame = content.to_vec();
                    frame[1..3].copy_from_slice(&height.to_be_bytes());
                    frame[3..5].copy_from_slice(&width.to_be_bytes());
                    push_segment(&mut header, kind, &frame);
                }
                marker::SOS => {
                    let blocks_in_strip = width.div_ceil(STRIP_ROWS as u16);
                    push_segment(&mut header, marker::DRI, &blocks_in_strip.to_be_bytes());
                    push_segment(&mut header, kind, content);
                }
                _ => push_segment(&mut header, kind, content),
            }
            // JFIF's segment has to be the first one.
            if kind == marker::APP0 {
                push_document(&mut header, document);
            }
        }
        sink.write_all(&header)?;
        let [width, rows_left] = size_px;
        Ok(Self { sink, quality, width, rows_left, strip: Vec::new(), strips_written: 0 })
    }

    /// Appends any number of RGB bytes.
    ///
    /// # Errors
    /// [`ExportError::Write`] from the sink; [`ExportError::Encode`] past the last row.
    pub fn write_rgb(&mut self, mut rgb: &[u8]) -> Result<(), ExportError> {
        while !rgb.is_empty() {
            let rows = self.rows_left.min(STRIP_ROWS);
            if rows == 0 {
                return Err(encode("more rows than the picture has"));
            }
            let wanted = 3 * self.width as usize * rows as usize - self.strip.len();
            let (now, later) = rgb.split_at(wanted.min(rgb.len()));
            self.strip.extend_from_slice(now);
            rgb = later;
            if now.len() == wanted {
                self.write_strip(rows)?;
            }
        }
        Ok(())
    }

    /// Encodes and writes the collected strip of `rows`.
    fn write_strip(&mut self, rows: u32) -> Result<(), ExportError> {
        let file = encoded(&self.strip, [self.width, rows], self.quality)?;
        if let Some(last) = self.strips_written.checked_sub(1) {
            self.sink.write_all(&[0xFF, marker::RST0 + (last % 8) as u8])?;
        }
        self.sink.write_all(coded_blocks(&file)?)?;
        self.strip.clear();
        self.strips_written += 1;
        self.rows_left -= rows;
        Ok(())
    }

    /// Writes the end of the file and returns the flushed sink.
    ///
    /// # Errors
    /// [`ExportError::Encode`] if rows are missing, [`ExportError::Write`] from the sink.
    pub fn finish(mut self) -> Result<W, ExportError> {
        if self.rows_left > 0 {
            return Err(encode("rows are missing"));
        }
        self.sink.write_all(&[0xFF, marker::EOI])?;
        self.sink.flush()?;
        Ok(self.sink)
    }
}

/// A whole JPEG of `rgb`.
fn encoded(rgb: &[u8], [width, height]: [u32; 2], quality: u8) -> Result<Vec<u8>, ExportError> {
    let mut file = Vec::new();
    JpegEncoder::new_with_quality(&mut file, quality)
        .encode(rgb, width, height, ExtendedColorType::Rgb8)
        .map_err(|error| ExportError::Encode(error.to_string()))?;
    Ok(file)
}

fn encode(reason: &str) -> ExportError {
    ExportError::Encode(reason.to_owned())
}

/// The Huffman-coded blocks of a file with one scan, up to a whole byte.
fn coded_blocks(file: &[u8]) -> Result<&[u8], ExportError> {
    let mut segments = Segments::of(file);
    for segment in segments.by_ref() {
        segment.map_err(encode)?;
    }
    let blocks = segments.rest.strip_suffix(&[0xFF, marker::EOI]);
    blocks.ok_or_else(|| encode("a strip of a JPEG does not end"))
}

/// Appends the document as comments: `mandelight 1 of 2: …`.
fn push_document(header: &mut Vec<u8>, document: &str) {
    let mut parts = Vec::new();
    let mut rest = document;
    while !rest.is_empty() {
        let (part, later) = rest.split_at(rest.floor_char_boundary(PART_BYTES));
        parts.push(part);
        rest = later;
    }
    for (number, part) in (1..).zip(&parts) {
        let text = format!("{SCENE_KEYWORD} {number} of {}: {part}", parts.len());
        push_segment(header, marker::COM, text.as_bytes());
    }
}

/// Appends a segment, whose `content` has at most 65,533 bytes.
fn push_segment(header: &mut Vec<u8>, kind: u8, content: &[u8]) {
    header.extend([0xFF, kind]);
    header.extend((content.len() as u16 + 2).to_be_bytes());
    header.extend(content);
}

/// A segment of a header.
struct Segment<'a> {
    /// The marker's second byte.
    kind: u8,
    /// What follows the length.
    content: &'a [u8],
}

/// The segments up to the first scan's header; afterwards `rest` begins with the scan.
struct Segments<'a> {
    rest: &'a [u8],
    is_ended: bool,
}

impl<'a> Segments<'a> {
    /// The segments of a file that [`is_jpeg`].
    fn of(file: &'a [u8]) -> Self {
        Self { rest: file.get(2..).unwrap_or_default(), is_ended: false }
    }

    fn read(&mut self) -> Result<Option<Segment<'a>>, &'static str> {
        const CUT: &str = "it ends within its header";
        loop {
            let [0xFF, rest @ ..] = self.rest else {
                return Err(if self.rest.is_empty() { CUT } else { "its header is damaged" });
            };
            let (&kind, rest) = rest.split_first().ok_or(CUT)?;
            match kind {
                // Any number of 0xFF may precede a marker.
                0xFF => self.rest = &self.rest[1..],
                marker::EOI => return Ok(None),
                // Markers without a segment.
                0x01 | marker::RST0..=marker::RST7 => self.rest = rest,
                _ => {
                    let (&length, rest) = rest.split_first_chunk().ok_or(CUT)?;
                    let length = usize::from(u16::from_be_bytes(length));
                    let content = length.checked_sub(2).ok_or("its header is damaged")?;
                    let (content, rest) = rest.split_at_checked(content).ok_or(CUT)?;
                    self.rest = rest;
                    self.is_ended = kind == marker::SOS;
                    return Ok(Some(Segment { kind, content }));
                }
            }
        }
    }
}

impl<'a> Iterator for Segments<'a> {
    type Item = Result<Segment<'a>, &'static str>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.is_ended {
            return None;
        }
        let segment = self.read().transpose();
        self.is_ended |= !matches!(segment, Some(Ok(_)));
        segment
    }
}

/// True if `bytes` begin as a JPEG does.
pub fn is_jpeg(bytes: &[u8]) -> bool {
    bytes.starts_with(&[0xFF, marker::SOI, 0xFF])
}

fn unreadable(reason: &str) -> SceneTextError {
    SceneTextError::unreadable("JPEG", reason)
}

/// The scene document of a JPEG, if it has one before its pixels.
///
/// `bytes` may end after the header: the pixels are neither read nor decoded.
///
/// # Errors
/// See [`SceneTextError`]; the content of `bytes` is untrusted.
pub fn jpeg_scene_text(bytes: &[u8]) -> Result<Option<String>, SceneTextError> {
    if !is_jpeg(bytes) {
        return Err(unreadable("it begins as another file"));
    }
    let mut parts: Vec<Option<&str>> = Vec::new();
    for segment in Segments::of(bytes) {
        let segment = segment.map_err(unreadable)?;
        let Some((number, count, part)) = part(&segment) else { continue };
        if count > MAX_PARTS {
            return Err(SceneTextError::TooLarge);
        }
        parts.resize(count.max(parts.len()), None);
        if let Some(place) = number.checked_sub(1).and_then(|index| parts.get_mut(index)) {
            *place = Some(part);
        }
    }
    if parts.is_empty() {
        return Ok(None);
    }
    let text = parts.into_iter().collect::<Option<String>>();
    text.ok_or_else(|| unreadable("a part of its scene is missing")).and_then(capped).map(Some)
}

/// Width and height in pixels of a complete JPEG; `None` where its end is not there.
///
/// Reads the header, at most [`MAX_HEADER_BYTES`] of it, and the last two bytes.
///
/// # Errors
/// [`SceneTextError::Unreadable`] for a file that is no JPEG; the content of `reader` is untrusted.
pub fn jpeg_complete_size(reader: impl Read + Seek) -> Result<Option<[u32; 2]>, SceneTextError> {
    let size = || -> Result<Option<[u32; 2]>, Unreadable> {
        let mut file = Source::new(reader).map_err(Unreadable::new)?;
        let header = file.up_to(MAX_HEADER_BYTES, "the header")?;
        if !is_jpeg(&header) {
            return Err(Unreadable::new("it begins as another file"));
        }
        let size = jpeg_size(&header)?;
        file.go_to(file.length().saturating_sub(2), "the end")?;
        let is_complete = file.array("the end")? == [0xFF, marker::EOI];
        Ok(is_complete.then_some(size))
    };
    size().map_err(|error| SceneTextError::unreadable("JPEG", error))
}

/// Width and height in pixels of a JPEG that [`is_jpeg`], from its header: baseline, extended or progressive.
///
/// # Errors
/// If the header is damaged or has no size.
pub(super) fn jpeg_size(header: &[u8]) -> Result<[u32; 2], Unreadable> {
    for segment in Segments::of(header) {
        let Segment { kind, content } = segment.map_err(Unreadable::new)?;
        // A frame's header: bits of a channel, height, width.
        if matches!(kind, marker::SOF0 | marker::SOF1 | marker::SOF2)
            && let [_, y0, y1, x0, x1, ..] = *content
        {
            return Ok([[x0, x1], [y0, y1]].map(|side| u32::from(u16::from_be_bytes(side))));
        }
    }
    Err(Unreadable::new("its header has no size"))
}

/// The number of a document's part, the number of parts, and the part; none for other segments.
fn part<'a>(segment: &Segment<'a>) -> Option<(usize, usize, &'a str)> {
    if segment.kind != marker::COM {
        return None;
    }
    // Some programs end a comment by a zero.
    let comment = str::from_utf8(segment.content).ok()?.trim_end_matches('\0');
    let (numbers, part) = comment.strip_prefix(SCENE_KEYWORD)?.split_once(": ")?;
    let (number, count) = numbers.trim().split_once(" of ")?;
    Some((number.parse().ok()?, count.parse().ok()?, part))
}

#[cfg(test)]
mod tests;
