//! `mandelight frames`: the frames of a camera path.
//!
//! Existing frames are kept. So the same call continues an interrupted one, and calls with other
//! ranges can run in parallel. On standard output the frames follow one another.

use std::{
    ops::{ControlFlow, Range},
    path::{Path as FilePath, PathBuf},
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    },
    time::Instant,
};

use indicatif::ProgressBar;
use mandelight::{
    export::{
        ExportError, Eye, PictureFormat, StillJob, StillOptions, StillStatus,
        sequence::remaining_secs,
    },
    scene::{BackgroundKind, Path, Scene},
};

use super::{
    Failure,
    adapter::{AdapterArguments, StillDevice},
    encoding::{EncodingArguments, FrameFormat},
    environment::{EnvironmentArguments, warn_of_missing_map},
    folder::{Folder, FrameFile, SequenceSettings},
    input::{self, Change},
    integrator::IntegratorArguments,
    kept::{self, Kept},
    message,
    output::Output,
    render::{interruption, parse_samples, parse_size, progress_bar, show},
    shown,
    stereo::StereoArguments,
};

/// The arguments of `mandelight frames`.
#[derive(clap::Args)]
pub struct FramesArguments {
    /// A scene document with a camera path, or - for standard input
    #[arg(value_name = "SCENE")]
    scene: PathBuf,
    /// The folder for the frames; existing frames are kept. Or - for standard output, PNG after PNG
    #[arg(short, long, value_name = "FOLDER")]
    output: PathBuf,
    /// Frames A to B, without B: 0..100, 100.., ..50, or one frame; default: all frames
    #[arg(long, value_name = "A..B", value_parser = parse_frames)]
    frames: Option<FrameRange>,
    /// Width and height in pixels, each 1 to 16384; in stereo, of one eye's picture
    #[arg(long, value_name = "WxH", default_value = "1280x720", value_parser = parse_size)]
    size: [u32; 2],
    /// Samples per pixel, instead of the scenes' number
    #[arg(long, value_name = "N", value_parser = parse_samples)]
    samples: Option<u32>,
    /// The files' format; PNG unless given
    #[arg(long, value_name = "FORMAT", value_enum)]
    format: Option<FrameFormat>,
    /// The same as --format exr: linear radiance, depth, normal and position
    #[arg(long, conflicts_with = "format")]
    exr: bool,
    #[command(flatten)]
    encoding: EncodingArguments,
    /// Change a field in every key, such as quality.detail=0.5, or of the path, such as path.frames_per_second=60
    #[arg(long, value_name = "PATH=VALUE", value_parser = input::parse_change)]
    set: Vec<Change>,
    #[command(flatten)]
    integrator: IntegratorArguments,
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

/// A requested range of frames.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct FrameRange {
    first: u32,
    /// One past the last frame; none for the path's end.
    end: Option<u32>,
}

