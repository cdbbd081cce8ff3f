//! The page's GPU work, which continues between frames of the interface.
//!
//! In: the session's scene and view size, once a frame. Out: pictures, exports, and repaint requests
//! when something new is visible. A timer drives the work, so that the GPU works between slow frames and
//! refinement doesn't redraw the panels. A hidden page draws no frames: there, each finished piece
//! of work starts the next.

use std::{
    cell::RefCell,
    rc::{Rc, Weak},
    time::Duration,
};

use eframe::egui_wgpu::RenderState;

use super::{
    exporter::Exporter,
    live_view::LiveView,
    page,
    session::{AppStatus, Session},
    small_pictures::SmallPictures,
    view_picture::ViewPicture,
};
use crate::{
    gpu::Gpu,
    render::{Activity, Pipelines, Report},
    ui::{self, SmallTextures, StillFile, StillFormat, loss_policy::SafeMode},
};

/// Milliseconds between two ticks: the shortest timer that browsers allow.
const TICK_MS: i32 = 4;

/// Shortest seconds between repaints that show only new numbers; longer where frames take longer.
const REPORT_EVERY_SECS: f64 = 0.2;

/// Delay of a requested frame: above zero, because egui draws two frames for a request without one.
const FRAME_DELAY: Duration = Duration::from_millis(1);

/// Frames until a new activity is on the screen. Compilation waits for that, to be announced first.
const FRAMES_PER_ACTIVITY: u32 = 2;

thread_local! {
    /// The running engine. GPU callbacks must be `Send`, so they can't own the engine.
    static ENGINE: RefCell<Weak<RefCell<Engine>>> = const { RefCell::new(Weak::new()) };
}

/// The GPU work on one device.
pub struct Engine {
    /// The exports, which take the GPU before the view.
    pub exporter: Exporter,
    gpu: Gpu,
    view: LiveView,
    small_pictures: SmallPictures,
    context: egui::Context,
    /// Whether a tick is scheduled.
    is_tick_scheduled: bool,
    /// Whether the interface has drawn a frame since the last tick.
    has_drawn: bool,
    /// The activity of the last repaint request.
    shown_activity: Activity,
    /// Repaints still to request for that activity.
    frames_due: u32,
    /// Whether a frame is to be drawn as soon as the view allows one.
    is_frame_due: bool,
    /// The report's number of pictures when the last frame was painted.
    pictures_drawn: u64,
    /// Whether the last step left work.
    was_busy: bool,
    /// Whether the last step was the view's, and no export's or small picture's.
    is_view_drawn: bool,
    repainted_at_secs: f64,
    /// The number of device errors at the last notice.
    errors_shown: u64,
    session: Rc<RefCell<Session>>,
}

impl Engine {
    /// An engine that continues the exports of `exporter`. It replaces the one of the lost device.
    pub fn new(
        gpu: Gpu,
        render_state: RenderState,
        context: egui::Context,
        session: Rc<RefCell<Session>>,
        exporter: Option<Exporter>,
    ) -> Rc<RefCell<Self>> {
        let pipelines = Pipelines::new(&gpu);
        let models = session.borrow().interface.models().clone();
        let mut exporter = exporter.unwrap_or_else(|| Exporter::new(pipelines.clone()));
        exporter.resume_on(&pipelines, &mut session.borrow_mut());
        let engine = Rc::new(RefCell::new(Self {
            exporter,
            gpu,
            view: LiveView::new(pipelines.clone(), render_state.clone(), &models),
            small_pictures: SmallPictures::new(pipelines, render_state),
            context,
            is_tick_scheduled: false,
            has_drawn: false,
            shown_activity: Activity::Idle,
            frames_due: 0,
            is_frame_due: false,
            pictures_drawn: 0,
            was_busy: false,
            is_view_drawn: false,
            repainted_at_secs: 0.0,
            errors_shown: 0,
            session,
        }));
        ENGINE.with(|slot| slot.replace(Rc::downgrade(&engine)));
        engine
    }

    /// The picture for egui; `None` before the first one.
    pub fn picture(&self) -> Option<ui::ViewTexture> {
        self.view.shown()
    }

