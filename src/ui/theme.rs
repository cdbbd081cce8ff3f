//! The style: a dark palette, spacing, and larger rows for touch screens.
//!
//! In: an egui context once, and a `Ui` each frame. Out: their style.

use egui::{
    Color32, Context, CornerRadius, FontFamily, FontId, Margin, Shadow, Stroke, Style, TextStyle,
    Theme, Ui, Vec2,
    style::{Spacing, WidgetVisuals},
    vec2,
};

/// Background of the window.
pub const BACKGROUND: Color32 = Color32::from_rgb(0x0b, 0x0d, 0x12);
/// Background of panels.
pub const PANEL: Color32 = Color32::from_rgb(0x14, 0x18, 0x22);
/// Background of slider rails and text fields.
pub const WELL: Color32 = Color32::from_rgb(0x0d, 0x10, 0x17);
/// Buttons at rest.
pub const RAISED: Color32 = Color32::from_rgb(0x22, 0x28, 0x36);
/// Buttons under the pointer.
pub const RAISED_HOVER: Color32 = Color32::from_rgb(0x2d, 0x35, 0x47);
/// Thin lines between parts.
pub const LINE: Color32 = Color32::from_rgb(0x25, 0x2b, 0x39);
/// Text.
pub const TEXT: Color32 = Color32::from_rgb(0xdf, 0xe4, 0xee);
/// Secondary text: labels, captions. The contrast on [`PANEL`] is at least 4.5:1.
pub const TEXT_DIM: Color32 = Color32::from_rgb(0x97, 0xa1, 0xb5);
/// Selected items and primary buttons.
pub const ACCENT: Color32 = Color32::from_rgb(0xe8, 0xa1, 0x3c);
/// Text on [`ACCENT`].
pub const ON_ACCENT: Color32 = Color32::from_rgb(0x1a, 0x12, 0x06);
/// Errors.
pub const ERROR: Color32 = Color32::from_rgb(0xff, 0x7a, 0x6b);

/// Minimum width of an upright window with a side panel, in points.
pub(super) const WIDE_FROM: f32 = 700.0;
/// Minimum width of a window that is wider than high, with a side panel, in points.
pub(super) const LANDSCAPE_FROM: f32 = 480.0;
/// Maximum width of the side panel, in points.
pub const PANEL_WIDTH: f32 = 304.0;
/// Maximum part of the window's width that the side panel takes.
pub(super) const PANEL_PART: f32 = 0.46;

/// True if a window of this size has the panel at its side; others have it as a bottom sheet.
pub fn has_side_panel(window: Vec2) -> bool {
    let from = if window.x > window.y { LANDSCAPE_FROM } else { WIDE_FROM };
    window.x >= from
}

/// Width of the side panel in a window of the width `window`, in points.
///
/// Even: most screens then have an even number of pixels for it, and the view beside it the same pixels as one without
/// panel, whose samples it keeps.
pub fn panel_width(window: f32) -> f32 {
    PANEL_WIDTH.min(2.0 * (0.5 * PANEL_PART * window).floor())
}

/// Duration of a widget's animations, in seconds.
const ANIMATION_SECS: f32 = 0.08;
/// Opacity of disabled widgets.
const DISABLED_ALPHA: f32 = 0.56;
/// Corner radius of buttons, rails and fields, in points.
pub const RADIUS: u8 = 6;

/// Sets the context's palette, text sizes and spacing. Call it once, before the first frame.
pub fn install(ctx: &Context) {
    ctx.set_theme(Theme::Dark);
    ctx.all_styles_mut(|style| {
        text_sizes(style);
        colors(style);
        spacing(style);
    });
    // Ctrl +/− is the browser's zoom.
    ctx.options_mut(|options| options.zoom_with_keyboard = false);
}

/// Lets widgets move while they change, or not.
pub fn set_motion(ctx: &Context, moves: bool) {
    let secs = if moves { ANIMATION_SECS } else { 0.0 };
    if ctx.global_style().animation_time != secs {
        ctx.all_styles_mut(|style| style.animation_time = secs);
    }
}

/// Height of a row for fingers, in points.
const TOUCH_ROW: f32 = 44.0;

