//! How scene radiance becomes display values (thesis 4.5, "High Dynamic Range Rendering").

use serde::{Deserialize, Serialize};

use super::param;

/// The curve from exposed radiance to display luminance.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ToneCurve {
    /// None: values above 1 are cut off.
    Linear,
    /// Reinhard et al. 2002, eq. 4, applied to luminance.
    #[default]
    ReinhardLuminance,
}

/// Tone settings.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Tone {
    /// Stops added before the curve, in [`param::EXPOSURE`].
    pub exposure: f64,
    /// The curve.
    pub curve: ToneCurve,
    /// Exposed luminance that becomes white, in [`param::WHITE_POINT`].
    pub white_point: f64,
}

impl Default for Tone {
    fn default() -> Self {
        Self {
            exposure: param::EXPOSURE.default,
            curve: ToneCurve::default(),
            white_point: param::WHITE_POINT.default,
        }
    }
}
