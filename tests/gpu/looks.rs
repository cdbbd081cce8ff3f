//! Looks as they are drawn: none is dark, blown out or flat.

use mandelight::{
    render::{Pace, Region},
    scene::{
        looks,
        presets::{Preset, opening_scenes},
    },
};
use mandelight_test_support::view::{finished_in, rgb, sampled};

/// Width and height of the pictures, in pixels.
const SIZE_PX: [u32; 2] = [64, 48];

/// A whole bulb, a near view and another formula.
fn scenes() -> impl Iterator<Item = &'static Preset> {
    let names = ["Mandelbulb", "Coral reef", "Whorls"];
    opening_scenes().iter().filter(move |preset| names.contains(&preset.name))
}

/// Part of the pixels that are black, part that are white, the brightness that a tenth of the pixels exceeds, and the
/// standard deviation of the brightness, each 0 to 1.
fn seen(pixels: &[[u8; 3]]) -> [f64; 4] {
    let part = |is: fn(&[u8; 3]) -> bool| {
        pixels.iter().filter(|pixel| is(pixel)).count() as f64 / pixels.len() as f64
    };
    let grey = |pixel: &[u8; 3]| pixel.iter().map(|v| f64::from(*v)).sum::<f64>() / 765.0;
    let mean = pixels.iter().map(grey).sum::<f64>() / pixels.len() as f64;
    let variance =
        pixels.iter().map(|pixel| (grey(pixel) - mean).powi(2)).sum::<f64>() / pixels.len() as f64;
    let mut sorted: Vec<f64> = pixels.iter().map(grey).collect();
    sorted.sort_by(f64::total_cmp);
    [
        // Backgrounds may be nearly black; surfaces are brighter.
        part(|pixel| pixel.iter().all(|v| *v < 4)),
        part(|pixel| pixel.iter().all(|v| *v > 250)),
        sorted[sorted.len() * 9 / 10],
        variance.sqrt(),
    ]
}

#[test]
fn no_look_is_dark_blown_out_or_flat() {
    let mut faults = Vec::new();
    let mut pictures: Vec<(String, Vec<[u8; 3]>)> = Vec::new();
    for preset in scenes() {
        for look in &looks::lists()[0].looks {
            let scene = sampled(looks::applied(look, &(preset.scene)()), 1);
            let pixels = rgb(&finished_in(&scene, Region::whole(SIZE_PX), Pace::Still));
            let [black, white, bright, deviation] = seen(&pixels);
            let name = format!("{} on {}", look.name, preset.name);
            println!("{name}: {black:.3} {white:.3} {bright:.3} {deviation:.3}");
            if black > 0.3 || white > 0.05 || bright < 0.3 || deviation < 0.06 {
                faults.push(format!("{name}: {black:.3}, {white:.3}, {bright:.3}, {deviation:.3}"));
            }
            pictures.push((name, pixels));
        }
    }
    assert!(faults.is_empty(), "{faults:#?}");
    // The looks of one scene differ: 16 pictures each.
    for one in pictures.chunks(looks::lists()[0].looks.len()) {
        for (i, (name, a)) in one.iter().enumerate() {
            for (other, b) in &one[..i] {
                let sum: f64 = a
                    .iter()
                    .flatten()
                    .zip(b.iter().flatten())
                    .map(|(a, b)| f64::from(a.abs_diff(*b)))
                    .sum();
                let apart = sum / (3 * a.len()) as f64;
                assert!(apart > 8.0, "{name} and {other} are {apart:.1} of 255 apart");
            }
        }
    }
}
