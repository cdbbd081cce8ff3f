//! The interface: panels, the view's pointer and keys, the status line.
//!
//! In: what the renderer reports and the picture's texture. Out: an edited [`Scene`], the size
//! the picture should have, whether it is in motion, and [`Action`]s for the shell to perform.
//! This layer draws with egui alone: it touches no GPU, no file, no browser.
//!
//! | file | what lives there |
//! |---|---|
//! | `interface` | one frame: layout, dispatch, undo |
//! | `panel/` | the panels, one a file |
//! | `widgets/` | sliders of the parameter table, the light ball, the gradient |
//! | `view`, `pilot`, `handles` | the picture, what moves its camera, its point lights |
//! | `field` | the distance field that the camera moves in |
//! | `home` | where Home leads |
//! | [`navigation`] | the camera's movements themselves, free of egui |
//! | [`shortcuts`] | the one table of keys, dispatched and listed in help |
//! | [`editor`] | the scene and the path under edit, and their history |
//! | `timeline` | the playhead: which moment of the path is in view |
//! | `status`, [`theme`], `icon`, [`rects`] | the status line, the look, drawn icons, widgets' places |

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

/// What the interface shows of the rest of the program, each frame.
#[derive(Clone, Copy, Debug)]
pub struct Inputs<'a> {
    /// The newest picture; none before the first.
    pub picture: Option<Picture>,
    /// What the renderer says of itself.
    pub report: &'a Report,
    /// The export in progress; none where there is none.
    pub export: Option<ExportProgress>,
    /// What the shell has to say; none where there is nothing.
    pub notice: Option<&'a Notice>,
    /// The name of the device that draws.
    pub adapter: &'a str,
}

/// A picture as egui can draw it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Picture {
    /// Its texture: sRGB-encoded, opaque.
    pub texture: egui::TextureId,
    /// Its width and height in pixels.
    pub size_px: [u32; 2],
}

/// How far an export is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExportProgress {
    /// The part done, 0 to 1.
    pub done: f32,
    /// Estimated seconds left; none while there is no telling.
    pub remaining_secs: Option<f64>,
}

/// A line from the shell: a file that could not be read, a link that was copied.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Notice {
    /// The line.
    pub text: String,
    /// Whether something failed.
    pub is_error: bool,
}

/// What the interface asks the shell to do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    /// Render the view at this size and hand it out as a PNG or an OpenEXR file.
    SavePicture {
        /// Width and height in pixels, each 1 to [`MAX_EXPORT_SIDE_PX`]; in stereo, of either
        /// eye's picture.
        size_px: [u32; 2],
        /// Whether as OpenEXR.
        exr: bool,
        /// Whether as a file for each eye.
        pair: bool,
    },
    /// Render frames of the camera path at this size and hand them out as a zip of PNGs.
    SaveSequence {
        /// Width and height in pixels, each 1 to [`MAX_EXPORT_SIDE_PX`].
        size_px: [u32; 2],
        /// The first frame, and the first one after it that is not wanted.
        frames: [u32; 2],
        /// Whether with a file for each eye.
        pair: bool,
    },
    /// Stop the export in progress.
    CancelExport,
    /// Hand out the scene document.
    SaveScene,
    /// Ask for a scene document, or a PNG that carries one, and load it.
    LoadScene,
    /// Ask for an environment map, for [`Interface::use_environment_map`].
    ChoosePicture,
    /// Copy the address that shares this view.
    CopyLink,
    /// Fill the screen, or leave it.
    ToggleFullscreen,
    /// The notice was read.
    DismissNotice,
}
