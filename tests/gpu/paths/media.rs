//! Fog, and sets that are a medium: closed forms, furnaces, and two ways to gather light.

use glam::DVec3;
use mandelight::{
    formula::{Fractal, section::SectionPlane},
    render::Pace,
    scene::{Background, Camera, Fog, IntegratorKind, Medium, MediumKind, Scene, param, presets},
};
use mandelight_test_support::{
    oracle::rays,
    view::{finished, sampled},
};

use super::{
    SIZE, assert_is_light, mean, plain,
    sampling::{assert_strategies_agree, ball_on_floor},
    scene_of,
    truth::{bowl, furnace},
    under_white_sky,
};

/// The unit ball as a set: points outside of it escape.
const BALL: &str = "name \"Ball\"; step { z = z * length(z); } estimate distance length(p) - 1; bound 1.3; iterations 40;";

/// A medium in a set of that formula.
fn ball_of(medium: Medium) -> Scene {
    let formula = mandelight::formula::own::alone(BALL).expect("a formula");
    let mut scene = plain(Fractal::new(formula), [1.0; 3]);
    scene.camera = Camera::looking_at(DVec3::new(0.5, -2.8, 0.9), DVec3::ZERO, DVec3::Z);
    scene.medium = medium;
    scene
}

/// Fog that falls off upward, seen against a white background.
fn foggy(fog: Fog) -> Scene {
    let mut scene = scene_of("length(p) - 0.4", [0.0; 3]);
    scene.background = Background::gradient([1.0; 3], [1.0; 3]);
    scene.camera = Camera::looking_at(DVec3::new(0.3, -1.6, 0.4), DVec3::ZERO, DVec3::Z);
    scene.fog = fog;
    scene
}

fn kinds_of_fog() -> [Fog; 3] {
    let even = Fog { density: 0.8, color: [0.0; 3], ..Fog::default() };
    let high = Fog { height: Some(0.15), level: -0.1, radius: 2.0, ..even.clone() };
    // The eye is outside.
    let small = Fog { density: 3.0, height: Some(0.3), level: -0.2, radius: 0.7, ..even.clone() };
    [even, high, small]
}

/// The fog's part of the light of a ray over `distance`, by the midpoint rule.
fn passed(scene: &Scene, direction: DVec3, distance: f64) -> f64 {
    const STEPS: u32 = 20_000;
    let unit = scene.camera.view_unit();
    let (fog, eye) = (&scene.fog, scene.camera.position.to_dvec3());
    let way = distance.min(3.0 * unit * (1.0 + fog.radius));
    let step = way / f64::from(STEPS);
    let density = |t: f64| {
        let point = eye + t * direction - scene.camera.pivot.to_dvec3();
        if point.length() > fog.radius * unit {
            return 0.0;
        }
        let over = (point.z / unit - fog.level).max(0.0);
        fog.height.map_or(1.0, |height| (-over / height).exp()) * fog.density / unit
    };
    let depth: f64 = (0..STEPS).map(|i| density((f64::from(i) + 0.5) * step) * step).sum();
    (-depth).exp()
}

#[test]
fn fog_dims_direct_light_as_its_optical_depth_says() {
    for fog in kinds_of_fog() {
        let mut scene = foggy(fog);
        scene.integrator.kind = IntegratorKind::Direct;
        scene.surface.emission = 1.0;
        scene.surface.gradient[0].color = [0.5; 3];
        let view = finished(&sampled(scene.clone(), 1), SIZE, Pace::Still);
        let (film, depths) = (view.film().expect("a film"), view.gbuffer().expect("samples").depth);
        let mut worst = 0.0_f64;
        for (i, (color, depth)) in film.iter().zip(depths).enumerate() {
            let pixel = [i as u32 % SIZE[0], i as u32 / SIZE[0]];
            let direction = rays::direction(&scene.camera, SIZE, pixel);
            let (radiance, distance) =
                if depth > 0.0 { (0.5, f64::from(depth)) } else { (1.0, f64::INFINITY) };
            let expected = radiance * passed(&scene, direction, distance);
            worst = worst.max((f64::from(color[1]) - expected).abs());
        }
        println!("off by {worst:.6}");
        // The rule's own error where the ball of fog ends is 1e-4.
        assert!(worst < 3e-4, "off by {worst}");
    }
}

