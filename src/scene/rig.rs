//! A rig: many directional lights generated from a sky or from an environment map.
//!
//! In: a scene's rig. Out: its lights, as directions and strengths. The document stores an
//! environment map's lights, so a scene or a link is lit the same without the map's file.
//!
//! Strengths have the unit of [`super::EnvironmentLight`]: 1 lights a white surface that faces
//! the light to 1. So a light that represents a solid angle has 1/π of the radiance integrated
//! over that solid angle.

mod sky;

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::{
    camera::Camera,
    environment_map::EnvironmentMap,
    light::{self, LightFrame, MAX_LIGHTS},
    param,
};
use crate::reading::at_most;
pub use sky::Sky;

/// The source of a rig's lights.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum RigKind {
    /// No source: the rig has no lights.
    #[default]
    None,
    /// A sky with a sun.
    Sky,
    /// An equirectangular environment map: `picture` in documents.
    #[serde(rename = "picture")]
    EnvironmentMap,
}

/// Directional lights generated together; they follow a scene's other lights in order.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Rig {
    /// The source of the lights.
    pub kind: RigKind,
    /// Number of lights to generate, range [`param::RIG_COUNT`].
    pub count: u32,
    /// Factor on the lights and on the background's environment map, range
    /// [`param::RIG_INTENSITY`].
    pub intensity: f64,
    /// True if surfaces block the lights.
    pub casts_shadows: bool,
    /// Longest shadow ray, range [`param::RIG_SHADOW_REACH`], view units; unlimited if none.
    pub shadow_reach: Option<f64>,
    /// The frame of the directions; in the camera's frame, z points backward.
    pub frame: LightFrame,
    /// True if the rig is switched off.
    pub muted: bool,
    /// While any light is solo, only solo lights shine.
    pub solo: bool,
    /// The sky, used by [`RigKind::Sky`].
    pub sky: Sky,
    /// The environment map, used by [`RigKind::EnvironmentMap`] and by the background.
    /// The field is `picture` in documents.
    #[serde(rename = "picture")]
    pub environment_map: EnvironmentMapRig,
}

impl Default for Rig {
    fn default() -> Self {
        Self {
            kind: RigKind::None,
            count: param::RIG_COUNT.default as u32,
            intensity: param::RIG_INTENSITY.default,
            casts_shadows: true,
            shadow_reach: Some(param::RIG_SHADOW_REACH.default),
            frame: LightFrame::Scene,
            muted: false,
            solo: false,
            sky: Sky::default(),
            environment_map: EnvironmentMapRig::default(),
        }
    }
}

/// An environment map's name, rotation and lights.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct EnvironmentMapRig {
    /// The file's name, at most [`MAX_NAME_CHARS`](super::MAX_NAME_CHARS) characters; empty for
    /// no environment map.
    pub name: String,
    /// Rotation about z, counterclockwise from above, range [`param::RIG_ROTATION`], degrees.
    pub rotation_deg: f64,
    /// The map's lights before the rotation.
    #[serde(deserialize_with = "at_most::<MAX_LIGHTS, _, _>")]
    pub lights: Vec<RigLight>,
}

impl Default for EnvironmentMapRig {
    fn default() -> Self {
        Self { name: String::new(), rotation_deg: param::RIG_ROTATION.default, lights: Vec::new() }
    }
}

/// Maximum strength of a rig light, per channel.
pub const MAX_RIG_RADIANCE: f32 = 1e6;
/// Tolerance of the length of a rig light's direction, around 1.
///
/// Four digits per coordinate are finer than a pixel of the largest environment map.
pub const RIG_DIRECTION_TOLERANCE: f64 = 1e-3;

/// One light of a rig.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RigLight {
    /// Vector toward the light in the rig's frame, of length 1 within
    /// [`RIG_DIRECTION_TOLERANCE`].
    pub direction: [f32; 3],
    /// Strength, linear Rec. 709, each channel 0 to [`MAX_RIG_RADIANCE`].
    pub strength: [f32; 3],
}

impl RigLight {
    /// A light rounded to few digits, which keeps documents and links short.
    ///
    /// The direction's error is at most 1e-5, the strength's relative error at most 5e-6.
    fn rounded(direction: DVec3, strength: DVec3) -> Self {
        let six_digits = |value: f64| {
            // A formatted number always parses.
            let text = format!("{:.5e}", value.clamp(0.0, f64::from(MAX_RIG_RADIANCE)));
            text.parse().unwrap_or(0.0)
        };
        Self {
            direction: direction.to_array().map(|v| ((v * 1e5).round() / 1e5) as f32),
            strength: strength.to_array().map(six_digits),
        }
    }
}

impl Rig {
    /// Number of lights.
    pub fn len(&self) -> usize {
        match self.kind {
            RigKind::None => 0,
            RigKind::Sky => self.count as usize,
            RigKind::EnvironmentMap => self.environment_map.lights.len(),
        }
    }

    /// True if the rig has no lights.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Whether the rig shines, given whether [any light](super::Lights::any_solo) is solo.
    pub fn shines(&self, any_solo: bool) -> bool {
        light::shines(self.muted, self.solo, any_solo)
    }

    /// The unit vector toward the sky's sun, in the camera's frame.
    pub fn toward_sun_in_view(&self, camera: &Camera) -> DVec3 {
        self.frame.to_view(self.sky.sun_direction, camera)
    }

    /// Sets the sun's direction from a vector toward it in the camera's frame, of any length.
    pub fn set_toward_sun_in_view(&mut self, in_view: DVec3, camera: &Camera) {
        self.sky.sun_direction = self.frame.from_view(in_view, camera);
    }

    /// The lights in the rig's frame: unit vectors toward the lights, and strengths.
    ///
    /// The strengths include the rig's intensity.
    pub fn lights(&self) -> Vec<(DVec3, DVec3)> {
        let lights = match self.kind {
            RigKind::None => Vec::new(),
            RigKind::Sky => self.sky.lights(self.count),
            RigKind::EnvironmentMap => self.environment_map.rotated_lights(),
        };
        lights
            .into_iter()
            .map(|(direction, strength)| (direction, strength * self.intensity))
            .collect()
    }

    /// Replaces the lights by those of `environment_map`: at most [`Self::count`] and `room`.
    ///
    /// A map with fewer bright pixels gives fewer lights.
    pub fn light_by(&mut self, environment_map: &EnvironmentMap, room: usize) {
        let count = (self.count as usize).min(room);
        self.kind = RigKind::EnvironmentMap;
        self.environment_map.name = environment_map.name().to_owned();
        self.environment_map.lights = environment_map
            .cut(count)
            .into_iter()
            .map(|light| RigLight::rounded(light.direction, light.energy / std::f64::consts::PI))
            .filter(|light| light.strength != [0.0; 3])
            .collect();
    }
}

impl EnvironmentMapRig {
    fn rotated_lights(&self) -> Vec<(DVec3, DVec3)> {
        let rotation = glam::DQuat::from_rotation_z(self.rotation_deg.to_radians());
        let rotated = |light: &RigLight| {
            let [x, y, z] = light.direction.map(f64::from);
            let strength = DVec3::from_array(light.strength.map(f64::from));
            (rotation * DVec3::new(x, y, z).normalize_or(DVec3::Z), strength)
        };
        self.lights.iter().map(rotated).collect()
    }
}

#[cfg(test)]
mod tests;
