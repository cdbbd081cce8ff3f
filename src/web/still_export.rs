//! An export of one picture, or of one for each eye, as downloads.
//!
//! In: the scene and a size. Out: an [`ExportStatus`] a step, and in the end the downloads. The
//! engine steps the export between frames; dropping it cancels it.

use std::sync::Arc;

use super::files::Download;
use crate::{
    export::{ExportError, Eye, StillJob, StillOptions, StillStatus, sequence::remaining_secs},
    render::{Pipelines, View},
    scene::Scene,
};

/// The export of a still or of a pair of stills.
pub struct StillExport {
    pipelines: Arc<Pipelines>,
    scene: Scene,
    options: StillOptions,
    job: StillJob<Download>,
    /// The eye of each file; `None` for a file of the whole picture.
    eyes: &'static [Option<Eye>],
    /// Names of the downloads so far.
    saved: Vec<String>,
    started_secs: Option<f64>,
}

/// The status of an export of any kind.
pub enum ExportStatus {
    /// The part done, 0 to 1, and the estimated seconds left.
    Working(f64, Option<f64>),
    /// The download has begun; the file's name.
    Saved(String),
    /// All bytes are handed over; the file posts a notice when closed.
    Closing,
    /// The GPU failed, with an explanation: the export can go on with another device.
    Stopped(String),
    /// The export failed, with an explanation.
    Failed(String),
    /// The export of a video failed, with the reason.
    VideoFailed(String),
}

impl StillExport {
    /// Starts the export of `scene`; with `pair`, each eye is a file.
    ///
    /// `view`: a view whose samples are taken if they are those of the picture.
    ///
    /// # Errors
    /// A size or a scene out of range.
    pub fn start(
        pipelines: &Arc<Pipelines>,
        scene: &Scene,
        options: StillOptions,
        pair: bool,
        view: Option<&View>,
    ) -> Result<Self, ExportError> {
        let eyes: &[_] = if pair { &[Some(Eye::Left), Some(Eye::Right)] } else { &[None] };
        let options = StillOptions { eye: eyes[0], ..options };
        let job = StillJob::new(pipelines, scene, options.clone(), Download::default())?;
        Ok(Self {
            pipelines: pipelines.clone(),
            job: match view {
                Some(view) => job.with_samples_of(view),
                None => job,
            },
            scene: scene.clone(),
            options,
            eyes,
            saved: Vec::new(),
            started_secs: None,
        })
    }

    /// Renders without waiting, and downloads each finished file. `None` once it has ended.
    pub fn step(mut self, now_secs: f64) -> (Option<Self>, ExportStatus) {
        let started_secs = *self.started_secs.get_or_insert(now_secs);
        match self.job.step(now_secs) {
            Ok(StillStatus::Working { done, remaining_secs: file_secs }) => {
                let file_count = self.eyes.len() as u32;
                let done = self.saved.len() as f64 + done;
                let pair_secs = remaining_secs(now_secs - started_secs, done, file_count);
                let left_secs = if file_count == 1 { file_secs } else { pair_secs };
                (Some(self), ExportStatus::Working(done / f64::from(file_count), left_secs))
            }
            Ok(StillStatus::Done { .. }) => self.finish_file(),
            Err(error @ ExportError::Gpu(_)) => {
                (Some(self), ExportStatus::Stopped(error.explain()))
            }
            Err(error) => (None, ExportStatus::Failed(error.explain())),
        }
    }

    /// Continues on another device.
    pub fn resume_on(&mut self, pipelines: &Arc<Pipelines>) {
        self.pipelines = pipelines.clone();
        self.job.resume_on(pipelines);
    }

    /// Number of complete files, and of finished tiles of the one after them.
    pub fn progress(&self) -> (u32, u32) {
        (self.saved.len() as u32, self.job.finished_tiles())
    }

    /// Downloads the finished file and starts the next one, if any.
    fn finish_file(mut self) -> (Option<Self>, ExportStatus) {
        let format = self.options.format;
        let suffix = self.options.eye.map_or("", Eye::suffix);
        let file = self.options.sheet_px(&self.scene).and_then(|[width, height]| {
            let name = format!("mandelight-{width}x{height}{suffix}.{}", format.extension());
            Ok((name, self.job.finish()?))
        });
        let saved = file.and_then(|(name, download)| {
            download.finish(&name, format.media_type()).map_err(ExportError::unwritten)?;
            Ok(name)
        });
        match saved {
            Ok(name) => self.saved.push(name),
            Err(error) => return (None, ExportStatus::Failed(error.explain())),
        }
        let Some(&eye) = self.eyes.get(self.saved.len()) else {
            return (None, ExportStatus::Saved(self.saved.join(" and ")));
        };
        self.options.eye = eye;
        let next =
            StillJob::new(&self.pipelines, &self.scene, self.options.clone(), Download::default());
        match next {
            Ok(job) => {
                let done = self.saved.len() as f64 / self.eyes.len() as f64;
                (Some(Self { job, ..self }), ExportStatus::Working(done, None))
            }
            Err(error) => (None, ExportStatus::Failed(error.explain())),
        }
    }
}
