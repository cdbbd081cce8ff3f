//! What the pixels of stills hold: 16 bits per channel, transparent backgrounds.

use std::{collections::BTreeSet, io::Cursor, ops::ControlFlow, sync::Arc};

use glam::DVec3;
use image_webp::WebPDecoder;
use mandelight::{
    export::{ExportError, Eye, PictureFormat, StillJob, StillOptions},
    scene::{
        Background, Bloom, Camera, Indirect, IndirectKind, IntegratorKind, Lens, Path, Scene,
        StereoLayout, ToneCurve,
        path::{Easing, Key},
        presets,
    },
};
use mandelight_test_support::{device::pipelines, picture::Picture, view::sampled};

fn still(scene: &Scene, options: StillOptions) -> Vec<u8> {
    let job = StillJob::new(pipelines(), scene, options, Vec::new()).unwrap();
    job.run(|_| ControlFlow::Continue(())).unwrap()
}

fn deep(size_px: [u32; 2]) -> StillOptions {
    StillOptions { is_deep: true, ..StillOptions::new(size_px) }
}

/// The channels of a PNG of 16 bits.
fn channels(file: &[u8]) -> Vec<u16> {
    let bytes = Picture::of(file).bytes;
    bytes.as_chunks::<2>().0.iter().map(|&channel| u16::from_be_bytes(channel)).collect()
}

/// Nothing but background: a camera far from the set that looks away from it.
fn empty(background: Background) -> Scene {
    let eye = DVec3::new(0.0, -20.0, 0.0);
    Scene { camera: Camera::looking_at(eye, 1.1 * eye, DVec3::Z), background, ..Scene::default() }
}

/// Rows of a gradient have the values of the closed form, far finer than steps of 8 bits.
#[test]
fn sixteen_bits_resolve_a_gradient() {
    let (top, bottom) = ([0.1_f32, 0.4, 0.9], [0.2_f32, 0.1, 0.05]);
    let mut scene = sampled(empty(Background::gradient(top, bottom)), 1);
    scene.tone.curve = ToneCurve::Linear;
    scene.tone.exposure = -0.5;
    scene.tone.auto_exposure = false;
    scene.bloom = Bloom { strength: 0.0, ..Bloom::default() };
    let height = 2000;
    let channels = channels(&still(&scene, deep([2, height])));
    for channel in 0..3 {
        let mut levels = BTreeSet::new();
        for y in 0..height as usize {
            let value = channels[6 * y + channel];
            levels.insert(value);
            let part = (y as f64 + 0.5) / f64::from(height);
            let linear = f64::from(top[channel])
                + part * (f64::from(bottom[channel]) - f64::from(top[channel]));
            let linear = linear * (-0.5_f64).exp2();
            let encoded = 1.055 * linear.powf(1.0 / 2.4) - 0.055;
            let error = f64::from(value) - encoded * 65535.0;
            assert!(error.abs() < 6.0, "row {y}, channel {channel}: {value} is off by {error}");
        }
        assert!(levels.len() > 1500, "channel {channel} has {} levels", levels.len());
    }
}

/// Dither moves a value by half a step at most, and rounding by 0.6, as Direct3D and Vulkan allow.
const MOST_STEPS: f64 = 1.11;

/// With every effect that the display has, 16 bits are the picture of 8 bits before it was rounded and dithered.
#[test]
fn sixteen_bits_round_to_the_picture_of_eight() {
    let size_px = [101, 67];
    for preset in presets::opening_scenes().iter().take(4) {
        let mut scene = sampled((preset.scene)(), 2);
        scene.tone.auto_exposure = true;
        scene.bloom = Bloom { strength: 0.5, threshold: 0.3, ..Bloom::default() };
        let eight = Picture::of(&still(&scene, StillOptions::new(size_px))).bytes;
        let sixteen = channels(&still(&scene, deep(size_px)));
        assert_eq!(eight.len(), sixteen.len());
        for (&eight, &sixteen) in eight.iter().zip(&sixteen) {
            let steps = f64::from(sixteen) / 257.0 - f64::from(eight);
            assert!(steps.abs() < MOST_STEPS, "{}: {sixteen} is {steps} from {eight}", preset.name);
        }
        let repeated = sixteen.iter().filter(|&channel| channel >> 8 == channel & 255).count();
        assert!(repeated < sixteen.len() / 4, "{}: bytes repeat", preset.name);
    }
}

