//! What one kind of work has cost so far: a line through its measurements.
//!
//! In: the rays and the time of each slice. Out: its fixed part, and what a ray adds.

use super::types::Phase;

/// Rays of the very first slice: small enough for a device 200 times slower than a desktop's.
const FIRST_RAYS: f64 = 4096.0;

/// Milliseconds a ray that are assumed before anything is measured.
const ASSUMED_MS: f64 = 0.001;

/// A measurement so many times above what was expected is a surprise.
const SURPRISE: f64 = 2.0;

/// A measurement so many times above what was expected, and the next one as far below what that makes
/// expected: the first had something done for it that is done once, and tells nothing.
const HELD_UP: f64 = 10.0;

/// How many times as large as the largest one lately a slice may be: it is measured before the
/// line is trusted any further.
pub const GROWTH: f64 = 3.0;

/// Most of the mean time that may count as fixed: the rest keeps slices from growing at once.
const MOST_FIXED: f64 = 0.95;

impl Phase {
    /// What a measurement weighs against the next one. A movement's costs follow the view; what
    /// refines stays the same for long, and its line has to outlast others who hold it up.
    fn memory(self) -> f64 {
        match self {
            Self::Opening => 0.85,
            Self::Refining => 0.95,
        }
    }

    /// The surprise in a row that is believed. A picture that was late must not be followed by
    /// another; a slice that was held up says nothing of the next one.
    fn patience(self) -> u32 {
        match self {
            Self::Opening => 1,
            Self::Refining => 4,
        }
    }

    /// Once a surprise is believed, all that came before is dearer by this power of it: what
    /// comes next shrinks at once.
    fn belief(self) -> f64 {
        match self {
            Self::Opening => 0.75,
            Self::Refining => 0.4,
        }
    }
}

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

    /// Makes all measurements so many times dearer.
    fn scale(&mut self, factor: f64) {
        self.ms *= factor;
        self.rays_ms *= factor;
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
pub struct Rate {
    /// What a slice takes whatever its size.
    pub fixed_ms: f64,
    /// What each ray adds.
    pub ray_ms: f64,
    sums: Sums,
    /// The measurements before one that took so long that it may have been held up.
    before: Option<Sums>,
    /// Rays of the largest slice lately that did not take surprisingly long.
    pub largest: f64,
    /// Measurements in a row that took surprisingly long.
    surprises: u32,
}

impl Rate {
    /// Nothing has been measured.
    pub const UNKNOWN: Self = Self {
        fixed_ms: 0.0,
        ray_ms: ASSUMED_MS,
        sums: Sums { weight: 0.0, rays: 0.0, ms: 0.0, rays_squared: 0.0, rays_ms: 0.0 },
        before: None,
        largest: FIRST_RAYS / GROWTH,
        surprises: 0,
    };

    /// Whether anything has been measured.
    pub fn is_measured(&self) -> bool {
        self.sums.weight > 0.0
    }

    /// Takes note of a measurement. `fixed_ms`: what is known of the fixed part from elsewhere;
    /// found out by the line unless told.
    pub fn learn(&mut self, phase: Phase, fixed_ms: Option<f64>, rays: f64, ms: f64) {
        if let Some(before) = self.before.take()
            && ms * HELD_UP < self.expected_ms(rays)
        {
            self.sums = before;
            (self.fixed_ms, self.ray_ms) = (0.0, ms / rays);
            if self.is_measured() {
                self.fit(fixed_ms);
            }
        }
        let expected_ms = self.expected_ms(rays);
        let dearer = ms / expected_ms;
        self.surprises = if dearer > SURPRISE { self.surprises + 1 } else { 0 };
        // A surprise is no point of the line. It would tilt it until rays seem to cost nothing,
        // and the next slices would take many times as long as they should.
        let mut ms = ms;
        if self.surprises >= phase.patience().min(self.sums.weight as u32) {
            self.before = (dearer > HELD_UP).then_some(self.sums);
            self.sums.scale(dearer.powf(phase.belief()));
        } else if self.surprises > 0 {
            ms = SURPRISE * expected_ms;
        }
        self.sums.add(phase.memory(), rays, ms);
        self.fit(fixed_ms);
        // What follows a surprise is no larger than it was.
        self.largest = if self.surprises > 0 {
            self.largest.min(rays / GROWTH)
        } else {
            rays.max(phase.memory() * self.largest)
        };
    }

    /// Lays the line through the measurements.
    fn fit(&mut self, fixed_ms: Option<f64>) {
        let mean_ms = self.sums.ms / self.sums.weight;
        let fixed_ms = fixed_ms.or_else(|| self.sums.fixed_ms()).unwrap_or(self.fixed_ms);
        self.fixed_ms = fixed_ms.clamp(0.0, MOST_FIXED * mean_ms);
        self.ray_ms = (mean_ms - self.fixed_ms) / (self.sums.rays / self.sums.weight);
    }

    /// What a slice of so many rays is going to take, milliseconds.
    pub fn expected_ms(&self, rays: f64) -> f64 {
        self.fixed_ms + self.ray_ms * rays
    }

    /// Makes all of it dearer, where rays cost less than this.
    pub fn raise_to(&mut self, ray_ms: f64) {
        let dearer = ray_ms / self.ray_ms;
        if self.is_measured() && dearer > 1.0 {
            if dearer > HELD_UP {
                self.before = Some(self.sums);
            }
            self.sums.scale(dearer);
            self.fixed_ms *= dearer;
            self.ray_ms *= dearer;
        }
    }

    /// The same with rays so many times as dear.
    pub fn times(self, dearer: f64) -> Self {
        Self { ray_ms: self.ray_ms * dearer, ..self }
    }

    /// The same, tried in slices no larger than another's.
    pub fn in_slices_of(self, other: Self) -> Self {
        Self { largest: other.largest, ..self }
    }
}
