//! Stills that take the samples of a finished view are those that are rendered.

use std::ops::ControlFlow;

use exr::prelude::{AnyChannel, FlatSamples};
use mandelight::{
    export::{PictureFormat, StillJob, StillOptions},
    render::{
        Pace, View,
        display_values::DisplayValues,
        pass::{march, scatter},
    },
    scene::{Bloom, Indirect, IndirectKind, IntegratorKind, Scene, presets},
};
use mandelight_test_support::{
    compare::{RESIZED, assert_same, assert_within},
    device::pipelines,
    picture::Picture,
    view::{finished, pixels, rgb, sampled, settle},
};

use crate::exr::read_exr;

/// Rows of several tiles, were they rendered.
const SIZE: [u32; 2] = [90, 60];

fn direct() -> Scene {
    let mut scene = sampled((presets::opening_scenes()[0].scene)(), 3);
    scene.tone.auto_exposure = true;
    scene.bloom = Bloom { strength: 0.5, threshold: 0.3, ..Bloom::default() };
    scene.indirect = Indirect { kind: IndirectKind::Uniform, ..Indirect::default() };
    scene
}

fn following() -> Scene {
    // The centre samples of fine detail depend on the lattices before them; further samples don't.
    let scene = sampled((presets::opening_scenes()[1].scene)(), 8);
    assert!(scene.surface.follows_view());
    scene
}

fn traced(denoise: bool, noise: f64) -> Scene {
    let mut scene = sampled(Scene::default(), 32);
    scene.integrator.kind = IntegratorKind::Path;
    (scene.integrator.denoise, scene.integrator.noise) = (denoise, noise);
    scene
}

/// Whether a still of the scene reuses a view's samples.
fn reuses(view: &View, scene: &Scene) -> bool {
    view.still_of_samples(scene, None, DisplayValues::default()).is_some()
}

/// A file, with the samples of a view if there is one.
fn file_of(scene: &Scene, options: StillOptions, view: Option<&View>) -> Vec<u8> {
    let job = StillJob::new(pipelines(), scene, options, Vec::new()).expect("a job");
    let job = match view {
        Some(view) => job.with_samples_of(view),
        None => job,
    };
    job.run(|_| ControlFlow::Continue(())).expect("a file")
}

fn options(format: PictureFormat, is_deep: bool) -> StillOptions {
    StillOptions { format, is_deep, tile_px: [32, 24], ..StillOptions::new(SIZE) }
}

/// The picture on the screen is saved as it is.
#[test]
fn a_finished_view_shows_what_a_still_shows() {
    let scenes = [
        ("direct", direct()),
        ("following", following()),
        ("paths", traced(false, 0.0)),
        ("denoised", traced(true, 0.0)),
        ("to a noise", traced(false, 0.2)),
    ];
    for (name, scene) in scenes {
        let shown = pixels(&finished(&scene, SIZE, Pace::Interactive));
        let saved = Picture::of(&file_of(&scene, options(PictureFormat::Png, false), None)).rgb();
        let saved: Vec<u8> = saved.iter().flat_map(|&[r, g, b]| [r, g, b, 255]).collect();
        assert_within(&shown, &saved, SIZE, RESIZED, name);
    }
}

/// Every channel of an OpenEXR file.
fn channels(file: &[u8]) -> Vec<(String, Vec<f32>)> {
    let channels = read_exr(file).expect("an OpenEXR file").layer_data.channel_data.list;
    let values = |channel: &AnyChannel<FlatSamples>| channel.sample_data.values_as_f32().collect();
    channels.iter().map(|channel| (channel.name.to_string(), values(channel))).collect()
}

#[test]
fn files_with_the_samples_of_a_still_are_those_that_are_rendered() {
    for scene in [direct(), following(), traced(true, 0.0), traced(false, 0.0)] {
        let view = finished(&scene, SIZE, Pace::Still);
        assert!(reuses(&view, &scene));
        let files = |format, is_deep| {
            let options = options(format, is_deep);
            let whole = StillOptions { tile_px: SIZE, ..options.clone() };
            [file_of(&scene, options, Some(&view)), file_of(&scene, whole, None)]
        };
        let [taken, rendered] = files(PictureFormat::Png, true);
        assert!(taken == rendered, "another PNG");
        let [taken, rendered] = files(PictureFormat::Exr, false).map(|file| channels(&file));
        assert_eq!(taken.len(), if scene.traces_paths() { 16 } else { 10 });
        // Depths of the background are infinite, never NaN.
        assert!(taken == rendered, "another OpenEXR file");
    }
}

