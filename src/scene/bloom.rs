//! Bloom: the soft glow around bright pixels (thesis 4.5, "Bloom").

use serde::{Deserialize, Serialize};

use super::param;

/// Whether bloom is added before or after the tone curve.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum BloomOrder {
    /// Added to the exposed radiance, before the tone curve, as a lens does.
    Before,
    /// Added to the tone curve's output, as in the thesis: restores some of the saturation that
    /// the curve removed.
    #[default]
    After,
}

/// Bloom settings.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Bloom {
    /// Factor on the blurred light, range [`param::BLOOM_STRENGTH`]; 0 is off.
    pub strength: f64,
    /// Before or after the tone curve.
    pub order: BloomOrder,
    /// Radius of the blur, range [`param::BLOOM_RADIUS`], as a fraction of the picture's height.
    pub radius: f64,
    /// Luminance above which pixels bloom, range [`param::BLOOM_THRESHOLD`].
    pub threshold: f64,
    /// Number of box blur passes, range [`param::BLOOM_PASSES`].
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
