//! One frame of the page: show the interface, do what it asks for, pass its scene on.
//!
//! In: eframe's calls. Out: downloads and work for the engine. Another frame is asked for only when
//! there is something to show: an idle page draws nothing.

use std::{cell::RefCell, rc::Rc};

use super::{
    engine::Engine,
    files,
    mailbox::{Mailbox, Message},
    page,
    session::Session,
};
use crate::{
    export::PictureFormat,
    gpu::Gpu,
    scene::document,
    ui::{Action, Inputs, theme},
};

/// The app on one device.
pub struct App {
    adapter: String,
    engine: Rc<RefCell<Engine>>,
    session: Rc<RefCell<Session>>,
}

impl App {
    /// An app on `gpu`; none where egui was started without wgpu.
    pub fn new(
        context: &eframe::CreationContext<'_>,
        gpu: Gpu,
        session: Rc<RefCell<Session>>,
    ) -> Option<Self> {
        let state = context.wgpu_render_state.clone()?;
        theme::install(&context.egui_ctx);
        session.borrow().mailbox.wakes(&context.egui_ctx);
        let adapter = gpu.name();
        let engine = Engine::new(gpu, state, context.egui_ctx.clone(), session.clone());
        Some(Self { adapter, engine, session })
    }
}

impl eframe::App for App {
    fn ui(&mut self, ui: &mut egui::Ui, _frame: &mut eframe::Frame) {
        let session = &mut *self.session.borrow_mut();
        let engine = &mut *self.engine.borrow_mut();
        read_dropped(ui.ctx(), &session.mailbox);
        session.read_messages();
        let now_secs = page::now_secs();
        let expiring = session.expire_notice(now_secs);

        let inputs = Inputs {
            picture: engine.shown(),
            report: &session.status.report,
            export: engine.progress(),
            notice: session.notice.as_ref(),
            adapter: &self.adapter,
        };
        let actions = session.interface.show(ui, &inputs);
        hint_at_drop(ui);
        for action in actions {
            perform(action, engine, session);
        }

        let settling = engine.follow(session);
        let moving = session.interface.is_moving();
        let kept = session.autosave.watch(session.interface.project(), moving, now_secs);
        session.status.frames += 1;
        for secs in [expiring, settling, kept].into_iter().flatten() {
            ui.ctx().request_repaint_after_secs(secs as f32);
        }
    }

    fn clear_color(&self, _visuals: &egui::Visuals) -> [f32; 4] {
        theme::BACKGROUND.to_normalized_gamma_f32()
    }
}

/// Does what the interface asked for.
fn perform(action: Action, engine: &mut Engine, session: &mut Session) {
    match action {
        Action::SavePicture { size_px, exr, pair } => {
            let format = if exr { PictureFormat::Exr } else { PictureFormat::Png };
            engine.start_still(size_px, format, pair, session);
        }
        Action::SaveSequence { size_px, frames: [first, end], pair } => {
            engine.start_sequence(size_px, first..end, pair, session);
        }
        Action::CancelExport => {
            engine.cancel_export();
            session.say("Saving was cancelled.");
        }
        Action::SaveScene => {
            let text = document::project_to_json(session.interface.project());
            let saved = files::download_text("mandelight.json", "application/json", &text);
            if let Err(reason) = saved {
                session.complain(format!("The scene was not saved: {reason}"));
            }
        }
        Action::LoadScene | Action::ChoosePicture => session.picker.open(),
        Action::CopyLink => session.copy_link(),
        Action::ToggleFullscreen => page::toggle_fullscreen(),
        Action::DismissNotice => session.notice = None,
    }
}

/// Says what a file that hovers over the page will do.
fn hint_at_drop(ui: &egui::Ui) {
    if ui.input(|input| input.raw.hovered_files.is_empty()) {
        return;
    }
    let layer = egui::LayerId::new(egui::Order::Foreground, egui::Id::unique("drop hint"));
    let painter = ui.ctx().layer_painter(layer);
    let area = ui.ctx().content_rect();
    painter.rect_filled(area, 0.0, theme::BACKGROUND.gamma_multiply(0.8));
    painter.text(
        area.center(),
        egui::Align2::CENTER_CENTER,
        "Drop a scene, a picture saved by Mandelight, or an environment map (.hdr, .exr)",
        egui::FontId::proportional(18.0),
        egui::Color32::WHITE,
    );
}

/// Reads the files that were dropped on the page.
fn read_dropped(context: &egui::Context, mailbox: &Mailbox) {
    let dropped = context.input(|input| input.raw.dropped_files.clone());
    match dropped.as_slice() {
        [] => {}
        [file] => {
            if let Some(file) = file.web_file() {
                files::read(file, mailbox);
            }
        }
        _ => mailbox.post(Message::Complaint("Drop one scene or picture at a time.".to_owned())),
    }
}
