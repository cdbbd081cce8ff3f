//! The frames of a path on their way from the GPU to a zip on the visitor's disk.
//!
//! In: a path, a size, a range of frames. Out: progress for the interface, and one zip: written
//! while it is made where the browser can, else among the downloads. It is stepped between
//! frames; dropping it cancels it.

use std::{
    io::{self, Write},
    ops::Range,
    sync::Arc,
};

use wasm_bindgen_futures::spawn_local;

use super::{
    file_access::{self, DiskFile, NoFile},
    files::Download,
    mailbox::{Mailbox, Message},
    still::Progress,
};
use crate::{
    export::{ExportError, SequenceJob, StillOptions, StillStatus},
    render::Pipelines,
    scene::Path,
};

const MIME: &str = "application/zip";

/// Where the zip goes.
pub struct Sink {
    name: String,
    goal: Goal,
}

#[derive(Clone)]
enum Goal {
    Disk(DiskFile),
    Download,
}

impl Sink {
    /// Asks for a file where the browser writes while it goes, and posts where the zip goes.
    pub fn choose(name: String, mailbox: &Mailbox) {
        let mailbox = mailbox.clone();
        if !file_access::is_there() {
            mailbox.post(Message::Sink(Some(Self { name, goal: Goal::Download })));
            return;
        }
        spawn_local(async move {
            let goal = match DiskFile::choose(&name, MIME, ".zip").await {
                Ok(file) => Some(Goal::Disk(file)),
                Err(NoFile::NotChosen) => None,
                Err(NoFile::Refused(reason)) => {
                    log::warn!("the zip goes to the downloads: {reason}");
                    Some(Goal::Download)
                }
            };
            mailbox.post(Message::Sink(goal.map(|goal| Self { name, goal })));
        });
    }
}

/// What the zip is written to.
enum Writer {
    Disk(DiskFile),
    Download(Download),
}

impl Write for Writer {
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

/// A sequence in progress.
pub struct Sequence {
    job: SequenceJob<Writer>,
    sink: Sink,
    mailbox: Mailbox,
    last: (f64, Option<f64>),
}

impl Sequence {
    /// Starts the sequence of `frames`; the options say how each is made, and whether in pairs.
    ///
    /// # Errors
    /// A size, a range or a path out of range.
    pub fn start(
        pipelines: &Arc<Pipelines>,
        path: Path,
        frames: Range<u32>,
        (options, pair): (StillOptions, bool),
        sink: Sink,
        mailbox: &Mailbox,
    ) -> Result<Self, ExportError> {
        let writer = match &sink.goal {
            Goal::Disk(file) => Writer::Disk(file.clone()),
            Goal::Download => Writer::Download(Download::default()),
        };
        let job = SequenceJob::new(pipelines, path, frames, options, pair, writer)?;
        Ok(Self { job, sink, mailbox: mailbox.clone(), last: (0.0, None) })
    }

    /// Does what can be done without waiting, and hands the zip over once it is whole.
    pub fn step(mut self, now_secs: f64) -> (Option<Self>, Progress) {
        if let Goal::Disk(file) = &self.sink.goal
            && file.is_behind()
        {
            let (done, remaining_secs) = self.last;
            return (Some(self), Progress::Working(done, remaining_secs));
        }
        match self.job.step(now_secs) {
            Ok(StillStatus::Working { done, remaining_secs }) => {
                self.last = (done, remaining_secs);
                (Some(self), Progress::Working(done, remaining_secs))
            }
            Ok(StillStatus::Done) => (None, self.finish()),
            Err(error) => (None, Progress::Failed(error.to_string())),
        }
    }

    fn finish(self) -> Progress {
        let Self { job, sink, mailbox, .. } = self;
        match job.finish() {
            Ok(Writer::Disk(file)) => {
                file.finish(sink.name, &mailbox);
                Progress::Closing
            }
            Ok(Writer::Download(download)) => match download.finish(&sink.name, MIME) {
                Ok(()) => Progress::Saved(sink.name),
                Err(reason) => Progress::Failed(reason),
            },
            Err(error) => Progress::Failed(error.to_string()),
        }
    }
}
