//! Colour arithmetic: the sRGB transfer curve, and the gradient that colours the surface.
//!
//! Inputs and outputs are linear Rec. 709 channels, unless a name says sRGB.

use glam::DVec3;

use super::surface::GradientStop;

/// Number of entries in a gradient's lookup table.
pub const GRADIENT_ENTRIES: usize = 256;

/// Linear value of an sRGB-encoded channel (IEC 61966-2-1); both clamped to 0 to 1.
pub fn linear_from_srgb(encoded: f32) -> f32 {
    let encoded = encoded.clamp(0.0, 1.0);
    if encoded <= 0.04045 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
}

/// The same, rounded so that documents and links stay short.
pub fn short_linear_from_srgb(encoded: f32) -> f32 {
    // A fifth of the darkest sRGB level of 255.
    const DECIMALS: f32 = 1e4;
    (linear_from_srgb(encoded) * DECIMALS).round() / DECIMALS
}

/// The sRGB encoding of a linear channel (IEC 61966-2-1); both clamped to 0 to 1.
pub fn srgb_from_linear(linear: f32) -> f32 {
    let linear = linear.clamp(0.0, 1.0);
    if linear <= 0.003_130_8 { linear * 12.92 } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

/// A colour by hue, saturation and value, each 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hsv {
    /// 0 red, 1/3 green, 2/3 blue.
    pub h: f32,
    /// Saturation.
    pub s: f32,
    /// Value: the largest sRGB channel.
    pub v: f32,
}

/// The sRGB channels of an HSV colour.
pub fn srgb_from_hsv(Hsv { h, s, v }: Hsv) -> [f32; 3] {
    let channel = |offset: f32| {
        let k = (offset + h * 6.0).rem_euclid(6.0);
        v - v * s * k.min(4.0 - k).clamp(0.0, 1.0)
    };
    [channel(5.0), channel(3.0), channel(1.0)]
}

/// The HSV colour of sRGB channels; greys have hue 0.
pub fn hsv_from_srgb([r, g, b]: [f32; 3]) -> Hsv {
    let v = r.max(g).max(b);
    let span = v - r.min(g).min(b);
    let sector = if span <= 0.0 {
        0.0
    } else if v == r {
        (g - b) / span
    } else if v == g {
        2.0 + (b - r) / span
    } else {
        4.0 + (r - g) / span
    };
    Hsv { h: (sector / 6.0).rem_euclid(1.0), s: if v > 0.0 { span / v } else { 0.0 }, v }
}

/// The luminance of a linear colour (Rec. 709).
pub fn luminance(color: DVec3) -> f64 {
    color.dot(DVec3::new(0.2126, 0.7152, 0.0722))
}

/// The gradient's linear colour at `fract(u)`.
///
/// The colour is interpolated in linear light between stops, and from the last stop to the
/// first across the wrap. Two stops at one position make a hard edge: the later one starts
/// there. Without stops the gradient is black.
pub fn gradient_at(stops: &[GradientStop], u: f64) -> [f32; 3] {
    let (Some(first), Some(last)) = (stops.first(), stops.last()) else {
        return [0.0; 3];
    };
    let u = if u.is_finite() { u.rem_euclid(1.0) } else { 0.0 };
    let next = stops.partition_point(|stop| stop.position <= u);
    // The stops on both sides of u; a pair that spans the wrap has one stop shifted by 1.
    let (before, before_at) = match next {
        0 => (last, last.position - 1.0),
        _ => (&stops[next - 1], stops[next - 1].position),
    };
    let (after, after_at) = match stops.get(next) {
        Some(stop) => (stop, stop.position),
        None => (first, first.position + 1.0),
    };
    let span = after_at - before_at;
    let t = if span > 0.0 { ((u - before_at) / span).clamp(0.0, 1.0) as f32 } else { 0.0 };
    std::array::from_fn(|i| before.color[i] + (after.color[i] - before.color[i]) * t)
}