/// Whether the rows of this `Ui` have the size for fingers.
pub fn has_touch_rows(ui: &Ui) -> bool {
    ui.spacing().interact_size.y >= TOUCH_ROW
}

/// Width or height of a control that is `size` points for a pointer: for fingers at least that of a row.
pub fn target_size(ui: &Ui, size: f32) -> f32 {
    if has_touch_rows(ui) { size.max(TOUCH_ROW) } else { size }
}

/// Sets the row sizes of this `Ui`, and of all windows, menus and messages: larger for touch screens.
pub fn set_row_sizes(ui: &mut Ui, touch: bool) {
    row_sizes(ui.spacing_mut(), touch);
    let ctx = ui.ctx();
    if ctx.global_style().spacing.interact_size != ui.spacing().interact_size {
        ctx.all_styles_mut(|style| row_sizes(&mut style.spacing, touch));
    }
}

fn row_sizes(spacing: &mut Spacing, touch: bool) {
    if touch {
        spacing.interact_size = Vec2::splat(TOUCH_ROW);
        spacing.item_spacing = vec2(8.0, 6.0);
        spacing.icon_width = 22.0;
        spacing.icon_width_inner = 14.0;
    } else {
        spacing.interact_size = vec2(28.0, 26.0);
        spacing.item_spacing = vec2(6.0, 5.0);
        spacing.icon_width = 17.0;
        spacing.icon_width_inner = 10.0;
    }
}

fn text_sizes(style: &mut Style) {
    let proportional = |size| FontId::new(size, FontFamily::Proportional);
    style.text_styles = [
        (TextStyle::Small, proportional(12.0)),
        (TextStyle::Body, proportional(13.5)),
        (TextStyle::Button, proportional(13.5)),
        (TextStyle::Heading, proportional(17.0)),
        (TextStyle::Monospace, FontId::new(12.0, FontFamily::Monospace)),
    ]
    .into();
}

fn colors(style: &mut Style) {
    let visuals = &mut style.visuals;
    *visuals = egui::Visuals::dark();
    visuals.override_text_color = None;
    visuals.weak_text_color = Some(TEXT_DIM);
    visuals.panel_fill = PANEL;
    visuals.window_fill = PANEL;
    visuals.window_stroke = Stroke::new(1.0, LINE);
    visuals.window_corner_radius = CornerRadius::same(10);
    visuals.menu_corner_radius = CornerRadius::same(8);
    visuals.extreme_bg_color = WELL;
    visuals.faint_bg_color = Color32::from_rgb(0x18, 0x1d, 0x29);
    visuals.code_bg_color = RAISED;
    visuals.hyperlink_color = ACCENT;
    visuals.warn_fg_color = ACCENT;
    visuals.error_fg_color = ERROR;
    // The least at which disabled buttons can be read as well as all other text.
    visuals.disabled_alpha = DISABLED_ALPHA;
    visuals.selection.bg_fill = Color32::from_rgb(0x5a, 0x42, 0x1c);
    visuals.selection.stroke = Stroke::new(1.0, Color32::from_rgb(0xff, 0xdc, 0xa6));
    visuals.slider_trailing_fill = true;
    visuals.handle_shape = egui::style::HandleShape::Circle;
    visuals.indent_has_left_vline = false;
    visuals.interact_cursor = None;
    let shadow =
        Shadow { offset: [0, 4], blur: 16, spread: 0, color: Color32::from_black_alpha(110) };
    visuals.window_shadow = shadow;
    visuals.popup_shadow = shadow;

    let widget = |fill, text: Color32, outline: Color32| WidgetVisuals {
        bg_fill: fill,
        weak_bg_fill: fill,
        bg_stroke: Stroke::new(1.0, outline),
        fg_stroke: Stroke::new(1.0, text),
        corner_radius: CornerRadius::same(RADIUS),
        expansion: 0.0,
    };
    let widgets = &mut visuals.widgets;
    widgets.noninteractive = widget(PANEL, TEXT, LINE);
    widgets.inactive = widget(RAISED, TEXT, Color32::TRANSPARENT);
    widgets.hovered = widget(RAISED_HOVER, Color32::WHITE, Color32::TRANSPARENT);
    widgets.active = widget(RAISED_HOVER, Color32::WHITE, ACCENT);
    widgets.open = widget(RAISED_HOVER, TEXT, LINE);
}

