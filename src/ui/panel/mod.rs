//! The panels, one per file.
//!
//! A panel draws into a `Ui`, edits the scene in place, and emits a [`Command`] or an
//! [`Action`](super::Action) for everything else. The file `context` defines the data that a
//! panel shows and edits; this file arranges the panels.

mod bloom;
mod camera;
mod card_grid;
mod colors;
mod context;
mod export;
mod fields;
mod fog;
mod formula;
mod formula_text;
mod fractal;
mod gallery;
mod help;
mod hybrid;
mod indirect;
mod light;
mod lights;
mod looks;
mod mine;
mod quality;
mod rig;
mod scenes;
mod section_planes;
mod sheet;
mod stereo;
mod surface;
mod timeline;
mod tone;

use egui::{
    Button, Frame, Margin, Rect, RichText, ScrollArea, Stroke, Ui, UiBuilder,
    emath::GuiRounding as _, vec2,
};

use crate::scene::{Path, param::Param};

use super::{
    icon::{Icon, icon_button, icon_side},
    settings::{Sections, Settings},
    sheet_height::{HEADING, SheetHeight},
    shortcuts::Command,
    theme,
    timeline::Timeline,
    widgets::{Help as _, note_part, reveal, reveal_focus, revealed, section},
};
pub(super) use context::Context;
use context::Section;
pub(super) use formula_text::{close_formula_window, formula_window, is_formula_window_open};
pub(super) use help::help_window;
pub(super) use sheet::Sheet;
pub(super) use timeline::strip;

/// The sections of "More", from top to bottom. A new panel adds its module above and its line here.
const SECTIONS: &[Section] = &[
    fractal::SECTION,
    section_planes::SECTION,
    camera::SECTION,
    lights::SECTION,
    colors::SECTION,
    surface::SECTION,
    indirect::SECTION,
    fog::SECTION,
    tone::SECTION,
    bloom::SECTION,
    quality::SECTION,
    export::SECTION,
];

/// Number of buttons in the heading.
const HEADING_BUTTONS: f32 = 5.0;
/// Space at the sides of the scrolled part, in points.
const SIDE_MARGIN: f32 = 14.0;
/// Space below the last row of the scrolled part, in points.
const BOTTOM_MARGIN: f32 = 10.0;
/// Minimum height of a sheet with a fixed area for saving, in points.
const WITH_SAVING: f32 = 320.0;
/// Height of the area for saving before it was drawn, in points.
const SAVING_HEIGHT: f32 = 58.0;
/// Gap between the heading's buttons, in points.
const HEADING_GAP: f32 = 2.0;
/// Width that the program's name takes in the heading, with the gaps, in points.
const TITLE_ROOM: f32 = 112.0;

/// The panel at the window's side: heading at the top, saving at the bottom, the rest scrolls.
pub(super) fn side(ui: &mut Ui, cx: &mut Context<'_>) {
    let margin = Margin { left: 14, right: 8, top: 8, bottom: 6 };
    egui::Panel::top("heading")
        .frame(Frame::new().inner_margin(margin).fill(theme::PANEL))
        .show_separator_line(false)
        .show(ui, |ui| heading(ui, cx, true));
    scrolled_and_saving(ui, cx);
}

/// The panel as a sheet of its present height, in a window of the height `window`.
pub(super) fn sheet(ui: &mut Ui, cx: &mut Context<'_>, sheet: &mut Sheet, window: f32) {
    let height = ui.max_rect().height();
    let open = height > HEADING;
    let margin = Margin { left: 14, right: 8, top: 8, bottom: 2 };
    let handle = egui::Panel::top("heading")
        .exact_size(HEADING)
        .frame(Frame::new().inner_margin(margin).fill(theme::PANEL))
        .show_separator_line(false)
        .show(ui, |ui| {
            // The buttons of the heading are added later, and so lie over the handle.
            let handle = sheet::handle(ui, open);
            heading(ui, cx, cx.settings.panel_open);
            handle
        })
        .inner;
    cx.rects.record("sheet handle", &handle);
    if height >= WITH_SAVING {
        scrolled_and_saving(ui, cx);
    } else if open {
        scrolled(ui, cx, true);
    }
    sheet.resize(&handle, cx.settings, window);
}

