//! Reading of a file's parts: its declared sizes are checked against its length first.

use std::{
    fmt,
    io::{self, Read, Seek, SeekFrom},
};

use super::visible;

/// Why a file cannot be read: truncated, damaged, or of a kind that is not read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct Unreadable(String);

impl Unreadable {
    /// The error of this message, which may quote the file at any length.
    pub fn new(message: impl fmt::Display) -> Self {
        const MAX_CHARS: usize = 300;
        let text: String = message.to_string().chars().take(MAX_CHARS).collect();
        Self(visible(&text).into_owned())
    }
}

/// A file, read from its start or from any position.
pub struct Source<R> {
    file: R,
    /// Length of the file, in bytes.
    length: u64,
    position: u64,
}

impl<R: Read + Seek> Source<R> {
    /// The source of `file`, whose position becomes 0.
    ///
    /// # Errors
    /// Those of a file that has no positions, such as a pipe.
    pub fn new(mut file: R) -> io::Result<Self> {
        let length = file.seek(SeekFrom::End(0))?;
        file.rewind()?;
        Ok(Self { file, length, position: 0 })
    }

    /// Length of the file, in bytes.
    pub fn length(&self) -> u64 {
        self.length
    }

    /// Position of the next byte.
    pub fn position(&self) -> u64 {
        self.position
    }

    /// Moves to `position`, which an error calls `what`.
    ///
    /// # Errors
    /// A position behind the end of the file.
    pub fn go_to(&mut self, position: u64, what: &str) -> Result<(), Unreadable> {
        if position > self.length {
            return Err(Unreadable::new(format!("{what} lies behind the end of the file")));
        }
        if position != self.position {
            self.file.seek(SeekFrom::Start(position)).map_err(Unreadable::new)?;
            self.position = position;
        }
        Ok(())
    }

    /// Reads `count` bytes. Nothing is allocated for bytes that the file does not have.
    ///
    /// # Errors
    /// A shorter file; the error calls the bytes `what`.
    pub fn bytes(&mut self, count: usize, what: &str) -> Result<Vec<u8>, Unreadable> {
        if count as u64 > self.length - self.position {
            return Err(Unreadable::new(format!("the file ends within {what}")));
        }
        let mut bytes = vec![0; count];
        self.fill(&mut bytes, what).map(|()| bytes)
    }

    /// Reads from here to the end, but at most `most` bytes.
    ///
    /// # Errors
    /// Those of reading the file.
    pub fn up_to(&mut self, most: usize, what: &str) -> Result<Vec<u8>, Unreadable> {
        let left = self.length - self.position;
        self.bytes(usize::try_from(left).map_or(most, |left| left.min(most)), what)
    }

    /// Reads as many bytes as `buffer` has.
    ///
    /// # Errors
    /// As [`Self::bytes`].
    pub fn fill(&mut self, buffer: &mut [u8], what: &str) -> Result<(), Unreadable> {
        let count = buffer.len() as u64;
        if count > self.length - self.position {
            return Err(Unreadable::new(format!("the file ends within {what}")));
        }
        self.file.read_exact(buffer).map_err(Unreadable::new)?;
        self.position += count;
        Ok(())
    }

    /// Reads an array of bytes.
    ///
    /// # Errors
    /// As [`Self::bytes`].
    pub fn array<const N: usize>(&mut self, what: &str) -> Result<[u8; N], Unreadable> {
        let mut bytes = [0; N];
        self.fill(&mut bytes, what).map(|()| bytes)
    }

    /// Reads a little-endian i32.
    ///
    /// # Errors
    /// As [`Self::bytes`].
    pub fn i32(&mut self, what: &str) -> Result<i32, Unreadable> {
        self.array(what).map(i32::from_le_bytes)
    }

    /// Reads the bytes up to `end`, which is read but not returned; at most `most` of them.
    ///
    /// # Errors
    /// As [`Self::bytes`]; and more than `most` bytes.
    pub fn until(&mut self, end: u8, most: usize, what: &str) -> Result<Vec<u8>, Unreadable> {
        let mut bytes = Vec::new();
        loop {
            match self.array(what)? {
                [byte] if byte == end => return Ok(bytes),
                _ if bytes.len() == most => {
                    return Err(Unreadable::new(format!("{what} has more than {most} bytes")));
                }
                [byte] => bytes.push(byte),
            }
        }
    }
}
