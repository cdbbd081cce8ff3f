//! Parts of looks on their own, to mix.

use super::{Look, LookList, background};
use crate::scene::{
    Bloom, BloomOrder, Tone, ToneChannels, ToneCurve, gradient, light_setups::SETUPS,
};

/// The gradients that come with the program.
pub(super) fn colors() -> LookList {
    let looks = gradient::library().map(|gradient| Look {
        name: gradient.name,
        about: "Colours the surface with this gradient",
        gradient: Some(gradient.stops),
        ..Look::default()
    });
    LookList {
        name: "Colours",
        about: "Gradients for the surface",
        kind: "Colours",
        looks: looks.collect(),
    }
}

/// The light setups.
pub(super) fn lights() -> LookList {
    let looks = SETUPS.into_iter().map(|setup| Look {
        name: setup.name.to_owned(),
        about: setup.about,
        lights: Some(setup.lights),
        ..Look::default()
    });
    LookList {
        name: "Lights",
        about: "Lights placed for the present view. They turn with the camera, but Candle's lamp stays in place",
        kind: "Light",
        looks: looks.collect(),
    }
}

/// Names, what they look like, and the sRGB colours at the upper and at the lower edge.
const BACKGROUNDS: &[(&str, &str, u32, u32)] = &[
    ("Black", "Nothing but black", 0x000000, 0x000000),
    ("Night", "Deep blue, a little lighter below", 0x05070D, 0x1A2233),
    ("Slate", "Dark grey-blue", 0x20262E, 0x4A5562),
    ("Studio", "Neutral grey, as a paper roll in a studio", 0x8C8F93, 0x4B4E52),
    ("Paper", "As white as the tone allows", 0xFFFFFF, 0xF3EEE4),
    ("Dawn", "Blue above, peach below", 0x5D7FA8, 0xF6C7A0),
    ("Dusk", "Violet above, orange below", 0x1E1A45, 0xD9784A),
    ("Sky", "A clear day", 0x3F7FC4, 0xD6E8F5),
    ("Storm", "Grey-green clouds", 0x2C3A3F, 0x8C9A96),
    ("Deep sea", "Light from above that fades to dark water", 0x1B7C8E, 0x031019),
    ("Forest", "Dark green shade", 0x0A1A12, 0x3F5F3A),
    ("Rose", "Pale pink above, wine below", 0xE9B7BC, 0x5B2238),
    ("Sand", "Warm light ochre", 0xE9D8B4, 0xB58A5A),
    ("Furnace", "Black above, embers below", 0x0B0302, 0x7A1E08),
];

/// Vertical gradients behind the fractal.
pub(super) fn backgrounds() -> LookList {
    let looks = BACKGROUNDS.iter().map(|&(name, about, top, bottom)| Look {
        name: name.to_owned(),
        about,
        background: Some(background(top, bottom)),
        ..Look::default()
    });
    LookList {
        name: "Backgrounds",
        about: "Colours behind the fractal",
        kind: "Background",
        looks: looks.collect(),
    }
}

/// Exposures and tone curves with their bloom.
pub(super) fn tones() -> LookList {
    let plain = Bloom::default();
    let curve = |curve, exposure| Tone { curve, exposure, ..Tone::default() };
    let glow = |strength, radius, threshold| Bloom { strength, radius, threshold, ..plain.clone() };
    let tones = [
        ("Natural", "The tone of new scenes", Tone::default(), plain.clone()),
        (
            "Film",
            "Strong contrast, whites that roll off",
            curve(ToneCurve::Aces, -0.3),
            plain.clone(),
        ),
        ("Soft", "Little contrast, pale highlights", curve(ToneCurve::Agx, 0.4), plain.clone()),
        ("Vivid", "Full, saturated colours", curve(ToneCurve::KhronosNeutral, -0.4), plain.clone()),
        (
            "Bright",
            "Contrast of the Reinhard curve, exposure +1 stop",
            curve(ToneCurve::Reinhard, 1.0),
            plain.clone(),
        ),
        (
            "Dark",
            "Deep shadows: Film, one stop darker",
            curve(ToneCurve::Aces, -1.3),
            plain.clone(),
        ),
        (
            "Faded",
            "Bright colours go white, as in an old print",
            Tone {
                channels: ToneChannels::PerChannel,
                white_point: 1.6,
                ..curve(ToneCurve::Reinhard, 0.6)
            },
            plain.clone(),
        ),
        (
            "Dream",
            "A wide glow around everything that is light",
            curve(ToneCurve::Agx, 0.5),
            Bloom { order: BloomOrder::Before, ..glow(0.35, 0.06, 0.25) },
        ),
        (
            "Sparkle",
            "A small glow around highlights",
            curve(ToneCurve::Reinhard, 0.0),
            Bloom { order: BloomOrder::Before, ..glow(0.9, 0.02, 0.7) },
        ),
    ];
    let looks = tones.into_iter().map(|(name, about, tone, bloom)| Look {
        name: name.to_owned(),
        about,
        tone: Some((tone, bloom)),
        ..Look::default()
    });
    LookList {
        name: "Tones",
        about: "Brightness, contrast and glow",
        kind: "Tone",
        looks: looks.collect(),
    }
}
