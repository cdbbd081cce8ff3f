//! A colour button that opens a picker: a square of saturation and brightness, a hue bar, and a
//! text field.
//!
//! Colours are linear Rec. 709. The picker uses hue, saturation and value of the sRGB encoding,
//! because the square is perceptually more uniform in this encoding.

use super::hover::Help as _;
use egui::{
    Color32, EventFilter, Key, Mesh, Popup, PopupCloseBehavior, Rect, Response, Sense, Shape,
    Stroke, StrokeKind, TextEdit, Ui, Vec2, WidgetInfo, accesskit::Role, lerp, pos2, vec2,
};

use crate::{
    scene::color::{Hsv, hsv_from_srgb, linear_from_srgb, srgb_from_hsv, srgb_from_linear},
    ui::theme,
};

/// Width of the picker, in points.
const WIDTH: f32 = 232.0;
/// Number of mesh cells along a side of the square and the bar.
const CELLS: usize = 24;
/// Change of a value per arrow key press, as a fraction of its range.
const KEY_STEP: f32 = 0.02;

/// Width and height of the button of [`color`], in points.
pub fn color_size(ui: &Ui) -> Vec2 {
    vec2(ui.spacing().interact_size.x.max(32.0), ui.spacing().interact_size.y)
}

/// A button in the colour `linear` (Rec. 709) that opens a picker.
///
/// `name` is the accessible name, `hover` the hover text.
pub fn color(ui: &mut Ui, name: &str, hover: &str, linear: &mut [f32; 3]) -> Response {
    let size = color_size(ui);
    let (rect, mut response) = ui.allocate_exact_size(size, Sense::click());
    response.widget_info(|| WidgetInfo::labeled(Role::ColorWell, ui.is_enabled(), name));
    paint_button(ui, rect, &response, *linear);
    let popup = Popup::menu(&response).close_behavior(PopupCloseBehavior::CloseOnClickOutside);
    let changed = popup.show(|ui| picker(ui, response.id, linear)).is_some_and(|shown| shown.inner);
    if changed {
        response.mark_changed();
    }
    response.help(hover)
}

fn paint_button(ui: &Ui, rect: Rect, response: &Response, linear: [f32; 3]) {
    if !ui.is_rect_visible(rect) {
        return;
    }
    // The outline makes a dark colour visible on the panel.
    let lit = response.hovered() || response.has_focus();
    let outline = if lit { theme::ACCENT } else { theme::RAISED_HOVER };
    let painter = ui.painter();
    painter.rect_filled(rect, theme::RADIUS, theme::display_color(linear));
    painter.rect_stroke(rect, theme::RADIUS, Stroke::new(1.0, outline), StrokeKind::Inside);
}

/// The picker's content; true if the colour changed.
fn picker(ui: &mut Ui, id: egui::Id, linear: &mut [f32; 3]) -> bool {
    ui.set_width(WIDTH);
    // A grey has no hue, so the last hue is stored with the colour.
    let memory = id.with("hsv");
    let stored = ui.data(|data| data.get_temp::<([f32; 3], Hsv)>(memory));
    let mut hsv = match stored {
        Some((color, hsv)) if color == *linear => hsv,
        _ => hsv_from_linear(*linear),
    };
    let before = hsv;
    square(ui, &mut hsv);
    hue_bar(ui, &mut hsv);
    let mut color = if hsv == before { *linear } else { linear_from_hsv(hsv) };
    if hex_field(ui, id, &mut color) {
        hsv = hsv_from_linear(color);
    }
    ui.data_mut(|data| data.insert_temp(memory, (color, hsv)));
    let changed = color != *linear;
    *linear = color;
    changed
}

