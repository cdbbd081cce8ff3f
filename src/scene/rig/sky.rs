//! A sky: a vertical gradient with a sun, and the lights that approximate both.
//!
//! The lights carry exactly the sky's light: the sphere is divided by height into bands of equal
//! luminous power, and each light has the radiance of one band, integrated in closed form. The
//! azimuth increases by the golden angle from light to light, which spreads the lights evenly.
//! So a light moves continuously while the sky is edited; a median cut would jump.

use std::f64::consts::{PI, TAU};

use glam::DVec3;
use serde::{Deserialize, Serialize};

use crate::scene::{color::luminance, param};

/// Sine of the angle below the horizon over which the ground's colour fades in.
const HAZE: f64 = 0.1;
/// The golden angle, which spreads points evenly around a circle (Vogel 1979).
const GOLDEN_ANGLE_RAD: f64 = 2.399_963_229_728_653;

/// A vertical gradient from −z to +z, and a sun.
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
    /// The sun's strength, range [`param::SUN_STRENGTH`]; at 0 no light represents the sun.
    pub sun_strength: f64,
    /// The sun's angular diameter, range [`param::SUN_SIZE`], degrees.
    pub sun_size_deg: f64,
    /// Number of the rig's lights that represent the sun, range [`param::SUN_LIGHTS`].
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

/// Integrals of the gradient over the part of the sphere below a height.
#[derive(Clone, Copy)]
struct Integrals {
    /// ∫ radiance over the solid angle.
    energy: DVec3,
    /// ∫ radiance · z over the solid angle.
    moment: DVec3,
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

    /// Unit directions and strengths of the `count` lights that represent the sky.
    pub(super) fn lights(&self, count: u32) -> Vec<(DVec3, DVec3)> {
        let sun_count = self.sun_count(count);
        let mut lights = self.lights_of_sun(sun_count);
        lights.extend(self.lights_of_gradient(count - sun_count));
        lights
    }

    /// Number of lights of the sun; at least one light remains for the gradient.
    fn sun_count(&self, count: u32) -> u32 {
        let wanted = if self.sun_strength > 0.0 { self.sun_lights } else { 0 };
        wanted.min(count.saturating_sub(1))
    }

    /// `count` equal lights, spread evenly over the sun's disc.
    fn lights_of_sun(&self, count: u32) -> Vec<(DVec3, DVec3)> {
        let center = DVec3::from_array(self.sun_direction).normalize_or(DVec3::Z);
        let (right, up) = center.any_orthonormal_pair();
        let radius = (self.sun_size_deg.to_radians() / 2.0).tan();
        let strength = rgb(self.sun_color) * (self.sun_strength / f64::from(count.max(1)));
        let light = |i: u32| {
            // Vogel's spiral (1979); a single light is at the centre.
            let area = if count == 1 { 0.0 } else { (f64::from(i) + 0.5) / f64::from(count) };
            let (sin, cos) = (f64::from(i) * GOLDEN_ANGLE_RAD).sin_cos();
            let offset = radius * area.sqrt();
            ((center + (right * cos + up * sin) * offset).normalize(), strength)
        };
        (0..count).map(light).collect()
    }

    /// One light for each of `count` bands of equal luminous power.
    fn lights_of_gradient(&self, count: u32) -> Vec<(DVec3, DVec3)> {
        let edge = |i: u32| self.height_of(f64::from(i) / f64::from(count));
        let band = |i: u32| {
            let (low, high) = (self.below(edge(i)), self.below(edge(i + 1)));
            let energy = high.energy - low.energy;
            let power = luminance(energy);
            let middle = (edge(i) + edge(i + 1)) / 2.0;
            let height =
                if power > 0.0 { luminance(high.moment - low.moment) / power } else { middle };
            let height = height.clamp(-1.0, 1.0);
            let (sin, cos) = (f64::from(i) * GOLDEN_ANGLE_RAD).sin_cos();
            let radius = (1.0 - height * height).sqrt();
            (DVec3::new(radius * cos, radius * sin, height), energy / PI)
        };
        (0..count).map(band).collect()
    }

    /// The height with the fraction `part` of the gradient's luminous power below.
    fn height_of(&self, part: f64) -> f64 {
        if part <= 0.0 {
            return -1.0;
        }
        let total = luminance(self.below(1.0).energy);
        if part >= 1.0 || total <= 0.0 {
            return (2.0 * part - 1.0).min(1.0);
        }
        let (mut low, mut high) = (-1.0, 1.0);
        for _ in 0..52 {
            let middle = (low + high) / 2.0;
            if luminance(self.below(middle).energy) < part * total {
                low = middle;
            } else {
                high = middle;
            }
        }
        (low + high) / 2.0
    }

    /// Integrals of [`Self::radiance`] below `height`, over 2π·dz, in closed form per colour.
    fn below(&self, height: f64) -> Integrals {
        let [ground, horizon, zenith] = self.colors();
        let (z, b) = (height, HAZE);
        let (low, up) = (z.min(-b), z.max(0.0));
        // In the haze between −b and 0, the ground's weight is −z/b.
        let haze = z.clamp(-b, 0.0);
        let ground_weight = low + 1.0 + (b * b - haze * haze) / (2.0 * b);
        let ground_moment = (low * low - 1.0) / 2.0 - (haze.powi(3) + b.powi(3)) / (3.0 * b);
        // Above the horizon, the zenith's weight is √z.
        let zenith_weight = 2.0 / 3.0 * up.powf(1.5);
        let zenith_moment = 2.0 / 5.0 * up.powf(2.5);
        // The three weights sum to 1 at every height.
        let horizon_weight = z + 1.0 - ground_weight - zenith_weight;
        let horizon_moment = (z * z - 1.0) / 2.0 - ground_moment - zenith_moment;
        let sum = |g: f64, h: f64, z: f64| (ground * g + horizon * h + zenith * z) * TAU;
        Integrals {
            energy: sum(ground_weight, horizon_weight, zenith_weight),
            moment: sum(ground_moment, horizon_moment, zenith_moment),
        }
    }

    fn colors(&self) -> [DVec3; 3] {
        [self.ground, self.horizon, self.zenith].map(rgb)
    }
}

fn rgb(color: [f32; 3]) -> DVec3 {
    DVec3::from_array(color.map(f64::from))
}