#[test]
fn paths_meet_as_much_fog_as_direct_light() {
    for fog in kinds_of_fog() {
        let mut scene = foggy(fog);
        // Black things before a white background.
        let traced = finished(&sampled(scene.clone(), 256), SIZE, Pace::Still).film();
        scene.integrator.kind = IntegratorKind::Direct;
        let direct = finished(&sampled(scene, 16), SIZE, Pace::Still).film();
        let (traced, direct) = (traced.expect("a film"), direct.expect("a film"));
        for (traced, direct) in traced.chunks(6 * 48).zip(direct.chunks(6 * 48)) {
            let (traced, direct) = (mean(traced), mean(direct));
            // Four standard errors of what is yes or no.
            let allowed = 4.0 * (0.25 / (6.0 * 48.0 * 256.0_f64)).sqrt();
            assert!((traced - direct).abs() < allowed, "{traced} instead of {direct}");
        }
    }
}

#[test]
fn an_absorbing_ball_dims_its_background_by_its_chords() {
    let scene = |kind| {
        let black = Medium { kind, color: [0.0; 3], mean_free_path: 0.3, ..Medium::default() };
        let mut scene = ball_of(Medium { thin_iterations: 5.0, dense_iterations: 8.0, ..black });
        scene.background = Background::gradient([1.0; 3], [1.0; 3]);
        scene
    };
    for kind in [MediumKind::Set, MediumKind::Iterations] {
        let scene = scene(kind);
        let free_path = 0.3 * scene.camera.view_unit();
        let eye = scene.camera.position.to_dvec3();
        // The steps of |z| -> |z|^2 until the bailout are counted smoothly: by two logarithms.
        let log_bailout = scene.fractal.bailout.ln();
        let density = |radius: f64| {
            if radius <= 1.0 {
                return 1.0;
            }
            let iterations = (log_bailout / radius.ln()).log2();
            let within = kind == MediumKind::Iterations && radius < 1.3;
            if within { ((iterations - 5.0) / 3.0).clamp(0.0, 1.0) } else { 0.0 }
        };
        let expected = |pixel: [f64; 2]| {
            const STEP: f64 = 1e-3;
            let direction = rays::direction_at(&scene.camera, SIZE, pixel);
            let depth: f64 = (0..5000)
                .map(|i| STEP * density((eye + (f64::from(i) + 0.5) * STEP * direction).length()))
                .sum();
            (-depth / free_path).exp()
        };
        let film = finished(&sampled(scene.clone(), 256), SIZE, Pace::Still).film();
        let film = film.expect("a film");
        let (mut found, mut wanted) = (0.0, 0.0);
        for (i, color) in film.iter().enumerate() {
            let [x, y] = [i as u32 % SIZE[0], i as u32 / SIZE[0]].map(f64::from);
            // The mean over a pixel, by four places.
            let places = [[0.25, 0.25], [0.75, 0.25], [0.25, 0.75], [0.75, 0.75]];
            let here: f64 = places.map(|[u, v]| expected([x + u, y + v])).iter().sum::<f64>() / 4.0;
            let off = (f64::from(color[1]) - here).abs();
            assert!(off < 0.2, "{kind:?}, pixel {x}, {y}: {} instead of {here}", color[1]);
            (found, wanted) = (found + f64::from(color[1]), wanted + here);
        }
        println!("{kind:?}: {:.5} of {:.5}", found / film.len() as f64, wanted / film.len() as f64);
        assert!((found / wanted - 1.0).abs() < 0.004, "{kind:?}: {found} instead of {wanted}");
    }
}

#[test]
fn white_media_vanish_in_a_white_sky() {
    let white = |kind, mean_free_path, anisotropy| {
        let medium =
            Medium { kind, mean_free_path, anisotropy, color: [1.0; 3], ..Medium::default() };
        Scene { medium, ..plain(Fractal::default(), [1.0; 3]) }
    };
    let in_fog = |fog: Fog| Scene { fog: Fog { color: [1.0; 3], ..fog }, ..bowl() };
    let [even, high, _] = kinds_of_fog();
    let both = Scene { fog: in_fog(even.clone()).fog, ..white(MediumKind::Set, 0.3, 0.0) };
    let kinds = [
        ("the set", white(MediumKind::Set, 0.15, 0.0)),
        ("the set, forward", white(MediumKind::Set, 0.05, 0.8)),
        ("a cloud, backward", white(MediumKind::Iterations, 0.15, -0.5)),
        ("even fog", in_fog(even)),
        ("high fog", in_fog(high)),
        ("fog about the set", both),
    ];
    for (kind, scene) in kinds {
        let found = furnace(under_white_sky(scene), 32);
        println!("{kind}: {found:.5}");
        assert!((found - 1.0).abs() < 0.005, "{kind}: {found}");
    }
}

