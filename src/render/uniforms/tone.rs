//! The uniforms of tone, bloom and display.

use super::{Bloom, Inputs, Tone};
use crate::{
    render::display_values::DisplayValues,
    scene::{self, BloomOrder, ToneChannels, ToneCurve, ToneMean},
};

/// The tone settings, for a display of 8 bits per channel.
pub fn tone(tone: &scene::Tone) -> Tone {
    Tone {
        exposure: tone.exposure.exp2() as f32,
        inverse_white_squared: tone.white_point.powi(-2) as f32,
        curve: match tone.curve {
            ToneCurve::Linear => 0,
            ToneCurve::Reinhard => 1,
            ToneCurve::Aces => 2,
            ToneCurve::Agx => 3,
            ToneCurve::KhronosNeutral => 4,
        },
        per_channel: u32::from(tone.channels == ToneChannels::PerChannel),
        auto_exposure: u32::from(tone.auto_exposure),
        logarithmic: u32::from(tone.mean == ToneMean::Logarithmic),
        key: tone.key as f32,
        is_deep: 0,
    }
}

/// The bloom settings.
pub fn bloom(bloom: &scene::Bloom) -> Bloom {
    Bloom {
        strength: bloom.strength as f32,
        radius: bloom.radius as f32,
        threshold: bloom.threshold as f32,
        after: u32::from(bloom.order == BloomOrder::After),
        passes: bloom.passes,
    }
}

impl Inputs {
    /// The inputs of a display picture of `scene` that holds `values`.
    pub fn with_display_values(mut self, scene: &scene::Scene, values: DisplayValues) -> Self {
        self.frame.tone.is_deep = u32::from(values.is_deep);
        if values.is_transparent {
            let sub_frames = self.sub_frame.map_or(1, |sub_frame| sub_frame.count);
            let samples = u64::from(scene.quality.samples) * u64::from(sub_frames);
            self.frame.background.transparent_samples = samples as f32;
        }
        self
    }
}
