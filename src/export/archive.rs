//! A streaming zip writer.
//!
//! In: names and bytes, one file after another. Out: the archive, to a sink that cannot seek.
//! Files are stored without compression, because PNGs are already compressed. One file at a time
//! is buffered, so that its length and checksum precede its content: every unzip tool can read
//! this form.

use std::io::{self, Read, Seek, SeekFrom, Write};

use zip::{CompressionMethod, DateTime, ZipWriter, write::SimpleFileOptions};

use super::ExportError;

/// A zip archive being written. Dropping it before [`Self::finish`] leaves an incomplete file.
pub struct Archive<W: Write> {
    zip: ZipWriter<Window<W>>,
}

impl<W: Write> Archive<W> {
    /// An empty archive that writes to `sink`.
    pub fn new(sink: W) -> Self {
        let mut zip = ZipWriter::new(Window { sink, written: 0, buffer: Vec::new(), cursor: 0 });
        zip.set_flush_on_finish_file(true);
        Self { zip }
    }

    /// Adds a file of at most 4 GiB with a unique name.
    ///
    /// # Errors
    /// [`ExportError::Write`] from the sink, or for a name that the archive already contains.
    pub fn add(&mut self, name: &str, bytes: &[u8]) -> Result<(), ExportError> {
        let options = SimpleFileOptions::default()
            .compression_method(CompressionMethod::Stored)
            .last_modified_time(DateTime::default());
        self.zip.start_file(name, options).map_err(io::Error::from)?;
        Ok(self.zip.write_all(bytes)?)
    }

    /// Writes the archive's central directory and returns the flushed sink.
    ///
    /// # Errors
    /// [`ExportError::Write`] from the sink.
    pub fn finish(self) -> Result<W, ExportError> {
        let mut window = self.zip.finish().map_err(io::Error::from)?;
        window.flush()?;
        window.sink.flush()?;
        Ok(window.sink)
    }
}

/// A buffered writer that can seek within its buffer.
struct Window<W> {
    sink: W,
    /// Number of bytes written to the sink.
    written: u64,
    buffer: Vec<u8>,
    /// Position of the next byte in `buffer`; at most the buffer's length.
    cursor: usize,
}

impl<W: Write> Write for Window<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let overwritten = bytes.len().min(self.buffer.len() - self.cursor);
        self.buffer[self.cursor..self.cursor + overwritten].copy_from_slice(&bytes[..overwritten]);
        self.buffer.extend_from_slice(&bytes[overwritten..]);
        self.cursor += bytes.len();
        Ok(bytes.len())
    }

    /// Writes the buffer to the sink. The zip writer calls this after each complete file.
    fn flush(&mut self) -> io::Result<()> {
        self.sink.write_all(&self.buffer)?;
        self.written += self.buffer.len() as u64;
        self.buffer.clear();
        self.cursor = 0;
        Ok(())
    }
}

// `ZipWriter` requires `Read` for archives that it appends to.
impl<W> Read for Window<W> {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        let read = (&self.buffer[self.cursor..]).read(bytes)?;
        self.cursor += read;
        Ok(read)
    }
}

impl<W> Seek for Window<W> {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        let end = self.written + self.buffer.len() as u64;
        let target = match to {
            SeekFrom::Start(position) => Some(position),
            SeekFrom::End(offset) => end.checked_add_signed(offset),
            SeekFrom::Current(offset) => {
                (self.written + self.cursor as u64).checked_add_signed(offset)
            }
        };
        let position = target.filter(|position| (self.written..=end).contains(position)).ok_or(
            io::Error::new(io::ErrorKind::Unsupported, "this part of the archive is written"),
        )?;
        // A position within the buffer fits a usize.
        self.cursor = (position - self.written) as usize;
        Ok(position)
    }
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use super::*;

    /// Records all bytes and the largest single write.
    #[derive(Default)]
    struct Sink {
        bytes: Vec<u8>,
        largest: usize,
    }

    impl Write for Sink {
        fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
            self.largest = self.largest.max(bytes.len());
            self.bytes.extend_from_slice(bytes);
            Ok(bytes.len())
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    fn content(index: usize) -> Vec<u8> {
        (0..10_000).map(|i| (i * (index + 3) % 251) as u8).collect()
    }

    #[test]
    fn files_round_trip_and_are_written_one_at_a_time() {
        let mut archive = Archive::new(Sink::default());
        for index in 0..20 {
            archive.add(&format!("f{index}"), &content(index)).unwrap();
        }
        let sink = archive.finish().unwrap();
        assert!(sink.largest < 12_000, "{} bytes were buffered", sink.largest);
        // Bit 3 of a file's flags is clear if its length and checksum precede its content.
        assert_eq!(sink.bytes[6] & 8, 0);
        assert_eq!(u32::from_le_bytes(sink.bytes[18..22].try_into().unwrap()), 10_000);
        let mut read = zip::ZipArchive::new(Cursor::new(sink.bytes)).unwrap();
        assert_eq!(read.len(), 20);
        for index in 0..20 {
            let mut bytes = Vec::new();
            read.by_name(&format!("f{index}")).unwrap().read_to_end(&mut bytes).unwrap();
            assert_eq!(bytes, content(index));
        }
    }

    #[test]
    fn a_failing_sink_is_an_error() {
        struct Full;
        impl Write for Full {
            fn write(&mut self, _: &[u8]) -> io::Result<usize> {
                Err(io::Error::other("full"))
            }
            fn flush(&mut self) -> io::Result<()> {
                Ok(())
            }
        }
        let mut archive = Archive::new(Full);
        archive.add("a", b"1").unwrap();
        assert!(matches!(archive.add("b", b"2"), Err(ExportError::Write(_))));
    }
}
