//! Descents to places: turning the wheel alone leads to the depths, and never loses the surface.

use std::sync::Arc;

use egui::{Event, Modifiers, PointerButton};
use egui_kittest::kittest::Queryable as _;
use glam::DVec2;
use mandelight::{
    formula::{DistanceField, mandelbulb::Mandelbulb},
    fractal::{FractalModel, camera_ray},
    gpu::device::in_parallel,
    scene::{Camera, Scene},
    ui::{
        Settings,
        navigation::{
            World,
            guide::{Guide, GuideStatus},
        },
    },
};
use mandelight_test_support::{
    deep::{
        arithmetic::{Number, Real},
        orbit::Set,
    },
    descent::{NOTCH, VIEWPORT, sixteen_pixels, wheel_in},
};

use crate::stage::{pointer, scene, stage, wheel};

/// The field about the point that `camera` looks at.
fn field_about_pivot(scene: &Scene, camera: &Camera) -> Arc<dyn DistanceField> {
    let formula = scene.fractal.formula();
    let steps = formula.begin_reference(&scene.fractal, camera.pivot.clone());
    let reference = steps.expect("a whole power").finish();
    let grain = 1e-4 * camera.view_unit();
    reference.distance_field(&scene.fractal, grain, grain)
}

/// The part of nine rays that hit the surface within thirty view units.
fn surface_in_view(field: &dyn DistanceField, camera: &Camera) -> f64 {
    let rays = (0..9).map(|i| DVec2::new(f64::from(i % 3) - 1.0, f64::from(i / 3) - 1.0) * 0.6);
    let hits = rays.filter(|ndc| {
        let ray = camera_ray(camera, &field.origin(), *ndc, VIEWPORT.aspect);
        field.march(ray, 1e-3, 30.0 * camera.view_unit()).is_some()
    });
    hits.count() as f64 / 9.0
}

#[test]
fn wheeling_from_sixteen_pixels_reaches_the_depths() {
    let scene = Scene::default();
    let pixels = sixteen_pixels(&scene);
    let ways = in_parallel(&pixels, |pixel| wheel_in(&scene, *pixel, 1e-12, true));
    let set = Set::new(&Mandelbulb::of(&scene.fractal), 200);
    for (pixel, way) in pixels.iter().zip(&ways) {
        let unit = way[way.len() - 1].view_unit();
        assert!(unit < 1e-12, "{pixel}: stops at {unit:e}");
        // A notch brings the eye nearer, or it turns about a corner first.
        let least = (scene.camera.view_unit() / unit).ln() / NOTCH;
        assert!((way.len() as f64) < 1.3 * least, "{pixel}: {} notches", way.len());
        for camera in way.iter().step_by(12).chain(way.last()) {
            let eye = camera.position.0.each_ref().map(|it| Real::parse(&it.to_string()));
            let room = set.estimate(&eye, 0.0).distance / camera.view_unit();
            assert!(room > 0.005, "{pixel} at {:e}: room {room}", camera.view_unit());
            let seen = surface_in_view(field_about_pivot(&scene, camera).as_ref(), camera);
            // The opening view shows background about the bulb.
            let is_whole = camera.view_unit() > 0.5;
            assert!(is_whole || seen > 0.5, "{pixel} at {:e}: sees {seen}", camera.view_unit());
        }
        for pair in way.windows(2) {
            let turned = pair[0].rotation().angle_between(pair[1].rotation());
            assert!(turned < 0.35, "{pixel}: turns by {turned} at one notch");
        }
    }
}

/// A dive from the middle of the opening view, in frames of `dt_secs`, to its end or for 100 seconds.
fn dive(scene: &Scene, dt_secs: f64) -> (Guide, Camera) {
    let model = FractalModel::new(&scene.fractal);
    let (mut guide, mut camera) = (Guide::default(), scene.camera.clone());
    let world = World { field: model.whole().as_ref(), viewport: VIEWPORT };
    guide.begin_dive(&model, &camera, world);
    assert_eq!(guide.status(), GuideStatus::Searching);
    let mut secs = 0.0;
    while secs < 100.0 && guide.advance(&model, &mut camera, world, dt_secs) {
        secs += dt_secs;
        for _ in 0..20 {
            guide.work(&camera, world);
        }
    }
    (guide, camera)
}

#[test]
fn a_dive_goes_down_to_the_end_by_itself() {
    let scene = Scene::default();
    let (guide, camera) = dive(&scene, 0.05);
    assert_eq!(guide.status(), GuideStatus::AtEnd);
    assert!(camera.view_unit() < 1e-26, "ends at {:e}", camera.view_unit());
    // The record leads there: an even fall in zoom, times ascending.
    let record = guide.record();
    assert!(record.len() > 50, "{} cameras", record.len());
    assert_eq!(record[0].1, scene.camera);
    for (index, pair) in record.windows(2).enumerate().skip(1) {
        let zoomed = (pair[0].1.view_unit() / pair[1].1.view_unit()).ln();
        // The last camera is where the dive ends, which may be less than a step from the one before.
        let least = if index + 2 == record.len() { 0.01 } else { 1.0 };
        assert!(pair[1].0 > pair[0].0 && (least..2.0).contains(&zoomed), "{zoomed}");
    }
}

