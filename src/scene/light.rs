//! What lights the scene (thesis 4.5): light from a direction, light from a point, and a rig.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::{PrecisePoint, Rig, param};

/// The most lights a scene holds, all kinds together: one visibility bit each.
pub const MAX_LIGHTS: usize = 64;

/// What a light's direction is fixed to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LightFrame {
    /// The light stays where it is as the camera moves.
    #[default]
    Scene,
    /// The light moves with the camera: its direction is in the camera's frame.
    View,
}

/// Light from infinitely far away in one direction.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct EnvironmentLight {
    /// Unit vector from the scene toward the light, in [`Self::frame`]; length 1 within 1e-6.
    pub direction: [f64; 3],
    /// Linear Rec. 709, each channel 0 to 1.
    pub color: [f32; 3],
    /// Strength, in [`param::ENVIRONMENT_INTENSITY`].
    pub intensity: f64,
    /// Whether surfaces block it.
    pub casts_shadows: bool,
    /// How far a blocker may be, in [`param::SHADOW_REACH`], view units; none for the whole scene.
    pub shadow_reach: Option<f64>,
    /// What the direction is fixed to.
    pub frame: LightFrame,
    /// Off for now.
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

/// Light from a point; it falls with the square of the distance.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct PointLight {
    /// Where it is, in scene units.
    pub position: PrecisePoint,
    /// Linear Rec. 709, each channel 0 to 1.
    pub color: [f32; 3],
    /// Strength at one scene unit, in [`param::POINT_INTENSITY`].
    pub intensity: f64,
    /// Whether surfaces block it.
    pub casts_shadows: bool,
    /// Off for now.
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
    /// Light from directions.
    pub environment: Vec<EnvironmentLight>,
    /// Light from points.
    pub point: Vec<PointLight>,
    /// Lights from directions that are made together.
    pub rig: Rig,
}

impl Lights {
    /// How many there are, all kinds together.
    pub fn len(&self) -> usize {
        self.environment.len() + self.point.len() + self.rig.len()
    }

    /// How many lights the rig can have beside those of the lists.
    pub fn room_for_rig(&self) -> usize {
        MAX_LIGHTS.saturating_sub(self.environment.len() + self.point.len())
    }

    /// True where there is no light at all.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// True while some light is solo.
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
                // A faint fill that comes along with the camera, so that what the others leave
                // in shadow keeps its shape at any depth.
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
