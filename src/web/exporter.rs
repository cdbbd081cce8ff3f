//! The export in progress: its start, its steps, its progress and its notices.
//!
//! In: sizes and frames to export, of the session's scene. Out: files, progress for the interface,
//! notices. Runs one export at a time, which goes on with another device after the GPU was lost.

use std::{ops::Range, sync::Arc};

use super::{
    sequence_export::SequenceExport,
    sequence_file::{FileChoice, FileRequest, SequenceKind},
    session::Session,
    still_export::{ExportStatus, StillExport},
    video,
};
use crate::{
    export::{PictureFormat, StillOptions},
    render::{Pipelines, View},
    scene::Project,
    ui::{ExportProgress, SequenceFormat, StillFile, StillFormat},
};

/// Seconds that a failed export waits for the report that the GPU was lost.
const LOSS_SECS: f64 = 5.0;

/// Runs exports on one device.
pub struct Exporter {
    pipelines: Arc<Pipelines>,
    export: Option<Export>,
    /// Why and when the GPU failed the export in progress.
    stopped: Option<(String, f64)>,
    /// The export's progress at the last loss of the GPU.
    progress_at_loss: Option<(u32, u32)>,
    progress: Option<ExportProgress>,
    /// The sequence whose file the visitor has yet to choose.
    requested_sequence: Option<RequestedSequence>,
}

/// An export of any kind.
enum Export {
    Still(Box<StillExport>),
    Sequence(Box<SequenceExport>),
}

/// A sequence that starts once the visitor has chosen its file.
struct RequestedSequence {
    options: StillOptions,
    frames: Range<u32>,
    /// Whether each frame is a file for each eye.
    pair: bool,
    file: FileRequest,
}

impl Exporter {
    /// An exporter without an export.
    pub fn new(pipelines: Arc<Pipelines>) -> Self {
        Self {
            pipelines,
            export: None,
            stopped: None,
            progress_at_loss: None,
            progress: None,
            requested_sequence: None,
        }
    }

    /// An exporter on the same device, without an export.
    pub fn idle(&self) -> Self {
        Self::new(self.pipelines.clone())
    }

    /// Continues on another device, from the last finished tile.
    ///
    /// Drops an export that has finished no tile since the last loss: it may be what lost the GPU.
    pub fn resume_on(&mut self, pipelines: &Arc<Pipelines>, session: &mut Session) {
        self.pipelines = pipelines.clone();
        self.stopped = None;
        let Some(export) = &mut self.export else { return };
        let progress = Some(export.progress());
        if self.progress_at_loss == progress {
            self.cancel();
            return session.show_error(
                "The graphics card stopped again, which cancelled saving. Save again in a smaller size.",
            );
        }
        self.progress_at_loss = progress;
        export.resume_on(pipelines);
        let text =
            "The graphics card stopped and was started again. Saving goes on where it stopped.";
        let texts: Vec<&str> = [text].into_iter().chain(session.pause_text()).collect();
        session.show_error(texts.join("\n"));
    }

    /// Whether an export is in progress.
    pub fn is_busy(&self) -> bool {
        self.export.is_some()
    }

    /// The progress of the export, for the interface.
    pub fn progress(&self) -> Option<ExportProgress> {
        self.progress
    }

    /// Starts to export the scene in view; with `pair`, each eye is a file.
    ///
    /// `view`: the view on the screen, whose samples are taken if they are those of the picture.
    pub fn start_still(
        &mut self,
        size_px: [u32; 2],
        (file, pair): (StillFile, bool),
        view: Option<&View>,
        session: &mut Session,
    ) {
        let environment_map = session.interface.environment_map().cloned();
        let options = StillOptions {
            environment_map,
            format: picture_format(file),
            quality: file.quality,
            is_deep: file.is_deep(),
            is_transparent: file.is_transparent(),
            ..StillOptions::new(size_px)
        };
        let scene = session.interface.scene();
        match StillExport::start(&self.pipelines, scene, options, pair, view) {
            Ok(still) => self.begin(Export::Still(Box::new(still))),
            Err(error) => session.show_error(error.explain()),
        }
    }

