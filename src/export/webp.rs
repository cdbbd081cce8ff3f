//! Writer of lossless WebP with the scene document, and reader of the scene document.
//!
//! The writer gets 8-bit sRGB rows from the top and the scene document, and writes a file's bytes.
//! The format needs the statistics of all pixels and the file's size before the first pixel. So this
//! writer alone holds the whole picture, and [`MAX_WEBP_PIXELS`](super::MAX_WEBP_PIXELS) limits it. The document is in an
//! XMP packet, which other programs keep, before the pixels. The reader accepts untrusted files.

use std::io::{Read, Seek, Write};

use image_webp::{ColorType, WebPEncoder};

use super::{
    ExportError, SceneTextError, checked_webp_size,
    metadata::{SCENE_KEYWORD, capped},
};
use crate::reading::source::{Source, Unreadable};

/// Bytes of the file's header: `RIFF`, the size of what follows, `WEBP`.
const RIFF_HEADER_BYTES: usize = 12;

/// Bytes of a chunk's header: its name and its size.
const CHUNK_HEADER_BYTES: usize = 8;

/// Bytes up to the end of the first chunk's size in pixels.
const SIZE_END: usize = RIFF_HEADER_BYTES + 18;

/// Bits of the `VP8X` chunk: that the file has an XMP chunk, and that its pixels have alpha.
const HAS_XMP: u8 = 1 << 2;
const HAS_ALPHA: u8 = 1 << 4;

/// A WebP being collected. Dropping it before [`Self::finish`] writes nothing.
pub struct WebPStream<W: Write> {
    sink: W,
    size_px: [u32; 2],
    document: String,
    has_alpha: bool,
    pixels: Vec<u8>,
}

impl<W: Write> WebPStream<W> {
    /// Starts a picture of `size_px` with the scene `document`, and with alpha, straight, if `has_alpha`.
    ///
    /// # Errors
    /// [`ExportError::WebPSize`] for a size out of range, [`ExportError::Encode`] if memory is short.
    pub fn new(
        sink: W,
        size_px: [u32; 2],
        document: &str,
        has_alpha: bool,
    ) -> Result<Self, ExportError> {
        let document = document.to_owned();
        let size_px = checked_webp_size(size_px)?;
        let mut stream = Self { sink, size_px, document, has_alpha, pixels: Vec::new() };
        let bytes = stream.missing_bytes();
        let room = stream.pixels.try_reserve_exact(bytes);
        room.map_err(|_| encode("memory is too short for a WebP of this size"))?;
        Ok(stream)
    }

    /// Appends any number of bytes of pixels.
    ///
    /// # Errors
    /// [`ExportError::Encode`] past the last row.
    pub fn write_pixels(&mut self, pixels: &[u8]) -> Result<(), ExportError> {
        if pixels.len() > self.missing_bytes() {
            return Err(encode("more rows than the picture has"));
        }
        self.pixels.extend_from_slice(pixels);
        Ok(())
    }

    fn missing_bytes(&self) -> usize {
        let [width, height] = self.size_px.map(|side| side as usize);
        let channels = if self.has_alpha { 4 } else { 3 };
        channels * width * height - self.pixels.len()
    }

    /// Encodes the picture, writes the file and returns the flushed sink.
    ///
    /// # Errors
    /// [`ExportError::Encode`] if rows are missing, [`ExportError::Write`] from the sink.
    pub fn finish(mut self) -> Result<W, ExportError> {
        if self.missing_bytes() > 0 {
            return Err(encode("rows are missing"));
        }
        let [width, height] = self.size_px;
        let color = if self.has_alpha { ColorType::Rgba8 } else { ColorType::Rgb8 };
        let mut file = Vec::new();
        WebPEncoder::new(&mut file)
            .encode(&self.pixels, width, height, color)
            .map_err(|error| ExportError::Encode(error.to_string()))?;
        let pixels = file.get(RIFF_HEADER_BYTES..).unwrap_or_default();

        // Flags, three reserved bytes, width and height less one in 24 bits each.
        let flags = if self.has_alpha { HAS_XMP | HAS_ALPHA } else { HAS_XMP };
        let mut features = vec![flags, 0, 0, 0];
        for side in self.size_px {
            features.extend(&(side - 1).to_le_bytes()[..3]);
        }
        let mut start = b"WEBP".to_vec();
        push_chunk(&mut start, b"VP8X", &features);
        push_chunk(&mut start, b"XMP ", xmp(&self.document).as_bytes());
        let size = u32::try_from(start.len() + pixels.len());
        let size = size.map_err(|_| encode("a WebP cannot be larger than 4 GiB"))?;
        self.sink.write_all(b"RIFF")?;
        self.sink.write_all(&size.to_le_bytes())?;
        self.sink.write_all(&start)?;
        self.sink.write_all(pixels)?;
        self.sink.flush()?;
        Ok(self.sink)
    }
}

fn encode(reason: &str) -> ExportError {
    ExportError::Encode(reason.to_owned())
}

/// Appends a chunk, whose content is padded to an even length.
fn push_chunk(file: &mut Vec<u8>, name: &[u8; 4], content: &[u8]) {
    file.extend(name);
    file.extend((content.len() as u32).to_le_bytes());
    file.extend(content);
    if !content.len().is_multiple_of(2) {
        file.push(0);
    }
}

