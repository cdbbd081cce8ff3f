//! What a PNG holds.

use std::io::{BufRead, Cursor, Seek};

/// A decoded PNG of eight bits a channel, without alpha unless it has one.
pub struct Picture {
    /// Width and height in pixels.
    pub size_px: [u32; 2],
    /// Its channels, row by row from the top.
    pub bytes: Vec<u8>,
    /// The text chunks: keyword and text.
    pub texts: Vec<(String, String)>,
}

impl Picture {
    /// Decodes a whole PNG.
    ///
    /// # Errors
    /// Where it is cut short or damaged.
    pub fn decode(file: impl BufRead + Seek) -> Result<Self, png::DecodingError> {
        let mut reader = png::Decoder::new(file).read_info()?;
        let size_px = [reader.info().width, reader.info().height];
        let mut bytes = vec![0; reader.output_buffer_size().expect("a size that fits memory")];
        reader.next_frame(&mut bytes)?;
        reader.finish()?;
        let texts = reader.info().utf8_text.iter();
        let texts = texts.map(|chunk| Ok((chunk.keyword.clone(), chunk.get_text()?)));
        Ok(Self { size_px, bytes, texts: texts.collect::<Result<_, png::DecodingError>>()? })
    }

    /// The picture that `file` holds.
    pub fn of(file: &[u8]) -> Self {
        Self::decode(Cursor::new(file)).expect("a whole PNG")
    }

    /// Pixels of a picture without alpha.
    pub fn rgb(&self) -> Vec<[u8; 3]> {
        assert_eq!(self.bytes.len(), 3 * self.size_px[0] as usize * self.size_px[1] as usize);
        self.bytes.as_chunks().0.to_vec()
    }
}
