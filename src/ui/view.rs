//! The picture's area: drawing of the picture, and its size in pixels.

use egui::{Color32, Context, EventFilter, Id, Rect, Sense, Stroke, StrokeKind, Ui, pos2};

use super::{
    display_inputs::{KeptPicture, ViewTexture},
    frame::Frame,
    theme,
};

/// Maximum width or height of the view, in pixels (WebGPU's default texture limit).
pub const MAX_VIEW_SIDE_PX: u32 = 8192;

fn id() -> Id {
    Id::unique("view")
}

/// True if the view has the keyboard, of which it takes the arrow keys.
pub fn has_focus(context: &Context) -> bool {
    context.memory(|memory| memory.has_focus(id()))
}

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

/// Draws the picture over `frame`, the kept one on top, and returns the area's pointer response.
///
/// `is_stereo` is true if the picture holds both eyes.
pub fn show(
    ui: &Ui,
    frame: Frame,
    picture: Option<ViewTexture>,
    kept: Option<KeptPicture>,
    is_stereo: bool,
) -> egui::Response {
    let painter = ui.painter().with_clip_rect(frame.rect);
    let newest = picture.map(|picture| KeptPicture { picture, span: 1.0 });
    let pictures = newest.into_iter().chain(kept).map(|KeptPicture { picture, span }| {
        // The pictures of both eyes have their own places.
        let at = if is_stereo { frame.rect } else { placed(picture.size_px, span, frame) };
        (picture.texture, at)
    });
    let pictures: Vec<_> = pictures.collect();
    // What a picture covers is not painted: on a slow GPU, each layer of a large window takes long.
    let lowest = pictures.iter().rposition(|(_, at)| at.contains_rect(frame.rect));
    if lowest.is_none() {
        painter.rect_filled(frame.rect, 0.0, theme::BACKGROUND);
    }
    for &(texture, at) in &pictures[lowest.unwrap_or(0)..] {
        let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
        painter.image(texture, at, whole, Color32::WHITE);
    }
    let response = ui.interact(frame.rect, id(), Sense::click_and_drag());
    if response.has_focus() {
        let ring = Stroke::new(2.0, theme::ACCENT);
        painter.rect_stroke(frame.rect, 0.0, ring, StrokeKind::Inside);
        // Without the filter, the arrow keys would move the focus.
        let arrows =
            EventFilter { horizontal_arrows: true, vertical_arrows: true, ..Default::default() };
        ui.memory_mut(|memory| memory.set_focus_lock_filter(id(), arrows));
    }
    ui.ctx().accesskit_node_builder(response.id, |node| {
        node.set_role(egui::accesskit::Role::Canvas);
        node.set_label("View");
    });
    response
}

/// Where a picture of this size shows what the picture of `frame` will show, in the window.
///
/// The camera's angle spans a picture's shorter side, or the part `span` of that side in a picture
/// that shows more. So pictures of a scene agree in this length. A picture of another shape than the frame's sticks out of the frame, or leaves its edges free.
fn placed(size_px: [u32; 2], span: f32, frame: Frame) -> Rect {
    let [width, height] = size_px.map(|side| side.max(1) as f32);
    let points_per_px = frame.rect.width().min(frame.rect.height()) / (width.min(height) * span);
    let size = egui::vec2(width, height) * points_per_px;
    if (size - frame.rect.size()).abs().max_elem() < 0.5 {
        return frame.rect;
    }
    let pixel = frame.rect.height() / frame.height_px.max(1) as f32;
    let corner = (frame.rect.center() - size / 2.0 - frame.rect.min) / pixel;
    // On whole pixels, a picture that is not scaled stays sharp.
    let is_scaled = (points_per_px / pixel - 1.0).abs() > 1e-3;
    let corner = if is_scaled { corner } else { corner.round() };
    Rect::from_min_size(frame.rect.min + corner * pixel, size)
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
    fn a_picture_of_another_size_shows_the_scene_in_the_same_places() {
        let rect = Rect::from_min_size(pos2(10.0, 20.0), vec2(1280.0, 690.0));
        let frame = Frame { rect, height_px: 690 };
        assert_eq!(placed([1280, 690], 1.0, frame), rect);
        assert_eq!(placed([640, 345], 1.0, frame), rect, "a smaller one of the same shape");
        // The picture beside an open panel is the middle of the one without.
        let beside = placed([976, 690], 1.0, frame);
        assert_eq!(beside, Rect::from_min_size(pos2(10.0 + 152.0, 20.0), vec2(976.0, 690.0)));
        // On a phone the angle spans the width.
        let rect = Rect::from_min_size(pos2(0.0, 0.0), vec2(390.0, 600.0));
        let below = placed([390, 350], 1.0, Frame { rect, height_px: 600 });
        assert!((below.width() - 390.0 * 390.0 / 350.0).abs() < 1e-3);
        assert!((below.center() - rect.center()).length() < 1e-3);
        let tall = placed([390, 700], 1.0, Frame { rect, height_px: 600 });
        assert_eq!(tall, Rect::from_min_size(pos2(0.0, -50.0), vec2(390.0, 700.0)));
        // A picture that shows twice as much is twice as large.
        let more = placed([100, 100], 0.5, Frame { rect, height_px: 600 });
        assert_eq!(more.size(), vec2(780.0, 780.0));
        assert!((more.center() - rect.center()).length() < 1e-3);
    }
}
