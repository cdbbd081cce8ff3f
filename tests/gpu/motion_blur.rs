//! Motion blur: the mean of sub-frames against its parts, against light of known changes, and where nothing moves.

use std::{ops::ControlFlow, sync::Arc};

use glam::{DQuat, DVec3};
use mandelight::{
    export::{StillJob, StillOptions},
    render::{Pace, Region, View, sub_frame::SubFrame},
    scene::{
        Background, IntegratorKind, Path, Scene,
        path::{Easing, Key},
    },
};
use mandelight_test_support::{
    compare::difference,
    device::pipelines,
    picture::Picture,
    view::{sampled, settle},
};

const SIZE: [u32; 2] = [61, 43];

fn key(time_secs: f64, easing: Easing, scene: &Scene) -> Key {
    Key { time_secs, easing, scene: Arc::new(scene.clone()) }
}

/// A scene and another, seen from a little farther around, with another power.
fn moving(samples: u32) -> [Scene; 2] {
    let scene = sampled(Scene::default(), samples);
    let mut other = scene.clone();
    let turn = DQuat::from_axis_angle(DVec3::Z, 0.3);
    other.camera.position = (turn * scene.camera.position.to_dvec3()).into();
    let orientation = DQuat::from_array(scene.camera.orientation.0);
    other.camera.orientation = (turn * orientation).normalize().into();
    other.fractal.set("power", 7.5);
    [scene, other]
}

fn path_of([from, to]: &[Scene; 2], shutter: f64) -> Path {
    let keys = vec![key(0.0, Easing::Linear, from), key(2.0, Easing::Linear, to)];
    Path { frames_per_second: 1, shutter, keys }
}

fn frame(path: &Path, frame: u32, tile_px: [u32; 2]) -> Vec<u8> {
    let options = StillOptions { tile_px, ..StillOptions::new(SIZE) };
    let job = StillJob::of_frame(pipelines(), path, frame, options, Vec::new()).expect("a job");
    Picture::of(&job.run(|_| ControlFlow::Continue(())).expect("a picture")).bytes
}

/// The film of each scene by itself, with the samples that it has as a sub-frame.
fn films(scenes: &[Scene]) -> Vec<Vec<[f32; 3]>> {
    let films = (0..).zip(scenes).map(|(i, scene)| {
        let mut view = View::new(pipelines(), Region::whole(SIZE), Pace::Still);
        let first_sample = i * scene.quality.samples;
        view.set_sub_frame(scene, SubFrame { index: 0, count: 1, first_sample });
        settle(&mut view);
        view.film().expect("a film")
    });
    films.collect()
}

/// The film of all scenes as sub-frames of a picture.
fn blurred(scenes: &[Scene]) -> Vec<[f32; 3]> {
    let mut view = View::new(pipelines(), Region::whole(SIZE), Pace::Still);
    let count = scenes.len() as u32;
    for (index, scene) in (0..).zip(scenes) {
        let first_sample = index * scene.quality.samples;
        view.set_sub_frame(scene, SubFrame { index, count, first_sample });
        settle(&mut view);
    }
    view.film().expect("a film")
}

#[test]
fn a_picture_is_the_mean_of_its_sub_frames() {
    for kind in [IntegratorKind::Direct, IntegratorKind::Path] {
        let [mut from, mut to] = moving(3);
        for scene in [&mut from, &mut to] {
            scene.integrator.kind = kind;
            scene.integrator.denoise = true;
        }
        let scenes = path_of(&[from, to], 1.0).shutter_scenes(1, 5);
        assert_eq!(scenes.len(), 5);
        let parts = films(&scenes);
        let mut apart = 0;
        for (i, mean) in blurred(&scenes).into_iter().enumerate() {
            for channel in 0..3 {
                let values = parts.iter().map(|film| film[i][channel]);
                let expected = values.clone().sum::<f32>() / parts.len() as f32;
                let error = (mean[channel] - expected).abs();
                assert!(error <= 1e-5 * expected.max(0.1), "{kind:?}: pixel {i} is off by {error}");
                let spread = values.clone().fold(0.0, f32::max) - values.fold(1e9, f32::min);
                apart += usize::from(spread > 0.05);
            }
        }
        assert!(apart > 500, "the sub-frames are alike: {apart}");
    }
}

