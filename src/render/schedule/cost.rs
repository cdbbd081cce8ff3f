//! What work has cost so far, and how much of it fits a time.
//!
//! A piece of work takes a fixed time, whatever its size, and a time for each ray. The fixed
//! part is small natively; in a browser the interface's own drawing and the way back of the news
//! can make it many milliseconds, and pieces that shrank for its sake would only add to it. A
//! straight line through recent measurements of what refines tells the two apart.
//!
//! A ray of a sparse lattice has little in common with its neighbours and costs more than one of
//! a dense lattice; how much more hangs on the scene. So what opens a change is measured apart
//! from what refines: what the last picture of a movement took is what the next one's first will.
//!
//! Rays are what work is counted in, for the shadow rays of a few lights or many are most of it:
//! what has been learnt with some lights holds well enough with others.

use super::{
    rate::{GROWTH, Rate},
    types::{Arithmetic, Phase},
    work::{Job, Stage},
};
use crate::render::lattice::WORKGROUP_THREADS;

/// Rays that shading is taken for until it has been measured.
const SHADING_RAYS: f64 = 0.25;

/// What a ray of an opening costs, in rays of what refines, until it has been measured.
const SPARSER: f64 = 1.5;

/// The most that it costs in those.
const SPARSEST: f64 = 2.0;

/// Fewest workgroups of a slice: two can be halved, and slices of two sizes keep telling what is
/// fixed. Were they all of one workgroup, their own smallness could never be found to be the trouble.
const FEWEST_WORKGROUPS: f64 = 2.0;

/// How many times as many rays as those before it an opening may have: two lattice levels.
const FINER: f64 = 5.0;

/// The most that drawing the interface may count as, milliseconds: what takes longer was held up.
const MOST_INTERFACE_MS: f64 = 200.0;

/// Part of a budget that is planned for: one frame takes a little more than the one before it.
const AIM: f64 = 0.9;

impl Arithmetic {
    const ALL: [Self; 4] = [Self::SpecializedPipeline, Self::Whole, Self::Real, Self::Deep];

    /// What an orbit step usually costs, in parts of the first one's. It only has to do until the
    /// first picture of another kind has been measured.
    fn usual(self) -> f64 {
        match self {
            Self::SpecializedPipeline => 1.0,
            Self::Whole => 2.0,
            Self::Real | Self::Deep => 6.0,
        }
    }
}

/// Running estimates of what traces and shows cost.
#[derive(Clone, Debug)]
pub struct Cost {
    /// Of traces that start with each [`Stage`], by each arithmetic, for either phase.
    rates: [[[Rate; 5]; Arithmetic::ALL.len()]; 2],
    /// What is traced by from now on.
    pub arithmetic: Arithmetic,
    show_ms: f64,
    interface_ms: f64,
    /// The visibility bits of the lights that have shadow rays.
    casting: u64,
}

impl Default for Cost {
    /// No experience yet.
    fn default() -> Self {
        let rates = [[[Rate::UNKNOWN; 5]; Arithmetic::ALL.len()]; 2];
        Self {
            rates,
            arithmetic: Arithmetic::default(),
            show_ms: 0.0,
            interface_ms: 0.0,
            casting: u64::MAX,
        }
    }
}

impl Cost {
    /// Says which lights have shadow rays, by their visibility bits: others are as good as free.
    pub fn set_casting(&mut self, casting: u64) {
        self.casting = casting;
    }

    /// The stage that a job costs as much as, and the rays that one of its pixels counts as.
    fn price(&self, job: Job) -> (Stage, f64) {
        let lights = f64::from((job.lights & self.casting).count_ones());
        match job.from {
            Stage::March | Stage::Normal => (job.from, 1.0 + lights),
            Stage::Shadow if lights > 0.0 => (Stage::Shadow, lights),
            Stage::Shadow | Stage::Shade => (Stage::Shade, SHADING_RAYS),
            Stage::Indirect => (Stage::Indirect, 1.0),
        }
    }

    /// A slice of so many pixels, traced by `arithmetic`, took so long.
    pub fn traced(
        &mut self,
        job: Job,
        phase: Phase,
        arithmetic: Arithmetic,
        pixels: f64,
        busy_ms: f64,
    ) {
        if pixels > 0.0 {
            let (stage, rays) = self.price(job);
            let refining = self.rate_for(Phase::Refining, arithmetic, stage).fixed_ms;
            // Openings are of too many views to tell.
            let fixed_ms = (phase == Phase::Opening).then_some(refining);
            let rate = &mut self.rates[phase as usize][arithmetic as usize][stage as usize];
            rate.learn(phase, fixed_ms, pixels * rays, busy_ms.max(1e-3));
            if phase == Phase::Opening {
                // It has seen a view that what refines has not.
                let ray_ms = rate.ray_ms / SPARSEST;
                let rates = &mut self.rates[Phase::Refining as usize];
                rates[arithmetic as usize][stage as usize].raise_to(ray_ms);
            }
        }
    }

