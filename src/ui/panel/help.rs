//! The help window: keys and gestures, from the tables of [`crate::ui::shortcuts`], and licences; on touch screens gestures
//! of fingers first.

use egui::{Align2, Grid, Hyperlink, RichText, ScrollArea, Ui, vec2};

use crate::ui::{
    rects::Rects,
    shortcuts::{FLIGHT, GESTURES, SHORTCUTS, TOUCH_GESTURES},
    theme,
    widgets::{caption, window_heading},
};

/// The licences of what the page contains, beside the page.
const LICENSES: &str = "./licenses.txt";

/// Shows the help window in the centre of the screen if `open`.
pub fn help_window(ctx: &egui::Context, open: &mut bool, has_touch: bool, rects: &mut Rects) {
    if !*open {
        return;
    }
    let screen = ctx.content_rect();
    let width = (screen.width() - 40.0).min(420.0);
    let shown = egui::Window::new("Keys and gestures")
        .anchor(Align2::CENTER_CENTER, [0.0, 0.0])
        .title_bar(false)
        .resizable(false)
        .fixed_size(vec2(width, (screen.height() - 90.0).clamp(120.0, 560.0)))
        .show(ctx, |ui| {
            *open = !window_heading(ui, "Keys and gestures");
            ScrollArea::vertical().auto_shrink([false, true]).show(ui, |ui| {
                let fingers = |ui: &mut Ui| {
                    caption(ui, "With fingers");
                    table(ui, "touch gestures", width, TOUCH_GESTURES.iter().copied());
                };
                if has_touch {
                    fingers(ui);
                }
                caption(ui, "With a mouse");
                table(ui, "gestures", width, GESTURES.iter().copied());
                caption(ui, "Keys");
                let of_page =
                    [("F6", "Go to the offer of a new version, if there is one, and back")];
                let keys = SHORTCUTS.iter().filter_map(|shortcut| shortcut.help).chain(of_page);
                table(ui, "keys", width, keys);
                caption(ui, "In fly mode (keys by position, as on a US keyboard)");
                let faster = [("Shift", "Fly faster")];
                table(
                    ui,
                    "flight",
                    width,
                    FLIGHT.iter().filter_map(|flight| flight.help).chain(faster),
                );
                if !has_touch {
                    fingers(ui);
                }
                caption(ui, "About");
                let licenses = "Licences of the software and fonts in this page";
                let link = Hyperlink::from_label_and_url(licenses, LICENSES).open_in_new_tab(true);
                ui.add_sized(vec2(ui.available_width(), ui.spacing().interact_size.y), link);
            });
        });
    if let Some(shown) = shown {
        rects.record("help window", &shown.response);
    }
}

fn table(
    ui: &mut Ui,
    id: &str,
    width: f32,
    lines: impl Iterator<Item = (&'static str, &'static str)>,
) {
    let first = (width * 0.4).min(160.0);
    Grid::new(id)
        .num_columns(2)
        .spacing([10.0, 4.0])
        .min_col_width(first)
        .max_col_width(width - first - 40.0)
        .show(ui, |ui| {
            for (keys, what) in lines {
                ui.label(RichText::new(keys).color(theme::ACCENT));
                ui.add(egui::Label::new(what).wrap());
                ui.end_row();
            }
        });
}