fn spacing(style: &mut Style) {
    let spacing = &mut style.spacing;
    row_sizes(spacing, false);
    spacing.button_padding = vec2(9.0, 3.0);
    spacing.menu_margin = Margin::same(8);
    spacing.window_margin = Margin::same(12);
    spacing.tooltip_width = 280.0;
    spacing.icon_spacing = 7.0;
    spacing.combo_width = 60.0;
    // A bar with a width of its own would change what is beside it, and with that whether it is needed.
    spacing.scroll = egui::style::ScrollStyle {
        floating_allocated_width: 0.0,
        ..egui::style::ScrollStyle::thin()
    };
    spacing.default_area_size = Vec2::new(320.0, 480.0);
    style.interaction.tooltip_delay = 0.4;
    style.interaction.selectable_labels = false;
    style.animation_time = ANIMATION_SECS;
}

/// The superscripts of the digits 0 to 9.
pub const SUPERSCRIPTS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];

/// `text` with characters replaced that the bundled fonts lack: `10⁻⁵` becomes `10^-5`.
pub fn printable(text: &str) -> String {
    let mut printable = String::with_capacity(text.len());
    let mut is_negative_power = false;
    for c in text.chars() {
        let digit = SUPERSCRIPTS.iter().position(|&digit| digit == c);
        match (c, digit) {
            ('⁻', _) => printable.push_str("^-"),
            ('ⁿ', _) => printable.push_str("^n"),
            ('→', _) => printable.push_str("->"),
            (_, Some(digit)) if is_negative_power => printable.push_str(&digit.to_string()),
            _ => printable.push(c),
        }
        is_negative_power = c == '⁻' || (is_negative_power && digit.is_some());
    }
    printable
}

/// Texts in quotes, in the formula editor.
pub const CODE_TEXT: Color32 = Color32::from_rgb(0xa8, 0xcf, 0x8e);
/// Numbers, in the formula editor.
pub const CODE_NUMBER: Color32 = Color32::from_rgb(0xd7, 0x9b, 0xd8);
/// Functions and built-in names, in the formula editor.
pub const CODE_FUNCTION: Color32 = Color32::from_rgb(0x7c, 0xbd, 0xf0);

/// The display colour of a linear Rec. 709 colour; channels are clamped to 0 to 1.
pub fn display_color(linear: [f32; 3]) -> Color32 {
    let [r, g, b] = linear.map(|v| v.clamp(0.0, 1.0));
    egui::Rgba::from_rgb(r, g, b).into()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        formula,
        scene::{param, presets},
    };

    #[test]
    fn negative_powers_are_written_with_a_caret() {
        assert_eq!(printable("At 4 · 10⁻¹², power 6"), "At 4 · 10^-12, power 6");
        assert_eq!(printable("3.2 × 10⁵"), "3.2 × 10⁵");
        assert_eq!(printable("zⁿ → c"), "z^n -> c");
    }

    #[test]
    fn the_fonts_can_draw_what_the_interface_says() {
        let context = Context::default();
        let presets = presets::all().flat_map(|preset| [preset.name, preset.blurb]);
        let params = param::all().flat_map(|param| [param.label, param.help]);
        let texts: Vec<String> = presets.chain(params).map(printable).collect();
        let texts = texts.iter().map(|text| (text.as_str(), FontId::proportional(13.0)));
        // The editor shows them as they are.
        let formulas = formula::texts().chain(formula::step_texts());
        let formulas = formulas.map(|(_, text)| (text, FontId::monospace(12.0)));
        let texts: Vec<_> = texts.chain(formulas).collect();
        // The fonts are loaded by the first frame.
        let mut output = context.run_ui(Default::default(), |ui| {
            for (text, font) in &texts {
                let lacks =
                    |c: &char| *c != '\n' && !ui.fonts_mut(|fonts| fonts.has_glyph(font, *c));
                let missing: String = text.chars().filter(lacks).collect();
                assert_eq!(missing, "", "in {text:?}");
            }
        });
        output.textures_delta.clear();
    }
}