/// Renders the frames that do not exist yet.
pub fn run(arguments: FramesArguments) -> Result<(), Failure> {
    let mut project = input::read_project(&arguments.scene)?;
    let environment = arguments.environment.read()?;
    if let Some(environment) = &environment {
        environment.surround_all(&mut project);
    }
    let mut project = input::changed_project(project, &arguments.set)?;
    arguments.integrator.apply_to_all(&mut project);
    arguments.stereo.apply_to_all(&mut project);
    let path = project.path;
    if environment.is_none() && !arguments.quiet {
        // The keys' scenes decide the background, not the scene beside the path.
        let mut scenes = path.keys.iter().map(|key| &key.scene);
        let shows_map =
            |scene: &&Arc<Scene>| scene.background.kind == BackgroundKind::EnvironmentMap;
        if let Some(scene) = scenes.find(shows_map) {
            warn_of_missing_map(scene);
        }
    }
    let frames = requested_frames(arguments.frames, &path, &arguments.scene)?;
    let environment_map = environment.map(|environment| environment.environment_map);
    let FramesArguments { size, samples, quiet, .. } = arguments;
    let denoise = arguments.integrator.denoise();
    let format = match arguments.format {
        Some(format) => format.picture_format(),
        None if arguments.exr => PictureFormat::Exr,
        None => PictureFormat::Png,
    };
    let mut options = StillOptions { samples, denoise, ..StillOptions::new(size) };
    arguments.encoding.apply(format, &mut options)?;
    let eyes = arguments.stereo.eyes();
    let is_stream = arguments.output.as_path() == "-";
    if is_stream && (format != PictureFormat::Png || eyes.len() > 1) {
        return Err(Failure::usage(
            "-o -: standard output takes one PNG for each frame; leave out --format, --exr and --stereo pair, or name a folder",
        ));
    }
    let sequence = SequenceSettings {
        path: &path,
        size_px: size,
        samples,
        environment_map: environment_map.as_deref(),
        format,
        quality: options.quality,
        is_deep: options.is_deep,
        is_transparent: options.is_transparent,
        eyes,
        denoise,
    };
    for (key, &eye) in path.keys.iter().flat_map(|key| eyes.iter().map(move |eye| (key, eye))) {
        let of_eye = StillOptions { eye, ..options.clone() };
        of_eye.sheet_px(&key.scene).map_err(Failure::usage)?;
    }
    // The handler is set before a file exists that an interruption would leave behind.
    let interrupted = interruption()?;
    let destination = if is_stream {
        Destination::StandardOutput
    } else {
        Destination::Folder(Folder::open(&arguments.output, &sequence, &interrupted)?)
    };
    let files = frames.clone().flat_map(|frame| eyes.iter().map(move |&eye| (frame, eye)));
    let requested = frames.len() * eyes.len();
    let (mut missing, mut damaged) = (Vec::new(), 0);
    for file in files {
        match destination.check(file, &path, &options)? {
            Kept::Complete => continue,
            Kept::Damaged => damaged += 1,
            _ => {}
        }
        missing.push(file);
    }
    let report = |text: String| {
        if !quiet {
            message(&format!("{}: {text}", shown(&arguments.output)));
        }
    };
    if missing.is_empty() {
        report(format!("all {} exist already", counted(requested, eyes)));
        return Ok(());
    }
    if damaged > 0 {
        report(format!("{} not complete, rendered again", counted(damaged, eyes)));
    }

    let mut work = Work {
        path: &path,
        destination: &destination,
        options: StillOptions { environment_map, ..options },
        eyes,
        device: StillDevice::open(arguments.adapter)?,
        interrupted,
        progress: progress_bar(quiet),
    };
    let clock = Instant::now();
    let rendered = work.render_all(&missing);
    work.progress.finish_and_clear();
    let rendered = rendered?;
    let kept = requested - rendered;
    let kept = if kept > 0 { format!(", {kept} kept") } else { String::new() };
    let secs = clock.elapsed().as_secs_f64();
    let rendered = counted(rendered, eyes);
    report(format!("{rendered}{kept}, {secs:.1} s on {}", work.device.pipelines.gpu.name()));
    Ok(())
}

/// Where the frames go.
enum Destination {
    Folder(Folder),
    StandardOutput,
}

impl Destination {
    /// The path of a frame's file, for [`Output::create`].
    fn file(&self, frame: FrameFile) -> PathBuf {
        match self {
            Self::Folder(folder) => folder.file(frame),
            Self::StandardOutput => PathBuf::from("-"),
        }
    }

    /// What is there of a frame. A file of another picture is a failure.
    fn check(
        &self,
        frame: FrameFile,
        path: &Path,
        options: &StillOptions,
    ) -> Result<Kept, Failure> {
        let Self::Folder(folder) = self else { return Ok(Kept::Missing) };
        let file = folder.file(frame);
        match kept::check(&file, frame, path, options) {
            Ok(Kept::Foreign) => Err(Failure::usage(format!(
                "{}: this is no frame of this sequence, by its size or scene; move it away, or choose another folder",
                shown(&file)
            ))),
            Ok(kept) => Ok(kept),
            Err(error) => Err(Failure::failed(format!("{}: {error}", shown(&file)))),
        }
    }

    /// What an interrupted command says of going on.
    fn how_to_go_on(&self) -> &'static str {
        match self {
            Self::Folder(_) => "the same command goes on from there",
            Self::StandardOutput => "--frames renders the others",
        }
    }
}

/// A number of files as text: `1 frame`, `3 pictures`.
fn counted(files: usize, eyes: &[Option<Eye>]) -> String {
    let kind = if eyes.len() > 1 { "picture" } else { "frame" };
    if files == 1 { format!("1 {kind}") } else { format!("{files} {kind}s") }
}

/// The requested frames, clipped to the frames of `path`.
fn requested_frames(
    range: Option<FrameRange>,
    path: &Path,
    scene: &FilePath,
) -> Result<Range<u32>, Failure> {
    let Some(last) = path.frame_count().checked_sub(1) else {
        return Err(Failure::usage(format!(
            "{}: this scene has no camera path; create one with the timeline of the page",
            shown(scene)
        )));
    };
    let FrameRange { first, end } = range.unwrap_or(FrameRange { first: 0, end: None });
    if first > last {
        return Err(Failure::usage(format!("--frames: {first}: the last frame is {last}")));
    }
    Ok(first..end.map_or(last + 1, |end| end.min(last + 1)))
}

