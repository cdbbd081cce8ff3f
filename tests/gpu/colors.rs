//! Colours belong to the view: neither the picture's size, nor a movement, nor a small zoom changes them.

use std::ops::ControlFlow;

use glam::DVec3;
use mandelight::{
    export::{StillJob, StillOptions},
    formula::mandelbulb::Mandelbulb,
    gpu::device::in_parallel,
    render::{
        Pace, Region, View,
        pass::{color_histogram, shade},
        space::RenderSpace,
    },
    scene::{Camera, ColorSource, GradientStop, Scene, ToneCurve, presets},
};
use mandelight_test_support::{
    compare::assert_same,
    histogram::{apart, earth_movers_distance, mean_color},
    oracle::{light, rays},
    picture::Picture,
    statistics::quantile,
    view::{finished, pipelines, pixels, rgb, sampled, settle, still},
};

/// Greatest difference of two mean colours, of 255.
const MEAN: f64 = 2.1;
/// Greatest earth mover's distance of two histograms.
const HISTOGRAMS: f64 = 0.03;

/// The scene by its colours alone: lighting shows finer relief in larger pictures.
fn unlit(mut scene: Scene) -> Scene {
    scene.surface.ambient = 1.0;
    scene.surface.diffuse = 0.0;
    scene.surface.specular = 0.0;
    scene.quality.shadows = false;
    scene.tone.curve = ToneCurve::Linear;
    scene.tone.exposure = 0.0;
    sampled(scene, 1)
}

/// The opening scene through a long lens, so that the surface fills the picture.
fn near() -> Scene {
    let mut scene = Scene::default();
    scene.camera.vertical_fov_deg = 8.0;
    unlit(scene)
}

fn dive(name: &str) -> Scene {
    let dive = presets::dives().iter().find(|dive| dive.name == name).expect("the dive");
    unlit((dive.scene)())
}

fn following(mut scene: Scene) -> Scene {
    scene.surface.coloring.follows_view = true;
    scene
}

fn colored_by(source: ColorSource, mut scene: Scene) -> Scene {
    scene.surface.coloring.source = source;
    scene
}

fn assert_same_colors(a: &[[u8; 3]], b: &[[u8; 3]], what: &str) {
    assert_colors_within(a, b, 1.0, what);
}

/// `slack` loosens the limits: of fewer samples, colours scatter more.
fn assert_colors_within(a: &[[u8; 3]], b: &[[u8; 3]], slack: f64, what: &str) {
    let mean = apart(mean_color(a), mean_color(b));
    let distance = earth_movers_distance(a, b);
    assert!(mean <= slack * MEAN, "{what}: mean colours are {mean} of 255 apart");
    assert!(distance <= slack * HISTOGRAMS, "{what}: histograms are {distance} apart");
}

#[test]
fn pictures_of_any_size_have_the_same_colors() {
    let scenes = [
        ("near", near()),
        ("near, by steps", colored_by(ColorSource::Iterations, near())),
        ("near, by the axis", colored_by(ColorSource::AxisTrap, near())),
        ("Vine", dive("Vine")),
        ("Vine, by steps", colored_by(ColorSource::Iterations, dive("Vine"))),
        ("near, following", following(near())),
        ("Vine, following", following(dive("Vine"))),
        ("Vine, following steps", following(colored_by(ColorSource::Iterations, dive("Vine")))),
    ];
    for (name, scene) in scenes {
        let draw = |size| rgb(&finished(&scene, size, Pace::Still));
        let large = draw([700, 500]);
        for size in [[210, 150], [336, 240], [490, 350]] {
            assert_same_colors(&draw(size), &large, &format!("{name} at {size:?}"));
        }
    }
}

/// The samples of a sparse lattice, of a picture that is `width` pixels wide.
fn lattice_samples(pixels: &[[u8; 3]], width: u32, level: u32) -> Vec<[u8; 3]> {
    let (spacing, is_staggered) = (1 << (level / 2), level % 2 == 1);
    let is_sample = |i: u32| {
        let [x, y] = [i % width, i / width];
        let is_left_out = is_staggered && (x + y) / spacing % 2 == 1;
        x % spacing == 0 && y % spacing == 0 && !is_left_out
    };
    (0..).zip(pixels).filter(|(i, _)| is_sample(*i)).map(|(_, pixel)| *pixel).collect()
}

/// The first picture of a movement with few milliseconds a picture, and that of the same view at rest.
fn moving_and_resting(
    scene: &Scene,
    size: [u32; 2],
    motion_budget_ms: f64,
) -> (View, Vec<[u8; 3]>) {
    let mut scene = scene.clone();
    let mut view = View::new(pipelines(), Region::whole(size), Pace::Interactive);
    scene.quality.motion_budget_ms = motion_budget_ms;
    view.set_scene(&scene, false);
    settle(&mut view);
    let resting = rgb(&view);
    // Work of the scene before counts as done only now, on a busy machine.
    pipelines().gpu.wait();
    view.pump(0.0);
    // Another scene, to the schedule; the same picture.
    scene.camera.vertical_fov_deg *= 1.0 + 1e-6;
    view.set_scene(&scene, true);
    let pictures = view.report().pictures;
    while view.report().pictures == pictures {
        view.pump(0.0);
        pipelines().gpu.wait();
    }
    (view, resting)
}

