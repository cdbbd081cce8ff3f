//! A folder of frames that belong together.
//!
//! In: a folder and the fingerprint of a sequence. Out: which frames are there, and where the
//! others go. A file whose name carries the fingerprint binds the folder to its sequence; a
//! folder that is bound to another one is left alone. Nothing in it is ever written over, and
//! nothing is locked: any number of processes, on any machines, may fill one folder.

use std::{
    fs, io,
    io::Write as _,
    path::{Path, PathBuf},
};

use mandelight::{
    export::{Eye, PictureFormat, frame_name},
    scene::{EnvironmentMap, document},
};
use sha2::{Digest as _, Sha256};

use super::{Failure, output::Output, stereo::file_of};

/// What the name of the binding file begins and ends with.
const MARK: (&str, &str) = ("sequence-", ".json");
/// Digits of the fingerprint in a name: 64 bits.
const DIGITS: usize = 16;

/// What decides the frames' pixels.
pub struct Sequence<'a> {
    /// The path.
    pub path: &'a mandelight::scene::Path,
    /// Width and height in pixels.
    pub size_px: [u32; 2],
    /// Samples a pixel in place of the scenes' own.
    pub samples: Option<u32>,
    /// The picture behind, where one is at hand.
    pub environment_map: Option<&'a EnvironmentMap>,
    /// The kind of the files.
    pub format: PictureFormat,
    /// Whose pictures each frame has.
    pub eyes: &'static [Option<Eye>],
}

/// A frame's number, and the eye whose picture of it a file holds, where it is one of a pair.
pub type FrameFile = (u32, Option<Eye>);

impl Sequence<'_> {
    /// A number of everything that the frames depend on, in hexadecimal digits. The document's
    /// layout, and whatever no key takes from it, have no part in it.
    fn fingerprint(&self) -> String {
        let mut hash = Sha256::new();
        let line = |hash: &mut Sha256, text: String| hash.update(text + "\n");
        let (version, format, eyes) = (env!("CARGO_PKG_VERSION"), self.format, self.eyes);
        line(&mut hash, format!("{version} {format:?} {eyes:?}"));
        line(
            &mut hash,
            format!("{:?} {:?} {}", self.size_px, self.samples, self.path.frames_per_second),
        );
        for key in &self.path.keys {
            let scene = document::to_json_compact(&key.scene);
            line(&mut hash, format!("{:?} {:?} {scene}", key.time_secs, key.easing));
        }
        for pixel in
            self.environment_map.iter().flat_map(|environment_map| environment_map.pixels())
        {
            pixel.to_array().iter().for_each(|channel| hash.update(channel.to_le_bytes()));
        }
        let digits: String = hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect();
        digits[..DIGITS].to_owned()
    }

    /// What the binding file says to people.
    fn text(&self) -> String {
        let facts = serde_json::json!({
            "mandelight": "sequence",
            "program": env!("CARGO_PKG_VERSION"),
            "size_px": self.size_px,
            "pair": self.eyes.len() > 1,
            "samples": self.samples,
            "frames_per_second": self.path.frames_per_second,
            "frames": self.path.frame_count(),
            "keys": self.path.keys.len(),
        });
        format!("{facts:#}\n")
    }
}

/// The folder of one sequence.
pub struct Folder {
    path: PathBuf,
    ending: &'static str,
}

impl Folder {
    /// Makes the folder where there is none, and binds it to `sequence` where it isn't yet.
    ///
    /// # Errors
    /// A folder of another sequence, frames that belong to nobody knows which, or a folder that
    /// cannot be read or written.
    pub fn open(path: &Path, sequence: &Sequence<'_>) -> Result<Self, Failure> {
        let shown = path.display();
        let failed = |error: io::Error| Failure::failed(format!("{shown}: {error}"));
        fs::create_dir_all(path).map_err(failed)?;
        let mark = format!("{}{}{}", MARK.0, sequence.fingerprint(), MARK.1);
        let names = names_in(path).map_err(failed)?;
        if let Some(other) = names.iter().find(|name| is_mark(name) && **name != mark) {
            return Err(other_sequence(path, other));
        }
        if !names.contains(&mark) {
            if let Some(frame) = names.iter().find(|name| is_frame(name)) {
                return Err(Failure::usage(format!(
                    "{shown} has {frame}, but not the file that says which sequence it belongs to; choose an empty folder"
                )));
            }
            let mut output = Output::create(&path.join(&mark)).map_err(failed)?;
            output
                .write_all(sequence.text().as_bytes())
                .and_then(|()| output.commit())
                .map_err(failed)?;
            // Another sequence may have come at the same moment; then neither has the folder.
            let names = names_in(path).map_err(failed)?;
            if let Some(other) = names.iter().find(|name| is_mark(name) && **name != mark) {
                return Err(other_sequence(path, other));
            }
        }
        let ending = match sequence.format {
            PictureFormat::Png => "png",
            PictureFormat::Exr => "exr",
        };
        Ok(Self { path: path.to_owned(), ending })
    }

    /// Where a frame is, or goes.
    pub fn file(&self, (frame, eye): FrameFile) -> PathBuf {
        let name = Path::new(&frame_name(frame)).with_extension(self.ending);
        self.path.join(file_of(&name, eye))
    }

    /// Whether a frame is there; it then is whole.
    pub fn has(&self, file: FrameFile) -> bool {
        self.file(file).exists()
    }
}

fn other_sequence(path: &Path, mark: &str) -> Failure {
    let shown = path.display();
    Failure::usage(format!(
        "{shown} holds frames of another scene, size, number of samples, kind or layout ({mark}); choose another folder, or empty this one"
    ))
}

fn names_in(folder: &Path) -> io::Result<Vec<String>> {
    let entries = fs::read_dir(folder)?;
    entries.map(|entry| Ok(entry?.file_name().to_string_lossy().into_owned())).collect()
}

fn is_mark(name: &str) -> bool {
    name.strip_prefix(MARK.0)
        .and_then(|rest| rest.strip_suffix(MARK.1))
        .is_some_and(|digits| digits.len() == DIGITS)
}

fn is_frame(name: &str) -> bool {
    name.starts_with("frame_") && (name.ends_with(".png") || name.ends_with(".exr"))
}