#[test]
fn tiles_and_eyes_have_sixteen_bits_too() {
    let mut scene = sampled(Scene::default(), 2);
    for layout in [
        StereoLayout::Off,
        StereoLayout::SideBySide,
        StereoLayout::TopBottom,
        StereoLayout::Anaglyph,
    ] {
        scene.camera.stereo.layout = layout;
        for tile_px in [[4096, 4096], [20, 13]] {
            let options = StillOptions { tile_px, ..StillOptions::new([61, 47]) };
            let eight = Picture::of(&still(&scene, options.clone())).bytes;
            let sixteen = channels(&still(&scene, StillOptions { is_deep: true, ..options }));
            assert_eq!(eight.len(), sixteen.len(), "{layout:?} in {tile_px:?}");
            let near =
                |(a, b): (&u16, &u8)| (f64::from(*a) / 257.0 - f64::from(*b)).abs() < MOST_STEPS;
            assert!(sixteen.iter().zip(&eight).all(near), "{layout:?} in {tile_px:?}");
        }
    }
}

/// Options for a transparent background.
fn transparent(size_px: [u32; 2]) -> StillOptions {
    StillOptions { is_transparent: true, ..StillOptions::new(size_px) }
}

/// Red, green, blue and alpha of a still with 16 bits per channel and a transparent background.
fn pixels(scene: &Scene, options: StillOptions) -> Vec<[u16; 4]> {
    let file = still(scene, StillOptions { is_deep: true, is_transparent: true, ..options });
    channels(&file).as_chunks().0.to_vec()
}

/// IEC 61966-2-1, from a channel of 16 bits to linear light.
fn linear(channel: u16) -> f64 {
    let encoded = f64::from(channel) / 65535.0;
    if encoded <= 0.04045 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
}

/// A scene of each kind of light, without effects that reach from a pixel to others.
fn scenes() -> Vec<(&'static str, Scene)> {
    let mut plain = sampled(Scene::default(), 16);
    plain.tone.curve = ToneCurve::Linear;
    plain.tone.exposure = -3.0;
    plain.tone.auto_exposure = false;
    plain.bloom.strength = 0.0;
    plain.background = Background::gradient([0.3, 0.8, 0.5], [0.9, 0.2, 0.4]);
    let mut wide = plain.clone();
    wide.camera.lens = Lens { depth_of_field: true, f_number: 1.0, ..Lens::default() };
    let mut traced = plain.clone();
    traced.integrator.kind = IntegratorKind::Path;
    traced.integrator.denoise = false;
    traced.integrator.noise = 0.0;
    let mut around = plain.clone();
    around.indirect = Indirect { kind: IndirectKind::Horizon, ..Indirect::default() };
    let mut foggy = plain.clone();
    foggy.fog.density = 0.05;
    let mut foggy_paths = traced.clone();
    foggy_paths.fog.density = 0.05;
    vec![
        ("direct", plain),
        ("lens", wide),
        ("paths", traced),
        ("indirect", around),
        ("fog", foggy),
        ("fog and paths", foggy_paths),
    ]
}

