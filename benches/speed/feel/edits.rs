//! The cost of edits at full resolution, and the time from release to full resolution.
//!
//! In: a scene of the session. Out: milliseconds, and multiples of a full frame. A view without
//! a limit on its motion budget draws each edit at full resolution at once.

use std::{
    sync::Arc,
    time::{Duration, Instant},
};

use glam::{DQuat, DVec3};
use mandelight::{
    formula::mandelbulb::Mandelbulb,
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
const UNLIMITED_BUDGET_MS: f64 = 1e7;

/// Measured rounds, after the warm-up that trains the view's cost estimates.
const ROUNDS: u32 = 3;
const WARM_UP: u32 = 2;

/// Median times from an edit to its picture, milliseconds; each round makes each edit once.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Costs {
    /// A camera move, which costs a full frame.
    pub camera_ms: f64,
    /// A move of one of three lights.
    pub light_ms: f64,
    /// A change of that light's intensity.
    pub intensity_ms: f64,
    /// A change of exposure.
    pub exposure_ms: f64,
}

/// Time from the release after an edit to the first picture of all pixels, in full frames.
///
/// The median of rounds that draw the full frame in turn with the release.
pub fn release(
    pipelines: &Arc<Pipelines>,
    scene: &Scene,
    edit: fn(&mut Scene, f64),
    budget_ms: f64,
) -> f64 {
    let start = Instant::now();
    let new_view = || View::new(pipelines, Region::whole(SIZE_PX), Pace::Interactive);
    let (mut budgeted, mut unbudgeted) = (new_view(), new_view());
    let (mut scene, mut unbudgeted_scene) =
        (scene.clone(), with_motion_budget(scene, UNLIMITED_BUDGET_MS));
    unbudgeted_scene.quality.samples = 1;
    let mut ratios = Vec::new();
    for round in 0..WARM_UP + ROUNDS {
        let sign = if round % 2 == 0 { 1.0 } else { -1.0 };
        move_camera(&mut unbudgeted_scene, sign);
        let own_ms = draw(pipelines, &mut unbudgeted, &unbudgeted_scene, start);
        edit(&mut scene, sign);
        let budgeted_scene = with_motion_budget(&scene, budget_ms);
        draw_until(pipelines, &mut budgeted, &budgeted_scene, true, start, |_| true);
        let whole = |pixels_per_sample| pixels_per_sample == 1;
        let released_ms =
            draw_until(pipelines, &mut budgeted, &budgeted_scene, false, start, whole);
        if round >= WARM_UP {
            ratios.push(released_ms / own_ms);
        }
    }
    median(&ratios)
}

/// Sets a scene and pumps the view as the page does; milliseconds until a picture is done.
///
/// `is_done` gets the picture's pixels per sample.
fn draw_until(
    pipelines: &Pipelines,
    view: &mut View,
    scene: &Scene,
    moving: bool,
    start: Instant,
    is_done: impl Fn(u32) -> bool,
) -> f64 {
    let edited = Instant::now();
    view.set_scene(scene, moving);
    let before = view.report().pictures;
    let mut pumped = Instant::now();
    view.pump(start.elapsed().as_secs_f64());
    loop {
        std::thread::sleep(Duration::from_micros(200));
        // Browsers run the callbacks of completed work on their own.
        pipelines.gpu.poll();
        if pumped.elapsed().as_secs_f64() >= PUMP_SECS {
            pumped = Instant::now();
            view.pump(start.elapsed().as_secs_f64());
        }
        let report = view.report();
        if report.pictures > before && is_done(report.pixels_per_sample) {
            return edited.elapsed().as_secs_f64() * 1e3;
        }
    }
}

/// Measures the edits of one scene.
pub fn costs(pipelines: &Arc<Pipelines>, scene: &Scene) -> Costs {
    let [camera_ms, light_ms, intensity_ms, exposure_ms] = edit_times_ms(
        pipelines,
        scene,
        [move_camera, move_light, change_intensity, change_exposure],
    );
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
    let power = Mandelbulb::of(&scene.fractal).power + 0.01 * sign;
    assert!(scene.fractal.set("power", power), "the session shows a Mandelbulb");
}

fn change_intensity(scene: &mut Scene, sign: f64) {
    scene.lights.environment[0].intensity *= (0.02 * sign).exp();
}

fn change_exposure(scene: &mut Scene, sign: f64) {
    scene.tone.exposure += 0.02 * sign;
}

fn edit_times_ms<const N: usize>(
    pipelines: &Arc<Pipelines>,
    scene: &Scene,
    edits: [fn(&mut Scene, f64); N],
) -> [f64; N] {
    let mut scene = with_motion_budget(scene, UNLIMITED_BUDGET_MS);
    scene.quality.samples = 1;
    pipelines.specialize(&scene);
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