/// An XMP packet (ISO 16684-1) with `document` as the property `mandelight:scene`.
fn xmp(document: &str) -> String {
    let document = document.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;");
    let version = env!("CARGO_PKG_VERSION");
    format!(
        "<?xpacket begin=\"\u{feff}\" id=\"W5M0MpCehiHzreSzNTczkc9d\"?>\
         <x:xmpmeta xmlns:x=\"adobe:ns:meta/\">\
         <rdf:RDF xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\">\
         <rdf:Description rdf:about=\"\" xmlns:xmp=\"http://ns.adobe.com/xap/1.0/\" xmlns:{SCENE_KEYWORD}=\"urn:x-mandelight:\">\
         <xmp:CreatorTool>Mandelight {version}</xmp:CreatorTool>\
         <{SCENE_KEYWORD}:scene>{document}</{SCENE_KEYWORD}:scene>\
         </rdf:Description></rdf:RDF></x:xmpmeta><?xpacket end=\"r\"?>"
    )
}

/// The document in an XMP packet; none in the packets of others.
///
/// Programs may turn a property's element into an attribute.
fn document_in_xmp(xmp: &str) -> Option<String> {
    let mut rest = xmp;
    loop {
        (_, rest) = rest.split_once(&format!("{SCENE_KEYWORD}:scene"))?;
        let content = match rest.split_at_checked(1)? {
            (">", content) => content.split('<').next(),
            ("=", content) => {
                let quote = content.chars().next().filter(|quote| ['"', '\''].contains(quote));
                quote.and_then(|quote| content[1..].split(quote).next())
            }
            _ => None,
        };
        if let Some(content) = content {
            return Some(unescaped(content));
        }
    }
}

/// `text` with its XML entities replaced; those that are unknown stay.
fn unescaped(text: &str) -> String {
    let mut plain = String::with_capacity(text.len());
    let mut rest = text;
    while let Some((before, entity)) = rest.split_once('&') {
        plain.push_str(before);
        match entity.split_once(';').and_then(|(name, after)| Some((letter(name)?, after))) {
            Some((letter, after)) => {
                plain.push(letter);
                rest = after;
            }
            None => {
                plain.push('&');
                rest = entity;
            }
        }
    }
    plain + rest
}

/// The letter of an XML entity, such as `lt` or `#x3c`.
fn letter(name: &str) -> Option<char> {
    Some(match name {
        "amp" => '&',
        "lt" => '<',
        "gt" => '>',
        "quot" => '"',
        "apos" => '\'',
        _ => {
            let code = name.strip_prefix('#')?;
            let number = match code.strip_prefix('x') {
                Some(digits) => u32::from_str_radix(digits, 16),
                None => code.parse(),
            };
            char::from_u32(number.ok()?)?
        }
    })
}

/// True if `bytes` begin as a WebP does.
pub fn is_webp(bytes: &[u8]) -> bool {
    bytes.starts_with(b"RIFF") && bytes.get(8..RIFF_HEADER_BYTES) == Some(b"WEBP".as_slice())
}

fn unreadable(reason: &str) -> SceneTextError {
    SceneTextError::unreadable("WebP", reason)
}

/// The scene document of a WebP, if it has one within `bytes`.
///
/// `bytes` may end within the pixels, which are neither read nor decoded.
///
/// # Errors
/// See [`SceneTextError`]; the content of `bytes` is untrusted.
pub fn webp_scene_text(bytes: &[u8]) -> Result<Option<String>, SceneTextError> {
    if !is_webp(bytes) {
        return Err(unreadable("it begins as another file"));
    }
    let mut rest = &bytes[RIFF_HEADER_BYTES..];
    while let Some((header, content)) = rest.split_first_chunk::<CHUNK_HEADER_BYTES>() {
        let [n0, n1, n2, n3, size @ ..] = *header;
        let size = u32::from_le_bytes(size) as usize;
        if &[n0, n1, n2, n3] == b"XMP " {
            let packet = content.get(..size).ok_or_else(|| unreadable("its metadata are cut"))?;
            let packet =
                str::from_utf8(packet).map_err(|_| unreadable("its metadata are no valid text"))?;
            return document_in_xmp(packet).map(capped).transpose();
        }
        // Chunks are padded to an even length.
        rest = content.get(size.saturating_add(size % 2)..).unwrap_or_default();
    }
    Ok(None)
}

/// Width and height in pixels of a complete WebP with metadata; `None` where its end is not there.
///
/// # Errors
/// [`SceneTextError::Unreadable`] for a file that is no such WebP; the content of `reader` is untrusted.
pub fn webp_complete_size(reader: impl Read + Seek) -> Result<Option<[u32; 2]>, SceneTextError> {
    let size = || -> Result<Option<[u32; 2]>, Unreadable> {
        let mut file = Source::new(reader).map_err(Unreadable::new)?;
        let header = file.array::<SIZE_END>("the header")?;
        if !is_webp(&header) {
            return Err(Unreadable::new("it begins as another file"));
        }
        let size = webp_size(&header)?;
        let [_, _, _, _, l0, l1, l2, l3, ..] = header;
        let length = u64::from(u32::from_le_bytes([l0, l1, l2, l3])) + 8;
        Ok((length == file.length()).then_some(size))
    };
    size().map_err(|error| SceneTextError::unreadable("WebP", error))
}

/// Width and height in pixels of a WebP with metadata that [`is_webp`], from its first bytes.
///
/// # Errors
/// If its first chunk is another one than a file with metadata has.
pub(super) fn webp_size(header: &[u8]) -> Result<[u32; 2], Unreadable> {
    // The first chunk: its header, flags and three reserved bytes, width and height less one in 24 bits each.
    match header.get(RIFF_HEADER_BYTES..SIZE_END) {
        Some(&[b'V', b'P', b'8', b'X', _, _, _, _, _, _, _, _, w0, w1, w2, h0, h1, h2]) => {
            Ok([[w0, w1, w2, 0], [h0, h1, h2, 0]].map(|side| u32::from_le_bytes(side) + 1))
        }
        _ => Err(Unreadable::new("its header has no size")),
    }
}

#[cfg(test)]
mod tests;
