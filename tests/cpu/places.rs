//! Places of twelve opening views: how many there are, and what makes them places.

use std::collections::HashSet;

use glam::{DMat3, DVec3};
use mandelight::{
    formula::{Recurrence, mandelbulb::Mandelbulb},
    fractal::{
        FractalModel, camera_ray,
        places::{Place, PlaceSearch, SearchArea},
    },
    gpu::device::in_parallel,
    scene::{Camera, PrecisePoint, Scene},
};
use mandelight_test_support::{
    deep::{
        arithmetic::{Number, Point, Real, difference, moved, rounded, sum},
        orbit::Set,
    },
    descent::opening_views,
};

const ASPECT: f64 = 1.5;

fn places_of(scene: &Scene) -> Vec<Place> {
    let model = FractalModel::new(&scene.fractal);
    PlaceSearch::new(&model, &scene.camera, ASPECT, SearchArea::PICTURE).finish()
}

#[test]
fn the_progress_of_a_search_grows_until_its_end() {
    let scene = Scene::default();
    let model = FractalModel::new(&scene.fractal);
    let area = SearchArea { rays: 64, count: 6, ..SearchArea::PICTURE };
    let mut search = PlaceSearch::new(&model, &scene.camera, ASPECT, area);
    let (mut last, mut distinct) = (search.progress(), 0);
    assert_eq!(last, 0.0);
    while search.step() {
        let progress = search.progress();
        assert!((last..=1.0).contains(&progress), "{progress} after {last}");
        distinct += u32::from(progress > last);
        last = progress;
    }
    assert_eq!(last, 1.0);
    assert!(distinct > 64, "{distinct} values");
}

#[test]
fn a_camera_found_in_steps_is_the_one_found_at_once() {
    let scene = Scene::default();
    for place in places_of(&scene).iter().take(4) {
        let depth = place.arrival(&scene.camera);
        let mut search = place.begin_camera(depth).expect("the place reaches so deep");
        assert!(search.camera(&scene.camera).is_none());
        let steps = std::iter::from_fn(|| search.step().then_some(())).count();
        assert!(steps > 100, "{steps} steps");
        assert_eq!(search.camera(&scene.camera), place.camera(&scene.camera, depth));
        assert!(place.begin_camera(0.0).is_none() || place.radius == 0.0);
    }
}

fn exact(point: &PrecisePoint) -> Point {
    point.0.each_ref().map(|it| Real::parse(&it.to_string()))
}

/// The first positions of the orbit of `point`, in 192 bits.
fn orbit(fractal: &Mandelbulb, point: &PrecisePoint, length: usize) -> Vec<Point> {
    let set = Set::new(fractal, 1);
    let start = exact(point);
    let added = if fractal.julia { fractal.julia_constant.map(Real::from_f64) } else { start };
    let mut positions = vec![start];
    while positions.len() < length {
        let raised = set.raised(&positions[positions.len() - 1]).point;
        positions.push(sum(&raised, &added));
    }
    positions
}

fn distance(a: &Point, b: &Point) -> f64 {
    rounded(&difference(a, b)).length()
}

/// The moduli of the extreme eigenvalues of the derivative of `steps` steps from `z`, by power iteration.
///
/// The derivative is that of differences of the orbit in 192 bits.
fn multiplier(fractal: &Mandelbulb, z: &Point, added: &Point, steps: usize) -> [f64; 2] {
    let set = Set::new(fractal, 1);
    let follow = |offset: DVec3| {
        let mut z = moved(z, offset);
        for _ in 0..steps {
            let raised = set.raised(&z).point;
            z = sum(&raised, added);
        }
        z
    };
    let column = |axis: DVec3| {
        let (after, before) = (follow(axis * 1e-30), follow(axis * -1e-30));
        rounded(&difference(&after, &before)) / 2e-30
    };
    let turn = DMat3::from_cols(column(DVec3::X), column(DVec3::Y), column(DVec3::Z));
    // A hundred turns: the norm's root is the largest modulus, whatever the other eigenvalues are.
    let growth = |matrix: DMat3| {
        let mut power = DMat3::IDENTITY;
        let mut log = 0.0;
        for _ in 0..200 {
            power = matrix * power;
            let norm = power.to_cols_array().into_iter().fold(0.0, |a: f64, b| a.max(b.abs()));
            log += norm.ln();
            power *= norm.recip();
        }
        (log / 200.0).exp()
    };
    [growth(turn.inverse()).recip(), growth(turn)]
}

#[test]
fn opening_views_show_dozens_of_places_of_their_fractals() {
    let views = opening_views();
    let found = in_parallel(&views, |(_, scene)| places_of(scene));
    for ((name, scene), places) in views.iter().zip(&found) {
        let fractal = Mandelbulb::of(&scene.fractal);
        let least = if fractal.power <= 4.0 { 5 } else { 30 };
        assert!(places.len() >= least, "{name}: {} places", places.len());
        assert!(places.is_sorted_by(|a, b| a.cost <= b.cost), "{name}: not the best first");
        let distinct: HashSet<_> = places.iter().map(|it| format!("{:?}", it.position)).collect();
        assert_eq!(distinct.len(), places.len(), "{name}: places found twice");
        for place in places {
            check_recurrence(name, &fractal, place, 1e-38);
        }
        for place in places.iter().take(6) {
            check_view(name, scene, place);
        }
    }
}

