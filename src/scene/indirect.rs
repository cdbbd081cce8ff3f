//! Indirect light: light reflected from other surfaces (thesis 4.5, "Global Illumination").

use serde::{Deserialize, Serialize};

use super::param;

/// The screen-space operator that approximates indirect light.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum IndirectKind {
    /// No indirect light.
    #[default]
    Off,
    /// Uniform sampling of a square, weighted by the normals (thesis eq. 4.1).
    Uniform,
    /// Horizon-based ambient occlusion with colour (thesis Algorithm 2).
    Horizon,
}

/// Settings of indirect light.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Indirect {
    /// The operator; off by default.
    pub kind: IndirectKind,
    /// Sampling radius around a pixel, range [`param::INDIRECT_RADIUS`], as a fraction of the
    /// picture's height.
    pub radius: f64,
    /// Factor on the indirect light, range [`param::INDIRECT_STRENGTH`].
    pub strength: f64,
    /// The ambient factor of Algorithm 2, range [`param::INDIRECT_AMBIENT`].
    pub ambient: f64,
    /// Directions of Algorithm 2, range [`param::INDIRECT_DIRECTIONS`].
    pub directions: u32,
    /// Samples per direction of Algorithm 2, or from the centre of eq. 4.1's square to a side;
    /// range [`param::INDIRECT_SAMPLES`].
    pub samples: u32,
}

impl Default for Indirect {
    fn default() -> Self {
        Self {
            kind: IndirectKind::Off,
            radius: param::INDIRECT_RADIUS.default,
            strength: param::INDIRECT_STRENGTH.default,
            ambient: param::INDIRECT_AMBIENT.default,
            directions: param::INDIRECT_DIRECTIONS.default as u32,
            samples: param::INDIRECT_SAMPLES.default as u32,
        }
    }
}
