//! The gradients that come with the program.

use super::named::{NamedGradient, srgb_stop};

/// Names, positions and sRGB colours. A short dark end sets one repeat apart from the next.
const SPACED: &[(&str, [f64; 5], [u32; 5])] = &[
    ("Dawn", [0.0, 0.25, 0.5, 0.75, 0.9], [0x26394F, 0x5A90AB, 0xF7E7CE, 0xEEAD75, 0x955A5A]),
    ("Moss", [0.0, 0.3, 0.55, 0.78, 0.9], [0x2F463A, 0x7D9B60, 0xE7E1AE, 0xF7F3E4, 0x957F69]),
    ("Ice", [0.0, 0.3, 0.55, 0.78, 0.9], [0x1A3A55, 0x3F94B3, 0xB5E0E8, 0xFBFCFB, 0x7C81AE]),
    ("Ember", [0.0, 0.28, 0.52, 0.75, 0.9], [0x451A26, 0xB84540, 0xF7AD59, 0xFEEFC4, 0x7C506F]),
    ("Stone", [0.0, 0.3, 0.55, 0.78, 0.9], [0x5A5655, 0xAEA399, 0xE7DFD1, 0xF9F7F1, 0x959AA6]),
    ("Orchid", [0.0, 0.28, 0.52, 0.76, 0.9], [0x3F2655, 0x9B59A6, 0xEEB5C8, 0xFDF1E7, 0x6F8CAA]),
    ("Brass", [0.0, 0.3, 0.55, 0.78, 0.9], [0x463A26, 0xAE8C50, 0xF1D795, 0xFEF9E4, 0x6F9090]),
];
/// Names and sRGB colours, evenly spaced.
const EVEN: &[(&str, &[u32])] = &[
    ("Thesis", &[0x590F2A, 0xCE7046, 0xF3C37C, 0xF6E9CF, 0x8998AE]),
    ("Glacier", &[0x0B1F33, 0x14507A, 0x4FA3C7, 0xC9E8F2, 0xFFFFFF, 0x7FB2C9]),
    ("Lagoon", &[0x05303A, 0x0B7A75, 0x7BD3B0, 0xF4F1DE, 0x1B6F8A]),
    ("Deep sea", &[0x020B1A, 0x08264A, 0x0F5C8C, 0x39B0C4, 0xBFF2E4, 0x124A73]),
    ("Aurora", &[0x07122B, 0x0E5E6F, 0x3CCF91, 0xD6F7A3, 0x7A4FBF, 0x2A1F66]),
    ("Fern", &[0x0E1F12, 0x2E6B34, 0x8FBF4D, 0xEAF2B0, 0x5A7A2E]),
    ("Meadow", &[0x254B2A, 0x6FAE4B, 0xF4E285, 0xF4A259, 0xBC4B51, 0x5B8E7D]),
    ("Autumn", &[0x2B1511, 0x7F2A1A, 0xD1621B, 0xF2B33D, 0xF7E7B5, 0x7A4A23]),
    ("Maple", &[0x3B0A0A, 0x9E1B1B, 0xE2582A, 0xF7C36B, 0x8C2F1A]),
    ("Lava", &[0x0A0303, 0x5C0A05, 0xC92C07, 0xFF8A1F, 0xFFE58A, 0x7A1606]),
    ("Furnace", &[0x000000, 0x7A0B00, 0xFF5A00, 0xFFD65C, 0xFFFFFF, 0xFF9F1A, 0x4A0500]),
    ("Copper", &[0x1C0F0A, 0x6E3B22, 0xC47B4A, 0xF3C9A0, 0x3F7A6D, 0x1F4A45]),
    ("Verdigris", &[0x14201E, 0x2F6F66, 0x7FC1AE, 0xD9E8D0, 0xB08D57, 0x5B4426]),
    ("Gold leaf", &[0x2A1B06, 0x8A5A13, 0xE0A526, 0xFFE9A3, 0xFFFBEA, 0xB98220]),
    ("Silver", &[0x1B1E22, 0x5E6770, 0xB4BEC8, 0xF5F7F9, 0x87919C, 0x343A42]),
    ("Pearl", &[0xE8DCD5, 0xF8F4EF, 0xD6E3EA, 0xF3E6EE, 0xFFFDF8, 0xE3EADF]),
    ("Porcelain", &[0xF7F4EE, 0xFFFFFF, 0xBFD3E6, 0x2E5C9A, 0x16335F, 0xA9C2DC]),
    ("Marble", &[0xF2EFEA, 0xD9D4CC, 0xFBFAF8, 0x9C948A, 0xE9E4DC, 0x5C564F]),
    ("Sandstone", &[0x5A3B25, 0xA87446, 0xE3BE8D, 0xF9E8CB, 0xC99A66]),
    ("Canyon", &[0x3A1A17, 0x8F3B2A, 0xD9774B, 0xF2C08A, 0x7B8FA1, 0x3F4F63]),
    ("Coral", &[0x3D1730, 0xB23A5B, 0xFF7F6B, 0xFFD0B0, 0xFFF6EA, 0x5FA8A8]),
    ("Rose", &[0x2E0F1C, 0x8F2A4F, 0xE0718F, 0xFBD3D8, 0xFFF8F5, 0xB04A6A]),
    ("Plum", &[0x170A1F, 0x4E1F5E, 0x9E4A93, 0xE6A6C4, 0xF9E7EC, 0x5C2E73]),
    ("Iris", &[0x120E33, 0x3B2F8F, 0x7F78D8, 0xCFCBF5, 0xF7E9A8, 0x6A4FA3]),
    ("Dusk", &[0x0D1230, 0x3A2A66, 0x9A4A7E, 0xF08A6C, 0xFFD79A, 0x4B3F78]),
    ("Neon", &[0x0A0520, 0x3D0B8C, 0xE0218A, 0xFF9A3C, 0x2FE6DE, 0x1545B8]),
    ("Peacock", &[0x04141F, 0x0B4F6C, 0x0FA3A3, 0x8FD14F, 0xF2D544, 0x204E8A]),
    ("Rainbow", &[0xD1334B, 0xF08A24, 0xF5D93A, 0x52B56A, 0x2C8FC9, 0x6A4CB3]),
    ("Zebra", &[0x111111, 0xF4F4F4, 0x222222, 0xFFFFFF]),
    ("Ink", &[0x0B0D12, 0x1C2430, 0x4A5A70, 0xE8ECF1, 0x2A3444]),
    ("Graphite", &[0x101112, 0x3A3D40, 0x7C8084, 0xC9CCCF, 0x55595D]),
];

