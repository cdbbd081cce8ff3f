//! Records pieces of work: an integrator's passes over samples, and the passes of a display.

use super::{
    integrator::Integrator,
    pass::{self, Record},
    recorder::{Display, Recorder},
    schedule::Work,
};

/// Records each pass whose `when` holds for the work, in the order of the pass's table.
pub fn record(integrator: &Integrator, recorder: &mut Recorder<'_>, work: Work) {
    match work {
        Work::Trace(trace) => {
            let grid = trace.points.grid(recorder.inputs.frame.size_px);
            for pass in integrator.passes {
                if let Record::Trace { when, record } = pass.record
                    && when(recorder, &trace)
                {
                    record(recorder, &trace, &grid);
                }
            }
        }
        Work::Display { level, fill, .. } => {
            let display = Display { level, fill };
            for pass in pass::DISPLAY {
                if let Record::Display { when, record } = pass.record
                    && when(recorder, &display)
                {
                    record(recorder, &display);
                }
            }
        }
    }
}
