//! The shell's message over the picture.

use egui::{Align2, Color32, Margin, Rect, Ui, text::LayoutJob, vec2};

use super::{
    action::Action,
    display_inputs::Notice,
    icon::{Icon, icon_button},
    theme,
};

/// Height of the view that is no text of the notice: margins and the edge, in points.
const AROUND: f32 = 40.0;

/// Shows `notice` at the upper edge of `view`, as much of its text as has room.
pub fn show(ui: &Ui, notice: Option<&Notice>, view: Option<Rect>, actions: &mut Vec<Action>) {
    let (Some(notice), Some(view)) = (notice, view) else {
        return;
    };
    let width = (view.width() - 24.0).clamp(120.0, 460.0);
    egui::Area::new(egui::Id::unique("notice"))
        .fixed_pos(view.center_top() + vec2(0.0, 12.0))
        .pivot(Align2::CENTER_TOP)
        .constrain_to(view)
        .show(ui.ctx(), |ui| {
            let edge = if notice.is_error { theme::ERROR } else { theme::ACCENT };
            egui::Frame::new()
                .fill(theme::PANEL)
                .stroke(egui::Stroke::new(1.0, edge))
                .corner_radius(8)
                .inner_margin(Margin { left: 12, right: 6, top: 6, bottom: 6 })
                .show(ui, |ui| {
                    ui.horizontal(|ui| {
                        let color = if notice.is_error { theme::ERROR } else { Color32::WHITE };
                        let font = egui::FontId::proportional(13.5);
                        let row_height = ui.fonts_mut(|fonts| fonts.row_height(&font));
                        let text = notice.text.clone();
                        let mut job = LayoutJob::simple(text, font, color, width - 52.0);
                        let rows = (view.height() - AROUND) / row_height;
                        job.wrap.max_rows = (rows as usize).max(1);
                        let text = ui.painter().layout_job(job);
                        let size = vec2(text.size().x, text.size().y.max(28.0));
                        let (rect, shown) = ui.allocate_exact_size(size, egui::Sense::hover());
                        ui.ctx().accesskit_node_builder(shown.id, |node| {
                            node.set_role(egui::accesskit::Role::Alert);
                            node.set_label(notice.text.as_str());
                        });
                        let at = rect.left_center() - vec2(0.0, text.size().y / 2.0);
                        ui.painter().galley(at, text, color);
                        let dismiss = icon_button(ui, Icon::Cross, "Dismiss", "Close this message");
                        if dismiss.clicked() {
                            actions.push(Action::DismissNotice);
                        }
                    });
                });
        });
}