#[test]
fn moving_pictures_have_the_colors_of_resting_ones() {
    for (name, scene) in [("near", near()), ("Vine", dive("Vine"))] {
        let size = [336, 240];
        // How many pixels fit a budget depends on the machine and what else it does.
        let budgets = [4.0, 2.0, 1.0, 0.5, 0.25].into_iter();
        let found = budgets
            .map(|budget| moving_and_resting(&scene, size, budget))
            .find(|(view, _)| view.report().pixels_per_sample > 8);
        let (view, resting) = found.unwrap_or_else(|| panic!("{name}: all pictures were dense"));
        let sparse = view.report().pixels_per_sample;
        let [moving, resting] =
            [rgb(&view), resting].map(|all| lattice_samples(&all, size[0], sparse.ilog2()));
        let slack = (f64::from(sparse) / 16.0).sqrt().max(1.0);
        assert_colors_within(&moving, &resting, slack, name);
    }
}

/// The scene from a part of its distance to the pivot.
fn from_nearer(scene: &Scene, part: f64) -> Scene {
    let Camera { position, pivot, .. } = &scene.camera;
    let way = part * (position - pivot);
    let position = pivot.moved_by(way, 1e-6 * way.length());
    Scene { camera: Camera { position, ..scene.camera.clone() }, ..scene.clone() }
}

/// The part of a picture that a picture from 1/1.1 of the distance shows.
fn seen_next(pixels: &[[u8; 3]], [width, height]: [u32; 2]) -> Vec<[u8; 3]> {
    let is_seen = |place: u32, side: u32| {
        let from_middle = (f64::from(place) + 0.5) / f64::from(side) - 0.5;
        from_middle.abs() < 0.5 / ZOOM
    };
    let indexed = (0..).zip(pixels);
    let seen = indexed.filter(|(i, _)| is_seen(i % width, width) && is_seen(i / width, height));
    seen.map(|(_, pixel)| *pixel).collect()
}

/// Factor of one step of a zoom.
const ZOOM: f64 = 1.1;

/// Width and height of a zoom's pictures.
const ZOOM_PX: [u32; 2] = [144, 96];

/// The pictures of a dive of a hundred steps, from a plain view into a deep one.
fn zoom(follows_view: bool) -> Vec<Vec<[u8; 3]>> {
    let mut dive = dive("Garland");
    dive.surface.gradient = Scene::default().surface.gradient;
    dive.surface.coloring.follows_view = follows_view;
    // A hit distance below the colour distance, as in pictures of 240 lines.
    dive.quality.detail = 0.4;
    let first = 1e-3 / dive.camera.view_unit();
    let scenes: Vec<_> = (0..=100).map(|i| from_nearer(&dive, first / ZOOM.powi(i))).collect();
    let is_deep =
        [0, 100].map(|i| RenderSpace::of(&scenes[i], Region::whole(ZOOM_PX)).reference().is_some());
    assert_eq!(is_deep, [false, true]);
    scenes.iter().map(|scene| rgb(&finished(scene, ZOOM_PX, Pace::Still))).collect()
}

/// The changes of the mean colour from each picture to the next, of 255.
fn changes(pictures: &[Vec<[u8; 3]>], seen: impl Fn(&[[u8; 3]]) -> Vec<[u8; 3]>) -> Vec<f64> {
    let change = |pair: &[Vec<[u8; 3]>]| apart(mean_color(&seen(&pair[0])), mean_color(&pair[1]));
    pictures.windows(2).map(change).collect()
}

/// Each picture has the colours that the same part of the picture before had. Nearer, more of a place's
/// own colour is seen: the mean drifts, by up to 3.1 of 255 in a step, and nothing jumps.
#[test]
fn colors_change_little_with_each_step_of_a_zoom() {
    let changes = changes(&zoom(false), |pixels| seen_next(pixels, ZOOM_PX));
    assert!(quantile(changes.clone(), 0.5) < MEAN, "{changes:.1?}");
    assert!(changes.iter().all(|change| *change < 2.0 * MEAN), "{changes:.1?}");
}

/// Whole pictures keep nearly one mean colour if the gradient follows the view.
#[test]
fn followed_colors_change_little_with_each_step_of_a_zoom() {
    let changes = changes(&zoom(true), <[_]>::to_vec);
    assert!(changes.iter().all(|change| *change < MEAN), "{changes:.1?}");
}

