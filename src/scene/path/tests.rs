//! Paths against what can be seen of them: even speeds, no jumps, every number on its way.

use glam::{DQuat, DVec3};
use serde_json::Value;

use super::*;
use crate::{
    formula::mandelbulb::Mandelbulb,
    scene::{
        Camera, EnvironmentLight, Fractal, GradientStop, Lights, PointLight, PrecisePoint, param,
    },
};

fn key(time_secs: f64, easing: Easing, scene: &Scene) -> Key {
    Key { time_secs, easing, scene: Arc::new(scene.clone()) }
}

fn path(keys: Vec<Key>) -> Path {
    let path = Path { keys, ..Default::default() };
    assert_eq!(path.validate(), Ok(()));
    path
}

/// A scene that looks at a point from `unit` away, turned by `turn_rad` about the z axis.
pub(super) fn looking(pivot: &PrecisePoint, unit: f64, turn_rad: f64) -> Scene {
    let tilt = DQuat::from_rotation_z(turn_rad) * DQuat::from_rotation_x(1.1);
    let camera = Camera {
        position: pivot.moved_by(tilt * DVec3::Z * unit, unit * 1e-12),
        pivot: pivot.clone(),
        orientation: tilt.normalize().into(),
        ..Camera::default()
    };
    Scene { camera, ..Scene::default() }
}

pub(super) fn deep_point() -> PrecisePoint {
    PrecisePoint([
        "0.7123456789012345678901234567890123456789".parse().unwrap(),
        "-0.3123456789012345678901234567890123456789".parse().unwrap(),
        "0.1".parse().unwrap(),
    ])
}

/// How far things move on screen from one camera to another, in view units: the eye against its
/// surroundings, and everything by the turn. Independent of how paths are interpolated.
fn seen_motion(a: &Camera, b: &Camera) -> f64 {
    let unit = (a.view_unit() * b.view_unit()).sqrt();
    let aside = (&b.pivot - &a.pivot).length() / unit;
    let zoom = (b.view_unit() / a.view_unit()).ln();
    let turn = a.rotation().inverse() * b.rotation();
    aside.hypot(zoom) + 2.0 * turn.xyz().length().atan2(turn.w.abs())
}

/// Seen speeds, per second, all along a path.
fn speeds(path: &Path, steps: u32) -> Vec<f64> {
    let step_secs = path.duration_secs() / f64::from(steps);
    let cameras: Vec<Camera> =
        (0..=steps).map(|i| path.at(f64::from(i) * step_secs).unwrap().camera).collect();
    cameras.windows(2).map(|pair| seen_motion(&pair[0], &pair[1]) / step_secs).collect()
}

fn spread(speeds: &[f64]) -> f64 {
    let (least, most) = speeds.iter().fold((f64::INFINITY, 0.0_f64), |(least, most), &speed| {
        (least.min(speed), most.max(speed))
    });
    most / least
}

#[test]
fn a_dive_looks_equally_fast_from_the_whole_to_the_deepest() {
    let start = looking(&DVec3::new(0.1, 0.2, 0.0).into(), 1.0, 0.0);
    let end = looking(&deep_point(), 1e-25, 0.0);
    let dive = path(vec![key(0.0, Easing::Linear, &start), key(20.0, Easing::Linear, &end)]);
    let spread = spread(&speeds(&dive, 600));
    assert!(spread < 1.001, "the seen speed changes by a factor of {spread}");
    let half = dive.at(10.0).unwrap().camera.view_unit().log10();
    assert!((-13.5..-11.5).contains(&half), "half the time is not half the zoom: 1e{half}");
}

/// Where `point` appears, in half heights of the picture from its centre; none behind the eye.
fn seen_at(camera: &Camera, point: &PrecisePoint) -> Option<glam::DVec2> {
    let seen = camera.rotation().inverse() * (point - &camera.position);
    (seen.z < 0.0).then(|| seen.truncate() / -seen.z / camera.half_height(1.0))
}

