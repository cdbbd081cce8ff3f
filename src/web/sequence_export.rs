//! An export of a path's frames: rendered one by one into a zip or a video.
//!
//! In: a path, a size, a range of frames, a file. Out: an [`ExportStatus`] a step, and in the end the
//! file. The engine steps the export between frames; dropping it cancels it.

use std::{ops::Range, sync::Arc};

use super::{
    sequence_file::{Backlog, SequenceFile},
    still_export::ExportStatus,
};
use crate::{
    export::{ExportError, SequenceJob, StillOptions, StillStatus},
    render::Pipelines,
    scene::Path,
};

/// The export of a sequence of frames.
pub struct SequenceExport {
    job: SequenceJob<SequenceFile>,
    backlog: Backlog,
    /// The part done and the seconds left, after the last step that rendered.
    progress: (f64, Option<f64>),
}

impl SequenceExport {
    /// Starts the export of `frames`; with `pair`, each frame is a file for each eye.
    ///
    /// # Errors
    /// A size, a range or a path out of range.
    pub fn start(
        pipelines: &Arc<Pipelines>,
        path: Path,
        frames: Range<u32>,
        (options, pair): (StillOptions, bool),
        file: SequenceFile,
    ) -> Result<Self, ExportError> {
        let backlog = file.backlog();
        let job = SequenceJob::new(pipelines, path, frames, options, pair, file)?;
        Ok(Self { job, backlog, progress: (0.0, None) })
    }

    /// Renders without waiting, and saves the complete file. `None` once it has ended.
    pub fn step(mut self, now_secs: f64) -> (Option<Self>, ExportStatus) {
        if self.backlog.is_full() {
            let (done, remaining_secs) = self.progress;
            return (Some(self), ExportStatus::Working(done, remaining_secs));
        }
        match self.job.step(now_secs) {
            Ok(StillStatus::Working { done, remaining_secs }) => {
                self.progress = (done, remaining_secs);
                (Some(self), ExportStatus::Working(done, remaining_secs))
            }
            Ok(StillStatus::Done { .. }) => {
                let Self { job, backlog, .. } = self;
                let status = match job.finish() {
                    Ok(file) => file.finish(),
                    Err(error) => failed(&backlog, error),
                };
                (None, status)
            }
            Err(error @ ExportError::Gpu(_)) => {
                (Some(self), ExportStatus::Stopped(error.explain()))
            }
            Err(error) => (None, failed(&self.backlog, error)),
        }
    }

    /// Continues on another device.
    pub fn resume_on(&mut self, pipelines: &Arc<Pipelines>) {
        self.job.resume_on(pipelines);
    }

    /// Number of complete files, and of finished tiles of the one after them.
    pub fn progress(&self) -> (u32, u32) {
        self.job.progress()
    }
}

/// The status of an export that ended by `error`.
fn failed(backlog: &Backlog, error: ExportError) -> ExportStatus {
    match (backlog, error) {
        (Backlog::Video(_), ExportError::Encode(reason)) => ExportStatus::VideoFailed(reason),
        (_, error) => ExportStatus::Failed(error.explain()),
    }
}
