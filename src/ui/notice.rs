//! The shell's message over the picture.

use egui::{Align2, Color32, Margin, Rect, Ui, vec2};

use super::{
    action::Action,
    display_inputs::Notice,
    icon::{Icon, icon_button},
    theme,
};

/// Room for the button of an offer, in points.
const OFFER_WIDTH: f32 = 130.0;

/// Shows `notice` at the upper edge of `view`.
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
                        let text = notice.text.clone();
                        let room = if notice.offer.is_some() { OFFER_WIDTH } else { 0.0 };
                        let text = ui.painter().layout(text, font, color, width - 52.0 - room);
                        let size = vec2(text.size().x, text.size().y.max(28.0));
                        let (rect, shown) = ui.allocate_exact_size(size, egui::Sense::hover());
                        ui.ctx().accesskit_node_builder(shown.id, |node| {
                            node.set_role(egui::accesskit::Role::Alert);
                            node.set_label(notice.text.as_str());
                        });
                        let at = rect.left_center() - vec2(0.0, text.size().y / 2.0);
                        ui.painter().galley(at, text, color);
                        if let Some(offer) = notice.offer
                            && ui.button(offer).clicked()
                        {
                            actions.push(Action::TakeOffer);
                        }
                        let dismiss = icon_button(ui, Icon::Cross, "Dismiss", "Close this message");
                        if dismiss.clicked() {
                            actions.push(Action::DismissNotice);
                        }
                    });
                });
        });
}
