//! A procedural environment map: a dusk over water between hills.
//!
//! Out: an equirectangular map in Radiance's format. The upper edge is +z and the centre is +y, as
//! the renderer expects.

use std::f64::consts::{PI, TAU};

const WIDTH: usize = 2048;
const HEIGHT: usize = 1024;

/// The sun's position: left of the map's centre, slightly above the hills.
const SUN_AZIMUTH_RAD: f64 = -0.35;
const SUN_HEIGHT_RAD: f64 = 0.16;
const SUN_RADIUS_RAD: f64 = 0.02;

type Color = [f64; 3];

/// The map as a Radiance RGBE file, not run-length encoded.
pub fn radiance_file() -> Vec<u8> {
    let mut file = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n".to_vec();
    file.extend(format!("-Y {HEIGHT} +X {WIDTH}\n").bytes());
    for row in 0..HEIGHT {
        let height_rad = PI * (0.5 - (row as f64 + 0.5) / HEIGHT as f64);
        for column in 0..WIDTH {
            let azimuth_rad = TAU * ((column as f64 + 0.5) / WIDTH as f64 - 0.5);
            file.extend(rgbe(radiance(azimuth_rad, height_rad)));
        }
    }
    file
}

/// A colour with a shared exponent (Ward, *Real Pixels*, Graphics Gems II).
fn rgbe(color: Color) -> [u8; 4] {
    let largest = color.iter().copied().fold(0.0, f64::max);
    if largest < 1e-30 {
        return [0; 4];
    }
    let exponent = largest.log2().floor() as i32 + 1;
    let [r, g, b] = color.map(|channel| (channel * 256.0 / 2f64.powi(exponent)) as u8);
    [r, g, b, (exponent + 128) as u8]
}

/// Linear Rec. 709 radiance from a direction; the azimuth increases to the right of the centre.
fn radiance(azimuth_rad: f64, height_rad: f64) -> Color {
    for (layer, color) in
        [[0.012, 0.012, 0.02], [0.05, 0.036, 0.055], [0.15, 0.085, 0.1]].iter().enumerate()
    {
        if height_rad.abs() < ridge(azimuth_rad, layer) {
            let mirrored = if height_rad < 0.0 { 0.6 } else { 1.0 };
            return color.map(|channel| channel * mirrored);
        }
    }
    if height_rad >= 0.0 {
        return sky(azimuth_rad, height_rad);
    }
    // Water reflects the mirrored sky with ripples, and less at steeper viewing angles.
    let near = 1.0 / (0.02 - height_rad);
    let ripple = noise(azimuth_rad * 40.0 * (1.0 - height_rad), near * 14.0) - 0.5;
    let mirrored_rad = (-height_rad + 0.10 * ripple * (1.0 + height_rad / 2.0)).max(0.02);
    let reflectance = 0.12 + 0.6 * (1.0 + height_rad.sin()).powi(4);
    let [r, g, b] = sky(azimuth_rad, mirrored_rad);
    [r * reflectance + 0.002, g * reflectance + 0.006, b * reflectance + 0.01]
}

/// The height of a layer of hills above the horizon, radians; layer 0 is the nearest.
fn ridge(azimuth_rad: f64, layer: usize) -> f64 {
    let far = layer as f64;
    // Noise on a circle is continuous across azimuth ±π.
    let around = (azimuth_rad + far * 1.7).sin() * 0.5 + 0.5;
    let circle = [azimuth_rad.cos(), azimuth_rad.sin()].map(|side| 3.0 * (1.0 + far) * side + 9.0);
    let rough = clouds(circle[0], circle[1] + 30.0 * far);
    (0.015 + 0.02 * far) * (0.3 + around) + 0.11 * rough * rough * (0.5 + 0.5 * around)
}

fn sky(azimuth_rad: f64, height_rad: f64) -> Color {
    let direction = |azimuth: f64, height: f64| {
        [height.cos() * azimuth.sin(), height.cos() * azimuth.cos(), height.sin()]
    };
    let here = direction(azimuth_rad, height_rad);
    let sun = direction(SUN_AZIMUTH_RAD, SUN_HEIGHT_RAD);
    let cosine: f64 = here.iter().zip(sun).map(|(a, b)| a * b).sum();
    let away_rad = cosine.clamp(-1.0, 1.0).acos();

    let toward = (0.5 + 0.5 * cosine).powi(3);
    let horizon = mix([0.16, 0.13, 0.24], [1.5, 0.52, 0.16], toward);
    let zenith = mix([0.03, 0.05, 0.13], [0.09, 0.16, 0.32], toward);
    let mut color = mix(horizon, zenith, here[2].clamp(0.0, 1.0).powf(0.45));

    let glow = 5.0 * (-away_rad / 0.09).exp() + 0.8 * (-away_rad / 0.35).exp();
    color = add(color, [1.0, 0.5, 0.18], glow);

    // Clouds on a horizontal plane, lit from below near the sun.
    let reach = 1.0 / (here[2] + 0.12);
    let thick = clouds(here[0] * reach * 1.1 + 40.0, here[1] * reach * 2.2 + 40.0);
    let cover = ((thick - 0.48) / 0.22).clamp(0.0, 1.0) * (here[2] * 6.0).clamp(0.0, 1.0);
    let lit = mix([0.10, 0.09, 0.16], [2.2, 0.72, 0.34], toward * toward * (1.2 - thick));
    color = mix(color, lit, cover * 0.85);

    let disc = ((SUN_RADIUS_RAD - away_rad) / 0.003).clamp(0.0, 1.0);
    add(color, [1.0, 0.62, 0.3], 900.0 * disc)
}

fn mix(a: Color, b: Color, part: f64) -> Color {
    [0, 1, 2].map(|i| a[i] + (b[i] - a[i]) * part)
}

fn add(a: Color, b: Color, part: f64) -> Color {
    [0, 1, 2].map(|i| a[i] + b[i] * part)
}

/// Mandelbulb noise of six octaves, 0 to 1.
fn clouds(x: f64, y: f64) -> f64 {
    let octave = |level: i32| {
        let scale = 2f64.powi(level);
        noise(x * scale + 17.0 * scale, y * scale) / scale
    };
    (0..6).map(octave).sum::<f64>() / (2.0 - 1.0 / 32.0)
}

/// Value noise on an integer grid with smooth interpolation, 0 to 1.
fn noise(x: f64, y: f64) -> f64 {
    let (cell_x, cell_y) = (x.floor(), y.floor());
    let smooth = |t: f64| t * t * (3.0 - 2.0 * t);
    let (s, t) = (smooth(x - cell_x), smooth(y - cell_y));
    let value = |dx: i64, dy: i64| hashed(cell_x as i64 + dx, cell_y as i64 + dy);
    let lower = value(0, 0) + (value(1, 0) - value(0, 0)) * s;
    let upper = value(0, 1) + (value(1, 1) - value(0, 1)) * s;
    lower + (upper - lower) * t
}

/// A pseudo-random number of a grid point, 0 to 1.
fn hashed(x: i64, y: i64) -> f64 {
    let mut bits = (x as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ (y as u64).rotate_left(32);
    // Steele, Lea, Flood: the finalizer of SplitMix64.
    bits = (bits ^ (bits >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    bits = (bits ^ (bits >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    ((bits ^ (bits >> 31)) >> 11) as f64 / (1u64 << 53) as f64
}