/// Sub-frames have samples of their own: in a still scene they are those of one long picture.
#[test]
fn sub_frames_share_out_the_samples_of_a_picture() {
    let [mut scene, _] = moving(16);
    // Jittered samples take the place of centre samples, as they do in sub-frames.
    scene.integrator.kind = IntegratorKind::Path;
    let mut view = View::new(pipelines(), Region::whole(SIZE), Pace::Still);
    view.set_scene(&scene, false);
    settle(&mut view);
    let whole = view.film().expect("a film");
    let scenes = vec![sampled(scene, 4); 4];
    let difference_of = |parts: &[[f32; 3]]| {
        let values = whole.iter().flatten().zip(parts.iter().flatten());
        let errors = values.map(|(a, b)| (a - b).abs());
        errors.sum::<f32>() / whole.iter().flatten().sum::<f32>()
    };
    // Rays that are marched together start together: their depths differ in the last digits, and a few paths go another way.
    let shared_out = difference_of(&blurred(&scenes));
    let repeated = difference_of(&films(&scenes)[0]);
    assert!(shared_out < 0.01 && repeated > 0.05, "differs by {shared_out}, {repeated}");
}

/// Light that grows evenly: a frame has the mean of what it was while the shutter was open.
#[test]
fn a_frame_has_the_mean_light_of_its_shutter_time() {
    let mut dark = sampled(Scene::default(), 16);
    dark.background = Background::gradient([0.0; 3], [0.0; 3]);
    dark.surface.emission = 0.0;
    let mut bright = dark.clone();
    bright.surface.emission = 0.4;
    for scene in [&mut dark, &mut bright] {
        scene.lights.environment.clear();
        scene.lights.point.clear();
    }
    // From half a second before the light begins to half a second after, when half of it is there.
    let keys = [(0.0, &dark), (1.0, &dark), (2.0, &bright)];
    let keys = keys.map(|(secs, scene)| key(secs, Easing::Linear, scene)).to_vec();
    let path = Path { frames_per_second: 1, shutter: 1.0, keys };
    let emissions = path.shutter_scenes(1, 16).into_iter().map(|scene| scene.surface.emission);
    let mut mean = dark.clone();
    mean.surface.emission = emissions.sum::<f64>() / 16.0;
    assert!(mean.surface.emission > 0.02);
    let still = Path { shutter: 0.0, keys: vec![key(1.0, Easing::Linear, &mean)], ..path.clone() };
    let [blurred, expected, dark] =
        [(&path, 1), (&still, 1), (&Path { shutter: 0.0, ..path.clone() }, 1)]
            .map(|(path, number)| frame(path, number, SIZE));
    let (mean, _) = difference(&blurred, &expected);
    assert!(mean < 0.5, "differs by {mean} levels");
    let (mean, _) = difference(&dark, &expected);
    assert!(mean > 3.0, "all is dark: {mean}");
}

#[test]
fn tiles_of_a_blurred_frame_join() {
    let [mut from, to] = moving(6);
    from.bloom.strength = 0.5;
    let path = path_of(&[from, to], 0.8);
    let whole = frame(&path, 1, SIZE);
    assert_eq!(difference(&whole, &frame(&path, 1, [24, 16])).1, 0);
    // And it is another picture than the sharp one.
    let sharp = frame(&Path { shutter: 0.0, ..path }, 1, SIZE);
    assert!(difference(&whole, &sharp).0 > 1.0);
}

#[test]
fn what_stands_still_is_not_blurred() {
    let [scene, other] = moving(4);
    let path = path_of(&[scene.clone(), scene.clone()], 1.0);
    let sharp = Path { shutter: 0.0, ..path.clone() };
    assert_eq!(frame(&path, 1, SIZE), frame(&sharp, 1, SIZE));
    // A hold's jump at 1.2 s is a cut: the frame at 1 s shows nothing of the other side.
    let keys = vec![key(0.0, Easing::Hold, &scene), key(1.2, Easing::Linear, &other)];
    let cut = Path { keys, ..path };
    assert_eq!(frame(&cut, 1, SIZE), frame(&sharp, 1, SIZE));
}
