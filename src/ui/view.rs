//! The picture's area: drawing of the picture, and its size in pixels.

use egui::{Color32, Rect, Sense, Ui, pos2};

use super::{display_inputs::ViewTexture, frame::Frame, theme};

/// Maximum width or height of the view, in pixels (WebGPU's default texture limit).
pub const MAX_VIEW_SIDE_PX: u32 = 8192;

/// The area rounded to whole pixels, and its size in pixels.
///
/// Each side has 1 to [`MAX_VIEW_SIDE_PX`] pixels.
pub fn snap_to_pixels(area: Rect, pixels_per_point: f32) -> (Rect, [u32; 2]) {
    let snap = |v: f32| (v * pixels_per_point).round();
    let (left, top) = (snap(area.left()), snap(area.top()));
    let (right, bottom) = (snap(area.right()).max(left + 1.0), snap(area.bottom()).max(top + 1.0));
    let rect = Rect::from_min_max(
        pos2(left, top) / pixels_per_point,
        pos2(right, bottom) / pixels_per_point,
    );
    let side = |length: f32| (length as u32).clamp(1, MAX_VIEW_SIDE_PX);
    (rect, [side(right - left), side(bottom - top)])
}

/// Draws the picture over `frame` and returns the area's pointer response.
pub fn show(ui: &Ui, frame: Frame, picture: Option<ViewTexture>) -> egui::Response {
    let painter = ui.painter().with_clip_rect(frame.rect);
    painter.rect_filled(frame.rect, 0.0, theme::BACKGROUND);
    if let Some(picture) = picture {
        painter.image(
            picture.texture,
            frame.rect,
            visible_part(picture.size_px, frame.aspect()),
            Color32::WHITE,
        );
    }
    let response = ui.interact(frame.rect, ui.scope_id().with("view"), Sense::click_and_drag());
    ui.ctx().accesskit_node_builder(response.id, |node| {
        node.set_role(egui::accesskit::Role::Canvas);
        node.set_label("View");
    });
    response
}

/// The central part of a picture with the area's aspect, in texture coordinates.
///
/// After a change of size, the old picture fills the area undistorted until the new one exists.
fn visible_part(size_px: [u32; 2], aspect: f64) -> Rect {
    let [width, height] = size_px.map(|side| f64::from(side.max(1)));
    let ratio = (width / height / aspect) as f32;
    let (u, v) = if (ratio - 1.0).abs() < 0.01 {
        (1.0, 1.0)
    } else {
        ((1.0 / ratio).min(1.0), ratio.min(1.0))
    };
    Rect::from_center_size(pos2(0.5, 0.5), egui::vec2(u, v))
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::vec2;

    #[test]
    fn areas_are_rounded_to_whole_pixels() {
        let area = Rect::from_min_size(pos2(0.0, 0.0), vec2(361.3, 640.7));
        for scale in [0.75, 1.0, 1.25, 1.5, 2.0, 2.625, 3.0] {
            let (rect, size) = snap_to_pixels(area, scale);
            assert!((rect.width() * scale - size[0] as f32).abs() < 1e-2);
            assert!((rect.height() * scale - size[1] as f32).abs() < 1e-2);
        }
    }

    #[test]
    fn areas_are_neither_empty_nor_too_large() {
        let empty = Rect::from_min_size(pos2(10.0, 10.0), vec2(0.0, -5.0));
        assert_eq!(snap_to_pixels(empty, 1.0).1, [1, 1]);
        let huge = Rect::from_min_size(pos2(0.0, 0.0), vec2(20_000.0, 9_000.0));
        assert_eq!(snap_to_pixels(huge, 1.0).1, [MAX_VIEW_SIDE_PX; 2]);
    }

    #[test]
    fn an_old_picture_is_cropped_not_stretched() {
        assert_eq!(
            visible_part([800, 600], 4.0 / 3.0),
            Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0))
        );
        let tall = visible_part([800, 400], 1.0);
        assert_eq!((tall.width(), tall.height()), (0.5, 1.0));
        let wide = visible_part([400, 800], 1.0);
        assert_eq!((wide.width(), wide.height()), (1.0, 0.5));
    }
}
