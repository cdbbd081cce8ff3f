//! Surprises as they look: none is blank, dark or flat.

use mandelight::{
    fractal::Surprise,
    render::{Pace, Region},
    scene::{Background, Scene},
};
use mandelight_test_support::view::{finished_in, rgb, sampled};

/// Width and height of the pictures in pixels, on a desktop and on a phone.
const SIZES_PX: [[u32; 2]; 2] = [[48, 32], [26, 48]];

/// Seeds of each size.
const SEEDS: u64 = 100;

/// Brightness of a pixel, 0 to 1, as encoded.
fn grey([r, g, b]: [u8; 3]) -> f64 {
    (f64::from(r) + f64::from(g) + f64::from(b)) / 765.0
}

/// Fraction of the pixels that show the surface, their mean brightness, and its standard deviation.
fn seen(scene: &Scene, size_px: [u32; 2]) -> [f64; 3] {
    let drawn =
        |scene: Scene| rgb(&finished_in(&sampled(scene, 1), Region::whole(size_px), Pace::Still));
    // On two backgrounds, what differs is background.
    let on = |color: [f32; 3]| {
        drawn(Scene { background: Background::gradient(color, color), ..scene.clone() })
    };
    let (black, white) = (on([0.0; 3]), on([1.0; 3]));
    let surface: Vec<f64> =
        black.iter().zip(&white).filter(|(a, b)| a == b).map(|(a, _)| grey(*a)).collect();
    let count = surface.len() as f64;
    let mean = surface.iter().sum::<f64>() / count.max(1.0);
    let variance = surface.iter().map(|grey| (grey - mean).powi(2)).sum::<f64>() / count.max(1.0);
    [count / black.len() as f64, mean, variance.sqrt()]
}

#[test]
fn no_surprise_is_blank_dark_or_flat() {
    for size_px in SIZES_PX {
        let faults: Vec<String> = (0..SEEDS)
            .filter_map(|seed| {
                let scene = Surprise::new(seed).finish();
                let [surface, mean, deviation] = seen(&scene, size_px);
                let is_fine = surface > 0.1 && mean > 0.15 && deviation > 0.03;
                let name = scene.fractal.formula().id();
                (!is_fine)
                    .then(|| format!("seed {seed}, {name}: {surface:.2} {mean:.3} {deviation:.3}"))
            })
            .collect();
        assert!(faults.is_empty(), "{size_px:?}: {faults:#?}");
    }
}
