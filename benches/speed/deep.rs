//! The cost of depth: one place seen from seven distances.
//!
//! In: the program's pipelines. Out: a row per distance. The time of an estimate is the still's
//! time divided by the estimates that counting kernels find. Each round draws every view once.

use std::sync::Arc;

use mandelight::{
    fractal::FractalModel,
    render::{Pipelines, Region, space::wants_anchor},
    scene::Scene,
};
use serde::Serialize;

use super::{
    counts::Counts, descent::PLACES, failure::Failure, ours, statistics::median, views::SIZE_PX,
};

/// The table's name for `--views`.
pub const NAME: &str = "deep";
/// Names of the views, and their distances from the eye to the surface, scene units.
const DISTANCES: [(&str, f64); 7] = [
    ("deep-1e-3", 1e-3),
    ("deep-1e-5", 1e-5),
    ("deep-1e-6", 1e-6),
    ("deep-1e-9", 1e-9),
    ("deep-1e-13", 1e-13),
    ("deep-1e-20", 1e-20),
    ("deep-1e-27", 1e-27),
];

/// One view.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// The view's name in the output.
    pub name: &'static str,
    /// True if the renderer uses an anchor.
    pub is_deep: bool,
    /// Median time, milliseconds.
    pub ms: f64,
    /// Counts per pixel.
    pub counts: Counts,
    /// Time of a distance estimate, nanoseconds.
    pub estimate_ns: f64,
    /// [`Self::estimate_ns`] divided by the first view's.
    pub cost: f64,
}

/// The place of the power-8 bulb that is a crevice at every scale.
///
/// # Errors
/// If the place is missing.
pub fn scene(distance: f64) -> Result<Scene, Failure> {
    let place = PLACES.iter().find(|place| place.name == "streaky" && place.set() == "8");
    place.ok_or("there is no place streaky-8")?.scene(distance)
}

/// Measures all views, `rounds` times each.
///
/// # Errors
/// If the device is lost, or a kernel can't be counted.
pub fn measure(
    pipelines: &Arc<Pipelines>,
    rounds: u32,
    size_px: Option<[u32; 2]>,
) -> Result<Vec<Row>, Failure> {
    let size_px = size_px.unwrap_or(SIZE_PX);
    let pixels: f64 = size_px.into_iter().map(f64::from).product();
    let scenes = DISTANCES.map(|(_, distance)| scene(distance));
    let scenes: Vec<_> = scenes.into_iter().collect::<Result<_, _>>()?;
    let mut times = vec![Vec::new(); scenes.len()];
    for round in 0..=rounds {
        for (scene, times) in scenes.iter().zip(&mut times) {
            let (ms, _) = ours::draw_ms(pipelines, scene, size_px);
            // The first round is a warm-up.
            if round > 0 {
                times.push(ms);
            }
        }
    }
    let mut rows: Vec<Row> = Vec::new();
    for ((scene, times), (name, _)) in scenes.iter().zip(&times).zip(DISTANCES) {
        let mut counts = Counts::default();
        for (_, counted) in ours::counts(pipelines, scene, size_px)? {
            counts += counted.per(pixels);
        }
        let ms = median(times);
        let estimate_ns = ms * 1e6 / (counts.estimates * pixels);
        let plain_ns = rows.first().map_or(estimate_ns, |plain| plain.estimate_ns);
        let is_deep =
            wants_anchor(&FractalModel::new(&scene.fractal), scene, Region::whole(size_px));
        rows.push(Row { name, is_deep, ms, counts, estimate_ns, cost: estimate_ns / plain_ns });
    }
    Ok(rows)
}

/// Prints a table for people and `cost` lines for scripts.
pub fn print(rows: &[Row]) {
    println!("\ndeep: one place from closer and closer by");
    println!(
        "  {:<12}{:>8}{:>10}{:>12}{:>10}{:>12}{:>12}",
        "", "anchor", "ms", "estimates", "steps", "steps each", "ns each"
    );
    for row in rows {
        let Counts { estimates, steps } = row.counts;
        println!(
            "  {:<12}{:>8}{:>10.1}{estimates:>12.1}{steps:>10.1}{:>12.2}{:>12.1}",
            row.name,
            if row.is_deep { "yes" } else { "no" },
            row.ms,
            steps / estimates,
            row.estimate_ns
        );
    }
    for row in rows.iter().skip(1) {
        println!("cost {} {:.2}", row.name, row.cost);
    }
}
