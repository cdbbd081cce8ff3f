//! The iterations of views about an anchor.

use mandelight::{
    formula::{
        Fractal,
        mandelbulb::{Mandelbulb, deep::iterations_for},
    },
    fractal::Search,
    scene::{Scene, document},
};
use mandelight_test_support::deep::views::ANCHORS;

/// A pixel's radius over the distance from the eye.
const CONE: f64 = 1e-3;

/// Iterations by the power alone, and about the anchor that the scene's view has.
fn iterations(scene: &Scene, footprint: f64) -> (u32, u32) {
    let fractal: &Fractal = &scene.fractal;
    let search = Search::new(fractal, &scene.camera, 1.5, None).expect("a whole power");
    let about = search.finish().iterations_for(fractal, footprint);
    (iterations_for(&Mandelbulb::of(fractal), footprint), about)
}

#[test]
fn an_anchor_never_takes_iterations_away() {
    for anchor in ANCHORS {
        for scale in anchor.scales().filter(|&scale| scale < 1e-3) {
            let scene = anchor.scene(scale);
            let (by_power, about) = iterations(&scene, CONE * scale);
            assert!(about >= by_power, "{} {} at {scale:e}", anchor.power, anchor.name);
            assert_eq!(iterations(&scene, 1e-2).1, scene.fractal.iterations);
        }
    }
}

#[test]
fn orbits_that_separate_slowly_have_more() {
    let scene = document::from_json(include_str!("../../gpu/hard_views/slow_orbits.json"))
        .expect("a scene");
    let (by_power, about) = iterations(&scene, 3e-27);
    assert!(about > by_power, "{about} of {by_power}");
}

/// dr is 1e3 after 25 steps only; points of the surface escape after 40 or 41.
#[test]
fn orbits_that_are_slow_from_the_start_have_enough() {
    let scene = document::from_json(include_str!("../../gpu/hard_views/slow_from_the_start.json"))
        .expect("a scene");
    let (by_power, about) = iterations(&scene, 6e-13);
    assert!(by_power < 40 && about > 41, "{about} of {by_power}");
}
