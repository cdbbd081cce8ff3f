//! A sky: a gradient by height with a sun in it, and the lights that stand for both.
//!
//! The lights carry the sky's light exactly: the sphere is divided into bands by height, each
//! with the same luminous power, and every band's light, integrated in closed form, goes to one
//! light. A golden angle from one light to the next spreads them all around. So every light
//! moves evenly as the sky is edited, where a cut through pixels would jump.

use std::f64::consts::{PI, TAU};

use glam::DVec3;
use serde::{Deserialize, Serialize};

use crate::scene::{color::luminance, param};

/// Height, as the sine of the angle below the horizon, over which the ground fades in.
const HAZE: f64 = 0.1;
/// The angle that spreads points best around a circle (Vogel 1979).
const GOLDEN_ANGLE_RAD: f64 = 2.399_963_229_728_653;

/// A gradient by height, fixed to +z, and a sun.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Sky {
    /// Radiance straight up: linear Rec. 709, each channel 0 to 1.
    pub zenith: [f32; 3],
    /// Radiance at the horizon: linear Rec. 709, each channel 0 to 1.
    pub horizon: [f32; 3],
    /// Radiance of the ground: linear Rec. 709, each channel 0 to 1.
    pub ground: [f32; 3],
    /// Unit vector toward the sun, in the rig's frame; length 1 within 1e-6.
    pub sun_direction: [f64; 3],
    /// The sun's colour: linear Rec. 709, each channel 0 to 1.
    pub sun_color: [f32; 3],
    /// The sun's strength, in [`param::SUN_STRENGTH`]; the sun has no light of its own at 0.
    pub sun_strength: f64,
    /// How wide the sun is, in [`param::SUN_SIZE`], degrees.
    pub sun_size_deg: f64,
    /// How many of the rig's lights make the sun, in [`param::SUN_LIGHTS`].
    pub sun_lights: u32,
}

impl Default for Sky {
    fn default() -> Self {
        Self {
            zenith: [0.16, 0.3, 0.62],
            horizon: [0.62, 0.7, 0.8],
            ground: [0.11, 0.09, 0.07],
            sun_direction: DVec3::new(-0.45, -0.7, 0.6).normalize().to_array(),
            sun_color: [1.0, 0.9, 0.74],
            sun_strength: param::SUN_STRENGTH.default,
            sun_size_deg: param::SUN_SIZE.default,
            sun_lights: param::SUN_LIGHTS.default as u32,
        }
    }
}

/// A band of the sphere, or all of the sphere below some height.
#[derive(Clone, Copy)]
struct Share {
    /// Radiance integrated over its solid angle.
    energy: DVec3,
    /// The same, each direction weighted with its height.
    raised: DVec3,
}

impl Sky {
    /// Radiance from `direction`, of length 1, without the sun.
    pub fn radiance(&self, direction: DVec3) -> DVec3 {
        let height = direction.z.clamp(-1.0, 1.0);
        let [ground, horizon, zenith] = self.colors();
        if height > 0.0 {
            horizon.lerp(zenith, height.sqrt())
        } else {
            horizon.lerp(ground, (-height / HAZE).min(1.0))
        }
    }

    /// Directions of length 1, and strengths, of the `count` lights that stand for the sky.
    pub(super) fn lights(&self, count: u32) -> Vec<(DVec3, DVec3)> {
        let sun_count = self.sun_count(count);
        let mut lights = self.sun(sun_count);
        lights.extend(self.gradient(count - sun_count));
        lights
    }

    /// The sun leaves the gradient at least one light.
    fn sun_count(&self, count: u32) -> u32 {
        let wanted = if self.sun_strength > 0.0 { self.sun_lights } else { 0 };
        wanted.min(count.saturating_sub(1))
    }

