//! One frame of the page: show the interface, do what it asks for, draw the picture.
//!
//! In: eframe's calls. Out: compute work, downloads, and a request for another frame only while
//! there is something left to do: an idle page draws nothing.

use std::{cell::RefCell, rc::Rc, sync::Arc};

use super::{
    files,
    loss::Caution,
    mailbox::{Mailbox, Message},
    page,
    picture::Picture,
    session::{Session, Status},
    still::{Progress, Still},
};
use crate::{
    export::StillOptions,
    gpu::Gpu,
    render::{Activity, Kernels},
    scene::document,
    ui::{Action, ExportProgress, Inputs, theme},
};

/// The app on one device.
pub struct App {
    session: Rc<RefCell<Session>>,
    adapter: String,
    kernels: Arc<Kernels>,
    picture: Picture,
    still: Option<Still>,
    progress: Option<ExportProgress>,
    gpu: Gpu,
    /// Errors of the device that the person at the page was told of.
    faults_told: u64,
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
        let kernels = Kernels::new(&gpu);
        Some(Self {
            session,
            adapter: gpu.name(),
            picture: Picture::new(kernels.clone(), state),
            kernels,
            still: None,
            progress: None,
            gpu,
            faults_told: 0,
        })
    }

    /// Does what the interface asked for.
    fn perform(&mut self, action: Action, session: &mut Session) {
        match action {
            Action::SavePicture { size_px } => self.start_still(size_px, session),
            Action::CancelExport => {
                self.still = None;
                session.say("The picture was cancelled.");
            }
            Action::SaveScene => {
                let text = document::to_json(session.interface.scene());
                let saved = files::download_text("mandelight.json", "application/json", &text);
                if let Err(reason) = saved {
                    session.complain(format!("The scene was not saved: {reason}"));
                }
            }
            Action::LoadScene => session.picker.open(),
            Action::CopyLink => session.copy_link(),
            Action::ToggleFullscreen => page::toggle_fullscreen(),
            Action::DismissNotice => session.notice = None,
        }
    }

    fn start_still(&mut self, size_px: [u32; 2], session: &mut Session) {
        let options = StillOptions::new(size_px);
        match Still::start(&self.kernels, session.interface.scene(), options) {
            Ok(still) => self.still = Some(still),
            Err(error) => session.complain(format!("The picture was not saved: {error}")),
        }
    }

    /// Takes a still a step further.
    fn step_still(&mut self, session: &mut Session) {
        let Some(still) = self.still.take() else {
            self.progress = None;
            return;
        };
        let (still, progress) = still.step(page::now_secs());
        self.still = still;
        self.progress = match progress {
            Progress::Working(done, remaining_secs) => {
                Some(ExportProgress { done: done as f32, remaining_secs })
            }
            Progress::Saved(name) => {
                session.say(format!("Saved {name}."));
                None
            }
            Progress::Failed(reason) => {
                session.complain(format!("The picture was not saved: {reason}"));
                None
            }
        };
    }

    /// Draws the scene in view. Returns whether there is more to do, and after how many seconds
    /// to look again where that is known.
    fn draw(&mut self, session: &mut Session) -> (bool, Option<f64>) {
        let now_secs = page::now_secs();
        let caution = session.caution();
        // A still has the GPU to itself, and a scene that lost it waits for a hand.
        if self.still.is_some() || caution == Caution::Paused {
            return (self.still.is_some(), None);
        }
        let interface = &session.interface;
        let settling = self.picture.resize(interface.view_size_px(), caution.scale(), now_secs);
        let busy = self.picture.draw(interface.scene(), interface.is_moving(), now_secs);
        let report = self.picture.report();
        if !busy && report.activity == Activity::Idle && report.pictures > 0 {
            session.note_finished();
        }
        (busy, settling)
    }

    fn tell(&mut self, session: &mut Session) {
        let faults = self.gpu.faults();
        if faults > std::mem::replace(&mut self.faults_told, faults) {
            session.complain(
                "The graphics card reported an error, so the picture may be wrong. A smaller window or a simpler scene may help; your scene is kept.",
            );
        }
        session.status = Status {
            report: self.picture.report(),
            texture: self.picture.texture().cloned(),
            dispatches: self.picture.dispatches(),
            frames: session.status.frames + 1,
            is_exporting: self.still.is_some(),
        };
    }
}

impl eframe::App for App {
    fn logic(&mut self, context: &egui::Context, _frame: &mut eframe::Frame) {
        let session = self.session.clone();
        let mut session = session.borrow_mut();
        self.step_still(&mut session);
        // A hidden page shows no interface, but a still goes on.
        if self.still.is_some() {
            context.request_repaint();
        }
    }

    fn ui(&mut self, ui: &mut egui::Ui, _frame: &mut eframe::Frame) {
        let session = self.session.clone();
        let session = &mut *session.borrow_mut();
        read_dropped(ui.ctx(), &session.mailbox);
        session.read_messages();
        let now_secs = page::now_secs();
        let expiring = session.expire_notice(now_secs);

        let report = self.picture.report();
        let actions = session.interface.show(
            ui,
            &Inputs {
                picture: self.picture.shown(),
                report: &report,
                export: self.progress,
                notice: session.notice.as_ref(),
                adapter: &self.adapter,
            },
        );
        hint_at_drop(ui);
        for action in actions {
            self.perform(action, session);
        }
        let (busy, settling) = self.draw(session);
        let moving = session.interface.is_moving();
        let kept = session.keeper.watch(session.interface.scene(), moving, now_secs);
        self.tell(session);

        if busy {
            ui.ctx().request_repaint();
        }
        for secs in [expiring, settling, kept].into_iter().flatten() {
            ui.ctx().request_repaint_after_secs(secs as f32);
        }
    }

    fn clear_color(&self, _visuals: &egui::Visuals) -> [f32; 4] {
        theme::BACKGROUND.to_normalized_gamma_f32()
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
        "Drop a scene, or a picture saved by Mandelight",
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
