//! What to compute next: a state machine without a GPU, a clock or a scene of its own.
//!
//! In: what became stale, the time, and how long finished work took. Out: [`Work`], one piece
//! at a time, sized to take a few milliseconds. After a change, a view opens on a lattice as sparse as
//! the motion budget demands. All pixels follow, through finer lattices where a full frame takes
//! long, then jittered samples up to the wanted number, then no more work.
//!
//! | file | contents |
//! |---|---|
//! | `traces` | the next run of blocks, and its parts |
//! | `piece_size` | how much a refining piece computes |
//! | `division` | in how many parts a long piece is submitted |
//! | `point_selection` | which sample points come next |
//! | `completion` | pieces in flight, and what their completions say of costs |
//! | `interface_frames` | room for frames of the interface |
//! | `progress` | how much of the picture has been computed |
//! | `cost`, `rate` | estimates of what work takes |
//! | `plan` | what an integrator says of its work |
//! | `gbuffer_validity` | which parts of the G-buffer are valid |
//! | `adaptation` | how exposure follows the film |
//! | `work`, `types` | plain types |

use super::{lattice::COARSEST, occupancy::Occupancy, region::Overlap};

mod adaptation;
mod completion;
mod cost;
mod division;
mod gbuffer_validity;
mod interface_frames;
mod piece_size;
mod plan;
mod point_selection;
mod progress;
mod rate;
mod traces;
mod types;
mod work;

use adaptation::{ADAPT_INTERVAL_SECS, ADAPT_SHARE, Adaptation};
use completion::{InFlight, Piece};
use cost::Cost;
pub use gbuffer_validity::GBufferValidity;
use interface_frames::{FRAME_SHARE, InterfaceFrames};
use piece_size::{PIECE_MS, PieceSizes};
pub use plan::{Plan, SampleCost, WorkKind};
use point_selection::PointSelection;
use progress::Progress;
pub use progress::Reuse;
use types::Phase;
pub use types::{Arithmetic, Pace, Stale, Status};
pub use work::{
    BATCH_WORKGROUPS, Display, Job, KeptPixels, MAX_BATCH_WORKGROUPS, MAX_PIECE_BLOCKS, Points,
    Stage, Trace, Work,
};

/// Least time between two displays of a refining picture, seconds.
const DISPLAY_INTERVAL_SECS: f64 = 0.25;

/// Largest part of GPU time that displays of a refining picture take.
const DISPLAY_SHARE: f64 = 0.05;

/// Time without a change after which a movement is over, seconds.
const QUIET_SECS: f64 = 0.12;

/// Work whose cost in one picture says nothing of the next one: in another view, or with other settings, paths are longer
/// or shorter.
const NEW_IN_ANOTHER_PICTURE: &[WorkKind] = &[WorkKind::Paths];

/// Work whose cost in one view says nothing of another one. No opening shows what shading alone and indirect light cost
/// there, as it shows the cost of rays.
const NEW_IN_ANOTHER_VIEW: &[WorkKind] = &[WorkKind::Paths, WorkKind::Shading, WorkKind::Indirect];

/// The state machine.
#[derive(Clone, Debug)]
pub struct Schedule {
    pace: Pace,
    budget_ms: f64,
    samples_wanted: u32,
    /// Whether the picture ends with the samples under way: all its pixels are clean.
    is_converged: bool,
    progress: Progress,
    /// Whether the film holds pixels that the display does not.
    is_display_stale: bool,
    /// Whether no picture of the last change has been shown.
    opening: bool,
    /// Whether the opening is of another view, and not of a step of a movement.
    is_jump: bool,
    shown_level: u32,
    moving: bool,
    changed_at: f64,
    shown_at: f64,
    /// Movement of auto exposure.
    adaptation: Adaptation,
    in_flight: InFlight,
    interface_frames: InterfaceFrames,
    piece_sizes: PieceSizes,
    cost: Cost,
}

impl Schedule {
    /// A schedule for a region of which everything is stale, whose samples `plan`'s integrator computes.
    pub fn new(plan: &'static Plan, pace: Pace, size_px: [u32; 2]) -> Self {
        Self {
            pace,
            budget_ms: 16.0,
            samples_wanted: 1,
            is_converged: false,
            progress: Progress::new(plan, size_px),
            is_display_stale: false,
            opening: true,
            is_jump: true,
            shown_level: COARSEST,
            moving: false,
            changed_at: 0.0,
            shown_at: f64::NEG_INFINITY,
            adaptation: Adaptation::default(),
            in_flight: InFlight::default(),
            interface_frames: InterfaceFrames::default(),
            piece_sizes: PieceSizes::default(),
            cost: Cost::new(plan),
        }
    }

