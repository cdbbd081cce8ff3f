//! The session against the clock: a view is fed as the page feeds it.
//!
//! A display ticks once a budget. At a tick the view gets the scene that the hand has got to; at
//! the tick, and every few milliseconds between two of them as the page's own timer does, the
//! view is pumped. A view that is behind keeps the newest scene for when it is ready.

use std::{
    sync::{
        Arc, Mutex, PoisonError,
        atomic::{AtomicBool, Ordering},
    },
    time::{Duration, Instant},
};

use mandelight::{
    gpu::Gpu,
    render::{Pace, Pipelines, Region, View},
    scene::Scene,
};

use super::{
    super::load::Load,
    session::{SIZE_PX, Session, with_motion_budget},
};

/// Between two pumps, as in the page, seconds.
pub const PUMP_SECS: f64 = 0.004;

/// Ticks of rest between two parts: two and a half full frames.
const REST_TICKS: u32 = 50;

/// Most ticks that a rest is prolonged by until the whole picture is there.
const MOST_REST_TICKS: u32 = 400;

/// One moving picture.
#[derive(Clone, Copy, Debug)]
pub struct Frame {
    /// The part of the session.
    pub part: usize,
    /// The tick whose scene it shows.
    pub tick: u32,
    /// From the picture before it, or from its own input where that came later, to its end, seconds.
    pub secs: f64,
    /// From its own input to its end, seconds.
    pub lag_secs: f64,
    /// One pixel of so many was computed.
    pub pixels_per_sample: u32,
}

/// What a replay showed.
#[derive(Default)]
pub struct Replay {
    /// Its moving pictures.
    pub frames: Vec<Frame>,
    /// Part of the machine's processors that other programs had meanwhile, where it tells.
    pub others: Option<f64>,
}

/// Runs callbacks of finished work as soon as they are due, as browsers do.
struct Poller {
    stop: Arc<AtomicBool>,
    thread: Option<std::thread::JoinHandle<()>>,
}

impl Poller {
    fn new(gpu: &Gpu) -> Self {
        let stop = Arc::new(AtomicBool::new(false));
        let (gpu, told) = (gpu.clone(), stop.clone());
        let thread = std::thread::spawn(move || {
            while !told.load(Ordering::Relaxed) {
                gpu.poll();
                std::thread::sleep(Duration::from_micros(200));
            }
        });
        Self { stop, thread: Some(thread) }
    }
}

impl Drop for Poller {
    fn drop(&mut self) {
        self.stop.store(true, Ordering::Relaxed);
        if let Some(thread) = self.thread.take() {
            // A poller that panicked has said so.
            let _ = thread.join();
        }
    }
}

/// A picture that was submitted.
#[derive(Clone, Copy)]
struct Shown {
    part: usize,
    tick: u32,
    given_secs: f64,
    pixels_per_sample: u32,
    moving: bool,
    /// Of a change, rather than of what refines.
    opening: bool,
    /// When it was done.
    done_secs: f64,
}

/// One replay under way.
struct Player {
    gpu: Gpu,
    view: View,
    start: Instant,
    budget_secs: f64,
    next_pump_secs: f64,
    /// Part, tick, time and movement of what the view was given last, and of what it took.
    given: (usize, u32, f64, bool),
    taken: (usize, u32, f64, bool),
    opening: bool,
    shown: Arc<Mutex<Vec<Shown>>>,
}

impl Player {
    fn now_secs(&self) -> f64 {
        self.start.elapsed().as_secs_f64()
    }

    fn give(&mut self, scene: &Scene, part: usize, tick: u32, moving: bool) {
        self.view.set_scene(scene, moving);
        self.given = (part, tick, self.now_secs(), moving);
    }

    /// Lets the view work, and notes a picture that it submits.
    fn pump(&mut self) -> bool {
        let tones = self.view.dispatches().tone;
        let now_secs = self.now_secs();
        let busy = self.view.pump(now_secs);
        self.next_pump_secs = now_secs + PUMP_SECS;
        let report = self.view.report();
        // The pump in which a change was taken is the change's own time.
        if report.elapsed_secs == 0.0 && self.taken != self.given {
            self.taken = self.given;
            self.opening = true;
        }
        if self.view.dispatches().tone > tones {
            let (part, tick, given_secs, moving) = self.taken;
            let opening = std::mem::take(&mut self.opening);
            let pixels_per_sample = report.pixels_per_sample;
            let (shown, start) = (self.shown.clone(), self.start);
            self.gpu.queue.on_submitted_work_done(move || {
                let done_secs = start.elapsed().as_secs_f64();
                shown.lock().unwrap_or_else(PoisonError::into_inner).push(Shown {
                    part,
                    tick,
                    given_secs,
                    pixels_per_sample,
                    moving,
                    opening,
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

    /// Plays a part from the tick that comes next until the hand lets go.
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
            self.give(&scenes[tick as usize], part, tick, true);
            self.pump();
            self.wait_until(first_secs + f64::from(tick) * self.budget_secs);
        }
        self.give(&scenes[last as usize], part, last, false);
        self.pump();
    }

    /// Rests for a while, and until the whole picture is there.
    fn rest(&mut self) {
        let mut whole_ticks = 0;
        for tick in 0..REST_TICKS + MOST_REST_TICKS {
            // The picture of the last pixel is still to come.
            whole_ticks += u32::from(self.view.report().samples_done > 0);
            if tick >= REST_TICKS && whole_ticks > 4 {
                break;
            }
            self.wait_until(self.now_secs() + self.budget_secs);
        }
    }
}

/// Plays the session with a display that ticks every `budget_ms`.
pub fn play(pipelines: &Arc<Pipelines>, session: &Session, budget_ms: f64) -> Replay {
    let _poller = Poller::new(&pipelines.gpu);
    let before = Load::now();
    let mut player = Player {
        gpu: pipelines.gpu.clone(),
        view: View::new(pipelines, Region::whole(SIZE_PX), Pace::Interactive),
        start: Instant::now(),
        budget_secs: budget_ms * 1e-3,
        next_pump_secs: 0.0,
        given: (0, 0, 0.0, false),
        taken: (0, 0, 0.0, false),
        opening: false,
        shown: Arc::default(),
    };
    let scenes = session.parts.iter().map(|part| {
        let aimed = part.iter().map(|scene| with_motion_budget(scene, budget_ms));
        aimed.collect::<Vec<_>>()
    });
    for (part, scenes) in scenes.enumerate() {
        if part == 0 {
            player.give(&scenes[0], part, 0, false);
            player.pump();
            player.rest();
            player.rest();
        }
        player.play(part, &scenes);
        player.rest();
    }
    pipelines.gpu.wait();
    let shown = player.shown.lock().unwrap_or_else(PoisonError::into_inner).clone();
    let others = Load::now().zip(before).map(|(now, before)| now.of_others_since(&before));
    Replay { frames: moving_frames(&shown), others }
}

fn moving_frames(shown: &[Shown]) -> Vec<Frame> {
    let mut frames = Vec::new();
    let mut before_secs = f64::NEG_INFINITY;
    for picture in shown {
        if picture.moving && picture.opening {
            frames.push(Frame {
                part: picture.part,
                tick: picture.tick,
                secs: picture.done_secs - before_secs.max(picture.given_secs),
                lag_secs: picture.done_secs - picture.given_secs,
                pixels_per_sample: picture.pixels_per_sample,
            });
        }
        before_secs = picture.done_secs;
    }
    frames
}
