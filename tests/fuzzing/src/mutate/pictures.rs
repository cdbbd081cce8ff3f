//! Changes of the parts of PNG, JPEG and WebP; lengths and checksums stay right.

use fastrand::Rng;

use super::{bytes, index, json, reordered};

/// A part of a file: its name, and its content.
type Part = (Vec<u8>, Vec<u8>);

/// Changes one to three parts.
fn changed(rng: &mut Rng, parts: &mut Vec<Part>, others: &[Part]) {
    for _ in 0..rng.usize(1..=3) {
        if rng.u8(..3) == 0 && !reordered(rng, parts, others) {
            continue;
        }
        if parts.is_empty() {
            return;
        }
        let at = index(rng, parts.len());
        let other = others.get(index(rng, others.len())).map_or(&[][..], |part| &part.1);
        let (name, content) = &mut parts[at];
        match content.iter().position(|&byte| byte == b'{') {
            // The scene's document, after a name.
            Some(start) if rng.u8(..4) > 0 => {
                let end = content.iter().rposition(|&byte| byte == b'}').unwrap_or(start) + 1;
                let range = start.min(end)..end;
                let donor =
                    other.iter().position(|&byte| byte == b'{').map_or(&[][..], |i| &other[i..]);
                let new = json::mutated(rng, &content[range.clone()], donor);
                content.splice(range, new);
            }
            _ if rng.u8(..8) == 0 => *name = bytes::mutated(rng, name, &[]),
            _ => *content = bytes::mutated(rng, content, other),
        }
    }
}

/// Chunks: length, name, content, checksum.
pub fn png(rng: &mut Rng, input: &[u8], other: &[u8]) -> Vec<u8> {
    const SIGNATURE: &[u8] = b"\x89PNG\r\n\x1a\n";
    let parts = |file: &[u8]| {
        let (mut parts, mut rest) = (Vec::<Part>::new(), file.get(8..).unwrap_or_default());
        while let Some((size, after)) = rest.split_first_chunk::<4>() {
            let size = u32::from_be_bytes(*size) as usize;
            let Some((name, after)) = after.split_at_checked(4) else { break };
            let Some((content, after)) = after.split_at_checked(size) else { break };
            parts.push((name.to_vec(), content.to_vec()));
            rest = after.get(4..).unwrap_or_default();
        }
        parts
    };
    let (mut list, others) = (parts(input), parts(other));
    changed(rng, &mut list, &others);
    let mut file = SIGNATURE.to_vec();
    for (mut name, content) in list {
        name.resize(4, b'a');
        file.extend((content.len() as u32).to_be_bytes());
        let start = file.len();
        file.extend([name, content].concat());
        let sum = crc32fast::hash(&file[start..]);
        file.extend(sum.to_be_bytes());
    }
    file
}

/// Segments: marker, length, content; the pixels are the content of the last.
pub fn jpeg(rng: &mut Rng, input: &[u8], other: &[u8]) -> Vec<u8> {
    let parts = |file: &[u8]| {
        let (mut parts, mut rest) = (Vec::<Part>::new(), file.get(2..).unwrap_or_default());
        while let [0xff, kind, high, low, after @ ..] = rest {
            let size = usize::from(u16::from_be_bytes([*high, *low])).saturating_sub(2);
            let Some((content, after)) = after.split_at_checked(size) else { break };
            parts.push((vec![0xff, *kind], content.to_vec()));
            rest = after;
            if *kind == 0xda {
                break;
            }
        }
        (parts, rest.to_vec())
    };
    let ((mut list, pixels), (others, _)) = (parts(input), parts(other));
    changed(rng, &mut list, &others);
    let mut file = vec![0xff, 0xd8];
    for (name, mut content) in list {
        content.truncate(65_533);
        file.extend(name);
        file.extend((content.len() as u16 + 2).to_be_bytes());
        file.extend(content);
    }
    file.extend(pixels);
    file
}

/// Chunks: name, length, content, padding.
pub fn webp(rng: &mut Rng, input: &[u8], other: &[u8]) -> Vec<u8> {
    let parts = |file: &[u8]| {
        let (mut parts, mut rest) = (Vec::<Part>::new(), file.get(12..).unwrap_or_default());
        while let Some((name, after)) = rest.split_first_chunk::<4>() {
            let Some((size, after)) = after.split_first_chunk::<4>() else { break };
            let size = u32::from_le_bytes(*size) as usize;
            let Some((content, after)) = after.split_at_checked(size) else { break };
            parts.push((name.to_vec(), content.to_vec()));
            rest = after.get(size % 2..).unwrap_or_default();
        }
        parts
    };
    let (mut list, others) = (parts(input), parts(other));
    changed(rng, &mut list, &others);
    let mut file = b"WEBP".to_vec();
    for (mut name, content) in list {
        name.resize(4, b'a');
        file.extend(name);
        file.extend((content.len() as u32).to_le_bytes());
        file.extend(&content);
        file.extend(&[0][..content.len() % 2]);
    }
    [b"RIFF", &(file.len() as u32).to_le_bytes()[..], &file].concat()
}
