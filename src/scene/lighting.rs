//! All lights of a scene: environment lights, point lights and the rig.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::{
    light::{EnvironmentLight, LightFrame, MAX_LIGHTS, PointLight},
    rig::Rig,
};
use crate::reading::at_most;

/// All lights of a scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Lights {
    /// Directional lights.
    #[serde(deserialize_with = "at_most::<MAX_LIGHTS, _, _>")]
    pub environment: Vec<EnvironmentLight>,
    /// Point lights.
    #[serde(deserialize_with = "at_most::<MAX_LIGHTS, _, _>")]
    pub point: Vec<PointLight>,
    /// Directional lights generated from a sky or an environment map.
    pub rig: Rig,
    /// True if the lights [follow](super::follow) close views.
    pub follow_view: bool,
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
            follow_view: false,
        }
    }
}
