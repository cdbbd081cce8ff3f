//! What is seen where a ray meets nothing.

use serde::{Deserialize, Serialize};

/// What lies behind the fractal.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum BackgroundKind {
    /// The vertical gradient.
    #[default]
    Gradient,
    /// The picture that [`super::PictureRig`] names, turned as it is; the gradient where that is
    /// not at hand.
    Picture,
}

/// What is seen behind the fractal: a vertical gradient fixed to the picture, or a picture of
/// the surroundings.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Background {
    /// Which of the two.
    pub kind: BackgroundKind,
    /// Colour at the picture's upper edge: linear Rec. 709, each channel 0 to 1.
    pub top: [f32; 3],
    /// Colour at the picture's lower edge: linear Rec. 709, each channel 0 to 1.
    pub bottom: [f32; 3],
}

impl Background {
    /// A gradient from `top` to `bottom`.
    pub fn gradient(top: [f32; 3], bottom: [f32; 3]) -> Self {
        Self { kind: BackgroundKind::Gradient, top, bottom }
    }
}

impl Default for Background {
    fn default() -> Self {
        Self::gradient([0.006, 0.009, 0.018], [0.05, 0.06, 0.085])
    }
}
