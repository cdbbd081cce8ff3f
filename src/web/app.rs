//! One frame of the page: shows the interface, performs its actions, updates the engine.
//!
//! In: eframe's calls. Out: downloads, work for the engine, repaint requests. An idle page requests no
//! repaint and so draws nothing.

use std::{cell::RefCell, rc::Rc, sync::Arc};

use super::{
    accessibility,
    address::Address,
    engine::Engine,
    exporter::Exporter,
    files, gallery,
    image_decoder::ImageDecoder,
    mailbox::{Mailbox, Message},
    opening::{self, Opening},
    page, scene_watch,
    session::Session,
    video_support::VideoSupport,
    view_picture::{self, ViewPicture},
};
use crate::{
    gpu::Gpu,
    scene::document,
    ui::{
        Action, DisplayInputs, GalleryState, KeptPicture, Sharing, file_progress::SceneUse, theme,
    },
};

/// The app on one device.
pub struct App {
    adapter_name: String,
    engine: Rc<RefCell<Engine>>,
    session: Rc<RefCell<Session>>,
    /// The page's address without a fragment.
    address: String,
    has_share_sheet: bool,
    video_support: VideoSupport,
    /// The picture that the page opened with, while the view has no better one.
    opening: Option<Opening>,
}

impl App {
    /// An app on `gpu` that continues the exports of `exporter`; `None` if egui runs without wgpu.
    pub fn new(
        context: &eframe::CreationContext<'_>,
        gpu: Gpu,
        session: Rc<RefCell<Session>>,
        exporter: Option<Exporter>,
    ) -> Option<Self> {
        let render_state = context.wgpu_render_state.clone()?;
        theme::install(&context.egui_ctx);
        context.egui_ctx.add_image_loader(Arc::new(ImageDecoder::default()));
        accessibility::connect(&context.egui_ctx);
        session.borrow().mailbox.set_context(&context.egui_ctx);
        let adapter_name = gpu.name();
        let egui = context.egui_ctx.clone();
        let engine = Engine::new(gpu, render_state, egui, session.clone(), exporter);
        let opening = Opening::of_document(&context.egui_ctx, session.borrow().interface.scene());
        let address = Address::with_fragment("").unwrap_or_default();
        let address = address.trim_end_matches('#').to_owned();
        let has_share_sheet = view_picture::has_share_sheet();
        let video_support = VideoSupport::default();
        Some(Self {
            adapter_name,
            engine,
            session,
            address,
            has_share_sheet,
            video_support,
            opening,
        })
    }

    /// The opening picture, if it is still of use; otherwise removes it.
    fn opening_picture(opening: &mut Option<Opening>, session: &Session) -> Option<KeptPicture> {
        let scene = session.interface.shown_scene();
        let is_of_use = opening.as_ref()?.is_of_use(scene, &session.status.report);
        if !is_of_use {
            *opening = None;
            opening::remove_from_document(true);
        }
        opening.as_ref()?.shown()
    }
}

impl eframe::App for App {
    fn ui(&mut self, ui: &mut egui::Ui, _frame: &mut eframe::Frame) {
        let session = &mut *self.session.borrow_mut();
        let engine = &mut *self.engine.borrow_mut();
        read_dropped_files(ui.ctx(), &session.mailbox);
        session.read_messages();
        let now_secs = page::now_secs();
        let notice_secs = session.expire_notice(now_secs);

        let opening = Self::opening_picture(&mut self.opening, session);
        let inputs = DisplayInputs {
            picture: engine.picture(),
            kept_picture: engine.kept_picture().or(opening),
            report: &session.status.report,
            export: engine.exporter.progress(),
            notice: session.toast.notice(),
            adapter: &self.adapter_name,
            sharing: Sharing { address: &self.address, has_share_sheet: self.has_share_sheet },
            missing_encoders: self.video_support.missing(),
            reading: session.decoder.slow_file(now_secs),
            gallery: session.gallery.as_ref(),
            reduced_motion: page::prefers_reduced_motion(),
            small_pictures: engine.small_textures(),
        };
        let actions = session.interface.show(ui, &inputs);
        self.video_support.check(session.interface.video(), &session.mailbox);
        if let Some(opening) = &mut self.opening {
            opening.hand_over();
        }
        show_drop_hint(ui);
        for action in actions {
            perform(action, engine, session);
        }

        let engine_secs = engine.update(session);
        let moving = session.interface.is_moving();
        let autosave_secs = session.autosave.update(session.interface.editor(), moving, now_secs);
        // After autosave, whose scene has a picture already where the view rests.
        if engine.is_sharp() {
            scene_watch::note_picture();
        }
        session.save_favourites();
        session.show_storage_notice();
        session.status.frames += 1;
        for secs in [notice_secs, engine_secs, autosave_secs].into_iter().flatten() {
            ui.ctx().request_repaint_after_secs(secs as f32);
        }
    }

