//! What to compute next: a state machine without a GPU, a clock or a scene of its own.
//!
//! In: what became stale, the time, and how long finished work took. Out: [`Work`], one piece
//! at a time, sized to take a few milliseconds. A view that changes opens on a lattice as sparse as
//! the motion budget demands and is shown; all pixels follow, by way of finer lattices where that
//! takes long, then jittered samples until there are enough, and then there is no more work.

use std::collections::VecDeque;

use super::lattice::{COARSEST, WORKGROUP_THREADS};

mod adaptation;
mod choice;
mod completion;
mod cost;
mod gbuffer_validity;
mod rate;
mod types;
mod work;

use adaptation::Adaptation;
use choice::STRAIGHT_MS;
pub use cost::Arithmetic;
use cost::Cost;
use gbuffer_validity::GBufferValidity;
use rate::Aim;
pub use types::{Pace, Stale, Status};
pub use work::{Job, Points, Stage, Trace, Work};

/// Pieces of work on the GPU at any time.
pub const MOST_IN_FLIGHT: usize = 2;

/// Most workgroups of jittered samples in one piece: their G-buffer has this size.
pub const SAMPLE_WORKGROUPS: u32 = 4096;

/// Most workgroups in any piece: its queues have room for a megapixel.
pub const MOST_WORKGROUPS: u32 = 16_384;

/// Most GPU time that one piece aims at while someone is watching, milliseconds. Each has its own
/// dispatches, whose last workgroups leave much of the GPU idle: small ones waste time.
pub const SLICE_MS: f64 = 25.0;

/// Most of the motion budget that it aims at. Two pieces that are in flight when the hand moves
/// again and a sparse picture take little more than a budget.
const SLICE_SHARE: f64 = 0.5;

/// GPU time that one piece of a still aims at, milliseconds.
pub const STILL_SLICE_MS: f64 = 60.0;

/// Least time between two displays of a picture that refines, seconds.
const SHOW_INTERVAL_SECS: f64 = 0.25;

/// Most of the GPU's time that displays of a refining picture may take.
const SHOW_SHARE: f64 = 0.05;

/// Most of the GPU's time that frames of the interface may take which only tell of progress.
const FRAME_SHARE: f64 = 0.1;

/// A movement counts as over when nothing has changed for this long, seconds.
const QUIET_SECS: f64 = 0.12;

/// Least time between two displays that only adapt, seconds.
const ADAPT_INTERVAL_SECS: f64 = 0.03;

/// Most of the GPU's time that they may take.
const ADAPT_SHARE: f64 = 0.2;

/// What is known of a piece of work that has not ended.
#[derive(Clone, Copy, Debug)]
struct InFlight {
    aim: Aim,
    /// What it is traced by.
    arithmetic: Arithmetic,
    /// What it is going to take.
    expected_ms: f64,
}

/// The state machine.
#[derive(Clone, Debug)]
pub struct Schedule {
    pace: Pace,
    size_px: [u32; 2],
    budget_ms: f64,
    samples_wanted: u32,
    /// What the centre samples' G-buffer holds.
    gbuffer_validity: GBufferValidity,
    /// The visibility bits of the lights that shine.
    shining: u64,
    /// Finest level whose every centre sample is shaded.
    shaded: Option<u32>,
    /// Whether there is indirect light, and the finest level that has it.
    has_indirect: bool,
    indirect_shaded: Option<u32>,
    samples_done: u32,
    /// The points under way and the next workgroup to submit.
    under_way: Option<(Points, u32)>,
    /// The film has been filled in, so that it can be shown while pixels come.
    is_filled: bool,
    /// The film holds something that the display does not.
    show_due: bool,
    /// Since the last restart nothing has been shown yet.
    opening: bool,
    shown_level: u32,
    moving: bool,
    changed_at: f64,
    shown_at: f64,
    /// Exposure follows the film.
    adaptation: Adaptation,
    in_flight: VecDeque<InFlight>,
    /// Slices so far.
    slices: u32,
    /// Ends of several pieces were told together.
    is_told_late: bool,
    cost: Cost,
}