    /// Sets the GPU time of a moving picture, milliseconds, and the samples of each pixel, at least one.
    pub fn aim(&mut self, budget_ms: f64, samples: u32) {
        self.budget_ms = budget_ms;
        self.samples_wanted = samples.max(1);
        // The film can't be reduced to fewer samples than were added to it.
        let most_samples = self.progress.samples_begun().max(self.progress.kept_samples());
        if most_samples > self.samples_wanted {
            self.restart(Stale::Light);
        }
    }

    /// Sets whether the picture ends with the samples under way; a restart sets it to false.
    pub fn set_converged(&mut self, is_converged: bool) {
        self.is_converged = is_converged;
    }

    /// Whether all submitted samples are whole rounds over all pixels.
    pub fn is_between_samples(&self) -> bool {
        self.progress.under_way.is_none()
    }

    /// Samples that each pixel gets.
    fn samples_to_do(&self) -> u32 {
        if self.is_converged {
            self.samples_wanted.min(self.progress.samples_begun().max(1))
        } else {
            self.samples_wanted
        }
    }

    /// Sets whether exposure follows the film gradually, which it does only while someone watches.
    /// The first picture has its exposure at once.
    pub fn set_adapting(&mut self, adapts: bool) {
        self.adaptation.set_slow(adapts && self.pace == Pace::Interactive);
    }

    /// Sets the plan of the integrator that computes samples. Call [`Self::change`] after it.
    pub fn set_plan(&mut self, plan: &'static Plan) {
        self.progress.plan = plan;
        self.cost.set_plan(plan);
    }

    /// Sets whether there is indirect light. Call [`Self::change`] after it.
    pub fn set_indirect(&mut self, has_indirect: bool) {
        self.progress.has_indirect = has_indirect;
    }

    /// Sets how kernels raise powers from now on.
    pub fn set_arithmetic(&mut self, arithmetic: Arithmetic) {
        self.cost.arithmetic = arithmetic;
    }

    /// Sets the lights that shine, and those whose shadow bits are stale, by their visibility bits. Call
    /// [`Self::change`] after it where either is not zero or was not.
    pub fn set_lights(&mut self, shining: u64, moved: u64) {
        self.progress.shining = shining;
        self.progress.gbuffer_validity.invalidate_lights(moved);
    }

    /// Sets what occupies the adapter: the sizes of a refining picture's pieces.
    pub fn set_occupancy(&mut self, occupancy: Occupancy) {
        self.piece_sizes.occupancy = occupancy;
    }

    /// Sets the lights that have shadow rays, by their visibility bits.
    pub fn set_casting(&mut self, casting: u64) {
        self.cost.set_casting(casting);
    }

    /// The finest lattice level whose every centre sample has been submitted; none before the first.
    pub fn center_level(&self) -> Option<u32> {
        self.progress.gbuffer_validity.depth()
    }

    /// Requests another display of the film as it is.
    pub fn show_again(&mut self) {
        self.is_display_stale |= self.progress.filmed().is_some();
    }

    /// Sets another region, and returns what it keeps of the old one: the caller moves that to its place.
    ///
    /// `overlap`: the pixels that are the same as before; all others become stale. `indirect_radius_px`: how far around a
    /// pixel its indirect light comes from; 0 without indirect light.
    pub fn resize(
        &mut self,
        size_px: [u32; 2],
        overlap: Option<Overlap>,
        indirect_radius_px: u32,
    ) -> Reuse {
        // The new region has not been shown: its exposure does not start from the old one's.
        self.shown_at = f64::NEG_INFINITY;
        self.adaptation.stop();
        let reuse = self.progress.resize(size_px, overlap, indirect_radius_px);
        let is_converged = self.is_converged && reuse == Reuse::Film;
        self.begin_opening();
        self.is_converged = is_converged;
        self.is_display_stale = reuse == Reuse::Film;
        reuse
    }

    /// Copies the progress of another schedule of the same picture; `whole` is all pixels of the region. Returns which
    /// samples the caller must copy.
    pub fn copy_progress(&mut self, other: &Self, whole: Overlap) -> Reuse {
        self.progress.clone_from(&other.progress);
        self.is_converged = other.is_converged;
        self.resize(whole.size_px, Some(whole), 0)
    }

    /// Samples of the pixels that are kept from a picture of another width; 0 without such pixels.
    pub fn kept_samples(&self) -> u32 {
        self.progress.kept_samples()
    }

    /// False while the opening picture of the last change is under way. The next change waits until it is
    /// shown, so that a slow device shows some pictures of a movement rather than none.
    pub fn accepts_changes(&self) -> bool {
        self.pace == Pace::Still || !self.opening || self.is_between()
    }

