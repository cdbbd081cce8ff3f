//! Quality settings: samples, shadows, detail and normals.

use serde::{Deserialize, Serialize};

use super::param;

/// The method that computes surface normals (thesis 3.2, figure 3.3).
///
/// The grid's spacing is the hit distance, about the pixel's radius on the surface.
/// `docs/normals.md` lists the error of each method.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Normals {
    /// No normals: every lit point counts as facing the light (figure 3.3 a).
    None,
    /// Forward differences along each axis (b).
    Three,
    /// Central differences along each axis (c), the thesis's choice.
    Six,
    /// Best fit of a gradient to 18 neighbours (d): faces and edges of a cube.
    Eighteen,
    /// Best fit of a gradient to 26 neighbours (e): faces, edges and corners of a cube.
    TwentySix,
    /// The exact gradient of the distance estimate.
    #[default]
    Analytic,
}

/// Quality settings of a scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Quality {
    /// GPU time of a frame during motion, range [`param::MOTION_BUDGET`], milliseconds.
    pub motion_budget_ms: f64,
    /// Jittered samples per pixel at rest, range [`param::SAMPLES`].
    pub samples: u32,
    /// False switches off the shadows of all lights.
    pub shadows: bool,
    /// Hit distance in cone radii of a pixel, range [`param::DETAIL`].
    pub detail: f64,
    /// The method that computes normals.
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
