//! What edits cost at full resolution, next to each other.
//!
//! A view with time without end for a moving frame draws each edit whole at once, as one picture.

use std::{sync::Arc, time::Instant};

use glam::{DQuat, DVec3};
use mandelight::{
    render::{Kernels, Pace, Region, View},
    scene::Scene,
};
use serde::Serialize;

use super::{SIZE_PX, median};

/// A motion budget that every frame fits, milliseconds.
const NO_HURRY_MS: f64 = 1e7;

/// Rounds after those that teach the view what things cost.
const ROUNDS: u32 = 3;
const WARM_UP: u32 = 2;

/// Medians of rounds in which each edit has its turn, milliseconds from the edit to the picture.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Costs {
    /// A camera move: a full frame's own time.
    pub camera_ms: f64,
    /// A light of three moved.
    pub light_ms: f64,
    /// The same light's intensity.
    pub intensity_ms: f64,
    /// Exposure.
    pub exposure_ms: f64,
}

/// A camera move alone on one scene: a full frame's own time, milliseconds.
pub fn full_frame_ms(kernels: &Arc<Kernels>, scene: &Scene) -> f64 {
    measured(kernels, scene, [move_camera])[0]
}

/// Measures the edits on one scene.
pub fn costs(kernels: &Arc<Kernels>, scene: &Scene) -> Costs {
    let [camera_ms, light_ms, intensity_ms, exposure_ms] =
        measured(kernels, scene, [move_camera, move_light, dim_light, expose]);
    Costs { camera_ms, light_ms, intensity_ms, exposure_ms }
}

fn move_camera(scene: &mut Scene, sign: f64) {
    let turn = DQuat::from_rotation_y(sign * 1e-3);
    scene.camera.orientation = (scene.camera.rotation() * turn).normalize().into();
}

fn move_light(scene: &mut Scene, sign: f64) {
    let light = &mut scene.lights.environment[0];
    let turn = DQuat::from_rotation_z(sign * 0.02);
    light.direction = (turn * DVec3::from_array(light.direction)).normalize().to_array();
}

fn dim_light(scene: &mut Scene, sign: f64) {
    scene.lights.environment[0].intensity *= (0.02 * sign).exp();
}

fn expose(scene: &mut Scene, sign: f64) {
    scene.tone.exposure += 0.02 * sign;
}

fn measured<const N: usize>(
    kernels: &Arc<Kernels>,
    scene: &Scene,
    edits: [fn(&mut Scene, f64); N],
) -> [f64; N] {
    let mut scene = super::aimed(scene, NO_HURRY_MS);
    scene.quality.samples = 1;
    kernels.specialise(&scene);
    let mut view = View::new(kernels, Region::whole(SIZE_PX), Pace::Interactive);
    let start = Instant::now();
    let mut times = [(); N].map(|()| Vec::new());
    draw(kernels, &mut view, &scene, start);
    for round in 0..WARM_UP + ROUNDS {
        let sign = if round % 2 == 0 { 1.0 } else { -1.0 };
        for (edit, times) in edits.iter().zip(&mut times) {
            edit(&mut scene, sign);
            let ms = draw(kernels, &mut view, &scene, start);
            if round >= WARM_UP {
                times.push(ms);
            }
        }
    }
    times.map(median)
}

/// Draws a scene; milliseconds from the edit to the picture of all pixels.
fn draw(kernels: &Kernels, view: &mut View, scene: &Scene, start: Instant) -> f64 {
    let edited = Instant::now();
    view.set_scene(scene, true);
    let before = view.report().pictures;
    loop {
        view.pump(start.elapsed().as_secs_f64());
        kernels.gpu.wait();
        let report = view.report();
        if report.pictures > before && report.pixels_per_sample == 1 {
            return edited.elapsed().as_secs_f64() * 1e3;
        }
    }
}