/// The square: saturation to the right, brightness upward.
fn square(ui: &mut Ui, hsv: &mut Hsv) {
    let (rect, response) = ui.allocate_exact_size(vec2(WIDTH, 140.0), Sense::click_and_drag());
    let name = "Saturation and brightness";
    response.widget_info(|| WidgetInfo::labeled(Role::Slider, ui.is_enabled(), name));
    let [right, up] = steps(ui, &response, true);
    hsv.s = (hsv.s + right).clamp(0.0, 1.0);
    hsv.v = (hsv.v + up).clamp(0.0, 1.0);
    if let Some(part) = pressed_position(&response, rect) {
        (hsv.s, hsv.v) = (part.x, 1.0 - part.y);
    }
    let hue = hsv.h;
    ui.painter().add(grid(rect, CELLS, |x, y| encoded_color(Hsv { h: hue, s: x, v: 1.0 - y })));
    let at = pos2(lerp(rect.x_range(), hsv.s), lerp(rect.y_range(), 1.0 - hsv.v));
    ui.painter().circle(at, 6.0, encoded_color(*hsv), Stroke::new(2.0, Color32::WHITE));
    ui.painter().circle_stroke(at, 7.5, Stroke::new(1.0, Color32::from_black_alpha(160)));
    focus_ring(ui, rect, &response);
    response.help("Drag right for a stronger colour, upward for a brighter one.");
}

fn hue_bar(ui: &mut Ui, hsv: &mut Hsv) {
    let height = ui.spacing().interact_size.y.max(20.0);
    let (rect, response) = ui.allocate_exact_size(vec2(WIDTH, height), Sense::click_and_drag());
    response.widget_info(|| WidgetInfo::labeled(Role::Slider, ui.is_enabled(), "Hue"));
    let [right, _] = steps(ui, &response, false);
    hsv.h = (hsv.h + right).clamp(0.0, 1.0);
    if let Some(part) = pressed_position(&response, rect) {
        hsv.h = part.x;
    }
    ui.painter().add(grid(rect, CELLS, |x, _| encoded_color(Hsv { h: x, s: 1.0, v: 1.0 })));
    let x = lerp(rect.x_range(), hsv.h);
    let mark = Rect::from_center_size(pos2(x, rect.center().y), vec2(6.0, rect.height() + 4.0));
    let fill = encoded_color(Hsv { h: hsv.h, s: 1.0, v: 1.0 });
    ui.painter().rect(mark, 2.0, fill, Stroke::new(2.0, Color32::WHITE), StrokeKind::Inside);
    focus_ring(ui, rect, &response);
    response.help("Drag to choose the hue.");
}

/// The text field of the colour as `#rrggbb`; true if a new colour was typed.
fn hex_field(ui: &mut Ui, id: egui::Id, linear: &mut [f32; 3]) -> bool {
    let shown = hex_text(*linear);
    let draft = id.with("hex");
    let mut text = ui.data(|data| data.get_temp::<String>(draft)).unwrap_or_else(|| shown.clone());
    let field = TextEdit::singleline(&mut text)
        .char_limit(7)
        .align(egui::Align2::LEFT_CENTER)
        .margin(egui::Margin::symmetric(8, 4))
        .desired_width(WIDTH - 20.0);
    let response =
        ui.add(field).accessible_name("Colour value").help("The colour as #rrggbb in sRGB");
    if response.has_focus() {
        ui.data_mut(|data| data.insert_temp(draft, text));
        return false;
    }
    ui.data_mut(|data| data.remove::<String>(draft));
    let typed = linear_from_hex(&text).filter(|_| response.lost_focus() && text != shown);
    if let Some(typed) = typed {
        *linear = typed;
    }
    typed.is_some()
}

/// The pressed pointer's position in `rect`, 0 to 1 in x and y; none if not pressed.
fn pressed_position(response: &Response, rect: Rect) -> Option<Vec2> {
    let at = response.interact_pointer_pos().filter(|_| response.is_pointer_button_down_on())?;
    Some(((at - rect.min) / rect.size()).clamp(Vec2::ZERO, Vec2::splat(1.0)))
}

/// The steps of the arrow keys, right and up, while `response` is focused.
fn steps(ui: &Ui, response: &Response, vertical: bool) -> [f32; 2] {
    if !response.has_focus() {
        return [0.0; 2];
    }
    let arrows =
        EventFilter { horizontal_arrows: true, vertical_arrows: vertical, ..Default::default() };
    ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, arrows));
    ui.input(|i| {
        let presses = |key| i.num_presses(key) as f32 * KEY_STEP;
        let up = presses(Key::ArrowUp) - presses(Key::ArrowDown);
        [presses(Key::ArrowRight) - presses(Key::ArrowLeft), if vertical { up } else { 0.0 }]
    })
}

