//! Where the search for a view's anchor ends, and in how many steps.

use mandelight::{
    fractal::Search,
    scene::{Scene, document},
};
use mandelight_test_support::deep::views::ANCHORS;

/// Most steps of a search: 526 measured.
const MOST_STEPS: u32 = 800;

/// Farthest anchor, in distances from the eye to the pivot, which lies on the surface: 1.0 measured. An anchor behind
/// the surface in view costs digits: it was 112 away from the eye of the sheets.
const FARTHEST: f64 = 1.5;

/// Checks the anchor of what `scene`'s camera sees in a picture that is half as wide again as high.
fn is_near(name: &str, scene: &Scene) {
    let camera = &scene.camera;
    let mut search = Search::new(&scene.fractal, camera, 1.5, None).expect("a search");
    let mut steps = 1;
    let reference = loop {
        if let Some(reference) = search.step() {
            break reference;
        }
        steps += 1;
    };
    let way = (&camera.position - reference.anchor()).length() / camera.view_unit();
    assert!(way < FARTHEST, "{name}: the anchor is {way} away");
    assert!(steps < MOST_STEPS, "{name}: {steps} steps");
}

#[test]
fn anchors_are_on_the_surface_in_view() {
    for anchor in ANCHORS {
        for scale in anchor.scales().filter(|&scale| scale < 1e-5) {
            is_near(
                &format!("power {} {} at {scale:e}", anchor.power, anchor.name),
                &anchor.scene(scale),
            );
        }
    }
}

#[test]
fn rays_that_pass_dust_find_it() {
    for (name, text) in [
        ("sheets", include_str!("../../gpu/hard_views/sheets.json")),
        ("dust", include_str!("../../gpu/hard_views/dust.json")),
    ] {
        is_near(name, &document::from_json(text).expect("a scene"));
    }
}