/// The scrolled part of the panel, and below it the fixed area for saving.
///
/// The Tab key follows the order of drawing, so saving is drawn last; its height is the last frame's.
fn scrolled_and_saving(ui: &mut Ui, cx: &mut Context<'_>) {
    let id = ui.scope_id().with("height of saving");
    let height = ui.data(|data| data.get_temp(id)).unwrap_or(SAVING_HEIGHT);
    let area = ui.available_rect_before_wrap();
    let (above, below) = area.split_top_bottom_at_y((area.bottom() - height).max(area.top()));
    ui.scope_builder(UiBuilder::new().max_rect(above), |ui| scrolled(ui, cx, false));
    let margin = Margin { left: 14, right: 14, top: 10, bottom: 12 };
    let saving = ui.scope_builder(UiBuilder::new().max_rect(below), |ui| {
        ui.painter().hline(below.x_range(), below.top(), Stroke::new(1.0, theme::LINE));
        Frame::new().inner_margin(margin).show(ui, |ui| export::save(ui, cx)).response.rect.height()
    });
    if saving.inner != height {
        ui.data_mut(|data| data.insert_temp(id, saving.inner));
        ui.ctx().request_repaint();
    }
}

fn scrolled(ui: &mut Ui, cx: &mut Context<'_>, with_saving: bool) {
    // A sheet that a finger holds may leave hardly any room.
    let area = ScrollArea::vertical().auto_shrink([false, false]).min_scrolled_height(0.0);
    area.show(ui, |ui| {
        let content = UiBuilder::new().max_rect(content_area(ui));
        ui.scope_builder(content, |ui| {
            reveal_focus(ui, |ui| {
                essentials(ui, cx);
                if with_saving {
                    ui.add_space(6.0);
                    export::save(ui, cx);
                    ui.add_space(4.0);
                }
                more(ui, cx);
            });
            ui.add_space(BOTTOM_MARGIN);
        });
    });
}

/// What the margins at the panel's sides leave, in whole pixels.
///
/// A scroll area rounds its own sides to whole pixels: it would be wider than a part of a pixel leaves.
fn content_area(ui: &Ui) -> Rect {
    let pixels_per_point = ui.pixels_per_point();
    let mut area = ui.available_rect_before_wrap().shrink2(vec2(SIDE_MARGIN, 0.0));
    area.min.x = ((area.left() * pixels_per_point).ceil() / pixels_per_point).round_ui();
    area.max.x = ((area.right() * pixels_per_point).floor() / pixels_per_point).round_ui();
    area
}

fn heading(ui: &mut Ui, cx: &mut Context<'_>, open: bool) {
    ui.horizontal(|ui| {
        let title = RichText::new("Mandelight").heading().color(theme::ACCENT);
        // Beside buttons for fingers, a narrow panel has no room for the name.
        if ui.available_width() >= HEADING_BUTTONS * icon_side(ui) + TITLE_ROOM {
            ui.add(egui::Label::new(title));
        }
        ui.spacing_mut().item_spacing.x = HEADING_GAP;
        let buttons = HEADING_BUTTONS * (icon_side(ui) + HEADING_GAP);
        ui.add_space((ui.available_width() - buttons).max(0.0));
        // Added from left to right, which is the order of the Tab key.
        let undo = ui
            .add_enabled_ui(cx.can_undo, |ui| icon_button(ui, Icon::Undo, "Undo", "Undo (Ctrl Z)"));
        cx.rects.record("undo", &undo.inner);
        if undo.inner.clicked() {
            cx.commands.push(Command::Undo);
        }
        let redo = ui.add_enabled_ui(cx.can_redo, |ui| {
            icon_button(ui, Icon::Redo, "Redo", "Redo (Ctrl Shift Z)")
        });
        if redo.inner.clicked() {
            cx.commands.push(Command::Redo);
        }
        if icon_button(ui, Icon::Fullscreen, "Fullscreen", "Fill the screen (Shift F)").clicked() {
            cx.commands.push(Command::ToggleFullscreen);
        }
        if icon_button(ui, Icon::Help, "Help", "Keys and gestures (?)").clicked() {
            cx.commands.push(Command::ToggleHelp);
        }
        let (icon, name, hover) = if open {
            (Icon::Cross, "Hide panel", "Hide the panel (P)")
        } else {
            (Icon::ChevronUp, "Show panel", "Show the panel (P)")
        };
        let toggle = icon_button(ui, icon, name, hover);
        cx.rects.record("panel toggle", &toggle);
        if toggle.clicked() {
            cx.commands.push(Command::TogglePanel);
        }
    });
}

