//! How much work a picture is given.

use serde::{Deserialize, Serialize};

use super::param;

/// How the surface's normals are found (thesis 3.2, figure 3.3). The grid's spacing is the hit
/// distance, about the pixel's radius on the surface; `docs/normals.md` has each one's error.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Normals {
    /// None: every point that light reaches counts as facing it (figure 3.3 a).
    None,
    /// Differences to the next grid point along each axis (b).
    Three,
    /// Differences across the point along each axis (c), the thesis's choice.
    Six,
    /// The gradient that fits the 18 grid points nearest best (d): faces and edges of a cube.
    Eighteen,
    /// The same of all 26 around it (e): corners too.
    TwentySix,
    /// The distance estimate's own gradient, exactly.
    #[default]
    Analytic,
}

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
    /// How normals are found.
    pub normals: Normals,
}

impl Default for Quality {
    fn default() -> Self {
        Self {
            motion_budget_ms: param::MOTION_BUDGET.default,
            samples: param::SAMPLES.default as u32,
            shadows: true,
            detail: param::DETAIL.default,
            normals: Normals::default(),
        }
    }
}
