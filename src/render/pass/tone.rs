//! Film to display: exposure, tone curve, bloom, sRGB, dither.

use crate::render::{
    display_parts::{DisplayPart, PartRange, Rows},
    lattice::Grid,
    pipeline_set,
    recorder::{Pass, Record, Recorder},
    schedule::Display,
    uniforms::DispatchParams,
};

/// The pass.
pub const PASS: Pass = Pass {
    name: "tone",
    groups: |layouts| vec![&layouts.frame, &layouts.post, &layouts.film, &layouts.denoised],
    set: &pipeline_set::TONE,
    modes: &[&[("SPARSE", 0)], &[("SPARSE", 1)]],
    record: Record::Film { parts: PARTS, when: |_, _| true, record },
};

/// All rows.
const PARTS: PartRange = PartRange {
    first: DisplayPart::Tone(Rows { first: 0, end: 0 }),
    last: DisplayPart::Tone(Rows { first: u32::MAX, end: u32::MAX }),
};

/// Tone maps the film of the region to the display picture.
pub fn record(recorder: &mut Recorder<'_>, &Display { level, .. }: &Display) {
    // The first mode is for a complete film, the second for a sparse lattice.
    let pipeline = recorder.pipeline(&PASS, usize::from(level != 0));
    recorder.bind_post();
    let spacing = if level == 0 { 0 } else { 1 << (level / 2) };
    let whole = Grid::level(0, recorder.inputs.frame.size_px);
    recorder.bind(3, &recorder.targets.denoiser.output_group);
    let denoised = u32::from(recorder.denoises);
    let params = DispatchParams { spacing, denoised, ..whole.dispatch_params(0) };
    recorder.dispatch_rows(&pipeline, params, recorder.parts.rows_of(DisplayPart::Tone));
}
