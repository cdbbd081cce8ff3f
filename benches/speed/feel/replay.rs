//! A replay of the session in real time, with input and pumps as in the page.
//!
//! In: a session and a motion budget. Out: the moving frames that were shown, and when. A
//! display ticks once a budget. Each tick sets the session's scene of that time; the view is
//! pumped at each tick and by a timer of a few milliseconds. A view that is behind keeps the
//! newest scene.

use std::{
    sync::{Arc, Mutex, PoisonError},
    time::{Duration, Instant},
};

use mandelight::{
    gpu::Gpu,
    render::{
        Pace, Pipelines, Region, View,
        pass::{tone, upsample},
    },
    scene::Scene,
};

use super::{
    super::{load::Load, poller::Poller},
    session::{SIZE_PX, Session, with_motion_budget},
};

/// Interval between two pumps, as in the page, seconds.
pub const PUMP_SECS: f64 = 0.004;

/// Number of display pictures that a view has submitted.
pub fn displays(view: &View) -> u64 {
    let of = |pass| view.dispatches().of(pass).dispatches;
    of(&tone::PASS) + of(&upsample::PASS)
}

/// Ticks at rest between two parts: two and a half full frames.
const REST_TICKS: u32 = 50;

/// Most additional ticks at rest until all pixels have a sample.
const MAX_REST_TICKS: u32 = 400;

/// One moving picture.
#[derive(Clone, Copy, Debug)]
pub struct Frame {
    /// Index of the session's part.
    pub part: usize,
    /// The tick whose scene the picture shows.
    pub tick: u32,
    /// From the picture before, or from this picture's input if that is later, to
    /// completion, seconds.
    pub secs: f64,
    /// From the input to completion, seconds.
    pub lag_secs: f64,
    /// Pixels per computed pixel.
    pub pixels_per_sample: u32,
}

/// The results of a replay.
#[derive(Default)]
pub struct Replay {
    /// The moving frames, in the order of completion.
    pub frames: Vec<Frame>,
    /// Fraction of the processors that other programs used, where the system has figures.
    pub others: Option<f64>,
}

/// A scene that was given to the view.
#[derive(Clone, Copy, Default, PartialEq)]
struct Input {
    part: usize,
    tick: u32,
    /// Time of the input.
    secs: f64,
    /// True while the pointer drags.
    moving: bool,
}

/// A submitted picture.
#[derive(Clone, Copy)]
struct ShownPicture {
    input: Input,
    pixels_per_sample: u32,
    /// True for a change's first picture, false for its refinements.
    first_of_change: bool,
    /// Time of completion.
    done_secs: f64,
}

/// The state of a replay.
struct Player {
    gpu: Gpu,
    view: View,
    start: Instant,
    budget_secs: f64,
    next_pump_secs: f64,
    latest_input: Input,
    /// The input that the view works on.
    accepted_input: Input,
    first_of_change: bool,
    shown: Arc<Mutex<Vec<ShownPicture>>>,
}

impl Player {
    fn now_secs(&self) -> f64 {
        self.start.elapsed().as_secs_f64()
    }

    fn set_scene(&mut self, scene: &Scene, part: usize, tick: u32, moving: bool) {
        self.view.set_scene(scene, moving);
        self.latest_input = Input { part, tick, secs: self.now_secs(), moving };
    }

    /// Pumps the view, and records a picture that it submits.
    fn pump(&mut self) -> bool {
        let before = displays(&self.view);
        let now_secs = self.now_secs();
        let busy = self.view.pump(now_secs);
        self.next_pump_secs = now_secs + PUMP_SECS;
        let report = self.view.report();
        // The view accepts a change in the pump that resets its elapsed time.
        if report.elapsed_secs == 0.0 && self.accepted_input != self.latest_input {
            self.accepted_input = self.latest_input;
            self.first_of_change = true;
        }
        if displays(&self.view) > before {
            let input = self.accepted_input;
            let first_of_change = std::mem::take(&mut self.first_of_change);
            let pixels_per_sample = report.pixels_per_sample;
            let (shown, start) = (self.shown.clone(), self.start);
            self.gpu.queue.on_submitted_work_done(move || {
                let done_secs = start.elapsed().as_secs_f64();
                shown.lock().unwrap_or_else(PoisonError::into_inner).push(ShownPicture {
                    input,
                    pixels_per_sample,
                    first_of_change,
                    done_secs,
                });
            });
        }
        busy
    }

