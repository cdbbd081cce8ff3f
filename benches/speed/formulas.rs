//! Pictures of all formulas: step policy, counts, times, overstepped pixels, compilation.
//!
//! In: the formulas' scenes. Out: a row each. A pixel is overstepped if its ray ends more than two footprints behind
//! the depth at which a slow march in f64 comes within half the hit distance.

use std::{process::Command, sync::Arc, time::Instant};

use mandelight::{
    formula,
    gpu::{Gpu, device::in_parallel},
    render::Pipelines,
    scene::{
        Scene,
        presets::{self, Preset},
    },
};
use mandelight_test_support::oracle::{formula_rays::FormulaRays, rays::cone};
use serde::Serialize;

use super::{arguments::Arguments, counts::Counts, failure::Failure, ours, statistics::median};

/// The table's name for `--views`.
pub const NAME: &str = "formulas";
const SIZE_PX: [u32; 2] = [320, 200];
/// The picture whose rays are compared.
const COMPARED_PX: [u32; 2] = [60, 40];
/// One formula.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// The formula's id.
    pub formula: &'static str,
    /// Step of a ray over the estimate.
    pub step: f64,
    /// Factor of over-relaxed steps.
    pub relaxation: f64,
    /// Counts per pixel.
    pub counts: Counts,
    /// Median time of a still, milliseconds.
    pub ms: f64,
    /// Part of the pixels whose rays pass the surface; none for the bulb, whose errors have a table of their own.
    pub overstepped: Option<f64>,
    /// Compilation of the formula's passes, milliseconds.
    pub compilation_ms: f64,
}

/// The bulb's scene, then those of the texts, with one sample a pixel.
fn scenes() -> impl Iterator<Item = (&'static str, Scene)> {
    let all = presets::opening_scenes().first().into_iter().chain(presets::formulas());
    all.map(|preset: &Preset| {
        let mut scene = (preset.scene)();
        scene.quality.samples = 1;
        (scene.fractal.formula().id(), scene)
    })
}

/// Measures all formulas.
///
/// # Errors
/// If the device is lost, or a kernel can't be counted.
pub fn measure(arguments: &Arguments, pipelines: &Arc<Pipelines>) -> Result<Vec<Row>, Failure> {
    let size_px = arguments.size.unwrap_or(SIZE_PX);
    let pixels: f64 = size_px.into_iter().map(f64::from).product();
    let compilation = compilation_times(arguments)?;
    let mut rows = Vec::new();
    for ((id, scene), compilation_ms) in scenes().zip(compilation) {
        pipelines.specialize(&scene);
        let mut times = Vec::new();
        for round in 0..=arguments.rounds {
            let (ms, _) = ours::draw_ms(pipelines, &scene, size_px);
            // The first round warms up.
            if round > 0 {
                times.push(ms);
            }
        }
        let mut counts = Counts::default();
        for (_, counted) in ours::counts(pipelines, &scene, size_px)? {
            counts += counted.per(pixels);
        }
        let policy = scene.fractal.formula().march_policy(&scene.fractal);
        let is_text = formula::texts().any(|(text, _)| text == id);
        rows.push(Row {
            formula: id,
            step: policy.ball_part.into(),
            relaxation: policy.relaxation.into(),
            counts,
            ms: median(&times),
            overstepped: is_text.then(|| overstepped(pipelines, &scene)).transpose()?,
            compilation_ms,
        });
    }
    Ok(rows)
}

/// Part of the pixels whose rays pass the surface.
fn overstepped(pipelines: &Arc<Pipelines>, scene: &Scene) -> Result<f64, Failure> {
    let (_, view) = ours::draw_ms(pipelines, scene, COMPARED_PX);
    let samples = view.gbuffer()?;
    let rays = FormulaRays::new(scene, COMPARED_PX);
    let [width, height] = COMPARED_PX;
    let indices: Vec<u32> = (0..width * height).collect();
    let passed = in_parallel(&indices, |&i| {
        let depth = f64::from(samples.depth[i as usize]);
        rays.march([i % width, i / width], 0.5).is_some_and(|hit| {
            let footprint = cone(&scene.camera, COMPARED_PX) * hit;
            depth == 0.0 || depth > hit + 2.0 * footprint
        })
    });
    Ok(passed.iter().filter(|passed| **passed).count() as f64 / f64::from(width * height))
}

/// Compiles each formula's passes in this process and prints the times as a line of JSON.
///
/// # Errors
/// If there is no adapter.
pub fn compile_once(arguments: &Arguments) -> Result<(), Failure> {
    let gpu = pollster::block_on(Gpu::open(arguments.adapter_name().as_deref()))?;
    let pipelines = Pipelines::new(&gpu);
    // What all formulas share is compiled by a picture of another kind of fractal.
    let mut first = presets::opening();
    first.fractal.set("power", 3.0);
    first.quality.samples = 1;
    ours::draw_ms(&pipelines, &first, COMPARED_PX);
    let mut all = Vec::new();
    for (_, scene) in scenes() {
        let start = Instant::now();
        pipelines.specialize(&scene);
        let made = start.elapsed().as_secs_f64() * 1e3;
        // Drivers defer a part of the compilation to the first use.
        let [first, again] = [(); 2].map(|()| ours::draw_ms(&pipelines, &scene, COMPARED_PX).0);
        all.push(made + (first - again).max(0.0));
    }
    println!("{}", serde_json::to_string(&all)?);
    Ok(())
}

/// Medians over processes of their own, whose drivers have no compiled shaders on disk.
fn compilation_times(arguments: &Arguments) -> Result<Vec<f64>, Failure> {
    let mut runs: Vec<Vec<f64>> = Vec::new();
    for _ in 0..arguments.rounds.clamp(1, 3) {
        let mut process = Command::new(std::env::current_exe()?);
        process
            .arg("--compile-once")
            .env("MESA_SHADER_CACHE_DISABLE", "true")
            .env("__GL_SHADER_DISK_CACHE", "0");
        if let Some(name) = arguments.adapter_name() {
            process.args(["--adapter", &name]);
        }
        let output = process.output()?;
        if !output.status.success() {
            return Err(String::from_utf8_lossy(&output.stderr).into_owned().into());
        }
        let text = String::from_utf8_lossy(&output.stdout);
        let line = text.lines().last().ok_or("the compilation printed nothing")?;
        runs.push(serde_json::from_str(line)?);
    }
    let count = runs.iter().map(Vec::len).min().unwrap_or_default();
    Ok((0..count).map(|i| median(&runs.iter().map(|run| run[i]).collect::<Vec<_>>())).collect())
}

/// Prints the rows.
pub fn print(rows: &[Row]) {
    println!("\nformulas: a still of each formula's scene");
    println!(
        "  {:<26}{:>6}{:>8}{:>11}{:>8}{:>9}{:>13}{:>13}",
        "", "march", "relax", "estimates", "steps", "ms", "overstepped", "compile, ms"
    );
    for row in rows {
        let overstepped =
            row.overstepped.map_or("–".to_owned(), |part| format!("{:.2} %", 100.0 * part));
        println!(
            "  {:<26}{:>6.2}{:>8.1}{:>11.1}{:>8.0}{:>9.0}{overstepped:>13}{:>13.0}",
            row.formula,
            row.step,
            row.relaxation,
            row.counts.estimates,
            row.counts.steps,
            row.ms,
            row.compilation_ms
        );
    }
}
