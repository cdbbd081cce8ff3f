//! Gradient files of other programs.

use mandelight::scene::{MAX_GRADIENT_STOPS, Scene, gradient};

use crate::{FuzzTarget, InputFormat, Outcome, promises::refused};

pub const TARGET: FuzzTarget = FuzzTarget {
    name: "gradient",
    check,
    seeds,
    format: InputFormat::Words,
    hundreds: 60,
    most_work: 64 << 20,
};

fn check(bytes: &[u8]) -> Outcome {
    let found = match gradient::read(bytes, "name") {
        Ok(found) => found,
        Err(error) => return refused(&error),
    };
    assert!(!found.is_empty(), "no gradient and no error");
    for named in found {
        assert!((1..=MAX_GRADIENT_STOPS).contains(&named.stops.len()), "{}", named.stops.len());
        for stop in &named.stops {
            assert!(stop.color.iter().all(|channel| (0.0..=1.0).contains(channel)), "{stop:?}");
        }
        let mut scene = Scene::default();
        scene.surface.gradient = named.stops;
        scene.validate().expect("a gradient that was read is valid");
    }
    Outcome::Read
}

fn seeds() -> Vec<Vec<u8>> {
    let segments = "GIMP Gradient\nName: Two\n3\n\
        0.0 0.1 0.3 1 0 0 1 0 1 0 1 0 0\n\
        0.3 0.5 0.6 0 1 0 1 0 0 1 1 1 2 0 0\n\
        0.6 0.9 1.0 0 0 1 1 0.2 0.3 0.4 1 4 1 0 0\n";
    let palette = "GIMP Palette\nName: Two tones\nColumns: 2\n# made by hand\n  0 128 255\tSky\n255 128   0\n";
    let map: String = (0..24).map(|i| format!("{} {} 40 comment\n", i * 10, 255 - i * 9)).collect();
    let ultra = "first {\ngradient:\n  title=\"First\" smooth=no\n  index=0 color=255\n  index=200 color=65280\n\
        opacity:\n  smooth=no index=0 opacity=255\n}\nsecond {\ngradient:\n  index=-30 color=16711680 ; comment\n\
        index=399 color=8\n}\n";
    [segments, palette, &map, ultra].map(|text| text.as_bytes().to_vec()).into()
}
