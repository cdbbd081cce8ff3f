//! The tone curves of small previews, against the curves from their definitions.

use glam::DVec3;
use mandelight::scene::{Tone, ToneChannels, ToneCurve};
use mandelight_test_support::{oracle::tone::curve, random::Random};

#[test]
fn previews_have_the_tone_curves_of_pictures() {
    let curves = [
        (ToneCurve::Linear, ToneChannels::Luminance),
        (ToneCurve::Reinhard, ToneChannels::Luminance),
        (ToneCurve::Reinhard, ToneChannels::PerChannel),
        (ToneCurve::Aces, ToneChannels::Luminance),
        (ToneCurve::Agx, ToneChannels::Luminance),
        (ToneCurve::KhronosNeutral, ToneChannels::Luminance),
    ];
    let mut random = Random(7);
    for (curve_kind, channels) in curves {
        let tone = Tone { curve: curve_kind, channels, white_point: 2.5, ..Tone::default() };
        for _ in 0..500 {
            // From black to far above white.
            let mut channel = || (random.unit() * 14.0 - 9.0).exp2();
            let light = DVec3::new(channel(), channel(), channel());
            let difference = (tone.displayed(light) - curve(&tone, light)).abs().max_element();
            assert!(difference < 2e-3, "{curve_kind:?} of {light}: {difference}");
        }
        assert_eq!(tone.displayed(DVec3::ZERO).max_element().max(0.01), 0.01);
    }
}
