//! Complete looks. Their lights stay with the camera, so that every view of every shape is lit.

use super::{
    Look, LookList, background,
    elements::{bloom, by_direction, glazed, headlights, matte, metal, sky, sun, tone},
    gradient, srgb, stop,
};
use crate::scene::{
    Bloom, Camera, ColorSource, Coloring, DrivenByLayer, Fog, GradientStop, Lights, SecondLayer,
    Sky, Surface, Tone, ToneCurve,
};

/// What a complete look is called before its name.
pub(super) const KIND: &str = "Look";

/// A look's parts, all of them.
struct Parts {
    gradient: Vec<GradientStop>,
    material: Surface,
    lights: fn(&Camera) -> Lights,
    /// The sRGB colours at the upper and at the lower edge.
    background: [u32; 2],
    fog: Fog,
    tone: Tone,
    bloom: Bloom,
}

impl Default for Parts {
    fn default() -> Self {
        Self {
            gradient: Vec::new(),
            material: Surface::default(),
            lights: |_| Lights::default(),
            background: [0, 0],
            fog: Fog::default(),
            tone: Tone::default(),
            bloom: Bloom::default(),
        }
    }
}

fn look(name: &str, about: &'static str, parts: Parts) -> Look {
    let Parts { gradient, material, lights, background: [top, bottom], fog, tone, bloom } = parts;
    Look {
        name: name.to_owned(),
        about,
        gradient: Some(gradient),
        material: Some(material),
        lights: Some(lights),
        background: Some(background(top, bottom)),
        fog: Some(fog),
        tone: Some((tone, bloom)),
    }
}

/// All complete looks.
pub(super) fn looks() -> LookList {
    LookList {
        name: "Looks",
        about: "Colours, material, light, background and tone by one click. The shape and the view stay.",
        kind: KIND,
        looks: vec![
            porcelain(),
            gold(),
            ember(),
            neon(),
            glacier(),
            copper(),
            beetle(),
            candy(),
            moonlight(),
            desert(),
            jade(),
            abyss(),
            ink(),
            clay(),
            sunset(),
            orchid(),
        ],
    }
}

fn porcelain() -> Look {
    let parts = Parts {
        gradient: gradient(&[0xF7F4EE, 0xFFFFFF, 0xE3EBF4, 0x2E5C9A, 0x16335F, 0xA9C2DC, 0xFFFFFF]),
        material: glazed(0.45, 1.0),
        lights: |_| {
            headlights([
                ([-0.6, 0.7, 0.6], 0xFFF3E4, 2.6),
                ([0.8, 0.2, 0.5], 0xDCE8FF, 0.9),
                ([0.3, 0.6, -0.7], 0xFFFFFF, 1.6),
            ])
        },
        background: [0xC9D3DC, 0x8C99A6],
        tone: tone(ToneCurve::KhronosNeutral, -0.8),
        ..Parts::default()
    };
    look("Porcelain", "White glaze with cobalt blue, in a bright studio", parts)
}

fn gold() -> Look {
    let parts = Parts {
        gradient: gradient(&[0xB0761E, 0xF0B948, 0xFFE08A, 0xD9952B]),
        material: metal(0.42, 0.75),
        lights: |_| {
            headlights([
                ([-0.65, 0.6, 0.55], 0xFFE2B0, 4.2),
                ([0.9, 0.1, 0.3], 0xFFB46A, 1.8),
                ([0.4, 0.5, -0.75], 0xFFF0D0, 4.0),
                ([0.1, -0.7, 0.6], 0xC06A2A, 0.9),
            ])
        },
        background: [0x0B0705, 0x2C1B0F],
        tone: tone(ToneCurve::Aces, -0.2),
        bloom: bloom(0.25, 0.03, 1.2),
        ..Parts::default()
    };
    look("Gold", "Polished gold in a dark, warm room", parts)
}

