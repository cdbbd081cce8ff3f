//! Moving pictures: what a sparse lattice is spread to, and what becomes of it.

use mandelight::{
    render::{Pace, Region, View},
    scene::Scene,
};
use mandelight_test_support::{
    compare::{assert_same, difference},
    patience::HANG,
    view::{finished, pipelines, pixels, sampled, settle, still},
};

/// A scene whose motion budget is so small that only the sparsest of lattices fit, or so many
/// more as `generosity` says.
fn hurried(generosity: f64) -> Scene {
    let mut scene = sampled(Scene::default(), 1);
    scene.quality.motion_budget_ms = 1e-4 * generosity;
    scene
}

/// Draws the first picture of a movement; the lattice's spacing and whether it is staggered.
fn moved(view: &mut View, scene: &Scene) -> (u32, bool) {
    view.set_scene(scene, true);
    let pictures = view.report().pictures;
    while view.report().pictures == pictures {
        view.pump(0.0);
        pipelines().gpu.wait();
    }
    let level = view.report().pixels_per_sample.ilog2();
    (1 << (level / 2), level % 2 == 1)
}

/// Each sample of the lattice is where it belongs, in the colour that it has in the whole picture, and
/// no pixel between them goes beyond what the samples have.
#[test]
fn samples_keep_their_places_and_colours() {
    pipelines().specialize(&Scene::default());
    let mut seen = std::collections::BTreeSet::new();
    for size in [[96, 64], [101, 67], [41, 3], [1, 1]] {
        for generosity in [1.0, 3e4, 1e5, 3e5] {
            let scene = hurried(generosity);
            let whole = still(&scene, size);
            let mut view = View::new(pipelines(), Region::whole(size), Pace::Interactive);
            view.set_scene(&Scene::default(), false);
            settle(&mut view);
            let (spacing, is_staggered) = moved(&mut view, &scene);
            seen.insert((spacing, is_staggered));
            // How many samples fit depends on the machine. Of a picture with half of them or all, the indirect
            // light differs from the still one's.
            if spacing == 1 {
                continue;
            }
            let shown = pixels(&view);
            let (mut low, mut high) = ([255_u8; 3], [0_u8; 3]);
            let (mut samples, mut far) = (0, 0);
            for (at, pixel) in shown.as_chunks::<4>().0.iter().enumerate() {
                let (x, y) = (at as u32 % size[0], at as u32 / size[0]);
                let is_sample = x % spacing == 0
                    && y % spacing == 0
                    && !(is_staggered && (x + y) / spacing % 2 == 1);
                if is_sample {
                    for channel in 0..3 {
                        let sample = whole[4 * at + channel];
                        samples += 1;
                        far += usize::from(sample.abs_diff(pixel[channel]) > 2);
                        low[channel] = low[channel].min(pixel[channel]);
                        high[channel] = high[channel].max(pixel[channel]);
                    }
                }
            }
            // Rays that graze the surface end a little otherwise in other cones.
            assert!(far <= 3 + samples / 50, "{size:?}, {spacing}: {far} of {samples} are off");
            for pixel in shown.as_chunks::<4>().0 {
                for channel in 0..3 {
                    assert!(pixel[channel] >= low[channel].saturating_sub(2));
                    assert!(pixel[channel] <= high[channel].saturating_add(2));
                }
            }
        }
    }
    assert!(seen.len() >= 2, "lattices of several kinds: {seen:?}");
}

/// What needs to know the film as a whole can be switched on while the film is unfilled.
#[test]
fn an_unfilled_film_gives_way_to_what_needs_it_whole() {
    pipelines().specialize(&Scene::default());
    let scene = hurried(1.0);
    let mut view = View::new(pipelines(), Region::whole([96, 64]), Pace::Interactive);
    view.set_scene(&Scene::default(), false);
    settle(&mut view);
    let mut turned = scene.clone();
    turned.camera.vertical_fov_deg = 40.0;
    moved(&mut view, &turned);
    turned.bloom.strength = 0.4;
    turned.tone.auto_exposure = true;
    view.set_scene(&turned, false);
    settle(&mut view);
    let (mean, _) =
        difference(&pixels(&view), &pixels(&finished(&turned, [96, 64], Pace::Interactive)));
    assert!(mean < 0.5, "mean difference {mean}");
}

/// Frames of the interface come between pieces of work, and are told apart from them.
#[test]
fn frames_of_the_interface_change_nothing() {
    let scene = sampled(Scene::default(), 3);
    let size = [96, 64];
    let mut view = View::new(pipelines(), Region::whole(size), Pace::Interactive);
    view.set_scene(&scene, false);
    let start = std::time::Instant::now();
    let mut now_secs = 0.0;
    // The first ones are waited for, to be measured.
    let (mut waited, mut drawn) = (0, 0);
    while view.pump(now_secs) {
        now_secs = start.elapsed().as_secs_f64();
        if view.request_frame(now_secs) {
            view.time_frame(true, now_secs);
            drawn += 1;
        } else {
            waited += 1;
        }
        view.wait();
        assert!(start.elapsed() < HANG, "the view never rests: {:?}", view.report());
    }
    let usual = finished(&scene, size, Pace::Interactive);
    assert_same(&pixels(&view), &pixels(&usual), size, "the picture");
    assert_eq!(view.report().samples_done, 3);
    assert!(waited > 0 && drawn > 0, "{waited} waits, {drawn} frames");
}
