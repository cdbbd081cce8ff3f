//! Records pieces of work as passes, in the order of [`PASSES`].

use super::{
    pass::{PASSES, Record},
    recorder::{Display, Recorder},
    schedule::Work,
};

/// Records each pass of [`PASSES`] whose `when` holds for the work.
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
