//! Lights that follow the view: continuous, rigid, and tied to the view where it is close.

use glam::{DQuat, DVec3};
use mandelight::scene::{
    Camera, EnvironmentLight, LightFrame, Lights, MAX_LIGHTS, Scene,
    document::{from_json, to_json},
    follow::{FAR_UNIT, KEY_IN_VIEW, NEAR_REACH, NEAR_UNIT, effective, shown, with_edit},
    presets,
};
use mandelight_test_support::random::Random;

/// A camera in a random direction with the view unit `unit`.
fn camera(random: &mut Random, unit: f64) -> Camera {
    let pivot = DVec3::new(0.6, -0.7, 0.3);
    let back = random.in_cube().normalize();
    let looking = Camera::looking_at(pivot + back, pivot, random.in_cube());
    at_unit(&looking, unit)
}

/// The camera moved along its axis to the view unit `unit`.
fn at_unit(camera: &Camera, unit: f64) -> Camera {
    let position = camera.pivot.moved_by(camera.forward() * -unit, 0.0);
    Camera { position, ..camera.clone() }
}

/// The camera turned about its pivot by `turn`, in world space.
fn turned(camera: &Camera, turn: DQuat) -> Camera {
    let unit = camera.view_unit();
    let orientation = (turn * camera.rotation()).normalize().into();
    at_unit(&Camera { orientation, ..camera.clone() }, unit)
}

/// The opening scenes' lights, and a set with every kind of reach.
fn sets() -> Vec<Lights> {
    let mut sets: Vec<Lights> =
        presets::opening_scenes().iter().map(|preset| (preset.scene)().lights).collect();
    let mut unlimited = sets[0].clone();
    unlimited.environment.iter_mut().for_each(|light| light.shadow_reach = None);
    sets.push(unlimited);
    sets
}

/// Toward a light, in the scene's frame.
fn in_scene(light: &EnvironmentLight, camera: &Camera) -> DVec3 {
    match light.frame {
        LightFrame::Scene => DVec3::from_array(light.direction),
        LightFrame::View => camera.rotation() * DVec3::from_array(light.direction),
    }
}

/// What arrives of each light: its direction times its strength. The fill is the last, if any.
fn radiances(lights: &Lights, camera: &Camera) -> Vec<DVec3> {
    let shining = effective(lights, camera);
    let count = lights.environment.len();
    let mut all: Vec<DVec3> =
        shining.environment.iter().map(|light| in_scene(light, camera) * light.intensity).collect();
    all.resize(count + 1, DVec3::ZERO);
    all
}

/// The largest change of any light between two cameras, relative to the brightest light.
fn change(lights: &Lights, a: &Camera, b: &Camera) -> f64 {
    let most = lights.environment.iter().fold(0.0_f64, |most, light| most.max(light.intensity));
    let (a, b) = (radiances(lights, a), radiances(lights, b));
    a.iter().zip(&b).fold(0.0_f64, |largest, (a, b)| largest.max((*a - *b).length())) / most
}

#[test]
fn whole_views_have_the_lights_of_the_document() {
    let mut random = Random(7);
    for lights in sets() {
        for unit in [3.5, 0.1, FAR_UNIT * 1.000_001] {
            assert_eq!(*effective(&lights, &camera(&mut random, unit)), lights);
            assert_eq!(shown(&lights, &camera(&mut random, unit)), None);
        }
        let still = Lights { follow_view: false, ..lights };
        assert_eq!(*effective(&still, &camera(&mut random, 1e-9)), still);
    }
}

/// Zooming by a five-hundredth of a decade, and turning by a twentieth of a degree, at any depth.
#[test]
fn small_steps_change_little() {
    let mut random = Random(11);
    for lights in sets() {
        for _ in 0..400 {
            let unit = 10_f64.powf(-2.6 + 1.2 * random.signed());
            let here = camera(&mut random, unit);
            let nearer = at_unit(&here, unit * 10_f64.powf(-0.002));
            let axis = random.in_cube().normalize();
            let aside = turned(&here, DQuat::from_axis_angle(axis, 0.05_f64.to_radians()));
            for next in [nearer, aside] {
                let change = change(&lights, &here, &next);
                assert!(change < 0.1, "{change} at {unit:e}");
            }
        }
    }
}

