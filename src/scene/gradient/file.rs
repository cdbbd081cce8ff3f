//! Gradient files of other programs.
//!
//! | ending | program | contents |
//! |---|---|---|
//! | `.ggr` | GIMP | one gradient of segments, each with its blend |
//! | `.gpl` | GIMP, Inkscape | a list of colours |
//! | `.map` | Fractint | up to 256 colours |
//! | `.ugr` | Ultra Fractal | gradients of control points at 0 to 399 |
//!
//! The contents decide, not the file's name. Colours are sRGB.

use super::{fit::fit, named::NamedGradient};
use crate::scene::color::{Hsv, hsv_from_srgb, srgb_from_hsv};

/// The endings of files that may have gradients.
pub const ENDINGS: [&str; 4] = ["ggr", "gpl", "map", "ugr"];

/// Largest file, in bytes.
pub const MAX_FILE_BYTES: usize = 4 << 20;
/// Most gradients that are read of one file.
const MAX_GRADIENTS: usize = 1000;
/// Most segments of a GIMP gradient.
const MAX_SEGMENTS: usize = 1000;
/// Most colours of a GIMP palette.
const MAX_COLORS: usize = 4096;
/// Number of samples of a segment of a GIMP gradient.
const SEGMENT_SAMPLES: u32 = 32;
/// Number of places in an Ultra Fractal gradient.
const ULTRA_PLACES: u32 = 400;

/// A file that is no gradient.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum GradientFileError {
    /// The file is too large.
    #[error("the file has {0} bytes; gradient files have at most {MAX_FILE_BYTES}")]
    TooLarge(usize),
    /// The file has no colours.
    #[error("no gradient found; .ggr, .gpl, .map and .ugr files can be read")]
    Unknown,
    /// A line cannot be read.
    #[error("line {line}: {message}")]
    Line {
        /// The line, from 1.
        line: usize,
        /// What is wrong.
        message: String,
    },
}

/// The gradients of a file, at least one. `name` is for gradients that the file does not name.
///
/// # Errors
///
/// The first line that cannot be read, or that the file has no gradient.
pub fn read(bytes: &[u8], name: &str) -> Result<Vec<NamedGradient>, GradientFileError> {
    if bytes.len() > MAX_FILE_BYTES {
        return Err(GradientFileError::TooLarge(bytes.len()));
    }
    let text = String::from_utf8_lossy(bytes);
    let text = text.trim_start_matches('\u{feff}');
    let found = match text.lines().next().map(str::trim) {
        Some("GIMP Gradient") => vec![segments(text, name)?],
        Some("GIMP Palette") => vec![palette(text, name)?],
        _ if text.contains("gradient:") => control_points(text)?,
        _ => vec![colors(text, name)?],
    };
    if found.is_empty() { Err(GradientFileError::Unknown) } else { Ok(found) }
}

fn at_line(index: usize, message: impl Into<String>) -> GradientFileError {
    GradientFileError::Line { line: index + 1, message: message.into() }
}

/// The numbers at the start of a line.
fn leading_numbers(line: &str) -> Vec<f64> {
    line.split([' ', '\t', ',', ';']).filter(|word| !word.is_empty()).map_while(number).collect()
}

fn number(word: &str) -> Option<f64> {
    word.parse().ok().filter(|number: &f64| number.is_finite())
}

/// An sRGB colour of three numbers from 0 to `most`.
fn color(numbers: &[f64], most: f64) -> Option<[f32; 3]> {
    let rgb = numbers.first_chunk::<3>()?;
    let is_valid = rgb.iter().all(|channel| (0.0..=most).contains(channel));
    is_valid.then(|| rgb.map(|channel| (channel / most) as f32))
}

/// Evenly spaced colours that blend from the last to the first.
fn evenly(name: &str, colors: &[[f32; 3]]) -> Result<NamedGradient, GradientFileError> {
    if colors.is_empty() {
        return Err(GradientFileError::Unknown);
    }
    let count = colors.len() as f64;
    let samples: Vec<_> = (0..).zip(colors).map(|(i, &c)| (f64::from(i) / count, c)).collect();
    Ok(NamedGradient { name: name.to_owned(), stops: fit(&samples) })
}