fn ember() -> Look {
    let glow = SecondLayer {
        coloring: Coloring {
            source: ColorSource::PointTrap,
            follows_view: true,
            ..Coloring::default()
        },
        gradient: vec![
            stop(0.0, 0xFFB040),
            stop(0.07, 0xF05A10),
            stop(0.2, 0x8C1402),
            stop(0.34, 0x000000),
            stop(0.97, 0x000000),
        ],
        ..SecondLayer::default()
    };
    let parts = Parts {
        gradient: gradient(&[0x3A302C, 0x54463F, 0x2A2422, 0x463A36]),
        material: Surface {
            emission: 1.1,
            driven_by_layer: DrivenByLayer { emission: true, ..DrivenByLayer::default() },
            second_layer: glow,
            ..matte(0.02)
        },
        lights: |_| {
            headlights([
                ([-0.6, 0.7, 0.4], 0xFFB48A, 1.5),
                ([0.8, 0.4, -0.5], 0x8FA6C8, 2.4),
                ([0.2, 0.1, 0.9], 0xFF9060, 0.2),
            ])
        },
        background: [0x090505, 0x331008],
        tone: tone(ToneCurve::Aces, 0.2),
        bloom: bloom(0.5, 0.05, 0.6),
        ..Parts::default()
    };
    look("Ember", "Charred rock that glows from within", parts)
}

fn neon() -> Look {
    let parts = Parts {
        gradient: gradient(&[0x2A1550, 0x5A2BB0, 0x38207A, 0x1F5AA8]),
        material: Surface { specular: 0.7, shininess: 50.0, ..Surface::default() },
        lights: |_| {
            headlights([
                ([-0.9, 0.25, -0.1], 0xFF1E9A, 9.0),
                ([0.9, 0.3, -0.15], 0x14E0FF, 8.0),
                ([0.0, 0.9, 0.3], 0x8A4DFF, 3.2),
                ([0.1, 0.1, 1.0], 0xC02AD0, 0.9),
            ])
        },
        background: [0x05030F, 0x1C0A33],
        tone: tone(ToneCurve::KhronosNeutral, -0.2),
        bloom: bloom(0.45, 0.05, 0.7),
        ..Parts::default()
    };
    look("Neon", "Magenta and cyan light on dark lacquer", parts)
}

fn glacier() -> Look {
    let parts = Parts {
        gradient: gradient(&[0x0E4A73, 0x4FA3C7, 0xC9E8F2, 0xFFFFFF, 0x9CCFE2]),
        material: Surface {
            second_layer: by_direction(0.35, &[0x0A3A66, 0x5FB4D6, 0xFFFFFF]),
            ..glazed(0.35, 0.8)
        },
        lights: |_| {
            headlights([
                ([-0.45, 0.75, 0.5], 0xFFFFFF, 2.4),
                ([0.8, 0.3, -0.4], 0x9AD8FF, 2.6),
                ([0.5, -0.3, 0.8], 0x5FA8E0, 0.5),
            ])
        },
        background: [0x4C86AE, 0xC7E0EC],
        tone: tone(ToneCurve::KhronosNeutral, -0.5),
        ..Parts::default()
    };
    look("Glacier", "Blue ice with snow on it, under a clear sky", parts)
}

fn copper() -> Look {
    let parts = Parts {
        gradient: gradient(&[0x6E2F1A, 0xC4643A, 0xF0A878, 0x9C4A2A]),
        material: Surface {
            second_layer: by_direction(0.75, &[0xC4622C, 0xB05A30, 0x7A7A58, 0x3FA890, 0x6FD8BC]),
            ..metal(0.5, 0.35)
        },
        lights: |_| {
            headlights([
                ([-0.6, 0.65, 0.6], 0xFFF0DA, 3.4),
                ([0.85, 0.25, -0.3], 0xFFB07A, 2.8),
                ([0.3, -0.2, 0.9], 0xA8D0C8, 0.4),
            ])
        },
        background: [0x101917, 0x33433F],
        tone: tone(ToneCurve::Aces, -0.2),
        ..Parts::default()
    };
    look("Copper", "Old copper, green with verdigris above", parts)
}

fn beetle() -> Look {
    let parts = Parts {
        gradient: gradient(&[0x0B3A2E, 0x14806A, 0x2B57B8, 0x7A2FA0, 0x1A5E6E]),
        material: Surface {
            coat: 1.0,
            coat_roughness: 0.1,
            second_layer: by_direction(0.6, &[0x7A1FA0, 0x2A4FD0, 0x12A890, 0xB8C43A, 0xE08A2A]),
            ..metal(0.36, 0.6)
        },
        lights: |_| {
            headlights([
                ([-0.55, 0.7, 0.55], 0xFFFFFF, 4.2),
                ([0.85, 0.1, 0.35], 0xBFD8FF, 2.0),
                ([0.2, 0.5, -0.8], 0xE8C8FF, 4.0),
            ])
        },
        background: [0x06090C, 0x1D2A30],
        tone: tone(ToneCurve::KhronosNeutral, 0.0),
        bloom: bloom(0.2, 0.03, 1.0),
        ..Parts::default()
    };
    look("Beetle", "Wing cases that shimmer from violet to gold", parts)
}

