//! The opening scenes: valid, told apart, and seen from outside of what they show.

use glam::DVec3;
use mandelight::{
    formula::{
        self, Fractal, Ray,
        mandelbulb::{Mandelbulb, Sine},
    },
    scene::{Scene, document, link, presets},
};
use mandelight_test_support::oracle::quaternion;

/// Distance estimate by an oracle of the fractal's formula; zero inside.
fn distance_estimate(fractal: &Fractal, point: DVec3) -> f64 {
    match fractal.formula().id() {
        "mandelbulb" => mandelbulb_distance(&Mandelbulb::of(fractal), point),
        "quaternion_julia" => quaternion::distance(fractal, point),
        other => panic!("no oracle of {other}"),
    }
}

/// Distance estimate of thesis Algorithm 1, with trigonometry; zero inside.
fn mandelbulb_distance(fractal: &Mandelbulb, point: DVec3) -> f64 {
    let n = fractal.power;
    let sign = if fractal.sine == Sine::Negative { -1.0 } else { 1.0 };
    let c = if fractal.julia { DVec3::from_array(fractal.julia_constant) } else { point };
    let (mut z, mut dr) = (point, 1.0);
    for _ in 0..fractal.iterations {
        let r = z.length();
        if r > fractal.bailout {
            return 0.5 * r.ln() * r / dr;
        }
        let (phi, theta) = ((z.z / r).asin(), z.y.atan2(z.x));
        dr = n * r.powf(n - 1.0) * dr + if fractal.julia { 0.0 } else { 1.0 };
        let direction = DVec3::new(
            (n * phi).cos() * (n * theta).cos(),
            (n * phi).cos() * (n * theta).sin(),
            sign * (n * phi).sin(),
        );
        z = r.powf(n) * direction + c;
    }
    0.0
}

#[test]
fn the_program_opens_on_the_first_and_names_differ() {
    let presets = presets::opening_scenes();
    assert_eq!((presets[0].scene)(), presets::opening());
    for (i, preset) in presets.iter().enumerate() {
        assert!(!preset.name.is_empty() && preset.blurb.ends_with('.'));
        for other in &presets[..i] {
            assert_ne!(preset.name, other.name);
            assert_ne!((preset.scene)(), (other.scene)(), "{} and {}", preset.name, other.name);
        }
    }
}

/// Documents that leave the switches out keep the look they had before there were switches.
#[test]
fn each_switches_on_what_documents_leave_off() {
    let default = Scene::default();
    assert!(!default.lights.follow_view && !default.has_indirect());
    assert!(!default.surface.coloring.follows_view);
    for preset in presets::opening_scenes() {
        let scene = (preset.scene)();
        assert!(scene.lights.follow_view && scene.has_indirect(), "{}", preset.name);
        assert!(scene.surface.coloring.follows_view, "{}", preset.name);
    }
}

#[test]
fn each_is_valid_and_fits_a_link() {
    for preset in presets::opening_scenes() {
        let scene = (preset.scene)();
        scene.validate().unwrap_or_else(|error| panic!("{}: {error}", preset.name));
        assert_eq!(document::from_json(&document::to_json(&scene)), Ok(scene.clone()));
        let fragment = link::to_fragment(&scene).unwrap();
        // docs/scene.md states these lengths.
        assert!(
            (500..=700).contains(&fragment.len()),
            "{}: {} characters",
            preset.name,
            fragment.len()
        );
        assert_eq!(link::from_fragment(&fragment), Ok(scene));
    }
}

#[test]
fn each_eye_and_lamp_is_outside_of_the_set() {
    for preset in presets::opening_scenes() {
        let scene = (preset.scene)();
        let eye = scene.camera.position.to_dvec3();
        let distance = distance_estimate(&scene.fractal, eye);
        assert!(distance > 0.1 * scene.camera.view_unit(), "{}: {distance}", preset.name);
        for light in &scene.lights.point {
            let lamp = light.position.to_dvec3();
            let distance = distance_estimate(&scene.fractal, lamp);
            assert!(distance > 0.005, "{}: lamp at {lamp}: {distance}", preset.name);
        }
    }
}

