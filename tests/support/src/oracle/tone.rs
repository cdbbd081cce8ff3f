//! The tone curves in f64, from their published definitions.

use glam::{DMat3, DVec2, DVec3};
use mandelight::scene::{Tone, ToneChannels, ToneCurve};

/// What the display shows, linear, each channel 0 to 1, of exposed radiance.
pub fn curve(tone: &Tone, exposed: DVec3) -> DVec3 {
    let mapped = match tone.curve {
        ToneCurve::Linear => exposed,
        ToneCurve::Reinhard => reinhard(tone, exposed),
        ToneCurve::Aces => aces(exposed),
        ToneCurve::Agx => agx(exposed),
        ToneCurve::KhronosNeutral => khronos_neutral(exposed),
    };
    mapped.clamp(DVec3::ZERO, DVec3::ONE)
}

/// L(1 + L/Lw²)/(1 + L), Reinhard et al. 2002, eq. 4.
fn reinhard(tone: &Tone, color: DVec3) -> DVec3 {
    let white = tone.white_point * tone.white_point;
    let mapped = |l: f64| l * (1.0 + l / white) / (1.0 + l);
    match tone.channels {
        ToneChannels::PerChannel => DVec3::from_array(color.to_array().map(mapped)),
        ToneChannels::Luminance => {
            let l = color.dot(DVec3::new(0.2126, 0.7152, 0.0722));
            if l > 0.0 { color * (mapped(l) / l) } else { color }
        }
    }
}

/// Hill's fit, matrices row by row as they were published, after an exposure by 1/0.6.
fn aces(color: DVec3) -> DVec3 {
    let rows = |rows: [[f64; 3]; 3]| DMat3::from_cols_array_2d(&rows).transpose();
    let input = rows([
        [0.59719, 0.35458, 0.04823],
        [0.07600, 0.90834, 0.01566],
        [0.02840, 0.13383, 0.83777],
    ]);
    let output = rows([
        [1.60475, -0.53108, -0.07367],
        [-0.10208, 1.10813, -0.00605],
        [-0.00327, -0.07276, 1.07602],
    ]);
    let fit =
        |v: f64| (v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.4329510) + 0.238081);
    output * DVec3::from_array((input * color / 0.6).to_array().map(fit))
}

/// Linear XYZ of the corners of an RGB space whose white is D65.
fn xyz_from(primaries: [DVec2; 3]) -> DMat3 {
    let xyz = |p: DVec2| DVec3::new(p.x / p.y, 1.0, (1.0 - p.x - p.y) / p.y);
    let corners = DMat3::from_cols(xyz(primaries[0]), xyz(primaries[1]), xyz(primaries[2]));
    let strengths = corners.inverse() * xyz(DVec2::new(0.3127, 0.3290));
    corners * DMat3::from_diagonal(strengths)
}

/// AgX: primaries 20 % nearer to white; log2 over 16.5 stops, 10 of them below 0.18; a sigmoid
/// through (10/16.5, 1/2) with slope 2, toe power 3, shoulder power 3.25, from (0, 0) to (1, 1);
/// the primaries outward again; a display of gamma 2.2.
fn agx(color: DVec3) -> DVec3 {
    let white = DVec2::new(0.3127, 0.3290);
    let rec_709 = [DVec2::new(0.64, 0.33), DVec2::new(0.30, 0.60), DVec2::new(0.15, 0.06)];
    let inset = xyz_from(rec_709).inverse() * xyz_from(rec_709.map(|p| white + 0.8 * (p - white)));
    let pivot = 10.0 / 16.5;
    let side = |distance: f64, power: f64, offset: f64| {
        let steep = (2.0 * distance).powf(power);
        let high = 0.5_f64.powf(power);
        let scale = (high * steep / (steep - high)).powf(1.0 / power);
        let u = 2.0 * offset / scale;
        scale * u / (1.0 + u.powf(power)).powf(1.0 / power)
    };
    let sigmoid = |v: f64| {
        let x = (((v / 0.18).log2() + 10.0) / 16.5).clamp(0.0, 1.0);
        if x < pivot {
            0.5 - side(pivot, 3.0, pivot - x)
        } else {
            0.5 + side(1.0 - pivot, 3.25, x - pivot)
        }
    };
    let encoded = inset.inverse() * DVec3::from_array((inset * color).to_array().map(sigmoid));
    DVec3::from_array(encoded.to_array().map(|v| v.max(0.0).powf(2.2)))
}

/// The specification's own steps.
fn khronos_neutral(color: DVec3) -> DVec3 {
    let (start, desaturation) = (0.8 - 0.04, 0.15);
    let x = color.min_element();
    let offset = if x < 0.08 { x - 6.25 * x * x } else { 0.04 };
    let color = color - offset;
    let peak = color.max_element();
    if peak < start {
        return color;
    }
    let d = 1.0 - start;
    let new_peak = 1.0 - d * d / (peak + d - start);
    let g = 1.0 - 1.0 / (desaturation * (peak - new_peak) + 1.0);
    (color * new_peak / peak).lerp(DVec3::splat(new_peak), g)
}
