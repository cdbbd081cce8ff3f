//! Streaming PNG writer with the scene document, and reader of the scene document.
//!
//! The writer gets sRGB rows, 8 or 16 bits per channel, from the top and the scene document, and writes a file's
//! bytes. The reader accepts untrusted files; its memory is bounded.

use std::{
    io::{self, BufRead, Read, Seek, Write},
    sync::{Arc, Mutex, PoisonError},
};

pub use png::BitDepth;

use super::{
    ExportError, MAX_HEADER_BYTES, MAX_TEXT_BYTES, SceneTextError,
    metadata::{SCENE_KEYWORD, capped},
};
use crate::reading::source::{Source, Unreadable};

/// Size of the file's compressed data chunks, in bytes.
const IDAT_BYTES: usize = 1 << 16;

/// The first bytes of every PNG.
const SIGNATURE: [u8; 8] = *b"\x89PNG\r\n\x1a\n";

/// Bytes up to the end of the size in pixels: the signature, and the first chunk's length, name and sides.
const SIZE_END: usize = SIGNATURE.len() + 16;

/// The last chunk of every PNG: its length, name and checksum.
const END: [u8; 12] = *b"\0\0\0\0IEND\xae\x42\x60\x82";

/// A shared buffer of the encoder's output.
#[derive(Clone, Default)]
struct Outbox(Arc<Mutex<Vec<u8>>>);

