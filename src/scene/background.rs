//! What is seen where a ray meets nothing.

use serde::{Deserialize, Serialize};

/// A vertical gradient behind the fractal, fixed to the picture.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Background {
    /// Colour at the picture's upper edge: linear Rec. 709, each channel 0 to 1.
    pub top: [f32; 3],
    /// Colour at the picture's lower edge: linear Rec. 709, each channel 0 to 1.
    pub bottom: [f32; 3],
}

impl Default for Background {
    fn default() -> Self {
        Self { top: [0.006, 0.009, 0.018], bottom: [0.05, 0.06, 0.085] }
    }
}