#[test]
fn each_shows_a_surface_in_the_middle() {
    for preset in presets::opening_scenes() {
        let scene = (preset.scene)();
        let (camera, fractal) = (&scene.camera, &scene.fractal);
        let pivot = camera.pivot.to_dvec3();
        assert!(pivot.length() < 3.0 && camera.view_unit() < 4.5, "{}", preset.name);
        // A slow march through the picture's centre and around it.
        let hits = (0..25).filter(|i| {
            let (x, y) = (f64::from(i % 5) - 2.0, f64::from(i / 5) - 2.0);
            let spread = 0.15 * camera.half_height(1.0);
            let direction =
                (camera.rotation() * DVec3::new(x * spread, y * spread, -1.0)).normalize();
            let mut t = 0.0;
            for _ in 0..2000 {
                let step = distance_estimate(fractal, camera.position.to_dvec3() + t * direction);
                if step < 1e-3 * t {
                    return true;
                }
                t += 0.3 * step.min(0.1);
            }
            false
        });
        let hits = hits.count();
        assert!(hits > 12, "{}: {hits} of 25 rays hit", preset.name);
    }
}

/// Each formula has a scene of its name: the chooser shows its picture.
#[test]
fn each_formula_has_a_scene_that_shows_it() {
    for (id, _) in formula::texts() {
        let formula = formula::find(id).expect("a formula");
        let mut own = presets::formulas().iter().filter(|preset| preset.name == formula.name());
        let preset = own.next().unwrap_or_else(|| panic!("no scene of {id}"));
        assert!(own.next().is_none(), "two scenes of {id}");
        let scene = (preset.scene)();
        scene.validate().unwrap_or_else(|error| panic!("{id}: {error}"));
        assert_eq!(scene.fractal.formula(), formula);
        let fragment = link::to_fragment(&scene).unwrap();
        assert!(fragment.len() < 800, "{id}: a link of {} characters", fragment.len());
        assert_eq!(link::from_fragment(&fragment), Ok(scene.clone()));
        // The eye is outside, and sees a surface about the middle.
        let field = scene.fractal.formula().distance_field(&scene.fractal);
        let camera = &scene.camera;
        let eye = camera.position.to_dvec3();
        assert!(field.clear_distance(eye) > 0.02 * camera.view_unit(), "{id}");
        let hits = (0..25).filter(|i| {
            let place = DVec3::new(f64::from(i % 5) - 2.0, f64::from(i / 5) - 2.0, 0.0);
            let spread = 0.2 * camera.half_height(1.0);
            let direction = (camera.rotation() * (spread * place - DVec3::Z)).normalize();
            field.march(Ray { origin: eye, direction }, 2e-3, 1e3).is_some()
        });
        let hits = hits.count();
        assert!(hits >= 8, "{id}: {hits} of 25 rays hit");
    }
}

#[test]
fn traced_scenes_trace_paths_of_the_fractals_that_they_are_named_after() {
    let traced = presets::traced();
    assert!(traced.len() >= 4);
    for preset in traced {
        let scene = (preset.scene)();
        scene.validate().unwrap_or_else(|error| panic!("{}: {error}", preset.name));
        assert!(scene.traces_paths() && scene.quality.samples >= 256, "{}", preset.name);
        assert!(!scene.lights.rig.is_empty() || scene.surface.emission > 0.0, "{}", preset.name);
        let fragment = link::to_fragment(&scene).unwrap();
        assert_eq!(link::from_fragment(&fragment), Ok(scene));
    }
    let formula = |name: &str| {
        let preset = presets::all().find(|preset| preset.name == name).expect("a preset");
        (preset.scene)().fractal
    };
    for [traced, source] in
        [["Filigree", "Apollonian"], ["Lamp", "Menger sponge"], ["Deep dahlia", "Dahlia"]]
    {
        assert_eq!(formula(traced), formula(source), "{traced}");
    }
}

#[test]
fn mixes_are_what_their_names_say() {
    let mixes: Vec<_> = presets::mixes().iter().map(|preset| (preset.scene)()).collect();
    let counts = [
        mixes.iter().filter(|scene| !scene.fractal.section_planes.is_empty()).count(),
        mixes.iter().filter(|scene| scene.fractal.hybrid().is_some()).count(),
        mixes.iter().filter(|scene| scene.surface.second_layer.is_on()).count(),
    ];
    assert_eq!(counts, [3, 5, 1]);
    for scene in mixes {
        scene.validate().unwrap_or_else(|error| panic!("{error}"));
        let steps = scene.fractal.hybrid().map_or(2, |hybrid| hybrid.steps.len());
        assert_eq!(steps, 2);
        let fragment = link::to_fragment(&scene).unwrap();
        assert_eq!(link::from_fragment(&fragment), Ok(scene));
    }
}
