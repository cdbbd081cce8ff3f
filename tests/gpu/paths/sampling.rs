//! Kinds of samples agree, errors fall as they must, and pieces of a picture are those of the whole.

use glam::DVec3;
use mandelight::{
    formula::Fractal,
    render::{Pace, Region, View},
    scene::{Camera, EnvironmentLight, PointLight, Scene, SurfaceModel},
};
use mandelight_test_support::{
    device::gpu,
    view::{finished, finished_in, pipelines, pixels, sampled, settle},
};

use super::{Gather, SIZE, Tracer, assert_is_light, mean, plain, scene_of, under_white_sky};

/// A ball over a floor, with lights of both kinds and a sky.
pub fn ball_on_floor() -> Scene {
    let distance = "min(p.z + 0.5, length(p - vec3(0, 0, 0.1)) - 0.5)";
    let mut scene = under_white_sky(scene_of(distance, [0.8, 0.6, 0.4]));
    scene.camera =
        Camera::looking_at(DVec3::new(0.6, -2.4, 1.4), DVec3::new(0.0, 0.0, -0.1), DVec3::Z);
    let rig = &mut scene.lights.rig;
    rig.intensity = 0.3;
    rig.sky.ground = [0.1, 0.3, 0.05];
    (rig.sky.sun_strength, rig.sky.sun_size_deg) = (2.0, 20.0);
    scene.lights.environment.push(EnvironmentLight {
        size_deg: 50.0,
        intensity: 0.8,
        shadow_reach: None,
        ..EnvironmentLight::default()
    });
    scene.lights.point.push(PointLight {
        position: DVec3::new(-0.9, -0.5, 0.6).into(),
        radius: 0.4,
        intensity: 0.5,
        ..PointLight::default()
    });
    scene.integrator.bounces = 3;
    scene
}

/// The mean over all pixels, and its standard error by 64 batches of eight samples.
fn mean_of_batches(scene: &Scene, gather: Gather) -> (f64, f64) {
    const BATCHES: u32 = 64;
    let tracer = Tracer::new(scene, gather);
    let means: Vec<f64> = (0..BATCHES).map(|batch| mean(&tracer.film(8 * batch, 8))).collect();
    let count = f64::from(BATCHES);
    let whole = means.iter().sum::<f64>() / count;
    let variance = means.iter().map(|mean| (mean - whole).powi(2)).sum::<f64>() / (count - 1.0);
    (whole, (variance / count).sqrt())
}

#[test]
fn samples_of_lights_and_of_surfaces_gather_the_same_light() {
    let diffuse = ball_on_floor();
    let mut glossy = ball_on_floor();
    glossy.surface.model = SurfaceModel::Physical;
    (glossy.surface.roughness, glossy.surface.metalness, glossy.surface.coat) = (0.5, 0.3, 0.5);
    for scene in [diffuse, glossy] {
        assert_strategies_agree(&scene);
    }
}

/// Checks that samples of lights alone, of directions alone and of both gather the same light.
pub fn assert_strategies_agree(scene: &Scene) {
    let (both, both_error) = mean_of_batches(scene, Gather::Both);
    for gather in [Gather::Lights, Gather::Surfaces] {
        let (found, error) = mean_of_batches(scene, gather);
        let allowed = 4.0 * both_error.hypot(error);
        println!("{gather:?}: {found:.5} ± {error:.5}, both {both:.5} ± {both_error:.5}");
        assert!(allowed < 0.03 * both, "{gather:?}: the errors {allowed} say too little");
        assert!((found - both).abs() < allowed, "{gather:?}: {found} instead of {both}");
    }
}

/// Root mean square of the relative difference to `reference`, over all pixels.
fn error_of(film: &[[f64; 3]], reference: &[[f64; 3]]) -> f64 {
    let scale = reference.iter().flatten().sum::<f64>() / (3 * reference.len()) as f64;
    let pairs = film.iter().flatten().zip(reference.iter().flatten());
    let sum: f64 = pairs.map(|(a, b)| ((a - b) / scale).powi(2)).sum();
    (sum / (3 * film.len()) as f64).sqrt()
}

