//! `mandelight render`: a picture of a scene.

use std::{
    fmt,
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
    export::{
        self, ExportError, PictureFormat, StillJob, StillOptions, StillStatus,
        sequence::remaining_secs,
    },
    render::report::clamped_text,
    scene::param,
};

use super::{
    Failure,
    adapter::{AdapterArguments, StillDevice},
    encoding::EncodingArguments,
    environment::{EnvironmentArguments, warn_of_missing_map},
    fractals::OtherFractal,
    gradient::GradientArguments,
    input::{self, Change},
    integrator::IntegratorArguments,
    message,
    output::Output,
    shown,
    stereo::{StereoArguments, file_of},
};

/// Number of steps of the progress bar.
const BAR_STEPS: u64 = 1000;

/// The arguments of `mandelight render`.
#[derive(clap::Args)]
pub struct RenderArguments {
    /// A scene document, a picture that contains one, or - for standard input
    #[arg(value_name = "SCENE")]
    scene: PathBuf,
    /// The file to write: JPEG if the name ends in .jpg, WebP if in .webp, OpenEXR if in .exr, else
    /// PNG; - for a PNG on standard output
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Width and height in pixels, each 1 to 16384; in stereo, of one eye's picture
    #[arg(long, value_name = "WxH", default_value = "1280x720", value_parser = parse_size)]
    size: [u32; 2],
    /// Samples per pixel, instead of the scene's number
    #[arg(long, value_name = "N", value_parser = parse_samples)]
    samples: Option<u32>,
    #[command(flatten)]
    encoding: EncodingArguments,
    #[command(flatten)]
    other: OtherFractal,
    #[command(flatten)]
    gradient: GradientArguments,
    #[command(flatten)]
    integrator: IntegratorArguments,
    /// Change a field of the scene, such as fractal.power=3 or lights.environment[0].intensity=2
    #[arg(long, value_name = "PATH=VALUE", value_parser = input::parse_change)]
    set: Vec<Change>,
    #[command(flatten)]
    stereo: StereoArguments,
    #[command(flatten)]
    environment: EnvironmentArguments,
    /// Print errors only
    #[arg(short, long)]
    quiet: bool,
    #[command(flatten)]
    adapter: AdapterArguments,
}

