//! The GPU work of the page, which goes on between frames of the interface.
//!
//! In: the scene and the view's size, once a frame. Out: pictures, stills, and a frame asked for
//! when there is something new to show. Compute is fed by a timer of its own, so that a slow frame
//! leaves no GPU idle, and a picture that refines does not redraw the panels at every step. A hidden
//! page draws no frames at all: there the end of one piece of work starts the next.

use std::{
    cell::RefCell,
    ops::Range,
    rc::{Rc, Weak},
    sync::Arc,
};

use eframe::egui_wgpu::RenderState;

use super::{
    device_loss::Caution,
    page,
    picture::Picture,
    sequence::{Sequence, ZipChoice, ZipRequest},
    session::{Session, Status},
    still::{Progress, Still},
};
use crate::{
    export::{PictureFormat, StillOptions},
    gpu::Gpu,
    render::{Activity, Pipelines, Report},
    ui::{self, ExportProgress},
};

/// Between two looks at what the GPU has finished, milliseconds: the least that browsers allow.
const TICK_MS: i32 = 4;

/// Numbers in the interface that change all the time are shown this often, seconds; less often where
/// that would take much of the GPU's time.
const TELL_EVERY_SECS: f64 = 0.2;

/// Frames after which a word is on the screen: what will be compiled waits for that.
const FRAMES_TO_TELL: u32 = 2;

thread_local! {
    /// The engine at work. Callbacks of the GPU must be `Send`, so they cannot carry it.
    static ENGINE: RefCell<Weak<RefCell<Engine>>> = const { RefCell::new(Weak::new()) };
}

/// What is on its way to a file.
enum Export {
    Still(Box<Still>),
    Sequence(Box<Sequence>),
}

impl Export {
    /// Does what can be done without waiting; gone once it is done or has failed.
    fn step(self, now_secs: f64) -> (Option<Self>, Progress) {
        match self {
            Self::Still(still) => {
                let (still, progress) = still.step(now_secs);
                (still.map(|still| Self::Still(Box::new(still))), progress)
            }
            Self::Sequence(sequence) => {
                let (sequence, progress) = sequence.step(now_secs);
                (sequence.map(|sequence| Self::Sequence(Box::new(sequence))), progress)
            }
        }
    }
}

/// A sequence that starts once the visitor has chosen its zip.
struct RequestedSequence {
    options: StillOptions,
    frames: Range<u32>,
    /// Whether each frame is a file for each eye.
    pair: bool,
    zip: ZipRequest,
}

/// The work on one device.
pub struct Engine {
    gpu: Gpu,
    pipelines: Arc<Pipelines>,
    picture: Picture,
    export: Option<Export>,
    /// The sequence whose zip the visitor has yet to choose.
    requested_sequence: Option<RequestedSequence>,
    progress: Option<ExportProgress>,
    context: egui::Context,
    /// Whether a tick is on its way.
    is_ticking: bool,
    /// Whether the interface has drawn a frame since the last tick.
    has_drawn: bool,
    /// What the interface was last told to say that the view does.
    told: Activity,
    /// How many frames it is still to be drawn in at once.
    frames_due: u32,
    told_at_secs: f64,
    /// Errors of the device that the person at the page was told of.
    faults_told: u64,
    session: Rc<RefCell<Session>>,
}

impl Engine {
    /// An engine that rests. It replaces the one on the device before.
    pub fn new(
        gpu: Gpu,
        state: RenderState,
        context: egui::Context,
        session: Rc<RefCell<Session>>,
    ) -> Rc<RefCell<Self>> {
        let pipelines = Pipelines::new(&gpu);
        let engine = Rc::new(RefCell::new(Self {
            gpu,
            picture: Picture::new(pipelines.clone(), state),
            pipelines,
            export: None,
            requested_sequence: None,
            progress: None,
            context,
            is_ticking: false,
            has_drawn: false,
            told: Activity::Idle,
            frames_due: 0,
            told_at_secs: 0.0,
            faults_told: 0,
            session,
        }));
        ENGINE.with(|slot| slot.replace(Rc::downgrade(&engine)));
        engine
    }

    /// The picture to show, once there is one.
    pub fn shown(&self) -> Option<ui::Picture> {
        self.picture.shown()
    }

    /// How far the export in progress is.
    pub fn progress(&self) -> Option<ExportProgress> {
        self.progress
    }

    /// Starts a still of the scene in view, or a `pair` of them.
    pub fn start_still(
        &mut self,
        size_px: [u32; 2],
        format: PictureFormat,
        pair: bool,
        session: &mut Session,
    ) {
        let environment_map = session.interface.environment_map().cloned();
        let options = StillOptions { environment_map, format, ..StillOptions::new(size_px) };
        match Still::start(&self.pipelines, session.interface.scene(), options, pair) {
            Ok(still) => {
                self.begin(Export::Still(Box::new(still)));
            }
            Err(error) => session.complain(format!("The picture was not saved: {error}")),
        }
    }

    /// Requests a zip for the frames of the path; [`Self::follow`] starts once it is chosen.
    pub fn start_sequence(
        &mut self,
        size_px: [u32; 2],
        frames: Range<u32>,
        pair: bool,
        session: &mut Session,
    ) {
        let [width, height] = size_px;
        let environment_map = session.interface.environment_map().cloned();
        let options = StillOptions { environment_map, ..StillOptions::new(size_px) };
        let zip = ZipRequest::new(format!("mandelight-{width}x{height}.zip"), &session.mailbox);
        self.requested_sequence = Some(RequestedSequence { options, frames, pair, zip });
    }