/// The mean over `batches` batches of `each` samples whose first numbers `first` gives.
fn film_of(
    tracer: &Tracer,
    batches: u32,
    each: u32,
    mut first: impl FnMut(u32) -> u32,
) -> Vec<[f64; 3]> {
    let mut sum = vec![[0.0; 3]; (SIZE[0] * SIZE[1]) as usize];
    for batch in 0..batches {
        for (sum, color) in sum.iter_mut().zip(tracer.film(first(batch), each)) {
            *sum = std::array::from_fn(|i| sum[i] + f64::from(color[i]) / f64::from(batches));
        }
    }
    sum
}

#[test]
fn errors_fall_as_those_of_an_even_sequence() {
    let scene = ball_on_floor();
    let tracer = Tracer::new(&scene, Gather::Both);
    // Samples far along the sequence, of which the pictures below have none.
    let reference = film_of(&tracer, 512, 8, |batch| (1 << 20) + 8 * batch);
    let error = |samples: u32| error_of(&film_of(&tracer, samples / 8, 8, |i| 8 * i), &reference);
    let (few, many) = (error(16), error(256));
    let slope = (many / few).log2() / 4.0;
    // Single samples at places of the sequence that have nothing to do with each other.
    let apart = film_of(&tracer, 256, 1, |i| i.wrapping_mul(0x9E37_79B9) >> 1);
    let independent = error_of(&apart, &reference);
    println!("errors {few:.4}, {many:.4}: slope {slope:.3}; independent numbers {independent:.4}");
    assert!(slope < -0.5, "the error falls with the power {slope} of the samples");
    assert!(many < 0.9 * independent, "{many}, independent numbers {independent}");
}

#[test]
fn pieces_of_a_picture_are_those_of_the_whole() {
    let scene = sampled(ball_on_floor(), 8);
    let whole = finished(&scene, SIZE, Pace::Still).film().expect("a film");
    let region = Region { origin_px: [20, 12], size_px: [20, 16], ..Region::whole(SIZE) };
    let piece = finished_in(&scene, region, Pace::Still).film().expect("a film");
    for (i, found) in piece.iter().enumerate() {
        let [x, y] = [20 + i % 20, 12 + i / 20];
        let wanted = whole[y * SIZE[0] as usize + x];
        let off = (0..3).map(|c| (found[c] - wanted[c]).abs()).fold(0.0, f32::max);
        assert!(off < 1e-4, "pixel {x}, {y}: {found:?} instead of {wanted:?}");
    }
}

#[test]
fn every_number_is_finite() {
    let mut scenes = vec![ball_on_floor()];
    for (roughness, metalness, coat) in [(0.0, 1.0, 0.0), (0.0, 0.0, 1.0), (1.0, 0.5, 0.5)] {
        let mut scene = under_white_sky(plain(Fractal::default(), [1.0; 3]));
        let surface = &mut scene.surface;
        surface.model = SurfaceModel::Physical;
        (surface.roughness, surface.metalness, surface.coat) = (roughness, metalness, coat);
        (surface.coat_roughness, surface.emission) = (0.0, 100.0);
        // Lights inside of the set, around it, and of no extent.
        for (position, radius) in [(DVec3::ZERO, 0.0), (DVec3::X, 10.0), (DVec3::Z, 1e-6)] {
            let position = position.into();
            scene.lights.point.push(PointLight { position, radius, ..PointLight::default() });
        }
        for size_deg in [0.001, 90.0] {
            scene.lights.environment.push(EnvironmentLight { size_deg, ..Default::default() });
        }
        scene.integrator.bounces = 64;
        scenes.push(scene);
    }
    let mut classic = ball_on_floor();
    (classic.surface.specular, classic.surface.shininess) = (1.0, 1.0);
    classic.integrator.bounces = 64;
    scenes.push(classic);
    for scene in scenes {
        let film = finished(&sampled(scene, 16), SIZE, Pace::Still).film().expect("a film");
        assert_is_light(&film);
        assert!(mean(&film) > 0.0);
    }
}

