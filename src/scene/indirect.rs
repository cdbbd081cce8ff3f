//! Light that reaches a surface by way of others (thesis 4.5, "Global Illumination").

use serde::{Deserialize, Serialize};

use super::param;

/// Which screen-space operator approximates it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum IndirectKind {
    /// None.
    #[default]
    Off,
    /// All around alike, weighted by the normals (thesis eq. 4.1).
    Uniform,
    /// Horizon-based ambient occlusion that carries colour (thesis Algorithm 2).
    Horizon,
}

/// Settings of indirect light.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Indirect {
    /// Which operator; off by default.
    pub kind: IndirectKind,
    /// How far around a point it looks, in [`param::INDIRECT_RADIUS`], as a part of the
    /// picture's height.
    pub radius: f64,
    /// How much of it is added, in [`param::INDIRECT_STRENGTH`].
    pub strength: f64,
    /// Light that comes from nowhere in particular, in [`param::INDIRECT_AMBIENT`]: the ambient
    /// factor of Algorithm 2.
    pub ambient: f64,
    /// Directions of Algorithm 2, in [`param::INDIRECT_DIRECTIONS`].
    pub directions: u32,
    /// Samples a direction of Algorithm 2, or from the middle of eq. 4.1's square to its side, in
    /// [`param::INDIRECT_SAMPLES`].
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
