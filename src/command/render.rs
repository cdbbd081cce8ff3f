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
    render::Pipelines,
    scene::param,
};

use super::{
    Failure,
    adapter::{AdapterArguments, Health},
    environment::{EnvironmentArguments, tell_of_missing},
    input::{self, Change},
    output::Output,
    stereo::{StereoArguments, file_of},
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
    /// Width and height in pixels, each 1 to 16384; in stereo, of either eye's picture
    #[arg(long, value_name = "WxH", default_value = "1280x720", value_parser = parse_size)]
    size: [u32; 2],
    /// Samples a pixel, in place of the scene's own
    #[arg(long, value_name = "N", value_parser = parse_samples)]
    samples: Option<u32>,
    /// Change a field of the scene, such as fractal.power=3 or lights.environment[0].intensity=2
    #[arg(long, value_name = "PATH=VALUE", value_parser = input::parse_change)]
    set: Vec<Change>,
    #[command(flatten)]
    stereo: StereoArguments,
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
    let mut scene = input::changed(scene, &arguments.set)?;
    arguments.stereo.lay_out(&mut scene);
    if environment.is_none() && !arguments.quiet {
        tell_of_missing(&scene);
    }
    let eyes = arguments.stereo.eyes();
    if arguments.output.as_path() == "-" && eyes.len() > 1 {
        return Err(Failure::usage("--stereo pair: two files do not go to standard output"));
    }
    let options = StillOptions {
        samples: arguments.samples,
        environment_map: environment.map(|environment| environment.environment_map),
        format: PictureFormat::of(&arguments.output),
        ..StillOptions::new(arguments.size)
    };
    let files: Vec<File> = eyes
        .iter()
        .map(|&eye| {
            let path = file_of(&arguments.output, eye);
            File { path, options: StillOptions { eye, ..options.clone() } }
        })
        .collect();
    let sizes = files.iter().map(|file| file.options.sheet_px(&scene));
    let sizes: Vec<_> = sizes.collect::<Result<_, _>>().map_err(Failure::usage)?;
    // Before there is a file that an interruption could leave behind.
    let interrupted = interruption()?;
    let outputs = files.iter().map(File::create).collect::<Result<Vec<_>, _>>()?;

    let gpu = arguments.adapter.open()?;
    let pipelines = Pipelines::for_stills(&gpu);
    let health = Health::of(&gpu);
    let progress = progress_bar(arguments.quiet);
    let count = files.len() as u32;
    let mut whole = Vec::new();
    for ((turn, file), output) in (0..).zip(&files).zip(outputs) {
        let job = StillJob::new(&pipelines, &scene, file.options.clone(), output)
            .map_err(|error| file.failed(error))?;
        let result = job.run(|status| {
            if let StillStatus::Working { done, remaining_secs: of_one } = status {
                let all_done = f64::from(turn) + done;
                let of_all = remaining_secs(progress.elapsed().as_secs_f64(), all_done, count);
                let left = if count == 1 { of_one } else { of_all };
                show(&progress, all_done / f64::from(count), left);
            }
            if health.loss().is_some() || interrupted.load(Ordering::Relaxed) {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        });
        // A device that goes shows itself in several ways; its own words explain them all.
        let name = names(&files);
        if let Some(reason) = health.loss() {
            progress.finish_and_clear();
            let text = format!("the GPU was lost: {reason}; {name} was not written");
            return Err(Failure::failed(text));
        }
        whole.push(result.map_err(|error| match error {
            ExportError::Cancelled => {
                Failure::failed(format!("interrupted; {name} was not written"))
            }
            error => file.failed(error),
        })?);
    }
    let took = progress.elapsed();
    progress.finish_and_clear();
    // Both of a pair, or neither.
    for (file, output) in files.iter().zip(whole) {
        output.commit().map_err(|error| file.failed(error))?;
    }
    if !arguments.quiet {
        let [width, height] = sizes[0];
        let samples = arguments.samples.unwrap_or(scene.quality.samples);
        let (name, secs) = (names(&files), took.as_secs_f64());
        tell(&format!(
            "{name}: {width}x{height}, {samples} samples, {secs:.1} s on {}",
            gpu.name()
        ));
    }
    Ok(())
}

/// A file to be written.
struct File {
    path: PathBuf,
    options: StillOptions,
}

impl File {
    fn name(&self) -> String {
        if self.path.as_path() == "-" {
            "standard output".into()
        } else {
            self.path.display().to_string()
        }
    }

    fn failed(&self, error: impl fmt::Display) -> Failure {
        Failure::failed(format!("{}: {error}", self.name()))
    }

    fn create(&self) -> Result<Output, Failure> {
        Output::create(&self.path).map_err(|error| self.failed(error))
    }
}

fn names(files: &[File]) -> String {
    files.iter().map(File::name).collect::<Vec<_>>().join(" and ")
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
