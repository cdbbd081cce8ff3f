//! Adds the light of finished paths to the film.

use crate::render::{
    lattice::Grid,
    pipeline_set,
    recorder::{ONE_MODE, Pass, Record, Recorder},
    schedule::Trace,
};

/// The pass.
pub const PASS: Pass = Pass {
    name: "film_paths",
    groups: |layouts| {
        vec![&layouts.frame, &layouts.traced_paths, &layouts.film, &layouts.environment_texture]
    },
    set: &pipeline_set::FILM_PATHS,
    modes: ONE_MODE,
    record: Record::Trace { when: |_, _| true, record },
};

/// Films the paths of `trace`.
pub fn record(recorder: &mut Recorder<'_>, trace: &Trace, grid: &Grid) {
    let pipeline = recorder.pipeline(&PASS, 0);
    let params = recorder.dispatch_params(trace, grid);
    recorder.bind_traced_paths();
    recorder.bind_film();
    recorder.bind_environment();
    recorder.dispatch_pixels(&pipeline, params);
}
