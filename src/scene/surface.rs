//! Surface material (Blinn-Phong, thesis 3.2) and colouring.

use serde::{Deserialize, Serialize};

use super::param;

/// Maximum number of stops in a gradient.
pub const MAX_GRADIENT_STOPS: usize = 16;

/// The orbit value that selects a colour of the gradient.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ColorSource {
    /// The smooth iteration count (thesis eq. 3.1, for any power).
    Iterations,
    /// Orbit trap: the smallest distance of the orbit from the origin.
    #[default]
    OriginTrap,
    /// Orbit trap: the smallest distance of the orbit from the z axis.
    AxisTrap,
    /// Orbit trap: the smallest distance of the orbit from the plane z = 0.
    PlaneTrap,
}

/// The mapping from an orbit value to a position in the gradient.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Coloring {
    /// The orbit value.
    pub source: ColorSource,
    /// Whether the gradient spans the values in view, instead of those from 0 to 1.
    pub follows_view: bool,
    /// Repeats of the gradient per unit of the value, or over the values in view, range [`param::COLOR_REPEATS`].
    pub repeats: f64,
    /// Start position in the gradient, range [`param::COLOR_OFFSET`].
    pub offset: f64,
}

impl Default for Coloring {
    fn default() -> Self {
        Self {
            source: ColorSource::default(),
            follows_view: false,
            repeats: param::COLOR_REPEATS.default,
            offset: param::COLOR_OFFSET.default,
        }
    }
}

/// One colour of the gradient.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GradientStop {
    /// Position in the gradient, 0 to 1.
    pub position: f64,
    /// Linear Rec. 709, each channel 0 to 1.
    pub color: [f32; 3],
}

/// The surface's material and colouring.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Surface {
    /// Fraction of the colour that is visible without light, range [`param::AMBIENT`].
    pub ambient: f64,
    /// Diffuse reflectance, range [`param::DIFFUSE`].
    pub diffuse: f64,
    /// Specular reflectance, range [`param::SPECULAR`].
    pub specular: f64,
    /// Blinn-Phong exponent, range [`param::SHININESS`].
    pub shininess: f64,
    /// The mapping from an orbit value to the gradient.
    pub coloring: Coloring,
    /// 1 to [`MAX_GRADIENT_STOPS`] stops with non-decreasing positions. The gradient wraps: the
    /// last stop blends to the first.
    pub gradient: Vec<GradientStop>,
}

impl Default for Surface {
    fn default() -> Self {
        let stop = |position, color| GradientStop { position, color };
        Self {
            ambient: param::AMBIENT.default,
            diffuse: param::DIFFUSE.default,
            specular: param::SPECULAR.default,
            shininess: param::SHININESS.default,
            coloring: Coloring::default(),
            // The last stop is below 1, so the blend back to the first is not abrupt.
            gradient: vec![
                stop(0.0, [0.10, 0.02, 0.05]),
                stop(0.3, [0.62, 0.16, 0.06]),
                stop(0.52, [0.90, 0.55, 0.20]),
                stop(0.7, [0.92, 0.82, 0.62]),
                stop(0.85, [0.25, 0.32, 0.42]),
            ],
        }
    }
}