/// A Fractint map: a line per colour, three numbers from 0 to 255 and perhaps a comment.
fn colors(text: &str, name: &str) -> Result<NamedGradient, GradientFileError> {
    let mut colors = Vec::new();
    for (index, line) in text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty()) {
        match color(&leading_numbers(line), 255.0) {
            Some(rgb) => colors.push(rgb),
            // Another kind of file has no colour in its first line.
            None if colors.is_empty() => return Err(GradientFileError::Unknown),
            None => return Err(at_line(index, "expected three numbers from 0 to 255")),
        }
        if colors.len() > 256 {
            return Err(at_line(index, "a colour map has at most 256 colours"));
        }
    }
    evenly(name, &colors)
}

/// A GIMP palette.
fn palette(text: &str, name: &str) -> Result<NamedGradient, GradientFileError> {
    let (mut name, mut colors) = (name.to_owned(), Vec::new());
    for (index, line) in text.lines().enumerate().skip(1) {
        let line = line.trim();
        if let Some(own) = line.strip_prefix("Name:") {
            name = own.trim().to_owned();
        } else if !(line.is_empty() || line.starts_with('#') || line.starts_with("Columns:")) {
            let rgb = color(&leading_numbers(line), 255.0);
            colors.push(rgb.ok_or_else(|| at_line(index, "expected three numbers from 0 to 255"))?);
            if colors.len() > MAX_COLORS {
                return Err(at_line(index, format!("a palette has at most {MAX_COLORS} colours")));
            }
        }
    }
    evenly(&name, &colors)
}

/// A GIMP gradient: a line per segment.
fn segments(text: &str, name: &str) -> Result<NamedGradient, GradientFileError> {
    let mut name = name.to_owned();
    let mut samples = Vec::new();
    let mut is_counted = false;
    for (index, line) in text.lines().enumerate().skip(1) {
        let line = line.trim();
        if let Some(own) = line.strip_prefix("Name:") {
            name = own.trim().to_owned();
        } else if line.is_empty() || line.starts_with('#') {
        } else if !is_counted {
            is_counted = true;
        } else {
            let segment = Segment::read(&leading_numbers(line)).ok_or_else(|| {
                at_line(index, "expected a segment: three positions, two colours, a blend")
            })?;
            if samples.last().is_some_and(|&(before, _)| segment.left < before) {
                return Err(at_line(index, "the segment begins before the one above ends"));
            }
            if samples.len() >= MAX_SEGMENTS * (SEGMENT_SAMPLES as usize + 1) {
                let message = format!("a gradient has at most {MAX_SEGMENTS} segments");
                return Err(at_line(index, message));
            }
            samples.extend((0..=SEGMENT_SAMPLES).map(|i| segment.sample(i)));
        }
    }
    if samples.is_empty() {
        return Err(GradientFileError::Unknown);
    }
    Ok(NamedGradient { name, stops: fit(&samples) })
}

/// A segment of a GIMP gradient.
struct Segment {
    left: f64,
    middle: f64,
    right: f64,
    from: [f32; 3],
    to: [f32; 3],
    /// 0 linear, 1 curved, 2 sine, 3 and 4 spherical, 5 a step.
    blend: u32,
    /// 0 RGB, 1 and 2 around the hues.
    coloring: u32,
}

impl Segment {
    fn read(numbers: &[f64]) -> Option<Self> {
        let &[left, middle, right, ..] = numbers else { return None };
        let is_ordered = 0.0 <= left && left <= middle && middle <= right && right <= 1.0;
        let kind = |place: usize| numbers.get(place).map_or(0, |&kind| kind as u32);
        let (from, to) = (color(numbers.get(3..)?, 1.0)?, color(numbers.get(7..)?, 1.0)?);
        is_ordered.then_some(Self {
            left,
            middle,
            right,
            from,
            to,
            blend: kind(11),
            coloring: kind(12),
        })
    }

    /// Position and colour of sample `i` of [`SEGMENT_SAMPLES`].
    fn sample(&self, i: u32) -> (f64, [f32; 3]) {
        let place = f64::from(i) / f64::from(SEGMENT_SAMPLES);
        let width = self.right - self.left;
        let middle = if width > 0.0 { (self.middle - self.left) / width } else { 0.5 };
        let part = blended(self.blend, place, middle) as f32;
        let color = match self.coloring {
            0 => std::array::from_fn(|k| self.from[k] + part * (self.to[k] - self.from[k])),
            around => around_hues(self.from, self.to, part, around == 1),
        };
        // Up to rounding, the last sample would lie beyond the end, where the next segment begins.
        ((self.left + place * width).min(self.right), color)
    }
}