fn focus_ring(ui: &Ui, rect: Rect, response: &Response) {
    if response.has_focus() {
        let stroke = Stroke::new(1.5, theme::ACCENT);
        ui.painter().rect_stroke(rect, 0.0, stroke, StrokeKind::Outside);
    }
}

/// A rectangle with the colours `color(x, y)`, with x and y from 0 to 1.
fn grid(rect: Rect, cells: usize, color: impl Fn(f32, f32) -> Color32) -> Shape {
    let mut mesh = Mesh::default();
    let side = cells + 1;
    for i in 0..side * side {
        let (x, y) = ((i % side) as f32 / cells as f32, (i / side) as f32 / cells as f32);
        mesh.colored_vertex(pos2(lerp(rect.x_range(), x), lerp(rect.y_range(), y)), color(x, y));
    }
    for row in 0..cells {
        for column in 0..cells {
            let a = (row * side + column) as u32;
            let below = a + side as u32;
            mesh.add_triangle(a, a + 1, below);
            mesh.add_triangle(a + 1, below, below + 1);
        }
    }
    Shape::mesh(mesh)
}

fn encoded_color(hsv: Hsv) -> Color32 {
    let [r, g, b] = srgb_from_hsv(hsv).map(|v| (v * 255.0).round() as u8);
    Color32::from_rgb(r, g, b)
}

fn linear_from_hsv(hsv: Hsv) -> [f32; 3] {
    srgb_from_hsv(hsv).map(linear_from_srgb)
}

fn hsv_from_linear(linear: [f32; 3]) -> Hsv {
    hsv_from_srgb(linear.map(srgb_from_linear))
}

fn hex_text(linear: [f32; 3]) -> String {
    let [r, g, b] = linear.map(|v| (srgb_from_linear(v) * 255.0).round() as u8);
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// The colour of a text such as `#e8a13c` or `e8a13c`; none for other texts.
fn linear_from_hex(text: &str) -> Option<[f32; 3]> {
    let digits = text.trim().trim_start_matches('#');
    let plain = digits.len() == 6 && digits.bytes().all(|b| b.is_ascii_hexdigit());
    let value = u32::from_str_radix(digits, 16).ok().filter(|_| plain)?;
    Some([16, 8, 0].map(|shift| linear_from_srgb((value >> shift & 0xff) as f32 / 255.0)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hues_give_the_primary_colours() {
        let hue = |h| srgb_from_hsv(Hsv { h, s: 1.0, v: 1.0 }).map(|v| (v * 255.0).round());
        assert_eq!(hue(0.0), [255.0, 0.0, 0.0]);
        assert_eq!(hue(1.0 / 3.0), [0.0, 255.0, 0.0]);
        assert_eq!(hue(2.0 / 3.0), [0.0, 0.0, 255.0]);
        assert_eq!(hue(1.0), [255.0, 0.0, 0.0]);
    }

    #[test]
    fn colours_round_trip_through_hsv() {
        for i in 0..216u32 {
            let linear = [i % 6, i / 6 % 6, i / 36].map(|v| v as f32 / 5.0);
            let back = linear_from_hsv(hsv_from_linear(linear));
            for (a, b) in linear.into_iter().zip(back) {
                assert!((a - b).abs() < 1e-5, "{linear:?} came back as {back:?}");
            }
        }
    }

    #[test]
    fn typed_colours_are_parsed_and_other_texts_rejected() {
        assert_eq!(linear_from_hex("#ffffff"), Some([1.0; 3]));
        assert_eq!(hex_text(linear_from_hex("e8A13c").expect("a colour")), "#e8a13c");
        for text in ["", "#", "#fff", "#gggggg", "+12345", "#1234567", "ééé"] {
            assert_eq!(linear_from_hex(text), None, "{text:?}");
        }
    }
}
