//! `mandelight frames`: the frames of a camera path.
//!
//! Frames that are there are kept, so that the same call goes on where the last one ended, and
//! calls with other ranges can run beside it.

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
    render::Pipelines,
    scene::{BackgroundKind, Path, Scene},
};

use super::{
    Failure,
    adapter::{AdapterArguments, Health},
    environment::{EnvironmentArguments, tell_of_missing},
    folder::{Folder, FrameFile, Sequence},
    input::{self, Change},
    output::Output,
    render::{interruption, parse_samples, parse_size, progress_bar, show},
    stereo::StereoArguments,
    tell,
};

/// What `mandelight frames` takes.
#[derive(clap::Args)]
pub struct Arguments {
    /// A scene document with a camera path, or - for standard input
    #[arg(value_name = "SCENE")]
    scene: PathBuf,
    /// The folder for the frames; frames that are there already are kept
    #[arg(short, long, value_name = "FOLDER")]
    output: PathBuf,
    /// Frames A to B, without B: 0..100, 100.., ..50, or a single one; all unless given
    #[arg(long, value_name = "A..B", value_parser = parse_frames)]
    frames: Option<Wanted>,
    /// Width and height in pixels, each 1 to 16384; in stereo, of either eye's picture
    #[arg(long, value_name = "WxH", default_value = "1280x720", value_parser = parse_size)]
    size: [u32; 2],
    /// Samples a pixel, in place of the scenes' own
    #[arg(long, value_name = "N", value_parser = parse_samples)]
    samples: Option<u32>,
    /// Write OpenEXR files, with linear radiance, depth, normal and position, in place of PNGs
    #[arg(long)]
    exr: bool,
    /// Change a field in every key, such as quality.detail=0.5, or of the path, such as path.frames_per_second=60
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

/// A range of frames as it was asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Wanted {
    first: u32,
    /// The first frame that is not wanted; none for all there are.
    end: Option<u32>,
}

/// Renders the frames that are not there yet.
pub fn run(arguments: Arguments) -> Result<(), Failure> {
    let mut project = input::read_project(&arguments.scene)?;
    let environment = arguments.environment.read()?;
    if let Some(environment) = &environment {
        environment.surround_all(&mut project);
    }
    let mut project = input::changed_project(project, &arguments.set)?;
    arguments.stereo.lay_out_all(&mut project);
    let path = project.path;
    if environment.is_none() && !arguments.quiet {
        // The frames show the keys' pictures, whatever the scene beside them has.
        let mut scenes = path.keys.iter().map(|key| &key.scene);
        let shows_one = |scene: &&Arc<Scene>| scene.background.kind == BackgroundKind::Picture;
        if let Some(scene) = scenes.find(shows_one) {
            tell_of_missing(scene);
        }
    }
    let frames = wanted_of(arguments.frames, &path, &arguments.scene)?;
    let environment_map = environment.map(|environment| environment.environment_map);
    let Arguments { size, samples, quiet, .. } = arguments;
    let format = if arguments.exr { PictureFormat::Exr } else { PictureFormat::Png };
    let eyes = arguments.stereo.eyes();
    let sequence = Sequence {
        path: &path,
        size_px: size,
        samples,
        environment_map: environment_map.as_deref(),
        format,
        eyes,
    };
    let options = StillOptions { samples, format, ..StillOptions::new(size) };
    for (key, &eye) in path.keys.iter().flat_map(|key| eyes.iter().map(move |eye| (key, eye))) {
        let of_eye = StillOptions { eye, ..options.clone() };
        of_eye.sheet_px(&key.scene).map_err(Failure::usage)?;
    }
    // Before there is a file that an interruption could leave behind.
    let interrupted = interruption()?;
    let folder = Folder::open(&arguments.output, &sequence)?;
    let files = frames.clone().flat_map(|frame| eyes.iter().map(move |&eye| (frame, eye)));
    let wanted = frames.len() * eyes.len();
    let missing: Vec<_> = files.filter(|&file| !folder.has(file)).collect();
    let say = |text: String| {
        if !quiet {
            tell(&format!("{}: {text}", arguments.output.display()));
        }
    };
    if missing.is_empty() {
        say(format!("all {} are there", counted(wanted, eyes)));
        return Ok(());
    }

    let gpu = arguments.adapter.open()?;
    let work = Work {
        path: &path,
        folder: &folder,
        options: StillOptions { environment_map, ..options },
        eyes,
        pipelines: Pipelines::for_stills(&gpu),
        health: Health::of(&gpu),
        interrupted,
        progress: progress_bar(quiet),
    };
    let clock = Instant::now();
    let made = work.make(&missing);
    work.progress.finish_and_clear();
    let made = made?;
    let kept = wanted - made;
    let kept = if kept > 0 { format!(", {kept} kept") } else { String::new() };
    let secs = clock.elapsed().as_secs_f64();
    let made = counted(made, eyes);
    say(format!("{made}{kept}, {secs:.1} s on {}", gpu.name()));
    Ok(())
}

