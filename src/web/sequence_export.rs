//! An export of a path's frames: rendered one by one into a zip on the visitor's disk.
//!
//! In: a path, a size, a range of frames. Out: an [`ExportStatus`] a step, and one zip: written to
//! the disk frame by frame where the browser can, else a download. The engine steps the export
//! between frames; dropping it cancels it.

use std::{
    cell::RefCell,
    io::{self, Write},
    ops::Range,
    rc::Rc,
    sync::Arc,
};

use wasm_bindgen_futures::spawn_local;

use super::{
    file_access::{self, ChooseError, DiskFile},
    files::Download,
    mailbox::Mailbox,
    still_export::ExportStatus,
};
use crate::{
    export::{ExportError, SequenceJob, StillOptions, StillStatus},
    render::Pipelines,
    scene::Path,
};

const MIME: &str = "application/zip";

/// A request to the visitor: where to save the zip.
pub struct ZipRequest(Rc<RefCell<ZipChoice>>);

/// The visitor's answer to a [`ZipRequest`].
#[derive(Default)]
pub enum ZipChoice {
    /// The dialogue is still open.
    #[default]
    Pending,
    /// The visitor closed the dialogue without a choice.
    Cancelled,
    /// The zip to write to.
    Chosen(Zip),
}

/// An empty zip with its name.
pub struct Zip {
    name: String,
    writer: ZipWriter,
}

/// The bytes of a zip.
enum ZipWriter {
    Disk(DiskFile),
    Download(Download),
}

impl ZipRequest {
    /// Opens the browser's save dialogue; its answer requests a repaint. A browser without one answers
    /// at once, with a download.
    pub fn new(name: String, mailbox: &Mailbox) -> Self {
        let download = |name| {
            ZipChoice::Chosen(Zip { name, writer: ZipWriter::Download(Download::default()) })
        };
        if !file_access::is_supported() {
            return Self(Rc::new(RefCell::new(download(name))));
        }
        let choice = Rc::new(RefCell::new(ZipChoice::Pending));
        let (answer, mailbox) = (choice.clone(), mailbox.clone());
        spawn_local(async move {
            *answer.borrow_mut() = match DiskFile::choose(&name, MIME, ".zip").await {
                Ok(file) => ZipChoice::Chosen(Zip { name, writer: ZipWriter::Disk(file) }),
                Err(ChooseError::Cancelled) => ZipChoice::Cancelled,
                Err(ChooseError::Refused(reason)) => {
                    log::warn!("no file on the disk, so the zip becomes a download: {reason}");
                    download(name)
                }
            };
            mailbox.wake();
        });
        Self(choice)
    }

    /// Takes the answer; leaves [`ZipChoice::Pending`].
    pub fn take_choice(&self) -> ZipChoice {
        self.0.take()
    }
}

impl Write for ZipWriter {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match self {
            Self::Disk(file) => file.write(bytes),
            Self::Download(download) => download.write(bytes),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match self {
            Self::Disk(file) => file.flush(),
            Self::Download(download) => download.flush(),
        }
    }
}

/// The export of a sequence of frames.
pub struct SequenceExport {
    job: SequenceJob<ZipWriter>,
    name: String,
    /// The file on the disk, which can be backlogged; `None` for a download.
    disk_file: Option<DiskFile>,
    mailbox: Mailbox,
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
        Zip { name, writer }: Zip,
        mailbox: &Mailbox,
    ) -> Result<Self, ExportError> {
        let disk_file = match &writer {
            ZipWriter::Disk(file) => Some(file.clone()),
            ZipWriter::Download(_) => None,
        };
        let job = SequenceJob::new(pipelines, path, frames, options, pair, writer)?;
        Ok(Self { job, name, disk_file, mailbox: mailbox.clone(), progress: (0.0, None) })
    }

    /// Renders without waiting, and saves the complete zip. `None` once it has ended.
    pub fn step(mut self, now_secs: f64) -> (Option<Self>, ExportStatus) {
        if self.disk_file.as_ref().is_some_and(DiskFile::is_backlogged) {
            let (done, remaining_secs) = self.progress;
            return (Some(self), ExportStatus::Working(done, remaining_secs));
        }
        match self.job.step(now_secs) {
            Ok(StillStatus::Working { done, remaining_secs }) => {
                self.progress = (done, remaining_secs);
                (Some(self), ExportStatus::Working(done, remaining_secs))
            }
            Ok(StillStatus::Done { .. }) => (None, self.finish()),
            Err(error) => (None, ExportStatus::Failed(error.to_string())),
        }
    }

    fn finish(self) -> ExportStatus {
        let Self { job, name, mailbox, .. } = self;
        match job.finish() {
            Ok(ZipWriter::Disk(file)) => {
                file.finish(name, &mailbox);
                ExportStatus::Closing
            }
            Ok(ZipWriter::Download(download)) => match download.finish(&name, MIME) {
                Ok(()) => ExportStatus::Saved(name),
                Err(reason) => ExportStatus::Failed(reason),
            },
            Err(error) => ExportStatus::Failed(error.to_string()),
        }
    }
}
