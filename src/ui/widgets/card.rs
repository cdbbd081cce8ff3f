//! A button with a picture: the name stands over the picture's lower edge.

use egui::{
    Align2, Color32, FontId, Image, Mesh, Pos2, Rect, Response, Sense, Stroke, StrokeKind, Ui,
    WidgetInfo,
    accesskit::{Role, Toggled},
    epaint::Vertex,
    pos2, vec2,
};

use crate::ui::theme;

/// Corner radius of cards, in points.
const RADIUS: u8 = 8;

/// Height of the dark gradient under the name, as a part of the card's.
const SHADE_PART: f32 = 0.55;

/// Opacity of the gradient at the card's lower edge.
const SHADE_ALPHA: f32 = 0.85;

/// A button in `rect` that shows `picture` and `name`; a plain button while there is no picture.
///
/// `is_chosen` marks the card of what is in view.
pub fn card(
    ui: &mut Ui,
    rect: Rect,
    name: &str,
    picture: Option<Image<'_>>,
    is_chosen: bool,
) -> Response {
    let response = ui.interact(rect, ui.scope_id().with(name), Sense::click());
    response.widget_info(|| WidgetInfo::selected(Role::Button, ui.is_enabled(), is_chosen, name));
    let toggled = if is_chosen { Toggled::True } else { Toggled::False };
    ui.ctx().accesskit_node_builder(response.id, |node| node.set_toggled(toggled));
    if response.gained_focus() {
        response.scroll_to_me(None);
    }
    if ui.is_rect_visible(rect) {
        paint(ui, &response, name, picture, is_chosen);
    }
    response
}

fn paint(ui: &Ui, response: &Response, name: &str, picture: Option<Image<'_>>, is_chosen: bool) {
    let rect = response.rect;
    let is_lit = response.hovered() || response.has_focus();
    let painter = ui.painter();
    painter.rect_filled(rect, RADIUS, if is_lit { theme::RAISED_HOVER } else { theme::RAISED });
    if let Some(picture) = picture {
        // At rest a little darker, so that the pointer lights the card up.
        let tint = if is_lit || is_chosen { Color32::WHITE } else { Color32::from_gray(0xdc) };
        let texture = picture.load_for_size(ui.ctx(), rect.size()).ok();
        if let Some(size) = texture.and_then(|texture| texture.size()) {
            let uv = covering(size.x / size.y, rect.width() / rect.height());
            let picture = picture.uv(uv).tint(tint).corner_radius(RADIUS);
            picture.show_loading_spinner(false).paint_at(ui, rect);
            painter.add(shade(rect));
        }
    }

    let font = FontId::proportional((rect.width() * 0.1).clamp(12.0, 13.5));
    let color = if is_chosen { CHOSEN_TEXT } else { Color32::WHITE };
    let mut job = egui::text::LayoutJob::simple_singleline(name.to_owned(), font, color);
    job.wrap.max_width = rect.width() - 14.0;
    job.wrap.max_rows = 1;
    job.wrap.break_anywhere = true;
    let galley = painter.layout_job(job);
    let at = rect.left_bottom() + vec2(8.0, -6.0);
    let place = Align2::LEFT_BOTTOM.anchor_size(at, galley.size());
    painter.galley(place.min, galley, color);

    let outline = match (response.has_focus(), is_chosen, response.hovered()) {
        (true, ..) => Stroke::new(2.0, Color32::WHITE),
        (_, true, _) => Stroke::new(2.0, theme::ACCENT),
        (.., true) => Stroke::new(1.0, Color32::from_white_alpha(150)),
        _ => Stroke::new(1.0, Color32::from_white_alpha(22)),
    };
    painter.rect_stroke(rect, RADIUS, outline, StrokeKind::Inside);
}

/// The chosen card's name.
const CHOSEN_TEXT: Color32 = Color32::from_rgb(0xff, 0xdc, 0xa6);

/// The part of a picture that covers a rectangle; both are given by width over height.
fn covering(picture_aspect: f32, rect_aspect: f32) -> Rect {
    let ratio = picture_aspect / rect_aspect;
    let size = if ratio > 1.0 { vec2(1.0 / ratio, 1.0) } else { vec2(1.0, ratio) };
    Rect::from_center_size(pos2(0.5, 0.5), size)
}

/// A gradient from nothing to dark over the lower part of a card, inside of its round corners.
fn shade(rect: Rect) -> Mesh {
    let radius = f32::from(RADIUS);
    let top = rect.bottom() - rect.height() * SHADE_PART;
    let corner = rect.bottom() - radius;
    // Straight down to the corners, then in steps around them.
    let rows = std::iter::once(top).chain((0..=8).map(|i| corner + radius * i as f32 / 8.0));
    let mut mesh = Mesh::default();
    for y in rows {
        let below = (y - corner).max(0.0);
        let inset = radius - (radius * radius - below * below).max(0.0).sqrt();
        let depth = (y - top) / (rect.bottom() - top);
        let color = Color32::BLACK.gamma_multiply(SHADE_ALPHA * depth.clamp(0.0, 1.0));
        for x in [rect.left() + inset, rect.right() - inset] {
            let (pos, uv) = (Pos2::new(x, y), egui::epaint::WHITE_UV);
            mesh.vertices.push(Vertex { pos, uv, color });
        }
        if let Some(first) = (mesh.vertices.len() as u32).checked_sub(4) {
            mesh.add_triangle(first, first + 1, first + 2);
            mesh.add_triangle(first + 1, first + 2, first + 3);
        }
    }
    mesh
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_covers_its_card_without_distortion() {
        for (picture, card) in [(1.6, 1.6), (1.6, 1.0), (1.6, 2.5)] {
            let uv = covering(picture, card);
            assert!((picture * uv.width() / uv.height() - card).abs() < 1e-5);
            assert!(Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0)).contains_rect(uv));
            assert!((uv.width().max(uv.height()) - 1.0).abs() < 1e-6);
        }
    }

    #[test]
    fn the_shade_stays_within_the_round_corners() {
        let rect = Rect::from_min_size(pos2(10.0, 20.0), vec2(135.0, 84.0));
        let radius = f32::from(RADIUS);
        let mesh = shade(rect);
        assert!(mesh.is_valid() && mesh.vertices.len() == 20);
        for vertex in mesh.vertices {
            assert!(rect.expand(1e-3).contains(vertex.pos), "{:?}", vertex.pos);
            let inner = rect.shrink(radius);
            let away = vertex.pos - inner.clamp(vertex.pos);
            assert!(away.length() < radius + 1e-3, "{:?}", vertex.pos);
        }
    }
}
