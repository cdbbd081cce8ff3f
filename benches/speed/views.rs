//! The views that are measured: scenes, sizes, and how many samples.

use glam::DVec3;
use mandelight::scene::{
    Camera, Coloring, EnvironmentLight, Fractal, Lights, Quality, Scene, Surface, Tone,
};

/// One thing to measure.
#[derive(Clone, Debug)]
pub struct View {
    /// What `--views` and the `ratio` lines call it.
    pub name: &'static str,
    /// What it shows, in a line.
    pub about: &'static str,
    /// The scene, its samples in it.
    pub scene: Scene,
    /// Width and height, pixels.
    pub size_px: [u32; 2],
    /// The literal kernel draws one block of 8x8 pixels in so many each way, and its time counts
    /// for all of them.
    pub stride: u32,
}

/// Width and height of most views: what the prototype's figures were measured at.
pub const SIZE_PX: [u32; 2] = [960, 540];

/// Every view, in the order in which they are measured.
pub fn all() -> Vec<View> {
    vec![
        View {
            name: "whole",
            about: "the whole Mandelbulb",
            scene: scene([1.57, -2.88, 1.05], [0.0, 0.0, 0.0], [0.0, 0.0, 1.0], &sky()),
            size_px: SIZE_PX,
            stride: 1,
        },
        View {
            name: "filled",
            about: "a picture filled by it, at a distance of 0.15",
            scene: scene(
                [0.1385390, -0.3897377, 1.0369570],
                [0.0352275, -0.2738807, 0.7802395],
                [0.32164, -0.83080, 0.45423],
                &sky(),
            ),
            size_px: SIZE_PX,
            stride: 1,
        },
        View {
            name: "crevice",
            about: "a crevice, partly in shadow, at a distance of 1e-3",
            scene: crevice(),
            size_px: SIZE_PX,
            stride: 1,
        },
    ]
}

fn crevice() -> Scene {
    scene(
        [0.6144420, -0.6200878, -0.2452360],
        [0.6148446, -0.6203554, -0.2471768],
        [0.46384, -0.55397, 0.69135],
        &sky(),
    )
}

/// Three lights: a warm key, a cool rim, a faint fill.
fn sky() -> Vec<EnvironmentLight> {
    vec![
        light([-0.35, -0.75, 0.8], [1.0, 0.86, 0.68], 2.6),
        light([0.6, 0.75, 0.35], [0.6, 0.75, 1.0], 1.4),
        light([0.7, -0.5, 0.45], [0.75, 0.65, 1.0], 0.8),
    ]
}

/// A light whose shadows reach through all of the scene, as the thesis's do.
fn light(direction: [f64; 3], color: [f32; 3], intensity: f64) -> EnvironmentLight {
    let direction = DVec3::from_array(direction).normalize().to_array();
    EnvironmentLight { direction, color, intensity, shadow_reach: None, ..Default::default() }
}

/// The Mandelbulb of power 8, one sample a pixel.
fn scene(eye: [f64; 3], at: [f64; 3], up: [f64; 3], lights: &[EnvironmentLight]) -> Scene {
    let [eye, at, up] = [eye, at, up].map(DVec3::from_array);
    Scene {
        fractal: Fractal::default(),
        camera: Camera::looking_at(eye, at, up),
        lights: Lights { environment: lights.to_vec(), point: Vec::new(), ..Default::default() },
        surface: Surface { coloring: Coloring::default(), ..Default::default() },
        tone: Tone::default(),
        quality: Quality { samples: 1, ..Default::default() },
        ..Default::default()
    }
}
