//! The denoiser: nearer to the truth than what it gets, and nothing lost.

use std::{io::Cursor, ops::ControlFlow};

use super::{mean, plain, sampling::ball_on_floor, under_white_sky};
use crate::exr::read_exr;
use glam::{DQuat, DVec3};
use mandelight::{
    export::{PictureFormat, StillJob, StillOptions},
    formula::Fractal,
    render::{Eyes, Pace, Region, View},
    scene::{Camera, GradientStop, IntegratorKind, Scene, StereoLayout},
};
use mandelight_test_support::{
    device::pipelines,
    picture::Picture,
    view::{finished, finished_in, pixels, sampled, settle},
};

const SIZE: [u32; 2] = [96, 72];
const SIZE_OF_STILL: [u32; 2] = [200, 150];

/// Colourful bulbs in soft light.
fn bulb() -> Scene {
    let mut scene = under_white_sky(plain(Fractal::default(), [1.0; 3]));
    let color = |position, color| GradientStop { position, color };
    scene.surface.gradient = vec![color(0.0, [0.8, 0.3, 0.1]), color(0.5, [0.1, 0.4, 0.8])];
    scene
}

fn denoised(scene: &Scene, samples: u32) -> View {
    let mut scene = sampled(scene.clone(), samples);
    scene.integrator.denoise = true;
    finished(&scene, SIZE, Pace::Still)
}

/// Root mean square of the relative difference, where dark pixels count as those of a tenth of white.
fn error_of(film: &[[f32; 3]], reference: &[[f32; 3]]) -> f64 {
    let pairs = film.iter().flatten().zip(reference.iter().flatten());
    let sum: f64 = pairs.map(|(a, b)| f64::from((a - b) / (b + 0.1)).powi(2)).sum();
    (sum / (3 * film.len()) as f64).sqrt()
}

#[test]
fn denoised_light_is_nearer_to_the_truth() {
    // In the bulb almost every pixel differs from those beside it: there is little to gain.
    let gains = [("floor", ball_on_floor(), [0.65, 0.8, 0.95]), ("bulb", bulb(), [0.9, 1.0, 1.03])];
    for (name, scene, gains) in gains {
        let reference =
            finished(&sampled(scene.clone(), 2048), SIZE, Pace::Still).film().expect("a film");
        for (samples, gain) in [8, 32, 128].into_iter().zip(gains) {
            let view = denoised(&scene, samples);
            let noisy = view.film().expect("a film");
            let smooth = view.denoised().expect("a film").expect("denoised light");
            let (before, after) = (error_of(&noisy, &reference), error_of(&smooth, &reference));
            let bias = mean(&smooth) / mean(&noisy) - 1.0;
            println!("{name}, {samples} samples: {before:.4}, denoised {after:.4}, bias {bias:.4}");
            assert!(after < gain * before, "{name}: {after} instead of {before}");
            assert!(bias.abs() < 0.01, "{name}: {bias} of all light");
        }
    }
}

/// What a sequence's frames get wrong changes from frame to frame, which people see as flicker.
#[test]
fn denoised_frames_flicker_less() {
    let still = ball_on_floor();
    let mut turned = still.clone();
    let camera = &still.camera;
    let turn = DQuat::from_rotation_z(0.3_f64.to_radians());
    turned.camera = Camera::looking_at(
        turn * camera.position.to_dvec3(),
        turn * camera.pivot.to_dvec3(),
        turn * (camera.rotation() * DVec3::Y),
    );
    turned.camera.vertical_fov_deg = camera.vertical_fov_deg;
    let frames = [still, turned].map(|scene| {
        let truth = finished(&sampled(scene.clone(), 512), SIZE, Pace::Still);
        let view = denoised(&scene, 16);
        let smooth = view.denoised().expect("a film").expect("denoised light");
        [truth.film().expect("a film"), view.film().expect("a film"), smooth]
    });
    // Of one kind of picture: the error of the second frame as it would be if the first were the truth.
    let flicker = |kind: usize| {
        let [[first_truth, ..], [truth, ..]] = &frames;
        let changed = |index: usize| {
            let of = |channel: usize| {
                let error = frames[0][kind][index][channel] - first_truth[index][channel];
                frames[1][kind][index][channel] - error
            };
            [of(0), of(1), of(2)]
        };
        error_of(&(0..truth.len()).map(changed).collect::<Vec<_>>(), truth)
    };
    let (noisy, smooth) = (flicker(1), flicker(2));
    println!("flicker {noisy:.4}, denoised {smooth:.4}");
    assert!(smooth < 0.8 * noisy, "{smooth} instead of {noisy}");
}

