//! Changes of the parts of OpenEXR and Radiance pictures; offsets stay right.

use fastrand::Rng;

use super::{bytes, index, reordered, words};

/// An attribute: its name and type, each with its end, and its value.
type Attribute = (Vec<u8>, Vec<u8>);

/// Bytes of the signature and the version.
const START_BYTES: usize = 8;

/// Changes attributes, the table of offsets or blocks.
pub fn openexr(rng: &mut Rng, input: &[u8], other: &[u8]) -> Vec<u8> {
    let (Some((mut list, end)), Some((others, other_end))) = (attributes(input), attributes(other))
    else {
        return bytes::mutated(rng, input, other);
    };
    let (start, rest) = (input[..START_BYTES].to_vec(), &input[end..]);
    if rng.u8(..3) > 0 {
        let rest = bytes::mutated(rng, rest, &other[other_end..]);
        return [&input[..end], &rest].concat();
    }
    for _ in 0..rng.usize(1..=2) {
        if rng.u8(..3) == 0 && !reordered(rng, &mut list, &others) {
            continue;
        }
        if !list.is_empty() {
            let at = index(rng, list.len());
            let donor = others.get(index(rng, others.len())).map_or(&[][..], |other| &other.1);
            list[at].1 = bytes::mutated(rng, &list[at].1, donor);
        }
    }
    let mut file = start;
    for (name, value) in list {
        file.extend(name);
        file.extend((value.len() as u32).to_le_bytes());
        file.extend(value);
    }
    file.push(0);
    let moved = file.len().wrapping_sub(end) as u64;
    let mut rest = rest.to_vec();
    // The table: what could be a position after it, in order.
    let mut last = end as u64;
    for entry in rest.as_chunks_mut::<8>().0 {
        let offset = u64::from_le_bytes(*entry);
        if offset < last || offset >= input.len() as u64 {
            break;
        }
        last = offset;
        *entry = offset.wrapping_add(moved).to_le_bytes();
    }
    file.extend(rest);
    file
}

/// The attributes of a file's first header, and the position after the header.
fn attributes(file: &[u8]) -> Option<(Vec<Attribute>, usize)> {
    let mut list = Vec::new();
    let mut at = START_BYTES;
    while *file.get(at)? != 0 {
        let text_end =
            |from: usize| Some(from + file.get(from..)?.iter().position(|&b| b == 0)? + 1);
        let name_end = text_end(text_end(at)?)?;
        let size = u32::from_le_bytes(*file.get(name_end..)?.first_chunk()?) as usize;
        let value = file.get(name_end + 4..)?.get(..size)?;
        list.push((file[at..name_end].to_vec(), value.to_vec()));
        at = name_end + 4 + size;
    }
    Some((list, at + 1))
}

/// Changes the words of the header, or the pixels.
pub fn radiance(rng: &mut Rng, input: &[u8], other: &[u8]) -> Vec<u8> {
    // The header ends with the line of the size, which follows an empty line.
    let end = |file: &[u8]| {
        let empty = file.windows(2).position(|pair| pair == b"\n\n")? + 2;
        Some(empty + file[empty..].iter().position(|&byte| byte == b'\n')? + 1)
    };
    let (Some(at), Some(other_at)) = (end(input), end(other)) else {
        return bytes::mutated(rng, input, other);
    };
    let ((header, pixels), (other_header, other_pixels)) =
        (input.split_at(at), other.split_at(other_at));
    if rng.u8(..3) == 0 {
        [&words::mutated(rng, header, other_header), pixels].concat()
    } else {
        [header, &bytes::mutated(rng, pixels, other_pixels)].concat()
    }
}