/// Once around the pivot, and once through the whole blend, in ever finer steps: every change
/// shrinks with the step, so nothing jumps.
#[test]
fn nothing_jumps_on_full_turns_at_any_stage_of_the_blend() {
    let lights = presets::opening().lights;
    let largest = |steps: u32| {
        let mut largest = 0.0_f64;
        let mut random = Random(5);
        for i in 0..12 {
            let middle = (FAR_UNIT * NEAR_UNIT).sqrt();
            // The middle of the blend itself is among them.
            let unit = middle * 10_f64.powf(0.07 * f64::from(i) - 0.35);
            let start = camera(&mut random, unit);
            let axis = random.in_cube().normalize();
            let at = |k: u32| {
                let angle = std::f64::consts::TAU * f64::from(k) / f64::from(steps);
                turned(&start, DQuat::from_axis_angle(axis, angle))
            };
            for k in 0..steps {
                largest = largest.max(change(&lights, &at(k), &at(k + 1)));
            }
        }
        largest
    };
    let (coarse, fine) = (largest(720), largest(7200));
    assert!(fine < 0.15 * coarse, "a jump by {fine} in the finest steps, {coarse} in others");
}

#[test]
fn angles_between_lights_stay() {
    let mut random = Random(3);
    for lights in sets() {
        let tied: Vec<usize> = (0..lights.environment.len())
            .filter(|&i| lights.environment[i].frame == LightFrame::Scene)
            .collect();
        for depth in 0..60 {
            let camera = camera(&mut random, 10_f64.powf(-1.9 - 0.03 * f64::from(depth)));
            let shining = effective(&lights, &camera);
            for &i in &tied {
                for &j in &tied {
                    let cosine = |lights: &Lights| {
                        let [a, b] = [i, j].map(|i| in_scene(&lights.environment[i], &camera));
                        a.dot(b)
                    };
                    let off = (cosine(&shining) - cosine(&lights)).abs();
                    assert!(off < 1e-9, "{off} at {:e}", camera.view_unit());
                }
            }
        }
    }
}

#[test]
fn close_views_have_the_key_at_the_upper_left_whatever_the_camera() {
    let mut random = Random(13);
    for lights in sets() {
        let first = effective(&lights, &camera(&mut random, 0.9e-3)).into_owned();
        let key = lights.environment.iter().position(|light| light.frame == LightFrame::Scene);
        let key = DVec3::from_array(first.environment[key.expect("a light")].direction);
        assert!(key.distance(KEY_IN_VIEW.normalize()) < 1e-9, "{key}");
        for unit in [0.5e-3, 1e-9, 1e-26] {
            // The same, to the last bit: view-tied lights march no rays anew while they stay.
            assert_eq!(*effective(&lights, &camera(&mut random, unit)), first);
        }
    }
}

#[test]
fn the_sets_own_up_is_the_pictures_where_the_key_allows() {
    // A key that is at the upper left front of a level view already: nothing has to turn.
    let level = Camera::looking_at(DVec3::new(0.0, -1.0, 0.0), DVec3::ZERO, DVec3::Z);
    let direction = (level.rotation() * KEY_IN_VIEW.normalize()).to_array();
    let mut lights = Lights::default();
    lights.environment[0].direction = direction;
    lights.follow_view = true;
    for unit in [5e-3, 1e-4] {
        let camera = at_unit(&level, unit);
        let shining = effective(&lights, &camera);
        for (was, is) in lights.environment.iter().zip(&shining.environment) {
            let off = in_scene(was, &camera).distance(in_scene(is, &camera));
            assert!(off < 1e-9, "turned by {off} at {unit:e}");
        }
    }
}

#[test]
fn equally_bright_lights_go_by_their_order() {
    let light = |direction: DVec3| EnvironmentLight {
        direction: direction.to_array(),
        ..EnvironmentLight::default()
    };
    let lights = |a: DVec3, b: DVec3| Lights {
        environment: vec![light(a), light(b)],
        follow_view: true,
        ..Lights::default()
    };
    let camera = camera(&mut Random(1), 1e-5);
    for lights in [lights(DVec3::X, DVec3::Y), lights(DVec3::Y, DVec3::X)] {
        let first = DVec3::from_array(effective(&lights, &camera).environment[0].direction);
        assert!(first.distance(KEY_IN_VIEW.normalize()) < 1e-9);
    }
    // Keys straight above and below have no upward direction of their own.
    for key in [DVec3::Z, DVec3::NEG_Z] {
        let shining = effective(&lights(key, DVec3::X), &camera).into_owned();
        let [a, b] = [0, 1].map(|i| DVec3::from_array(shining.environment[i].direction));
        assert!(a.dot(b).abs() < 1e-9 && a.is_normalized() && b.is_normalized());
    }
}

