//! A still on its way from the GPU to a download, and how exports of any kind tell of themselves.
//!
//! In: the scene and a size. Out: progress for the interface, and at the end a file, or one for
//! each eye, among the visitor's downloads. It is stepped between frames; dropping it cancels it.

use std::sync::Arc;

use super::files::Download;
use crate::{
    export::{ExportError, Eye, StillJob, StillOptions, StillStatus, sequence::remaining_secs},
    render::Pipelines,
    scene::Scene,
};

/// A still in progress, or a pair of them.
pub struct Still {
    pipelines: Arc<Pipelines>,
    scene: Scene,
    options: StillOptions,
    job: StillJob<Download>,
    /// Whose pictures are wanted, a file each.
    eyes: &'static [Option<Eye>],
    /// The files that are with the visitor.
    saved: Vec<String>,
    started_secs: Option<f64>,
}

/// How an export is getting on.
pub enum Progress {
    /// Part of the work done, 0 to 1, and the seconds to go where they can be told.
    Working(f64, Option<f64>),
    /// The download has begun; the file's name.
    Saved(String),
    /// All is written; the browser is closing the file, and says so itself.
    Closing,
    /// It will not be finished.
    Failed(String),
}

impl Still {
    /// Starts a still of `scene`, or, as a `pair`, one for each eye.
    ///
    /// # Errors
    /// A size or a scene out of range.
    pub fn start(
        pipelines: &Arc<Pipelines>,
        scene: &Scene,
        options: StillOptions,
        pair: bool,
    ) -> Result<Self, ExportError> {
        let eyes: &[_] = if pair { &[Some(Eye::Left), Some(Eye::Right)] } else { &[None] };
        let options = StillOptions { eye: eyes[0], ..options };
        Ok(Self {
            pipelines: pipelines.clone(),
            job: StillJob::new(pipelines, scene, options.clone(), Download::default())?,
            scene: scene.clone(),
            options,
            eyes,
            saved: Vec::new(),
            started_secs: None,
        })
    }

    /// Does what can be done without waiting, and hands each file over once it is whole.
    pub fn step(mut self, now_secs: f64) -> (Option<Self>, Progress) {
        let started_secs = *self.started_secs.get_or_insert(now_secs);
        match self.job.step(now_secs) {
            Ok(StillStatus::Working { done, remaining_secs: of_one }) => {
                let all = self.eyes.len() as u32;
                let done = self.saved.len() as f64 + done;
                let of_all = remaining_secs(now_secs - started_secs, done, all);
                let left = if all == 1 { of_one } else { of_all };
                (Some(self), Progress::Working(done / f64::from(all), left))
            }
            Ok(StillStatus::Done) => self.hand_over(),
            Err(error) => (None, Progress::Failed(error.to_string())),
        }
    }

    /// Hands the file over, and turns to the next one where there is one.
    fn hand_over(mut self) -> (Option<Self>, Progress) {
        let format = self.options.format;
        let suffix = self.options.eye.map_or("", Eye::suffix);
        let file = self.options.sheet_px(&self.scene).and_then(|[width, height]| {
            let name = format!("mandelight-{width}x{height}{suffix}.{}", format.extension());
            Ok((name, self.job.finish()?))
        });
        let saved = file.map_err(|error| error.to_string()).and_then(|(name, download)| {
            download.finish(&name, format.media_type())?;
            Ok(name)
        });
        match saved {
            Ok(name) => self.saved.push(name),
            Err(reason) => return (None, Progress::Failed(reason)),
        }
        let Some(&eye) = self.eyes.get(self.saved.len()) else {
            return (None, Progress::Saved(self.saved.join(" and ")));
        };
        self.options.eye = eye;
        let next =
            StillJob::new(&self.pipelines, &self.scene, self.options.clone(), Download::default());
        match next {
            Ok(job) => {
                let done = self.saved.len() as f64 / self.eyes.len() as f64;
                (Some(Self { job, ..self }), Progress::Working(done, None))
            }
            Err(error) => (None, Progress::Failed(error.to_string())),
        }
    }
}
