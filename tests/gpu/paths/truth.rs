//! White furnaces: surfaces that lose no light look like the sky around them. And spheres, whose light has a closed form.

use glam::DVec3;
use mandelight::{
    formula::Fractal,
    render::Pace,
    scene::{Background, Camera, PointLight, Scene, SurfaceModel},
};
use mandelight_test_support::{
    statistics::quantile,
    view::{finished, sampled},
};

use super::{SIZE, mean, plain, scene_of, under_white_sky};

/// Draws a white surface under a white sky, before a white background, and returns its mean.
pub fn furnace(mut scene: Scene, samples: u32) -> f64 {
    scene.background = Background::gradient([1.0; 3], [1.0; 3]);
    scene.integrator.bounces = 64;
    let film = finished(&sampled(scene, samples), SIZE, Pace::Still).film().expect("a film");
    mean(&film)
}

/// A ball with a deep hollow, from whose inside light needs several bounces.
pub fn bowl() -> Scene {
    let distance = "max(length(p) - 1, 0.85 - length(p - vec3(0, -0.35, 0.35)))";
    let mut scene = under_white_sky(scene_of(distance, [1.0; 3]));
    scene.camera = Camera::looking_at(DVec3::new(0.0, -2.2, 1.6), DVec3::ZERO, DVec3::Z);
    scene
}

#[test]
fn white_surfaces_vanish_in_a_white_sky() {
    let physical = |roughness, metalness, coat| {
        let mut scene = bowl();
        let surface = &mut scene.surface;
        surface.model = SurfaceModel::Physical;
        (surface.roughness, surface.metalness, surface.coat) = (roughness, metalness, coat);
        scene
    };
    let kinds = [
        ("diffuse", bowl()),
        ("smooth metal", physical(0.0, 1.0, 0.0)),
        ("satin metal", physical(0.4, 1.0, 0.0)),
        ("rough metal", physical(1.0, 1.0, 0.0)),
        ("plastic", physical(0.3, 0.0, 0.0)),
        ("stone", physical(0.9, 0.0, 0.0)),
        ("lacquer", physical(0.7, 0.5, 1.0)),
    ];
    for (kind, scene) in kinds {
        let found = furnace(scene, 32);
        println!("{kind}: {found:.5}");
        assert!((found - 1.0).abs() < 0.005, "{kind}: {found}");
    }
}

#[test]
fn a_white_bulb_loses_little_of_a_white_sky() {
    // Some ways out of its crevices take more than 64 bounces.
    let found = furnace(under_white_sky(plain(Fractal::default(), [1.0; 3])), 32);
    println!("{found:.5}");
    assert!((0.985..1.002).contains(&found), "{found}");
}

#[test]
fn a_grey_sphere_reflects_its_part_of_the_sky() {
    // No ray from a sphere meets the sphere again.
    let mut scene = under_white_sky(scene_of("length(p) - 1", [0.5, 0.25, 0.125]));
    scene.camera = Camera::looking_at(DVec3::new(0.0, -2.5, 0.4), DVec3::ZERO, DVec3::Z);
    let view = finished(&sampled(scene, 64), SIZE, Pace::Still);
    let (film, depth) = (view.film().expect("a film"), view.gbuffer().expect("samples").depth);
    for channel in 0..3 {
        let found: Vec<f64> = (film.iter().zip(&depth))
            // The edge's pixels are in part background.
            .filter(|(_, depth)| (0.1..2.2).contains(*depth))
            .map(|(color, _)| f64::from(color[channel]))
            .collect();
        assert!(found.len() > 200, "{} pixels", found.len());
        let mean = found.iter().sum::<f64>() / found.len() as f64;
        let expected = 0.5_f64.powi(channel as i32 + 1);
        assert!((mean / expected - 1.0).abs() < 0.002, "channel {channel}: {mean}");
    }
}

/// The inside of a sphere, seen from within.
fn hollow(albedo: f32) -> Scene {
    let mut scene = scene_of("1 - length(p)", [albedo; 3]);
    scene.camera = Camera::looking_at(DVec3::new(0.0, -0.5, 0.1), DVec3::ZERO, DVec3::Z);
    scene.integrator.bounces = 64;
    scene
}

/// Checks that all of a picture has the radiance `expected`.
fn assert_even(scene: Scene, expected: f64) {
    let film = finished(&sampled(scene, 64), SIZE, Pace::Still).film().expect("a film");
    let found = mean(&film);
    let off = film.iter().map(|color| (f64::from(color[1]) / expected - 1.0).abs()).collect();
    println!("{found:.5} of {expected:.5}, 99 % within {:.4}", quantile(off, 0.99));
    assert!((found / expected - 1.0).abs() < 0.005, "{found} instead of {expected}");
}

#[test]
fn the_inside_of_a_glowing_sphere_gathers_all_its_light() {
    let mut scene = hollow(0.5);
    scene.surface.emission = 0.6;
    // Emission is over the colour: 0.3, and 1 / (1 - albedo) times as much with all bounces.
    assert_even(scene.clone(), 0.6);
    scene.integrator.bounces = 1;
    assert_even(scene, 0.3 * 1.5);
}

#[test]
fn the_inside_of_a_lit_sphere_gathers_all_bounces() {
    for radius in [0.0, 0.2] {
        let mut scene = hollow(0.8);
        scene.lights.point.push(PointLight {
            position: DVec3::ZERO.into(),
            intensity: 0.25,
            radius,
            ..PointLight::default()
        });
        assert_even(scene, 0.25 * 0.8 / 0.2);
    }
}
