//! How auto exposure follows the film: over some tenths of a second for someone who watches.

/// Time in which it goes 1 − 1/e of the way to its goal, seconds.
const ADAPT_SECS: f64 = 0.15;

/// After this long without a new goal it is there, seconds: what is left of a change by two
/// stops no longer shows.
const SETTLE_SECS: f64 = 0.9;

/// Auto exposure on its way.
#[derive(Clone, Copy, Debug, Default)]
pub struct Adaptation {
    /// It takes its time.
    is_slow: bool,
    /// When it will have settled; none once it has.
    settles_at: Option<f64>,
}

impl Adaptation {
    /// Says whether it takes time, or is at its goal at once.
    pub fn set_slow(&mut self, is_slow: bool) {
        self.is_slow = is_slow;
        if !is_slow {
            self.settles_at = None;
        }
    }

    /// It is wherever the next goal will be.
    pub fn stop(&mut self) {
        self.settles_at = None;
    }

    /// Whether there is a way left.
    pub fn is_under_way(&self) -> bool {
        self.settles_at.is_some()
    }

    /// How far it goes toward its goal in a display at `now_secs`, `since_secs` after the one
    /// before, above 0 to 1. `is_new_goal`: the film is another than it was.
    pub fn step(&mut self, now_secs: f64, since_secs: f64, is_new_goal: bool) -> f32 {
        if !self.is_slow || since_secs == f64::INFINITY {
            self.settles_at = None;
            return 1.0;
        }
        if is_new_goal {
            self.settles_at = Some(now_secs + SETTLE_SECS);
        }
        if self.settles_at.is_none_or(|settles_at| now_secs >= settles_at) {
            self.settles_at = None;
            return 1.0;
        }
        (1.0 - (-since_secs / ADAPT_SECS).exp()) as f32
    }
}