/// The controls for first-time users: scenes, power, looks, light.
fn essentials(ui: &mut Ui, cx: &mut Context<'_>) {
    scenes::show(ui, cx);
    ui.add_space(8.0);
    fractal::headline(ui, cx);
    ui.add_space(8.0);
    looks::show(ui, cx);
    ui.add_space(8.0);
    lights::key_light(ui, cx);
}

/// All other controls, in sections.
fn more(ui: &mut Ui, cx: &mut Context<'_>) {
    ui.add_space(8.0);
    find_button(ui, cx);
    ui.add_space(4.0);
    let mut more_open = cx.settings.more_open;
    let response = section(ui, "More", "All other settings", &mut more_open, |ui| {
        for shown @ Section { name, title, hover, .. } in SECTIONS {
            let mut is_open = cx.settings.sections.is_open(name);
            let heading = section(ui, title, hover, &mut is_open, |ui| contents(ui, cx, shown));
            note_part(ui, title, ui.min_rect().with_min_y(heading.rect.bottom()));
            if revealed(ui, name) {
                heading.scroll_to_me(Some(egui::Align::TOP));
            }
            cx.settings.sections.set_open(name, is_open);
            cx.rects.record(title, &heading);
        }
    });
    cx.rects.record("more", &response);
    cx.settings.more_open = more_open;
}

/// The button that opens the finder.
fn find_button(ui: &mut Ui, cx: &mut Context<'_>) {
    let size = vec2(ui.available_width(), ui.spacing().interact_size.y);
    let find = ui.add_sized(size, Button::new("Find a setting…"));
    let find = find.help("Search all controls, scenes and commands by their names (Ctrl K)");
    cx.rects.record("find", &find);
    if find.clicked() {
        cx.commands.push(Command::Find);
    }
}

/// A section's controls.
fn contents(ui: &mut Ui, cx: &mut Context<'_>, section: &Section) {
    (section.show)(ui, cx);
    reset_button(ui, cx, section);
}

/// A small button at the end of a section that restores its settings.
fn reset_button(ui: &mut Ui, cx: &mut Context<'_>, section: &Section) {
    let Section { title, reset, .. } = section;
    let size = vec2(ui.available_width(), ui.spacing().interact_size.y);
    let layout = egui::Layout::right_to_left(egui::Align::Center);
    ui.allocate_ui_with_layout(size, layout, |ui| {
        let text = RichText::new("Reset").small().color(theme::TEXT_DIM);
        let response = ui.button(text).help(format!("Sets {title} back to its default values"));
        if response.clicked() {
            reset(cx);
        }
        response.accessible_name(format!("Reset: {title}"));
    });
}

/// Whether the section planes' section is open, so that their handles show in the view.
pub(super) fn shows_section_planes(settings: &Settings) -> bool {
    is_shown(settings, &section_planes::SECTION)
}

/// Whether the lights' section is open, so that all lights have handles in the view.
pub(super) fn shows_lights(settings: &Settings) -> bool {
    is_shown(settings, &lights::SECTION)
}

