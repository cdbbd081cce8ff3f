//! A gradient with its name.

use crate::scene::{GradientStop, color::linear_from_srgb};

/// A gradient with its name.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedGradient {
    /// The name in menus.
    pub name: String,
    /// The stops, as [`Surface::gradient`](crate::scene::Surface::gradient).
    pub stops: Vec<GradientStop>,
}

/// Decimals of a channel: a fifth of the darkest sRGB level of 255.
const DECIMALS: f32 = 1e4;

/// A stop with an sRGB colour, rounded so that documents and links stay short.
pub fn srgb_stop(position: f64, encoded: [f32; 3]) -> GradientStop {
    let rounded = |channel: f32| (linear_from_srgb(channel) * DECIMALS).round() / DECIMALS;
    GradientStop { position, color: encoded.map(rounded) }
}
