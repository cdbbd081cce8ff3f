//! A folder of frames that is bound to one sequence.
//!
//! In: a folder and the settings of a sequence. Out: the paths of frames, and whether they exist.
//! A binding file, whose name contains the sequence's fingerprint, binds the folder to its
//! sequence. A folder bound to another sequence is rejected. Only damaged frames are overwritten, and no frame
//! is locked, so any number of processes, on any machines, may fill one folder.

use std::{
    fs, io,
    io::Write as _,
    path::{Path, PathBuf},
    sync::{Arc, atomic::AtomicBool},
};

use mandelight::{
    export::{Eye, PictureFormat, frame_name},
    reading::visible,
    scene::{EnvironmentMap, document},
};
use sha2::{Digest as _, Sha256};

use super::{
    Failure,
    output::{Output, remove_stale_once},
    shown,
    stereo::file_of,
};

/// Prefix and suffix of the binding file's name.
const BINDING_NAME: (&str, &str) = ("sequence-", ".json");
/// Number of hexadecimal digits of a fingerprint in a name: 64 bits.
const FINGERPRINT_DIGITS: usize = 16;

/// Everything that the pixels of a sequence's frames depend on.
pub struct SequenceSettings<'a> {
    /// The camera path.
    pub path: &'a mandelight::scene::Path,
    /// Width and height in pixels.
    pub size_px: [u32; 2],
    /// Samples per pixel; none for the scenes' numbers.
    pub samples: Option<u32>,
    /// The loaded environment map, if any.
    pub environment_map: Option<&'a EnvironmentMap>,
    /// The file format.
    pub format: PictureFormat,
    /// Quality of JPEGs, 1 to 100.
    pub quality: u8,
    /// True for 16 bits per channel.
    pub is_deep: bool,
    /// True for a transparent background.
    pub is_transparent: bool,
    /// The eye of each file of a frame.
    pub eyes: &'static [Option<Eye>],
    /// As [`StillOptions::denoise`](mandelight::export::StillOptions::denoise).
    pub denoise: Option<bool>,
}

/// A file of a sequence: the frame's number, and the eye for one file of a stereo pair.
pub type FrameFile = (u32, Option<Eye>);

impl SequenceSettings<'_> {
    /// A hash of everything that the frames depend on, in hexadecimal digits.
    ///
    /// The document's formatting, and the scene beside the path, do not affect the hash.
    fn fingerprint(&self) -> String {
        let mut hash = Sha256::new();
        let line = |hash: &mut Sha256, text: String| hash.update(text + "\n");
        let (version, format, eyes) = (env!("CARGO_PKG_VERSION"), self.format, self.eyes);
        line(&mut hash, format!("{version} {format:?} {eyes:?} {:?}", self.denoise));
        if format == PictureFormat::Jpeg {
            line(&mut hash, format!("quality {}", self.quality));
        }
        if self.is_deep {
            line(&mut hash, "16 bits".to_owned());
        }
        if self.is_transparent {
            line(&mut hash, "transparent".to_owned());
        }
        line(
            &mut hash,
            format!(
                "{:?} {:?} {} {:?}",
                self.size_px, self.samples, self.path.frames_per_second, self.path.shutter
            ),
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
        digits[..FINGERPRINT_DIGITS].to_owned()
    }

    /// The content of the binding file, for people.
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
    extension: &'static str,
}

impl Folder {
    /// Creates the folder and binds it to `sequence`, if necessary.
    ///
    /// # Errors
    /// A folder of another sequence, frames without a binding file, or a folder that cannot be
    /// read or written.
    pub fn open(
        path: &Path,
        sequence: &SequenceSettings<'_>,
        interrupted: &Arc<AtomicBool>,
    ) -> Result<Self, Failure> {
        let shown = shown(path);
        let failed = |error: io::Error| Failure::failed(format!("{shown}: {error}"));
        fs::create_dir_all(path).map_err(failed)?;
        let binding = format!("{}{}{}", BINDING_NAME.0, sequence.fingerprint(), BINDING_NAME.1);
        let names = names_in(path).map_err(failed)?;
        if let Some(other) = names.iter().find(|name| is_binding_name(name) && **name != binding) {
            return Err(other_sequence(path, other));
        }
        if !names.contains(&binding) {
            if let Some(frame) = names.iter().find(|name| is_frame(name)) {
                return Err(Failure::usage(format!(
                    "{shown} contains {}, but no file that names its sequence; choose an empty folder",
                    visible(frame)
                )));
            }
            let mut output = Output::create(&path.join(&binding), interrupted).map_err(failed)?;
            output
                .write_all(sequence.text().as_bytes())
                .and_then(|()| output.commit())
                .map_err(failed)?;
            // A process with another sequence may have bound the folder at the same time; then
            // both processes fail here.
            let names = names_in(path).map_err(failed)?;
            if let Some(other) =
                names.iter().find(|name| is_binding_name(name) && **name != binding)
            {
                return Err(other_sequence(path, other));
            }
        }
        // If all frames exist, no file is created, so that nothing else removes stale ones.
        remove_stale_once(path);
        Ok(Self { path: path.to_owned(), extension: sequence.format.extension() })
    }

    /// The path of a frame's file.
    pub fn file(&self, (frame, eye): FrameFile) -> PathBuf {
        let name = Path::new(&frame_name(frame)).with_extension(self.extension);
        self.path.join(file_of(&name, eye))
    }
}

fn other_sequence(path: &Path, binding: &str) -> Failure {
    let (shown, binding) = (shown(path), visible(binding));
    Failure::usage(format!(
        "{shown} contains frames of another scene, size, number of samples, file format or stereo layout ({binding}); choose another folder, or empty this one"
    ))
}

fn names_in(folder: &Path) -> io::Result<Vec<String>> {
    let entries = fs::read_dir(folder)?;
    entries.map(|entry| Ok(entry?.file_name().to_string_lossy().into_owned())).collect()
}

fn is_binding_name(name: &str) -> bool {
    name.strip_prefix(BINDING_NAME.0)
        .and_then(|rest| rest.strip_suffix(BINDING_NAME.1))
        .is_some_and(|digits| digits.len() == FINGERPRINT_DIGITS)
}

fn is_frame(name: &str) -> bool {
    let extension = name.strip_prefix("frame_").and_then(|rest| rest.rsplit_once('.'));
    extension.is_some_and(|(_, extension)| ["png", "jpg", "webp", "exr"].contains(&extension))
}