    /// True once the first sharp picture of the newest scene is complete.
    pub fn is_sharp(&self) -> bool {
        self.view.is_sharp()
    }

    /// The picture from before a change of size, until the newest is as good.
    pub fn kept_picture(&self) -> Option<ui::KeptPicture> {
        self.view.kept()
    }

    /// The picture on the screen with its scene, once there is one.
    pub fn view_picture(&self, session: &Session) -> Option<ViewPicture> {
        Some(self.with_scene(self.view.texture()?, session))
    }

    /// Saves a picture of the edited scene; with `pair`, each eye is a file.
    ///
    /// What the view has finished of the same picture is not rendered again.
    pub fn save_picture(
        &mut self,
        size_px: [u32; 2],
        file: StillFile,
        pair: bool,
        session: &mut Session,
    ) {
        let is_of_display =
            file.format != StillFormat::Exr && !file.is_deep() && !file.is_transparent() && !pair;
        let same = if is_of_display { self.finished_picture(session, size_px) } else { None };
        match same {
            Some(picture) => picture.save(file, &session.mailbox),
            None => self.exporter.start_still(size_px, (file, pair), self.view.view(), session),
        }
    }

    /// The picture on the screen, if a still of `size_px` of the edited scene would be the same.
    fn finished_picture(&self, session: &Session, size_px: [u32; 2]) -> Option<ViewPicture> {
        let scene = session.interface.scene();
        if session.interface.shown_scene() != scene {
            return None;
        }
        let texture = self.view.finished(scene, size_px)?;
        Some(self.with_scene(texture, session))
    }

    fn with_scene(&self, texture: &wgpu::Texture, session: &Session) -> ViewPicture {
        ViewPicture::new(&self.gpu, texture, session.interface.shown_scene().clone())
    }

    /// The small pictures that are finished.
    pub fn small_textures(&self) -> &SmallTextures {
        self.small_pictures.textures()
    }

    /// Applies this frame's scene and view size, and starts the work. Returns the seconds until the
    /// next call is due, if that is known.
    pub fn update(&mut self, session: &mut Session) -> Option<f64> {
        let now_secs = page::now_secs();
        self.view.free_discarded();
        self.pictures_drawn = session.status.report.pictures;
        self.is_frame_due = false;
        self.exporter.start_requested_sequence(session);
        let scale = session.update_safe_mode().scale();
        let interface = &session.interface;
        let scene = interface.shown_scene();
        let settling_secs = self.view.resize(scene, interface.view_size_px(), scale, now_secs);
        self.view.note_frame();
        if self.context.input(ui::shortcuts::wants_answer) {
            self.view.note_input(now_secs);
        }
        self.view.set_environment_map(interface.environment_map());
        self.view.set_scene(interface.shown_scene(), interface.is_moving());
        self.view.watch_histogram(interface.wants_histogram());
        self.small_pictures.want(interface.small_pictures());
        self.small_pictures.set_environment_map(interface.environment_map());
        self.small_pictures.note_frame();
        let busy = self.step(session, now_secs);
        if busy {
            self.schedule_tick();
        } else if self.was_busy {
            // This frame was painted before its last picture was there.
            self.context.request_repaint_after(FRAME_DELAY);
        }
        self.was_busy = busy;
        self.has_drawn = true;
        self.frames_due = self.frames_due.saturating_sub(1);
        settling_secs
    }

