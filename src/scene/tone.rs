//! Tone settings: exposure and tone curve (thesis 4.5, "High Dynamic Range Rendering").

use serde::{Deserialize, Serialize};

use super::param;

/// The curve from exposed radiance to display values; `docs/tone.md` has the equations.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ToneCurve {
    /// No curve: values above 1 are clipped.
    Linear,
    /// Reinhard et al. 2002, eq. 4, which the thesis chose.
    #[default]
    #[serde(alias = "reinhard_luminance")]
    Reinhard,
    /// Hill's fit of the ACES reference and output transforms.
    Aces,
    /// AgX (Sobotka): a sigmoid of the logarithm, between an inset and an outset of the primaries.
    Agx,
    /// The Khronos PBR Neutral tone mapper: colours below the highlights stay as they are.
    KhronosNeutral,
}

/// The quantity that Reinhard's curve maps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ToneChannels {
    /// The luminance: colours keep their hue and saturation.
    #[default]
    Luminance,
    /// Each of red, green and blue: bright colours shift toward white.
    PerChannel,
}

/// The mean of the film that auto exposure uses.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ToneMean {
    /// The luminance of the mean colour, as in the thesis.
    Arithmetic,
    /// The mean of the luminance's logarithm (Reinhard et al. 2002, eq. 1): small bright spots
    /// have little influence.
    #[default]
    Logarithmic,
}

/// Tone settings.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Tone {
    /// Exposure before the curve, range [`param::EXPOSURE`], stops.
    pub exposure: f64,
    /// True scales the film's mean to [`Self::key`] before the exposure.
    pub auto_exposure: bool,
    /// The mean that auto exposure uses.
    pub mean: ToneMean,
    /// Target of auto exposure for the mean, range [`param::KEY`].
    pub key: f64,
    /// The tone curve.
    pub curve: ToneCurve,
    /// The quantity that Reinhard's curve maps.
    pub channels: ToneChannels,
    /// Exposed luminance that Reinhard's curve maps to white, range [`param::WHITE_POINT`].
    pub white_point: f64,
}

impl Tone {
    /// Exposed luminance of the darkest grey that displays as white, within 1/255.
    pub fn white(&self) -> f64 {
        match self.curve {
            ToneCurve::Linear => 1.0,
            ToneCurve::Reinhard => self.white_point,
            ToneCurve::Aces => 15.4,
            ToneCurve::Agx => 0.18 * 6.5_f64.exp2(),
            ToneCurve::KhronosNeutral => 7.5,
        }
    }
}

impl Default for Tone {
    fn default() -> Self {
        Self {
            exposure: param::EXPOSURE.default,
            auto_exposure: false,
            mean: ToneMean::default(),
            key: param::KEY.default,
            curve: ToneCurve::default(),
            channels: ToneChannels::default(),
            white_point: param::WHITE_POINT.default,
        }
    }
}