/// Over any background, the transparent picture is the picture with that background.
#[test]
fn a_transparent_picture_composes_to_the_opaque_one() {
    let size_px = [48, 40];
    for (name, mut scene) in scenes() {
        let own = pixels(&scene, StillOptions::new(size_px));
        for (top, bottom) in [([0.0_f32; 3], [0.0_f32; 3]), ([1.0, 0.5, 0.1], [0.2, 0.9, 1.0])] {
            scene.background = Background::gradient(top, bottom);
            // What is transparent does not depend on what would be there.
            assert!(pixels(&scene, StillOptions::new(size_px)) == own, "{name}");
            let opaque = channels(&still(&scene, deep(size_px)));
            let gain = scene.tone.exposure.exp2();
            for (index, (over, opaque)) in own.iter().zip(opaque.as_chunks::<3>().0).enumerate() {
                let alpha = f64::from(over[3]) / 65535.0;
                let row = (index / size_px[0] as usize) as f64;
                for channel in 0..3 {
                    let [top, bottom] = [top, bottom].map(|color| f64::from(color[channel]));
                    // Samples of a pixel lie up to half a pixel above and below its centre.
                    let behind = |row: f64| top + row / f64::from(size_px[1]) * (bottom - top);
                    let slack = (behind(row + 1.0) - behind(row)).abs() * gain * 0.5 + 1e-3;
                    let expected =
                        alpha * linear(over[channel]) + (1.0 - alpha) * gain * behind(row + 0.5);
                    let error = (expected - linear(opaque[channel])).abs();
                    // Clipped samples of an edge cannot be told apart.
                    let is_clipped = over[channel] > 65000 || opaque[channel] > 65000;
                    assert!(
                        is_clipped || error < slack,
                        "{name}: pixel {index}, channel {channel} is off by {error}, alpha {alpha}"
                    );
                }
            }
        }
        let count = |test: fn(u16) -> bool| own.iter().filter(|pixel| test(pixel[3])).count();
        let (clear, solid) = (count(|alpha| alpha == 0), count(|alpha| alpha == u16::MAX));
        let partial = own.len() - clear - solid;
        assert!(
            solid > 100 && partial > 20,
            "{name}: {clear} clear, {partial} partial, {solid} solid"
        );
        // Far fog is never clear.
        assert!(clear > 100 || scene.fog.density > 0.0, "{name}: {clear} clear pixels");
        assert!(own.iter().all(|pixel| pixel[3] > 0 || pixel[..3] == [0; 3]), "{name}");
        if ["direct", "lens", "paths", "indirect"].contains(&name) {
            let whole = |alpha: u16| (f64::from(alpha) * 16.0 / 65535.0).fract();
            let is_count = |alpha| whole(alpha) < 1e-3 || whole(alpha) > 1.0 - 1e-3;
            assert!(own.iter().all(|pixel| is_count(pixel[3])), "{name}: not of 16 samples");
        }
    }
}

/// Each format has the same alpha, in tiles of any size, for both eyes, denoised or not.
#[test]
fn alpha_is_the_same_in_every_file() {
    let size_px = [48, 40];
    let mut scene = sampled(Scene::default(), 8);
    let whole = pixels(&scene, StillOptions::new(size_px));
    let tiles = pixels(&scene, StillOptions { tile_px: [20, 13], ..StillOptions::new(size_px) });
    let alpha = |pixels: &[[u16; 4]]| pixels.iter().map(|pixel| pixel[3]).collect::<Vec<_>>();
    assert!(alpha(&whole) == alpha(&tiles));
    let png = Picture::of(&still(&scene, transparent(size_px))).bytes;
    let webp = still(&scene, StillOptions { format: PictureFormat::WebP, ..transparent(size_px) });
    let mut webp = WebPDecoder::new(Cursor::new(webp)).unwrap();
    let mut decoded = vec![0; webp.output_buffer_size().unwrap()];
    webp.read_image(&mut decoded).unwrap();
    assert!(decoded == png && png.len() == 4 * whole.len());
    let near = |(deep, byte): (&[u16; 4], &[u8; 4])| {
        (f64::from(deep[3]) / 257.0 - f64::from(byte[3])).abs() < 0.51
    };
    assert!(whole.iter().zip(png.as_chunks::<4>().0).all(near));

    scene.integrator.kind = IntegratorKind::Path;
    scene.integrator.noise = 0.1;
    let [noisy, denoised] = [false, true].map(|denoise| {
        pixels(&scene, StillOptions { denoise: Some(denoise), ..StillOptions::new(size_px) })
    });
    assert!(noisy != denoised && alpha(&noisy) == alpha(&denoised));

    scene.integrator.kind = IntegratorKind::Direct;
    scene.camera.stereo.layout = StereoLayout::SideBySide;
    let both = pixels(&scene, StillOptions::new(size_px));
    let left = StillOptions { eye: Some(Eye::Left), ..StillOptions::new(size_px) };
    let left = pixels(&scene, left);
    let rows = both.chunks(2 * size_px[0] as usize).flat_map(|row| &row[..size_px[0] as usize]);
    assert!(rows.eq(&left));
}

