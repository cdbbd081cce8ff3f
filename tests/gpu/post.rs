//! The film as a whole in views: exposure that settles, and tiles that know all of the picture.

use mandelight::{
    gpu::{host_shared::HostShared, readback::Readback},
    render::{Eyes, Pace, Region, View, uniforms::Statistics},
    scene::{Bloom, BloomOrder, Scene, StereoLayout},
};
use mandelight_test_support::{
    compare::assert_same,
    view::{finished, pipelines, pixels, sampled, settle},
};

fn exposed_scene() -> Scene {
    let mut scene = sampled(Scene::default(), 2);
    scene.tone.auto_exposure = true;
    scene
}

fn statistics(view: &View) -> Statistics {
    let gpu = &pipelines().gpu;
    let bytes = Readback::buffer(gpu, &view.post().statistics).wait(gpu).expect("statistics");
    Statistics::read(&bytes)
}

fn assert_mean(view: &View) {
    let film = view.film().expect("the film");
    let size_px = view.region().size_px;
    assert_eq!(film.len() as u32, size_px[0] * size_px[1]);
    let found = statistics(view).mean;
    for (channel, found) in found.into_iter().enumerate() {
        let sum: f64 = film.iter().map(|color| f64::from(color[channel])).sum();
        let expected = sum / film.len() as f64;
        let error = (f64::from(found) - expected).abs();
        assert!(error <= 1e-5 * expected, "{size_px:?}: {found} for {expected}");
    }
}

#[test]
fn the_mean_is_that_of_the_film_shown() {
    for size_px in [[1, 1], [7, 3], [101, 67]] {
        for pace in [Pace::Still, Pace::Interactive] {
            assert_mean(&finished(&exposed_scene(), size_px, pace));
        }
    }
}

/// Two eyes that share the pixels of one leave the film its size, but not its parts.
#[test]
fn a_change_of_layout_leaves_nothing_of_the_one_before() {
    let mut scene = exposed_scene();
    scene.bloom = Bloom { strength: 0.5, threshold: 0.0, ..Bloom::default() };
    let window = Region::whole([50, 30]);
    let mut view = View::new(pipelines(), window, Pace::Interactive);
    for layout in [StereoLayout::Off, StereoLayout::SideBySide, StereoLayout::TopBottom] {
        scene.camera.stereo.layout = layout;
        let region = window.shared_by(layout);
        assert_eq!(region.film_px(), window.film_px());
        let mut fresh = View::new(pipelines(), region, Pace::Interactive);
        view.set_region(region);
        for view in [&mut view, &mut fresh] {
            view.set_scene(&scene, false);
            settle(view);
        }
        assert!(pixels(&view) == pixels(&fresh), "{layout:?}");
    }
}

/// The view's auto exposure after each picture until it rests, stops, on a clock of its own.
fn stops_until_rest(view: &mut View, now_secs: &mut f64) -> Vec<f32> {
    let mut stops = Vec::new();
    let mut pictures = view.report().pictures;
    loop {
        let is_busy = view.pump(*now_secs);
        pipelines().gpu.wait();
        *now_secs += 0.01;
        let report = view.report();
        if report.pictures > pictures {
            pictures = report.pictures;
            stops.push(statistics(view).adapted_stops);
        }
        if !is_busy {
            return stops;
        }
    }
}

/// Where the film is the same on every lattice, exposure goes its way without turning back.
#[test]
fn exposure_goes_straight_to_its_goal_and_rests_there() {
    let mut scene = exposed_scene();
    let eye = scene.camera.position.to_dvec3();
    scene.camera = mandelight::scene::Camera::looking_at(eye, eye * 2.0, glam::DVec3::Z);
    let filled = |scene: &mut Scene, value: f32| {
        scene.background.top = [value; 3];
        scene.background.bottom = [value; 3];
    };
    filled(&mut scene, 0.04);
    let mut view = View::new(pipelines(), Region::whole([33, 20]), Pace::Interactive);
    view.set_scene(&scene, false);
    let mut now_secs = 0.0;
    let dark = *stops_until_rest(&mut view, &mut now_secs).last().expect("a picture");
    for value in [0.8, 0.04] {
        filled(&mut scene, value);
        let before = statistics(&view).adapted_stops;
        view.set_scene(&scene, false);
        let way = stops_until_rest(&mut view, &mut now_secs);
        let goal = *way.last().expect("pictures");
        let still = finished(&scene, [33, 20], Pace::Still);
        assert_eq!(goal, statistics(&still).adapted_stops, "a still differs");
        assert_eq!(pixels(&view), pixels(&still));
        let direction = (goal - before).signum();
        assert!((goal - before).abs() > 4.0);
        assert!(way.windows(2).all(|pair| (pair[1] - pair[0]) * direction >= 0.0), "{way:?}");
        let steps = way.windows(2).filter(|pair| pair[1] != pair[0]).count();
        assert!(steps > 10, "{way:?}");
    }
    assert_eq!(statistics(&view).adapted_stops, dark);
}

/// Whatever a live view went through, its exposure ends as that of the picture alone.
#[test]
fn a_live_view_ends_with_the_exposure_of_a_still() {
    pipelines().specialize(&Scene::default());
    let mut scene = exposed_scene();
    let mut view = finished(&scene, [96, 64], Pace::Interactive);
    for stops in [3.0_f64, -2.0] {
        for light in &mut scene.lights.environment {
            light.intensity *= stops.exp2();
        }
        scene.camera.vertical_fov_deg += 7.0;
        view.set_scene(&scene, false);
        settle(&mut view);
        let still = finished(&scene, [96, 64], Pace::Still);
        let stops = [&view, &still].map(|view| statistics(view).adapted_stops);
        assert!((stops[0] - stops[1]).abs() < 0.02, "{stops:?}");
        assert_same(&pixels(&view), &pixels(&still), [96, 64], "a live view");
    }
}

/// A part of the picture, shown by what is known of all of it, is that part of the whole.
#[test]
fn a_tile_is_exposed_and_blooms_as_the_whole_picture_does() {
    let mut scene = exposed_scene();
    scene.bloom = Bloom { strength: 0.8, threshold: 0.2, ..Bloom::default() };
    for order in [BloomOrder::Before, BloomOrder::After] {
        scene.bloom.order = order;
        let picture_px = [96, 64];
        let whole = finished(&scene, picture_px, Pace::Still);
        let expected = pixels(&whole);
        let region =
            Region { picture_px, origin_px: [32, 16], size_px: [50, 40], eyes: Eyes::Camera };
        let mut tile = View::new(pipelines(), region, Pace::Still);
        tile.lend_post(Some(whole.post()));
        tile.set_scene(&scene, false);
        settle(&mut tile);
        let own = tile.dispatches().passes();
        assert!(!own.contains(&"mean") && !own.contains(&"bloom"), "{own:?}");
        for (row, found) in pixels(&tile).chunks(4 * 50).enumerate() {
            let at = 4 * ((16 + row) * 96 + 32);
            assert_eq!(found, &expected[at..at + 4 * 50], "row {row}");
        }
    }
}
