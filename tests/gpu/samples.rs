//! Oversampling: the mean of many samples is the pixel's mean, and the error falls fast.
//!
//! The reference knows nothing of the sample positions: the same view drawn finer by a factor, one
//! sample to a pixel, averaged over blocks. Its detail is coarser by that factor, so that hit
//! distances and normals are the same.

use glam::DVec3;
use mandelight::{
    render::{Pace, lattice},
    scene::{Background, Camera, Scene, param},
};
use mandelight_test_support::view::{finished, sampled};

const SIZE: [u32; 2] = [48, 32];

/// How much finer the reference is along a side.
const FINER: u32 = 32;

/// A pixel's mean luminance and the variance of its samples.
struct Pixel {
    mean: f64,
    variance: f64,
}

fn scene() -> Scene {
    let mut scene = Scene::default();
    scene.quality.detail = param::DETAIL.max / f64::from(FINER);
    scene
}

/// Luminance of each pixel.
fn luminance(scene: &Scene, size_px: [u32; 2]) -> Vec<f64> {
    let view = finished(scene, size_px, Pace::Still);
    let radiance = view.film().expect("the film's bytes");
    let weigh = |[r, g, b]: &[f32; 3]| {
        0.2126 * f64::from(*r) + 0.7152 * f64::from(*g) + 0.0722 * f64::from(*b)
    };
    radiance.iter().map(weigh).collect()
}

fn reference() -> Vec<Pixel> {
    let mut scene = sampled(scene(), 1);
    scene.quality.detail = param::DETAIL.max;
    let [width, height] = SIZE;
    let fine = luminance(&scene, [width * FINER, height * FINER]);
    let block = |x: u32, y: u32| {
        let values = (0..FINER * FINER).map(|i| {
            let (x, y) = (x * FINER + i % FINER, y * FINER + i / FINER);
            fine[(y * width * FINER + x) as usize]
        });
        let count = f64::from(FINER * FINER);
        let mean = values.clone().sum::<f64>() / count;
        Pixel { mean, variance: values.map(|v| (v - mean).powi(2)).sum::<f64>() / count }
    };
    (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).map(|(x, y)| block(x, y)).collect()
}

/// Mean over the pixels.
fn mean(values: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = values.len() as f64;
    values.sum::<f64>() / count
}

/// The slope of the straight line of least squares through points (x, y).
fn slope(points: &[(f64, f64)]) -> f64 {
    let x_mean = mean(points.iter().map(|p| p.0));
    let y_mean = mean(points.iter().map(|p| p.1));
    let covariance: f64 = points.iter().map(|(x, y)| (x - x_mean) * (y - y_mean)).sum();
    covariance / points.iter().map(|(x, _)| (x - x_mean).powi(2)).sum::<f64>()
}

/// Independent samples of a pixel with variance σ² leave a mean with variance σ²/N: a log-log slope
/// of −½. These do better, about −0.7, and err by a quarter as much at 1024.
#[test]
fn samples_converge_to_the_pixels_mean() {
    let reference = reference();
    let variance = mean(reference.iter().map(|p| p.variance));
    let mut fall = Vec::new();
    for count in (0..=10).map(|k| 1 << k) {
        let found = luminance(&sampled(scene(), count), SIZE);
        let errors: Vec<_> = found.iter().zip(&reference).map(|(f, r)| f - r.mean).collect();
        let rms = mean(errors.iter().map(|e| e * e)).sqrt();
        let independent = (variance / f64::from(count)).sqrt();
        assert!(rms < independent, "{count} samples: off by {rms}, chance alone by {independent}");
        let bias = mean(errors.iter().copied());
        let chance = independent / (errors.len() as f64).sqrt();
        assert!(bias.abs() < 3.0 * chance, "{count} samples: {bias} too bright");
        let far = errors.iter().zip(&reference).filter(|(error, pixel)| {
            error.abs() > 3.0 * (pixel.variance / f64::from(count)).sqrt() + 1e-3
        });
        let far = far.count() as f64 / errors.len() as f64;
        assert!(far < 0.01, "{count} samples: {far} of the pixels are off by three sigma");
        if count <= 256 {
            fall.push((f64::from(count).ln(), rms.ln()));
        }
    }
    let slope = slope(&fall);
    assert!(slope < -0.6, "the error falls with a slope of {slope} only");
}

/// Samples are computed one, two, four or eight of a pixel at a time. Before an empty sky, whose
/// colour is a straight line down the picture, a pixel's mean tells which of them it got: each once.
#[test]
fn every_pixel_gets_each_sample_once() {
    // Not whole blocks of any shape.
    let size = [53, 37];
    let scene = Scene {
        camera: Camera::looking_at(DVec3::NEG_Y * 9.0, DVec3::NEG_Y * 20.0, DVec3::Z),
        background: Background::gradient([0.0; 3], [1.0; 3]),
        ..Scene::default()
    };
    for count in [1, 2, 3, 4, 5, 7, 8, 9, 10, 16, 17, 40] {
        let view = finished(&sampled(scene.clone(), count), size, Pace::Still);
        let film = view.film().expect("the film's bytes");
        let places = (0..count).map(|index| f64::from(lattice::jitter(index)[1]));
        let place = places.sum::<f64>() / f64::from(count);
        for (pixel, found) in film.iter().enumerate() {
            let row = (pixel / size[0] as usize) as f64;
            let expected = (row + place) / f64::from(size[1]);
            let off = f64::from(found[0]) - expected;
            assert!(off.abs() < 2e-6, "{count} samples, pixel {pixel}: {off} too bright");
        }
    }
}