#[test]
fn what_is_dived_to_stays_in_the_picture_and_before_the_eye() {
    let target = deep_point();
    // The surface there is a plane through the target, and both keys look at it from above.
    let above = DQuat::from_rotation_z(0.4) * DQuat::from_rotation_x(1.1) * DVec3::Z;
    let whole = Camera::looking_at(DVec3::new(1.76, -2.86, 1.2), DVec3::ZERO, DVec3::Z);
    let starts = [
        looking(&DVec3::new(0.4, -0.1, 0.05).into(), 2.5, 0.0),
        looking(&target, 2.0, 1.2),
        Scene { camera: whole, ..Scene::default() },
    ];
    for (start, easing) in
        starts.iter().flat_map(|start| [Easing::Linear, Easing::Smooth].map(|it| (start, it)))
    {
        let end = looking(&target, 1e-25, 0.4);
        let dive = path(vec![key(0.0, easing, start), key(25.0, easing, &end)]);
        let cameras: Vec<Camera> =
            (0..=5000).map(|i| dive.at(f64::from(i) * 0.005).unwrap().camera).collect();
        for (i, camera) in cameras.iter().enumerate() {
            let what = format!("{easing:?}, sample {i}, {:e}", camera.view_unit());
            let seen = seen_at(camera, &target).expect(&what);
            assert!(seen.abs().max_element() < 1.0, "{what}: the target is at {seen}");
            let height = (&camera.position - &target).dot(above);
            assert!(height > 0.3 * camera.view_unit(), "{what}: the eye is {height:e} above");
        }
        assert_eq!(cameras.last(), Some(&end.camera), "to the last digit");
        // Away from rest, equal times zoom by equal factors, and no sample jumps.
        let zooms: Vec<f64> =
            cameras.windows(2).map(|p| (p[0].view_unit() / p[1].view_unit()).ln()).collect();
        let even = (58.0 / 5000.0) * if easing == Easing::Smooth { 1.5 } else { 1.0 };
        for (i, zoom) in zooms.iter().enumerate() {
            assert!(*zoom < 1.05 * even, "{easing:?}, sample {i}: a zoom of {zoom}");
            let middle = (2400..2600).contains(&i);
            assert!(!middle || *zoom > 0.95 * even, "{easing:?}, sample {i}: only {zoom}");
        }
        for pair in zooms.windows(2) {
            assert!((pair[1] - pair[0]).abs() < 0.02 * even, "{easing:?}: {pair:?}");
        }
        let moved = cameras.windows(2).map(|p| seen_motion(&p[0], &p[1])).fold(0.0, f64::max);
        assert!(moved < 0.03, "{easing:?}: a sample moves what is seen by {moved}");
    }
}

#[test]
fn a_smooth_path_through_even_keys_keeps_its_speed_between_them() {
    let scenes: Vec<Scene> =
        (0..6).map(|i| looking(&deep_point(), 10f64.powi(-5 * i), 0.3 * f64::from(i))).collect();
    let times = (0..6).map(|i| f64::from(i) * 3.0);
    let keys = times.zip(&scenes).map(|(secs, scene)| key(secs, Easing::Smooth, scene)).collect();
    let dive = path(keys);
    let speeds = speeds(&dive, 600);
    // Away from the ends, where it starts from rest and comes to rest.
    let spread = spread(&speeds[120..480]);
    assert!(spread < 1.01, "between the keys the seen speed changes by a factor of {spread}");
    assert!(speeds[0] < 0.05 * speeds[300] && speeds[599] < 0.05 * speeds[300]);
}

#[test]
fn far_apart_at_great_depth_it_goes_out_across_and_in_again() {
    let here = looking(&deep_point(), 1e-20, 0.0);
    let there = looking(&deep_point().moved_by(DVec3::new(0.5, 0.1, 0.0), 0.0), 1e-20, 0.0);
    let path = path(vec![key(0.0, Easing::Linear, &here), key(10.0, Easing::Linear, &there)]);
    // Steps of a quarter of a view unit are chords of the way.
    assert!(spread(&speeds(&path, 400)) < 1.01);
    let top = path.at(5.0).unwrap().camera.view_unit();
    assert!((0.2..0.3).contains(&top), "from {top} away the way of 0.51 is in view");
}

