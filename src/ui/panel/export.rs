//! The export panel: saving of pictures, scene files and links.

use egui::{Button, ProgressBar, RichText, Ui, vec2};
use serde::{Deserialize, Serialize};

use super::Context;
use crate::{
    scene::{
        StereoLayout,
        param::{Param, Scale, Unit},
    },
    ui::{
        Action, ExportProgress,
        shortcuts::Command,
        status::duration_text,
        theme,
        widgets::{caption, choice, number},
    },
};

/// Maximum width or height of a saved picture, in pixels.
pub const MAX_EXPORT_SIDE_PX: u32 = 16384;

/// A side of a typed size; a setting of the interface, so not in the scene's table.
const SIDE: Param = Param {
    path: "export.side_px",
    label: "Side",
    unit: Unit::Count,
    min: 1.0,
    max: MAX_EXPORT_SIDE_PX as f64,
    default: 3840.0,
    scale: Scale::Integer,
    step: 1.0,
    help: "One side of the saved picture, in pixels.",
};

/// Size and format of saved pictures.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct ExportSize {
    /// Factor on the view's size: 1, 2 or 4; 0 for the typed size.
    pub times: u32,
    /// The typed width and height in pixels, each 1 to [`MAX_EXPORT_SIDE_PX`].
    pub typed_px: [u32; 2],
    /// True for OpenEXR, false for PNG.
    pub exr: bool,
    /// True to save a stereo picture as one file per eye.
    pub pair: bool,
}

impl Default for ExportSize {
    fn default() -> Self {
        Self { times: 1, typed_px: [3840, 2160], exr: false, pair: false }
    }
}

impl ExportSize {
    /// Width and height of the saved picture, or of one eye's picture, in pixels.
    ///
    /// If the size exceeds the limit, both sides shrink and keep the view's aspect.
    pub fn resolve(&self, view_px: [u32; 2], layout: StereoLayout) -> [u32; 2] {
        let grid_in_file = self.grid_in_file(layout);
        let limit = grid_in_file.map(|pictures| f64::from(MAX_EXPORT_SIDE_PX / pictures));
        let side = |axis: usize, length: f64| length.round().clamp(1.0, limit[axis]) as u32;
        if self.times == 0 {
            return std::array::from_fn(|axis| side(axis, f64::from(self.typed_px[axis])));
        }
        let grid = layout.grid();
        let picture_px: [f64; 2] =
            std::array::from_fn(|axis| f64::from((view_px[axis] / grid[axis]).max(1)));
        let max_times = (limit[0] / picture_px[0]).min(limit[1] / picture_px[1]);
        let times = f64::from(self.times.min(16)).min(max_times);
        std::array::from_fn(|axis| side(axis, picture_px[axis] * times))
    }

    /// True if each eye's picture is a separate file.
    pub fn is_pair(&self, layout: StereoLayout) -> bool {
        self.pair && layout != StereoLayout::Off
    }

    /// Number of columns and rows of pictures in one file.
    fn grid_in_file(&self, layout: StereoLayout) -> [u32; 2] {
        if self.pair { [1, 1] } else { layout.grid() }
    }

    /// The size of the saved file as text.
    pub fn text(&self, view_px: [u32; 2], layout: StereoLayout) -> String {
        let (picture_px, grid) = (self.resolve(view_px, layout), self.grid_in_file(layout));
        let [width, height] = [0, 1].map(|axis| picture_px[axis] * grid[axis]);
        let pair = if self.is_pair(layout) { ", one for each eye" } else { "" };
        format!("{width} × {height} pixels{pair}")
    }
}

/// The button that saves the picture, or the progress of saving it.
pub(super) fn save(ui: &mut Ui, cx: &mut Context<'_>) {
    if let Some(progress) = cx.inputs.export {
        return saving(ui, cx, progress);
    }
    let extent = cx.settings.export.text(cx.view_px, cx.scene.camera.stereo.layout);
    let kind = if cx.settings.export.exr { "an OpenEXR file" } else { "a PNG" };
    let size = vec2(ui.available_width(), ui.spacing().interact_size.y.max(36.0));
    let text = RichText::new("Save picture").size(15.0).color(theme::ON_ACCENT);
    let response = ui
        .add_sized(size, Button::new(text).fill(theme::ACCENT))
        .on_hover_text(format!("Renders the view as {kind} of {extent} (Ctrl S). You can open the file again as a scene. For other sizes, see More, Export."));
    cx.rects.record("save picture", &response);
    if response.clicked() {
        cx.commands.push(Command::SavePicture);
    }
}

/// The progress of an export, with a button to cancel.
pub(super) fn saving(ui: &mut Ui, cx: &mut Context<'_>, progress: ExportProgress) {
    let left = match progress.remaining_secs {
        Some(secs) => format!("Saving, {} left", duration_text(secs)),
        None => "Saving…".to_owned(),
    };
    ui.horizontal(|ui| {
        ui.label(RichText::new(left).small().color(theme::TEXT_DIM));
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            let cancel = ui.button("Cancel").on_hover_text("Stop the export; no file is saved");
            cx.rects.record("cancel export", &cancel);
            if cancel.clicked() {
                cx.actions.push(Action::CancelExport);
            }
        });
    });
    let done = if progress.done.is_finite() { progress.done.clamp(0.0, 1.0) } else { 0.0 };
    ui.add(ProgressBar::new(done).desired_height(6.0).corner_radius(3.0).fill(theme::ACCENT));
}