/// The part of the right colour at `place`, where `middle` has half of each.
fn blended(kind: u32, place: f64, middle: f64) -> f64 {
    use std::f64::consts::{FRAC_PI_2, LN_2, PI};
    let linear = if place <= middle {
        if middle > 0.0 { 0.5 * place / middle } else { 0.0 }
    } else {
        0.5 + 0.5 * (place - middle) / (1.0 - middle)
    };
    match kind {
        1 => place.powf(LN_2 / -middle.clamp(1e-6, 1.0 - 1e-6).ln()),
        2 => 0.5 + 0.5 * (PI * linear - FRAC_PI_2).sin(),
        3 => (1.0 - (linear - 1.0).powi(2)).sqrt(),
        4 => 1.0 - (1.0 - linear * linear).sqrt(),
        5 => f64::from(u8::from(place >= middle)),
        _ => linear,
    }
}

/// Between two colours by hue, saturation and value; `ccw` is toward greater hues.
fn around_hues(from: [f32; 3], to: [f32; 3], part: f32, ccw: bool) -> [f32; 3] {
    let (from, mut to) = (hsv_from_srgb(from), hsv_from_srgb(to));
    if ccw && to.h < from.h {
        to.h += 1.0;
    } else if !ccw && to.h > from.h {
        to.h -= 1.0;
    }
    let mix = |a: f32, b: f32| a + part * (b - a);
    srgb_from_hsv(Hsv { h: mix(from.h, to.h), s: mix(from.s, to.s), v: mix(from.v, to.v) })
}

/// Ultra Fractal's gradients: `name { gradient: … index=0 color=255 … }`.
fn control_points(text: &str) -> Result<Vec<NamedGradient>, GradientFileError> {
    let mut found = Vec::new();
    let (mut name, mut points, mut is_gradient) = (String::new(), Vec::new(), false);
    for (index, line) in text.lines().enumerate() {
        let line = line.split(';').next().unwrap_or_default().trim();
        if let Some(title) = line.strip_suffix('{') {
            (name, points, is_gradient) = (title.trim().to_owned(), Vec::new(), false);
        } else if line.starts_with('}') {
            if !points.is_empty() && found.len() < MAX_GRADIENTS {
                found.push(ultra_gradient(&name, &mut points));
            }
            points = Vec::new();
        } else if let Some(section) = line.strip_suffix(':') {
            is_gradient = section == "gradient";
        } else if is_gradient {
            let mut place = None;
            for word in line.split_whitespace() {
                if let Some(value) = word.strip_prefix("index=") {
                    let value = value
                        .parse::<i32>()
                        .map_err(|_| at_line(index, "expected a number after index="))?;
                    place = Some(value.rem_euclid(ULTRA_PLACES as i32));
                } else if let Some(value) = word.strip_prefix("color=") {
                    let color = value
                        .parse::<u32>()
                        .map_err(|_| at_line(index, "expected a number after color="))?;
                    // The lowest byte is red.
                    let [r, g, b, _] = color.to_le_bytes();
                    let rgb = [r, g, b].map(|channel| f32::from(channel) / 255.0);
                    points.extend(place.take().map(|place| (place, rgb)));
                }
            }
        }
    }
    Ok(found)
}

/// Control points in order, with samples of the straight lines between them.
fn ultra_gradient(name: &str, points: &mut [(i32, [f32; 3])]) -> NamedGradient {
    points.sort_by_key(|point| point.0);
    let places = ULTRA_PLACES as i32;
    let mut samples = Vec::new();
    for place in 0..places {
        let next = points.partition_point(|point| point.0 <= place);
        let count = points.len();
        let (before, after) = (points[(next + count - 1) % count], points[next % count]);
        let span = (after.0 - before.0).rem_euclid(places).max(1) as f32;
        let part = (place - before.0).rem_euclid(places) as f32 / span;
        let part = if count == 1 { 0.0 } else { part };
        let color = std::array::from_fn(|k| before.1[k] + part * (after.1[k] - before.1[k]));
        samples.push((f64::from(place) / f64::from(places), color));
    }
    NamedGradient { name: name.to_owned(), stops: fit(&samples) }
}

#[cfg(test)]
mod tests;
