//! What work has cost so far, and how much of it fits a time.
//!
//! In: measured pieces. Out: estimates of others. A piece takes a fixed time and a time for each
//! ray. The fixed part is small natively; in a browser the interface's own drawing and the
//! completion-callback latency make it many milliseconds. Pieces that shrank on its account would
//! only add to it, so pieces of two sizes separate the two.
//!
//! A ray of a sparse lattice has little in common with its neighbours and costs more than one of
//! a dense lattice, by a factor that depends on the scene. So openings and refining pieces are
//! estimated separately: what the last picture of a movement took is what its next one will take.
//!
//! The integrator's [`Plan`] says how many rays a sample counts as.

use super::{
    division::Division,
    plan::{Plan, SampleCost, WorkKind},
    rate::{CostHistory, FIRST_RAYS, Rate},
    types::{Arithmetic, Phase},
    work::Job,
};
use crate::render::lattice::BLOCK_THREADS;

/// Longest time that drawing the interface counts as, milliseconds: longer ones were held up.
const MAX_INTERFACE_MS: f64 = 200.0;

/// Part of a budget that is planned for: a picture may take more than the one before it.
const PLANNED: f64 = 0.9;

/// Least part of a budget for the lattice's samples, whatever display and latency take.
const MIN_FOR_SAMPLES: f64 = 0.25;

/// Cost of a ray by a general pipeline, in rays by specialized ones, until measured. Rays by specialized ones count as those by
/// others until measured: how much less they cost depends on the view and the adapter.
const UNSPECIALIZED: f64 = 4.0;

/// Cost of a path, in rays, until measured.
const RAYS_OF_PATH: f64 = 6.0;

const ARITHMETICS: [Arithmetic; 4] =
    [Arithmetic::SpecializedPipeline, Arithmetic::Whole, Arithmetic::Real, Arithmetic::Deep];

/// Kinds of work that have costs of their own: rays by each arithmetic, paths by each, shading, indirect light.
const PATHS: usize = ARITHMETICS.len();
const SHADING: usize = PATHS + ARITHMETICS.len();
const INDIRECT: usize = SHADING + 1;
const KINDS: usize = INDIRECT + 1;

/// Running estimates of what traces and displays cost.
#[derive(Clone, Debug)]
pub struct Cost {
    /// What the integrator's work costs.
    plan: &'static Plan,
    histories: [CostHistory; KINDS],
    /// How kernels raise powers from now on.
    pub arithmetic: Arithmetic,
    /// What parts of pieces cost.
    pub division: Division,
    display_ms: f64,
    /// Time of the last display alone.
    last_display_ms: f64,
    interface_ms: f64,
    /// Time of the last measured frame of the interface alone.
    last_frame_ms: f64,
    /// The visibility bits of the lights that have shadow rays.
    casting: u64,
}

/// Index of a kind's history.
fn history_index(kind: WorkKind, arithmetic: Arithmetic) -> usize {
    match kind {
        WorkKind::Tracing => arithmetic as usize,
        WorkKind::Paths => PATHS + arithmetic as usize,
        WorkKind::Shading => SHADING,
        WorkKind::Indirect => INDIRECT,
    }
}

impl Cost {
    /// Nothing has been measured.
    pub fn new(plan: &'static Plan) -> Self {
        Self {
            plan,
            histories: Default::default(),
            arithmetic: Arithmetic::default(),
            division: Division::default(),
            display_ms: 0.0,
            last_display_ms: f64::INFINITY,
            interface_ms: 0.0,
            last_frame_ms: f64::INFINITY,
            casting: u64::MAX,
        }
    }

    /// Sets what the integrator's work costs.
    pub fn set_plan(&mut self, plan: &'static Plan) {
        self.plan = plan;
    }

    /// Forgets what these kinds of work cost. Their next pieces are small, and grow as they are measured.
    pub fn forget(&mut self, kinds: &[WorkKind]) {
        for &kind in kinds {
            self.forget_but_by(None, kind);
        }
    }