#[test]
fn nothing_jumps_anywhere() {
    let scenes = [
        looking(&DVec3::new(0.1, 0.2, 0.0).into(), 3.0, 0.0),
        looking(&deep_point(), 1e-6, 2.0),
        looking(&deep_point(), 1e-6, 2.0 + 3.1),
        looking(&deep_point().moved_by(DVec3::new(3e-6, 0.0, 1e-6), 0.0), 1e-9, 5.5),
        looking(&DVec3::new(-0.4, 0.3, 0.2).into(), 1.0, 9.0),
    ];
    for easing in [Easing::Smooth, Easing::Linear] {
        let times = [0.0, 4.0, 5.0, 11.0, 12.5];
        let keys = times.into_iter().zip(&scenes).map(|(secs, scene)| key(secs, easing, scene));
        let path = path(keys.collect());
        let coarse = speeds(&path, 250).into_iter().fold(0.0, f64::max);
        let fine = speeds(&path, 2_500).into_iter().fold(0.0, f64::max);
        // A jump would make the speed of a ten times shorter step ten times as high.
        assert!(fine < 1.2 * coarse, "{easing:?}: a step of {fine} where {coarse} was seen");
    }
}

#[test]
fn speed_does_not_jump_at_a_smooth_key() {
    let scenes = [
        looking(&DVec3::new(0.1, 0.2, 0.0).into(), 2.0, 0.0),
        looking(&DVec3::new(0.5, 0.2, 0.1).into(), 0.7, 0.8),
        looking(&DVec3::new(0.4, -0.4, 0.3).into(), 0.9, 2.0),
        looking(&DVec3::new(-0.6, -0.4, 0.0).into(), 1.5, 3.0),
    ];
    let keys = [0.0, 2.0, 5.0, 7.0].into_iter().zip(&scenes);
    let path = path(keys.map(|(secs, scene)| key(secs, Easing::Smooth, scene)).collect());
    let velocity = |secs: f64| {
        let (a, b) = (path.at(secs).unwrap().camera, path.at(secs + 1e-5).unwrap().camera);
        ((&b.position - &a.position) / 1e-5, (a.rotation().inverse() * b.rotation()).xyz() / 1e-5)
    };
    for key_secs in [2.0, 5.0] {
        let ((eye_a, turn_a), (eye_b, turn_b)) =
            (velocity(key_secs - 2e-5), velocity(key_secs + 1e-5));
        assert!(eye_a.length() > 0.05, "the path stops at a key");
        assert!((eye_a - eye_b).length() < 1e-3 * eye_a.length(), "{eye_a} then {eye_b}");
        assert!((turn_a - turn_b).length() < 1e-3, "{turn_a} then {turn_b}");
    }
}

#[test]
fn turns_take_the_shorter_way_whatever_the_sign_of_their_quaternions() {
    let mut a = looking(&DVec3::ZERO.into(), 1.0, 0.0);
    let b = looking(&DVec3::ZERO.into(), 1.0, 1.0);
    for _ in 0..2 {
        let path = path(vec![key(0.0, Easing::Linear, &a), key(1.0, Easing::Linear, &b)]);
        let turned: f64 = speeds(&path, 100).iter().map(|speed| speed / 100.0).sum();
        assert!((turned - 1.0).abs() < 1e-6, "turned by {turned}");
        a.camera.orientation.0 = a.camera.orientation.0.map(|v| -v);
    }
}