fn candy() -> Look {
    let parts = Parts {
        gradient: gradient(&[0xFF8FB0, 0xFFD3DE, 0xFFF6E8, 0xA8E6D4, 0x8FC4F0, 0xD0A8F0]),
        material: glazed(0.5, 0.9),
        lights: |_| {
            headlights([
                ([-0.6, 0.7, 0.6], 0xFFF6EE, 2.3),
                ([0.9, 0.1, 0.4], 0xFFC4DC, 1.0),
                ([0.1, 0.4, -0.9], 0xBFE4FF, 2.0),
                ([0.0, 0.0, 1.0], 0xFFE0F0, 0.3),
            ])
        },
        background: [0xF8C9D6, 0xC7B6EA],
        tone: tone(ToneCurve::KhronosNeutral, -0.4),
        ..Parts::default()
    };
    look("Candy", "Sugar in pink, mint and sky blue", parts)
}

fn moonlight() -> Look {
    let parts = Parts {
        gradient: gradient(&[0x4A5058, 0x8A9098, 0xC8CCD2, 0x666C74]),
        material: Surface { specular: 0.3, shininess: 30.0, ..matte(0.03) },
        lights: |_| {
            headlights([
                ([0.75, 0.65, -0.05], 0xBFD4FF, 3.2),
                ([-0.8, 0.2, -0.5], 0x6A82B8, 1.2),
                ([-0.1, 0.3, 1.0], 0x6A86C8, 0.5),
            ])
        },
        background: [0x04070F, 0x26324A],
        tone: tone(ToneCurve::Aces, 0.3),
        bloom: bloom(0.3, 0.08, 0.5),
        ..Parts::default()
    };
    look("Moonlight", "Cold light from one side in a blue night", parts)
}

fn desert() -> Look {
    let parts = Parts {
        gradient: gradient(&[0x6B3A22, 0xB56A3A, 0xE3B27A, 0xF6DFB8, 0xC98850]),
        material: matte(0.05),
        lights: |_| {
            sky(
                1.0,
                Sky {
                    zenith: srgb(0x5F90D0),
                    horizon: srgb(0xE8D4B8),
                    ground: srgb(0xA8703F),
                    sun_direction: sun([-0.7, 0.45, 0.5]),
                    sun_color: srgb(0xFFE2B0),
                    sun_strength: 2.6,
                    ..Sky::default()
                },
            )
        },
        background: [0x5B8CC8, 0xF0D9B0],
        fog: Fog { density: 0.03, color: srgb(0xF4DDB8), ..Fog::default() },
        tone: tone(ToneCurve::Aces, -0.3),
        ..Parts::default()
    };
    look("Desert", "Sandstone in the low sun of a clear day", parts)
}

fn jade() -> Look {
    let parts = Parts {
        gradient: gradient(&[0x0F4A35, 0x2F8F62, 0x8FD0A0, 0xDFF0D0, 0x4FA878]),
        material: Surface { emission: 0.06, ..glazed(0.4, 1.0) },
        lights: |_| {
            headlights([
                ([-0.6, 0.65, 0.55], 0xFFF8E0, 2.6),
                ([0.7, 0.2, -0.6], 0xA8F0C8, 3.0),
                ([0.4, -0.4, 0.8], 0x4FB890, 0.5),
            ])
        },
        background: [0x10201C, 0x4A6658],
        tone: tone(ToneCurve::KhronosNeutral, -0.3),
        bloom: bloom(0.2, 0.06, 0.6),
        ..Parts::default()
    };
    look("Jade", "Polished green stone, lit from behind", parts)
}

