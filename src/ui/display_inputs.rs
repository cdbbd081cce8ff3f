//! Data of the shell for the interface to display: the picture, progress and messages.

use std::collections::BTreeMap;

use egui::{Color32, CornerRadius, Painter, Rect, Shape, epaint::RectShape, pos2};

use super::{
    export_size::MissingEncoders, gallery::GalleryState, share::Sharing,
    small_picture::SmallPictureId,
};
use crate::render::report::Report;

/// The data of one frame that the interface displays.
#[derive(Clone, Copy, Debug)]
pub struct DisplayInputs<'a> {
    /// The newest picture; none before the first.
    pub picture: Option<ViewTexture>,
    /// An older picture of the same scene, which covers the newest until that is as good.
    pub kept_picture: Option<KeptPicture>,
    /// The renderer's report.
    pub report: &'a Report,
    /// The export in progress, if any.
    pub export: Option<ExportProgress>,
    /// The shell's message, if any.
    pub notice: Option<&'a Notice>,
    /// The kinds of video that the browser cannot encode, of those of
    /// [`Interface::video`](super::Interface::video).
    pub missing_encoders: MissingEncoders,
    /// The name of the file that is being read, if that takes long.
    pub reading: Option<&'a str>,
    /// The name of the GPU adapter.
    pub adapter: &'a str,
    /// What the shell can share.
    pub sharing: Sharing<'a>,
    /// The gallery that the page's address names, if it names one.
    pub gallery: Option<&'a GalleryState>,
    /// True if the user asks for as little motion on the screen as possible.
    pub reduced_motion: bool,
    /// Those of [`Interface::small_pictures`](super::Interface::small_pictures) that are drawn.
    pub small_pictures: &'a SmallTextures,
}

/// The rendered picture as an egui texture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ViewTexture {
    /// The texture: sRGB-encoded, opaque.
    pub texture: egui::TextureId,
    /// Width and height in pixels.
    pub size_px: [u32; 2],
}

impl ViewTexture {
    /// Draws the picture over `rect`, with round corners.
    pub(super) fn paint(&self, painter: &Painter, rect: Rect, corners: CornerRadius) {
        let uv = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
        let shape = RectShape::filled(rect, corners, Color32::WHITE);
        painter.add(Shape::Rect(shape.with_texture(self.texture, uv)));
    }
}

/// An older picture of the scene in view, of any size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KeptPicture {
    /// The picture.
    pub picture: ViewTexture,
    /// Part of the picture's shorter side that the camera's angle spans; below 1, it shows more.
    pub span: f32,
}

/// The small pictures that have been drawn.
#[derive(Clone, Debug, Default)]
pub struct SmallTextures {
    /// Their textures.
    pub by_id: BTreeMap<SmallPictureId, ViewTexture>,
    /// GPU memory of the pictures and of the view that draws them.
    pub memory_bytes: u64,
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
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Notice {
    /// The message.
    pub text: String,
    /// True for an error.
    pub is_error: bool,
    /// The label of a button that takes what the message offers; none for other messages.
    pub offer: Option<&'static str>,
}
