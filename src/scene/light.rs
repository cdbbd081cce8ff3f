//! Single lights (thesis 4.5): environment lights and point lights.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::{camera::Camera, param};
use crate::precise::PrecisePoint;

/// Maximum number of lights in a scene, all kinds together: one visibility bit each.
pub const MAX_LIGHTS: usize = 64;

/// The frame of a light's direction.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LightFrame {
    /// World space: the light stays in place while the camera moves.
    #[default]
    Scene,
    /// Camera space: the light moves with the camera.
    View,
}

impl LightFrame {
    /// Converts a direction of this frame to world space.
    pub fn to_world(self, direction: DVec3, camera: &Camera) -> DVec3 {
        match self {
            Self::Scene => direction,
            Self::View => camera.rotation() * direction,
        }
    }

    /// Converts a direction of world space to this frame.
    pub fn from_world(self, direction: DVec3, camera: &Camera) -> DVec3 {
        match self {
            Self::Scene => direction,
            Self::View => camera.rotation().inverse() * direction,
        }
    }

    /// Converts a direction of this frame, of any length, to a unit vector of the camera's frame.
    pub fn to_view(self, direction: [f64; 3], camera: &Camera) -> DVec3 {
        let direction = DVec3::from_array(direction).normalize_or(DVec3::Z);
        Self::View.from_world(self.to_world(direction, camera), camera)
    }

    /// Converts a direction of the camera's frame, of any length, to a unit vector of this frame.
    pub fn from_view(self, in_view: DVec3, camera: &Camera) -> [f64; 3] {
        let direction = self.from_world(Self::View.to_world(in_view, camera), camera);
        direction.normalize_or(DVec3::Z).to_array()
    }
}

/// A light infinitely far away: one direction, or a disc of directions.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct EnvironmentLight {
    /// Unit vector from the scene toward the light, in [`Self::frame`]; length 1 within 1e-6.
    pub direction: [f64; 3],
    /// Linear Rec. 709, each channel 0 to 1.
    pub color: [f32; 3],
    /// Strength, range [`param::ENVIRONMENT_INTENSITY`].
    pub intensity: f64,
    /// Apparent diameter, range [`param::ENVIRONMENT_SIZE`], degrees.
    pub size_deg: f64,
    /// True if surfaces block the light.
    pub casts_shadows: bool,
    /// Longest shadow ray, range [`param::SHADOW_REACH`], view units; unlimited if none.
    pub shadow_reach: Option<f64>,
    /// The frame of the direction.
    pub frame: LightFrame,
    /// True if the light is switched off.
    pub muted: bool,
    /// While any light is solo, only solo lights shine.
    pub solo: bool,
}

impl EnvironmentLight {
    /// A light of the scene from `direction`, of any length.
    pub fn new(direction: [f64; 3], color: [f32; 3], intensity: f64) -> Self {
        let direction = DVec3::from_array(direction).normalize_or(DVec3::Z).to_array();
        Self { direction, color, intensity, ..Self::default() }
    }

    /// A light that stays with the camera, from `direction` in its frame: x right, y up, z backward.
    pub fn headlight(direction: [f64; 3], color: [f32; 3], intensity: f64) -> Self {
        Self { frame: LightFrame::View, ..Self::new(direction, color, intensity) }
    }

    /// Whether the light shines, given whether [any light](super::Lights::any_solo) is solo.
    pub fn shines(&self, any_solo: bool) -> bool {
        shines(self.muted, self.solo, any_solo)
    }

    /// The unit vector toward the light, in the camera's frame.
    pub fn toward_light_in_view(&self, camera: &Camera) -> DVec3 {
        self.frame.to_view(self.direction, camera)
    }

    /// Sets the direction from a vector toward the light in the camera's frame, of any length.
    pub fn set_toward_light_in_view(&mut self, in_view: DVec3, camera: &Camera) {
        self.direction = self.frame.from_view(in_view, camera);
    }
}

impl Default for EnvironmentLight {
    fn default() -> Self {
        Self {
            direction: DVec3::new(0.4, -0.5, 0.75).normalize().to_array(),
            color: [1.0; 3],
            intensity: param::ENVIRONMENT_INTENSITY.default,
            size_deg: param::ENVIRONMENT_SIZE.default,
            casts_shadows: true,
            shadow_reach: Some(param::SHADOW_REACH.default),
            frame: LightFrame::Scene,
            muted: false,
            solo: false,
        }
    }
}

/// Whether a light shines: `any_solo` says whether [any light](super::Lights::any_solo) is solo.
pub(super) fn shines(muted: bool, solo: bool, any_solo: bool) -> bool {
    !muted && (solo || !any_solo)
}

/// A point light, or a glowing ball; its light falls with the square of the distance.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct PointLight {
    /// Position, in scene units.
    pub position: PrecisePoint,
    /// Linear Rec. 709, each channel 0 to 1.
    pub color: [f32; 3],
    /// Strength at a distance of one scene unit, range [`param::POINT_INTENSITY`].
    pub intensity: f64,
    /// Radius of the glowing sphere, range [`param::POINT_RADIUS`], scene units.
    pub radius: f64,
    /// True if surfaces block the light.
    pub casts_shadows: bool,
    /// True if the light is switched off.
    pub muted: bool,
    /// While any light is solo, only solo lights shine.
    pub solo: bool,
}

impl PointLight {
    /// Whether the light shines, given whether [any light](super::Lights::any_solo) is solo.
    pub fn shines(&self, any_solo: bool) -> bool {
        shines(self.muted, self.solo, any_solo)
    }
}

impl Default for PointLight {
    fn default() -> Self {
        Self {
            position: PrecisePoint::from(DVec3::new(0.0, -1.5, 1.0)),
            color: [1.0; 3],
            intensity: param::POINT_INTENSITY.default,
            radius: param::POINT_RADIUS.default,
            casts_shadows: true,
            muted: false,
            solo: false,
        }
    }
}
