//! What edits cost at full resolution, next to each other.
//!
//! A view with time without end for a moving frame draws each edit whole at once, as one picture.

use std::{
    sync::Arc,
    time::{Duration, Instant},
};

use glam::{DQuat, DVec3};
use mandelight::{
    render::{Pace, Pipelines, Region, View},
    scene::Scene,
};
use serde::Serialize;

use super::{
    super::statistics::median,
    replay::PUMP_SECS,
    session::{SIZE_PX, with_motion_budget},
};

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

/// From the release after an edit to the picture of all pixels, in full frames' own time: the median
/// of rounds in which both have their turn.
pub fn release(
    pipelines: &Arc<Pipelines>,
    scene: &Scene,
    edit: fn(&mut Scene, f64),
    budget_ms: f64,
) -> f64 {
    let start = Instant::now();
    let new_view = || View::new(pipelines, Region::whole(SIZE_PX), Pace::Interactive);
    let (mut hurried, mut unhurried) = (new_view(), new_view());
    let (mut scene, mut turned) = (scene.clone(), with_motion_budget(scene, NO_HURRY_MS));
    turned.quality.samples = 1;
    let mut ratios = Vec::new();
    for round in 0..WARM_UP + ROUNDS {
        let sign = if round % 2 == 0 { 1.0 } else { -1.0 };
        move_camera(&mut turned, sign);
        let own_ms = draw(pipelines, &mut unhurried, &turned, start);
        edit(&mut scene, sign);
        let aimed = with_motion_budget(&scene, budget_ms);
        draw_until(pipelines, &mut hurried, &aimed, true, start, |_| true);
        let whole = |pixels_per_sample| pixels_per_sample == 1;
        let released_ms = draw_until(pipelines, &mut hurried, &aimed, false, start, whole);
        if round >= WARM_UP {
            ratios.push(released_ms / own_ms);
        }
    }
    median(&ratios)
}

/// Gives a scene to a view that is pumped as the page does; milliseconds until a picture is
/// `enough`, one pixel of so many having been computed.
fn draw_until(
    pipelines: &Pipelines,
    view: &mut View,
    scene: &Scene,
    moving: bool,
    start: Instant,
    enough: impl Fn(u32) -> bool,
) -> f64 {
    let given = Instant::now();
    view.set_scene(scene, moving);
    let before = view.report().pictures;
    let mut pumped = Instant::now();
    view.pump(start.elapsed().as_secs_f64());
    loop {
        std::thread::sleep(Duration::from_micros(200));
        // Browsers tell by themselves when work is done.
        pipelines.gpu.poll();
        if pumped.elapsed().as_secs_f64() >= PUMP_SECS {
            pumped = Instant::now();
            view.pump(start.elapsed().as_secs_f64());
        }
        let report = view.report();
        if report.pictures > before && enough(report.pixels_per_sample) {
            return given.elapsed().as_secs_f64() * 1e3;
        }
    }
}

/// Measures the edits on one scene.
pub fn costs(pipelines: &Arc<Pipelines>, scene: &Scene) -> Costs {
    let [camera_ms, light_ms, intensity_ms, exposure_ms] =
        measured(pipelines, scene, [move_camera, move_light, dim_light, expose]);
    Costs { camera_ms, light_ms, intensity_ms, exposure_ms }
}

/// Turns the camera a little.
pub fn move_camera(scene: &mut Scene, sign: f64) {
    let turn = DQuat::from_rotation_y(sign * 1e-3);
    scene.camera.orientation = (scene.camera.rotation() * turn).normalize().into();
}

/// Turns the first light a little.
pub fn move_light(scene: &mut Scene, sign: f64) {
    let light = &mut scene.lights.environment[0];
    let turn = DQuat::from_rotation_z(sign * 0.02);
    light.direction = (turn * DVec3::from_array(light.direction)).normalize().to_array();
}

/// Raises the power a little.
pub fn raise_power(scene: &mut Scene, sign: f64) {
    scene.fractal.power += 0.01 * sign;
}

fn dim_light(scene: &mut Scene, sign: f64) {
    scene.lights.environment[0].intensity *= (0.02 * sign).exp();
}

fn expose(scene: &mut Scene, sign: f64) {
    scene.tone.exposure += 0.02 * sign;
}

fn measured<const N: usize>(
    pipelines: &Arc<Pipelines>,
    scene: &Scene,
    edits: [fn(&mut Scene, f64); N],
) -> [f64; N] {
    let mut scene = with_motion_budget(scene, NO_HURRY_MS);
    scene.quality.samples = 1;
    pipelines.specialise(&scene);
    let mut view = View::new(pipelines, Region::whole(SIZE_PX), Pace::Interactive);
    let start = Instant::now();
    let mut times = [(); N].map(|()| Vec::new());
    draw(pipelines, &mut view, &scene, start);
    for round in 0..WARM_UP + ROUNDS {
        let sign = if round % 2 == 0 { 1.0 } else { -1.0 };
        for (edit, times) in edits.iter().zip(&mut times) {
            edit(&mut scene, sign);
            let ms = draw(pipelines, &mut view, &scene, start);
            if round >= WARM_UP {
                times.push(ms);
            }
        }
    }
    times.map(|times| median(&times))
}

/// Draws a scene; milliseconds from the edit to the picture of all pixels.
fn draw(pipelines: &Pipelines, view: &mut View, scene: &Scene, start: Instant) -> f64 {
    let edited = Instant::now();
    view.set_scene(scene, true);
    let before = view.report().pictures;
    loop {
        view.pump(start.elapsed().as_secs_f64());
        pipelines.gpu.wait();
        let report = view.report();
        if report.pictures > before && report.pixels_per_sample == 1 {
            return edited.elapsed().as_secs_f64() * 1e3;
        }
    }
}