#[test]
fn samples_of_lights_and_of_phase_functions_gather_the_same_light() {
    let fog =
        Fog { density: 1.5, anisotropy: 0.5, height: Some(0.4), level: 0.0, ..Fog::default() };
    let foggy = Scene { fog, ..ball_on_floor() };
    let medium =
        Medium { kind: MediumKind::Set, mean_free_path: 0.1, anisotropy: 0.4, ..Medium::default() };
    let mut cloudy = Scene { medium: medium.clone(), ..ball_on_floor() };
    cloudy.fractal = ball_of(medium).fractal;
    cloudy.camera = Camera::looking_at(DVec3::new(0.6, -2.8, 1.4), DVec3::ZERO, DVec3::Z);
    for scene in [foggy, cloudy] {
        assert_strategies_agree(&scene);
    }
}

#[test]
fn extreme_media_give_finite_numbers() {
    let fogs = [
        Fog { density: param::FOG_DENSITY.max, radius: param::FOG_RADIUS.max, ..Fog::default() },
        Fog {
            density: param::FOG_DENSITY.max,
            height: Some(param::FOG_HEIGHT.min),
            level: param::FOG_LEVEL.min,
            anisotropy: param::FOG_ANISOTROPY.min,
            ..Fog::default()
        },
        Fog { density: 1e-6, radius: param::FOG_RADIUS.min, ..Fog::default() },
    ];
    let media = [
        Medium { mean_free_path: param::MEAN_FREE_PATH.min, anisotropy: 0.9, ..Medium::default() },
        Medium { thin_iterations: 1000.0, dense_iterations: 0.0, ..Medium::default() },
        Medium { mean_free_path: param::MEAN_FREE_PATH.max, ..Medium::default() },
    ];
    for (fog, medium) in fogs.into_iter().zip(media) {
        for kind in [MediumKind::None, MediumKind::Set, MediumKind::Iterations] {
            let medium = Medium { kind, ..medium.clone() };
            let mut scene = Scene { fog: fog.clone(), medium, ..ball_on_floor() };
            scene.fractal = Fractal::default();
            let film = finished(&sampled(scene, 8), SIZE, Pace::Still).film().expect("a film");
            assert_is_light(&film);
        }
    }
}

#[test]
fn media_keep_their_light_in_the_depth() {
    // Petals about petals at 1e-20, translucent, and in fog.
    let dive = presets::traced().iter().find(|preset| preset.name == "Deep dahlia").expect("it");
    let mut scene = (dive.scene)();
    scene.integrator.bounces = 4;
    let [surface, translucent, foggy] = [
        scene.clone(),
        Scene { medium: Medium { kind: MediumKind::Set, ..Medium::default() }, ..scene.clone() },
        Scene { fog: Fog { density: 0.5, ..Fog::default() }, ..scene },
    ]
    .map(|scene| {
        let film = finished(&sampled(scene, 8), SIZE, Pace::Still).film().expect("a film");
        assert_is_light(&film);
        mean(&film)
    });
    println!("surface {surface:.4}, translucent {translucent:.4}, foggy {foggy:.4}");
    assert!((0.2..5.0).contains(&(translucent / surface)), "{translucent} of {surface}");
    assert!((0.2..5.0).contains(&(foggy / surface)), "{foggy} of {surface}");
}

#[test]
fn a_cut_takes_away_half_of_a_ball_of_medium() {
    let black =
        Medium { kind: MediumKind::Set, color: [0.0; 3], mean_free_path: 0.3, ..Medium::default() };
    let mut scene = ball_of(black);
    scene.background = Background::gradient([1.0; 3], [1.0; 3]);
    // The plane through the eye and the middle: rays above it meet nothing.
    scene.camera = Camera::looking_at(DVec3::new(0.0, -3.0, 0.0), DVec3::ZERO, DVec3::Z);
    scene.fractal.section_planes.push(SectionPlane::default());
    let film = finished(&sampled(scene, 32), SIZE, Pace::Still).film().expect("a film");
    let row = |y: usize| mean(&film[y * SIZE[0] as usize..][..SIZE[0] as usize]);
    assert!((row(12) - 1.0).abs() < 1e-5, "{}", row(12));
    assert!(row(23) < 0.9, "{}", row(23));
}