#[test]
fn followed_colors_agree_with_the_oracle() {
    let size = [96, 64];
    for source in [ColorSource::PointTrap, ColorSource::AxisTrap, ColorSource::Iterations] {
        let scene = following(colored_by(source, unlit(Scene::default())));
        let view = finished(&scene, size, Pace::Still);
        let depths = view.gbuffer().expect("samples").depth;
        let hits: Vec<_> = (0_u32..).zip(depths).filter(|(_, depth)| *depth > 0.0).collect();
        let values = in_parallel(&hits, |&(i, depth)| {
            let way = rays::direction(&scene.camera, size, [i % size[0], i / size[0]]);
            let point = scene.camera.position.to_dvec3() + way * f64::from(depth);
            let fractal = Mandelbulb::of(&scene.fractal);
            light::color_value(&fractal, &scene.surface.coloring, point, DVec3::Z)
        });
        let display = rgb(&view);
        let expected = light::positions_in_view(&values).into_iter();
        let off = hits.iter().zip(expected).map(|(&(i, _), position)| {
            let expected = light::display(&scene, light::color_at(&scene, position)).to_array();
            apart(display[i as usize].map(f64::from), expected)
        });
        let off: Vec<_> = off.collect();
        assert!(off.len() > 1000, "{} hits", off.len());
        let (typical, most) = (quantile(off.clone(), 0.5), quantile(off, 0.95));
        assert!(typical < 2.0 && most < 6.0, "{source:?}: off by {typical}, {most}");
    }
}

/// All of the gradient is in the picture, at any depth.
#[test]
fn followed_gradients_are_used_throughout() {
    for scene in [near(), dive("Dahlia"), colored_by(ColorSource::Iterations, dive("Rosette"))] {
        let spread = |scene: &Scene| {
            let mut scene = scene.clone();
            let stop = |position, level| GradientStop { position, color: [level; 3] };
            scene.surface.gradient = vec![stop(0.0, 0.0), stop(0.999, 1.0)];
            let drawn = rgb(&finished(&scene, [96, 64], Pace::Still));
            let levels: Vec<_> = drawn.iter().map(|pixel| f64::from(pixel[0])).collect();
            quantile(levels.clone(), 0.9) - quantile(levels, 0.1)
        };
        let followed = spread(&following(scene));
        assert!(followed > 120.0, "{followed} of 255");
    }
}

/// What a view shows at rest does not depend on how it got there, and stays.
#[test]
fn followed_colors_rest_as_the_still_has_them() {
    let size = [96, 64];
    let scene = following(sampled(Scene::default(), 3));
    let mut view = View::new(pipelines(), Region::whole(size), Pace::Interactive);
    let mut other = following(sampled(dive("Vine"), 1));
    view.set_scene(&other, false);
    settle(&mut view);
    other.camera.vertical_fov_deg = 20.0;
    view.set_scene(&other, true);
    for _ in 0..20 {
        view.pump(0.0);
        pipelines().gpu.wait();
    }
    view.set_scene(&scene, false);
    settle(&mut view);
    let still = still(&scene, size);
    assert_same(&pixels(&view), &still, size, "after another view");
    // A drag that is held until the picture is complete, and then let go.
    let mut turned = scene.clone();
    turned.camera.vertical_fov_deg = 20.0;
    for (scene, moving) in [(&turned, true), (&scene, true), (&scene, false)] {
        view.set_scene(scene, moving);
        settle(&mut view);
    }
    assert_same(&pixels(&view), &still, size, "after a drag");
    let (rested, shaded) = (pixels(&view), view.dispatches().clone());
    for frame in 0..50 {
        assert!(!view.pump(1000.0 + f64::from(frame)));
    }
    assert_eq!(view.dispatches(), &shaded);
    assert_eq!(pixels(&view), rested);
}

#[test]
fn following_the_view_marches_no_camera_ray() {
    let scene = sampled(Scene::default(), 1);
    let mut view = finished(&scene, [96, 64], Pace::Interactive);
    let before = view.dispatches().clone();
    view.set_scene(&following(scene), false);
    settle(&mut view);
    let cost = view.dispatches().since(&before);
    assert!(!cost.passes().contains(&"march"), "{cost:?}");
    assert_eq!(cost.of(&color_histogram::PASS).dispatches, 1);
    // Once with the switch, once with the curve.
    assert!(cost.of(&shade::PASS).samples <= 3 * 96 * 64, "{cost:?}");
}

#[test]
fn tiles_share_the_colors_of_the_whole_picture() {
    let scene = following(sampled(Scene::default(), 2));
    let size = [150, 101];
    let draw = |tile_px| {
        let options = StillOptions { tile_px, ..StillOptions::new(size) };
        let job = StillJob::new(pipelines(), &scene, options, Vec::new()).expect("a still");
        Picture::of(&job.run(|_| ControlFlow::Continue(())).expect("a file")).rgb()
    };
    let (whole, tiles) = (draw([256, 256]), draw([64, 48]));
    let mean = apart(mean_color(&whole), mean_color(&tiles));
    assert!(mean < 0.2, "means are {mean} of 255 apart");
    assert!(earth_movers_distance(&whole, &tiles) < 0.002);
    let differ =
        whole.iter().zip(&tiles).filter(|(a, b)| apart(a.map(f64::from), b.map(f64::from)) > 12.0);
    assert!(differ.count() < 60);
}