/// The radiance in an OpenEXR file.
fn radiance(file: &[u8]) -> Vec<[f32; 3]> {
    let channels = channels(file);
    let of = |name: &str| &channels.iter().find(|channel| channel.0 == name).expect(name).1;
    let [r, g, b] = ["R", "G", "B"].map(of);
    (0..r.len()).map(|i| [r[i], g[i], b[i]]).collect()
}

#[test]
fn files_of_the_picture_on_the_screen_have_its_samples() {
    for (name, scene) in
        [("direct", direct()), ("following", following()), ("denoised", traced(true, 0.0))]
    {
        let view = finished(&scene, SIZE, Pace::Interactive);
        let film = view.film().expect("the film's bytes");
        let exr = file_of(&scene, options(PictureFormat::Exr, false), Some(&view));
        assert!(radiance(&exr) == film, "{name}: other samples");
        let deep = Picture::of(&file_of(&scene, options(PictureFormat::Png, true), Some(&view)));
        let high = deep.bytes.as_chunks::<2>().0.iter().map(|&[high, _]| high);
        let shown = rgb(&view).into_flattened();
        assert_eq!(deep.bytes.len(), 2 * shown.len());
        // Eight bits are rounded and dithered.
        let is_shown = high.zip(shown).all(|(high, shown)| high.abs_diff(shown) <= 2);
        assert!(is_shown, "{name}: another picture");
        assert_eq!(view.film().expect("the film's bytes"), film);
    }
}

#[test]
fn a_still_of_samples_computes_none() {
    for scene in [direct(), traced(true, 0.0)] {
        let mut view = finished(&scene, SIZE, Pace::Interactive);
        let shown = pixels(&view);
        let still = view.still_of_samples(&scene, None, DisplayValues::default());
        // The view goes on with something else.
        view.set_scene(&following(), false);
        settle(&mut view);
        let mut still = still.expect("the samples of the picture");
        settle(&mut still);
        for pass in [&march::PASS, &scatter::PASS] {
            assert_eq!(still.dispatches().of(pass).dispatches, 0, "{}", pass.name);
        }
        assert_same(&pixels(&still), &shown, SIZE, "the still");
    }
}

#[test]
fn samples_of_another_picture_are_not_taken() {
    let scene = direct();
    let view = finished(&scene, SIZE, Pace::Interactive);
    let is_taken = |scene: &Scene| reuses(&view, scene);
    assert!(is_taken(&scene));
    let brighter = {
        let mut scene = scene.clone();
        scene.tone.exposure += 1.0;
        scene
    };
    assert!(is_taken(&brighter), "exposure changes no sample");
    assert!(!is_taken(&sampled(scene.clone(), 2)), "the film has more samples");
    assert!(!is_taken(&sampled(scene.clone(), 4)), "the film has fewer samples");
    assert!(!is_taken(&following()), "another scene");
    let mut unlit = scene.clone();
    unlit.surface.diffuse *= 0.5;
    assert!(!is_taken(&unlit), "other light");
    // Where they are not taken, the file is rendered.
    let transparent = StillOptions { is_transparent: true, ..options(PictureFormat::Png, false) };
    let files = [Some(&view), None].map(|view| file_of(&scene, transparent.clone(), view));
    assert!(files[0] == files[1], "another transparent picture");
    let smaller = StillOptions { size_px: [61, 40], ..options(PictureFormat::Exr, false) };
    let files = [Some(&view), None].map(|view| radiance(&file_of(&scene, smaller.clone(), view)));
    assert!(files[0] == files[1], "another picture of another size");
}

/// More noise needs fewer samples, and exposure decides how much of it is seen.
#[test]
fn samples_for_another_noise_are_not_taken() {
    let scene = traced(false, 0.5);
    let scene = sampled(scene, 4096);
    let view = finished(&scene, SIZE, Pace::Interactive);
    assert!(view.report().samples_done < 4096, "no pixel was clean");
    assert!(reuses(&view, &scene));
    let mut finer = scene.clone();
    finer.integrator.noise = 0.1;
    assert!(!reuses(&view, &finer));
    let mut brighter = scene;
    brighter.tone.exposure += 1.0;
    assert!(!reuses(&view, &brighter));
}

/// The lights keep the bits under which their shadows are stored.
#[test]
fn samples_are_taken_after_a_light_went() {
    let mut scene = direct();
    assert!(scene.lights.environment.len() > 1);
    let mut view = finished(&scene, SIZE, Pace::Interactive);
    scene.lights.environment.remove(0);
    view.set_scene(&scene, false);
    settle(&mut view);
    assert!(reuses(&view, &scene));
}
