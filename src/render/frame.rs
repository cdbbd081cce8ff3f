//! The passes of a frame, in the order in which they run.

use super::{
    pass::{PASSES, Record},
    recorder::{Display, Recorder},
    schedule::Work,
};

/// Records one piece of work: those of [`PASSES`] that the work has, in order.
pub fn record(recorder: &mut Recorder<'_>, work: Work) {
    match work {
        Work::Trace(trace) => {
            let grid = trace.points.grid(recorder.inputs.frame.size_px);
            for pass in PASSES {
                if let Record::Trace { when, record } = pass.record
                    && when(recorder, &trace)
                {
                    record(recorder, &trace, &grid);
                }
            }
        }
        Work::Show { level, fill, .. } => {
            let display = Display { level, fill };
            for pass in PASSES {
                if let Record::Display { when, record } = pass.record
                    && when(recorder, &display)
                {
                    record(recorder, &display);
                }
            }
        }
    }
}
