//! The plain zoom: it holds on to the surface under the pointer or nearest to it, at every step.

use std::sync::{
    Arc,
    atomic::{AtomicU32, Ordering},
};

use egui::{Event, Pos2};
use egui_kittest::kittest::Queryable as _;
use glam::{DQuat, DVec2, DVec3};
use mandelight::{
    formula::{DistanceField, march::Estimate},
    fractal::FractalModel,
    scene::{Camera, presets},
    ui::{
        Settings,
        navigation::{Navigator, Viewport, World},
    },
};

use crate::stage::*;

const VIEWPORT: Viewport = Viewport { aspect: 16.0 / 9.0, height_px: 720.0, detail: 1.0 };

/// A plain f64 field that lets the eye come nearer than f32 pictures would, and counts its
/// estimates.
struct Deeper {
    field: Arc<dyn DistanceField>,
    asked: AtomicU32,
}

impl Deeper {
    fn new(model: &FractalModel) -> Self {
        Self { field: model.finer(1e-12), asked: AtomicU32::new(0) }
    }
}

impl DistanceField for Deeper {
    fn finest_footprint(&self) -> f64 {
        1e-13
    }

    fn distance(&self, point: DVec3) -> f64 {
        self.asked.fetch_add(1, Ordering::Relaxed);
        self.field.distance(point)
    }

    fn estimate(&self, point: DVec3) -> Estimate {
        self.asked.fetch_add(1, Ordering::Relaxed);
        self.field.estimate(point)
    }

    fn needs_hit_check(&self) -> bool {
        self.field.needs_hit_check()
    }

    fn bounding_radius(&self) -> f64 {
        self.field.bounding_radius()
    }
}

fn world(field: &dyn DistanceField) -> World<'_> {
    World { field, viewport: VIEWPORT }
}

/// Distance from `ndc` to the nearest hit of a fine grid around it, in half heights.
fn nearest_hit(world: World<'_>, camera: &Camera, ndc: DVec2, reach: f64) -> Option<f64> {
    let cells = -6..=6;
    let places =
        cells.clone().flat_map(|x| cells.clone().map(move |y| DVec2::new(x.into(), y.into())));
    let mut places: Vec<DVec2> = places.map(|place| place * reach / 6.0).collect();
    places.sort_by(|a, b| a.length().total_cmp(&b.length()));
    let found = places.into_iter().find(|&aside| {
        let at = ndc + aside / DVec2::new(VIEWPORT.aspect, 1.0);
        at.abs().max_element() <= 1.0 && world.pick(camera, at).is_some()
    });
    found.map(DVec2::length)
}

/// Zooms in by small steps at pixels inside of the set, at its edge and beside it.
#[test]
fn a_zoom_anywhere_holds_on_to_the_surface_down_to_a_millionth() {
    // The sheets of quaternion Julia sets are too thin for every step.
    let bulbs = presets::opening_scenes().iter().filter(|preset| {
        (preset.scene)().fractal.formula() == mandelight::formula::FormulaRef::default()
    });
    for preset in bulbs.step_by(2) {
        let scene = (preset.scene)();
        let model = FractalModel::new(&scene.fractal);
        let field = Deeper::new(&model);
        let world = world(&field);
        let places = (0..6).flat_map(|i| {
            let along = DVec2::from_angle(1.1 * f64::from(i)) / DVec2::new(VIEWPORT.aspect, 1.0);
            [0.2, 0.62, 0.7, 0.9].map(|radius| along * radius)
        });
        for ndc in places {
            let (mut camera, mut navigator) = (scene.camera.clone(), Navigator::default());
            let first = nearest_hit(world, &camera, ndc, 1.2).expect("a surface in the picture");
            let mut steps = 0;
            while camera.view_unit() > 1e-6 {
                navigator.dolly(&mut camera, world, ndc, 0.25);
                steps += 1;
                assert!(steps < 90, "{}: {ndc} stops at {:e}", preset.name, camera.view_unit());
                let seen = nearest_hit(world, &camera, ndc, first + 0.2);
                assert!(
                    seen.is_some(),
                    "{}: {ndc} loses it at {:e}",
                    preset.name,
                    camera.view_unit()
                );
                assert!(field.field.distance(camera.position.to_dvec3()) > 0.0);
            }
            // What is approached is a surface: the pivot goes along with its distance.
            let distance = field.field.distance(camera.position.to_dvec3());
            assert!(distance < 1e-4, "{}: {ndc} ends in free space, {distance:e}", preset.name);
        }
    }
}

