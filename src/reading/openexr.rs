//! The attributes of an OpenEXR file's headers, one after the other.
//!
//! In: a file. Out: names, types and positions of attributes; a value is read by who wants it.

use std::io::{Read, Seek};

use super::source::{Source, Unreadable};

/// The first bytes of an OpenEXR file.
pub const SIGNATURE: [u8; 4] = [0x76, 0x2f, 0x31, 0x01];
/// Most attributes of a file, those of all its parts together.
pub const MAX_ATTRIBUTES: usize = 1000;
/// Most parts of a file.
pub const MAX_PARTS: usize = 64;
/// Longest name in a header, in bytes; the format's own limit.
pub const MAX_NAME_BYTES: usize = 255;

/// A flag of the version field: one part, in tiles.
const TILED: u32 = 1 << 9;
/// A flag of the version field: names of more than 31 bytes.
const LONG_NAMES: u32 = 1 << 10;
/// A flag of the version field: a part with any number of samples per pixel.
const DEEP: u32 = 1 << 11;
/// A flag of the version field: many parts.
const MULTI_PART: u32 = 1 << 12;

/// An attribute of a header.
pub struct Attribute {
    /// Number of the part that it belongs to, from 0.
    pub part: usize,
    /// Its name.
    pub name: Vec<u8>,
    /// Bytes of its value, which follows.
    pub size: u64,
}

/// Reads headers.
pub struct Headers {
    /// Whether the file has many parts.
    pub is_multi_part: bool,
    /// Whether the one part of the file is in tiles.
    pub is_tiled: bool,
    part: usize,
    attributes: usize,
    /// Position after the value of the last attribute.
    next: u64,
}

impl Headers {
    /// Reads the signature and the version.
    ///
    /// # Errors
    /// Another format, or a version that is not known.
    pub fn new(file: &mut Source<impl Read + Seek>) -> Result<Self, Unreadable> {
        if file.array::<4>("the signature")? != SIGNATURE {
            return Err(Unreadable::new("this is no OpenEXR file"));
        }
        let version = u32::from_le_bytes(file.array("the version")?);
        let flags = version & !0xff;
        let is_known = flags & !(TILED | LONG_NAMES | DEEP | MULTI_PART) == 0;
        if !matches!(version & 0xff, 1 | 2) || !is_known {
            return Err(Unreadable::new(format!("the OpenEXR version {version:#x} is not known")));
        }
        Ok(Self {
            is_multi_part: flags & MULTI_PART != 0,
            is_tiled: flags & TILED != 0,
            part: 0,
            attributes: 0,
            next: file.position(),
        })
    }

    /// The next attribute, whose value is at the position of `file`. `None` after the last header.
    ///
    /// The position may be anywhere when the next attribute is asked for.
    ///
    /// # Errors
    /// A truncated header, or one beyond a limit, by name.
    pub fn next(
        &mut self,
        file: &mut Source<impl Read + Seek>,
    ) -> Result<Option<Attribute>, Unreadable> {
        file.go_to(self.next, "the end of an attribute")?;
        let mut name = file.until(0, MAX_NAME_BYTES, "an attribute's name")?;
        if name.is_empty() {
            if !self.is_multi_part {
                return Ok(None);
            }
            self.part += 1;
            // A second empty name ends the list of parts.
            name = file.until(0, MAX_NAME_BYTES, "an attribute's name")?;
            if name.is_empty() {
                return Ok(None);
            }
            if self.part == MAX_PARTS {
                let message =
                    format!("the file has more than {MAX_PARTS} parts, the most that are read");
                return Err(Unreadable::new(message));
            }
        }
        self.attributes += 1;
        if self.attributes > MAX_ATTRIBUTES {
            let message = format!(
                "the file has more than {MAX_ATTRIBUTES} attributes, the most that are read"
            );
            return Err(Unreadable::new(message));
        }
        file.until(0, MAX_NAME_BYTES, "an attribute's type")?;
        let size = u64::try_from(file.i32("an attribute")?)
            .map_err(|_| Unreadable::new("an attribute has no size"))?;
        self.next = file.position() + size;
        Ok(Some(Attribute { part: self.part, name, size }))
    }
}
