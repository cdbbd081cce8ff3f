//! Depth of field: blurred edges against the share of the lens that sees past them.

use glam::DVec3;
use mandelight::{
    formula::{Fractal, own},
    render::Pace,
    scene::{Background, Camera, GradientStop, Lights, Scene, param},
};
use mandelight_test_support::{
    oracle::rays,
    statistics::quantile,
    view::{finished, sampled},
};

const SIZE: [u32; 2] = [96, 24];
/// Distance from the eye to the pivot and to the wall.
const PIVOT: f64 = 2.0;
const WALL: f64 = 3.0;

/// A glowing wall on the left, seen head on through a lens with this focus, in view units.
fn wall(focus: f64, blades: u32) -> Scene {
    let text = "name \"Wall\"; step { z = z; } bound 4; iterations 2;\n\
                estimate distance max(p.x, abs(p.y - 1.01) - 0.01);";
    let eye = DVec3::new(0.0, -PIVOT, 0.0);
    let mut scene = Scene {
        fractal: Fractal::new(own::alone(text).expect("a formula")),
        camera: Camera::looking_at(eye, DVec3::ZERO, DVec3::Z),
        lights: Lights { environment: Vec::new(), ..Lights::default() },
        background: Background::gradient([0.0; 3], [0.0; 3]),
        ..Scene::default()
    };
    scene.surface.gradient = vec![GradientStop { position: 0.0, color: [1.0; 3] }];
    scene.surface.ambient = 1.0;
    scene.quality.detail = param::DETAIL.min;
    scene.camera.vertical_fov_deg = 10.0;
    let lens = &mut scene.camera.lens;
    (lens.depth_of_field, lens.f_number, lens.focus, lens.blades) = (true, 0.5, focus, blades);
    scene
}

/// For each pixel: where its middle sees the wall's plane, over the blur's radius there, and the pixel's radiance.
fn profile(scene: &Scene) -> Vec<[f64; 2]> {
    let film = finished(scene, SIZE, Pace::Still).film().expect("a film");
    let half_height = scene.camera.half_height(f64::from(SIZE[0]) / f64::from(SIZE[1]));
    let radius = scene.camera.lens.radius(half_height) * PIVOT;
    let sharp = scene.camera.lens.focus * PIVOT;
    let blur = radius * (WALL - sharp).abs() / sharp;
    let place = |i: usize| {
        let pixel = [i as u32 % SIZE[0], i as u32 / SIZE[0]];
        let direction = rays::direction(&scene.camera, SIZE, pixel);
        direction.x / direction.y * WALL / blur.max(1e-9)
    };
    film.iter().enumerate().map(|(i, color)| [place(i), f64::from(color[0])]).collect()
}

/// The share of the unit disc about `x` that lies left of 0: a circular segment.
fn segment(x: f64) -> f64 {
    let x = x.clamp(-1.0, 1.0);
    (x.acos() - x * (1.0 - x * x).sqrt()) / std::f64::consts::PI
}

#[test]
fn an_edge_out_of_focus_is_blurred_by_the_lens_s_disc() {
    for focus in [0.6, 1.0] {
        let scene = sampled(wall(focus, 2), 256);
        let found = profile(&scene);
        let between = found.iter().filter(|[x, _]| x.abs() < 0.9).count();
        assert!(between > 60, "{between} pixels in the blur");
        let off: Vec<f64> = found.iter().map(|[x, light]| (light - segment(*x)).abs()).collect();
        let (mean, most) = (off.iter().sum::<f64>() / off.len() as f64, quantile(off, 0.99));
        println!("focus {focus}: off by {mean:.4}, {most:.4}");
        assert!(mean < 0.008 && most < 0.04, "focus {focus}: off by {mean}, {most}");
    }
}

#[test]
fn what_is_in_focus_is_sharp() {
    let scene = sampled(wall(WALL / PIVOT, 2), 65);
    let found = profile(&scene);
    let grey = found.iter().filter(|[_, light]| (0.02..0.98).contains(light)).count();
    assert!(grey <= 2 * SIZE[1] as usize, "{grey} grey pixels");
    assert!(found.iter().filter(|[_, light]| *light >= 0.98).count() > 900);
}

/// A square aperture blurs a vertical edge by its own profile: that of a square on its corner, or by half of it.
#[test]
fn four_blades_blur_as_a_square() {
    let scene = sampled(wall(1.0, 4), 256);
    // Corners lie on the axes: the share of the square |x| + |y| < 1 left of the edge.
    let square = |x: f64| {
        let x = x.clamp(-1.0, 1.0);
        if x < 0.0 { 1.0 - 0.5 * (1.0 + x).powi(2) } else { 0.5 * (1.0 - x).powi(2) }
    };
    let off: Vec<f64> =
        profile(&scene).iter().map(|[x, light]| (light - square(*x)).abs()).collect();
    let (mean, most) = (off.iter().sum::<f64>() / off.len() as f64, quantile(off, 0.99));
    assert!(mean < 0.008 && most < 0.04, "off by {mean}, {most}");
}
