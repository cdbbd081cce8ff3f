//! How scene radiance becomes display values (thesis 4.5, "High Dynamic Range Rendering").

use serde::{Deserialize, Serialize};

use super::param;

/// The curve from exposed radiance to what the display shows. `docs/tone.md` has the equations.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ToneCurve {
    /// None: values above 1 are cut off.
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

/// What Reinhard's curve is applied to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ToneChannels {
    /// The luminance: colours keep their hue and saturation.
    #[default]
    Luminance,
    /// Red, green and blue each: bright colours go toward white.
    PerChannel,
}

/// Which mean of the film auto exposure goes by.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ToneMean {
    /// The luminance of the mean colour, as in the thesis.
    Arithmetic,
    /// The mean of the luminance's logarithm, Reinhard et al. 2002, eq. 1: a few bright spots
    /// weigh little.
    #[default]
    Logarithmic,
}

/// Tone settings.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Tone {
    /// Stops added before the curve, in [`param::EXPOSURE`].
    pub exposure: f64,
    /// Whether the film's mean is first brought to [`Self::key`].
    pub auto_exposure: bool,
    /// The mean that this goes by.
    pub mean: ToneMean,
    /// What the mean is brought to, in [`param::KEY`].
    pub key: f64,
    /// The curve.
    pub curve: ToneCurve,
    /// What Reinhard's curve is applied to.
    pub channels: ToneChannels,
    /// Exposed luminance that becomes white, in [`param::WHITE_POINT`].
    pub white_point: f64,
}

impl Tone {
    /// The exposed luminance of a grey that the display shows as white, to within a step of
    /// 1/255: where the curve reaches 1, or comes as near to it.
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