/// A file of this format.
fn still(
    size_px: [u32; 2],
    scene: &Scene,
    tile_px: [u32; 2],
    format: PictureFormat,
    denoise: Option<bool>,
) -> Vec<u8> {
    let options = StillOptions { tile_px, format, denoise, ..StillOptions::new(size_px) };
    let job = StillJob::new(pipelines(), scene, options, Vec::new()).expect("a job");
    job.run(|_| ControlFlow::Continue(())).expect("a picture")
}

#[test]
fn denoised_tiles_have_no_seams() {
    let mut scene = sampled(ball_on_floor(), 4);
    scene.integrator.denoise = true;
    let decode = |bytes: Vec<u8>| Picture::decode(Cursor::new(bytes)).expect("a PNG").bytes;
    let apart = |a: &[u8], b: &[u8]| a.iter().zip(b).map(|(a, b)| a.abs_diff(*b)).max();
    // On a CPU adapter the wide picture is denoised in parts of 40 rows, which no tile is.
    for (size_px, tile_px) in [(SIZE_OF_STILL, [72, 24]), ([1600, 64], [400, 64])] {
        let png =
            |tile_px, denoise| decode(still(size_px, &scene, tile_px, PictureFormat::Png, denoise));
        let whole = png([2048; 2], None);
        let tiles = png(tile_px, None);
        let noisy = png([2048; 2], Some(false));
        assert!(apart(&whole, &tiles) <= Some(1), "{:?}", apart(&whole, &tiles));
        assert!(apart(&whole, &noisy) > Some(20), "nothing was denoised");
    }
}

#[test]
fn open_exr_keeps_its_noise_unless_asked() {
    let mut scene = sampled(bulb(), 4);
    let plain = still(SIZE_OF_STILL, &scene, [2048; 2], PictureFormat::Exr, None);
    scene.integrator.denoise = true;
    let of_scene = still(SIZE_OF_STILL, &scene, [2048; 2], PictureFormat::Exr, None);
    let asked = still(SIZE_OF_STILL, &scene, [2048; 2], PictureFormat::Exr, Some(true));
    let read = |bytes: &[u8]| {
        let image = read_exr(bytes).expect("an OpenEXR file");
        let channels = image.layer_data.channel_data.list;
        let values = |name: &str| -> Vec<f32> {
            let channel = channels.iter().find(|channel| channel.name.eq(name));
            channel.expect(name).sample_data.values_as_f32().collect()
        };
        ["R", "albedo.R", "albedo.B", "normal.X", "normal.Y", "normal.Z", "Z"].map(values)
    };
    let [plain, of_scene, asked] = [&plain, &of_scene, &asked].map(|bytes| read(bytes));
    assert!(plain[0] == of_scene[0] && plain[0] != asked[0]);
    let [_, red, blue, x, y, z, depth] = plain;
    for i in 0..depth.len() {
        let length = (x[i] * x[i] + y[i] * y[i] + z[i] * z[i]).sqrt();
        assert!(length < 1.02 && (0.0..=1.0).contains(&red[i]), "{length}, {}", red[i]);
        // Between the two colours, or in part background.
        assert!(red[i] >= 0.06 && blue[i] >= 0.06, "{} {}", red[i], blue[i]);
    }
    let of_bulb = depth.iter().filter(|depth| depth.is_finite()).count();
    let lit = x.iter().zip(&z).filter(|(x, z)| x.hypot(**z) > 0.1).count();
    assert!(lit > of_bulb / 2, "{lit} normals of {of_bulb} points");
}