/// The picture's size and format, and the scene's file and link.
pub(super) fn show(ui: &mut Ui, cx: &mut Context<'_>) {
    let export = &mut cx.settings.export;
    let response = choice(
        ui,
        "Picture size",
        &mut export.times,
        &[
            (1, "View", "The view's width and height"),
            (2, "2×", "Twice the view's width and height"),
            (4, "4×", "Four times the view's width and height"),
            (0, "Typed", "Any width and height"),
        ],
    );
    cx.rects.record("picture size", &response);
    if export.times == 0 {
        typed(ui, export);
    }
    let response = choice(
        ui,
        "File",
        &mut export.exr,
        &[
            (false, "PNG", "The picture as you see it"),
            (
                true,
                "EXR",
                "For other programs: light before exposure and tone, depth, normals and positions, 32 bits per channel",
            ),
        ],
    );
    cx.rects.record("picture format", &response);
    let layout = cx.scene.camera.stereo.layout;
    if layout != StereoLayout::Off {
        let response = choice(
            ui,
            "Both eyes",
            &mut export.pair,
            &[
                (false, "One file", "Both pictures in one file, as in the view"),
                (true, "Two files", "One file for the left eye, one for the right eye"),
            ],
        );
        cx.rects.record("picture pair", &response);
    }
    ui.label(RichText::new(export.text(cx.view_px, layout)).small().color(theme::TEXT_DIM))
        .on_hover_text("The size of the file of Save picture");
    caption(ui, "Scene");
    ui.columns(3, |columns| {
        let mut button = |index: usize, name: &str, hover: &str, command: Command| {
            let ui: &mut Ui = &mut columns[index];
            let size = vec2(ui.available_width(), ui.spacing().interact_size.y);
            if ui.add_sized(size, Button::new(name).truncate()).on_hover_text(hover).clicked() {
                cx.commands.push(command);
            }
        };
        button(0, "Save scene", "Save the scene as a JSON file (Ctrl Shift S)", Command::SaveScene);
        button(
            1,
            "Open…",
            "Open a scene file, or a saved picture with its scene (Ctrl O)",
            Command::LoadScene,
        );
        button(2, "Copy link", "Copy a link to this view (L)", Command::CopyLink);
    });
}

fn typed(ui: &mut Ui, export: &mut ExportSize) {
    ui.horizontal(|ui| {
        for (index, label) in ["Width", "Height"].into_iter().enumerate() {
            let param = Param { label, ..SIDE };
            let mut value = f64::from(export.typed_px[index]);
            ui.label(RichText::new(label).color(theme::TEXT_DIM));
            let response = ui.push_id(label, |ui| number(ui, &param, &mut value)).inner;
            response.on_hover_text(format!(
                "{label} of the saved picture in pixels, 1 to {MAX_EXPORT_SIDE_PX}"
            ));
            export.typed_px[index] = value as u32;
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_multiples_of_the_view() {
        let view = [1280, 720];
        let size =
            |times| ExportSize { times, ..Default::default() }.resolve(view, StereoLayout::Off);
        assert_eq!((size(1), size(2), size(4)), ([1280, 720], [2560, 1440], [5120, 2880]));
    }

    #[test]
    fn a_size_at_the_limit_keeps_the_aspect() {
        let export = ExportSize { times: 4, ..Default::default() };
        assert_eq!(export.resolve([8192, 4096], StereoLayout::Off), [16384, 8192]);
    }

    #[test]
    fn invalid_stored_settings_are_clamped() {
        let export = ExportSize { times: 0, typed_px: [0, u32::MAX], ..Default::default() };
        assert_eq!(export.resolve([800, 600], StereoLayout::Off), [1, MAX_EXPORT_SIDE_PX]);
        let export = ExportSize { times: u32::MAX, typed_px: [1, 1], ..Default::default() };
        assert_eq!(export.resolve([1600, 400], StereoLayout::Off), [16384, 4096]);
    }

    #[test]
    fn both_eyes_share_the_view_and_the_file() {
        use StereoLayout::{Anaglyph, SideBySide, TopBottom};
        let export = ExportSize::default();
        let sized = |export: &ExportSize, layout| export.resolve([1280, 720], layout);
        assert_eq!(sized(&export, SideBySide), [640, 720]);
        assert_eq!(sized(&export, TopBottom), [1280, 360]);
        assert_eq!(sized(&export, Anaglyph), [1280, 720]);
        assert_eq!(export.text([1280, 720], SideBySide), "1280 × 720 pixels");
        let pair = ExportSize { pair: true, ..export };
        assert_eq!(sized(&pair, SideBySide), [640, 720]);
        assert_eq!(pair.text([1280, 720], SideBySide), "640 × 720 pixels, one for each eye");
        assert_eq!(pair.text([1280, 720], StereoLayout::Off), "1280 × 720 pixels");
        // No side of a file goes above the limit.
        let typed = ExportSize { times: 0, typed_px: [16_384, 9000], ..export };
        assert_eq!(sized(&typed, SideBySide), [8192, 9000]);
        assert_eq!(sized(&typed, TopBottom), [16_384, 8192]);
        let large = ExportSize { times: 4, ..export };
        assert_eq!(large.resolve([8192, 4096], SideBySide), [8192, 8192]);
    }
}