    fn clear_color(&self, _visuals: &egui::Visuals) -> [f32; 4] {
        theme::BACKGROUND.to_normalized_gamma_f32()
    }
}

/// Performs an action of the interface.
fn perform(action: Action, engine: &mut Engine, session: &mut Session) {
    match action {
        Action::SavePicture { size_px, file, pair } => {
            engine.save_picture(size_px, file, pair, session);
        }
        Action::SaveSequence { size_px, frames: [first, end], format, pair } => {
            engine.exporter.request_sequence(size_px, first..end, (format, pair), session);
        }
        Action::CancelExport => {
            engine.exporter.cancel();
            session.show_notice("Saving was cancelled.");
        }
        Action::CancelReading => {
            if session.decoder.cancel() {
                session.show_notice("Reading the file was cancelled.");
            }
        }
        Action::SaveScene => {
            let text = document::project_to_json(session.interface.project());
            let saved = files::download("mandelight.json", "application/json", text.as_bytes());
            if let Err(reason) = saved {
                session.show_error(format!(
                    "The scene could not be saved. Copy a link to it instead. ({reason})"
                ));
            }
        }
        Action::LoadScene | Action::ChooseEnvironmentMap | Action::ChooseGradient => {
            session.picker.open()
        }
        Action::CopyLink => session.copy_link(),
        Action::CopyPicture | Action::KeepFavourite | Action::SharePicture => {
            match engine.view_picture(session) {
                Some(picture) => use_picture(action, picture, session),
                None => session.show_error(
                    "There is no picture yet. Wait a moment, then try again.",
                ),
            }
        }
        Action::ReportUnreadableFavourite => session.show_error(
            "This kept view cannot be read: it is damaged, or a newer Mandelight kept it. Remove it under Mine.",
        ),
        Action::OpenGalleryPicture(index) => {
            if let Some(GalleryState::Ready { address, gallery }) = &session.gallery
                && let Some(picture) = gallery.pictures.get(index)
            {
                let (name, mailbox) = (&picture.name, &session.mailbox);
                let ticket = session.decoder.reserve(name, SceneUse::FlyInto, mailbox);
                gallery::open_picture(address, picture, ticket, mailbox);
            }
        }
        Action::ToggleFullscreen => page::toggle_fullscreen(),
        Action::TakeOffer => session.take_offer(),
        Action::DismissNotice => session.dismiss_notice(),
    }
}

/// Performs an action on the picture on the screen.
fn use_picture(action: Action, picture: ViewPicture, session: &Session) {
    match action {
        Action::CopyPicture => picture.copy(&session.mailbox),
        Action::SharePicture => picture.share(&session.mailbox),
        Action::KeepFavourite => {
            let document = document::project_to_json_compact(session.interface.project());
            picture.keep(document, &session.mailbox);
        }
        _ => {}
    }
}

/// Shows which files can be dropped while one is dragged over the page.
fn show_drop_hint(ui: &egui::Ui) {
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
        "Drop a scene, a picture saved by Mandelight, an environment map (.hdr, .exr), or gradients (.ggr, .gpl, .map, .ugr)",
        egui::FontId::proportional(18.0),
        egui::Color32::WHITE,
    );
}

/// Reads the file that was dropped on the page.
fn read_dropped_files(context: &egui::Context, mailbox: &Mailbox) {
    let dropped = context.input(|input| input.raw.dropped_files.clone());
    match dropped.as_slice() {
        [] => {}
        [file] => {
            if let Some(file) = file.web_file() {
                mailbox.post(Message::File(file.clone()));
            }
        }
        _ => mailbox.post(Message::Error("Drop one file at a time.".to_owned())),
    }
}
