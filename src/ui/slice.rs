//! Slices of a frame for searches that run beside the frames.

/// Longest slice of a frame, in milliseconds; a step that has begun is finished.
const SLICE_MS: f64 = 2.0;

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
