//! Radiance RGBE pictures, as Greg Ward's "Real Pixels" (Graphics Gems II, 1991) describes them.
//!
//! A picture is read row by row: at any time one row is in memory.

use std::io::{Read, Seek};

use glam::Vec3;

use super::error::{DecodeError, checked_size, unreadable};
use crate::{reading::source::Source, scene::environment_map::downsample::Downsampler};

/// Most bytes of a header.
pub const MAX_HEADER_BYTES: usize = 64 << 10;

/// A pixel: three mantissas and their exponent.
type Rgbe = [u8; 4];

/// Reads the picture.
pub fn decode(file: &mut Source<impl Read + Seek>) -> Result<Downsampler, DecodeError> {
    let exposure = header(file)?;
    let [width, height] = size(&line(file)?)?;
    let mut row = vec![[0; 4]; width as usize];
    let mut downsampler = Downsampler::new([width, height]);
    for y in 0..height {
        read_row(file, &mut row)?;
        downsampler.add_row([0, y], row.iter().map(|pixel| radiance(*pixel) / exposure));
    }
    Ok(downsampler)
}

/// Reads the lines up to the empty one. Returns the factor by which the pixels are scaled.
fn header(file: &mut Source<impl Read + Seek>) -> Result<f32, DecodeError> {
    let mut exposure = 1.0;
    loop {
        let line = line(file)?;
        if line.is_empty() {
            return Ok(exposure);
        }
        if file.position() > MAX_HEADER_BYTES as u64 {
            let message = format!("the header has more than {MAX_HEADER_BYTES} bytes");
            return Err(unreadable(message));
        }
        // Each program that scaled the pixels added a line of its own.
        if let Some(factor) = line.strip_prefix("EXPOSURE=") {
            exposure *= factor.trim().parse().unwrap_or(f32::NAN);
            if !(exposure.is_normal() && exposure > 0.0) {
                return Err(unreadable(format!("EXPOSURE={factor} is no factor above 0")));
            }
        } else if let Some(format) = line.strip_prefix("FORMAT=")
            && format.trim() != "32-bit_rle_rgbe"
        {
            let message = format!(
                "FORMAT={format} cannot be read: save the picture as 32-bit_rle_rgbe (RGB colours)"
            );
            return Err(unreadable(message));
        }
    }
}

fn line(file: &mut Source<impl Read + Seek>) -> Result<String, DecodeError> {
    let bytes = file.until(b'\n', MAX_HEADER_BYTES, "the header")?;
    Ok(String::from_utf8_lossy(&bytes).trim_end_matches('\r').to_owned())
}

/// Width and height of the line `-Y HEIGHT +X WIDTH`.
fn size(line: &str) -> Result<[u32; 2], DecodeError> {
    let words: Vec<&str> = line.split_whitespace().take(5).collect();
    let [y, height, x, width] = words[..] else {
        return Err(unreadable(format!("\"{line}\" is no line -Y HEIGHT +X WIDTH")));
    };
    if (y, x) != ("-Y", "+X") {
        let message =
            format!("the rows of \"{line}\" do not go from top left: save the picture as -Y +X");
        return Err(unreadable(message));
    }
    let side = |text: &str| {
        text.parse::<u64>().map_err(|_| unreadable(format!("\"{text}\" is no number of pixels")))
    };
    checked_size([side(width)?, side(height)?])
}

/// Reads one row in any of the format's three packings.
fn read_row(file: &mut Source<impl Read + Seek>, row: &mut [Rgbe]) -> Result<(), DecodeError> {
    let first: Rgbe = file.array("the pixels")?;
    let width = row.len();
    if first[0] == 2 && first[1] == 2 && first[2] < 128 {
        let declared = usize::from(u16::from_be_bytes([first[2], first[3]]));
        if declared != width {
            return Err(unreadable(format!("a row has {declared} pixels instead of {width}")));
        }
        return (0..4).try_for_each(|channel| read_channel(file, row, channel));
    }
    read_old_row(file, row, first)
}

/// Reads one channel of a row: runs, and values as they are.
fn read_channel(
    file: &mut Source<impl Read + Seek>,
    row: &mut [Rgbe],
    channel: usize,
) -> Result<(), DecodeError> {
    let mut rest = row.iter_mut().map(|pixel| &mut pixel[channel]);
    while rest.len() > 0 {
        let [count] = file.array("the pixels")?;
        let is_run = count > 128;
        let count = usize::from(if is_run { count - 128 } else { count });
        if count == 0 || count > rest.len() {
            return Err(unreadable("a run of pixels does not fit its row"));
        }
        let mut values = [0; 128];
        if is_run {
            let [value] = file.array("the pixels")?;
            values.fill(value);
        } else {
            file.fill(&mut values[..count], "the pixels")?;
        }
        rest.by_ref().zip(&values[..count]).for_each(|(to, value)| *to = *value);
    }
    Ok(())
}

/// Reads a row of pixels as they are; a pixel of mantissas 1 repeats the one before.
fn read_old_row(
    file: &mut Source<impl Read + Seek>,
    row: &mut [Rgbe],
    first: Rgbe,
) -> Result<(), DecodeError> {
    let (mut x, mut shift, mut pixel) = (0, 0, first);
    loop {
        if pixel[..3] == [1, 1, 1] {
            // Counts of consecutive repetitions are the digits of one number, the lowest first.
            let count = usize::from(pixel[3]).checked_shl(shift);
            let count = count.filter(|count| *count <= row.len() - x && x > 0 && shift < 32);
            let Some(count) = count else {
                return Err(unreadable("a run of pixels does not fit its row"));
            };
            let repeated = row[x - 1];
            row[x..x + count].fill(repeated);
            x += count;
            shift += 8;
        } else {
            row[x] = pixel;
            x += 1;
            shift = 0;
        }
        if x == row.len() {
            return Ok(());
        }
        pixel = file.array("the pixels")?;
    }
}

/// The colour of a pixel: mantissa / 256 · 2^(exponent − 128).
fn radiance([red, green, blue, exponent]: Rgbe) -> Vec3 {
    if exponent == 0 {
        return Vec3::ZERO;
    }
    let scale = 2.0_f64.powi(i32::from(exponent) - 136) as f32;
    Vec3::new(red.into(), green.into(), blue.into()) * scale
}
