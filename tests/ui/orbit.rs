//! Orbits: what they turn about stays in its place, and the whole stays in the picture.

use glam::{DQuat, DVec2, DVec3};
use mandelight::{
    fractal::{FractalModel, pixel_cone},
    scene::{Camera, PrecisePoint, presets},
    ui::navigation::Navigator,
};

use crate::navigation::{VIEWPORT, bulb, picked, random, seen_px, to_px, world};

/// The centre of the orbit in progress.
fn center(navigator: &Navigator) -> PrecisePoint {
    navigator.orbit_center().expect("an orbit is in progress").clone()
}

#[test]
fn orbit_keeps_its_radius_its_centre_in_the_picture_and_the_horizon() {
    let (field, mut random) = (bulb(), random());
    for i in 0..50 {
        let (mut camera, mut navigator) = (Camera::default(), Navigator::default());
        let ndc = random.ndc() * 0.3;
        navigator.dolly(&mut camera, world(&field), ndc, 0.5 * f64::from(i % 5));
        navigator.begin_orbit(&camera, world(&field), ndc);
        let center = center(&navigator);
        let (radius, place) = ((&camera.position - &center).length(), seen_px(&camera, &center));
        let mut pointer = ndc;
        for _ in 0..20 {
            pointer += random.ndc() * 0.3;
            navigator.drag(&mut camera, world(&field), pointer);
            assert!(((&camera.position - &center).length() / radius - 1.0).abs() < 1e-6);
            assert!((seen_px(&camera, &center) - place).length() < 1e-2);
            assert!((camera.rotation() * DVec3::X).z.abs() < 1e-9, "the horizon tilts");
            assert!((camera.rotation() * DVec3::Y).z > 0.0, "upside down");
        }
    }
}

#[test]
fn an_orbit_close_up_begins_about_the_point_under_the_pointer() {
    let (field, mut camera, mut navigator) = (bulb(), Camera::default(), Navigator::default());
    let ndc = DVec2::new(0.1, -0.1);
    navigator.dolly(&mut camera, world(&field), ndc, 0.5);
    assert!(!world(&field).shows_whole(&camera));
    let start = camera.clone();
    navigator.begin_orbit(&camera, world(&field), ndc);
    let under = center(&navigator);
    assert!((seen_px(&camera, &under) - to_px(ndc)).length() < 1e-3);
    assert!(
        field.distance(under.to_dvec3())
            < 2.0 * pixel_cone(&camera, VIEWPORT.aspect, VIEWPORT.height_px) * camera.view_unit()
    );
    assert_eq!(camera, start, "a gesture begins without a change");
    // Turning brings the pivot there: gradually, so that nothing measured in view units jumps.
    let mut unit = camera.view_unit();
    for i in 1..=60 {
        navigator.drag(&mut camera, world(&field), ndc + DVec2::new(0.004, 0.0) * f64::from(i));
        assert!((camera.view_unit() / unit).ln().abs() < 0.05, "the view unit jumps");
        unit = camera.view_unit();
    }
    assert_eq!(camera.pivot, under);
    camera = start;
    camera.pivot = under;
    // Over the background the pivot stays, as long as it is on a surface in the picture.
    let sky = (0..40).map(|i| DVec2::from_angle(0.3 * f64::from(i)) * DVec2::new(1.0, 0.9));
    let mut sky = sky.filter(|&ndc| picked(&camera, &field, ndc).is_none());
    let sky = sky.next().expect("there is background");
    navigator.begin_orbit(&camera, world(&field), sky);
    assert_eq!(center(&navigator), camera.pivot);
    // Else it is what the picture shows nearest to the pointer.
    for elsewhere in [DVec3::new(50.0, 50.0, 0.0), DVec3::ZERO] {
        camera.pivot = PrecisePoint::from(elsewhere);
        navigator.begin_orbit(&camera, world(&field), sky);
        let nearest = center(&navigator);
        assert!(field.distance(nearest.to_dvec3()) < 0.01);
        let seen = seen_px(&camera, &nearest) / to_px(DVec2::ONE);
        assert!(seen.abs().max_element() <= 1.0, "{seen}");
    }
}

