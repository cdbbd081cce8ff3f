//! `cargo xtask bench`: the renderer's speed compared with the thesis's own algorithm.
//!
//! Both sides draw fixed views in turn on one adapter. In: the command line. Out: tables for people,
//! lines `ratio <view> <value>` for scripts, and JSON on request. `docs/benchmark.md` explains how
//! to read them. Each file imports only files above it in this table; this file imports all.
//!
//! | file | contents |
//! |---|---|
//! | `failure` | the error of any measurement |
//! | `arguments` | the command line |
//! | `statistics` | medians, quantiles, means |
//! | `poller` | a thread that runs completion callbacks |
//! | `load` | processor load of this program and of others |
//! | `peak` | the adapter's multiply-add throughput |
//! | `views` | scenes, sizes and sample counts |
//! | `limits` | `limits.txt`, and the check against it |
//! | `pixels` | compared pixels, their rays and cones in f64 |
//! | `reference` | hits, depths, normals and shadows in f64 |
//! | `errors` | errors of pictures against the reference |
//! | `instrument` | shader texts with counters |
//! | `counts` | counts of distance estimates and orbit steps |
//! | `literal` | the thesis's algorithm on the GPU |
//! | `literal_paths` | a path tracer in one kernel |
//! | `tuning` | the literal kernel's settings for a view |
//! | `ours` | the program's stills and single passes |
//! | `image_file` | PNG files of what both sides draw |
//! | `compare` | one view drawn by both sides |
//! | `timed_kernel` | a compute kernel that is run and timed |
//! | `powers` | the cost of an orbit step for each power |
//! | `descent` | the cost of depth in half decades |
//! | `deep` | the cost of depth at one place |
//! | `paths` | light paths: times, noise, bounces |
//! | `mandelbulber` | light paths beside Mandelbulber's Monte Carlo |
//! | `scaling` | growth of time with a picture's settings |
//! | `step_costs` | the cost of an orbit step of formulas' texts |
//! | `formulas` | pictures of all formulas: counts, times, errors, compilation |
//! | `start` | time to the first picture |
//! | `feel` | interactive response in a recorded session |
//! | `pieces` | how long pieces of work keep the GPU |
//! | `report` | the results of a whole run |
//! | `tables` | the tables of `docs/benchmark.md` |

pub mod arguments;
pub mod compare;
pub mod counts;
pub mod deep;
pub mod descent;
pub mod errors;
pub mod failure;
pub mod feel;
pub mod formulas;
pub mod image_file;
pub mod instrument;
pub mod limits;
pub mod literal;
pub mod literal_paths;
pub mod load;
pub mod mandelbulber;
pub mod ours;
pub mod paths;
pub mod peak;
pub mod pieces;
pub mod pixels;
pub mod poller;
pub mod powers;
pub mod reference;
pub mod report;
pub mod scaling;
pub mod start;
pub mod statistics;
pub mod step_costs;
pub mod tables;
pub mod timed_kernel;
pub mod tuning;
pub mod views;

use std::{process::ExitCode, sync::Arc};

use arguments::Arguments;
use clap::Parser as _;
use failure::Failure;
use limits::Limits;
use mandelight::{gpu::Gpu, render::Pipelines};
use report::Report;
use views::View;

/// The limits of views at their own sizes.
const LIMITS: &str = include_str!("limits.txt");

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    match run(&arguments) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) if !arguments.check => ExitCode::SUCCESS,
        Ok(false) => {
            eprintln!("bench: a picture, a power or a limit failed");
            ExitCode::FAILURE
        }
        Err(failure) => {
            eprintln!("bench: {failure}");
            ExitCode::FAILURE
        }
    }
}

/// Measures and prints what the arguments select.
///
/// True if every ratio counts, every power is within its fit, and no measurement breaks its limit.
///
/// # Errors
/// If a view or an adapter of that name doesn't exist, the device is lost or reports errors, or a
/// file can't be written.
pub fn run(arguments: &Arguments) -> Result<bool, Failure> {
    if arguments.compile_once {
        return formulas::compile_once(arguments).map(|()| true);
    }
    if arguments.start_once {
        return start::once(arguments).map(|()| true);
    }
    let views = chosen(arguments)?;
    let gpu = pollster::block_on(Gpu::open(arguments.adapter_name().as_deref()))?;
    let mut report = Report { adapter: gpu.name(), ..Report::default() };
    println!("adapter {}", report.adapter);
    let pipelines = Pipelines::new(&gpu);
    compare_views(arguments, &pipelines, &views, &mut report)?;
    measure_tables(arguments, &pipelines, &mut report)?;
    write_results(arguments, &report)?;
    let is_within_limits = check_limits(arguments, &report)?;
    match gpu.faults() {
        0 => Ok(report.is_good() && is_within_limits),
        faults => Err(format!("the device reported {faults} errors").into()),
    }
}

/// Draws the selected views on both sides.
fn compare_views(
    arguments: &Arguments,
    pipelines: &Arc<Pipelines>,
    views: &[View],
    report: &mut Report,
) -> Result<(), Failure> {
    if views.is_empty() {
        return Ok(());
    }
    let gpu = &pipelines.gpu;
    let literal = literal::Literal::new(gpu);
    let peak = peak::Peak::new(gpu);
    if gpu.faults() > 0 {
        return Err("the adapter rejects the literal kernel".into());
    }
    for view in views {
        let comparison = compare::compare(arguments, pipelines, &literal, &peak, view)?;
        comparison.print();
        report.views.push(comparison);
    }
    Ok(())
}