/// Renders the scene to one file, or to one file per eye.
pub fn run(arguments: RenderArguments) -> Result<(), Failure> {
    let mut scene = input::read_scene(&arguments.scene)?;
    let environment = arguments.environment.read()?;
    if let Some(environment) = &environment {
        environment.surround(&mut scene);
    }
    let scene = arguments.gradient.in_scene(arguments.other.in_scene(scene)?)?;
    let mut scene = input::changed(scene, &arguments.set)?;
    arguments.integrator.apply(&mut scene);
    arguments.stereo.apply(&mut scene);
    if environment.is_none() && !arguments.quiet {
        warn_of_missing_map(&scene);
    }
    let eyes = arguments.stereo.eyes();
    if arguments.output.as_path() == "-" && eyes.len() > 1 {
        return Err(Failure::usage("--stereo pair: standard output cannot take two files"));
    }
    let mut options = StillOptions {
        samples: arguments.samples,
        environment_map: environment.map(|environment| environment.environment_map),
        denoise: arguments.integrator.denoise(),
        ..StillOptions::new(arguments.size)
    };
    arguments.encoding.apply(PictureFormat::of(&arguments.output), &mut options)?;
    let files: Vec<File> = eyes
        .iter()
        .map(|&eye| {
            let path = file_of(&arguments.output, eye);
            File { path, options: StillOptions { eye, ..options.clone() } }
        })
        .collect();
    let sizes = files.iter().map(|file| file.options.sheet_px(&scene));
    let sizes: Vec<_> = sizes.collect::<Result<_, _>>().map_err(Failure::usage)?;
    // The handler is set before a file exists that an interruption would leave behind.
    let interrupted = interruption()?;
    let outputs =
        files.iter().map(|file| file.create(&interrupted)).collect::<Result<Vec<_>, _>>()?;

    let mut device = StillDevice::open(arguments.adapter)?;
    let progress = progress_bar(arguments.quiet);
    let count = files.len() as u32;
    let mut complete = Vec::new();
    let mut clamped = None;
    for ((index, file), output) in (0..).zip(&files).zip(outputs) {
        let job = StillJob::new(&device.pipelines, &scene, file.options.clone(), output)
            .map_err(|error| file.failed(error))?;
        let result = job.run_on(&mut device, |status| {
            if let StillStatus::Working { done, remaining_secs: of_file } = status {
                let all_done = f64::from(index) + done;
                let of_all = remaining_secs(progress.elapsed().as_secs_f64(), all_done, count);
                let remaining = if count == 1 { of_file } else { of_all };
                show(&progress, all_done / f64::from(count), remaining);
            }
            if let StillStatus::Done { clamped_fraction } = status {
                clamped = clamped_fraction;
            }
            if interrupted.load(Ordering::Relaxed) {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        });
        let name = names(&files);
        complete.push(result.map_err(|error| match (error, device.loss()) {
            // A lost device causes many different errors; the driver's reason explains all of them.
            (ExportError::Gpu(_), Some(reason)) => {
                progress.finish_and_clear();
                Failure::failed(format!("the GPU was lost: {reason}; {name} was not written"))
            }
            (ExportError::Cancelled, _) => {
                Failure::failed(format!("interrupted; {name} was not written"))
            }
            (error, _) => file.failed(error),
        })?);
    }
    let elapsed = progress.elapsed();
    progress.finish_and_clear();
    // Files are committed after all are complete, so a failed pair leaves no single file.
    for (file, output) in files.iter().zip(complete) {
        output.commit().map_err(|error| file.failed(error))?;
    }
    if !arguments.quiet {
        let [width, height] = sizes[0];
        let samples = arguments.samples.unwrap_or(scene.quality.samples);
        let (name, secs) = (names(&files), elapsed.as_secs_f64());
        message(&format!(
            "{name}: {width}x{height}, {samples} samples, {secs:.1} s on {}",
            device.pipelines.gpu.name()
        ));
        if let Some(fraction) = clamped {
            message(&format!("the firefly limit removed {} of the light", clamped_text(fraction)));
        }
    }
    Ok(())
}

/// A file to write, and the options of its still.
struct File {
    path: PathBuf,
    options: StillOptions,
}

impl File {
    fn name(&self) -> String {
        if self.path.as_path() == "-" { "standard output".into() } else { shown(&self.path) }
    }

    fn failed(&self, error: impl fmt::Display) -> Failure {
        Failure::failed(format!("{}: {error}", self.name()))
    }

    fn create(&self, interrupted: &Arc<AtomicBool>) -> Result<Output, Failure> {
        Output::create(&self.path, interrupted).map_err(|error| self.failed(error))
    }
}

fn names(files: &[File]) -> String {
    files.iter().map(File::name).collect::<Vec<_>>().join(" and ")
}

/// A flag that Ctrl-C sets. A second Ctrl-C ends the process at once.
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

/// A progress bar on standard error; hidden if standard error is not a terminal.
pub(super) fn progress_bar(quiet: bool) -> ProgressBar {
    if quiet {
        return ProgressBar::hidden();
    }
    // The template is a constant and well formed, so the default is never used.
    let style = ProgressStyle::with_template("{bar:40} {percent:>3} %  {msg}")
        .unwrap_or(ProgressStyle::default_bar());
    ProgressBar::new(BAR_STEPS).with_style(style)
}

/// Updates the progress bar: the completed fraction, and the estimated remaining time.
pub(super) fn show(progress: &ProgressBar, done: f64, remaining_secs: Option<f64>) {
    progress.set_position((done * BAR_STEPS as f64) as u64);
    if let Some(secs) = remaining_secs {
        // One year at most: `from_secs_f64` panics for values out of its range.
        let remaining = Duration::from_secs_f64(secs.clamp(0.0, 3.2e7).ceil());
        progress.set_message(format!("about {} left", HumanDuration(remaining)));
    }
}

/// Parses `1280x720`.
pub(super) fn parse_size(text: &str) -> Result<[u32; 2], String> {
    let sides = text
        .split_once(['x', 'X'])
        .and_then(|(width, height)| Some([width.parse().ok()?, height.parse().ok()?]));
    let sides = sides.ok_or("write the width and height in pixels, such as 1280x720")?;
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
    fn sizes_are_parsed_and_checked() {
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
    fn sample_counts_are_parsed_and_checked() {
        assert_eq!(parse_samples("16"), Ok(16));
        for text in ["0", "65537", "-1", "2.5", "many", ""] {
            assert!(parse_samples(text).is_err(), "{text:?} was accepted");
        }
    }
}
