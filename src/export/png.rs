//! Rows of pixels to a PNG, written while it is made; and the scene back out of a PNG.
//!
//! In: 8-bit RGB rows, sRGB-encoded, from the top; and the scene document that they show. Out:
//! bytes for a file or a blob. A reader may be handed anything at all: what it keeps is bounded.

use std::{
    io::{self, BufRead, Seek, Write},
    sync::{Arc, Mutex, PoisonError},
};

use super::ExportError;

/// The keyword of the text chunk that holds the scene document.
pub const SCENE_KEYWORD: &str = "mandelight";

/// Longest scene document that is read out of a PNG, in bytes after inflating.
pub const MAX_TEXT_BYTES: usize = 1 << 20;

/// What the decoder may keep of a file's chunks before the first pixels, in bytes.
const MAX_METADATA_BYTES: usize = 8 * MAX_TEXT_BYTES;

/// Size of the compressed chunks in the file, in bytes.
const IDAT_BYTES: usize = 1 << 16;

/// The first bytes of every PNG.
const SIGNATURE: [u8; 8] = *b"\x89PNG\r\n\x1a\n";

/// Bytes that the encoder has made and nobody has taken yet.
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

/// A PNG in the making. Dropped before its end, it leaves `sink` with half a file.
pub struct PngStream<W: Write> {
    // The encoder writes its last chunk as it is dropped, where an error would be lost; so it
    // writes to memory, and this type moves what it wrote to the sink.
    encoder: png::StreamWriter<'static, Outbox>,
    outbox: Outbox,
    sink: W,
}

impl<W: Write> PngStream<W> {
    /// Starts a picture of `size_px` and writes its header, with `document` as its scene.
    ///
    /// # Errors
    /// [`ExportError::Write`] from `sink`, [`ExportError::Encode`] where a side is zero.
    pub fn new(sink: W, size_px: [u32; 2], document: &str) -> Result<Self, ExportError> {
        let outbox = Outbox::default();
        let mut header = png::Encoder::new(outbox.clone(), size_px[0], size_px[1]);
        header.set_color(png::ColorType::Rgb);
        header.set_depth(png::BitDepth::Eight);
        header.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
        header.set_compression(png::Compression::Balanced);
        let software = concat!("Mandelight ", env!("CARGO_PKG_VERSION"));
        header.add_text_chunk("Software".to_owned(), software.to_owned()).map_err(encode)?;
        // Uncompressed, so that any tool that shows text chunks shows the scene.
        header.add_itxt_chunk(SCENE_KEYWORD.to_owned(), document.to_owned()).map_err(encode)?;
        let encoder = header
            .write_header()
            .and_then(|writer| writer.into_stream_writer_with_size(IDAT_BYTES))
            .map_err(encode)?;
        let mut stream = Self { encoder, outbox, sink };
        stream.pass_on()?;
        Ok(stream)
    }

    /// Adds RGB bytes that follow the last ones: any number of them.
    ///
    /// # Errors
    /// [`ExportError::Write`] from the sink; [`ExportError::Encode`] past the last row.
    pub fn write_rgb(&mut self, rgb: &[u8]) -> Result<(), ExportError> {
        self.encoder.write_all(rgb).map_err(|error| ExportError::Encode(error.to_string()))?;
        self.pass_on()
    }

    /// Writes the end of the file and gives the flushed sink back.
    ///
    /// # Errors
    /// [`ExportError::Encode`] where rows are missing, [`ExportError::Write`] from the sink.
    pub fn finish(self) -> Result<W, ExportError> {
        let Self { encoder, outbox, mut sink } = self;
        encoder.finish().map_err(encode)?;
        sink.write_all(&outbox.take())?;
        sink.flush()?;
        Ok(sink)
    }

    fn pass_on(&mut self) -> Result<(), ExportError> {
        Ok(self.sink.write_all(&self.outbox.take())?)
    }
}

fn encode(error: png::EncodingError) -> ExportError {
    ExportError::Encode(error.to_string())
}

/// Why no text could be read from a PNG.
#[derive(Debug, thiserror::Error)]
pub enum PngError {
    /// It is no PNG, or a damaged one.
    #[error("not a readable PNG: {0}")]
    Unreadable(String),
    /// The scene's text, or what comes with it, is larger than any scene.
    #[error("its text is larger than {MAX_TEXT_BYTES} bytes")]
    TooLarge,
}

/// Whether `bytes` start like a PNG.
pub fn is_png(bytes: &[u8]) -> bool {
    bytes.starts_with(&SIGNATURE)
}

/// The scene document that a PNG carries ahead of its pixels; none where it carries none.
/// The pixels are neither decoded nor read.
///
/// # Errors
/// See [`PngError`]: `reader` may hold anything.
pub fn scene_text(reader: impl BufRead + Seek) -> Result<Option<String>, PngError> {
    let limits = png::Limits { bytes: MAX_METADATA_BYTES };
    let reader = png::Decoder::new_with_limits(reader, limits).read_info().map_err(decode)?;
    let info = reader.info();

    if let Some(chunk) = info.utf8_text.iter().find(|chunk| chunk.keyword == SCENE_KEYWORD) {
        let mut chunk = chunk.clone();
        chunk.decompress_text_with_limit(MAX_TEXT_BYTES).map_err(decode)?;
        return capped(chunk.get_text().map_err(decode)?).map(Some);
    }
    // Programs that save a PNG again turn plain text into the two older kinds.
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

fn capped(text: String) -> Result<String, PngError> {
    if text.len() > MAX_TEXT_BYTES { Err(PngError::TooLarge) } else { Ok(text) }
}

fn decode(error: png::DecodingError) -> PngError {
    match error {
        png::DecodingError::LimitsExceeded => PngError::TooLarge,
        other => PngError::Unreadable(other.to_string()),
    }
}

#[cfg(test)]
mod tests;
