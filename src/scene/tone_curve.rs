//! The tone curves on the CPU, for small previews; `shaders/lib/curve.wgsl` has those of pictures.

use glam::{DMat3, DVec3};

use super::{Tone, ToneChannels, ToneCurve, color::luminance};

impl Tone {
    /// What a display shows of exposed radiance: linear Rec. 709, each channel 0 to 1.
    ///
    /// `docs/tone.md` has the equations and their sources.
    pub fn displayed(&self, exposed: DVec3) -> DVec3 {
        let mapped = match self.curve {
            ToneCurve::Linear => exposed,
            ToneCurve::Reinhard => self.reinhard(exposed),
            ToneCurve::Aces => aces(exposed),
            ToneCurve::Agx => agx(exposed),
            ToneCurve::KhronosNeutral => khronos_neutral(exposed),
        };
        mapped.clamp(DVec3::ZERO, DVec3::ONE)
    }

    fn reinhard(&self, color: DVec3) -> DVec3 {
        let by = match self.channels {
            ToneChannels::Luminance => DVec3::splat(luminance(color)),
            ToneChannels::PerChannel => color,
        };
        color * (1.0 + by / (self.white_point * self.white_point)) / (1.0 + by)
    }
}

fn aces(color: DVec3) -> DVec3 {
    let to_working = DMat3::from_cols_array(&[
        0.59719, 0.07600, 0.02840, 0.35458, 0.90834, 0.13383, 0.04823, 0.01566, 0.83777,
    ]);
    let from_working = DMat3::from_cols_array(&[
        1.60475, -0.10208, -0.00327, -0.53108, 1.10813, -0.07276, -0.07367, -0.00605, 1.07602,
    ]);
    let v = to_working * (color / 0.6);
    let fitted = (v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.4329510) + 0.238081);
    from_working * fitted
}

fn agx(color: DVec3) -> DVec3 {
    const INSET: DVec3 = DVec3::new(0.04239893, 0.07843017, 0.07917091);
    const PIVOT: f64 = 10.0 / 16.5;
    let inset = 0.8 * color + DVec3::splat(INSET.dot(color));
    let sigmoid = |value: f64| {
        let x = (((value.max(1e-10) / 0.18).log2() + 10.0) / 16.5).clamp(0.0, 1.0);
        let (power, scale) = if x < PIVOT { (3.0, 0.5122774) } else { (3.25, 0.5414642) };
        let u: f64 = 2.0 * (x - PIVOT) / scale;
        0.5 + scale * u / (1.0 + u.abs().powf(power)).powf(1.0 / power)
    };
    let encoded = DVec3::from_array(inset.to_array().map(sigmoid));
    let outset = (encoded - DVec3::splat(INSET.dot(encoded))) / 0.8;
    outset.max(DVec3::ZERO).powf(2.2)
}

fn khronos_neutral(color: DVec3) -> DVec3 {
    const START: f64 = 0.76;
    let least = color.min_element();
    let offset = if least < 0.08 { least - 6.25 * least * least } else { 0.04 };
    let base = color - DVec3::splat(offset);
    let peak = base.max_element();
    if peak < START {
        return base;
    }
    let room = 1.0 - START;
    let new_peak = 1.0 - room * room / (peak + room - START);
    let toward_white = 1.0 - 1.0 / (0.15 * (peak - new_peak) + 1.0);
    (base * (new_peak / peak)).lerp(DVec3::splat(new_peak), toward_white)
}
