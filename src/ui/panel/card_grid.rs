//! The layout of scene cards: rows in a panel, one row that scrolls sideways in a sheet.

use egui::{Rect, ScrollArea, Sense, Ui, Vec2, vec2};

use crate::ui::thumbnail;

/// Gap between cards, in points.
const GAP: f32 = 6.0;
/// Height of a card in a sheet's row, in points.
const STRIP_HEIGHT: f32 = 100.0;
/// Smallest width of a card in a row of more than two, in points.
const MIN_CARD_WIDTH: f32 = 100.0;

/// Places `count` cards: in a panel as many per row as fit, in a sheet in a row that scrolls sideways.
///
/// `show` draws the card of a number in its rectangle.
pub(super) fn arrange(
    ui: &mut Ui,
    is_sheet: bool,
    id_salt: &str,
    count: usize,
    mut show: impl FnMut(&mut Ui, usize, Rect),
) {
    let [width_px, height_px] = thumbnail::SIZE_PX.map(|side| side as f32);
    if is_sheet {
        let size = vec2((STRIP_HEIGHT * width_px / height_px).round(), STRIP_HEIGHT);
        ScrollArea::horizontal().id_salt(id_salt).show(ui, |ui| {
            let width = (size.x + GAP) * count as f32 - GAP;
            let (area, _) = ui.allocate_exact_size(vec2(width.max(0.0), size.y), Sense::hover());
            for index in 0..count {
                let at = area.min + vec2((size.x + GAP) * index as f32, 0.0);
                show(ui, index, Rect::from_min_size(at, size));
            }
        });
        return;
    }
    let width = ui.available_width();
    let fitting = ((width + GAP) / (MIN_CARD_WIDTH + GAP)).floor() as usize;
    let columns = fitting.clamp(2, 4);
    let card_width = (width - GAP * (columns - 1) as f32) / columns as f32;
    let size = vec2(card_width, (card_width * height_px / width_px).round());
    let height = (size.y + GAP) * count.div_ceil(columns) as f32 - GAP;
    let (area, _) = ui.allocate_exact_size(vec2(width, height.max(0.0)), Sense::hover());
    for index in 0..count {
        let place = vec2((index % columns) as f32, (index / columns) as f32);
        show(ui, index, Rect::from_min_size(area.min + place * (size + Vec2::splat(GAP)), size));
    }
}
