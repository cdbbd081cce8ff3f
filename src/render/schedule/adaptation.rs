//! How auto exposure follows the film: over some tenths of a second where someone watches.

/// Least time between two displays that only adapt exposure, seconds.
pub const ADAPT_INTERVAL_SECS: f64 = 0.03;

/// Largest part of GPU time that displays take which only adapt exposure.
pub const ADAPT_SHARE: f64 = 0.2;

/// Time constant of exposure, seconds: it moves 1 − 1/e of the way to its goal in this time.
const ADAPT_SECS: f64 = 0.15;

/// Time after which exposure jumps to its goal, seconds: the rest of a change by two stops is
/// invisible then.
const SETTLE_SECS: f64 = 0.9;

/// Progress of auto exposure toward its goal.
#[derive(Clone, Copy, Debug, Default)]
pub struct Adaptation {
    /// Whether exposure moves gradually.
    is_slow: bool,
    /// Time at which exposure reaches its goal; none once there.
    settles_at: Option<f64>,
}

impl Adaptation {
    /// Sets whether exposure moves gradually, or jumps to its goal.
    pub fn set_slow(&mut self, is_slow: bool) {
        self.is_slow = is_slow;
        if !is_slow {
            self.settles_at = None;
        }
    }

    /// Ends the movement: exposure jumps to its next goal.
    pub fn stop(&mut self) {
        self.settles_at = None;
    }

    /// Whether exposure is still moving.
    pub fn is_under_way(&self) -> bool {
        self.settles_at.is_some()
    }

    /// Part of the way to its goal that exposure moves, above 0 to 1.
    ///
    /// The display is at `now_secs`, `since_secs` after the one before. `is_new_goal`: the film has
    /// changed.
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
