//! Short ways to a finished picture and its pixels, on the device that the tests share.

use mandelight::{
    gpu::readback::Readback,
    render::{Pace, Region, View, gbuffer::Samples},
    scene::Scene,
};

pub use crate::device::pipelines;
use crate::{device::gpu, patience::HANG};

/// Pumps a view until it rests.
pub fn settle(view: &mut View) {
    let start = std::time::Instant::now();
    while view.pump(start.elapsed().as_secs_f64()) {
        gpu().wait();
        assert!(start.elapsed() < HANG, "the view never rests: {:?}", view.report());
    }
}

/// A view of the whole scene, finished.
pub fn finished(scene: &Scene, size_px: [u32; 2], pace: Pace) -> View {
    finished_in(scene, Region::whole(size_px), pace)
}

/// A view of a region of the scene, finished.
pub fn finished_in(scene: &Scene, region: Region, pace: Pace) -> View {
    let mut view = View::new(pipelines(), region, pace);
    view.set_scene(scene, false);
    settle(&mut view);
    view
}

/// One sample a pixel of a finished picture without shadows.
pub fn single_samples(scene: &Scene, size_px: [u32; 2]) -> Samples {
    let mut scene = sampled(scene.clone(), 1);
    scene.quality.shadows = false;
    let view = finished(&scene, size_px, Pace::Still);
    assert_eq!(gpu().faults(), 0);
    view.gbuffer().expect("the G-buffer's bytes")
}

/// The bytes of a view's picture, RGBA.
pub fn pixels(view: &View) -> Vec<u8> {
    let texture = view.texture().expect("a picture");
    let size_px = [texture.width(), texture.height()];
    let bytes =
        Readback::texture(gpu(), texture, size_px).wait(gpu()).expect("the picture's bytes");
    assert_eq!(gpu().faults(), 0, "the device reported errors");
    bytes
}

/// A view's picture without its alpha.
pub fn rgb(view: &View) -> Vec<[u8; 3]> {
    pixels(view).as_chunks::<4>().0.iter().map(|&[r, g, b, _]| [r, g, b]).collect()
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