    /// Requests a file for `frames` of the path; [`Self::start_requested_sequence`] uses the answer.
    pub fn request_sequence(
        &mut self,
        size_px: [u32; 2],
        frames: Range<u32>,
        (format, pair): (SequenceFormat, bool),
        session: &mut Session,
    ) {
        let Project { scene, path } = session.interface.project();
        let environment_map = session.interface.environment_map().cloned();
        let options = StillOptions { environment_map, ..StillOptions::new(size_px) };
        // Both eyes' pictures of a frame may be side by side.
        let size_px = match options.sheet_px(scene) {
            Ok(size_px) => size_px,
            Err(error) => {
                return session.show_error(error.explain());
            }
        };
        let frames_per_second = path.frames_per_second;
        let kind = SequenceKind { format, size_px, frames_per_second };
        let options = StillOptions { format: kind.picture_format(), ..options };
        let file = FileRequest::new(kind, &session.mailbox);
        self.requested_sequence = Some(RequestedSequence { options, frames, pair, file });
    }

    /// Starts the requested sequence once its file is chosen.
    pub fn start_requested_sequence(&mut self, session: &mut Session) {
        let Some(requested) = self.requested_sequence.take() else { return };
        let file = match requested.file.take_choice() {
            FileChoice::Pending => {
                self.requested_sequence = Some(requested);
                return;
            }
            FileChoice::Cancelled => return,
            FileChoice::Failed(reason) => {
                return session.show_error(format!(
                    "The browser could not start this video. Choose a smaller size, or PNGs beside Save, which every browser can write. ({reason})"
                ));
            }
            FileChoice::Chosen(file) => file,
        };
        let path = session.interface.project().path.clone();
        match SequenceExport::start(
            &self.pipelines,
            path,
            requested.frames,
            (requested.options, requested.pair),
            file,
        ) {
            Ok(sequence) => self.begin(Export::Sequence(Box::new(sequence))),
            Err(error) => session.show_error(error.explain()),
        }
    }

    fn begin(&mut self, export: Export) {
        self.export = Some(export);
        (self.stopped, self.progress_at_loss) = (None, None);
        self.progress = Some(ExportProgress { done: 0.0, remaining_secs: None });
    }

    /// Drops the export in progress.
    pub fn cancel(&mut self) {
        self.export = None;
        self.stopped = None;
        self.progress = None;
    }

    /// Advances the export without waiting, and shows a notice when it ends.
    pub fn step(&mut self, session: &mut Session, now_secs: f64) {
        if let Some((reason, since_secs)) = &self.stopped {
            if now_secs - since_secs > LOSS_SECS {
                session.show_error(reason.as_str());
                self.cancel();
            }
            return;
        }
        let Some(export) = self.export.take() else { return };
        let (export, status) = export.step(now_secs);
        self.export = export;
        self.progress = match status {
            ExportStatus::Working(done, remaining_secs) => {
                Some(ExportProgress { done: done as f32, remaining_secs })
            }
            ExportStatus::Saved(name) => {
                session.show_notice(format!("Saved {name}."));
                None
            }
            ExportStatus::Closing => None,
            ExportStatus::Stopped(reason) => {
                self.stopped = Some((reason, now_secs));
                self.progress
            }
            ExportStatus::Failed(reason) => {
                session.show_error(reason);
                None
            }
            ExportStatus::VideoFailed(reason) => {
                session.show_error(video::failure(&reason));
                None
            }
        };
    }
}

/// The format of a saved picture.
pub fn picture_format(file: StillFile) -> PictureFormat {
    match file.format {
        StillFormat::Png => PictureFormat::Png,
        StillFormat::Jpeg => PictureFormat::Jpeg,
        StillFormat::WebP => PictureFormat::WebP,
        StillFormat::Exr => PictureFormat::Exr,
    }
}

impl Export {
    fn resume_on(&mut self, pipelines: &Arc<Pipelines>) {
        match self {
            Self::Still(still) => still.resume_on(pipelines),
            Self::Sequence(sequence) => sequence.resume_on(pipelines),
        }
    }

    fn progress(&self) -> (u32, u32) {
        match self {
            Self::Still(still) => still.progress(),
            Self::Sequence(sequence) => sequence.progress(),
        }
    }

    /// Advances the export without waiting; `None` once it has ended.
    fn step(self, now_secs: f64) -> (Option<Self>, ExportStatus) {
        match self {
            Self::Still(still) => {
                let (still, status) = still.step(now_secs);
                (still.map(|still| Self::Still(Box::new(still))), status)
            }
            Self::Sequence(sequence) => {
                let (sequence, status) = sequence.step(now_secs);
                (sequence.map(|sequence| Self::Sequence(Box::new(sequence))), status)
            }
        }
    }
}