#[test]
fn keys_are_hit_exactly_and_held() {
    let (a, b) = (Scene::default(), looking(&deep_point(), 1e-12, 1.0));
    let path = path(vec![
        key(1.0, Easing::Hold, &a),
        key(2.0, Easing::Smooth, &b),
        key(3.5, Easing::Smooth, &a),
    ]);
    for (secs, scene) in [(0.0, &a), (1.0, &a), (1.999, &a), (2.0, &b), (3.5, &a), (9.0, &a)] {
        assert_eq!(path.at(secs).as_ref(), Some(scene), "at {secs} s");
    }
    // And is as near as one likes just before.
    let before = path.at(3.5 - 1e-9).unwrap().camera;
    assert!(seen_motion(&before, &a.camera) < 1e-6);
    assert_eq!(Path::default().at(1.0), None);
}

#[test]
fn frames_run_from_the_beginning_to_the_last_key() {
    let scene = Scene::default();
    let mut path = path(vec![key(0.0, Easing::Smooth, &scene), key(3.0, Easing::Smooth, &scene)]);
    assert_eq!((path.frame_count(), path.frame_secs(90), path.nearest_frame(2.99)), (91, 3.0, 90));
    path.frames_per_second = 24;
    assert_eq!(path.frame_count(), 73);
    assert_eq!(Path::default().frame_count(), 0);
    path.keys.truncate(1);
    assert_eq!(path.frame_count(), 1);
}

#[test]
fn the_shutter_is_open_about_a_frame_but_not_beyond_ends_and_cuts() {
    let (a, b) = (Scene::default(), looking(&DVec3::ZERO.into(), 1.0, 1.0));
    let mut path = path(vec![
        key(0.0, Easing::Linear, &a),
        key(2.1, Easing::Hold, &b),
        key(3.2, Easing::Linear, &a),
        key(5.0, Easing::Linear, &b),
    ]);
    path.frames_per_second = 1;
    assert_eq!(path.shutter_secs(1), [1.0, 1.0]);
    path.shutter = 0.5;
    let times = [[0.0, 0.25], [0.75, 1.25], [1.75, 2.25], [2.75, 3.2], [3.75, 4.25], [4.75, 5.0]];
    for (frame, expected) in (0..).zip(times) {
        let found = path.shutter_secs(frame);
        assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12), "{found:?}");
    }
    // From 2.1 to 3.2 s nothing moves.
    let counts = (0..7).map(|frame| path.shutter_scenes(frame, 4).len());
    assert_eq!(counts.collect::<Vec<_>>(), [4, 4, 4, 0, 4, 4, 0]);
    let second = path.shutter_scenes(1, 2);
    assert_eq!(second, [0.875, 1.125].map(|secs| path.at(secs).unwrap()));
    // A frame on a cut shows the new side.
    path.keys[2].time_secs = 4.0;
    assert_eq!(path.shutter_secs(4), [4.0, 4.25]);
    path.keys.clear();
    assert_eq!(path.shutter_scenes(0, 4), []);
}

/// A scene of which every number differs from the default scene's.
fn everything_else() -> (Scene, Scene) {
    let mut a = Scene {
        lights: Lights {
            environment: vec![EnvironmentLight::default()],
            point: vec![PointLight::default()],
            ..Default::default()
        },
        ..Scene::default()
    };
    a.surface.gradient = vec![GradientStop { position: 0.2, color: [0.1, 0.2, 0.3] }];
    a.surface.second_layer.gradient = a.surface.gradient.clone();
    let mut value = serde_json::to_value(&a).unwrap();
    change_numbers(&mut value, &mut String::new());
    let mut b: Scene = serde_json::from_value(value).unwrap();
    for direction in [&mut b.lights.environment[0].direction, &mut b.lights.rig.sky.sun_direction] {
        *direction = DVec3::from_array(*direction).normalize().to_array();
    }
    b.lights.point[0].position = DVec3::new(0.3, 0.4, 0.5).into();
    let Camera { lens, stereo, .. } = b.camera.clone();
    b.camera = Camera { lens, stereo, ..looking(&deep_point(), 0.01, 2.0).camera };
    b.camera.vertical_fov_deg = 77.0;
    b.fractal.bailout = 3.0;
    (a, b)
}