impl Schedule {
    /// A schedule for a region; everything is stale.
    pub fn new(pace: Pace, size_px: [u32; 2]) -> Self {
        Self {
            pace,
            size_px,
            budget_ms: 16.0,
            samples_wanted: 1,
            gbuffer_validity: GBufferValidity::default(),
            shining: 0,
            shaded: None,
            has_indirect: false,
            indirect_shaded: None,
            samples_done: 0,
            under_way: None,
            is_filled: false,
            show_due: false,
            opening: true,
            shown_level: COARSEST,
            moving: false,
            changed_at: 0.0,
            shown_at: f64::NEG_INFINITY,
            adaptation: Adaptation::default(),
            in_flight: VecDeque::new(),
            slices: 0,
            is_told_late: false,
            cost: Cost::default(),
        }
    }

    /// Sets the GPU time of a frame while something moves, milliseconds, and the samples that
    /// each pixel is to have, at least one.
    pub fn aim(&mut self, budget_ms: f64, samples: u32) {
        self.budget_ms = budget_ms;
        self.samples_wanted = samples.max(1);
        // More samples go on from those that are there; fewer would need a film without them.
        let coming = match self.under_way {
            Some((Points::Samples { first, count }, _)) => first + count,
            _ => self.samples_done,
        };
        if coming > self.samples_wanted {
            self.restart(Stale::Light);
        }
    }

    /// Says whether exposure follows the film. Someone who watches sees it move there over some
    /// tenths of a second; what was never shown, and a still, has it at once.
    pub fn set_adapting(&mut self, adapts: bool) {
        self.adaptation.set_slow(adapts && self.pace == Pace::Interactive);
    }

    /// Says whether there is indirect light. Follow it with the change that it is.
    pub fn set_indirect(&mut self, has_indirect: bool) {
        self.has_indirect = has_indirect;
    }

    /// Says what powers are raised by from now on.
    pub fn set_arithmetic(&mut self, arithmetic: Arithmetic) {
        self.cost.arithmetic = arithmetic;
    }

    /// Says which lights shine, and which of all are not where their rays were marched to, both by
    /// their visibility bits. Follow it with the change that it is: none where no light of either
    /// kind shines or did.
    pub fn set_lights(&mut self, shining: u64, moved: u64) {
        self.shining = shining;
        self.gbuffer_validity.forget_lights(moved);
    }

    /// Says which lights have shadow rays at all, by their visibility bits.
    pub fn set_casting(&mut self, casting: u64) {
        self.cost.set_casting(casting);
    }

    /// The finest level that is on the film.
    fn filmed(&self) -> Option<u32> {
        if self.has_indirect { self.indirect_shaded } else { self.shaded }
    }

    /// Has the film shown once more as it is.
    pub fn show_again(&mut self) {
        self.show_due |= self.filmed().is_some();
    }

    /// Gives the schedule another region; everything becomes stale.
    pub fn resize(&mut self, size_px: [u32; 2]) {
        self.size_px = size_px;
        // Nothing of it has been shown: exposure does not come from elsewhere.
        self.shown_at = f64::NEG_INFINITY;
        self.adaptation.stop();
        self.restart(Stale::Geometry);
    }

    /// False while the opening picture of the last change is under way: the next change waits
    /// until that one has been shown, so that a slow device shows every movement at some rate
    /// rather than none.
    pub fn accepts_changes(&self) -> bool {
        self.pace == Pace::Still || !self.opening || self.is_between()
    }

    /// Whether a movement goes on.
    fn follows(&self, now_secs: f64) -> bool {
        self.moving && now_secs - self.changed_at < QUIET_SECS
    }

    /// Nothing of an opening is under way, nor about to be.
    fn is_between(&self) -> bool {
        self.under_way.is_none() && !self.show_due && self.filmed() == self.shaded
    }

    /// Something changed at `now_secs`. `moving` says that more changes are expected at once.
    pub fn change(&mut self, stale: Stale, moving: bool, now_secs: f64) {
        self.moving = moving;
        self.changed_at = now_secs;
        self.restart(stale);
    }