#[test]
fn a_search_over_the_background_is_bounded_work() {
    let scene = presets::opening();
    let field = Deeper::new(&FractalModel::new(&scene.fractal));
    let mut most = 0;
    for i in 0..200 {
        let ndc = DVec2::from_angle(2.4 * f64::from(i)) * (f64::from(i) / 200.0).sqrt();
        let (mut camera, mut navigator) = (scene.camera.clone(), Navigator::default());
        // Some look past the set.
        camera.orientation =
            (camera.rotation() * DQuat::from_rotation_y(0.005 * f64::from(i))).into();
        field.asked.store(0, Ordering::Relaxed);
        navigator.dolly(&mut camera, world(&field), ndc, 0.1);
        most = most.max(field.asked.load(Ordering::Relaxed));
    }
    assert!(most <= 2000, "{most} estimates");
}

/// Steps of one run stay on one straight line, though other surfaces come under the pointer.
#[test]
fn a_run_of_zooms_keeps_its_target_while_the_pointer_rests() {
    // The whole bulb, with background about it.
    let scene = mandelight::scene::Scene::default();
    let field = Deeper::new(&FractalModel::new(&scene.fractal));
    let mut over_background = 0;
    for i in 0..40 {
        let ndc = DVec2::from_angle(0.5 * f64::from(i)) * DVec2::new(0.6, 0.85);
        let (mut camera, mut navigator) = (scene.camera.clone(), Navigator::default());
        over_background += u32::from(world(&field).pick(&camera, ndc).is_none());
        let start = camera.position.clone();
        navigator.dolly(&mut camera, world(&field), ndc, 0.1);
        let first = (&camera.position - &start).normalize();
        for _ in 0..10 {
            let before = camera.position.clone();
            navigator.dolly(&mut camera, world(&field), ndc + 1e-3, 0.1);
            let step = (&camera.position - &before).normalize();
            assert!(step.angle_between(first) < 0.05, "{ndc}: {step} after {first}");
        }
    }
    assert!(over_background > 10, "{over_background} over the background");
}

#[test]
fn looking_away_stops_the_zoom_and_zooming_out_leads_back() {
    for preset in presets::opening_scenes() {
        let scene = (preset.scene)();
        let model = FractalModel::new(&scene.fractal);
        let field = &**model.whole();
        let (mut camera, mut navigator) = (scene.camera.clone(), Navigator::default());
        // From outside, with the set behind.
        let back = camera.position.to_dvec3().normalize() * 3.0 * field.bounding_radius();
        camera = Camera::looking_at(back, back * 2.0, DVec3::Z);
        let before = camera.clone();
        assert!(!navigator.dolly(&mut camera, world(field), DVec2::new(0.2, -0.1), 0.3));
        assert_eq!(camera, before);
        assert!(navigator.found_nothing());
        let shows = |camera: &Camera| nearest_hit(world(field), camera, DVec2::ZERO, 2.0).is_some();
        for _ in 0..8 {
            assert!(navigator.dolly(&mut camera, world(field), DVec2::ZERO, -0.2));
            assert!(!navigator.found_nothing());
            assert!(field.distance(camera.position.to_dvec3()) > 0.0);
            assert!((camera.rotation() * DVec3::X).z.abs() < 1e-9, "the horizon tilts");
        }
        assert!(shows(&camera), "{}: still out of the picture", preset.name);
        assert!(navigator.dolly(&mut camera, world(field), DVec2::ZERO, 0.3), "{}", preset.name);
    }
}

#[test]
fn the_status_line_says_that_nothing_is_there() {
    let mut scene_away = presets::opening();
    let camera = &mut scene_away.camera;
    camera.orientation = (DQuat::from_rotation_z(3.0) * camera.rotation()).into();
    let mut harness = stage(scene_away.clone(), Settings::default(), [1280.0, 720.0]);
    let view: Pos2 = harness.state().interface.rects().get("view").expect("a view").center();
    harness.event(Event::PointerMoved(view));
    let mut turn = |delta: f32| {
        harness.event(wheel(delta));
        harness.run_steps(30);
        let said = harness.query_by_label_contains("Nothing to zoom into here").is_some();
        (scene(&harness).camera.clone(), said)
    };
    assert_eq!(turn(100.0), (scene_away.camera.clone(), true));
    let (camera, said) = turn(-100.0);
    assert!(!said && camera != scene_away.camera);
}
