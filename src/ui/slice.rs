//! Slices of a frame for searches that run beside the frames.

use std::sync::LazyLock;

use web_time::Instant;

/// Longest slice of a frame, in milliseconds; a step that has begun is finished.
const SLICE_MS: f64 = 2.0;

/// A steady clock, in milliseconds from any start.
#[derive(Clone, Copy, Debug)]
pub struct Clock(pub fn() -> f64);

impl Default for Clock {
    fn default() -> Self {
        Self(since_first_use_ms)
    }
}

fn since_first_use_ms() -> f64 {
    static START: LazyLock<Instant> = LazyLock::new(Instant::now);
    START.elapsed().as_secs_f64() * 1e3
}

/// Runs steps for a slice, at least one; returns whether there are more.
///
/// `step` returns false once nothing is left to do; `now_ms` is any steady clock.
pub fn run(now_ms: &mut dyn FnMut() -> f64, mut step: impl FnMut() -> bool) -> bool {
    let began_ms = now_ms();
    while step() {
        if now_ms() - began_ms >= SLICE_MS {
            return true;
        }
    }
    false
}
