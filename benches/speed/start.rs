//! Time from the start of a process to its first picture, and the share of shader compilation.
//!
//! In: the arguments. Out: medians of a first visit and of a later one. Each start is a process
//! of its own, because drivers cache compiled shaders on disk; an environment variable turns
//! Mesa's cache off for a first visit.

use std::{process::Command, time::Instant};

use mandelight::{
    gpu::Gpu,
    render::{Pace, Pipelines, Region, Report, View},
    scene::presets,
};
use serde::{Deserialize, Serialize};

use super::{arguments::Arguments, failure::Failure, statistics::median};

/// The table's name for `--views`.
pub const NAME: &str = "start";
const SIZE_PX: [u32; 2] = [1280, 720];

/// The parts of one start, milliseconds.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub struct Start {
    /// From the start to a device.
    pub device: f64,
    /// Creation of the pipelines that every picture needs.
    pub pipelines: f64,
    /// From setting the scene to its first picture, a filled sparse lattice.
    pub picture: f64,
    /// The same again in a second view.
    ///
    /// The difference to [`Self::picture`] is compilation that the driver deferred to the
    /// first use.
    pub again: f64,
    /// Creation of the pipelines specialised for the power, which the page compiles while idle.
    pub special: f64,
    /// From setting the scene to the first sample of every pixel, without compilation.
    pub complete: f64,
}

impl Start {
    /// Compilation before the first picture.
    fn compilation(&self) -> f64 {
        self.pipelines + (self.picture - self.again).max(0.0)
    }

    /// Total time to the first picture.
    fn all(&self) -> f64 {
        self.device + self.pipelines + self.picture
    }
}

/// A line of the table: its name and value.
type Part = (&'static str, fn(&Start) -> f64);

/// The table's lines.
pub const PARTS: &[Part] = &[
    ("until a device is there", |start| start.device),
    ("shader compilation", Start::compilation),
    ("the first picture itself", |start| start.again),
    ("in all", Start::all),
    ("the power's own pipelines", |start| start.special),
    ("every pixel's first sample", |start| start.complete),
];

/// Medians of a first visit and of a later one.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Starts {
    /// No shader is compiled yet.
    pub first: Start,
    /// The driver has its shaders on disk, if it caches them.
    pub later: Start,
}

/// Starts once in this process and prints the times as a line of JSON.
///
/// # Errors
/// If there is no adapter.
pub fn once(arguments: &Arguments) -> Result<(), Failure> {
    let mut clock = Instant::now();
    let mut lap = || {
        let ms = clock.elapsed().as_secs_f64() * 1e3;
        clock = Instant::now();
        ms
    };
    let gpu = pollster::block_on(Gpu::open(arguments.adapter_name().as_deref()))?;
    let device = lap();
    let pipelines = Pipelines::new(&gpu);
    let compiled = lap();
    let mut scene = presets::opening();
    scene.quality.samples = 1;
    let size_px = arguments.size.unwrap_or(SIZE_PX);
    let drawn_until = |is_enough: fn(&Report) -> bool| {
        let mut view = View::new(&pipelines, Region::whole(size_px), Pace::Interactive);
        view.set_scene(&scene, false);
        let started = Instant::now();
        while !is_enough(&view.report()) {
            view.pump(started.elapsed().as_secs_f64());
            gpu.wait();
        }
    };
    let has_picture = |report: &Report| report.pictures > 0;
    lap();
    drawn_until(has_picture);
    let picture = lap();
    drawn_until(has_picture);
    let again = lap();
    pipelines.specialize(&scene);
    let made = lap();
    let has_sample = |report: &Report| report.samples_done > 0;
    drawn_until(has_sample);
    let compiling = lap();
    drawn_until(has_sample);
    let complete = lap();
    // Drivers defer a part of this compilation too.
    let special = made + (compiling - complete).max(0.0);
    let start = Start { device, pipelines: compiled, picture, again, special, complete };
    println!("{}", serde_json::to_string(&start)?);
    Ok(())
}

/// Measures starts in processes of their own, `rounds` times each.
///
/// # Errors
/// If a process fails.
pub fn measure(arguments: &Arguments) -> Result<Starts, Failure> {
    let runs = |is_cached: bool| -> Result<Start, Failure> {
        let starts: Vec<_> = (0..arguments.rounds)
            .map(|_| start_process(arguments, is_cached))
            .collect::<Result<_, _>>()?;
        let of = |part: fn(&Start) -> f64| median(&starts.iter().map(part).collect::<Vec<_>>());
        Ok(Start {
            device: of(|start| start.device),
            pipelines: of(|start| start.pipelines),
            picture: of(|start| start.picture),
            again: of(|start| start.again),
            special: of(|start| start.special),
            complete: of(|start| start.complete),
        })
    };
    let first = runs(false)?;
    // Fills the driver's cache.
    start_process(arguments, true)?;
    Ok(Starts { first, later: runs(true)? })
}

fn start_process(arguments: &Arguments, is_cached: bool) -> Result<Start, Failure> {
    let mut process = Command::new(std::env::current_exe()?);
    process.arg("--start-once").env("MESA_SHADER_CACHE_DISABLE", (!is_cached).to_string());
    if let Some(name) = arguments.adapter_name() {
        process.args(["--adapter", &name]);
    }
    if let Some([width, height]) = arguments.size {
        process.args(["--size", &format!("{width}x{height}")]);
    }
    let output = process.output()?;
    let text = String::from_utf8_lossy(&output.stdout);
    let line = text.lines().last().ok_or("a start printed nothing")?;
    Ok(serde_json::from_str(line)?)
}

impl Starts {
    /// Prints the table.
    pub fn print(&self) {
        println!("\nstart: milliseconds until there is a picture");
        println!("  {:<34}{:>10}{:>10}", "", "first", "later");
        for (name, part) in PARTS {
            println!("  {name:<34}{:>10.1}{:>10.1}", part(&self.first), part(&self.later));
        }
    }
}
