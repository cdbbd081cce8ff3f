//! Scenes for two eyes, and the sheets that hold both eyes' pictures.

use glam::DVec3;
use mandelight::scene::{Bloom, Camera, Scene, Stereo, StereoLayout};

/// A smooth surface, near the screen.
pub fn scene(layout: StereoLayout) -> Scene {
    let mut scene = Scene::default();
    scene.fractal.iterations = 3;
    scene.quality.samples = 1;
    scene.camera = Camera::looking_at(DVec3::new(1.4, -2.2, 0.9), DVec3::ZERO, DVec3::Z);
    scene.camera.stereo = Stereo { layout, ..Stereo::default() };
    scene
}

/// A scene whose pictures depend on the film as a whole.
pub fn glowing(layout: StereoLayout) -> Scene {
    let mut scene = scene(layout);
    scene.quality.samples = 2;
    scene.tone.auto_exposure = true;
    scene.bloom = Bloom { strength: 0.6, threshold: 0.3, ..Bloom::default() };
    scene
}

/// Two pictures of the same width, beside each other or one below the other.
pub fn sheet(
    [left, right]: &[Vec<[u8; 3]>; 2],
    width: usize,
    layout: StereoLayout,
) -> Vec<[u8; 3]> {
    if layout == StereoLayout::TopBottom {
        return [left.clone(), right.clone()].concat();
    }
    let rows = left.chunks(width).zip(right.chunks(width));
    rows.flat_map(|(left, right)| [left, right].concat()).collect()
}
