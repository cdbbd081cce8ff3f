//! The panel as a sheet at the lower edge of a narrow window, at three heights.
//!
//! The sheet opens low, with a row of large scene pictures, so that the picture has most of the
//! window. A drag of its heading changes the height; a tap switches between low and half.

use egui::{Rect, Response, Sense, Ui, WidgetInfo, accesskit::Role, vec2};

use crate::ui::{
    settings::Settings,
    sheet_height::{HEADING, SheetHeight},
    theme,
    widgets::Help as _,
};

/// Width and height of the bar in the heading that invites to drag, in points.
const BAR: [f32; 2] = [36.0, 4.0];

/// The sheet, which may be held at any height.
#[derive(Clone, Copy, Debug, Default)]
pub struct Sheet {
    /// The height during a drag, in points.
    dragged: Option<f32>,
}

impl Sheet {
    /// The sheet's height in a window of the height `window`, in points.
    pub fn height(&self, settings: &Settings, window: f32) -> f32 {
        let rest = if settings.panel_open { settings.sheet.points(window) } else { HEADING };
        self.dragged.unwrap_or(rest)
    }

    /// Changes the height by a drag or a tap of the handle.
    pub fn resize(&mut self, handle: &Response, settings: &mut Settings, window: f32) {
        if handle.drag_started() {
            self.dragged = Some(self.height(settings, window));
        }
        if let Some(height) = &mut self.dragged {
            let tallest = SheetHeight::Tall.points(window);
            *height = (*height - handle.drag_delta().y).clamp(HEADING, tallest.max(HEADING));
        }
        if (handle.drag_stopped() || !handle.dragged())
            && let Some(height) = self.dragged.take()
        {
            rest_near(settings, height, window);
        }
        if handle.clicked() {
            settings.sheet = match settings.sheet {
                SheetHeight::Low if settings.panel_open => SheetHeight::Half,
                _ => SheetHeight::Low,
            };
            settings.panel_open = true;
        }
    }
}

/// Opens the sheet at the height nearest to `height`, or closes it.
fn rest_near(settings: &mut Settings, height: f32, window: f32) {
    let away = |sheet: SheetHeight| (sheet.points(window) - height).abs();
    let nearest = SheetHeight::ALL.into_iter().min_by(|a, b| away(*a).total_cmp(&away(*b)));
    let nearest = nearest.unwrap_or_default();
    settings.panel_open = height - HEADING >= away(nearest);
    if settings.panel_open {
        settings.sheet = nearest;
    }
}

/// The area of the heading, which drags the sheet, with a bar at its top that says so.
pub fn handle(ui: &Ui, open: bool) -> Response {
    let area = ui.max_rect();
    let handle = ui.interact(area, ui.scope_id().with("handle"), Sense::click_and_drag());
    let name = if open { "Resize the panel" } else { "Open the panel" };
    handle.widget_info(|| WidgetInfo::labeled(Role::Button, true, name));
    let is_held = handle.hovered() || handle.dragged() || handle.has_focus();
    let color = if is_held { theme::TEXT } else { theme::RAISED_HOVER };
    let center = area.center_top() - vec2(0.0, 3.0);
    ui.painter().rect_filled(Rect::from_center_size(center, BAR.into()), BAR[1] / 2.0, color);
    handle.help("Drag to make the panel taller or lower")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_released_sheet_rests_at_the_nearest_height() {
        let window = 844.0;
        for (height, open, sheet) in [
            (60.0, false, SheetHeight::Low),
            (200.0, true, SheetHeight::Low),
            (430.0, true, SheetHeight::Half),
            (660.0, true, SheetHeight::Tall),
        ] {
            let mut settings = Settings::default();
            rest_near(&mut settings, height, window);
            assert_eq!((settings.panel_open, settings.sheet), (open, sheet), "{height}");
        }
    }
}
