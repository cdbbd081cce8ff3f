//! Decides which pixels get no more samples.

use crate::render::{
    pipeline_set,
    recorder::{ONE_MODE, Pass, Record, Recorder},
    uniforms::DispatchParams,
};

/// Samples of a round; the spread of the rounds' means gives a pixel's error.
pub const SAMPLES_PER_ROUND: u32 = 8;

/// Rounds of a pixel from which it may get no more samples.
pub const MIN_ROUNDS: u32 = 4;

/// The pass. A view with a noise target records the pass between its samples.
pub const PASS: Pass = Pass {
    name: "assess_noise",
    groups: |layouts| vec![&layouts.frame, &layouts.traced_paths, &layouts.film],
    set: &pipeline_set::FILM_PATHS,
    modes: ONE_MODE,
    record: Record::Within,
};

/// Assesses all pixels of the region.
pub fn record(recorder: &mut Recorder<'_>) {
    let pipeline = recorder.pipeline(&PASS, 0);
    recorder.bind_traced_paths();
    recorder.bind_film();
    recorder.dispatch_plane(&pipeline, DispatchParams::default());
}