    /// The sun's light, spread evenly over its disc.
    fn sun(&self, count: u32) -> Vec<(DVec3, DVec3)> {
        let center = DVec3::from_array(self.sun_direction).normalize_or(DVec3::Z);
        let (right, up) = center.any_orthonormal_pair();
        let radius = (self.sun_size_deg.to_radians() / 2.0).tan();
        let strength = rgb(self.sun_color) * (self.sun_strength / f64::from(count.max(1)));
        let place = |i: u32| {
            // A sunflower's seeds (Vogel 1979); a single one is the centre.
            let outward = if count == 1 { 0.0 } else { (f64::from(i) + 0.5) / f64::from(count) };
            let (sin, cos) = (f64::from(i) * GOLDEN_ANGLE_RAD).sin_cos();
            let aside = radius * outward.sqrt();
            ((center + (right * cos + up * sin) * aside).normalize(), strength)
        };
        (0..count).map(place).collect()
    }

    /// The gradient's light, one light a band of equal luminous power.
    fn gradient(&self, count: u32) -> Vec<(DVec3, DVec3)> {
        let edge = |i: u32| self.height_of(f64::from(i) / f64::from(count));
        let band = |i: u32| {
            let (low, high) = (self.below(edge(i)), self.below(edge(i + 1)));
            let energy = high.energy - low.energy;
            let power = luminance(energy);
            let middle = (edge(i) + edge(i + 1)) / 2.0;
            let height =
                if power > 0.0 { luminance(high.raised - low.raised) / power } else { middle };
            let height = height.clamp(-1.0, 1.0);
            let (sin, cos) = (f64::from(i) * GOLDEN_ANGLE_RAD).sin_cos();
            let aside = (1.0 - height * height).sqrt();
            (DVec3::new(aside * cos, aside * sin, height), energy / PI)
        };
        (0..count).map(band).collect()
    }

    /// The height below which the part `part` of the gradient's luminous power lies.
    fn height_of(&self, part: f64) -> f64 {
        if part <= 0.0 {
            return -1.0;
        }
        let whole = luminance(self.below(1.0).energy);
        if part >= 1.0 || whole <= 0.0 {
            return (2.0 * part - 1.0).min(1.0);
        }
        let (mut low, mut high) = (-1.0, 1.0);
        for _ in 0..52 {
            let middle = (low + high) / 2.0;
            if luminance(self.below(middle).energy) < part * whole {
                low = middle;
            } else {
                high = middle;
            }
        }
        (low + high) / 2.0
    }

    /// What lies below `height`: the integrals of [`Self::radiance`] over the solid angle 2π·dz,
    /// colour by colour in closed form.
    fn below(&self, height: f64) -> Share {
        let [ground, horizon, zenith] = self.colors();
        let (z, b) = (height, HAZE);
        let (low, up) = (z.min(-b), z.max(0.0));
        // The haze between −b and 0, where the ground's part is −z/b.
        let haze = z.clamp(-b, 0.0);
        let ground_part = low + 1.0 + (b * b - haze * haze) / (2.0 * b);
        let ground_raised = (low * low - 1.0) / 2.0 - (haze.powi(3) + b.powi(3)) / (3.0 * b);
        // Above the horizon the zenith's part is √z.
        let zenith_part = 2.0 / 3.0 * up.powf(1.5);
        let zenith_raised = 2.0 / 5.0 * up.powf(2.5);
        // The three parts make the whole.
        let horizon_part = z + 1.0 - ground_part - zenith_part;
        let horizon_raised = (z * z - 1.0) / 2.0 - ground_raised - zenith_raised;
        let sum = |g: f64, h: f64, z: f64| (ground * g + horizon * h + zenith * z) * TAU;
        Share {
            energy: sum(ground_part, horizon_part, zenith_part),
            raised: sum(ground_raised, horizon_raised, zenith_raised),
        }
    }

    fn colors(&self) -> [DVec3; 3] {
        [self.ground, self.horizon, self.zenith].map(rgb)
    }
}

fn rgb(color: [f32; 3]) -> DVec3 {
    DVec3::from_array(color.map(f64::from))
}
