//! Colours belong to the view: neither the picture's size, nor a movement, nor a small zoom changes them.

use mandelight::{
    render::{Pace, Region, View},
    scene::{Camera, ColorSource, Scene, ToneCurve, presets},
};
use mandelight_test_support::{
    histogram::{apart, earth_movers_distance, mean_color},
    view::{finished, pipelines, rgb, sampled, settle},
};

/// Greatest difference of two mean colours, of 255.
const MEAN: f64 = 2.0;
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

fn colored_by(source: ColorSource, mut scene: Scene) -> Scene {
    scene.surface.coloring.source = source;
    scene
}

fn assert_same_colors(a: &[[u8; 3]], b: &[[u8; 3]], what: &str) {
    let mean = apart(mean_color(a), mean_color(b));
    let distance = earth_movers_distance(a, b);
    println!("{what}: means {mean:.2} of 255 apart, histograms {distance:.4}");
    assert!(mean <= MEAN, "{what}: mean colours are {mean} of 255 apart");
    assert!(distance <= HISTOGRAMS, "{what}: histograms are {distance} apart");
}

#[test]
fn pictures_of_any_size_have_the_same_colors() {
    let scenes = [
        ("near", near()),
        ("near, by steps", colored_by(ColorSource::Iterations, near())),
        ("near, by the axis", colored_by(ColorSource::AxisTrap, near())),
        ("Vine", dive("Vine")),
        ("Vine, by steps", colored_by(ColorSource::Iterations, dive("Vine"))),
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

#[test]
fn moving_pictures_have_the_colors_of_resting_ones() {
    for (name, mut scene) in [("near", near()), ("Vine", dive("Vine"))] {
        let size = [336, 240];
        let mut view = View::new(pipelines(), Region::whole(size), Pace::Interactive);
        scene.quality.motion_budget_ms = 8.0;
        view.set_scene(&scene, false);
        settle(&mut view);
        let resting = rgb(&view);
        // Another scene, to the schedule; the same picture.
        scene.camera.vertical_fov_deg *= 1.0 + 1e-6;
        view.set_scene(&scene, true);
        let pictures = view.report().pictures;
        while view.report().pictures == pictures {
            view.pump(0.0);
            pipelines().gpu.wait();
        }
        let sparse = view.report().pixels_per_sample;
        assert!(sparse > 8, "{name}: one pixel of {sparse} is drawn");
        let [moving, resting] =
            [rgb(&view), resting].map(|all| lattice_samples(&all, size[0], sparse.ilog2()));
        assert_same_colors(&moving, &resting, name);
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

/// A dive of a hundred steps, from a plain view into a deep one: each picture has the colours that the
/// same part of the picture before had.
#[test]
fn colors_change_little_with_each_step_of_a_zoom() {
    let mut dive = dive("Vine");
    // A hit distance below the colour distance, as in pictures of 240 lines.
    dive.quality.detail = 0.4;
    let size = [144, 96];
    let (mut before, mut most) = (None, 0.0_f64);
    let top = 4e-5 / dive.camera.view_unit();
    for step in 0..=100 {
        let scene = from_nearer(&dive, top / ZOOM.powi(step));
        let drawn = rgb(&finished(&scene, size, Pace::Still));
        let change = before.map_or(0.0, |before| apart(before, mean_color(&drawn)));
        most = most.max(change);
        before = Some(mean_color(&seen_next(&drawn, size)));
    }
    assert!(most <= MEAN, "a step changes the mean colour by {most} of 255");
}