/// The place's exact orbit recurs, and its cycle repels nearly alike in all directions.
fn check_recurrence(name: &str, fractal: &Mandelbulb, place: &Place, tolerance: f64) {
    let last = place.recurrence.last();
    let positions = orbit(fractal, &place.position, last + 1);
    match place.recurrence {
        Recurrence::Cycle { preperiod, period } => {
            let error = distance(&positions[last], &positions[preperiod]);
            assert!(error < tolerance, "{name}, {place:?}: off by {error:e}");
            let added = if fractal.julia {
                fractal.julia_constant.map(Real::from_f64)
            } else {
                positions[0]
            };
            let [least, most] = multiplier(fractal, &positions[preperiod], &added, period);
            let elongation = most.ln() / least.ln();
            assert!(least > 1.05, "{name}, {place:?}: repels by {least}");
            assert!(
                (elongation - place.elongation).abs() < 0.02 && elongation < 1.1,
                "{name}, {place:?}: elongation {elongation}"
            );
        }
        Recurrence::Center { returns } => {
            assert!(!fractal.julia, "{name}, {place:?}: Julia forms have no such copies");
            let error = rounded(&positions[returns]).length();
            assert!(error < tolerance, "{name}, {place:?}: off by {error:e}");
            assert!(place.radius > 0.0, "{name}, {place:?}: no size");
        }
    }
}

/// The picture shows the place where the place says, with no surface in front.
fn check_view(name: &str, scene: &Scene, place: &Place) {
    let field = FractalModel::new(&scene.fractal).finer(1e-5);
    let ray = camera_ray(&scene.camera, &field.origin(), place.ndc, ASPECT);
    let depth = (&place.position - &scene.camera.position).length();
    let beside = ray.at(depth).distance(place.position.to_dvec3());
    assert!(beside < 1e-6 * depth, "{name}, {place:?}: {beside} beside its ray");
    let hit = field.march(ray, 1e-4, depth).unwrap_or(depth);
    assert!(depth - hit < 0.03 * depth, "{name}, {place:?}: hidden at {hit} of {depth}");
}

#[test]
fn places_can_be_looked_at_from_every_depth() {
    for (name, scene) in opening_views().into_iter().step_by(5) {
        let fractal = Mandelbulb::of(&scene.fractal);
        let set = Set::new(&fractal, 200);
        let places = places_of(&scene);
        let endless = places.iter().filter(|place| place.radius == 0.0);
        for place in endless.take(3) {
            for depth in [1e-3, 1e-8, 1e-20] {
                let camera: Camera = place
                    .camera(&scene.camera, depth)
                    .unwrap_or_else(|| panic!("{name}: {place:?}"));
                let away = (&camera.position - &place.position).length();
                assert!((away / depth - 1.0).abs() < 1e-6, "{name}: {away} instead of {depth}");
                assert!(
                    camera.forward().dot((&place.position - &camera.position) / away) > 1.0 - 1e-9,
                    "{name}: looks past {place:?}"
                );
                // The estimate of the 192-bit orbit: the eye is outside, with room to move.
                let room = set.estimate(&exact(&camera.position), 0.0).distance;
                assert!(room > 0.04 * depth, "{name}, {depth:e}, {place:?}: {room:e}");
            }
        }
    }
}

#[test]
fn fractals_without_recurring_orbits_have_no_places() {
    for preset in mandelight::scene::presets::opening_scenes() {
        let scene = (preset.scene)();
        if scene.fractal.formula().id() != "mandelbulb" {
            assert!(places_of(&scene).is_empty(), "{}", preset.name);
        }
    }
    // A view that sees nothing.
    let mut away = Scene::default();
    away.camera.pivot = PrecisePoint::from(DVec3::new(4.0, -6.0, 2.0));
    away.camera =
        Camera::looking_at(DVec3::new(2.0, -3.0, 1.0), DVec3::new(4.0, -6.0, 2.0), DVec3::Z);
    assert!(places_of(&away).is_empty());
}

#[test]
fn a_search_in_a_deep_view_finds_places_there() {
    let scene = Scene::default();
    let places = places_of(&scene);
    let place = places.iter().find(|place| place.radius == 0.0).expect("a place");
    let camera = place.camera(&scene.camera, 1e-12).expect("a vantage");
    let model = FractalModel::new(&scene.fractal);
    let deep = PlaceSearch::new(&model, &camera, ASPECT, SearchArea::PICTURE).finish();
    assert!(deep.len() >= 10, "{} places", deep.len());
    let fractal = Mandelbulb::of(&scene.fractal);
    for place in &deep {
        let away = (&place.position - &camera.position).length();
        assert!(away < 1e-10, "{place:?} is {away:e} away");
        // Fourteen steps enlarge the rounding of a position by the view's zoom.
        check_recurrence("deep view", &fractal, place, 1e-28);
    }
}