/// A sphere's silhouette in the picture: its extent in half heights, left, right, below and above.
fn silhouette(camera: &Camera, center: DVec3, radius: f64) -> [f64; 4] {
    let seen = camera.rotation().inverse() * (center - camera.position.to_dvec3());
    let bounds = |across: f64| {
        let (depth, reach) = (-seen.z, across.hypot(seen.z));
        let (middle, half) = (across.atan2(depth), (radius / reach).asin());
        [middle - half, middle + half]
            .map(|angle| angle.tan() / camera.half_height(VIEWPORT.aspect))
    };
    let ([left, right], [below, above]) = (bounds(seen.x), bounds(seen.y));
    [left, right, below, above]
}

#[test]
fn turning_the_whole_keeps_it_in_the_picture_at_its_size() {
    let mut random = random();
    for preset in presets::opening_scenes() {
        let scene = (preset.scene)();
        let model = FractalModel::new(&scene.fractal);
        let field = &**model.whole();
        let (center, radius) = (field.center(), field.bounding_radius());
        let (mut camera, mut navigator) = (scene.camera.clone(), Navigator::default());
        if !world(field).shows_whole(&camera) {
            navigator.frame_all(&mut camera, world(field));
            while navigator.advance(&mut camera, 0.1) {}
        }
        assert!(world(field).shows_whole(&camera), "{}", preset.name);
        let start = camera.clone();
        for _ in 0..8 {
            camera = start.clone();
            let mut pointer = random.ndc();
            let before = silhouette(&camera, center, radius);
            navigator.begin_orbit(&camera, world(field), pointer);
            for _ in 0..12 {
                pointer += random.ndc() * 0.7;
                navigator.drag(&mut camera, world(field), pointer);
                let after = silhouette(&camera, center, radius);
                for (a, b) in before.iter().zip(after) {
                    assert!((a - b).abs() < 1e-3, "{}: {before:?} {after:?}", preset.name);
                }
            }
        }
    }
}

#[test]
fn dragging_right_brings_the_left_side_into_view() {
    let (field, mut navigator) = (bulb(), Navigator::default());
    let mut camera = Camera::looking_at(DVec3::new(0.0, -3.0, 0.0), DVec3::ZERO, DVec3::Z);
    navigator.begin_orbit(&camera, world(&field), DVec2::ZERO);
    navigator.drag(&mut camera, world(&field), DVec2::new(0.1, 0.0));
    assert!(camera.position.to_dvec3().x < -0.05);
    navigator.drag(&mut camera, world(&field), DVec2::new(0.1, 0.2));
    assert!(camera.position.to_dvec3().z < -0.05, "dragging up shows the underside");
}

#[test]
fn the_poles_stop_an_upright_camera_and_no_rolled_one() {
    let (field, mut navigator) = (bulb(), Navigator::default());
    let mut camera = Camera::default();
    navigator.begin_orbit(&camera, world(&field), DVec2::ZERO);
    for i in 1..40 {
        navigator.drag(&mut camera, world(&field), DVec2::new(0.0, -0.2 * f64::from(i)));
    }
    let steepness = camera.forward().z.asin().to_degrees();
    assert!((-89.6..-89.4).contains(&steepness), "{steepness}");
    let before = camera.position.to_dvec3();
    navigator.drag(&mut camera, world(&field), DVec2::new(0.3, -7.8));
    assert!((camera.rotation() * DVec3::X).z.abs() < 1e-9);
    assert!(camera.position.to_dvec3() != before, "it still turns about the axis");

    let rolled = camera.rotation() * DQuat::from_rotation_z(0.5);
    camera.orientation = rolled.into();
    navigator.begin_orbit(&camera, world(&field), DVec2::ZERO);
    let mut lowest = f64::INFINITY;
    for i in 1..40 {
        navigator.drag(&mut camera, world(&field), DVec2::new(0.0, -0.1 * f64::from(i)));
        lowest = lowest.min((camera.rotation() * DVec3::Y).z);
    }
    assert!(lowest < -0.5, "a rolled camera goes over the top");
}