    /// Whether a movement goes on.
    fn follows(&self, now_secs: f64) -> bool {
        self.moving && now_secs - self.changed_at < QUIET_SECS
    }

    /// Whether no part of an opening has been submitted that waits for more.
    fn is_between(&self) -> bool {
        self.progress.under_way.is_none()
            && !self.is_display_stale
            && self.progress.filmed() == self.progress.shaded
    }

    /// Restarts after a change at `now_secs`. `moving`: more changes are expected at once.
    pub fn change(&mut self, stale: Stale, moving: bool, now_secs: f64) {
        self.moving = moving;
        self.changed_at = now_secs;
        self.interface_frames.release();
        // A jump that was never shown stays one.
        self.is_jump = (stale == Stale::Geometry && !moving) || self.is_at_jump();
        self.restart(stale);
    }

    /// Whether another view has not been shown yet, which may cost many times what the last one cost.
    pub fn is_at_jump(&self) -> bool {
        self.is_jump && self.opening
    }

    /// Sets whether more changes are expected, without a change.
    pub fn set_moving(&mut self, moving: bool) {
        self.moving = moving;
    }

    fn restart(&mut self, stale: Stale) {
        self.progress.restart(stale);
        if stale == Stale::Tone {
            self.show_again();
            // A picture that was never shown is shown by its own opening.
            if !self.opening {
                self.shown_at = f64::NEG_INFINITY;
            }
            return;
        }
        self.begin_opening();
    }

    /// Begins another picture, of which none has been shown.
    fn begin_opening(&mut self) {
        if self.pace == Pace::Interactive {
            let kinds = if self.is_jump { NEW_IN_ANOTHER_VIEW } else { NEW_IN_ANOTHER_PICTURE };
            self.cost.forget(kinds);
            self.in_flight.forget(kinds);
        }
        self.interface_frames.release();
        self.is_converged = false;
        self.is_display_stale = false;
        self.opening = true;
    }

    /// The next piece of work at `now_secs`.
    ///
    /// None where enough is in flight, where the last picture of a movement has been shown, while a frame of the
    /// interface is measured, or where all is done.
    pub fn next(&mut self, now_secs: f64) -> Option<Work> {
        let (phase, in_flight_ms) = (self.phase(), self.in_flight.expected_ms(Phase::Refining));
        let frames = &self.interface_frames;
        if self.in_flight.len() >= frames.max_in_flight(phase, in_flight_ms, now_secs) {
            return None;
        }
        let work = self.choose(now_secs)?;
        let (learned_as, expected_ms) = match work {
            Work::Trace(trace) => {
                let job = trace.job();
                let whole_ms = self.cost.expected_ms(job, phase, trace.samples());
                let expected_ms = match trace.parts() {
                    1 => whole_ms,
                    parts => self.cost.division.part_ms(parts, whole_ms),
                };
                (Some(self.cost.sample_cost(job)), expected_ms)
            }
            Work::Display(_) => (None, self.cost.display_ms()),
        };
        let arithmetic = self.cost.arithmetic;
        self.in_flight.push(Piece { phase, arithmetic, learned_as, expected_ms });
        Some(work)
    }

    /// Removes finished pieces of work and learns their costs.
    ///
    /// `finished`: the pieces that [`Self::next`] returned, and frames of the interface (none), in
    /// order, each with the GPU time since the one before it ended, milliseconds.
    pub fn collect(&mut self, finished: &[(Option<Work>, f64)]) {
        self.in_flight.collect(finished, &mut self.interface_frames, &mut self.cost);
    }

    /// Requests a frame of the interface that reports progress. Returns whether it may be drawn now.
    pub fn request_frame(&mut self, now_secs: f64) -> bool {
        let status = self.status(now_secs);
        let is_refining = status.shown && !status.moving && !status.idle;
        self.interface_frames.request(is_refining, self.in_flight.is_empty(), now_secs)
    }

    /// Notes input at the interface that someone waits for the answer of, such as a click.
    pub fn note_input(&mut self, now_secs: f64) {
        self.interface_frames.note_input(now_secs);
    }

    /// Notes that a frame of the interface has been submitted. `is_only_work`: nothing but this picture and the interface
    /// use the GPU.
    pub fn frame_submitted(&mut self, is_only_work: bool, now_secs: f64) {
        let is_free = is_only_work && self.in_flight.is_empty();
        self.interface_frames.submitted(is_free, now_secs);
    }

    /// What the next piece of work is for.
    fn phase(&self) -> Phase {
        let is_seen = self.pace == Pace::Interactive;
        match self.opening && is_seen {
            true if self.is_jump => Phase::Jump,
            true => Phase::Opening,
            false => Phase::Refining,
        }
    }