/// The gradients that come with the program, in the menu's order. They blend from the last colour to the first.
pub fn library() -> impl Iterator<Item = NamedGradient> {
    let stop = |(position, &color): (f64, &u32)| {
        let [_, rgb @ ..] = color.to_be_bytes();
        srgb_stop(position, rgb.map(|channel| f32::from(channel) / 255.0))
    };
    let spaced = SPACED.iter().map(move |(name, positions, colors)| NamedGradient {
        name: (*name).to_owned(),
        stops: positions.iter().copied().zip(colors).map(stop).collect(),
    });
    let even = EVEN.iter().map(move |(name, colors)| NamedGradient {
        name: (*name).to_owned(),
        stops: (0..).map(|i| f64::from(i) / colors.len() as f64).zip(*colors).map(stop).collect(),
    });
    spaced.chain(even)
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use super::*;
    use crate::scene::{Scene, Surface};

    #[test]
    fn gradients_are_three_dozen_valid_and_different() {
        let all: Vec<_> = library().collect();
        assert!(all.len() >= 36, "{}", all.len());
        let names: HashSet<_> = all.iter().map(|gradient| gradient.name.clone()).collect();
        assert_eq!(names.len(), all.len());
        for (i, gradient) in all.iter().enumerate() {
            let surface = Surface { gradient: gradient.stops.clone(), ..Surface::default() };
            let scene = Scene { surface, ..Scene::default() };
            scene.validate().unwrap_or_else(|error| panic!("{}: {error}", gradient.name));
            assert!(all[..i].iter().all(|other| other.stops != gradient.stops));
        }
    }
}
