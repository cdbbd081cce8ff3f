//! Lights (thesis 4.5): environment lights, point lights and the rig.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::{PrecisePoint, Rig, param};

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

/// A directional light: parallel light from infinitely far away.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct EnvironmentLight {
    /// Unit vector from the scene toward the light, in [`Self::frame`]; length 1 within 1e-6.
    pub direction: [f64; 3],
    /// Linear Rec. 709, each channel 0 to 1.
    pub color: [f32; 3],
    /// Strength, range [`param::ENVIRONMENT_INTENSITY`].
    pub intensity: f64,
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

impl Default for EnvironmentLight {
    fn default() -> Self {
        Self {
            direction: DVec3::new(0.4, -0.5, 0.75).normalize().to_array(),
            color: [1.0; 3],
            intensity: param::ENVIRONMENT_INTENSITY.default,
            casts_shadows: true,
            shadow_reach: Some(param::SHADOW_REACH.default),
            frame: LightFrame::Scene,
            muted: false,
            solo: false,
        }
    }
}

/// A point light; its light falls with the square of the distance.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct PointLight {
    /// Position, in scene units.
    pub position: PrecisePoint,
    /// Linear Rec. 709, each channel 0 to 1.
    pub color: [f32; 3],
    /// Strength at a distance of one scene unit, range [`param::POINT_INTENSITY`].
    pub intensity: f64,
    /// True if surfaces block the light.
    pub casts_shadows: bool,
    /// True if the light is switched off.
    pub muted: bool,
    /// While any light is solo, only solo lights shine.
    pub solo: bool,
}

impl Default for PointLight {
    fn default() -> Self {
        Self {
            position: PrecisePoint::from(DVec3::new(0.0, -1.5, 1.0)),
            color: [1.0; 3],
            intensity: param::POINT_INTENSITY.default,
            casts_shadows: true,
            muted: false,
            solo: false,
        }
    }
}

/// All lights of a scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Lights {
    /// Directional lights.
    pub environment: Vec<EnvironmentLight>,
    /// Point lights.
    pub point: Vec<PointLight>,
    /// Directional lights generated from a sky or an environment map.
    pub rig: Rig,
}

impl Lights {
    /// Number of lights, all kinds together.
    pub fn len(&self) -> usize {
        self.environment.len() + self.point.len() + self.rig.len()
    }

    /// Maximum number of lights that the rig can have beside the other lights.
    pub fn room_for_rig(&self) -> usize {
        MAX_LIGHTS.saturating_sub(self.environment.len() + self.point.len())
    }

    /// True if the scene has no light of any kind.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// True if any light is solo.
    pub fn any_solo(&self) -> bool {
        self.environment.iter().any(|l| l.solo)
            || self.point.iter().any(|l| l.solo)
            || (self.rig.solo && !self.rig.is_empty())
    }
}

impl Default for Lights {
    fn default() -> Self {
        let toward = |x, y, z| DVec3::new(x, y, z).normalize().to_array();
        Self {
            environment: vec![
                // A warm key from the upper left.
                EnvironmentLight {
                    direction: toward(-0.35, -0.75, 0.8),
                    color: [1.0, 0.86, 0.68],
                    intensity: 2.6,
                    ..Default::default()
                },
                // A cool rim from behind.
                EnvironmentLight {
                    direction: toward(0.6, 0.75, 0.35),
                    color: [0.6, 0.75, 1.0],
                    intensity: 1.4,
                    ..Default::default()
                },
                // A faint fill light fixed to the camera, so that shadowed surfaces keep their
                // shape at any depth.
                EnvironmentLight {
                    direction: toward(0.5, 0.35, 0.8),
                    color: [0.5, 0.66, 1.0],
                    intensity: 0.4,
                    casts_shadows: false,
                    frame: LightFrame::View,
                    ..Default::default()
                },
            ],
            point: Vec::new(),
            rig: Rig::default(),
        }
    }
}
