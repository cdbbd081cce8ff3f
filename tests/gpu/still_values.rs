//! What the pixels of stills hold: 16 bits per channel.

use std::{collections::BTreeSet, ops::ControlFlow};

use glam::DVec3;
use mandelight::{
    export::{ExportError, PictureFormat, StillJob, StillOptions},
    scene::{Background, Bloom, Camera, Scene, StereoLayout, ToneCurve, presets},
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
            // Dither moves a value by half a step at most, and rounding by another half.
            let steps = f64::from(sixteen) / 257.0 - f64::from(eight);
            assert!(steps.abs() < 1.01, "{}: {sixteen} is {steps} from {eight}", preset.name);
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
            let near = |(a, b): (&u16, &u8)| (f64::from(*a) / 257.0 - f64::from(*b)).abs() < 1.01;
            assert!(sixteen.iter().zip(&eight).all(near), "{layout:?} in {tile_px:?}");
        }
    }
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
