//! `cargo xtask bench`: the renderer's speed beside that of the thesis's own algorithm.
//!
//! In: the command line. Out: tables for people, lines `ratio <view> <value>` for scripts, and JSON
//! where it is asked for, of fixed views drawn by both sides in turn on one adapter.
//! `docs/benchmark.md` tells how to read them.
//!
//! | file | what lives there |
//! |---|---|
//! | `failure` | the error of any measurement |
//! | `arguments` | the command line |
//! | `views` | what is drawn |
//! | `compare` | one view by both sides |
//! | `limits` | what a run is held to |
//! | `literal` | the thesis's algorithm on the GPU |
//! | `tuning` | its settings for a view |
//! | `ours` | the program's stills, and its passes one by one |
//! | `pixels` | compared pixels, their rays and cones |
//! | `reference` | what a picture should show, in f64 |
//! | `errors` | how far pictures are from that |
//! | `counts` | distance estimates and orbit steps of both sides |
//! | `instrument` | shaders that count what they do |
//! | `load` | how busy the processors are |
//! | `peak` | the adapter's multiply-adds |
//! | `powers` | what an orbit step costs, power by power |
//! | `deep` | what depth costs |
//! | `descent` | what every half decade on the way down costs |
//! | `scaling` | how time grows with what is asked for |
//! | `start` | how long it takes until there is a picture |
//! | `feel` | a recorded session against the clock |
//! | `image_file` | what both sides draw, as files |
//! | `report` | what was measured, told |
//! | `tables` | the same for `docs/benchmark.md` |
//! | `statistics` | medians, quantiles |

pub mod arguments;
pub mod compare;
pub mod counts;
pub mod deep;
pub mod descent;
pub mod errors;
pub mod failure;
pub mod feel;
pub mod image_file;
pub mod instrument;
pub mod limits;
pub mod literal;
pub mod load;
pub mod ours;
pub mod peak;
pub mod pixels;
pub mod powers;
pub mod reference;
pub mod report;
pub mod scaling;
pub mod start;
pub mod statistics;
pub mod tables;
pub mod tuning;
pub mod views;

use std::process::ExitCode;

use arguments::Arguments;
use clap::Parser as _;
use failure::Failure;
use limits::Limits;
use mandelight::{gpu::Gpu, render::Pipelines};
use report::Report;
use views::View;

/// The limits of views in their own sizes.
const LIMITS: &str = include_str!("limits.txt");

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    match run(&arguments) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) if !arguments.check => ExitCode::SUCCESS,
        Ok(false) => {
            eprintln!("bench: a picture, a power or a limit is not as good as it has to be");
            ExitCode::FAILURE
        }
        Err(failure) => {
            eprintln!("bench: {failure}");
            ExitCode::FAILURE
        }
    }
}

/// Measures what the arguments ask for and tells it; true where every picture is good enough, every
/// power as cheap as its products, and nothing breaks its limit.
///
/// # Errors
/// Where a view has no such name, there is no such adapter, its device is lost or reports errors,
/// or a file can't be written.
pub fn run(arguments: &Arguments) -> Result<bool, Failure> {
    if arguments.start_once {
        return start::once(arguments).map(|()| true);
    }
    let views = chosen(arguments)?;
    let gpu = pollster::block_on(Gpu::open(arguments.adapter_name().as_deref()))?;
    let mut report = Report { adapter: gpu.name(), ..Report::default() };
    println!("adapter {}", report.adapter);
    let pipelines = Pipelines::new(&gpu);
    if !views.is_empty() {
        let literal = literal::Literal::new(&gpu);
        let peak = peak::Peak::new(&gpu);
        if gpu.faults() > 0 {
            return Err("the adapter does not take the literal kernel".into());
        }
        for view in &views {
            let comparison = compare::compare(arguments, &pipelines, &literal, &peak, view)?;
            comparison.print();
            report.views.push(comparison);
        }
    }
    if arguments.wants(deep::NAME) {
        report.deep = deep::measure(&pipelines, arguments.rounds, arguments.size)?;
        deep::print(&report.deep);
    }
    if arguments.wants(descent::NAME) {
        report.descent = descent::measure(
            &pipelines,
            arguments.rounds.div_ceil(2),
            arguments.size,
            &arguments.places,
        )?;
    }
    if arguments.wants(powers::NAME) {
        let table = powers::measure(&gpu, 3 * arguments.rounds)?;
        table.print();
        report.powers = Some(table);
    }
    if arguments.wants(scaling::NAME) {
        report.scaling = scaling::measure(&pipelines, arguments.rounds, arguments.size);
        scaling::print(&report.scaling);
    }
    if arguments.wants(start::NAME) {
        let starts = start::measure(arguments)?;
        starts.print();
        report.start = Some(starts);
    }
    if arguments.wants(feel::NAME) {
        let feel = feel::run(&pipelines, arguments.pictures.as_deref())?;
        feel.print();
        report.feel = Some(feel);
    }
    if let Some(file) = &arguments.json {
        let text = serde_json::to_string_pretty(&report)?;
        if file.as_os_str() == "-" {
            println!("{text}");
        } else {
            std::fs::write(file, text + "\n")?;
        }
    }
    if let Some(file) = &arguments.tables {
        let text = tables::updated(std::fs::read_to_string(file)?, &report)?;
        std::fs::write(file, text)?;
    }
    let has_limits = arguments.size.is_none() && arguments.places.is_empty();
    let run_in_own_sizes = if has_limits { report.measured() } else { Vec::new() };
    if let Some(file) = &arguments.tighten {
        let text = Limits::tightened(&std::fs::read_to_string(file)?, &run_in_own_sizes)?;
        std::fs::write(file, text)?;
    }
    let limits = Limits::parse(LIMITS)?;
    let complaints = limits.complaints(&run_in_own_sizes);
    if arguments.check && !has_limits {
        println!("limits hold without --size and --places: none was checked");
    } else if arguments.check {
        println!(
            "{} measurements have no limit yet: see --tighten",
            limits.missing(&run_in_own_sizes)
        );
    }
    for complaint in complaints.iter().filter(|_| arguments.check) {
        println!("FAIL: {complaint}");
    }
    match gpu.faults() {
        0 => Ok(report.is_good() && complaints.is_empty()),
        faults => Err(format!("the device reported {faults} errors").into()),
    }
}

/// The views that were asked for, in the size that was asked for.
fn chosen(arguments: &Arguments) -> Result<Vec<View>, Failure> {
    let mut views = views::all();
    let tables = [deep::NAME, descent::NAME, powers::NAME, scaling::NAME, start::NAME, feel::NAME];
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