/// Measures the selected tables.
fn measure_tables(
    arguments: &Arguments,
    pipelines: &Arc<Pipelines>,
    report: &mut Report,
) -> Result<(), Failure> {
    let &Arguments { rounds, size, ref places, .. } = arguments;
    if arguments.wants(deep::NAME) {
        report.deep = deep::measure(pipelines, rounds, size)?;
        deep::print(&report.deep);
    }
    if arguments.wants(descent::NAME) {
        report.descent = descent::measure(pipelines, rounds.div_ceil(2), size, places)?;
    }
    if arguments.wants(paths::NAME) {
        report.paths = paths::measure(pipelines, rounds.div_ceil(2), size)?;
    }
    if arguments.wants(mandelbulber::NAME) {
        report.mandelbulber = beside_mandelbulber(arguments, pipelines)?;
    }
    if arguments.wants(powers::NAME) {
        let table = powers::measure(&pipelines.gpu, 3 * rounds)?;
        table.print();
        report.powers = Some(table);
    }
    if arguments.wants(scaling::NAME) {
        report.scaling = scaling::measure(pipelines, rounds, size);
        scaling::print(&report.scaling);
    }
    if arguments.wants(start::NAME) {
        let starts = start::measure(arguments)?;
        starts.print();
        report.start = Some(starts);
    }
    if arguments.wants(formulas::NAME) {
        report.step_costs = step_costs::measure(&pipelines.gpu, 3 * rounds)?;
        step_costs::print(&report.step_costs);
        report.formulas = formulas::measure(arguments, pipelines)?;
        formulas::print(&report.formulas);
    }
    if arguments.wants(feel::NAME) {
        let feel = feel::run(pipelines, arguments.pictures.as_deref())?;
        feel.print();
        report.feel = Some(feel);
    }
    if let Some(folder) = &arguments.keep_scenes {
        pieces::keep_scenes(folder)?;
    }
    if arguments.wants(pieces::NAME) {
        report.pieces = pieces::measure(pipelines, size);
        pieces::print(&report.pieces);
    }
    Ok(())
}

/// Draws light paths beside Mandelbulber's, which only those who ask for it must have installed.
fn beside_mandelbulber(
    arguments: &Arguments,
    pipelines: &Arc<Pipelines>,
) -> Result<Vec<mandelbulber::Row>, Failure> {
    let &Arguments { rounds, size, ref pictures, ref views, .. } = arguments;
    if views.is_empty() && !mandelbulber::is_installed() {
        println!("\n{}: left out, because it is not installed", mandelbulber::NAME);
        return Ok(Vec::new());
    }
    mandelbulber::measure(pipelines, rounds.div_ceil(2), size, pictures.as_deref())
}

/// Writes the report as JSON and as tables, where the arguments name a file.
fn write_results(arguments: &Arguments, report: &Report) -> Result<(), Failure> {
    if let Some(file) = &arguments.json {
        let text = serde_json::to_string_pretty(report)?;
        if file.as_os_str() == "-" {
            println!("{text}");
        } else {
            std::fs::write(file, text + "\n")?;
        }
    }
    if let Some(file) = &arguments.tables {
        let text = tables::updated(std::fs::read_to_string(file)?, report)?;
        std::fs::write(file, text)?;
    }
    Ok(())
}

/// Compares the report with the limits, and tightens them on request; true if none is broken.
///
/// Limits are for the views' own sizes and for all places.
fn check_limits(arguments: &Arguments, report: &Report) -> Result<bool, Failure> {
    let has_limits = arguments.size.is_none() && arguments.places.is_empty();
    let measured = if has_limits { report.measured() } else { Vec::new() };
    if let Some(file) = &arguments.tighten {
        let text = Limits::tightened(&std::fs::read_to_string(file)?, &measured)?;
        std::fs::write(file, text)?;
    }
    let limits = Limits::parse(LIMITS)?;
    let complaints = limits.complaints(&measured);
    if arguments.check && !has_limits {
        println!("limits hold without --size and --places: none was checked");
    } else if arguments.check {
        println!("{} measurements have no limit yet: see --tighten", limits.missing(&measured));
    }
    for complaint in complaints.iter().filter(|_| arguments.check) {
        println!("FAIL: {complaint}");
    }
    Ok(complaints.is_empty())
}

/// The selected views at the selected size.
fn chosen(arguments: &Arguments) -> Result<Vec<View>, Failure> {
    let mut views = views::all();
    let tables = [
        deep::NAME,
        descent::NAME,
        paths::NAME,
        mandelbulber::NAME,
        powers::NAME,
        scaling::NAME,
        start::NAME,
        formulas::NAME,
        feel::NAME,
        pieces::NAME,
    ];
    let names: Vec<_> = views.iter().map(|view| view.name).chain(tables).collect();
    if let Some(name) = arguments.views.iter().find(|name| !names.contains(&name.as_str())) {
        return Err(format!("there is no view {name:?}; there are {}", names.join(", ")).into());
    }
    views.retain(|view| arguments.wants(view.name));
    for view in &mut views {
        view.size_px = arguments.size.unwrap_or(view.size_px);
    }
    Ok(views)
}