    /// Sets the lights that have shadow rays, by their visibility bits: others cost next to nothing.
    pub fn set_casting(&mut self, casting: u64) {
        self.casting = casting;
    }

    /// The lights that have shadow rays, by their visibility bits.
    pub fn casting(&self) -> u64 {
        self.casting
    }

    /// What a job costs for each of its samples.
    pub fn sample_cost(&self, job: Job) -> SampleCost {
        (self.plan.sample_cost)(job, self.casting)
    }

    /// Learns that a trace of so many samples by `arithmetic`, each of `sample_cost`, took `busy_ms`.
    pub fn traced(
        &mut self,
        sample_cost: SampleCost,
        phase: Phase,
        arithmetic: Arithmetic,
        samples: f64,
        busy_ms: f64,
    ) {
        if samples > 0.0 {
            let SampleCost { kind, rays: rays_of_sample } = sample_cost;
            // Rays by other arithmetics were measured in other views. The first pieces by pipelines that are compiled while this
            // view refines are sized by what its rays cost by the present one.
            if phase == Phase::Jump && kind == WorkKind::Tracing {
                self.forget_but_by(Some(arithmetic), kind);
            }
            let history = &mut self.histories[history_index(kind, arithmetic)];
            history.learn(phase, samples * rays_of_sample, busy_ms.max(1e-3));
        }
    }

    /// Forgets what a kind of work costs by all arithmetics but `kept`.
    fn forget_but_by(&mut self, kept: Option<Arithmetic>, kind: WorkKind) {
        for arithmetic in ARITHMETICS.into_iter().filter(|&arithmetic| Some(arithmetic) != kept) {
            self.histories[history_index(kind, arithmetic)] = CostHistory::default();
        }
    }

    /// Estimated time of a trace of so many samples, milliseconds.
    pub fn expected_ms(&self, job: Job, phase: Phase, samples: u32) -> f64 {
        let SampleCost { kind, rays: rays_of_sample } = self.sample_cost(job);
        self.rate(phase, kind).expected_ms(f64::from(samples) * rays_of_sample)
    }

    /// Learns the time of a display.
    pub fn displayed(&mut self, busy_ms: f64) {
        // Displays are much alike: one that took longer than the one before it was held up.
        self.display_ms = busy_ms.min(self.last_display_ms);
        self.last_display_ms = busy_ms;
    }

    /// Estimated time of a display, milliseconds.
    pub fn display_ms(&self) -> f64 {
        self.display_ms
    }

    /// Learns the time of a frame of the interface that had the GPU to itself.
    pub fn interface_drawn(&mut self, busy_ms: f64) {
        let busy_ms = busy_ms.min(MAX_INTERFACE_MS);
        // Frames are much alike: one that took longer than the one before it was held up.
        self.interface_ms = busy_ms.min(self.last_frame_ms);
        self.last_frame_ms = busy_ms;
    }

    /// Estimated time of a frame of the interface, milliseconds.
    pub fn interface_ms(&self) -> f64 {
        self.interface_ms
    }

    /// The rate of a kind by the present arithmetic, or by one that was measured.
    fn rate(&self, phase: Phase, kind: WorkKind) -> Rate {
        let of_other = |&other: &Arithmetic| {
            let rate = self.rate_by(other, phase, kind)?;
            let is_of_special = other == Arithmetic::SpecializedPipeline;
            Some(rate.scaled(if is_of_special { UNSPECIALIZED } else { 1.0 }))
        };
        self.rate_by(self.arithmetic, phase, kind)
            .or_else(|| ARITHMETICS.iter().find_map(of_other))
            .unwrap_or(Rate::ASSUMED)
    }

