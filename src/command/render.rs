//! `mandelight render`: a picture of a scene.

use std::{
    ops::ControlFlow,
    path::PathBuf,
    process,
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    },
    time::Duration,
};

use indicatif::{HumanDuration, ProgressBar, ProgressStyle};
use mandelight::{
    export::{self, ExportError, PictureFormat, StillJob, StillOptions, StillStatus},
    render::Kernels,
    scene::param,
};

use super::{
    Failure,
    adapter::{AdapterArguments, Health},
    environment::{EnvironmentArguments, tell_of_missing},
    input::{self, Change},
    output::Output,
    tell,
};

/// Steps of the progress bar.
const BAR_STEPS: u64 = 1000;

/// What `mandelight render` takes.
#[derive(clap::Args)]
pub struct Arguments {
    /// A scene document, a picture that carries one, or - for standard input
    #[arg(value_name = "SCENE")]
    scene: PathBuf,
    /// The file to write, a PNG, or an OpenEXR file where its name ends in .exr; or - for a PNG
    /// on standard output
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Width and height in pixels, each 1 to 16384
    #[arg(long, value_name = "WxH", default_value = "1280x720", value_parser = parse_size)]
    size: [u32; 2],
    /// Samples a pixel, in place of the scene's own
    #[arg(long, value_name = "N", value_parser = parse_samples)]
    samples: Option<u32>,
    /// Change a field of the scene, such as fractal.power=3 or lights.environment[0].intensity=2
    #[arg(long, value_name = "PATH=VALUE", value_parser = input::parse_change)]
    set: Vec<Change>,
    #[command(flatten)]
    environment: EnvironmentArguments,
    /// Say nothing but errors
    #[arg(short, long)]
    quiet: bool,
    #[command(flatten)]
    adapter: AdapterArguments,
}

/// Renders the scene, and leaves the file or an error.
pub fn run(arguments: Arguments) -> Result<(), Failure> {
    let mut scene = input::read_scene(&arguments.scene)?;
    let environment = arguments.environment.read()?;
    if let Some(environment) = &environment {
        environment.surround(&mut scene);
    }
    let scene = input::changed(scene, &arguments.set)?;
    if environment.is_none() && !arguments.quiet {
        tell_of_missing(&scene);
    }
    let name = if arguments.output.as_path() == "-" {
        "standard output".into()
    } else {
        arguments.output.display().to_string()
    };
    let unwritable = |error: &dyn std::fmt::Display| Failure::failed(format!("{name}: {error}"));
    // Before there is a file that an interruption could leave behind.
    let interrupted = interruption()?;
    let output = Output::create(&arguments.output).map_err(|error| unwritable(&error))?;

    let gpu = arguments.adapter.open()?;
    let health = Health::of(&gpu);
    let options = StillOptions {
        samples: arguments.samples,
        panorama: environment.map(|environment| environment.panorama),
        format: PictureFormat::of(&arguments.output),
        ..StillOptions::new(arguments.size)
    };
    let job = StillJob::new(&Kernels::new(&gpu), &scene, options, output)
        .map_err(|error| unwritable(&error))?;

    let progress = progress_bar(arguments.quiet);
    let mut loss = None;
    let result = job.run(|status| {
        if let StillStatus::Working { done, remaining_secs } = status {
            show(&progress, done, remaining_secs);
        }
        loss = health.loss();
        if loss.is_some() || interrupted.load(Ordering::Relaxed) {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    });
    let took = progress.elapsed();
    progress.finish_and_clear();

    // A device that goes shows itself in several ways; its own words explain them all.
    if let Some(reason) = loss.or_else(|| health.loss()) {
        return Err(Failure::failed(format!("the GPU was lost: {reason}; {name} was not written")));
    }
    match result {
        Ok(output) => output.commit().map_err(|error| unwritable(&error))?,
        Err(ExportError::Cancelled) => {
            return Err(Failure::failed(format!("interrupted; {name} was not written")));
        }
        Err(error) => return Err(unwritable(&error)),
    }
    if !arguments.quiet {
        let [width, height] = arguments.size;
        let samples = arguments.samples.unwrap_or(scene.quality.samples);
        let secs = took.as_secs_f64();
        tell(&format!(
            "{name}: {width}x{height}, {samples} samples, {secs:.1} s on {}",
            gpu.name()
        ));
    }
    Ok(())
}

/// A flag that Ctrl-C sets. The second time ends the process where it stands.
pub(super) fn interruption() -> Result<Arc<AtomicBool>, Failure> {
    let flag = Arc::new(AtomicBool::new(false));
    let set = flag.clone();
    ctrlc::set_handler(move || {
        if set.swap(true, Ordering::Relaxed) {
            process::exit(1);
        }
    })
    .map_err(Failure::failed)?;
    Ok(flag)
}

/// A bar on standard error; hidden where that is no terminal.
pub(super) fn progress_bar(quiet: bool) -> ProgressBar {
    if quiet {
        return ProgressBar::hidden();
    }
    // The template is a constant that a run has shown to be well formed.
    let style = ProgressStyle::with_template("{bar:40} {percent:>3} %  {msg}")
        .unwrap_or(ProgressStyle::default_bar());
    ProgressBar::new(BAR_STEPS).with_style(style)
}

pub(super) fn show(progress: &ProgressBar, done: f64, remaining_secs: Option<f64>) {
    progress.set_position((done * BAR_STEPS as f64) as u64);
    if let Some(secs) = remaining_secs {
        // More than a year is as good as a year.
        let left = Duration::from_secs_f64(secs.clamp(0.0, 3.2e7).ceil());
        progress.set_message(format!("about {} left", HumanDuration(left)));
    }
}

/// Parses `1280x720`.
pub(super) fn parse_size(text: &str) -> Result<[u32; 2], String> {
    let sides = text
        .split_once(['x', 'X'])
        .and_then(|(width, height)| Some([width.parse().ok()?, height.parse().ok()?]));
    let sides = sides.ok_or("write it as width x height in pixels, such as 1280x720")?;
    export::checked_size(sides).map_err(|error| error.to_string())
}

pub(super) fn parse_samples(text: &str) -> Result<u32, String> {
    let samples: u32 =
        text.parse().map_err(|_| format!("write {}", param::SAMPLES.range_text()))?;
    if param::SAMPLES.accepts(samples.into()) {
        Ok(samples)
    } else {
        Err(format!("{samples} is outside {}", param::SAMPLES.range_text()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_read_and_checked() {
        assert_eq!(parse_size("1280x720"), Ok([1280, 720]));
        assert_eq!(parse_size("1X16384"), Ok([1, 16384]));
        for text in [
            "",
            "x",
            "1280",
            "0x0",
            "20000x1",
            "1x16385",
            "-1x5",
            "1.5x2",
            "1x2x3",
            "99999999999x1",
            "1280 x 720",
        ] {
            assert!(parse_size(text).is_err(), "{text:?} was accepted");
        }
        assert!(parse_size("20000x1").unwrap_err().contains("16384"));
    }

    #[test]
    fn samples_are_read_and_checked() {
        assert_eq!(parse_samples("16"), Ok(16));
        for text in ["0", "1025", "-1", "2.5", "many", ""] {
            assert!(parse_samples(text).is_err(), "{text:?} was accepted");
        }
    }
}
