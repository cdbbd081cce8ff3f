//! Requests of the interface to the shell, such as saving a picture.

use super::export_size::{SequenceFormat, StillFile};

/// A request of the interface to the shell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    /// Render the view at this size and save it.
    SavePicture {
        /// Width and height in pixels, each 1 to
        /// [`MAX_EXPORT_SIDE_PX`](super::MAX_EXPORT_SIDE_PX); in stereo, of one eye's picture.
        size_px: [u32; 2],
        /// How the picture is stored.
        file: StillFile,
        /// True for one file per eye.
        pair: bool,
    },
    /// Render frames of the camera path and save them as one file.
    SaveSequence {
        /// Width and height in pixels, each 1 to [`MAX_EXPORT_SIDE_PX`](super::MAX_EXPORT_SIDE_PX).
        size_px: [u32; 2],
        /// The first frame, and one past the last frame.
        frames: [u32; 2],
        /// The kind of file.
        format: SequenceFormat,
        /// True for one file per eye.
        pair: bool,
    },
    /// Cancel the export in progress.
    CancelExport,
    /// Cancel the reading of a file.
    CancelReading,
    /// Save the scene document.
    SaveScene,
    /// Open a file dialog for a scene document or a picture with its scene.
    LoadScene,
    /// Open a file dialog for an environment map, for
    /// [`Interface::use_environment_map`](super::Interface::use_environment_map).
    ChooseEnvironmentMap,
    /// Open a file dialog for gradients, for
    /// [`Interface::use_gradients`](super::Interface::use_gradients).
    ChooseGradient,
    /// Copy a link to this view.
    CopyLink,
    /// Keep the view with a small picture, for
    /// [`Interface::keep_favourite`](super::Interface::keep_favourite).
    KeepFavourite,
    /// Tell that a kept view cannot be read.
    ReportUnreadableFavourite,
    /// Open the scene of the gallery's picture of this number, for
    /// [`Interface::fly_into`](super::Interface::fly_into).
    OpenGalleryPicture(usize),
    /// Copy the picture on the screen to the clipboard.
    CopyPicture,
    /// Hand the picture on the screen to the system's share sheet.
    SharePicture,
    /// Enter or leave fullscreen.
    ToggleFullscreen,
    /// Take what the notice offers.
    TakeOffer,
    /// Close the notice.
    DismissNotice,
}