    /// Starts the requested sequence once its zip is chosen.
    fn start_requested_sequence(&mut self, session: &mut Session) {
        let Some(requested) = self.requested_sequence.take() else { return };
        let zip = match requested.zip.take_choice() {
            ZipChoice::Pending => {
                self.requested_sequence = Some(requested);
                return;
            }
            ZipChoice::Cancelled => return,
            ZipChoice::Chosen(zip) => zip,
        };
        let path = session.interface.project().path.clone();
        match Sequence::start(
            &self.pipelines,
            path,
            requested.frames,
            (requested.options, requested.pair),
            zip,
            &session.mailbox,
        ) {
            Ok(sequence) => self.begin(Export::Sequence(Box::new(sequence))),
            Err(error) => session.complain(format!("The sequence was not saved: {error}")),
        }
    }

    fn begin(&mut self, export: Export) {
        self.export = Some(export);
        self.progress = Some(ExportProgress { done: 0.0, remaining_secs: None });
    }

    /// Drops the export in progress.
    pub fn cancel_export(&mut self) {
        self.export = None;
        self.progress = None;
    }

    /// Takes over what this frame of the interface changed, and does what can be done at once.
    /// Returns after how many seconds to call again where that is known.
    pub fn follow(&mut self, session: &mut Session) -> Option<f64> {
        let now_secs = page::now_secs();
        self.start_requested_sequence(session);
        let scale = session.caution().scale();
        let interface = &session.interface;
        let settling = self.picture.resize(
            interface.view_size_px(),
            interface.scene().camera.stereo.layout,
            scale,
            now_secs,
        );
        self.picture.note_frame();
        self.picture.set_environment_map(interface.environment_map());
        self.picture.set_scene(interface.scene(), interface.is_moving());
        self.picture.watch_histogram(interface.wants_histogram());
        if self.step(session, now_secs) {
            self.tick_later();
        }
        self.has_drawn = true;
        self.frames_due = self.frames_due.saturating_sub(1);
        settling
    }

    /// Does what can be done without waiting. Returns whether there is more to do.
    fn step(&mut self, session: &mut Session, now_secs: f64) -> bool {
        // An export has the GPU to itself, and a scene that lost it waits for a hand.
        let busy = if self.export.is_some() {
            self.step_export(session, now_secs);
            // What the export kept waiting comes next.
            true
        } else if session.caution() == Caution::Paused {
            false
        } else {
            let busy = self.picture.pump(now_secs);
            let report = self.picture.report();
            if !busy && report.activity == Activity::Idle && report.pictures > 0 {
                session.note_finished();
            }
            busy
        };
        self.note_faults(session);
        self.tell(session);
        busy
    }

    fn step_export(&mut self, session: &mut Session, now_secs: f64) {
        let Some(export) = self.export.take() else { return };
        let (export, progress) = export.step(now_secs);
        self.export = export;
        self.progress = match progress {
            Progress::Working(done, remaining_secs) => {
                Some(ExportProgress { done: done as f32, remaining_secs })
            }
            Progress::Saved(name) => {
                session.say(format!("Saved {name}."));
                None
            }
            Progress::Closing => None,
            Progress::Failed(reason) => {
                session.complain(format!("Saving failed: {reason}"));
                None
            }
        };
    }

    fn note_faults(&mut self, session: &mut Session) {
        let faults = self.gpu.faults();
        if faults > std::mem::replace(&mut self.faults_told, faults) {
            session.complain(
                "The graphics card reported an error, so the picture may be wrong. A smaller window or a simpler scene may help; your scene is kept.",
            );
        }
    }

    fn tell(&self, session: &mut Session) {
        session.status = Status {
            report: self.picture.report(),
            texture: self.picture.texture().cloned(),
            dispatches: self.picture.dispatches(),
            frames: session.status.frames,
            is_exporting: self.export.is_some(),
        };
    }

    /// Sees to it that the work goes on.
    fn tick_later(&mut self) {
        if std::mem::replace(&mut self.is_ticking, true) {
            return;
        }
        if page::is_hidden() {
            // Browsers hold timers of hidden pages back, but not the GPU's own word.
            self.gpu.queue.on_submitted_work_done(tick);
        } else {
            page::after_ms(TICK_MS, tick);
        }
    }

    /// Asks for a frame where there is something new to show.
    fn show(&mut self, pictures_before: u64, busy: bool, report: &Report) {
        let now_secs = page::now_secs();
        if report.activity != self.told {
            self.told = report.activity.clone();
            self.frames_due = FRAMES_TO_TELL;
        }
        let is_new = report.pictures != pictures_before || self.frames_due > 0 || !busy;
        let tell_every_secs = TELL_EVERY_SECS.max(report.frame_interval_secs);
        if is_new || now_secs - self.told_at_secs > tell_every_secs {
            self.told_at_secs = now_secs;
            self.context.request_repaint();
        }
    }
}

/// Takes the engine at work a step further.
fn tick() {
    let Some(engine) = ENGINE.with(|slot| slot.borrow().upgrade()) else { return };
    // Ticks come between frames, when nobody else holds these.
    let Ok(mut engine) = engine.try_borrow_mut() else { return };
    let session = engine.session.clone();
    let Ok(mut session) = session.try_borrow_mut() else { return };
    engine.is_ticking = false;
    // What that frame submitted comes before anything that is submitted now.
    if std::mem::take(&mut engine.has_drawn) {
        engine.picture.time_frame();
    }
    let pictures_before = session.status.report.pictures;
    let busy = engine.step(&mut session, page::now_secs());
    engine.show(pictures_before, busy, &session.status.report);
    if busy {
        engine.tick_later();
    }
}