    /// The rate of a kind by one arithmetic: that of tracing where only tracing has been measured.
    fn rate_by(&self, arithmetic: Arithmetic, phase: Phase, kind: WorkKind) -> Option<Rate> {
        let rate = |kind: WorkKind| self.histories[history_index(kind, arithmetic)].rate(phase);
        rate(kind).or_else(|| match kind {
            WorkKind::Indirect => rate(WorkKind::Tracing).map(|rate| rate.untried(1.0)),
            // Openings are as fine as those of rays, so that the first picture of an edit is.
            WorkKind::Shading if phase == Phase::Refining => {
                rate(WorkKind::Tracing).map(|rate| rate.untried(1.0))
            }
            WorkKind::Paths => rate(WorkKind::Tracing).map(|rate| rate.untried(RAYS_OF_PATH)),
            WorkKind::Tracing | WorkKind::Shading => rate(WorkKind::Tracing),
        })
    }

    /// Blocks of the next refining piece, whose rays are to take `aim_ms` ([`Rate::rays`]).
    pub fn piece_blocks(&self, aim_ms: f64, job: Job) -> u32 {
        let rate = self.rate(Phase::Refining, self.sample_cost(job).kind);
        self.blocks_of(rate.rays(aim_ms), job)
    }

    /// Blocks of the first piece of a view whose rays may take any time.
    pub fn first_blocks(&self, job: Job) -> u32 {
        self.blocks_of(FIRST_RAYS, job)
    }

    /// What a refining piece of so many blocks takes whatever its size, and what its rays take, milliseconds.
    pub fn piece_ms(&self, blocks: u32, job: Job) -> (f64, f64) {
        let SampleCost { kind, rays: rays_of_sample } = self.sample_cost(job);
        let rate = self.rate(Phase::Refining, kind);
        (rate.fixed_ms, rate.ray_ms * f64::from(blocks * BLOCK_THREADS) * rays_of_sample)
    }

    /// How many blocks have so many rays.
    fn blocks_of(&self, rays: f64, job: Job) -> u32 {
        let rays_of_block = f64::from(BLOCK_THREADS) * self.sample_cost(job).rays;
        (rays / rays_of_block).min(1e9) as u32
    }

    /// The rate of the openings that were tried with this kind of work, or if it is new, with any rays; none where refining pieces
    /// alone say what it costs.
    fn tried_opening(&self, kind: WorkKind) -> Option<Rate> {
        let own = &self.histories[history_index(kind, self.arithmetic)];
        let of_rays = |&arithmetic: &Arithmetic| {
            self.histories[history_index(WorkKind::Tracing, arithmetic)].opening()
        };
        match own.rate(Phase::Refining) {
            Some(_) => own.opening(),
            None => ARITHMETICS.iter().find_map(of_rays),
        }
    }

    /// Whether an opening fits a budget, with its display and the work in flight.
    ///
    /// `has_indirect`: the opening's indirect light has to fit too.
    pub fn fits(
        &self,
        budget_ms: f64,
        in_flight_ms: f64,
        samples: u32,
        job: Job,
        has_indirect: bool,
    ) -> bool {
        let SampleCost { kind, rays: rays_of_sample } = self.sample_cost(job);
        let rate = self.rate(Phase::Opening, kind);
        let mut fixed_ms = rate.fixed_ms;
        let mut sample_ms = rate.ray_ms * rays_of_sample;
        if has_indirect {
            let indirect = self.rate(Phase::Opening, WorkKind::Indirect);
            fixed_ms += indirect.fixed_ms;
            sample_ms += indirect.ray_ms;
        }
        let left_ms = PLANNED * budget_ms - in_flight_ms - self.display_ms - fixed_ms;
        let samples = f64::from(samples);
        // The cost of few rays says little of the cost of many.
        let tried = self.tried_opening(kind);
        let is_near = tried.is_none_or(|rate| samples * rays_of_sample <= rate.max_rays);
        is_near && samples * sample_ms <= left_ms.max(MIN_FOR_SAMPLES * budget_ms)
    }
}
