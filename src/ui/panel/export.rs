//! The export panel: saving of pictures, scene files and links.

use egui::{Button, ProgressBar, RichText, Ui, vec2};

use super::context::{Context, Section};
use crate::{
    scene::{
        StereoLayout,
        param::{Param, Scale, Unit},
    },
    ui::{
        action::Action,
        display_inputs::ExportProgress,
        export_size::{DEFAULT_QUALITY, ExportSize, MAX_EXPORT_SIDE_PX, StillFormat},
        notice::{CANCEL_HELP, saving_text},
        shortcuts::Command,
        theme,
        widgets::{Help as _, button_row, caption, choice, number},
    },
};

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

/// The quality of a JPEG.
const QUALITY: Param = Param {
    path: "export.quality",
    label: "Quality",
    unit: Unit::Count,
    min: 1.0,
    max: 100.0,
    default: DEFAULT_QUALITY as f64,
    scale: Scale::Integer,
    step: 1.0,
    help: "Quality of the JPEG, 1 to 100: higher values lose less and make larger files.",
};

/// The button that saves the picture, or the progress of saving it.
pub(super) fn save(ui: &mut Ui, cx: &mut Context<'_>) {
    if let Some(progress) = cx.inputs.export {
        return saving(ui, cx, progress);
    }
    let extent = cx.settings.export.text(cx.view_px, cx.scene.camera.stereo.layout);
    let kind = cx.settings.export.file.format.article_and_name();
    let size = vec2(ui.available_width(), ui.spacing().interact_size.y.max(36.0));
    let text = RichText::new("Save picture").size(15.0).color(theme::ON_ACCENT);
    let response = ui
        .add_sized(size, Button::new(text).fill(theme::ACCENT))
        .help(format!("Renders the view as {kind} of {extent} (Ctrl S). You can open the file again as a scene. For other sizes, see More, Export."));
    cx.rects.record("save picture", &response);
    if response.clicked() {
        cx.commands.push(Command::SavePicture);
    }
}

/// The progress of an export, with a button to cancel.
pub(super) fn saving(ui: &mut Ui, cx: &mut Context<'_>, progress: ExportProgress) {
    ui.horizontal(|ui| {
        ui.label(RichText::new(saving_text(progress)).small().color(theme::TEXT_DIM));
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            let cancel = ui.button("Cancel").help(CANCEL_HELP);
            // Scrolled out of sight, it is shown over the view as well.
            if ui.clip_rect().contains(cancel.rect.center()) {
                cx.rects.record("cancel export", &cancel);
            }
            if cancel.clicked() {
                cx.actions.push(Action::CancelExport);
            }
        });
    });
    let done = if progress.done.is_finite() { progress.done.clamp(0.0, 1.0) } else { 0.0 };
    ui.add(ProgressBar::new(done).desired_height(6.0).corner_radius(3.0).fill(theme::ACCENT));
}

/// The section of the panel.
pub(super) const SECTION: Section = Section {
    name: "export",
    title: "Export",
    hover: "Size and format of saved pictures, scene files and links",
    show,
    reset,
};

/// Restores all but the kind of file of a path's frames, which is chosen in the timeline.
fn reset(cx: &mut Context<'_>) {
    let export = &mut cx.settings.export;
    *export = ExportSize { sequence: export.sequence, ..ExportSize::default() };
}

/// The picture's size and format, and the scene's file and link.
fn show(ui: &mut Ui, cx: &mut Context<'_>) {
    let export = &mut cx.settings.export;
    let response = choice(
        ui,
        "Picture size",
        &mut export.times,
        &[
            (1, "View", "The view's width and height"),
            (2, "2×", "Twice the view's width and height"),
            (4, "4×", "Four times the view's width and height"),
            (0, "Custom", "Any width and height"),
        ],
    );
    cx.rects.record("picture size", &response);
    if export.times == 0 {
        typed(ui, export);
    }
    let response = choice(ui, "File", &mut export.file.format, &StillFormat::ALL);
    cx.rects.record("picture format", &response);
    if export.file.format == StillFormat::Png {
        let response = choice(
            ui,
            "Bits per channel",
            &mut export.file.deep_png,
            &[
                (false, "8", "As many shades as screens show"),
                (
                    true,
                    "16",
                    "Fine shades for other programs, so that gradients stay smooth in later edits; a larger file",
                ),
            ],
        );
        cx.rects.record("picture bits", &response);
    }
    if export.file.format.has_alpha() {
        let response = choice(
            ui,
            "Background",
            &mut export.file.no_background,
            &[
                (false, "As shown", "The background is part of the picture"),
                (true, "Transparent", "No background: the picture can be laid over others"),
            ],
        );
        cx.rects.record("picture background", &response);
    }
    if export.file.format == StillFormat::Jpeg {
        ui.horizontal(|ui| {
            ui.label(RichText::new(QUALITY.label).color(theme::TEXT_DIM));
            let mut quality = f64::from(export.file.quality);
            let response = number(ui, &QUALITY, &mut quality).help(QUALITY.help);
            cx.rects.record("picture quality", &response);
            export.file.quality = quality as u8;
        });
    }
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
        .help("The size of the file of Save picture");
    caption(ui, "Scene");
    let buttons = [
        ("Save scene", "Save the scene as a JSON file (Ctrl Shift S)", Command::SaveScene),
        (
            "Open…",
            "Open a scene file, or a saved picture with its scene (Ctrl O)",
            Command::LoadScene,
        ),
        ("Copy link", "Copy a link to this view (L)", Command::CopyLink),
    ];
    button_row(ui, buttons.len(), |ui, index, size| {
        let (name, hover, command) = buttons[index];
        if ui.add_sized(size, Button::new(name).truncate()).help(hover).clicked() {
            cx.commands.push(command);
        }
    });
}

fn typed(ui: &mut Ui, export: &mut ExportSize) {
    ui.horizontal(|ui| {
        for (index, label) in ["Width", "Height"].into_iter().enumerate() {
            let param = Param { label, ..SIDE };
            let mut value = f64::from(export.typed_px[index]);
            ui.label(RichText::new(label).color(theme::TEXT_DIM));
            let response = ui.push_id(label, |ui| number(ui, &param, &mut value)).inner;
            response
                .help(format!("{label} of the saved picture in pixels, 1 to {MAX_EXPORT_SIDE_PX}"));
            export.typed_px[index] = value as u32;
        }
    });
}
