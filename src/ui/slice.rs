//! Slices of a frame for searches that run beside the frames.

use std::{ops::RangeInclusive, sync::LazyLock};

use web_time::Instant;

/// The part of a frame that a slice takes: slow frames give searches more, or these would end when the camera is
/// already elsewhere.
const FRAME_PART: f64 = 0.12;
/// Lengths of slices, in milliseconds; a step that has begun is finished.
const SLICE_MS: RangeInclusive<f64> = 2.0..=40.0;

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

/// A slice of one frame.
pub struct Slice<'a> {
    /// Any steady clock, in milliseconds.
    now_ms: &'a mut dyn FnMut() -> f64,
    /// The slice's length, in milliseconds.
    length_ms: f64,
}

impl<'a> Slice<'a> {
    /// A slice of a frame that takes `frame_secs`; `now_ms` is any steady clock.
    pub fn of(frame_secs: f32, now_ms: &'a mut dyn FnMut() -> f64) -> Self {
        let length_ms = FRAME_PART * 1e3 * f64::from(frame_secs);
        // Unlike `clamp`, this takes the shortest length for a frame time that is NaN.
        let length_ms = length_ms.max(*SLICE_MS.start()).min(*SLICE_MS.end());
        Self { now_ms, length_ms }
    }

    /// Runs steps, at least one; returns whether there are more.
    ///
    /// `step` returns false once nothing is left to do.
    pub fn run(&mut self, mut step: impl FnMut() -> bool) -> bool {
        let began_ms = (self.now_ms)();
        while step() {
            if (self.now_ms)() - began_ms >= self.length_ms {
                return true;
            }
        }
        false
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slice_has_the_steps_that_fit_its_time() {
        // The frame's seconds, a step's milliseconds and the number of steps.
        let cases = [
            (0.016, 0.25, 8),
            (0.016, 0.5, 4),
            (0.016, 1.5, 2),
            (0.016, 30.0, 1),
            (0.0, 0.5, 4),
            (f32::NAN, 0.5, 4),
            (0.125, 0.5, 30),
            (0.25, 0.5, 60),
            (60.0, 0.5, 80),
        ];
        for (frame_secs, step_ms, expected) in cases {
            let (mut steps, mut at_ms) = (0, 1e6);
            let mut now_ms = || {
                at_ms += step_ms;
                at_ms
            };
            let has_more = Slice::of(frame_secs, &mut now_ms).run(|| {
                steps += 1;
                true
            });
            assert!(has_more);
            assert_eq!(steps, expected, "frames of {frame_secs} s, steps of {step_ms} ms");
        }
        let mut left = 3;
        let mut stopped = || 0.0;
        assert!(!Slice::of(0.016, &mut stopped).run(|| {
            left -= 1;
            left > 0
        }));
        assert_eq!(left, 0);
    }
}