/// The inputs that all frames share.
struct Work<'a> {
    path: &'a Path,
    destination: &'a Destination,
    options: StillOptions,
    eyes: &'static [Option<Eye>],
    device: StillDevice,
    interrupted: Arc<AtomicBool>,
    progress: ProgressBar,
}

impl Work<'_> {
    /// Renders the `missing` files and returns their number.
    ///
    /// Skips a file that another process has rendered meanwhile.
    fn render_all(&mut self, missing: &[FrameFile]) -> Result<usize, Failure> {
        let (clock, all) = (Instant::now(), missing.len() as u32);
        let mut rendered = 0;
        for (index, &frame) in missing.iter().enumerate() {
            if self.destination.check(frame, self.path, &self.options)? == Kept::Complete {
                continue;
            }
            let file = self.destination.file(frame);
            let progress = self.progress.clone();
            let result = self.render(frame, &file, |done| {
                let done = index as f64 + done;
                let remaining = remaining_secs(clock.elapsed().as_secs_f64(), done, all);
                show(&progress, done / f64::from(all), remaining);
            });
            match result {
                Ok(()) => rendered += 1,
                Err(ExportError::Cancelled) => {
                    let reason = match self.device.loss() {
                        Some(reason) => format!("the GPU was lost: {reason}"),
                        None => "interrupted".to_owned(),
                    };
                    return Err(Failure::failed(format!(
                        "{reason}; {rendered} of {} are complete; {}",
                        counted(missing.len(), self.eyes),
                        self.destination.how_to_go_on()
                    )));
                }
                Err(error) => return Err(Failure::failed(format!("{}: {error}", shown(&file)))),
            }
        }
        Ok(rendered)
    }

    /// Renders one file; the file appears only when it is complete.
    fn render(
        &mut self,
        (frame, eye): FrameFile,
        file: &FilePath,
        on_progress: impl Fn(f64),
    ) -> Result<(), ExportError> {
        let output = Output::create(file, &self.interrupted)?;
        let options = StillOptions { eye, ..self.options.clone() };
        let job = StillJob::of_frame(&self.device.pipelines, self.path, frame, options, output)?;
        let interrupted = &self.interrupted;
        let result = job.run_on(&mut self.device, |status| {
            if let StillStatus::Working { done, .. } = status {
                on_progress(done);
            }
            if interrupted.load(Ordering::Relaxed) {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        });
        let output = result.map_err(|error| match (error, self.device.loss()) {
            // A lost device causes many different errors; the driver's reason explains all of them.
            (ExportError::Gpu(_), Some(_)) => ExportError::Cancelled,
            (error, _) => error,
        })?;
        Ok(output.commit()?)
    }
}

/// Parses `100..200`, `100..`, `..200` and `100`.
fn parse_frames(text: &str) -> Result<FrameRange, String> {
    let help = "write frames A to B, without B, as A..B, such as 0..100; or A.., ..B, or one frame";
    let number = |text: &str| text.trim().parse::<u32>().map_err(|_| help.to_owned());
    let range = match text.split_once("..") {
        None => {
            let frame = number(text)?;
            FrameRange { first: frame, end: Some(frame.saturating_add(1)) }
        }
        Some((first, end)) => FrameRange {
            first: if first.trim().is_empty() { 0 } else { number(first)? },
            end: if end.trim().is_empty() { None } else { Some(number(end)?) },
        },
    };
    match range.end {
        Some(end) if end <= range.first => {
            Err(format!("{text} holds no frame: the end, {end}, is not included"))
        }
        _ => Ok(range),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_are_parsed_and_checked() {
        let range = |first, end| Ok(FrameRange { first, end });
        assert_eq!(parse_frames("3..7"), range(3, Some(7)));
        assert_eq!(parse_frames("3.."), range(3, None));
        assert_eq!(parse_frames("..7"), range(0, Some(7)));
        assert_eq!(parse_frames(".."), range(0, None));
        assert_eq!(parse_frames("7"), range(7, Some(8)));
        for text in ["", "a..b", "3..3", "7..3", "-1..3", "1.5", "1..2..3", "3...5", "99999999999"]
        {
            assert!(parse_frames(text).is_err(), "{text:?} was accepted");
        }
    }
}
