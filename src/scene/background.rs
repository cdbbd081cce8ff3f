//! The background: the colour of a ray that hits no surface.

use serde::{Deserialize, Serialize};

/// The kind of background behind the fractal.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum BackgroundKind {
    /// A vertical gradient.
    #[default]
    Gradient,
    /// The environment map of [`super::EnvironmentMapRig`], with its rotation. Without the file, the
    /// gradient. `picture` in documents.
    #[serde(rename = "picture")]
    EnvironmentMap,
}

/// The background: a vertical gradient fixed to the picture, or an environment map.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Background {
    /// Gradient or environment map.
    pub kind: BackgroundKind,
    /// Colour at the picture's upper edge: linear Rec. 709, each channel 0 to 1.
    pub top: [f32; 3],
    /// Colour at the picture's lower edge: linear Rec. 709, each channel 0 to 1.
    pub bottom: [f32; 3],
}

impl Background {
    /// A gradient background from `top` to `bottom`.
    pub fn gradient(top: [f32; 3], bottom: [f32; 3]) -> Self {
        Self { kind: BackgroundKind::Gradient, top, bottom }
    }
}

impl Default for Background {
    fn default() -> Self {
        Self::gradient([0.006, 0.009, 0.018], [0.05, 0.06, 0.085])
    }
}