/// Gives every number another valid value.
fn change_numbers(value: &mut Value, path: &mut String) {
    match value {
        Value::Object(fields) => {
            for (name, field) in fields {
                let here = path.len();
                path.push_str(if here > 0 { "." } else { "" });
                path.push_str(name);
                change_numbers(field, path);
                path.truncate(here);
            }
        }
        Value::Array(items) => {
            for item in items {
                let here = path.len();
                path.push_str("[]");
                change_numbers(item, path);
                path.truncate(here);
            }
        }
        Value::Number(number) => {
            let old = number.as_f64().unwrap();
            let (min, max) = param::find(path).map_or((0.0, 1.0), |param| (param.min, param.max));
            // Whole numbers need room for one between.
            let (low, high) = if number.is_f64() { (0.2, 0.7) } else { (0.0, 1.0) };
            let part = if old < 0.5 * (min + max) { high } else { low };
            let new = min + part * (max - min);
            *value = if number.is_f64() { new.into() } else { (new.round() as i64).into() };
        }
        _ => {}
    }
}

/// Every number of a document with its path; positions too, as the nearest f64.
fn numbers(value: &Value, path: String, found: &mut Vec<(String, f64)>) {
    match value {
        Value::Object(fields) => {
            fields.iter().for_each(|(name, field)| numbers(field, format!("{path}.{name}"), found));
        }
        Value::Array(items) => {
            let items = items.iter().enumerate();
            items.for_each(|(i, item)| numbers(item, format!("{path}[{i}]"), found));
        }
        Value::Number(number) => found.push((path, number.as_f64().unwrap())),
        Value::String(text) => {
            if let Ok(number) = text.parse() {
                found.push((path, number));
            }
        }
        _ => {}
    }
}

#[test]
fn every_number_of_a_scene_moves() {
    let (a, b) = everything_else();
    assert_eq!((a.validate(), b.validate()), (Ok(()), Ok(())));
    let whole = path(vec![key(0.0, Easing::Linear, &a), key(1.0, Easing::Linear, &b)]);
    let middle = whole.at(0.5).unwrap();
    assert_eq!(middle.validate(), Ok(()));
    let found = [&a, &middle, &b].map(|scene| {
        let mut found = Vec::new();
        numbers(&serde_json::to_value(scene).unwrap(), String::new(), &mut found);
        found
    });
    assert!(found[0].len() > 50 && found[0].len() == found[2].len());
    for ((path, from), ((_, at), (_, to))) in
        found[0].iter().zip(found[1].iter().zip(found[2].iter()))
    {
        assert_ne!(from, to, "{path} is the same at both keys: the test's own scenes");
        assert_ne!(at, from, "{path} stays where it was");
        assert_ne!(at, to, "{path} is there at once");
        // What lies on circles and goes with the camera need not lie between in each coordinate.
        if !["camera", "direction", "position"].iter().any(|word| path.contains(word)) {
            assert!((from.min(*to)..from.max(*to)).contains(at), "{path}: {from}, {at}, {to}");
        }
    }
}

#[test]
fn logarithmic_numbers_run_by_ratios() {
    let (mut a, mut b) = (Scene::default(), Scene::default());
    (a.surface.shininess, b.surface.shininess) = (4.0, 400.0);
    let path = path(vec![key(0.0, Easing::Linear, &a), key(1.0, Easing::Linear, &b)]);
    assert!((path.at(0.5).unwrap().surface.shininess - 40.0).abs() < 1e-9);
}

