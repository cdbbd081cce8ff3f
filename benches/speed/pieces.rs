//! How long pieces of work keep the GPU, which draws no frame of the interface meanwhile.
//!
//! In: an adapter's pipelines. Out: times of pieces in motion budgets, over the scenes of the gallery, over random
//! scenes that are hard on the kernels, and over the most expensive settings that a document may have. One view opens
//! scene after scene, as in the page: each is a jump whose cost nothing before it foretells. Displays count apart: their
//! size is that of the picture.

use std::{
    fs, io,
    path::Path,
    sync::Arc,
    time::{Duration, Instant},
};

use mandelight::{
    gpu::Gpu,
    render::{Pace, Pipelines, Region, View, schedule::Work, view::PieceTime},
    scene::{EnvironmentMap, MAX_LIGHTS, Scene, document, param, presets},
};
use mandelight_test_support::hostile::{HostileScene, HostileScenes};
use serde::Serialize;

use super::{feel::PUMP_SECS, poller::Poller, statistics::quantile, views};

/// The table's name for `--views`.
pub const NAME: &str = "pieces";

/// Width and height of the pictures, unless another size is chosen.
const SIZE_PX: [u32; 2] = [640, 360];
/// Longest time that a scene is drawn, seconds.
const SCENE_SECS: f64 = 2.0;
/// Random scenes: the same each run.
const RANDOM_SCENES: usize = 60;
const SEED: u64 = 5;
/// Powers of the most expensive scenes: multiplied out, and by series.
const EXPENSIVE_POWERS: [f64; 3] = [8.0, 16.0, 8.5];

/// The times of pieces over a set of scenes.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// The set.
    pub name: &'static str,
    /// Number of scenes.
    pub scenes: usize,
    /// Number of pieces that trace or shade samples.
    pub pieces: usize,
    /// The median of the pieces' times, in motion budgets.
    pub median: f64,
    /// The 99th of 100, in motion budgets.
    pub most: f64,
    /// Part of the pieces that took over two budgets, percent.
    pub over: f64,
    /// The longest piece, milliseconds.
    pub longest_ms: f64,
    /// Its scene and its work.
    pub longest: String,
    /// The longest display, or part of one that was submitted in parts, milliseconds.
    pub display_ms: f64,
    /// Its scene and its parts.
    pub display: String,
}

struct Piece {
    scene: String,
    time: PieceTime,
    budget_ms: f64,
}

/// A view that someone watches.
struct Watched {
    view: View,
    gpu: Gpu,
    start: Instant,
}

impl Watched {
    /// Draws a scene, and returns the pieces of it that have finished.
    fn draw(&mut self, name: &str, scene: &Scene, map: Option<&Arc<EnvironmentMap>>) -> Vec<Piece> {
        self.view.set_environment_map(map);
        self.view.set_scene(scene, false);
        let until_secs = self.start.elapsed().as_secs_f64() + SCENE_SECS;
        let mut times = Vec::new();
        loop {
            let now_secs = self.start.elapsed().as_secs_f64();
            let is_busy = self.view.pump(now_secs);
            times.extend(self.view.take_piece_times());
            // The first pieces are waited for, however long they take.
            let is_shown = self.view.report().pictures > 0 && !self.view.is_amid_display();
            if !is_busy || (now_secs > until_secs && is_shown) {
                break;
            }
            std::thread::sleep(Duration::from_secs_f64(PUMP_SECS));
        }
        // The next scene's anchor may take all processor cores, which are the GPU of a software adapter.
        self.gpu.wait();
        times.extend(self.view.take_piece_times());
        let budget_ms = scene.quality.motion_budget_ms;
        let piece = |time| Piece { scene: name.to_owned(), time, budget_ms };
        times.into_iter().map(piece).collect()
    }
}

/// A set of scenes of one row.
struct Scenes {
    name: &'static str,
    /// The scenes by name, with the environment maps that lights are made of.
    scenes: Vec<HostileScene>,
}

/// All sets of scenes.
fn all_scenes() -> Vec<Scenes> {
    let plain = |(name, scene)| HostileScene { name, scene, environment_map: None };
    let gallery = presets::all().map(|preset| plain((preset.name.to_owned(), (preset.scene)())));
    let mut generator = HostileScenes::new(SEED);
    vec![
        Scenes { name: "gallery", scenes: gallery.collect() },
        Scenes {
            name: "random",
            scenes: (0..RANDOM_SCENES).map(|_| generator.next_scene()).collect(),
        },
        Scenes { name: "expensive", scenes: expensive_scenes().into_iter().map(plain).collect() },
    ]
}

/// Writes all scenes to `folder` as documents, a folder for each set, numbered in order: for `benches/page/pieces.mjs`.
///
/// # Errors
/// If a file cannot be written.
pub fn keep_scenes(folder: &Path) -> io::Result<()> {
    for Scenes { name, scenes } in all_scenes() {
        let folder = folder.join(name);
        fs::create_dir_all(&folder)?;
        for (index, it) in scenes.iter().enumerate() {
            let file = folder.join(format!("{index:02}.json"));
            fs::write(file, document::to_json(&it.scene))?;
        }
    }
    Ok(())
}

