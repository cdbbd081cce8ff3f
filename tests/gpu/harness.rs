//! One device for all tests of the binary, and short ways to a finished picture.

use std::sync::{Arc, OnceLock};

use mandelight::{
    gpu::{Gpu, readback::Readback},
    render::{Pace, Pipelines, Region, View},
    scene::Scene,
};

/// The pipelines of the one device.
pub fn pipelines() -> &'static Arc<Pipelines> {
    static PIPELINES: OnceLock<Arc<Pipelines>> = OnceLock::new();
    PIPELINES.get_or_init(|| {
        let gpu = pollster::block_on(Gpu::open(None)).expect("a GPU or a software driver");
        Pipelines::new(&gpu)
    })
}

/// Pumps a view until it rests.
pub fn settle(view: &mut View) {
    let start = std::time::Instant::now();
    while view.pump(start.elapsed().as_secs_f64()) {
        pipelines().gpu.wait();
        assert!(start.elapsed().as_secs() < 300, "the view never rests: {:?}", view.report());
    }
}

/// A view of the whole scene, finished.
pub fn finished(scene: &Scene, size_px: [u32; 2], pace: Pace) -> View {
    let mut view = View::new(pipelines(), Region::whole(size_px), pace);
    view.set_scene(scene, false);
    settle(&mut view);
    view
}

/// The bytes of a view's picture, RGBA.
pub fn pixels(view: &View) -> Vec<u8> {
    let gpu = &pipelines().gpu;
    let texture = view.texture().expect("a picture");
    let size_px = [texture.width(), texture.height()];
    let bytes = Readback::texture(gpu, texture, size_px).wait(gpu).expect("the picture's bytes");
    assert_eq!(gpu.faults(), 0, "the device reported errors");
    bytes
}

/// A finished still's bytes, RGBA.
pub fn still(scene: &Scene, size_px: [u32; 2]) -> Vec<u8> {
    pixels(&finished(scene, size_px, Pace::Still))
}

/// The scene with so many samples a pixel.
pub fn sampled(mut scene: Scene, samples: u32) -> Scene {
    scene.quality.samples = samples;
    scene
}

/// Mean and largest difference of two pictures' colour channels, in steps of 1/255.
pub fn difference(a: &[u8], b: &[u8]) -> (f64, u8) {
    assert_eq!(a.len(), b.len(), "pictures of different sizes");
    let steps = || a.iter().zip(b).map(|(a, b)| a.abs_diff(*b));
    let sum: u64 = steps().map(u64::from).sum();
    (sum as f64 / a.len() as f64 * 4.0 / 3.0, steps().max().unwrap_or(0))
}

/// Holds two pictures to be the same but for a few pixels: rays that graze the surface end a little
/// otherwise where a bundle of other rays went before them, and which rays these are depends on
/// how the lattice was filled.
pub fn assert_same(a: &[u8], b: &[u8], what: &str) {
    assert_eq!(a.len(), b.len(), "{what}: pictures of different sizes");
    let pixels = a.len() / 4;
    let far = |(a, b): (&[u8], &[u8])| a.iter().zip(b).any(|(a, b)| a.abs_diff(*b) > 12);
    let different = a.chunks(4).zip(b.chunks(4)).filter(|pair| far(*pair)).count();
    let most = 3.max(pixels / 50);
    assert!(different <= most, "{what}: {different} of {pixels} pixels differ");
}