impl Outbox {
    fn take(&self) -> Vec<u8> {
        std::mem::take(&mut *self.0.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

impl Write for Outbox {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// A PNG being written. Dropping it before [`Self::finish`] leaves an incomplete file.
pub struct PngStream<W: Write> {
    // The encoder's destructor writes the last chunk and would lose an error. So the encoder
    // writes to memory, and this type copies the bytes to the sink.
    encoder: png::StreamWriter<'static, Outbox>,
    outbox: Outbox,
    sink: W,
}

impl<W: Write> PngStream<W> {
    /// Starts a picture of `size_px`, 8 bits per channel, and writes its header with the scene `document`.
    ///
    /// # Errors
    /// [`ExportError::Write`] from `sink`, [`ExportError::Encode`] if a side is zero.
    pub fn new(sink: W, size_px: [u32; 2], document: &str) -> Result<Self, ExportError> {
        Self::with_layout(sink, size_px, document, BitDepth::Eight, false)
    }

    /// The same with as many bits per channel as `depth` says, and with alpha, straight, if `has_alpha`.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn with_layout(
        sink: W,
        size_px: [u32; 2],
        document: &str,
        depth: BitDepth,
        has_alpha: bool,
    ) -> Result<Self, ExportError> {
        let outbox = Outbox::default();
        let mut header = png::Encoder::new(outbox.clone(), size_px[0], size_px[1]);
        header.set_color(if has_alpha { png::ColorType::Rgba } else { png::ColorType::Rgb });
        header.set_depth(depth);
        header.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
        header.set_compression(png::Compression::Balanced);
        let software = concat!("Mandelight ", env!("CARGO_PKG_VERSION"));
        header.add_text_chunk("Software".to_owned(), software.to_owned()).map_err(encode)?;
        // The chunk is uncompressed, so that every tool that lists text chunks shows the scene.
        header.add_itxt_chunk(SCENE_KEYWORD.to_owned(), document.to_owned()).map_err(encode)?;
        let encoder = header
            .write_header()
            .and_then(|writer| writer.into_stream_writer_with_size(IDAT_BYTES))
            .map_err(encode)?;
        let mut stream = Self { encoder, outbox, sink };
        stream.drain()?;
        Ok(stream)
    }

    /// Appends any number of bytes of pixels; a channel of 16 bits begins with its high byte.
    ///
    /// # Errors
    /// [`ExportError::Write`] from the sink; [`ExportError::Encode`] past the last row.
    pub fn write_pixels(&mut self, rgb: &[u8]) -> Result<(), ExportError> {
        self.encoder.write_all(rgb).map_err(|error| ExportError::Encode(error.to_string()))?;
        self.drain()
    }

    /// Writes the end of the file and returns the flushed sink.
    ///
    /// # Errors
    /// [`ExportError::Encode`] if rows are missing, [`ExportError::Write`] from the sink.
    pub fn finish(self) -> Result<W, ExportError> {
        let Self { encoder, outbox, mut sink } = self;
        encoder.finish().map_err(encode)?;
        sink.write_all(&outbox.take())?;
        sink.flush()?;
        Ok(sink)
    }

    /// Copies the encoder's output to the sink.
    fn drain(&mut self) -> Result<(), ExportError> {
        Ok(self.sink.write_all(&self.outbox.take())?)
    }
}

fn encode(error: png::EncodingError) -> ExportError {
    ExportError::Encode(error.to_string())
}

/// True if `bytes` begin with the PNG signature.
pub fn is_png(bytes: &[u8]) -> bool {
    bytes.starts_with(&SIGNATURE)
}

/// Width and height in pixels of a complete PNG; `None` where its last chunk is not there.
///
/// # Errors
/// [`SceneTextError::Unreadable`] for a file that is no PNG; the content of `reader` is untrusted.
pub fn png_complete_size(reader: impl Read + Seek) -> Result<Option<[u32; 2]>, SceneTextError> {
    let size = || -> Result<Option<[u32; 2]>, Unreadable> {
        let mut file = Source::new(reader).map_err(Unreadable::new)?;
        let header = file.array::<SIZE_END>("the header")?;
        if !is_png(&header) {
            return Err(Unreadable::new("it has no signature"));
        }
        file.go_to(file.length().saturating_sub(END.len() as u64), "the last chunk")?;
        let is_complete = file.array("the last chunk")? == END;
        Ok(png_size(&header).ok().filter(|_| is_complete))
    };
    size().map_err(|error| SceneTextError::unreadable("PNG", error))
}

/// Width and height in pixels of a PNG that [`is_png`], from its first bytes.
///
/// # Errors
/// If its first chunk is not the header.
pub(super) fn png_size(start: &[u8]) -> Result<[u32; 2], Unreadable> {
    match start.get(SIGNATURE.len() + 4..SIZE_END) {
        Some(&[b'I', b'H', b'D', b'R', w0, w1, w2, w3, h0, h1, h2, h3]) => {
            Ok([[w0, w1, w2, w3], [h0, h1, h2, h3]].map(u32::from_be_bytes))
        }
        _ => Err(Unreadable::new("its header has no size")),
    }
}

/// Whether all of a PNG's pixels can be read: a crash of the machine may leave holes in a file.
pub fn png_has_all_pixels(reader: impl BufRead + Seek) -> bool {
    let limits = png::Limits { bytes: MAX_HEADER_BYTES };
    let Ok(mut reader) = png::Decoder::new_with_limits(reader, limits).read_info() else {
        return false;
    };
    loop {
        match reader.next_row() {
            Ok(Some(_)) => {}
            Ok(None) => return reader.finish().is_ok(),
            Err(_) => return false,
        }
    }
}

/// The scene document of a PNG, if it has one before its pixels.
///
/// The pixels are neither read nor decoded.
///
/// # Errors
/// See [`SceneTextError`]; the content of `reader` is untrusted.
pub fn scene_text(reader: impl BufRead + Seek) -> Result<Option<String>, SceneTextError> {
    let limits = png::Limits { bytes: MAX_HEADER_BYTES };
    let reader = png::Decoder::new_with_limits(reader, limits).read_info().map_err(decode)?;
    let info = reader.info();

    if let Some(chunk) = info.utf8_text.iter().find(|chunk| chunk.keyword == SCENE_KEYWORD) {
        let mut chunk = chunk.clone();
        chunk.decompress_text_with_limit(MAX_TEXT_BYTES).map_err(decode)?;
        return capped(chunk.get_text().map_err(decode)?).map(Some);
    }
    // Programs that re-save a PNG convert plain ASCII text to the two older chunk types.
    if let Some(chunk) =
        info.uncompressed_latin1_text.iter().find(|chunk| chunk.keyword == SCENE_KEYWORD)
    {
        return capped(chunk.text.clone()).map(Some);
    }
    if let Some(chunk) =
        info.compressed_latin1_text.iter().find(|chunk| chunk.keyword == SCENE_KEYWORD)
    {
        let mut chunk = chunk.clone();
        chunk.decompress_text_with_limit(MAX_TEXT_BYTES).map_err(decode)?;
        return capped(chunk.get_text().map_err(decode)?).map(Some);
    }
    Ok(None)
}

fn decode(error: png::DecodingError) -> SceneTextError {
    match error {
        png::DecodingError::LimitsExceeded => SceneTextError::TooLarge,
        other => SceneTextError::unreadable("PNG", other),
    }
}

#[cfg(test)]
mod tests;
