//! Fills the film between the pixels of a sparse lattice, along edges.

use crate::render::{
    display_parts::{DisplayPart, PartRange},
    lattice::Grid,
    pipeline_set,
    recorder::{ONE_MODE, Pass, Record, Recorder},
    schedule::Display,
};

/// The pass.
pub const PASS: Pass = Pass {
    name: "fill",
    groups: |layouts| vec![&layouts.frame, &layouts.gbuffer, &layouts.film],
    set: &pipeline_set::ALWAYS,
    modes: ONE_MODE,
    record: Record::Film {
        parts: PartRange::only(DisplayPart::Fill),
        when: |_, display| display.fill,
        record,
    },
};

/// Fills every level below that of `display`, except kept pixels, coarsest first: each level reads the one before.
pub fn record(recorder: &mut Recorder<'_>, display: &Display) {
    let pipeline = recorder.pipeline(&PASS, 0);
    for finer in (0..display.level).rev() {
        let grid = Grid::added(finer, recorder.inputs.frame.size_px);
        if grid.workgroups() > 0 {
            recorder.dispatch_grid(&pipeline, &grid, 1 << (finer / 2), display.kept);
        }
    }
}