#[test]
fn pictures_end_at_the_noise_that_is_asked_for() {
    let mut scene = sampled(ball_on_floor(), 1024);
    let clean = finished(&sampled(scene.clone(), 2048), SIZE, Pace::Still).film().expect("a film");
    scene.integrator.noise = 0.05;
    let view = finished(&scene, SIZE, Pace::Still);
    let report = view.report();
    assert!((32..1024).contains(&report.samples_done), "{} samples", report.samples_done);
    assert_eq!(report.converged_fraction, Some(1.0));
    // As the pass measures it: over the pixel's value and a tenth of white.
    let luminance = |c: &[f32; 3]| 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
    let film = view.film().expect("a film");
    let errors: Vec<f64> = film
        .iter()
        .zip(&clean)
        .map(|(found, clean)| {
            let (found, clean) = (luminance(found), luminance(clean));
            f64::from((found - clean) / (clean + 0.1))
        })
        .collect();
    let rms = (errors.iter().map(|error| error * error).sum::<f64>() / errors.len() as f64).sqrt();
    let bias = errors.iter().sum::<f64>() / errors.len() as f64;
    println!("{} samples, error {rms:.4}, bias {bias:.5}", report.samples_done);
    assert!(rms < 0.05 && bias.abs() < 0.003, "error {rms}, bias {bias}");
}

/// Mean absolute difference of two pictures, of 255.
fn difference(a: &[u8], b: &[u8]) -> f64 {
    let sum: f64 = a.iter().zip(b).map(|(a, b)| f64::from(a.abs_diff(*b))).sum();
    sum / a.len() as f64
}

#[test]
fn traced_light_takes_the_place_of_direct_light_step_by_step() {
    let mut scene = sampled(ball_on_floor(), 256);
    scene.lights.rig.intensity = 1.0;
    let mut view = View::new(pipelines(), Region::whole(SIZE), Pace::Interactive);
    view.set_scene(&scene, false);
    let mut pictures: Vec<(u32, Vec<u8>)> = Vec::new();
    // A clock on which every pump is due for a display.
    for pump in 0..4000 {
        let goes_on = view.pump(f64::from(pump));
        gpu().wait();
        let report = view.report();
        if report.pictures > pictures.len() as u64 && report.pixels_per_sample == 1 {
            pictures.push((report.samples_done, pixels(&view)));
        }
        if !goes_on {
            break;
        }
    }
    assert!(pictures.len() > 16, "{} pictures", pictures.len());
    let (Some(first), Some(last)) = (pictures.first(), pictures.last()) else { return };
    assert_eq!(last.0, 256);
    let whole = difference(&first.1, &last.1);
    let steps = pictures.windows(2).map(|pair| difference(&pair[0].1, &pair[1].1));
    let largest = steps.fold(0.0, f64::max);
    println!("{} pictures, {whole:.2} in all, {largest:.2} at a step", pictures.len());
    assert!(whole > 3.0, "traced light looks as direct light does: {whole}");
    assert!(largest < 0.4 * whole, "a step of {largest} of {whole}");
}

/// Pixels that have converged in one picture are drawn anew in the next.
#[test]
fn a_picture_after_a_converged_one_is_that_of_a_fresh_view() {
    let mut scene = sampled(ball_on_floor(), 64);
    scene.integrator.noise = 0.5;
    let mut view = finished(&scene, SIZE, Pace::Interactive);
    assert_eq!(view.report().converged_fraction, Some(1.0));
    assert!(view.report().samples_done < 64);
    scene.lights.environment[0].intensity = 3.0;
    scene.integrator.noise = 0.02;
    view.set_scene(&scene, false);
    settle(&mut view);
    let fresh = finished(&scene, SIZE, Pace::Interactive);
    let apart = mean(&view.film().expect("a film")) / mean(&fresh.film().expect("a film")) - 1.0;
    println!("apart by {apart:.5}");
    assert!(apart.abs() < 0.01, "apart by {apart}");
    // Nothing of the direct picture shows any more.
    let still = finished(&scene, SIZE, Pace::Still);
    assert!(difference(&pixels(&view), &pixels(&still)) < 2.0);
}
