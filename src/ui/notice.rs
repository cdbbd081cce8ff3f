//! Messages over the picture: the shell's, and files that are being read or saved.

use egui::{
    Align2, Color32, Margin, Rect, Response, Ui, accesskit::Role, pos2, text::LayoutJob, vec2,
};

use super::{
    action::Action,
    display_inputs::{DisplayInputs, ExportProgress, Notice},
    icon::{Icon, icon_button},
    rects::Rects,
    status::duration_text,
    theme,
};

/// Height of the view that is no text of the message: margins and the edge, in points.
const AROUND: f32 = 40.0;
/// Least height of a message's row, in points.
const ROW: f32 = 28.0;
/// Distance from the picture's upper edge, and between messages, in points.
const GAP: f32 = 12.0;
/// Room for the cross, in points.
const CROSS_WIDTH: f32 = 52.0;
/// Room for the button of an offer, in points.
const OFFER_WIDTH: f32 = 130.0;

/// What the button to cancel an export does.
pub(super) const CANCEL_HELP: &str = "Stop the export; no file is saved";

/// How far an export is, in words.
pub(super) fn saving_text(progress: ExportProgress) -> String {
    match progress.remaining_secs {
        Some(secs) => format!("Saving, {} left", duration_text(secs)),
        None => "Saving…".to_owned(),
    }
}

/// Shows the messages of `inputs` at the upper edge of `view`, or below the bar of a comparison, which is drawn before.
pub fn show(
    ui: &Ui,
    inputs: &DisplayInputs<'_>,
    view: Option<Rect>,
    actions: &mut Vec<Action>,
    rects: &mut Rects,
) {
    let Some(view) = view else { return };
    let compare = rects.get("compare").map(|bar| bar.bottom());
    let mut top = compare.unwrap_or(view.top()) + GAP;
    if let Some(Notice { text, is_error, offer }) = inputs.notice {
        let (text_color, edge) =
            if *is_error { (theme::ERROR, theme::ERROR) } else { (Color32::WHITE, theme::ACCENT) };
        let buttons_width = if offer.is_some() { CROSS_WIDTH + OFFER_WIDTH } else { CROSS_WIDTH };
        let role = Role::Alert;
        let message = Message { id: "notice", role, text, text_color, edge, top, buttons_width };
        let shown = message.show(ui, view, |ui| {
            if let Some(offer) = offer
                && ui.button(*offer).clicked()
            {
                actions.push(Action::TakeOffer);
            }
            if icon_button(ui, Icon::Cross, "Dismiss", "Close this message").clicked() {
                actions.push(Action::DismissNotice);
            }
        });
        rects.record("notice", &shown);
        top = shown.rect.bottom() + GAP;
    }
    let mut progress = |id: &'static str, text: &str, help: &str, rects: &mut Rects| {
        let (text_color, edge) = (Color32::WHITE, theme::LINE);
        let (role, buttons_width) = (Role::Status, CROSS_WIDTH);
        let message = Message { id, role, text, text_color, edge, top, buttons_width };
        let mut cancel = None;
        let shown = message
            .show(ui, view, |ui| cancel = Some(icon_button(ui, Icon::Cross, "Cancel", help)));
        rects.record(id, &shown);
        top = shown.rect.bottom() + GAP;
        cancel
    };
    if let Some(name) = inputs.reading {
        let cancel =
            progress("reading", &format!("Reading {name}…"), "Stop reading this file", rects);
        if cancel.is_some_and(|cancel| cancel.clicked()) {
            actions.push(Action::CancelReading);
        }
    }
    // Where neither the panel nor the timeline, which are drawn before, shows it.
    if let Some(export) = inputs.export.filter(|_| rects.get("cancel export").is_none()) {
        let cancel = progress("saving", &saving_text(export), CANCEL_HELP, rects);
        if let Some(cancel) = cancel {
            rects.record("cancel export", &cancel);
            if cancel.clicked() {
                actions.push(Action::CancelExport);
            }
        }
    }
}

/// A framed text with buttons.
struct Message<'a> {
    id: &'static str,
    role: Role,
    text: &'a str,
    text_color: Color32,
    edge: Color32,
    /// Its upper edge.
    top: f32,
    buttons_width: f32,
}

impl Message<'_> {
    /// Shows the message at the middle of `view`, with `buttons` on its right: as much of its text as has room.
    fn show(&self, ui: &Ui, view: Rect, buttons: impl FnOnce(&mut Ui)) -> Response {
        let width = (view.width() - 24.0).clamp(120.0, 460.0);
        let area = egui::Area::new(egui::Id::unique(self.id))
            .fixed_pos(pos2(view.center().x, self.top))
            .pivot(Align2::CENTER_TOP)
            .constrain_to(view);
        // For fingers, the buttons are higher than the row.
        let larger = (ui.spacing().interact_size.y - ROW).max(0.0);
        let shown = area.show(ui.ctx(), |ui| {
            let margin = Margin { left: 12, right: 6, top: 6, bottom: 6 };
            let frame = egui::Frame::new().fill(theme::PANEL).corner_radius(8).inner_margin(margin);
            frame.stroke(egui::Stroke::new(1.0, self.edge)).show(ui, |ui| {
                ui.horizontal(|ui| {
                    let font = egui::FontId::proportional(13.5);
                    // Twice: once for the cross, once for wider gaps.
                    let room = width - self.buttons_width - 2.0 * larger;
                    let row_height = ui.fonts_mut(|fonts| fonts.row_height(&font));
                    let text = self.text.to_owned();
                    let mut job = LayoutJob::simple(text, font, self.text_color, room);
                    let rows = (view.bottom() - self.top - AROUND + GAP) / row_height;
                    job.wrap.max_rows = (rows as usize).max(1);
                    let text = ui.painter().layout_job(job);
                    let size = vec2(text.size().x, text.size().y.max(ROW + larger));
                    let (rect, shown) = ui.allocate_exact_size(size, egui::Sense::hover());
                    ui.ctx().accesskit_node_builder(shown.id, |node| {
                        node.set_role(self.role);
                        node.set_label(self.text);
                    });
                    let at = rect.left_center() - vec2(0.0, text.size().y / 2.0);
                    ui.painter().galley(at, text, self.text_color);
                    buttons(ui);
                });
            });
        });
        shown.response
    }
}
