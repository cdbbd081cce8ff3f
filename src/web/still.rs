//! A still on its way from the GPU to a download, and how exports of any kind tell of themselves.
//!
//! In: the scene and a size. Out: progress for the interface, and at the end a PNG among the
//! visitor's downloads. It is stepped between frames; dropping it cancels it.

use std::sync::Arc;

use super::files::Download;
use crate::{
    export::{ExportError, PictureFormat, StillJob, StillOptions, StillStatus},
    render::Kernels,
    scene::Scene,
};

/// A still in progress.
pub struct Still {
    job: StillJob<Download>,
    file_name: String,
    format: PictureFormat,
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
    /// Starts a still of `scene`.
    ///
    /// # Errors
    /// A size or a scene out of range.
    pub fn start(
        kernels: &Arc<Kernels>,
        scene: &Scene,
        options: StillOptions,
    ) -> Result<Self, ExportError> {
        let ([width, height], format) = (options.size_px, options.format);
        Ok(Self {
            job: StillJob::new(kernels, scene, options, Download::default())?,
            file_name: format!("mandelight-{width}x{height}.{}", format.extension()),
            format,
        })
    }

    /// Does what can be done without waiting, and hands the file over once it is whole.
    pub fn step(mut self, now_secs: f64) -> (Option<Self>, Progress) {
        match self.job.step(now_secs) {
            Ok(StillStatus::Working { done, remaining_secs }) => {
                (Some(self), Progress::Working(done, remaining_secs))
            }
            Ok(StillStatus::Done) => {
                let Self { job, file_name, format } = self;
                let saved = job
                    .finish()
                    .map_err(|error| error.to_string())
                    .and_then(|download| download.finish(&file_name, format.media_type()));
                (None, saved.map_or_else(Progress::Failed, |()| Progress::Saved(file_name)))
            }
            Err(error) => (None, Progress::Failed(error.to_string())),
        }
    }
}