#[test]
fn shadows_come_down_to_the_view_without_a_jump() {
    let lights = sets().pop().expect("a set without limits");
    let mut random = Random(17);
    let reach = |camera: &Camera| effective(&lights, camera).environment[0].shadow_reach;
    let mut before = None;
    for step in 0..=120 {
        let unit = FAR_UNIT * 1.1 * 10_f64.powf(-0.01 * f64::from(step));
        match (before, reach(&camera(&mut random, unit))) {
            (None, None) => assert!(unit > FAR_UNIT),
            // A first limit that no set is as large as changes no picture.
            (None, Some(first)) => assert!(first * unit > 7.5, "{first} at {unit:e}"),
            (Some(_), None) => panic!("the limit is gone at {unit:e}"),
            (Some(before), Some(now)) => {
                let ratio: f64 = now / before;
                assert!((0.85..1.05).contains(&ratio), "by {ratio} at {unit:e}");
            }
        }
        before = reach(&camera(&mut random, unit));
    }
    assert!((before.expect("a limit") / NEAR_REACH - 1.0).abs() < 1e-12);
    // Limits that a scene has stay.
    let limited = presets::opening().lights;
    let shining = effective(&limited, &camera(&mut random, 1e-8)).into_owned();
    assert_eq!(shining.environment[0].shadow_reach, limited.environment[0].shadow_reach);
}

#[test]
fn close_views_have_a_fill_if_the_scene_has_none() {
    let camera = camera(&mut Random(19), 1e-6);
    let mut lights = presets::opening().lights;
    assert_eq!(effective(&lights, &camera).len(), lights.len(), "it has its own");
    lights.environment.retain(|light| light.casts_shadows);
    let shining = effective(&lights, &camera).into_owned();
    assert_eq!(shining.len(), lights.len() + 1);
    let fill = shining.environment.last().expect("a fill");
    assert!(!fill.casts_shadows && fill.frame == LightFrame::View);
    assert!(fill.intensity < 0.2 * lights.environment[0].intensity && fill.intensity > 0.0);
    // A full scene has no room for one.
    lights.environment = vec![lights.environment[0].clone(); MAX_LIGHTS];
    assert_eq!(effective(&lights, &camera).len(), MAX_LIGHTS);
    // Without lights nothing shines, and nothing turns.
    lights.environment.clear();
    assert!(effective(&lights, &camera).environment.is_empty());
}

#[test]
fn effective_lights_make_a_valid_scene_of_the_same_look() {
    let mut random = Random(23);
    for lights in sets() {
        for unit in [9e-3, 4e-3, 2e-3, 1e-4, 1e-20] {
            let camera = camera(&mut random, unit);
            let shining = effective(&lights, &camera).into_owned();
            let scene = Scene { camera, lights: shining.clone(), ..Scene::default() };
            assert_eq!(from_json(&to_json(&scene)), Ok(scene.clone()));
            assert_eq!(*effective(&shining, &scene.camera), shining);
        }
    }
}

/// `light` as it shines in a view of unit 1e-3 or closer, or of 3e-3.
fn shining_close(light: &EnvironmentLight, unit: f64) -> EnvironmentLight {
    let x = (FAR_UNIT / unit).log10().min(1.0);
    let strength = 0.65_f64.powf(x * x * (3.0 - 2.0 * x));
    EnvironmentLight { intensity: light.intensity * strength, ..light.clone() }
}

#[test]
fn edits_of_what_is_seen_keep_what_they_do_not_touch() {
    let document = presets::opening().lights;
    let mut random = Random(29);
    for unit in [3e-3, 1e-7] {
        let camera = camera(&mut random, unit);
        let before = shown(&document, &camera).expect("a close view");
        let edit = |change: &dyn Fn(&mut Lights)| {
            let mut edited = before.clone();
            change(&mut edited);
            with_edit(document.clone(), &before, edited, &camera)
        };
        assert_eq!(edit(&|_| ()), document);
        // Colours and strengths are edited in the document's own set.
        let dimmed = edit(&|lights| lights.environment[1].intensity = 0.7);
        let mut expected = document.clone();
        expected.environment[1].intensity = 0.7;
        assert_eq!(dimmed, expected);
        // A new direction stores the whole set as it is seen.
        let direction = [0.0, 0.0, 1.0];
        let dragged = edit(&|lights| lights.environment[0].direction = direction);
        assert!(!dragged.follow_view);
        assert_eq!(dragged.environment[0].direction, direction);
        assert_eq!(dragged.environment[0].frame, LightFrame::View);
        for (stored, seen) in dragged.environment.iter().zip(&before.environment).skip(1) {
            assert_eq!(*stored, shining_close(seen, unit));
        }
        // So does an edit that would make another light the key, and turn the set.
        let weaker = edit(&|lights| lights.environment[0].intensity = 0.01);
        assert_eq!(weaker.environment[0].direction, before.environment[0].direction);
        assert_eq!(weaker.environment[1], shining_close(&before.environment[1], unit));
        assert!(!weaker.follow_view);
    }
}