#[test]
fn a_light_that_is_dived_along_keeps_its_strength_in_the_picture() {
    let light = |unit: f64| {
        let mut scene = looking(&deep_point(), unit, 0.0);
        let position = deep_point().moved_by(DVec3::new(0.3, 0.1, 0.4) * unit, 0.0);
        let intensity = 0.25 * unit * unit;
        scene.lights.point = vec![PointLight { position, intensity, ..Default::default() }];
        scene
    };
    let dive =
        path(vec![key(0.0, Easing::Smooth, &light(1.0)), key(9.0, Easing::Smooth, &light(1e-25))]);
    for i in 0..=900 {
        let scene = dive.at(f64::from(i) * 0.01).unwrap();
        let light = &scene.lights.point[0];
        let distance = (&light.position - &scene.camera.pivot).length();
        let strength = light.intensity / (distance * distance);
        assert!((0.9..1.1).contains(&(strength / (0.25 / 0.26))), "sample {i}: {strength}");
    }
}

#[test]
fn lights_of_one_key_alone_shine_from_nothing() {
    let (mut a, mut b) = (Scene::default(), Scene::default());
    a.lights.environment.truncate(1);
    b.lights.point.push(PointLight { intensity: 8.0, solo: true, ..Default::default() });
    let path = path(vec![key(0.0, Easing::Linear, &a), key(1.0, Easing::Linear, &b)]);
    let at = |secs: f64| path.at(secs).unwrap().lights;
    let early = at(0.01);
    assert_eq!((early.environment.len(), early.point.len()), (3, 1));
    assert!(early.point[0].intensity < 0.01 && early.environment[2].intensity < 0.01);
    assert!(!early.any_solo(), "a light that only appears hides no other");
    assert!(at(0.99).point[0].intensity > 7.0);
    let mut last = 0.0;
    for i in 1..100 {
        let intensity = at(f64::from(i) / 100.0).point[0].intensity;
        assert!(intensity > last);
        last = intensity;
    }
}

#[test]
fn two_crowds_of_lights_stay_within_the_limit() {
    let (mut a, mut b) = (Scene::default(), Scene::default());
    a.lights = Lights {
        environment: vec![EnvironmentLight::default(); 60],
        point: vec![],
        ..Default::default()
    };
    b.lights = Lights {
        environment: vec![],
        point: vec![PointLight::default(); 60],
        ..Default::default()
    };
    let path = path(vec![key(0.0, Easing::Linear, &a), key(1.0, Easing::Linear, &b)]);
    let middle = path.at(0.5).unwrap();
    assert_eq!(middle.validate(), Ok(()));
    assert_eq!((middle.lights.environment.len(), middle.lights.point.len()), (60, 4));
}

#[test]
fn rules_between_fields_hold_on_the_way() {
    let fractal = |power: f64, bailout: f64| -> Fractal {
        Mandelbulb { power, bailout, ..Default::default() }.into()
    };
    let a = Scene { fractal: fractal(9.0, 100.0), ..Default::default() };
    let b = Scene { fractal: fractal(16.0, 15.9), ..Default::default() };
    let path = path(vec![key(0.0, Easing::Smooth, &a), key(1.0, Easing::Smooth, &b)]);
    for i in 0..=100 {
        let scene = path.at(f64::from(i) / 100.0).unwrap();
        assert_eq!(scene.validate(), Ok(()));
        assert!(
            i % 100 == 0 || (9.0..16.0).contains(&scene.fractal.number("power").unwrap()),
            "it went on"
        );
    }
}

#[test]
fn keys_keep_their_order() {
    let scene = Scene::default();
    let mut path = Path::default();
    for secs in [3.0, 1.0, 2.0] {
        path.insert(key(secs, Easing::Smooth, &scene));
    }
    assert_eq!(path.insert(key(2.0, Easing::Hold, &scene)), Some(1));
    let times: Vec<f64> = path.keys.iter().map(|key| key.time_secs).collect();
    assert_eq!((times, path.keys[1].easing), (vec![1.0, 2.0, 3.0], Easing::Hold));
    assert_eq!((path.key_at(2.01), path.key_at(1.5)), (Some(1), None));
    path.keys[2].time_secs = 2.0;
    assert_eq!(path.validate().unwrap_err().path, "path.keys[2].time_secs");
}
