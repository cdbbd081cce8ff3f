//! The file of a sequence: a zip of pictures or a video, on the visitor's disk or as a download.
//!
//! In: the visitor's choice of a place, then the pictures. Out: the file. The visitor is asked first,
//! because browsers open a save dialogue only shortly after a click.

use std::{
    cell::RefCell,
    io::{self, Write},
    rc::Rc,
};

use wasm_bindgen_futures::spawn_local;

use super::{
    file_access::{self, ChooseError, ChosenFile, DiskFile},
    files::Download,
    mailbox::Mailbox,
    still_export::ExportStatus,
    video::Video,
};
use crate::{
    export::{Archive, ExportError, FrameSink, PictureFormat},
    ui::SequenceFormat,
};

/// The wanted file of a sequence.
#[derive(Clone, Copy)]
pub struct SequenceKind {
    /// What the file is.
    pub format: SequenceFormat,
    /// Width and height of the pictures, in pixels.
    pub size_px: [u32; 2],
    /// Frames per second of a video.
    pub frames_per_second: u32,
}

impl SequenceKind {
    /// The format of the pictures.
    pub fn picture_format(&self) -> PictureFormat {
        match self.format {
            SequenceFormat::Mp4 | SequenceFormat::WebM => PictureFormat::Rgb,
            SequenceFormat::Pngs => PictureFormat::Png,
        }
    }

    fn name(&self) -> String {
        let [width, height] = self.size_px;
        format!("mandelight-{width}x{height}.{}", self.format.extension())
    }

    /// Asks the visitor for a place on the disk; `None` for a download.
    async fn choose(&self) -> Result<Option<ChosenFile>, ChooseError> {
        if !file_access::is_supported() {
            return Ok(None);
        }
        let extension = format!(".{}", self.format.extension());
        match ChosenFile::choose(&self.name(), self.format.media_type(), &extension).await {
            Err(ChooseError::Refused(reason)) => {
                log::warn!("no file on the disk, so there will be a download: {reason}");
                Ok(None)
            }
            chosen => chosen.map(Some),
        }
    }

    async fn open(&self, file: Option<ChosenFile>, mailbox: &Mailbox) -> Result<Frames, String> {
        let container = match self.format {
            SequenceFormat::Mp4 => "mp4",
            SequenceFormat::WebM => "webm",
            SequenceFormat::Pngs => {
                let disk_file = file.map(DiskFile::new);
                let writer = match disk_file.clone() {
                    Some(file) => ZipWriter::Disk(file),
                    None => ZipWriter::Download(Download::default()),
                };
                return Ok(Frames::Zip(Box::new(Archive::new(writer)), disk_file));
            }
        };
        let rate = self.frames_per_second;
        Video::open(container, self.size_px, rate, file, mailbox).await.map(Frames::Video)
    }
}

/// A request to the visitor: where to save the sequence.
pub struct FileRequest(Rc<RefCell<FileChoice>>);

/// The answer to a [`FileRequest`].
#[derive(Default)]
pub enum FileChoice {
    /// The dialogue is still open.
    #[default]
    Pending,
    /// The visitor closed the dialogue without a choice.
    Cancelled,
    /// There can be no such file, with the reason.
    Failed(String),
    /// The file to write.
    Chosen(SequenceFile),
}

impl FileRequest {
    /// Opens the browser's save dialogue, if it has one; the answer requests a repaint.
    pub fn new(kind: SequenceKind, mailbox: &Mailbox) -> Self {
        let choice = Rc::new(RefCell::new(FileChoice::Pending));
        let (answer, mailbox) = (choice.clone(), mailbox.clone());
        spawn_local(async move {
            let chosen = match kind.choose().await {
                Ok(file) => kind.open(file, &mailbox).await.map(Some),
                Err(_) => Ok(None),
            };
            *answer.borrow_mut() = match chosen {
                Ok(Some(frames)) => FileChoice::Chosen(SequenceFile {
                    name: kind.name(),
                    frames,
                    mailbox: mailbox.clone(),
                }),
                Ok(None) => FileChoice::Cancelled,
                Err(reason) => FileChoice::Failed(reason),
            };
            mailbox.wake();
        });
        Self(choice)
    }

    /// Takes the answer; leaves [`FileChoice::Pending`].
    pub fn take_choice(&self) -> FileChoice {
        self.0.take()
    }
}

/// The file of a sequence that is being written. Dropping it unfinished deletes it.
pub struct SequenceFile {
    name: String,
    frames: Frames,
    mailbox: Mailbox,
}

enum Frames {
    /// A zip, and its file on the disk unless it is a download.
    Zip(Box<Archive<ZipWriter>>, Option<DiskFile>),
    Video(Video),
}

/// The bytes of a zip.
enum ZipWriter {
    Disk(DiskFile),
    Download(Download),
}

/// Tells whether a [`SequenceFile`] can take more, while a job owns the file.
pub enum Backlog {
    /// It always can.
    None,
    /// It can unless the disk is behind.
    Disk(DiskFile),
    /// It can unless the encoder is behind.
    Video(Video),
}

impl Backlog {
    /// Whether to wait before the next picture.
    pub fn is_full(&self) -> bool {
        match self {
            Self::None => false,
            Self::Disk(file) => file.is_backlogged(),
            Self::Video(video) => video.is_busy(),
        }
    }
}

impl SequenceFile {
    /// The file's backlog.
    pub fn backlog(&self) -> Backlog {
        match &self.frames {
            Frames::Zip(_, Some(file)) => Backlog::Disk(file.clone()),
            Frames::Zip(_, None) => Backlog::None,
            Frames::Video(video) => Backlog::Video(video.clone()),
        }
    }

    /// Ends the file.
    pub fn finish(self) -> ExportStatus {
        let Self { name, frames, mailbox } = self;
        let archive = match frames {
            Frames::Zip(archive, _) => archive,
            Frames::Video(video) => {
                video.finish(name);
                return ExportStatus::Closing;
            }
        };
        match archive.finish() {
            Ok(ZipWriter::Disk(file)) => {
                file.finish(name, &mailbox);
                ExportStatus::Closing
            }
            Ok(ZipWriter::Download(download)) => {
                match download.finish(&name, SequenceFormat::Pngs.media_type()) {
                    Ok(()) => ExportStatus::Saved(name),
                    Err(reason) => ExportStatus::Failed(ExportError::unwritten(reason).explain()),
                }
            }
            Err(error) => ExportStatus::Failed(error.explain()),
        }
    }
}

impl FrameSink for SequenceFile {
    fn add(&mut self, name: &str, picture: Vec<u8>) -> Result<(), ExportError> {
        match &mut self.frames {
            Frames::Zip(archive, _) => archive.add(name, &picture),
            Frames::Video(video) => video.add(name, picture),
        }
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
