//! How long it takes until there is a picture, and how much of that is shader compilation.
//!
//! Each start is a process of its own. Drivers keep compiled shaders on disk: Mesa is told not to,
//! and then to, for a first visit and a later one.

use std::{process::Command, time::Instant};

use mandelight::{
    gpu::Gpu,
    render::{Pace, Pipelines, Region, Report, View},
    scene::Scene,
};
use serde::{Deserialize, Serialize};

use super::{arguments::Arguments, failure::Failure, statistics::median};

/// What `--views` calls the table.
pub const NAME: &str = "start";
const SIZE_PX: [u32; 2] = [1280, 720];

/// One start, milliseconds of each part.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub struct Start {
    /// From nothing to a device.
    pub device: f64,
    /// Making the pipelines that every picture needs.
    pub pipelines: f64,
    /// From a scene to its first picture on the screen, a sparse lattice filled in.
    pub picture: f64,
    /// The same once more, in a view of its own: what the first one took longer is compilation
    /// that the driver had put off until then.
    pub again: f64,
    /// The power's own pipelines, which the page compiles while it rests.
    pub special: f64,
    /// From a scene to every pixel's first sample, all being compiled.
    pub complete: f64,
}

impl Start {
    /// Compilation that a first picture waits for.
    fn compilation(&self) -> f64 {
        self.pipelines + (self.picture - self.again).max(0.0)
    }

    /// All that it waits for.
    fn all(&self) -> f64 {
        self.device + self.pipelines + self.picture
    }
}

/// One line of the table: its name, and what of a start it tells.
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

/// A first visit and a later one.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Starts {
    /// Nothing is compiled yet.
    pub first: Start,
    /// The driver has its shaders on disk; the same where it keeps none.
    pub later: Start,
}

/// Starts once, in this process, and says how long it took as a line of JSON.
///
/// # Errors
/// Where there is no adapter.
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
    let mut scene = Scene::default();
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
    pipelines.specialise(&scene);
    let made = lap();
    let has_sample = |report: &Report| report.samples_done > 0;
    drawn_until(has_sample);
    let compiling = lap();
    drawn_until(has_sample);
    let complete = lap();
    // What the driver put off again.
    let special = made + (compiling - complete).max(0.0);
    let start = Start { device, pipelines: compiled, picture, again, special, complete };
    println!("{}", serde_json::to_string(&start)?);
    Ok(())
}

/// Starts so many times in processes of their own.
///
/// # Errors
/// Where one of them fails.
pub fn measure(arguments: &Arguments) -> Result<Starts, Failure> {
    let runs = |is_cached: bool| -> Result<Start, Failure> {
        let starts: Vec<_> =
            (0..arguments.rounds).map(|_| one(arguments, is_cached)).collect::<Result<_, _>>()?;
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
    // Fills the cache.
    one(arguments, true)?;
    Ok(Starts { first, later: runs(true)? })
}

fn one(arguments: &Arguments, is_cached: bool) -> Result<Start, Failure> {
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
    let line = text.lines().last().ok_or("a start said nothing")?;
    Ok(serde_json::from_str(line)?)
}

impl Starts {
    /// Tells them to people.
    pub fn print(&self) {
        println!("\nstart: milliseconds until there is a picture");
        println!("  {:<34}{:>10}{:>10}", "", "first", "later");
        for (name, part) in PARTS {
            println!("  {name:<34}{:>10.1}{:>10.1}", part(&self.first), part(&self.later));
        }
    }
}
