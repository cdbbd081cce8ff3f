//! Light that spreads around what is bright (thesis 4.5, "Bloom").

use serde::{Deserialize, Serialize};

use super::param;

/// Where in the order of things bloom is added.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum BloomOrder {
    /// To the exposed radiance, before the tone curve, as a lens does.
    Before,
    /// To what the tone curve gave, as in the thesis: some of the saturation that the curve
    /// took comes back.
    #[default]
    After,
}

/// Bloom settings.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Bloom {
    /// How much of the spread light is added, in [`param::BLOOM_STRENGTH`]; 0 is off.
    pub strength: f64,
    /// Before or after the tone curve.
    pub order: BloomOrder,
    /// How far it spreads, in [`param::BLOOM_RADIUS`], as a part of the picture's height.
    pub radius: f64,
    /// Luminance above which light spreads, in [`param::BLOOM_THRESHOLD`].
    pub threshold: f64,
    /// How often the uniform kernel is applied, in [`param::BLOOM_PASSES`].
    pub passes: u32,
}

impl Default for Bloom {
    fn default() -> Self {
        Self {
            strength: param::BLOOM_STRENGTH.default,
            order: BloomOrder::default(),
            radius: param::BLOOM_RADIUS.default,
            threshold: param::BLOOM_THRESHOLD.default,
            passes: param::BLOOM_PASSES.default as u32,
        }
    }
}