/// The gradient as a cyclic lookup table of linear RGBA, opaque.
///
/// Entry `i` is the colour at `u = i / 256`. Readers interpolate between neighbours; the last
/// entry's neighbour is the first.
pub fn gradient_lut(stops: &[GradientStop]) -> [[f32; 4]; GRADIENT_ENTRIES] {
    std::array::from_fn(|i| {
        let [r, g, b] = gradient_at(stops, i as f64 / GRADIENT_ENTRIES as f64);
        [r, g, b, 1.0]
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const RED: [f32; 3] = [1.0, 0.0, 0.0];
    const BLUE: [f32; 3] = [0.0, 0.0, 1.0];

    fn stops(list: &[(f64, [f32; 3])]) -> Vec<GradientStop> {
        list.iter().map(|&(position, color)| GradientStop { position, color }).collect()
    }

    #[test]
    fn srgb_matches_the_values_of_the_standard() {
        // 8-bit code values and their linear values, from the definition in exact arithmetic.
        for (code, linear) in [
            (0, 0.0),
            (1, 0.000_303_527),
            (10, 0.003_035_27),
            (11, 0.003_346_54),
            (128, 0.215_860_5),
            (188, 0.502_886_5),
            (255, 1.0),
        ] {
            let encoded = code as f32 / 255.0;
            assert!((linear_from_srgb(encoded) - linear).abs() < 1e-6, "{code}");
            assert!((srgb_from_linear(linear) - encoded).abs() < 2e-6, "{code}");
        }
        assert_eq!(srgb_from_linear(-1.0), 0.0);
        assert!((srgb_from_linear(7.0) - 1.0).abs() < 1e-6);
    }

    #[test]
    fn a_gradient_blends_between_stops_and_across_the_wrap() {
        let stops = stops(&[(0.2, RED), (0.6, BLUE)]);
        assert_eq!(gradient_at(&stops, 0.2), RED);
        assert_eq!(gradient_at(&stops, 0.6), BLUE);
        let near = |u: f64, red: f32| (gradient_at(&stops, u)[0] - red).abs() < 1e-6;
        // A quarter from red to blue, then half and five sixths of the way back to red.
        assert!(near(0.3, 0.75) && near(0.9, 0.5) && near(0.1, 5.0 / 6.0));
        assert!(near(7.3, 0.75) && near(-0.7, 0.75));
    }

    #[test]
    fn stops_at_one_position_make_a_hard_edge() {
        let stops = stops(&[(0.0, RED), (0.5, RED), (0.5, BLUE), (1.0, BLUE)]);
        assert_eq!(gradient_at(&stops, 0.499_999), RED);
        assert_eq!(gradient_at(&stops, 0.5), BLUE);
        assert_eq!(gradient_at(&stops, 0.999_999), BLUE);
    }

    #[test]
    fn empty_single_and_unsorted_gradients_give_a_valid_color() {
        assert_eq!(gradient_at(&[], 0.5), [0.0; 3]);
        assert_eq!(gradient_at(&stops(&[(0.7, BLUE)]), 0.1), BLUE);
        assert_eq!(gradient_at(&stops(&[(0.7, BLUE)]), f64::NAN), BLUE);
        for u in [0.0, 0.3, 0.99] {
            let disordered = gradient_at(&stops(&[(0.9, RED), (0.1, BLUE)]), u);
            assert!(disordered.iter().all(|c| (0.0..=1.0).contains(c)));
        }
    }

    #[test]
    fn the_lookup_table_samples_the_gradient() {
        let stops = stops(&[(0.0, RED), (0.5, BLUE)]);
        let lut = gradient_lut(&stops);
        assert_eq!(lut[0], [1.0, 0.0, 0.0, 1.0]);
        assert_eq!(lut[64], [0.5, 0.0, 0.5, 1.0]);
        assert_eq!(lut[128], [0.0, 0.0, 1.0, 1.0]);
    }
}