fn abyss() -> Look {
    let glow = SecondLayer {
        coloring: Coloring {
            source: ColorSource::PointTrap,
            follows_view: true,
            ..Coloring::default()
        },
        gradient: vec![
            stop(0.0, 0x000000),
            stop(0.62, 0x000000),
            stop(0.78, 0x06705A),
            stop(0.9, 0x5CFFB0),
            stop(0.97, 0x043A38),
        ],
        ..SecondLayer::default()
    };
    let parts = Parts {
        gradient: gradient(&[0x06282E, 0x0E4E58, 0x1F7A7C, 0x0A383E]),
        material: Surface {
            emission: 1.2,
            driven_by_layer: DrivenByLayer { emission: true, ..DrivenByLayer::default() },
            second_layer: glow,
            specular: 0.4,
            ..Surface::default()
        },
        lights: |_| {
            headlights([
                ([-0.1, 0.95, 0.25], 0x8FE8FF, 1.8),
                ([0.7, -0.1, -0.6], 0x3A5CFF, 2.0),
                ([-0.3, 0.0, 0.95], 0x2A80A0, 0.3),
            ])
        },
        background: [0x0C4A50, 0x010A0C],
        fog: Fog { density: 0.025, color: srgb(0x3FA090), ..Fog::default() },
        tone: tone(ToneCurve::Aces, 0.3),
        bloom: bloom(0.5, 0.06, 0.5),
    };
    look("Abyss", "Living lights in deep water", parts)
}

fn ink() -> Look {
    let parts = Parts {
        gradient: gradient(&[0x14161A, 0xF4F1EA, 0xFFFFFF, 0x2A2C30, 0xF8F5EE]),
        material: Surface { specular: 0.0, ..matte(0.25) },
        lights: |_| {
            headlights([([-0.55, 0.75, 0.5], 0xFFFFFF, 2.2), ([0.8, 0.0, 0.6], 0xFFFFFF, 0.25)])
        },
        background: [0xF7F3EA, 0xE6DFD0],
        tone: tone(ToneCurve::KhronosNeutral, -0.2),
        ..Parts::default()
    };
    look("Ink", "Black bands on white paper", parts)
}

fn clay() -> Look {
    let parts = Parts {
        gradient: gradient(&[0xC09078, 0xD0A48C, 0xB4846C]),
        material: matte(0.02),
        lights: |_| {
            sky(
                0.55,
                Sky {
                    zenith: srgb(0xE0E4EA),
                    horizon: srgb(0xB8B4B0),
                    ground: srgb(0x6A5F58),
                    sun_direction: sun([-0.55, 0.65, 0.5]),
                    sun_color: srgb(0xFFF0E0),
                    sun_strength: 3.6,
                    sun_size_deg: 12.0,
                    ..Sky::default()
                },
            )
        },
        background: [0x8A8078, 0x544A44],
        tone: tone(ToneCurve::Aces, -0.5),
        ..Parts::default()
    };
    look("Clay", "One pale colour: nothing but the shape", parts)
}

fn sunset() -> Look {
    let parts = Parts {
        gradient: gradient(&[0x3B1F4F, 0x9A3F66, 0xF0785A, 0xFFC98A, 0x6A3A78]),
        material: Surface { specular: 0.2, shininess: 25.0, ..Surface::default() },
        lights: |_| {
            headlights([
                ([-0.85, 0.2, 0.3], 0xFF8A3C, 3.6),
                ([0.7, 0.5, 0.3], 0x6A5CD0, 1.4),
                ([0.3, 0.3, -0.9], 0xFF5A6E, 3.0),
                ([0.0, 0.0, 1.0], 0xB080D0, 0.25),
            ])
        },
        background: [0x2A2358, 0xF08A50],
        tone: tone(ToneCurve::Reinhard, 0.1),
        bloom: bloom(0.25, 0.08, 0.8),
        ..Parts::default()
    };
    look("Sunset", "The last orange light against violet shadows", parts)
}

fn orchid() -> Look {
    let parts = Parts {
        gradient: gradient(&[0x4A1542, 0xA0408F, 0xE8A0C8, 0xFFF0F4, 0xC8D890]),
        material: Surface {
            second_layer: by_direction(0.25, &[0x3A6A4A, 0xD070B0, 0xFFF4E0]),
            specular: 0.15,
            shininess: 18.0,
            ..Surface::default()
        },
        lights: |_| {
            headlights([
                ([-0.5, 0.75, 0.55], 0xFFF4E8, 2.5),
                ([0.8, 0.3, -0.4], 0xE0A0FF, 2.2),
                ([0.4, -0.3, 0.85], 0xA8C890, 0.45),
            ])
        },
        background: [0x28402F, 0x0C1710],
        tone: tone(ToneCurve::KhronosNeutral, -0.2),
        bloom: bloom(0.2, 0.06, 0.7),
        ..Parts::default()
    };
    look("Orchid", "Petals in a shaded greenhouse", parts)
}
