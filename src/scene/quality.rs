//! How much work a picture is given.

use serde::{Deserialize, Serialize};

use super::param;

/// Work per picture.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Quality {
    /// GPU time of a frame while something moves, in [`param::MOTION_BUDGET`], milliseconds.
    pub motion_budget_ms: f64,
    /// Jittered samples a pixel averages at rest, in [`param::SAMPLES`].
    pub samples: u32,
    /// Whether any light casts shadows.
    pub shadows: bool,
    /// Hit distance in cone radii of a pixel, in [`param::DETAIL`].
    pub detail: f64,
}

impl Default for Quality {
    fn default() -> Self {
        Self {
            motion_budget_ms: param::MOTION_BUDGET.default,
            samples: param::SAMPLES.default as u32,
            shadows: true,
            detail: param::DETAIL.default,
        }
    }
}
