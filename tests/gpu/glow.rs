//! The film as a whole: its mean by mip levels, its histogram, exposure and bloom.

use mandelight::{
    gpu::readback::Readback,
    render::{Pace, View, uniforms::Statistics},
    scene::Scene,
};

use crate::harness::{finished, kernels, sampled};

/// Sizes that mip levels by halves get wrong.
const SIZES: [[u32; 2]; 7] = [[1, 1], [5, 1], [1, 9], [7, 3], [16, 16], [101, 67], [129, 65]];

fn exposed_scene() -> Scene {
    let mut scene = sampled(Scene::default(), 2);
    scene.tone.auto_exposure = true;
    scene
}

fn statistics(view: &View) -> Statistics {
    let gpu = &kernels().gpu;
    let bytes = Readback::buffer(gpu, &view.glow().statistics).wait(gpu).expect("statistics");
    bytemuck::pod_read_unaligned(&bytes)
}

fn luminance(color: [f64; 3]) -> f64 {
    0.2126 * color[0] + 0.7152 * color[1] + 0.0722 * color[2]
}

/// The film's mean colour and mean log2(luminance + 1e-4), in f64.
fn mean(film: &[[f32; 3]]) -> [f64; 4] {
    let mut sum = [0.0; 4];
    for color in film {
        let color = color.map(f64::from);
        for (sum, channel) in sum.iter_mut().zip(color) {
            *sum += channel;
        }
        sum[3] += (luminance(color) + 1e-4).log2();
    }
    sum.map(|sum| sum / film.len() as f64)
}

fn assert_mean(view: &View, film: &[[f32; 3]]) {
    let [r, g, b, log2] = mean(film);
    let found = statistics(view);
    for (found, expected) in found.mean.into_iter().zip([r, g, b]) {
        let error = (f64::from(found) - expected).abs();
        assert!(error <= 1e-5 * expected, "{:?}: {found} for {expected}", view.region().size_px);
    }
    assert!((f64::from(found.mean_log2) - log2).abs() < 1e-4);
}

#[test]
fn the_mean_is_that_of_the_film_whatever_its_size() {
    for size_px in SIZES {
        let view = finished(&exposed_scene(), size_px, Pace::Still);
        let film = view.film().expect("the film");
        assert_eq!(film.len() as u32, size_px[0] * size_px[1]);
        assert_mean(&view, &film);
    }
}
