//! Fog: air that scatters light.

use serde::{Deserialize, Serialize};

use super::param;

/// Fog in a ball about the camera's pivot.
///
/// Its lengths are view units, so that fog looks the same at every depth. The direct integrator lights fog evenly;
/// path tracing adds shadows in fog, and shafts of light.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Fog {
    /// Extinction coefficient, range [`param::FOG_DENSITY`], per view unit; 0: no fog.
    pub density: f64,
    /// Single-scattering albedo: linear Rec. 709, each channel 0 to 1.
    pub color: [f32; 3],
    /// Mean cosine of scattering (Henyey-Greenstein), range [`param::FOG_ANISOTROPY`]; above 0: forward.
    pub anisotropy: f64,
    /// Scale height: range [`param::FOG_HEIGHT`], view units; none for fog of the same density everywhere.
    ///
    /// Above [`Self::level`] the density falls by the factor e over this height; height is along the world's +Z.
    pub height: Option<f64>,
    /// Height over the pivot up to which the density is full, range [`param::FOG_LEVEL`], view units.
    pub level: f64,
    /// Radius of the fog, range [`param::FOG_RADIUS`], view units.
    pub radius: f64,
}

impl Default for Fog {
    fn default() -> Self {
        Self {
            density: param::FOG_DENSITY.default,
            color: [1.0; 3],
            anisotropy: param::FOG_ANISOTROPY.default,
            height: None,
            level: param::FOG_LEVEL.default,
            radius: param::FOG_RADIUS.default,
        }
    }
}
