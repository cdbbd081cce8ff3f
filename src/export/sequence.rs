//! The frames of a camera path: file names, and a job that hands all frames to one sink.
//!
//! In: a path, a range of frames, a size. Out: one picture per frame, to an archive or a video. Each
//! frame is an independent still of its scene, so every split of the range gives the same pictures.

use std::{io::Write, ops::Range, sync::Arc};

use super::{Archive, ExportError, Eye, StillJob, StillOptions, StillStatus};
use crate::{render::Pipelines, scene::Path};

/// The file name of a frame: `frame_000042.png`.
pub fn frame_name(frame: u32) -> String {
    file_name(frame, None)
}

/// The file name of a frame or of one eye's picture: `frame_000042_left.png`.
fn file_name(frame: u32, eye: Option<Eye>) -> String {
    let suffix = eye.map_or("", Eye::suffix);
    format!("frame_{frame:06}{suffix}.png")
}

/// What takes the pictures of a sequence, in the order of its frames.
pub trait FrameSink {
    /// Takes a complete picture, in the format of the job's options.
    ///
    /// # Errors
    /// [`ExportError::Write`] if it cannot be stored.
    fn add(&mut self, name: &str, picture: Vec<u8>) -> Result<(), ExportError>;
}

impl<W: Write> FrameSink for Archive<W> {
    fn add(&mut self, name: &str, picture: Vec<u8>) -> Result<(), ExportError> {
        self.add(name, &picture)
    }
}

/// Estimated remaining seconds, after `done` of `all` frames in `elapsed_secs`.
///
/// `done` includes fractions of frames. None until an estimate is possible.
pub fn remaining_secs(elapsed_secs: f64, done: f64, all: u32) -> Option<f64> {
    let left = (f64::from(all) - done).max(0.0);
    (done > 0.05 && elapsed_secs > 1.0).then(|| elapsed_secs * left / done)
}

/// A sequence in progress. Dropping the job cancels it.
pub struct SequenceJob<S: FrameSink> {
    pipelines: Arc<Pipelines>,
    path: Path,
    options: StillOptions,
    /// The eye of each file of a frame.
    eyes: &'static [Option<Eye>],
    frames: Range<u32>,
    /// The current frame.
    frame: u32,
    /// Number of complete files of the current frame.
    files: u32,
    still: Option<StillJob<Vec<u8>>>,
    sink: S,
    started_secs: Option<f64>,
}

impl<S: FrameSink> SequenceJob<S> {
    /// Starts a sequence of `frames`, clipped to the frames of `path`, for `sink`.
    ///
    /// Each frame is one file, or with `pair` one file per eye.
    ///
    /// # Errors
    /// [`ExportError::NoFrames`] if the range is empty; sizes, samples and scenes out of range as
    /// in [`StillJob::new`].
    pub fn new(
        pipelines: &Arc<Pipelines>,
        path: Path,
        frames: Range<u32>,
        options: StillOptions,
        pair: bool,
        sink: S,
    ) -> Result<Self, ExportError> {
        let frames = frames.start..frames.end.min(path.frame_count());
        if frames.is_empty() {
            return Err(ExportError::NoFrames);
        }
        path.validate()?;
        let eyes: &[_] = if pair { &[Some(Eye::Left), Some(Eye::Right)] } else { &[None] };
        for key in &path.keys {
            StillOptions { eye: eyes[0], ..options.clone() }.sheet_px(&key.scene)?;
        }
        Ok(Self {
            pipelines: pipelines.clone(),
            path,
            options,
            eyes,
            frame: frames.start,
            files: 0,
            frames,
            still: None,
            sink,
            started_secs: None,
        })
    }

    /// Does the work that needs no waiting, as [`StillJob::step`].
    ///
    /// # Errors
    /// As [`StillJob::step`].
    pub fn step(&mut self, now_secs: f64) -> Result<StillStatus, ExportError> {
        let started_secs = *self.started_secs.get_or_insert(now_secs);
        if self.frame >= self.frames.end {
            return Ok(StillStatus::Done { clamped_fraction: None });
        }
        let mut still = match self.still.take() {
            Some(still) => still,
            None => self.begin()?,
        };
        let mut of_file = 0.0;
        match still.step(now_secs) {
            Ok(StillStatus::Working { done, .. }) => {
                of_file = done;
                self.still = Some(still);
            }
            Err(error) => {
                // The still may go on with another device.
                self.still = Some(still);
                return Err(error);
            }
            Ok(StillStatus::Done { .. }) => {
                let eye = self.eyes[self.files as usize];
                self.sink.add(&file_name(self.frame, eye), still.finish()?)?;
                self.files += 1;
                if self.files as usize == self.eyes.len() {
                    self.frame += 1;
                    self.files = 0;
                }
            }
        }
        let all = self.frames.len() as u32;
        let of_frame = (f64::from(self.files) + of_file) / self.eyes.len() as f64;
        let done = f64::from(self.frame - self.frames.start) + of_frame;
        let remaining_secs = remaining_secs(now_secs - started_secs, done, all);
        Ok(StillStatus::Working { done: done / f64::from(all), remaining_secs })
    }

    /// Continues on another device, as [`StillJob::resume_on`]; complete frames stay as they are.
    pub fn resume_on(&mut self, pipelines: &Arc<Pipelines>) {
        self.pipelines = pipelines.clone();
        if let Some(still) = &mut self.still {
            still.resume_on(pipelines);
        }
    }

    /// Number of complete files, and of finished tiles of the one after them.
    pub fn progress(&self) -> (u32, u32) {
        let files = (self.frame - self.frames.start) * self.eyes.len() as u32 + self.files;
        (files, self.still.as_ref().map_or(0, StillJob::finished_tiles))
    }

    fn begin(&self) -> Result<StillJob<Vec<u8>>, ExportError> {
        let options = StillOptions { eye: self.eyes[self.files as usize], ..self.options.clone() };
        StillJob::of_frame(&self.pipelines, &self.path, self.frame, options, Vec::new())
    }

    /// The sink, which has all pictures.
    ///
    /// # Errors
    /// [`ExportError::Encode`] before [`StillStatus::Done`].
    pub fn finish(self) -> Result<S, ExportError> {
        if self.frame < self.frames.end {
            return Err(ExportError::Encode(format!("frame {} is not done", self.frame)));
        }
        Ok(self.sink)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn file_names_sort_in_frame_order() {
        assert_eq!(frame_name(42), "frame_000042.png");
        assert_eq!(file_name(7, Some(Eye::Right)), "frame_000007_right.png");
        // The longest path is an hour at 240 frames per second.
        assert_eq!(frame_name(864_000).len(), frame_name(0).len());
    }

    #[test]
    fn the_remaining_time_is_extrapolated_from_the_elapsed_time() {
        assert_eq!(remaining_secs(10.0, 2.0, 6), Some(20.0));
        assert_eq!(remaining_secs(0.5, 0.5, 6), None);
        assert_eq!(remaining_secs(60.0, 0.0, 6), None);
    }
}
