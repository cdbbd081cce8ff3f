//! The set as a medium that scatters light inside, instead of a surface.

use serde::{Deserialize, Serialize};

use super::param;

/// What the density of the set's medium follows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum MediumKind {
    /// No medium: the set has a surface.
    #[default]
    None,
    /// Full density at every point of the set, none outside.
    Set,
    /// A cloud about the set, as dense as the smooth iteration count of a point is high.
    Iterations,
}

/// A medium in place of the surface: path tracing draws the set translucent.
///
/// The direct integrator draws the set's surface in the medium's colour.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Medium {
    /// What the density follows.
    pub kind: MediumKind,
    /// Single-scattering albedo: linear Rec. 709, each channel 0 to 1.
    pub color: [f32; 3],
    /// Mean free path at full density, range [`param::MEAN_FREE_PATH`], view units.
    pub mean_free_path: f64,
    /// Mean cosine of scattering (Henyey-Greenstein), range [`param::MEDIUM_ANISOTROPY`]; above 0: forward.
    pub anisotropy: f64,
    /// Of [`MediumKind::Iterations`]: smooth iteration count below which the density is 0, range
    /// [`param::THIN_ITERATIONS`].
    pub thin_iterations: f64,
    /// Of [`MediumKind::Iterations`]: smooth iteration count from which the density is full, range
    /// [`param::DENSE_ITERATIONS`]. In between, the density grows linearly.
    pub dense_iterations: f64,
}

impl Default for Medium {
    fn default() -> Self {
        Self {
            kind: MediumKind::None,
            color: [0.95, 0.9, 0.8],
            mean_free_path: param::MEAN_FREE_PATH.default,
            anisotropy: param::MEDIUM_ANISOTROPY.default,
            thin_iterations: param::THIN_ITERATIONS.default,
            dense_iterations: param::DENSE_ITERATIONS.default,
        }
    }
}