    fn choose(&mut self, now_secs: f64) -> Option<Work> {
        if (self.is_display_stale && self.is_display_due(now_secs)) || self.adapts_now(now_secs) {
            return Some(self.display(now_secs));
        }
        if self.follows(now_secs) && !self.opening {
            return None;
        }
        loop {
            let (points, first_block) = match self.progress.under_way {
                Some(state) => state,
                None => {
                    let selection = self.point_selection(now_secs);
                    let points = selection.next_points()?;
                    let is_blank = points == Points::All && !self.progress.is_filled;
                    if is_blank && selection.needs_preview() {
                        self.progress.is_filled = true;
                        return Some(self.display(now_secs));
                    }
                    (points, 0)
                }
            };
            if points.grid(self.progress.size_px).workgroups() > 0 {
                return Some(Work::Trace(self.next_trace(points, first_block)));
            }
            // A small region has no pixels of this kind.
            self.is_display_stale = self.progress.complete(points);
        }
    }

    /// What the next points depend on.
    fn point_selection(&self, now_secs: f64) -> PointSelection<'_> {
        PointSelection {
            progress: &self.progress,
            cost: &self.cost,
            pace: self.pace,
            // Of another view it is not known what the budget is enough for.
            budget_ms: if self.is_jump { self.budget_ms.min(PIECE_MS) } else { self.budget_ms },
            samples_wanted: self.samples_to_do(),
            is_opening: self.opening,
            is_display_due: now_secs - self.shown_at >= self.display_interval_secs(),
            in_flight_ms: self.in_flight.expected_ms(Phase::Refining),
        }
    }

    /// Whether a change of the film is displayed now.
    ///
    /// Openings, complete lattices, edits and finished pictures are displayed at once, refining ones at intervals,
    /// because a display takes GPU time. A still is displayed once.
    fn is_display_due(&self, now_secs: f64) -> bool {
        let finished = self.progress.samples_done >= self.samples_to_do();
        if self.pace == Pace::Still {
            return finished;
        }
        let complete = self.progress.samples_done == 1 && self.progress.under_way.is_none();
        let waited_secs = now_secs - self.shown_at;
        self.opening || complete || finished || waited_secs >= self.display_interval_secs()
    }

    /// Least time between two displays of a refining picture, seconds. Each display comes with a
    /// frame of the interface.
    fn display_interval_secs(&self) -> f64 {
        let interval_secs =
            DISPLAY_INTERVAL_SECS.max(self.cost.display_ms() * 1e-3 / DISPLAY_SHARE);
        interval_secs.max(self.frame_interval_secs())
    }

    /// Least time between two frames of the interface that only report progress, seconds.
    pub fn frame_interval_secs(&self) -> f64 {
        self.cost.interface_ms() * 1e-3 / FRAME_SHARE
    }

    /// Whether exposure is moving and its next step is due.
    fn adapts_now(&self, now_secs: f64) -> bool {
        let frame_ms = self.cost.display_ms() + self.cost.interface_ms();
        let interval_secs = ADAPT_INTERVAL_SECS.max(frame_ms * 1e-3 / ADAPT_SHARE);
        self.adaptation.is_under_way()
            && self.progress.filmed().is_some()
            && !self.opening
            && now_secs - self.shown_at >= interval_secs
    }

    fn display(&mut self, now_secs: f64) -> Work {
        // Only opening pictures and complete lattices move exposure's goal: further samples
        // hardly change the film's mean.
        let is_new_goal = self.is_display_stale && self.progress.samples_done <= 1;
        let adapt = self.adaptation.step(now_secs, now_secs - self.shown_at, is_new_goal);
        let refines = !self.opening && self.shown_at.is_finite();
        self.is_display_stale = false;
        (self.opening, self.is_jump) = (false, false);
        self.shown_at = now_secs;
        let level = self.progress.filmed().unwrap_or(0);
        self.shown_level = level;
        // Reconstruction would overwrite the pixels of a level under way.
        let fill = level > 0 && self.progress.under_way.is_none();
        Work::Display(Display {
            level,
            fill,
            from_film: self.progress.is_filled && level > 0,
            adapt,
            kept: self.progress.kept_pixels(Points::Level(level)),
            refines,
        })
    }

    /// The state of the schedule at `now_secs`.
    pub fn status(&self, now_secs: f64) -> Status {
        Status {
            samples_done: self.progress.samples_done,
            samples_so_far: self.progress.samples_so_far(),
            shown_level: self.shown_level,
            shown: !self.opening,
            moving: self.follows(now_secs),
            idle: self.in_flight.is_empty()
                && !self.is_display_stale
                && self.progress.under_way.is_none()
                && !self.adaptation.is_under_way()
                && self.progress.samples_done >= self.samples_to_do(),
        }
    }
}

#[cfg(test)]
mod tests;