    /// Pumps until `secs`.
    fn wait_until(&mut self, secs: f64) {
        loop {
            let now_secs = self.now_secs();
            if now_secs >= secs {
                return;
            }
            let next_secs = self.next_pump_secs.min(secs);
            if next_secs > now_secs {
                std::thread::sleep(Duration::from_secs_f64(next_secs - now_secs));
            }
            if self.now_secs() >= self.next_pump_secs {
                self.pump();
            }
        }
    }

    /// Plays a part from the next tick to the release.
    fn play(&mut self, part: usize, scenes: &[Scene]) {
        let first_secs = self.now_secs();
        let last = scenes.len() as u32 - 1;
        let mut count = 0;
        loop {
            let tick = ((self.now_secs() - first_secs) / self.budget_secs).round() as u32 + 1;
            let tick = tick.max(count + 1);
            count = tick;
            if tick > last {
                break;
            }
            self.set_scene(&scenes[tick as usize], part, tick, true);
            self.pump();
            self.wait_until(first_secs + f64::from(tick) * self.budget_secs);
        }
        self.set_scene(&scenes[last as usize], part, last, false);
        self.pump();
    }

    /// Rests for some ticks, and until all pixels have a sample.
    fn rest(&mut self) {
        let mut whole_ticks = 0;
        for tick in 0..REST_TICKS + MAX_REST_TICKS {
            // The picture of the last pixels is shown some ticks later.
            whole_ticks += u32::from(self.view.report().samples_done > 0);
            if tick >= REST_TICKS && whole_ticks > 4 {
                break;
            }
            self.wait_until(self.now_secs() + self.budget_secs);
        }
    }
}

/// Replays the session on a display that ticks every `budget_ms`.
pub fn play(pipelines: &Arc<Pipelines>, session: &Session, budget_ms: f64) -> Replay {
    let _poller = Poller::new(&pipelines.gpu);
    let before = Load::now();
    let mut player = Player {
        gpu: pipelines.gpu.clone(),
        view: View::new(pipelines, Region::whole(SIZE_PX), Pace::Interactive),
        start: Instant::now(),
        budget_secs: budget_ms * 1e-3,
        next_pump_secs: 0.0,
        latest_input: Input::default(),
        accepted_input: Input::default(),
        first_of_change: false,
        shown: Arc::default(),
    };
    let scenes = session.parts.iter().map(|part| {
        let budgeted = part.iter().map(|scene| with_motion_budget(scene, budget_ms));
        budgeted.collect::<Vec<_>>()
    });
    for (part, scenes) in scenes.enumerate() {
        if part == 0 {
            player.set_scene(&scenes[0], part, 0, false);
            player.pump();
            player.rest();
            player.rest();
        }
        player.play(part, &scenes);
        player.rest();
    }
    pipelines.gpu.wait();
    let shown = player.shown.lock().unwrap_or_else(PoisonError::into_inner).clone();
    let others = Load::now().zip(before).map(|(now, before)| now.others_share_since(&before));
    Replay { frames: moving_frames(&shown), others }
}

fn moving_frames(shown: &[ShownPicture]) -> Vec<Frame> {
    let mut frames = Vec::new();
    let mut before_secs = f64::NEG_INFINITY;
    for picture in shown {
        if picture.input.moving && picture.first_of_change {
            frames.push(Frame {
                part: picture.input.part,
                tick: picture.input.tick,
                secs: picture.done_secs - before_secs.max(picture.input.secs),
                lag_secs: picture.done_secs - picture.input.secs,
                pixels_per_sample: picture.pixels_per_sample,
            });
        }
        before_secs = picture.done_secs;
    }
    frames
}