    /// Says whether more changes are expected, without one.
    pub fn set_moving(&mut self, moving: bool) {
        self.moving = moving;
    }

    fn restart(&mut self, stale: Stale) {
        if stale == Stale::Tone {
            self.show_due |= self.filmed().is_some();
            // A picture that was never shown is shown by its own opening.
            if !self.opening {
                self.shown_at = f64::NEG_INFINITY;
            }
            return;
        }
        self.gbuffer_validity.forget(stale);
        if stale >= Stale::Light {
            self.shaded = None;
        }
        self.indirect_shaded = None;
        self.samples_done = 0;
        self.under_way = None;
        self.is_filled = false;
        self.show_due = false;
        self.opening = true;
    }

    /// The next piece of work at `now_secs`; none where enough is in flight, where a movement
    /// is being followed and has been shown, or where all is done.
    pub fn next(&mut self, now_secs: f64) -> Option<Work> {
        if self.in_flight.len() >= MOST_IN_FLIGHT {
            return None;
        }
        let aim = self.aim_now();
        let work = self.choose(now_secs)?;
        let expected_ms = match work {
            Work::Trace(trace) => {
                self.cost.expected_ms(trace.job(), aim, trace.workgroups * WORKGROUP_THREADS)
            }
            Work::Show { .. } => self.cost.show_ms(),
        };
        let arithmetic = self.cost.arithmetic;
        self.in_flight.push_back(InFlight { aim, arithmetic, expected_ms });
        Some(work)
    }

    /// What the next piece of work is for.
    fn aim_now(&self) -> Aim {
        let is_seen = self.pace == Pace::Interactive;
        if self.opening && is_seen { Aim::Opening } else { Aim::Refining }
    }

    fn choose(&mut self, now_secs: f64) -> Option<Work> {
        if (self.show_due && self.show_now(now_secs)) || self.adapt_now(now_secs) {
            return Some(self.show(now_secs));
        }
        if self.follows(now_secs) && !self.opening {
            return None;
        }
        loop {
            let (points, first_workgroup) = match self.under_way {
                Some(state) => state,
                None => {
                    let points = self.next_points(now_secs)?;
                    if points == Points::All && !self.is_filled && self.whole_ms() > STRAIGHT_MS {
                        self.is_filled = true;
                        return Some(self.show(now_secs));
                    }
                    (points, 0)
                }
            };
            if points.grid(self.size_px).workgroups() > 0 {
                return Some(Work::Trace(self.slice(points, first_workgroup)));
            }
            // A small region has no pixels of this kind.
            self.complete(points);
        }
    }

    /// A first picture, a complete lattice, an edit and a finished picture are shown at once; what
    /// refines in between no oftener than [`SHOW_INTERVAL_SECS`] and [`SHOW_SHARE`] say, for showing costs
    /// time too. A still is shown once.
    fn show_now(&self, now_secs: f64) -> bool {
        let finished = self.samples_done >= self.samples_wanted;
        if self.pace == Pace::Still {
            return finished;
        }
        let complete = self.samples_done == 1 && self.under_way.is_none();
        let waited_secs = now_secs - self.shown_at;
        self.opening || complete || finished || waited_secs >= self.show_interval_secs()
    }

    /// Least time between two displays of what refines. Each comes with a frame of the interface.
    fn show_interval_secs(&self) -> f64 {
        let interval_secs = SHOW_INTERVAL_SECS.max(self.cost.show_ms() * 1e-3 / SHOW_SHARE);
        interval_secs.max(self.frame_interval_secs())
    }

    /// Least time between two frames of the interface that only tell of progress, seconds.
    pub fn frame_interval_secs(&self) -> f64 {
        self.cost.interface_ms() * 1e-3 / FRAME_SHARE
    }

    /// Whether exposure is on its way and another step of it is due.
    fn adapt_now(&self, now_secs: f64) -> bool {
        let frame_ms = self.cost.show_ms() + self.cost.interface_ms();
        let interval_secs = ADAPT_INTERVAL_SECS.max(frame_ms * 1e-3 / ADAPT_SHARE);
        self.adaptation.is_under_way()
            && self.filmed().is_some()
            && !self.opening
            && now_secs - self.shown_at >= interval_secs
    }

