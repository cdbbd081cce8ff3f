//! How the surface answers light (Blinn-Phong, thesis 3.2) and where its colour comes from.

use serde::{Deserialize, Serialize};

use super::param;

/// The most stops a gradient holds.
pub const MAX_GRADIENT_STOPS: usize = 16;

/// The value that drives the gradient.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ColorSource {
    /// The smooth iteration count (thesis eq. 3.1, for any power).
    Iterations,
    /// The orbit's least distance from the origin.
    #[default]
    OriginTrap,
    /// The orbit's least distance from the z axis.
    AxisTrap,
    /// The orbit's least distance from the plane z = 0.
    PlaneTrap,
}

/// How the driving value runs through the gradient.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Coloring {
    /// The driving value.
    pub source: ColorSource,
    /// Gradient lengths per unit of it, in [`param::COLOR_REPEATS`].
    pub repeats: f64,
    /// Where the gradient starts, in [`param::COLOR_OFFSET`].
    pub offset: f64,
}

impl Default for Coloring {
    fn default() -> Self {
        Self {
            source: ColorSource::default(),
            repeats: param::COLOR_REPEATS.default,
            offset: param::COLOR_OFFSET.default,
        }
    }
}

/// One colour of the gradient.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GradientStop {
    /// Where it lies, 0 to 1.
    pub position: f64,
    /// Linear Rec. 709, each channel 0 to 1.
    pub color: [f32; 3],
}

/// The surface's answer to light.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Surface {
    /// Part of the colour that shows without any light, in [`param::AMBIENT`].
    pub ambient: f64,
    /// Diffuse reflectance, in [`param::DIFFUSE`].
    pub diffuse: f64,
    /// Specular reflectance, in [`param::SPECULAR`].
    pub specular: f64,
    /// Blinn-Phong exponent, in [`param::SHININESS`].
    pub shininess: f64,
    /// What runs through the gradient.
    pub coloring: Coloring,
    /// One to [`MAX_GRADIENT_STOPS`] stops, positions not decreasing; after the last it blends
    /// back to the first.
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
            // The last stop leaves room for the blend back to the first.
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
