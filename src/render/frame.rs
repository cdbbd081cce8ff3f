//! Records one batch of an integrator's work, or parts of a display.

use super::{
    display_parts::DisplayPart,
    integrator::Integrator,
    pass::{self, Record, shutter},
    recorder::Recorder,
    schedule::{Points, Work},
};

/// Records each pass whose `when` holds for the work, in the order of the table.
pub fn record(integrator: &Integrator, recorder: &mut Recorder<'_>, work: Work) {
    match work {
        Work::Trace(trace) => {
            let grid = trace.points.grid(recorder.inputs.frame.size_px);
            let passes = match trace.points {
                Points::Samples { .. } => integrator.jittered_passes,
                _ => integrator.center_passes,
            };
            for pass in passes {
                if let Record::Trace { when, record } = pass.record
                    && when(recorder, &trace)
                {
                    record(recorder, &trace, &grid);
                }
            }
        }
        Work::Display(display) => {
            if let Some(sub_frame) = recorder.inputs.sub_frame
                && recorder.parts.contains(DisplayPart::Fill)
            {
                shutter::record(recorder, sub_frame.index);
                if !sub_frame.is_last() {
                    return;
                }
            }
            let sparse_level = recorder.upsample_level;
            for pass in pass::DISPLAY {
                match (&pass.record, sparse_level) {
                    (Record::Sparse { record }, Some(level)) => record(recorder, level),
                    (Record::Film { parts, when, record }, None)
                        if recorder.parts.overlaps(*parts) && when(recorder, &display) =>
                    {
                        record(recorder, &display);
                    }
                    _ => {}
                }
            }
        }
    }
}
