//! Changes of any bytes.

use fastrand::Rng;

use super::{few, index, range};

/// Whole numbers at which sizes and signs turn over.
const NUMBERS: [u64; 16] = [
    0,
    1,
    7,
    0x7f,
    0x80,
    0xff,
    0x7fff,
    0x8000,
    0xffff,
    0x1_0000,
    0x7fff_ffff,
    0x8000_0000,
    0xffff_ffff,
    0x1_0000_0000,
    1 << 62,
    u64::MAX,
];

/// `input` with one to four changes.
pub fn mutated(rng: &mut Rng, input: &[u8], other: &[u8]) -> Vec<u8> {
    let mut bytes = input.to_vec();
    for _ in 0..few(rng) {
        change(rng, &mut bytes, other);
    }
    bytes
}

fn change(rng: &mut Rng, bytes: &mut Vec<u8>, other: &[u8]) {
    if bytes.is_empty() {
        bytes.extend_from_slice(other);
        return;
    }
    let at = index(rng, bytes.len());
    match rng.u8(..9) {
        0 => bytes[at] ^= 1 << rng.u8(..8),
        1 => bytes[at] = rng.u8(..),
        2 => number(rng, &mut bytes[at..]),
        3 => {
            let new: Vec<u8> = (0..rng.usize(1..12)).map(|_| rng.u8(..)).collect();
            bytes.splice(at..at, new);
        }
        4 => {
            bytes.drain(range(rng, bytes.len()));
        }
        5 => {
            let part = bytes[range(rng, bytes.len())].to_vec();
            bytes.splice(at..at, part);
        }
        6 => {
            let part = other[range(rng, other.len())].to_vec();
            bytes.splice(at..at, part);
        }
        7 => {
            let part = &other[range(rng, other.len())];
            let count = part.len().min(bytes.len() - at);
            bytes[at..at + count].copy_from_slice(&part[..count]);
        }
        _ => bytes.truncate(at),
    }
}

/// Writes a number over the first bytes, in either order.
fn number(rng: &mut Rng, bytes: &mut [u8]) {
    let number = NUMBERS[index(rng, NUMBERS.len())];
    let size = [1, 2, 4, 8][index(rng, 4)].min(bytes.len());
    let little = number.to_le_bytes();
    let target = &mut bytes[..size];
    target.copy_from_slice(&little[..size]);
    if rng.bool() {
        target.reverse();
    }
}
