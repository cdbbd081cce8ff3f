//! What work has cost so far, and how much of it fits a time.
//!
//! A piece of work takes a fixed time, whatever its size, and a time for each ray. The fixed
//! part is small natively; in a browser the interface's own drawing and the way back of the news
//! can make it many milliseconds, and pieces that shrank for its sake would only add to it. A
//! straight line through recent measurements tells the two apart.
//!
//! Rays are what work is counted in, for the shadow rays of a few lights or many are most of it:
//! what has been learnt with some lights holds well enough with others.

use super::{Job, Stage};
use crate::render::lattice::WORKGROUP_THREADS;

/// Rays of the very first slice: small enough for a device 200 times slower than a desktop's.
const FIRST_RAYS: f64 = 4096.0;

/// Milliseconds a ray that are assumed before anything is measured.
const ASSUMED_MS: f64 = 0.001;

/// Rays that shading is taken for until it has been measured.
const SHADING_RAYS: f64 = 0.25;

/// What a measurement weighs against the next one.
const MEMORY: f64 = 0.85;

/// What it weighs against one so many times above what was expected: slices then shrink at once.
const SURPRISE: f64 = 2.0;
const MEMORY_AFTER_SURPRISE: f64 = 0.3;

/// Fewest workgroups of a slice: two can be halved, and slices of two sizes keep telling what is
/// fixed. Were they all of one workgroup, their own smallness could never be found to be the trouble.
const FEWEST_WORKGROUPS: f64 = 2.0;

/// Most of the mean time that may count as fixed: the rest keeps slices from growing at once.
const MOST_FIXED: f64 = 0.95;

/// Part of a budget that is planned for: one frame takes a little more than the one before it.
const AIM: f64 = 0.9;

/// Weighted sums over measurements of rays and milliseconds.
#[derive(Clone, Copy, Debug, Default)]
struct Sums {
    weight: f64,
    rays: f64,
    ms: f64,
    rays_squared: f64,
    rays_ms: f64,
}

impl Sums {
    fn add(&mut self, memory: f64, rays: f64, ms: f64) {
        *self = Self {
            weight: self.weight * memory + 1.0,
            rays: self.rays * memory + rays,
            ms: self.ms * memory + ms,
            rays_squared: self.rays_squared * memory + rays * rays,
            rays_ms: self.rays_ms * memory + rays * ms,
        };
    }

    /// The fixed part of the line of least squares; none where all slices were of one size.
    fn fixed_ms(&self) -> Option<f64> {
        let (rays, ms) = (self.rays / self.weight, self.ms / self.weight);
        let variance = self.rays_squared / self.weight - rays * rays;
        let covariance = self.rays_ms / self.weight - rays * ms;
        (variance > 0.01 * rays * rays).then(|| ms - covariance.max(0.0) / variance * rays)
    }
}

/// The cost of one kind of trace.
#[derive(Clone, Copy, Debug)]
struct Rate {
    fixed_ms: f64,
    ray_ms: f64,
    sums: Sums,
    /// Rays of the largest slice so far that was measured.
    largest: f64,
}

impl Rate {
    const UNKNOWN: Self = Self {
        fixed_ms: 0.0,
        ray_ms: ASSUMED_MS,
        sums: Sums { weight: 0.0, rays: 0.0, ms: 0.0, rays_squared: 0.0, rays_ms: 0.0 },
        largest: FIRST_RAYS / 2.0,
    };

    fn is_measured(&self) -> bool {
        self.sums.weight > 0.0
    }

    fn learn(&mut self, rays: f64, ms: f64) {
        let is_surprise = ms > SURPRISE * (self.fixed_ms + self.ray_ms * rays);
        self.sums.add(if is_surprise { MEMORY_AFTER_SURPRISE } else { MEMORY }, rays, ms);
        let mean_ms = self.sums.ms / self.sums.weight;
        let fixed_ms = self.sums.fixed_ms().unwrap_or(self.fixed_ms);
        self.fixed_ms = fixed_ms.clamp(0.0, MOST_FIXED * mean_ms);
        self.ray_ms = (mean_ms - self.fixed_ms) / (self.sums.rays / self.sums.weight);
        self.largest = self.largest.max(rays);
    }
}

/// How powers are raised: what a ray costs hangs on it more than on anything else that can change
/// from one moving picture to the next.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Arithmetic {
    /// By pipelines for one whole power.
    #[default]
    Special,
    /// By pipelines for any whole power.
    Whole,
    /// By series, for real powers.
    Real,
}

impl Arithmetic {
    const ALL: [Self; 3] = [Self::Special, Self::Whole, Self::Real];

