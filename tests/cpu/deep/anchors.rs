//! Where the search for a view's anchor ends, and in how many steps.

use glam::DVec3;
use mandelight::{
    formula::march::{COARSEST_FOOTPRINT, DEEP_FOOTPRINT},
    fractal::{FractalModel, Search, ndc_of, pixel_cone},
    render::{Region, space::wants_anchor},
    scene::{Scene, document},
};
use mandelight_test_support::deep::views::ANCHORS;

/// Width over height of the pictures.
const ASPECT: f64 = 1.5;

/// Most steps of a search: 589 measured.
const MOST_STEPS: u32 = 900;

/// Farthest anchor, in distances from the eye to the pivot, which lies on the surface: 1.0 measured. An anchor behind
/// the surface in view costs digits: that of `sheets.json` was 112 such distances away.
const FARTHEST: f64 = 1.5;

/// Largest distance from an anchor to the surface, over that from the eye to the anchor.
const OFF_THE_SURFACE: f64 = 1e-6;

/// Asserts that the anchor of `scene` is in view, on the surface, and found in few steps.
fn assert_anchor_in_view(name: &str, scene: &Scene) {
    let Scene { fractal, camera, .. } = scene;
    let mut search = Search::new(fractal, camera, ASPECT, None).expect("a search");
    let anchor = (0..MOST_STEPS).find_map(|_| search.step());
    let reference = anchor.unwrap_or_else(|| panic!("{name}: no anchor in {MOST_STEPS} steps"));
    let way = reference.anchor() - &camera.position;
    let far = way.length() / camera.view_unit();
    assert!(far < FARTHEST, "{name}: the anchor is {far} away");
    let ndc = ndc_of(camera, way, ASPECT);
    let is_in_view = ndc.is_some_and(|ndc| ndc.abs().max_element() <= 1.0);
    assert!(is_in_view, "{name}: it is at {ndc:?}");
    let field = fractal.field_about(reference, DEEP_FOOTPRINT, DEEP_FOOTPRINT);
    let off = field.distance(DVec3::ZERO) / way.length();
    assert!(off < OFF_THE_SURFACE, "{name}: it is {off} off the surface");
}

#[test]
fn anchors_are_on_the_surface_in_view() {
    for anchor in ANCHORS {
        for scale in anchor.scales().filter(|&scale| scale < 1e-5) {
            let name = format!("power {} {} at {scale:e}", anchor.power, anchor.name);
            assert_anchor_in_view(&name, &anchor.scene(scale));
        }
    }
}

#[test]
fn rays_that_pass_dust_find_it() {
    for (name, text) in [
        ("sheets", include_str!("../../gpu/hard_views/sheets.json")),
        ("dust", include_str!("../../gpu/hard_views/dust.json")),
    ] {
        assert_anchor_in_view(name, &document::from_json(text).expect("a scene"));
    }
}

/// Power 2 at 2e-5 and 3e-7: the rays pass all dust near the eye, and their nearest hit is 176 and 900 times as far away as
/// the pivot. In the second view the estimate at the eye is larger than that.
#[test]
fn an_anchor_in_dust_that_all_rays_pass_is_near_the_eye() {
    for text in
        [include_str!("dust_passed.json"), include_str!("../../gpu/hard_views/passed_dust.json")]
    {
        let scene = document::from_json(text).expect("a scene");
        let search = Search::new(&scene.fractal, &scene.camera, ASPECT, None).expect("a search");
        let way = search.finish().anchor() - &scene.camera.position;
        let far = way.length() / scene.camera.view_unit();
        assert!((0.1..FARTHEST).contains(&far), "the anchor is {far} away");
    }
}

/// Dust 3e-14 away: the estimate at the eye is 8.5e-11, and rays with a first leap of a part of that found an anchor 1.3e-9
/// away.
#[test]
fn rays_find_dust_far_nearer_than_the_estimate_at_the_eye() {
    let text = include_str!("../../gpu/hard_views/near_dust.json");
    let scene = document::from_json(text).expect("a scene");
    let search = Search::new(&scene.fractal, &scene.camera, ASPECT, None).expect("a search");
    let far = (search.finish().anchor() - &scene.camera.position).length();
    assert!(far < 1e-13, "the anchor is {far:e} away");
}

/// Power 9, 2.1e-6 from the pivot: the estimate at the eye is 8.5 times the depth of the nearest hit.
#[test]
fn a_view_whose_estimate_at_the_eye_is_too_large_wants_an_anchor() {
    let text = include_str!("../../gpu/hard_views/overestimated.json");
    let scene = document::from_json(text).expect("a scene");
    let model = FractalModel::new(&scene.fractal);
    let region = Region::whole([36, 24]);
    let cone = pixel_cone(&scene.camera, region.aspect(), 24.0);
    assert!(model.clear_distance(&scene.camera.position) * cone > COARSEST_FOOTPRINT);
    assert!(wants_anchor(&model, &scene, region));
}
