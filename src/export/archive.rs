//! A zip of files, written while they come.
//!
//! In: names and bytes, one file after another. Out: the archive, to a sink that need not seek.
//! Files are stored as they are: a PNG is packed already. One file at a time stands in memory, so
//! that its length and checksum can go ahead of it, where every unzipper finds them.

use std::io::{self, Read, Seek, SeekFrom, Write};

use zip::{CompressionMethod, DateTime, ZipWriter, write::SimpleFileOptions};

use super::ExportError;

/// An archive in the making. Dropped before its end, it leaves the sink with half of one.
pub struct Archive<W: Write> {
    zip: ZipWriter<Window<W>>,
}

impl<W: Write> Archive<W> {
    /// An archive that goes to `sink`.
    pub fn new(sink: W) -> Self {
        let mut zip = ZipWriter::new(Window { sink, passed_on: 0, held: Vec::new(), at: 0 });
        zip.set_flush_on_finish_file(true);
        Self { zip }
    }

    /// Adds a file of at most 4 GiB. Names are all different.
    ///
    /// # Errors
    /// [`ExportError::Write`] from the sink, or where a name comes twice.
    pub fn add(&mut self, name: &str, bytes: &[u8]) -> Result<(), ExportError> {
        let options = SimpleFileOptions::default()
            .compression_method(CompressionMethod::Stored)
            .last_modified_time(DateTime::default());
        self.zip.start_file(name, options).map_err(io::Error::from)?;
        Ok(self.zip.write_all(bytes)?)
    }

    /// Writes the archive's table of contents and gives the flushed sink back.
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

/// A sink that can seek within what it has not passed on yet.
struct Window<W> {
    sink: W,
    /// Bytes that have gone to the sink.
    passed_on: u64,
    held: Vec<u8>,
    /// Where the next byte goes, in `held`; never past its end.
    at: usize,
}

impl<W: Write> Write for Window<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let over = bytes.len().min(self.held.len() - self.at);
        self.held[self.at..self.at + over].copy_from_slice(&bytes[..over]);
        self.held.extend_from_slice(&bytes[over..]);
        self.at += bytes.len();
        Ok(bytes.len())
    }

    /// Passes everything on. The archive asks for it when a file is complete.
    fn flush(&mut self) -> io::Result<()> {
        self.sink.write_all(&self.held)?;
        self.passed_on += self.held.len() as u64;
        self.held.clear();
        self.at = 0;
        Ok(())
    }
}

// The archive's type wants it, for archives that are gone on with.
impl<W> Read for Window<W> {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        let read = (&self.held[self.at..]).read(bytes)?;
        self.at += read;
        Ok(read)
    }
}

impl<W> Seek for Window<W> {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        let end = self.passed_on + self.held.len() as u64;
        let wanted = match to {
            SeekFrom::Start(place) => Some(place),
            SeekFrom::End(offset) => end.checked_add_signed(offset),
            SeekFrom::Current(offset) => {
                (self.passed_on + self.at as u64).checked_add_signed(offset)
            }
        };
        let place = wanted.filter(|place| (self.passed_on..=end).contains(place)).ok_or(
            io::Error::new(io::ErrorKind::Unsupported, "that part of the archive has gone out"),
        )?;
        // Within what is held, which is memory.
        self.at = (place - self.passed_on) as usize;
        Ok(place)
    }
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use super::*;

    /// Counts what it gets at once.
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
    fn files_come_out_as_they_went_in_and_leave_one_by_one() {
        let mut archive = Archive::new(Sink::default());
        for index in 0..20 {
            archive.add(&format!("f{index}"), &content(index)).unwrap();
        }
        let sink = archive.finish().unwrap();
        assert!(sink.largest < 12_000, "{} bytes were held", sink.largest);
        // Lengths and checksums ahead of the content: no bit 3 in any file's flags.
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
    fn a_sink_that_refuses_is_an_error() {
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