    /// Submits as much work as fits now. Returns whether more is left.
    fn step(&mut self, session: &mut Session, now_secs: f64) -> bool {
        self.is_view_drawn = false;
        let busy = if self.exporter.is_busy() {
            self.exporter.step(session, now_secs);
            // The view waited for the export, so it may have work left.
            true
        } else if session.update_safe_mode() == SafeMode::Paused {
            false
        } else if self.is_turn_of_small_pictures(session) {
            if self.small_pictures.pump(now_secs) {
                self.context.request_repaint_after(FRAME_DELAY);
            }
            if self.small_pictures.is_compiling() {
                self.view.pump(now_secs);
            }
            // The view waited, so it may have work left.
            true
        } else {
            self.is_view_drawn = true;
            let busy = self.view.pump(now_secs) || self.small_pictures.has_work();
            let report = self.view.report();
            if !busy && report.is_finished() {
                session.note_complete_picture();
            }
            busy
        };
        self.show_gpu_errors(session);
        session.status = AppStatus {
            report: self.view.report(),
            texture: self.view.texture().cloned(),
            dispatches: self.view.dispatches(),
            frames: session.status.frames,
            small_pictures: self.small_pictures.textures().by_id.len(),
            has_small_pictures_left: self.small_pictures.has_work(),
            ui_textures: self.context.tex_manager().read().num_allocated(),
            exported: self.exporter.progress().map(|progress| progress.done),
        };
        busy
    }

    /// Whether a small picture is drawn now: only while nothing moves and the view's picture is sharp.
    fn is_turn_of_small_pictures(&self, session: &Session) -> bool {
        self.small_pictures.has_work() && self.view.is_sharp() && !session.interface.is_moving()
    }

    /// Shows a notice where the device has reported new errors.
    fn show_gpu_errors(&mut self, session: &mut Session) {
        let errors = self.gpu.faults();
        if errors > std::mem::replace(&mut self.errors_shown, errors) {
            session.show_error(
                "The graphics card reported an error, so the picture may be wrong. Your scene is saved. Make the window smaller or the scene simpler.",
            );
        }
    }

    /// Schedules the next [`tick`], unless one is scheduled.
    fn schedule_tick(&mut self) {
        if std::mem::replace(&mut self.is_tick_scheduled, true) {
            return;
        }
        if page::is_hidden() {
            // Browsers slow the timers of hidden pages down, but not the GPU's callbacks.
            self.gpu.queue.on_submitted_work_done(tick);
        } else {
            page::after_ms(TICK_MS, tick);
        }
    }

    /// Requests a repaint where something new is to be shown.
    fn request_repaint(&mut self, busy: bool, report: &Report) {
        let now_secs = page::now_secs();
        if report.activity != self.shown_activity {
            self.shown_activity = report.activity.clone();
            self.frames_due = FRAMES_PER_ACTIVITY;
        }
        let is_new = report.pictures != self.pictures_drawn || self.frames_due > 0 || !busy;
        let report_every_secs = REPORT_EVERY_SECS.max(report.frame_interval_secs);
        self.is_frame_due |= is_new || now_secs - self.repainted_at_secs > report_every_secs;
        // While the view does not draw, it does not learn what has ended either.
        let may_wait = self.is_view_drawn && busy;
        if self.is_frame_due && (!may_wait || self.view.request_frame(now_secs)) {
            self.is_frame_due = false;
            self.repainted_at_secs = now_secs;
            self.context.request_repaint_after(FRAME_DELAY);
        }
    }
}

/// The exports of the running engine, which then has none.
pub fn take_exporter() -> Option<Exporter> {
    let engine = ENGINE.with(|slot| slot.borrow().upgrade())?;
    let engine = &mut *engine.try_borrow_mut().ok()?;
    let idle = engine.exporter.idle();
    Some(std::mem::replace(&mut engine.exporter, idle))
}

/// Advances the running engine between frames.
fn tick() {
    let Some(engine) = ENGINE.with(|slot| slot.borrow().upgrade()) else { return };
    // The event loop runs callbacks between frames, so nobody else borrows these.
    let Ok(mut engine) = engine.try_borrow_mut() else { return };
    let session = engine.session.clone();
    let Ok(mut session) = session.try_borrow_mut() else { return };
    engine.is_tick_scheduled = false;
    // Timed before this tick submits work, which would be counted as the frame's.
    if std::mem::take(&mut engine.has_drawn) {
        let is_only_work = engine.is_view_drawn;
        engine.view.time_frame(is_only_work, page::now_secs());
    }
    let busy = engine.step(&mut session, page::now_secs());
    engine.request_repaint(busy, &session.status.report);
    engine.was_busy = busy;
    if busy {
        engine.schedule_tick();
    }
}