/// So many files, in words.
fn counted(files: usize, eyes: &[Option<Eye>]) -> String {
    let kind = if eyes.len() > 1 { "picture" } else { "frame" };
    if files == 1 { format!("1 {kind}") } else { format!("{files} {kind}s") }
}

/// The frames that were asked for, of those that there are.
fn wanted_of(wanted: Option<Wanted>, path: &Path, scene: &FilePath) -> Result<Range<u32>, Failure> {
    let Some(last) = path.frame_count().checked_sub(1) else {
        return Err(Failure::usage(format!(
            "{}: this scene has no camera path; the page's timeline makes one",
            scene.display()
        )));
    };
    let Wanted { first, end } = wanted.unwrap_or(Wanted { first: 0, end: None });
    if first > last {
        return Err(Failure::usage(format!("--frames: {first}: the last frame is {last}")));
    }
    Ok(first..end.map_or(last + 1, |end| end.min(last + 1)))
}

/// What every frame needs.
struct Work<'a> {
    path: &'a Path,
    folder: &'a Folder,
    options: StillOptions,
    eyes: &'static [Option<Eye>],
    pipelines: Arc<Pipelines>,
    health: Health,
    interrupted: Arc<AtomicBool>,
    progress: ProgressBar,
}

impl Work<'_> {
    /// Makes those of `missing` that nobody else has made meanwhile, and says how many.
    fn make(&self, missing: &[FrameFile]) -> Result<usize, Failure> {
        let (clock, all) = (Instant::now(), missing.len() as u32);
        let mut made = 0;
        for (turn, &wanted) in missing.iter().enumerate() {
            if self.folder.has(wanted) {
                continue;
            }
            let file = self.folder.file(wanted);
            let whole = self.frame(wanted, &file, |done| {
                let done = turn as f64 + done;
                let left = remaining_secs(clock.elapsed().as_secs_f64(), done, all);
                show(&self.progress, done / f64::from(all), left);
            });
            match whole {
                Ok(()) => made += 1,
                Err(ExportError::Cancelled) => {
                    let reason = match self.health.loss() {
                        Some(reason) => format!("the GPU was lost: {reason}"),
                        None => "interrupted".to_owned(),
                    };
                    return Err(Failure::failed(format!(
                        "{reason}; {made} of {} were made; the same command goes on from there",
                        counted(missing.len(), self.eyes)
                    )));
                }
                Err(error) => return Err(Failure::failed(format!("{}: {error}", file.display()))),
            }
        }
        Ok(made)
    }

    /// Makes one frame, or one eye's, there whole or not at all.
    fn frame(
        &self,
        (frame, eye): FrameFile,
        file: &FilePath,
        tell: impl Fn(f64),
    ) -> Result<(), ExportError> {
        let scene = self.path.frame(frame).ok_or(ExportError::NoFrames)?;
        let output = Output::create(file)?;
        let options = StillOptions { eye, ..self.options.clone() };
        let job = StillJob::new(&self.pipelines, &scene, options, output)?;
        let result = job.run(|status| {
            if let StillStatus::Working { done, .. } = status {
                tell(done);
            }
            if self.health.loss().is_some() || self.interrupted.load(Ordering::Relaxed) {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        });
        // A device that goes shows itself in several ways; its own words explain them all.
        let output = result.map_err(|error| match self.health.loss() {
            Some(_) => ExportError::Cancelled,
            None => error,
        })?;
        Ok(output.commit()?)
    }
}

/// Parses `100..200`, `100..`, `..200` and `100`.
fn parse_frames(text: &str) -> Result<Wanted, String> {
    let help =
        "write it as A..B, frames A to B without B, such as 0..100; or A.., ..B, or one frame";
    let number = |text: &str| text.trim().parse::<u32>().map_err(|_| help.to_owned());
    let wanted = match text.split_once("..") {
        None => {
            let frame = number(text)?;
            Wanted { first: frame, end: Some(frame.saturating_add(1)) }
        }
        Some((first, end)) => Wanted {
            first: if first.trim().is_empty() { 0 } else { number(first)? },
            end: if end.trim().is_empty() { None } else { Some(number(end)?) },
        },
    };
    match wanted.end {
        Some(end) if end <= wanted.first => {
            Err(format!("{text} holds no frame: the end, {end}, is not one of them"))
        }
        _ => Ok(wanted),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_are_read_and_checked() {
        let range = |first, end| Ok(Wanted { first, end });
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