    /// What a slice of so many pixels is going to take, milliseconds.
    pub fn expected_ms(&self, job: Job, phase: Phase, pixels: u32) -> f64 {
        let (stage, rays) = self.price(job);
        self.rate(phase, stage).expected_ms(f64::from(pixels) * rays)
    }

    /// A show took so long.
    pub fn shown(&mut self, busy_ms: f64) {
        // All displays are much alike: what the last one took more was none of its own.
        let before_ms = self.show_ms.min(2.0 * busy_ms);
        self.show_ms = 0.5 * (before_ms + busy_ms);
    }

    /// What a show takes, milliseconds.
    pub fn show_ms(&self) -> f64 {
        self.show_ms
    }

    /// The interface's drawing of a frame took so long.
    pub fn interface_drawn(&mut self, busy_ms: f64) {
        self.interface_ms += 0.5 * (busy_ms.min(MOST_INTERFACE_MS) - self.interface_ms);
    }

    /// What the interface's drawing of a frame takes, milliseconds.
    pub fn interface_ms(&self) -> f64 {
        self.interface_ms
    }

    fn rate(&self, phase: Phase, from: Stage) -> Rate {
        let own = self.rate_by(phase, self.arithmetic, from);
        let of_others = Arithmetic::ALL.map(|other| (other, self.rate_by(phase, other, from)));
        match of_others.into_iter().find(|(_, rate)| rate.is_measured()) {
            Some((other, rate)) if !own.is_measured() => {
                rate.times(self.arithmetic.usual() / other.usual())
            }
            _ => own,
        }
    }

    /// What is known of one arithmetic.
    fn rate_by(&self, phase: Phase, arithmetic: Arithmetic, from: Stage) -> Rate {
        let own = self.rate_for(phase, arithmetic, from);
        if own.is_measured() {
            return own;
        }
        // A refining slice that is as dear as an opening's errs on the safe side.
        let rate = self.rate_for(phase.other(), arithmetic, from);
        let dearer = if phase == Phase::Opening && rate.is_measured() { SPARSER } else { 1.0 };
        rate.times(dearer)
    }

    /// What is known of one phase and arithmetic.
    fn rate_for(&self, phase: Phase, arithmetic: Arithmetic, from: Stage) -> Rate {
        let rates = &self.rates[phase as usize][arithmetic as usize];
        let own = rates[from as usize];
        // Rays cost about the same at any start.
        let earlier = &rates[..from.min(Stage::Shade) as usize];
        let dearer = earlier.iter().rev().find(|rate| rate.is_measured());
        match dearer {
            Some(dearer) if !own.is_measured() => {
                // Gathering is no part of the others: what is too much of it has to be found out.
                if from == Stage::Indirect { dearer.in_slices_of(own) } else { *dearer }
            }
            _ => own,
        }
    }

    /// Workgroups of a slice whose pixels are to take `aim_ms`, or as long as the fixed part does
    /// where that is longer: not much larger than slices have been seen to end well, and two at least.
    pub fn slice_workgroups(&self, aim_ms: f64, job: Job, phase: Phase) -> u32 {
        let (stage, rays_of_pixel) = self.price(job);
        let rate = self.rate(phase, stage);
        let rays = (aim_ms.max(rate.fixed_ms) / rate.ray_ms).min(GROWTH * rate.largest);
        let workgroup = f64::from(WORKGROUP_THREADS) * rays_of_pixel;
        (rays / workgroup).clamp(FEWEST_WORKGROUPS, 1e9) as u32
    }

    /// Whether an opening of so many pixels fits `budget_ms` together with its display and with
    /// what is still in flight of other work, which takes `before_ms`. `has_indirect`: and with its
    /// indirect light.
    pub fn fits(
        &self,
        budget_ms: f64,
        before_ms: f64,
        pixels: u32,
        job: Job,
        has_indirect: bool,
    ) -> bool {
        let (stage, rays_of_pixel) = self.price(job);
        let rate = self.rate(Phase::Opening, stage);
        let mut fixed_ms = rate.fixed_ms;
        let mut pixel_ms = rate.ray_ms * rays_of_pixel;
        if has_indirect {
            let indirect = self.rate(Phase::Opening, Stage::Indirect);
            fixed_ms += indirect.fixed_ms;
            pixel_ms += indirect.ray_ms;
        }
        // At least a quarter of the budget goes into the lattice's pixels, however slow the
        // display and the way to it.
        let left_ms = AIM * budget_ms - before_ms - self.show_ms - fixed_ms;
        let pixels = f64::from(pixels);
        // What few rays took says little of what many will.
        let tried = self.rate_for(Phase::Opening, self.arithmetic, stage);
        let is_near = !tried.is_measured() || pixels * rays_of_pixel <= FINER * tried.largest;
        is_near && pixels * pixel_ms <= left_ms.max(0.25 * budget_ms)
    }
}
