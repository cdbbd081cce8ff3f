//! A gradient with its name.

use crate::scene::{GradientStop, color::short_linear_from_srgb};

/// A gradient with its name.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedGradient {
    /// The name in menus.
    pub name: String,
    /// The stops, as [`Surface::gradient`](crate::scene::Surface::gradient).
    pub stops: Vec<GradientStop>,
}

/// A stop with an sRGB colour, rounded so that documents and links stay short.
pub fn srgb_stop(position: f64, encoded: [f32; 3]) -> GradientStop {
    GradientStop { position, color: encoded.map(short_linear_from_srgb) }
}
