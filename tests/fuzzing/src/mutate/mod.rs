//! Changes of bytes that keep the form of a format, so that they reach what is behind its checksums.
//!
//! In: an input, a second one to take parts of, and random numbers. Out: another input, of at most
//! [`MAX_INPUT_BYTES`].
//!
//! | file | contents |
//! |---|---|
//! | `bytes` | any bytes |
//! | `words` | texts, word by word |
//! | `json` | JSON documents, value by value |
//! | `pictures` | the parts of PNG, JPEG and WebP |
//! | `environments` | the parts of OpenEXR and Radiance |

mod bytes;
mod environments;
mod json;
mod pictures;
mod words;

use base64::{Engine, engine::general_purpose::URL_SAFE_NO_PAD};
use fastrand::Rng;
use miniz_oxide::{deflate::compress_to_vec, inflate::decompress_to_vec_with_limit};

use crate::MAX_INPUT_BYTES;

/// The format that changes keep.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InputFormat {
    /// Words, numbers and lines.
    Words,
    /// Lines, each an argument.
    Arguments,
    /// JSON values.
    Json,
    /// Deflated JSON as base64.
    Link,
    /// Chunks with their checksums.
    Png,
    /// Segments with their lengths.
    Jpeg,
    /// Chunks with their lengths.
    WebP,
    /// Attributes, offsets and blocks.
    OpenExr,
    /// Lines, then bytes.
    Radiance,
}

/// `input` with a few changes, perhaps with parts of `other`; one in eight keeps no form.
pub fn mutated(format: InputFormat, rng: &mut Rng, input: &[u8], other: &[u8]) -> Vec<u8> {
    let mut changed = if rng.u8(..8) == 0 {
        bytes::mutated(rng, input, other)
    } else {
        match format {
            InputFormat::Words => words::mutated(rng, input, other),
            InputFormat::Arguments => arguments(rng, input, other),
            InputFormat::Json => json::mutated(rng, input, other),
            InputFormat::Link => link(rng, input, other),
            InputFormat::Png => pictures::png(rng, input, other),
            InputFormat::Jpeg => pictures::jpeg(rng, input, other),
            InputFormat::WebP => pictures::webp(rng, input, other),
            InputFormat::OpenExr => environments::openexr(rng, input, other),
            InputFormat::Radiance => environments::radiance(rng, input, other),
        }
    };
    changed.truncate(MAX_INPUT_BYTES);
    changed
}

/// Arguments in another order, more or fewer, or with a word changed.
fn arguments(rng: &mut Rng, input: &[u8], other: &[u8]) -> Vec<u8> {
    if rng.bool() {
        return words::mutated(rng, input, other);
    }
    let lines = |text: &'_ [u8]| text.split(|byte| *byte == b'\n').map(<[u8]>::to_vec).collect();
    let (mut list, others): (Vec<Vec<u8>>, Vec<_>) = (lines(input), lines(other));
    for _ in 0..few(rng) {
        reordered(rng, &mut list, &others);
    }
    list.join(&b'\n')
}

/// A link whose JSON is changed.
fn link(rng: &mut Rng, input: &[u8], other: &[u8]) -> Vec<u8> {
    let json = |link: &[u8]| {
        let at = link.iter().position(|&byte| byte == b'=')?;
        let deflated = URL_SAFE_NO_PAD.decode(&link[at + 1..]).ok()?;
        let json = decompress_to_vec_with_limit(&deflated, MAX_INPUT_BYTES).ok()?;
        Some((link[..=at].to_vec(), json))
    };
    let (Some((prefix, first)), Some((_, second))) = (json(input), json(other)) else {
        return bytes::mutated(rng, input, other);
    };
    let changed = json::mutated(rng, &first, &second);
    // Low levels are fast, and the reader does not see them.
    let deflated = compress_to_vec(&changed, 1);
    [prefix, URL_SAFE_NO_PAD.encode(deflated).into_bytes()].concat()
}

/// How many changes: mostly one, which is easier to accept.
fn few(rng: &mut Rng) -> usize {
    if rng.bool() { 1 } else { rng.usize(1..=4) }
}

/// An index below `len`, which is above 0.
fn index(rng: &mut Rng, len: usize) -> usize {
    rng.usize(..len.max(1))
}

/// A part of `length`: its start and end.
fn range(rng: &mut Rng, length: usize) -> std::ops::Range<usize> {
    let start = rng.usize(..=length);
    // Most parts are short.
    let longest = if rng.u8(..4) == 0 { length } else { 16 };
    start..(start + rng.usize(..=longest)).min(length)
}

/// Changes the order, number or place of entries of a list; true if nothing was changed.
fn reordered<T: Clone>(rng: &mut Rng, list: &mut Vec<T>, other: &[T]) -> bool {
    match rng.u8(..6) {
        _ if list.is_empty() => return true,
        0 => {
            list.remove(index(rng, list.len()));
        }
        1 => {
            let (from, to) = (index(rng, list.len()), index(rng, list.len()));
            let entry = list[from].clone();
            let count = if rng.u8(..8) == 0 { rng.usize(..80) } else { 1 };
            list.splice(to..to, std::iter::repeat_n(entry, count));
        }
        2 => {
            let (a, b) = (index(rng, list.len()), index(rng, list.len()));
            list.swap(a, b);
        }
        3 if !other.is_empty() => {
            let at = index(rng, list.len());
            list.insert(at, other[index(rng, other.len())].clone());
        }
        4 if !other.is_empty() => {
            let at = index(rng, list.len());
            list[at] = other[index(rng, other.len())].clone();
        }
        _ => return true,
    }
    false
}