fn is_shown(settings: &Settings, section: &Section) -> bool {
    settings.panel_open && settings.more_open && settings.sections.is_open(section.name)
}

/// A section of the panel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SectionRef(usize);

impl SectionRef {
    /// The heading.
    pub fn title(self) -> &'static str {
        SECTIONS[self.0].title
    }

    /// What the section holds.
    pub fn hover(self) -> &'static str {
        SECTIONS[self.0].hover
    }
}

/// All sections, from top to bottom.
pub(super) fn sections() -> impl Iterator<Item = SectionRef> {
    (0..SECTIONS.len()).map(SectionRef)
}

/// Prefixes of parameters' paths and the sections of their controls; longer prefixes come first.
const SECTION_BY_PREFIX: &[(&str, &str)] = &[
    ("fractal.section_planes", "section_planes"),
    ("fractal.", "fractal"),
    ("camera.", "camera"),
    ("lights.", "lights"),
    ("surface.coloring", "colors"),
    ("surface.second_layer", "colors"),
    ("surface.gradient", "colors"),
    ("surface.", "surface"),
    ("medium.", "surface"),
    ("indirect.", "indirect"),
    ("integrator.", "indirect"),
    ("fog.", "fog"),
    ("tone.", "tone"),
    ("bloom.", "bloom"),
    ("quality.", "quality"),
];

/// The section that has the control of a parameter; none if it is elsewhere.
pub(super) fn section_of(param: &Param) -> Option<SectionRef> {
    let (_, name) = SECTION_BY_PREFIX.iter().find(|(prefix, _)| param.path.starts_with(prefix))?;
    sections().find(|section| SECTIONS[section.0].name == *name)
}

/// The heading of the section that has the control of a parameter; none if it is elsewhere.
pub fn section_title_of(param: &Param) -> Option<&'static str> {
    section_of(param).map(SectionRef::title)
}

/// Opens a section, with whatever hides it, and scrolls to it.
pub(super) fn show_section(ui: &Ui, settings: &mut Settings, section: SectionRef) {
    reveal(ui, SECTIONS[section.0].name);
    settings.more_open = true;
    settings.sections.set_open(SECTIONS[section.0].name, true);
    show_panel(settings);
}

/// Shows the panel, as a sheet at half height at least.
pub(super) fn show_panel(settings: &mut Settings) {
    settings.panel_open = true;
    if settings.sheet == SheetHeight::Low {
        settings.sheet = SheetHeight::Half;
    }
}

/// A part of the panel, or the timeline.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PanelPart {
    /// The heading, the controls above the sections, and saving.
    Panel,
    /// A section.
    Section(SectionRef),
    /// The timeline.
    Timeline,
}

impl PanelPart {
    /// The part's name.
    pub fn title(self) -> &'static str {
        match self {
            Self::Panel => "Panel",
            Self::Section(section) => section.title(),
            Self::Timeline => "Timeline",
        }
    }
}

/// All parts, from top to bottom.
pub(super) fn parts() -> impl Iterator<Item = PanelPart> {
    [PanelPart::Panel]
        .into_iter()
        .chain(sections().map(PanelPart::Section))
        .chain([PanelPart::Timeline])
}

/// Draws the controls of a part alone, over the width of `ui`.
pub(super) fn show_part(
    ui: &mut Ui,
    cx: &mut Context<'_>,
    part: PanelPart,
    path: &mut Path,
    timeline: &mut Timeline,
) {
    match part {
        PanelPart::Panel => {
            heading(ui, cx, true);
            essentials(ui, cx);
            find_button(ui, cx);
            export::save(ui, cx);
        }
        PanelPart::Section(SectionRef(index)) => contents(ui, cx, &SECTIONS[index]),
        PanelPart::Timeline => strip(ui, cx, path, timeline),
    }
}

/// Every section open.
pub fn all_sections_open() -> Sections {
    let mut sections = Sections::default();
    for section in SECTIONS {
        sections.set_open(section.name, true);
    }
    sections
}