#[test]
fn the_firefly_limit_says_what_it_took_away() {
    let mut scene = sampled(ball_on_floor(), 64);
    let whole = finished(&scene, SIZE, Pace::Still);
    assert_eq!(whole.report().clamped_light, None);
    let luminance = |film: &[[f32; 3]]| {
        let weights = [0.2126, 0.7152, 0.0722];
        let pixels = film.iter().map(|c| (0..3).map(|i| f64::from(c[i]) * weights[i]).sum::<f64>());
        pixels.sum::<f64>()
    };
    scene.integrator.firefly_limit = Some(1.0);
    let limited = finished(&scene, SIZE, Pace::Still);
    let light = limited.report().clamped_light.expect("what was taken away");
    // The limited picture lacks what was taken away: the background, which no limit holds, is black.
    let [all, left] = [&whole, &limited].map(|view| luminance(&view.film().expect("a film")));
    let lost = 1.0 - left / all;
    println!("lost {lost:.5}, told {:.5}", light.fraction());
    assert!(lost > 0.01, "the limit took nothing: {lost}");
    assert!((light.fraction() / lost - 1.0).abs() < 0.03, "{} instead of {lost}", light.fraction());
    // A single path is never brighter than the limit.
    let mut one = sampled(scene, 1);
    one.integrator.denoise = false;
    let film = finished(&one, SIZE, Pace::Still).film().expect("a film");
    assert!(film.iter().all(|pixel| luminance(&[*pixel]) < 1.0 + 1e-5));
}

/// Paths keep the denoiser's guides where direct light has its shadows.
#[test]
fn direct_light_after_paths_is_that_of_a_fresh_view() {
    let mut scene = sampled(bulb(), 8);
    scene.lights.environment = Scene::default().lights.environment;
    for denoise in [false, true] {
        scene.integrator.kind = IntegratorKind::Path;
        scene.integrator.denoise = denoise;
        let mut view = finished(&scene, SIZE, Pace::Interactive);
        scene.integrator.kind = IntegratorKind::Direct;
        view.set_scene(&scene, false);
        settle(&mut view);
        let fresh = finished(&scene, SIZE, Pace::Interactive);
        let [found, wanted] = [&view, &fresh].map(|view| view.film().expect("a film"));
        let pairs = found.iter().flatten().zip(wanted.iter().flatten());
        // Rays that start at a known point may end on the other side of a shadow's edge.
        let apart = pairs.filter(|(a, b)| (*a - *b).abs() > 1e-3).count();
        assert!(apart < found.len() / 100, "{apart} values of {} pixels are apart", found.len());
        assert_eq!(view.report().memory, fresh.report().memory);
    }
}

#[test]
fn switching_the_denoiser_traces_nothing() {
    let mut scene = sampled(ball_on_floor(), 64);
    let mut view = finished(&scene, SIZE, Pace::Interactive);
    let before = view.dispatches().clone();
    let noisy = pixels(&view);
    scene.integrator.denoise = true;
    view.set_scene(&scene, false);
    settle(&mut view);
    let new = view.dispatches().since(&before);
    assert_eq!(new.passes(), ["denoise", "denoise_input", "tone"]);
    assert_ne!(pixels(&view), noisy);
}

/// A pair of pictures beside each other, each as the single eye's.
#[test]
fn the_eyes_of_a_pair_do_not_mix() {
    let mut scene = sampled(ball_on_floor(), 8);
    scene.integrator.denoise = true;
    scene.camera.stereo.layout = StereoLayout::SideBySide;
    let picture_px = SIZE;
    let region = |eyes| Region { eyes, ..Region::whole(picture_px) };
    let light = |eyes| {
        let view = finished_in(&scene, region(eyes), Pace::Still);
        view.denoised().expect("a film").expect("denoised light")
    };
    let (both, right) = (light(Eyes::Beside), light(Eyes::Right));
    let width = SIZE[0] as usize;
    for (both, right) in both.chunks(2 * width).zip(right.chunks(width)) {
        for (a, b) in both[width..].iter().flatten().zip(right.iter().flatten()) {
            assert!((a - b).abs() < 0.01 * b.abs().max(0.01), "{a} instead of {b}");
        }
    }
}