#[test]
fn a_dive_without_a_place_in_view_ends_with_a_word() {
    let mut scene = Scene::default();
    scene.camera.orientation = (scene.camera.rotation() * glam::DQuat::from_rotation_y(2.0)).into();
    let (guide, camera) = dive(&scene, 0.05);
    assert_eq!(guide.status(), GuideStatus::NoPlace);
    assert_eq!(camera, scene.camera);
}

#[test]
fn a_touch_stops_a_dive_and_keeps_its_record() {
    let scene = Scene::default();
    let model = FractalModel::new(&scene.fractal);
    let (mut guide, mut camera) = (Guide::default(), scene.camera.clone());
    let world = World { field: model.whole().as_ref(), viewport: VIEWPORT };
    guide.begin_dive(&model, &camera, world);
    for _ in 0..200 {
        guide.advance(&model, &mut camera, world, 0.05);
        for _ in 0..20 {
            guide.work(&camera, world);
        }
    }
    assert_eq!(guide.status(), GuideStatus::Diving);
    let recorded = guide.record().len();
    guide.cancel();
    assert_eq!(guide.status(), GuideStatus::Idle);
    let record = guide.record();
    assert_eq!(record.len(), recorded);
    assert_eq!(
        record.last().map(|(_, camera)| camera),
        Some(&camera),
        "it ends where the dive did"
    );
    let here = camera.clone();
    assert!(!guide.advance(&model, &mut camera, world, 0.05) && camera == here);
    guide.forget_record();
    assert!(guide.record().is_empty());
}

#[test]
fn the_button_dives_a_touch_stops_and_the_dive_becomes_a_path() {
    let mut harness = stage(Scene::default(), Settings::default(), [900.0, 600.0]);
    harness.run();
    let opening = scene(&harness).clone();
    harness.get_by_label("Dive").click();
    // The search ends after some frames, whatever the machine's speed; then the eye comes nearer.
    let mut frames = 0;
    while scene(&harness).camera.view_unit() > 0.05 * opening.camera.view_unit() {
        harness.step();
        frames += 1;
        assert!(frames < 100_000, "no dive: {:e}", scene(&harness).camera.view_unit());
    }
    let view = harness.state().interface.rects().get("view").expect("a view").center();
    pointer(&harness, view, PointerButton::Primary, true, Modifiers::NONE);
    pointer(&harness, view, PointerButton::Primary, false, Modifiers::NONE);
    harness.run_steps(3);
    let here = scene(&harness).camera.clone();
    harness.run_steps(20);
    assert_eq!(scene(&harness).camera, here, "goes on after a touch");

    harness.get_by_label("Keep as a path").click();
    harness.run_steps(3);
    let project = harness.state().interface.project().clone();
    let keys = &project.path.keys;
    assert!(keys.len() >= 3, "{} keys", keys.len());
    assert_eq!(*keys[0].scene, opening);
    let depths: Vec<_> = keys.iter().map(|key| key.scene.camera.view_unit()).collect();
    assert!(depths.is_sorted_by(|a, b| a > b), "{depths:?}");
    assert!(harness.query_by_label("Keep as a path").is_none());

    // The dive was one step of undo.
    let editor = harness.state_mut().interface.editor_mut();
    editor.undo();
    editor.undo();
    assert_eq!(scene(&harness).camera, opening.camera);
}

#[test]
fn the_wheel_is_drawn_to_a_place_only_with_the_switch() {
    let ends = [true, false].map(|drawn_to_places| {
        let settings = Settings { drawn_to_places, ..Settings::default() };
        let mut harness = stage(Scene::default(), settings, [900.0, 600.0]);
        harness.run();
        let at = harness.state().interface.rects().get("view").expect("a view").center();
        harness.event(Event::PointerMoved(at));
        let mut frames = 0;
        while scene(&harness).camera.view_unit() > 1e-3 && frames < 2000 {
            harness.event(wheel(30.0));
            harness.step();
            frames += 1;
        }
        scene(&harness).camera.clone()
    });
    // Drawn, the eye turns about the place; without, it keeps its direction.
    let turned =
        |camera: &Camera| camera.rotation().angle_between(Scene::default().camera.rotation());
    assert!(turned(&ends[0]) > 0.05, "{}", turned(&ends[0]));
    assert!(turned(&ends[1]) < 1e-6, "{}", turned(&ends[1]));
}