/// Measures all sets of scenes.
pub fn measure(pipelines: &Arc<Pipelines>, size_px: Option<[u32; 2]>) -> Vec<Row> {
    let _poller = Poller::new(&pipelines.gpu);
    let region = Region::whole(size_px.unwrap_or(SIZE_PX));
    let view = View::new(pipelines, region, Pace::Interactive);
    let mut watched = Watched { view, gpu: pipelines.gpu.clone(), start: Instant::now() };
    watched.view.watch_piece_times(true);
    let rows = all_scenes().into_iter().map(|Scenes { name, scenes }| {
        let mut pieces = Vec::new();
        for HostileScene { name, scene, environment_map } in &scenes {
            pieces.extend(watched.draw(name, scene, environment_map.as_ref()));
        }
        row(name, scenes.len(), pieces)
    });
    let rows = rows.collect();
    pipelines.gpu.wait();
    rows
}

/// A view filled with surface in as many lights as there may be, all with shadows, at the finest detail and with the
/// most iterations.
fn expensive_scenes() -> Vec<(String, Scene)> {
    let scene = |&power: &f64| {
        let mut scene = views::with_lights(views::filled(), views::many_lights(MAX_LIGHTS as u32));
        for light in &mut scene.lights.environment {
            light.shadow_reach = None;
        }
        scene.fractal.set("power", power);
        scene.fractal.iterations = param::ITERATIONS.max as u32;
        scene.quality.detail = param::DETAIL.min;
        (format!("power {power}"), scene)
    };
    EXPENSIVE_POWERS.iter().map(scene).collect()
}

fn row(name: &'static str, scenes: usize, pieces: Vec<Piece>) -> Row {
    let is_display = |piece: &Piece| matches!(piece.time.work, Work::Display(_));
    let (displays, pieces): (Vec<_>, Vec<_>) = pieces.into_iter().partition(is_display);
    let budgets = |piece: &Piece| piece.time.busy_ms / piece.budget_ms;
    let at = |part| quantile(pieces.iter().map(budgets).collect(), part);
    let over = pieces.iter().filter(|piece| budgets(piece) > 2.0).count();
    let longest = |of: &[Piece]| {
        let longest = of.iter().max_by(|a, b| a.time.busy_ms.total_cmp(&b.time.busy_ms));
        longest.map(|piece| (piece.scene.clone(), piece.time))
    };
    let of_piece = longest(&pieces);
    let of_display = longest(&displays);
    Row {
        name,
        scenes,
        pieces: pieces.len(),
        median: at(0.5),
        most: at(0.99),
        over: 100.0 * over as f64 / pieces.len().max(1) as f64,
        longest_ms: of_piece.as_ref().map_or(0.0, |(_, time)| time.busy_ms),
        longest: of_piece
            .map(|(scene, time)| format!("{scene}: {:?}", time.work))
            .unwrap_or_default(),
        display_ms: of_display.as_ref().map_or(0.0, |(_, time)| time.busy_ms),
        display: of_display
            .map(|(scene, time)| format!("{scene}: {:?}", time.parts))
            .unwrap_or_default(),
    }
}

/// Share of long pieces, and the longest piece, over all sets of scenes.
#[derive(Clone, Copy, Debug)]
pub struct Summary {
    /// Part of the pieces that took over two budgets, percent.
    pub over: f64,
    /// The longest piece or display, milliseconds.
    pub longest_ms: f64,
}

/// The summary of all rows; none without pieces.
pub fn summary(rows: &[Row]) -> Option<Summary> {
    let pieces: usize = rows.iter().map(|row| row.pieces).sum();
    let over: f64 = rows.iter().map(|row| row.over * row.pieces as f64).sum();
    let longest_ms = rows.iter().map(|row| row.longest_ms.max(row.display_ms)).fold(0.0, f64::max);
    (pieces > 0).then(|| Summary { over: over / pieces as f64, longest_ms })
}

/// Prints the table.
pub fn print(rows: &[Row]) {
    println!("\npieces of work: GPU time in motion budgets");
    let names = ["scenes", "pieces", "median", "99 %", "over 2", "longest ms", "display ms"];
    let [scenes, pieces, median, most, over, longest, display] = names;
    println!(
        "  {:<10}{scenes:>7}{pieces:>8}{median:>8}{most:>8}{over:>9}{longest:>12}{display:>12}",
        ""
    );
    for row in rows {
        let Row { name, scenes, pieces, median, most, over, longest_ms, display_ms, .. } = row;
        println!(
            "  {name:<10}{scenes:>7}{pieces:>8}{median:>8.2}{most:>8.2}{over:>7.1} %{longest_ms:>12.1}{display_ms:>12.1}"
        );
        println!("            the longest: {}", row.longest);
        println!("            the longest display: {}", row.display);
    }
    if let Some(Summary { over, longest_ms }) = summary(rows) {
        println!("  all sets: {over:.2} % over two budgets, the longest {longest_ms:.1} ms");
    }
}