/// With motion blur alpha is the mean over the shutter time, and the picture composes as well.
#[test]
fn a_moving_edge_is_partly_transparent() {
    let size_px = [48, 40];
    let (_, mut scene) = scenes().swap_remove(0);
    scene.background = Background::gradient([0.0; 3], [0.0; 3]);
    let keys = [0.0, 2.0].map(|time_secs| {
        let at = DVec3::new(0.2 * time_secs, -4.0, 0.0);
        scene.camera = Camera::looking_at(at, at + 4.0 * DVec3::Y, DVec3::Z);
        Key { time_secs, easing: Easing::Linear, scene: Arc::new(scene.clone()) }
    });
    let mut path = Path { frames_per_second: 1, shutter: 0.9, keys: keys.to_vec() };
    let frame = |path: &Path, is_transparent| {
        let options = StillOptions { is_transparent, ..deep(size_px) };
        let job = StillJob::of_frame(pipelines(), path, 1, options, Vec::new()).unwrap();
        channels(&job.run(|_| ControlFlow::Continue(())).unwrap())
    };
    let blurred = frame(&path, true);
    let opaque = frame(&path, false);
    for (over, opaque) in blurred.as_chunks::<4>().0.iter().zip(opaque.as_chunks::<3>().0) {
        let alpha = f64::from(over[3]) / 65535.0;
        for channel in 0..3 {
            let error = (alpha * linear(over[channel]) - linear(opaque[channel])).abs();
            let is_clipped = over[channel] > 65000 || opaque[channel] > 65000;
            assert!(is_clipped || error < 1e-3, "{over:?} composes to {opaque:?}");
        }
    }
    path.shutter = 0.0;
    let sharp = frame(&path, true);
    let partial = |channels: &[u16]| {
        let pixels = channels.as_chunks::<4>().0.iter();
        pixels.filter(|pixel| ![0, u16::MAX].contains(&pixel[3])).count()
    };
    assert!(partial(&blurred) > partial(&sharp) + 20, "{} {}", partial(&blurred), partial(&sharp));
}

#[test]
fn what_has_no_alpha_refuses_a_transparent_background() {
    let refusal = |scene: &Scene, format| {
        let options = StillOptions { format, ..transparent([8, 8]) };
        StillJob::new(pipelines(), scene, options, Vec::new()).err().expect("an error")
    };
    for format in [PictureFormat::Jpeg, PictureFormat::Rgb] {
        assert!(matches!(refusal(&Scene::default(), format), ExportError::Transparent));
    }
    let mut scene = Scene::default();
    scene.camera.stereo.layout = StereoLayout::Anaglyph;
    assert!(matches!(refusal(&scene, PictureFormat::Png), ExportError::TransparentRedCyan));
}

#[test]
fn other_formats_refuse_sixteen_bits() {
    for format in [PictureFormat::Jpeg, PictureFormat::WebP, PictureFormat::Exr] {
        let options = StillOptions { format, ..deep([8, 8]) };
        let refused = StillJob::new(pipelines(), &Scene::default(), options, Vec::new()).err();
        let refused = refused.expect("an error");
        assert!(matches!(refused, ExportError::Deep), "{format:?}: {refused}");
    }
}