    fn show(&mut self, now_secs: f64) -> Work {
        // The first picture of a change and those that complete the lattice set exposure a new
        // goal; further samples hardly move it.
        let is_new_goal = self.show_due && self.samples_done <= 1;
        let adapt = self.adaptation.step(now_secs, now_secs - self.shown_at, is_new_goal);
        self.show_due = false;
        self.opening = false;
        self.shown_at = now_secs;
        let level = self.filmed().unwrap_or(0);
        self.shown_level = level;
        // A level under way has put true pixels where the fill would go: only fill when whole.
        let fill = level > 0 && self.under_way.is_none();
        Work::Show { level, fill, film: self.is_filled && level > 0, adapt }
    }

    fn slice(&mut self, points: Points, first_workgroup: u32) -> Trace {
        let job = self.job(points);
        let total = points.grid(self.size_px).workgroups();
        // An opening goes out whole where the budget has room for it: it and its display are
        // then the two pieces in flight, and every displayed frame can have one.
        let opening = self.aim_now() == Aim::Opening;
        let aim_ms = match self.pace {
            Pace::Still => STILL_SLICE_MS,
            Pace::Interactive if opening => self.budget_ms,
            Pace::Interactive => SLICE_MS.min(SLICE_SHARE * self.budget_ms),
        };
        let most = match points {
            Points::Samples { .. } => SAMPLE_WORKGROUPS,
            _ => MOST_WORKGROUPS,
        };
        let largest = self.cost.slice_workgroups(aim_ms, job, self.aim_now()).min(most);
        // Slices of two sizes tell the cost of a slice from that of its pixels, and so have pairs to
        // be, where those are all that is told of.
        self.slices = self.slices.wrapping_add(1);
        let every = if self.is_told_late { 3 } else { 2 };
        let smaller = !opening && self.slices.is_multiple_of(every);
        let wanted = if smaller { largest.div_ceil(2) } else { largest };
        let workgroups = wanted.min(total - first_workgroup);
        let next = first_workgroup + workgroups;
        if next < total {
            self.under_way = Some((points, next));
            // A complete lattice is below: what has come so far may be shown, unless it waits for
            // its indirect light.
            let is_filmed = match points {
                Points::All => self.is_filled,
                Points::Level(_) | Points::Added(_) => !self.has_indirect,
                Points::Indirect(_) | Points::Samples { .. } => true,
            };
            self.show_due |= is_filmed && self.filmed().is_some() && self.pace == Pace::Interactive;
        } else {
            self.complete(points);
        }
        let Job { from, lights } = job;
        Trace { points, from, lights, first_workgroup, workgroups }
    }

    fn complete(&mut self, points: Points) {
        self.under_way = None;
        match points {
            Points::Level(_) | Points::Added(_) | Points::All => {
                let level = points.level();
                self.shaded = Some(level);
                // What waits for indirect light is not on the film yet.
                self.show_due = !self.has_indirect;
                self.gbuffer_validity.complete(level, self.shining);
            }
            Points::Indirect(level) => {
                self.indirect_shaded = Some(level);
                self.show_due = true;
            }
            Points::Samples { first, count } => {
                self.samples_done = first + count;
                self.show_due = true;
                return;
            }
        }
        self.samples_done = u32::from(self.filmed() == Some(0));
    }

    /// What the schedule says of itself at `now_secs`.
    pub fn status(&self, now_secs: f64) -> Status {
        Status {
            samples_done: self.samples_done,
            samples_so_far: self.samples_so_far(),
            shown_level: self.shown_level,
            shown: !self.opening,
            moving: self.follows(now_secs),
            idle: self.in_flight.is_empty()
                && !self.show_due
                && self.under_way.is_none()
                && !self.adaptation.is_under_way()
                && self.samples_done >= self.samples_wanted,
        }
    }
}

#[cfg(test)]
mod tests;