    /// What an orbit step usually costs, in parts of the first one's. It only has to do until the
    /// first picture of another kind has been measured.
    fn usual(self) -> f64 {
        match self {
            Self::Special => 1.0,
            Self::Whole => 2.0,
            Self::Real => 4.0,
        }
    }
}

/// Running estimates of what traces and shows cost.
#[derive(Clone, Debug)]
pub struct Cost {
    /// Of traces that start with each [`Stage`], by each arithmetic.
    rates: [[Rate; 5]; Arithmetic::ALL.len()],
    /// What is traced by from now on.
    pub arithmetic: Arithmetic,
    show_ms: f64,
    /// The visibility bits of the lights that have shadow rays.
    casting: u64,
}

impl Default for Cost {
    /// No experience yet.
    fn default() -> Self {
        let rates = [[Rate::UNKNOWN; 5]; Arithmetic::ALL.len()];
        Self { rates, arithmetic: Arithmetic::default(), show_ms: 0.0, casting: u64::MAX }
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
            Stage::Gather => (Stage::Gather, 1.0),
        }
    }

    /// A slice of so many pixels, traced by `arithmetic`, took so long.
    pub fn traced(&mut self, job: Job, arithmetic: Arithmetic, pixels: u32, busy_ms: f64) {
        if pixels > 0 {
            let (stage, rays) = self.price(job);
            let rate = &mut self.rates[arithmetic as usize][stage as usize];
            rate.learn(f64::from(pixels) * rays, busy_ms.max(1e-3));
        }
    }

    /// A show took so long.
    pub fn shown(&mut self, busy_ms: f64) {
        self.show_ms += 0.5 * (busy_ms - self.show_ms);
    }

    /// What a show takes, milliseconds.
    pub fn show_ms(&self) -> f64 {
        self.show_ms
    }

    fn rate(&self, from: Stage) -> Rate {
        let own = self.rate_by(self.arithmetic, from);
        let of_others = Arithmetic::ALL.map(|other| (other, self.rate_by(other, from)));
        match of_others.into_iter().find(|(_, rate)| rate.is_measured()) {
            Some((other, rate)) if !own.is_measured() => {
                let dearer = self.arithmetic.usual() / other.usual();
                Rate { ray_ms: rate.ray_ms * dearer, ..rate }
            }
            _ => own,
        }
    }

    /// What is known of one arithmetic.
    fn rate_by(&self, arithmetic: Arithmetic, from: Stage) -> Rate {
        let rates = &self.rates[arithmetic as usize];
        let own = rates[from as usize];
        // Rays cost about the same at any start.
        let earlier = &rates[..from.min(Stage::Shade) as usize];
        let dearer = earlier.iter().rev().find(|rate| rate.is_measured());
        match dearer {
            Some(dearer) if !own.is_measured() => {
                // Gathering is no part of the others: what is too much of it has to be found out.
                let largest = if from == Stage::Gather { own.largest } else { dearer.largest };
                Rate { largest, ..*dearer }
            }
            _ => own,
        }
    }

    /// Workgroups of a slice whose pixels are to take `aim_ms`, or as long as the fixed part does
    /// where that is longer: never more than twice the largest slice that has been seen to end
    /// well, and two at least.
    pub fn slice_workgroups(&self, aim_ms: f64, job: Job) -> u32 {
        let (stage, rays_of_pixel) = self.price(job);
        let rate = self.rate(stage);
        let rays = (aim_ms.max(rate.fixed_ms) / rate.ray_ms).min(2.0 * rate.largest);
        let workgroup = f64::from(WORKGROUP_THREADS) * rays_of_pixel;
        (rays / workgroup).clamp(FEWEST_WORKGROUPS, 1e9) as u32
    }

    /// Whether so many pixels fit `budget_ms` together with their display. `gathers`: and with
    /// their indirect light.
    pub fn fits(&self, budget_ms: f64, pixels: u32, job: Job, gathers: bool) -> bool {
        let (stage, rays_of_pixel) = self.price(job);
        let rate = self.rate(stage);
        let mut fixed_ms = rate.fixed_ms;
        let mut pixel_ms = rate.ray_ms * rays_of_pixel;
        if gathers {
            let gather = self.rate(Stage::Gather);
            fixed_ms += gather.fixed_ms;
            pixel_ms += gather.ray_ms;
        }
        // At least a quarter of the budget goes into the lattice's pixels, however slow the
        // display and the way to it.
        let left_ms = (AIM * budget_ms - self.show_ms - fixed_ms).max(0.25 * budget_ms);
        f64::from(pixels) * pixel_ms <= left_ms
    }
}
