//! Growth of a picture's time when one of its settings doubles.
//!
//! In: the program's pipelines. Out: a row per setting.

use std::sync::Arc;

use glam::DVec3;
use mandelight::{
    render::Pipelines,
    scene::{EnvironmentLight, Scene},
};
use serde::Serialize;

use super::{
    ours,
    statistics::median,
    views::{self, light, many_lights, with_lights},
};

/// The table's name for `--views`.
pub const NAME: &str = "scaling";
/// Width and height of the base view, unless another size is chosen.
const SIZE_PX: [u32; 2] = [640, 360];

/// The time of one setting.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// The setting.
    pub name: &'static str,
    /// The setting's amount divided by that of the row [`Self::against`].
    pub factor: f64,
    /// The row to compare with.
    pub against: &'static str,
    /// Median time, milliseconds.
    pub ms: f64,
    /// [`Self::ms`] divided by that of the row [`Self::against`].
    pub growth: f64,
}

/// The name of the base view's row.
const VIEW: &str = "the view";

struct Case {
    name: &'static str,
    factor: f64,
    against: &'static str,
    scene: Scene,
    size_px: [u32; 2],
}

/// The base view, and its settings in pairs of which one has twice as much.
fn cases(size_px: [u32; 2]) -> Vec<Case> {
    let four = || with_lights(views::filled(), many_lights(4));
    let base = views::filled;
    let case = |name, factor, against, scene| Case { name, factor, against, scene, size_px };
    let twice_px = size_px.map(|side| (f64::from(side) * 2.0_f64.sqrt()).round() as u32);
    let iterations = |count| {
        let mut scene = base();
        scene.fractal.iterations = count;
        scene
    };
    let eight = |four_more: Vec<EnvironmentLight>| {
        with_lights(base(), many_lights(4).into_iter().chain(four_more).collect())
    };
    // Directions behind all that the camera sees.
    let away = base().camera.forward();
    let from_behind = |k: i32| {
        let aside = DVec3::new(0.05 * f64::from(k), 0.0, 0.0);
        light((away + aside).to_array(), [1.0; 3], 1.0)
    };
    let muted = |light: EnvironmentLight| EnvironmentLight { muted: true, ..light };
    vec![
        case(VIEW, 1.0, VIEW, base()),
        Case { size_px: twice_px, ..case("twice the pixels", 2.0, VIEW, base()) },
        case("2 samples", 2.0, VIEW, views::sampled(base(), 2)),
        case("4 samples", 2.0, "2 samples", views::sampled(base(), 4)),
        case("32 iterations", 2.0, VIEW, iterations(32)),
        case("64 iterations", 2.0, "32 iterations", iterations(64)),
        case("4 lights", 1.0, "4 lights", four()),
        case("8 lights", 2.0, "4 lights", with_lights(base(), many_lights(8))),
        case("16 lights", 2.0, "8 lights", with_lights(base(), many_lights(16))),
        case(
            "4 lights, 4 muted",
            2.0,
            "4 lights",
            eight(many_lights(4).into_iter().map(muted).collect()),
        ),
        case("4 lights, 4 behind", 2.0, "4 lights", eight((0..4).map(from_behind).collect())),
    ]
}

/// Measures all rows, `rounds` times each.
pub fn measure(pipelines: &Arc<Pipelines>, rounds: u32, size_px: Option<[u32; 2]>) -> Vec<Row> {
    let cases = cases(size_px.unwrap_or(SIZE_PX));
    let mut times = vec![Vec::new(); cases.len()];
    for round in 0..=rounds {
        for (case, times) in cases.iter().zip(&mut times) {
            let (ms, _) = ours::draw_ms(pipelines, &case.scene, case.size_px);
            // The first round is a warm-up.
            if round > 0 {
                times.push(ms);
            }
        }
    }
    let ms: Vec<_> = times.iter().map(|times| median(times)).collect();
    let of = |name: &str| cases.iter().position(|case| case.name == name).unwrap_or(0);
    cases
        .iter()
        .zip(&ms)
        .map(|(case, &own_ms)| Row {
            name: case.name,
            factor: case.factor,
            against: case.against,
            ms: own_ms,
            growth: own_ms / ms[of(case.against)],
        })
        .collect()
}

/// Prints the table.
pub fn print(rows: &[Row]) {
    println!("\nscaling: the filled view, each row beside the one that has half as much");
    println!("  {:<20}{:>10}  {:>6}  {:>6}  against", "", "ms", "times", "asked");
    for Row { name, factor, against, ms, growth } in rows.iter().filter(|row| row.factor > 1.0) {
        println!("  {name:<20}{ms:>10.1}  {growth:>6.2}  {factor:>6.2}  {against}");
    }
}
