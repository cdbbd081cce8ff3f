//! The user interface: panels, input in the view, the status line.
//!
//! In: the renderer's report and the picture's texture. Out: an edited
//! [`Scene`](crate::scene::Scene), the picture's size, whether the view is in motion, and
//! [`Action`]s for the shell. This layer draws with egui only; it accesses no GPU, file or browser.
//!
//! | file | contents |
//! |---|---|
//! | `interface` | one frame: layout, dispatch, undo |
//! | `panel/` | the panels, one per file |
//! | `widgets/` | sliders for the parameter table, the direction ball, the gradient editor |
//! | `view`, `pilot`, `handles` | the picture, the camera's input, handles of point lights |
//! | `field` | the distance field for the camera's movements |
//! | `home` | the target of the Home button |
//! | [`navigation`] | the camera's movements, independent of egui |
//! | [`shortcuts`] | the table of keys, for dispatch and for the help window |
//! | [`editor`] | the edited scene and path, and their history |
//! | `timeline` | the playhead: the time of the path that is in view |
//! | `status`, [`theme`], `icon`, [`rects`] | the status line, style, icons, widget positions |

mod field;
mod handles;
mod home;
mod icon;
mod interface;
mod panel;
mod pilot;
mod status;
mod timeline;
mod view;
mod widgets;

pub mod editor;
pub mod navigation;
pub mod rects;
pub mod shortcuts;
pub mod theme;

pub use interface::Interface;
pub use panel::export::{ExportSize, MAX_EXPORT_SIDE_PX};
pub use panel::{Sections, Settings};
pub use status::zoom;

use crate::render::report::Report;

/// The data of one frame that the interface displays.
#[derive(Clone, Copy, Debug)]
pub struct DisplayInputs<'a> {
    /// The newest picture; none before the first.
    pub picture: Option<ViewTexture>,
    /// The renderer's report.
    pub report: &'a Report,
    /// The export in progress, if any.
    pub export: Option<ExportProgress>,
    /// The shell's message, if any.
    pub notice: Option<&'a Notice>,
    /// The name of the GPU adapter.
    pub adapter: &'a str,
}

/// The rendered picture as an egui texture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ViewTexture {
    /// The texture: sRGB-encoded, opaque.
    pub texture: egui::TextureId,
    /// Width and height in pixels.
    pub size_px: [u32; 2],
}

/// Progress of an export.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExportProgress {
    /// Completed fraction, 0 to 1.
    pub done: f32,
    /// Estimated remaining seconds; none until an estimate is possible.
    pub remaining_secs: Option<f64>,
}

/// A message of the shell to the user, such as "link copied".
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Notice {
    /// The message.
    pub text: String,
    /// True for an error.
    pub is_error: bool,
}

/// A request of the interface to the shell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    /// Render the view at this size and save it as PNG or OpenEXR.
    SavePicture {
        /// Width and height in pixels, each 1 to [`MAX_EXPORT_SIDE_PX`]; in stereo, of one eye's
        /// picture.
        size_px: [u32; 2],
        /// True for OpenEXR, false for PNG.
        exr: bool,
        /// True for one file per eye.
        pair: bool,
    },
    /// Render frames of the camera path and save a zip of PNGs.
    SaveSequence {
        /// Width and height in pixels, each 1 to [`MAX_EXPORT_SIDE_PX`].
        size_px: [u32; 2],
        /// The first frame, and one past the last frame.
        frames: [u32; 2],
        /// True for one file per eye.
        pair: bool,
    },
    /// Cancel the export in progress.
    CancelExport,
    /// Save the scene document.
    SaveScene,
    /// Open a file dialog for a scene document or a picture with its scene.
    LoadScene,
    /// Open a file dialog for an environment map, for [`Interface::use_environment_map`].
    ChoosePicture,
    /// Copy a link to this view.
    CopyLink,
    /// Enter or leave fullscreen.
    ToggleFullscreen,
    /// Close the notice.
    DismissNotice,
}
