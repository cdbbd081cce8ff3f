//! Submits pieces of work; a display that takes long in parts, one after another.

use super::{
    View,
    parts::{PieceTime, Recording, Submitted},
};
use crate::render::{
    display_parts::{DisplayPart, PartRange, Rows},
    frame,
    lattice::WORKGROUP_THREADS,
    pass::denoise,
    post::Tasks,
    recorder::Recorder,
    schedule::{Display, Stage, Work},
};

impl View {
    /// Submits a piece of work; of a display, the parts that may be submitted now.
    pub(super) fn submit(&mut self, work: Work) {
        self.fit_batch(work);
        let upsample_level = self.upsample_level(work);
        // Sub-frames before the last are not shown.
        let is_shown = self.sub_frame.is_none_or(|sub_frame| sub_frame.is_last());
        let is_unseen_display = matches!(work, Work::Display(_)) && !is_shown;
        let tasks = match upsample_level {
            Some(_) => Tasks::default(),
            None if is_unseen_display => Tasks::default(),
            None => self.stats_validity.tasks(work, self.post_need(), &self.histogram_readback),
        };
        let recording = Recording { work, tasks, upsample_level, denoises: self.denoises() };
        match work {
            Work::Display(display) if upsample_level.is_none() && is_shown => {
                self.display_division.begin(self.parts_of(&display, &recording));
                self.display_under_way = Some(recording);
                self.continue_display();
            }
            _ => self.record(recording, None),
        }
        if upsample_level.is_some() && is_shown {
            self.note_picture();
        }
    }

    /// Submits the next parts of the display under way, if those before have ended. Returns false if there were none left.
    pub(super) fn continue_display(&mut self) -> bool {
        let had_parts_left = self.is_amid_display();
        if let Some(parts) = self.display_division.next_parts() {
            self.submit_parts(parts);
        }
        had_parts_left
    }

    /// Whether parts of a display are left to submit.
    pub fn is_amid_display(&self) -> bool {
        self.display_division.has_parts_left()
    }

    /// Leaves the denoiser out of the display under way, and shows the film again after it: without a graphics card the denoiser takes
    /// seconds, which nobody waits for whose change is to be shown.
    pub(super) fn skip_denoiser(&mut self) {
        if self.display_division.skip_denoiser()
            && let Some(recording) = &mut self.display_under_way
        {
            recording.denoises = false;
            self.schedule.show_again();
        }
    }

    /// Submits all parts that are left but the denoiser's, one submit after another, before a change of what they read or write.
    pub(super) fn finish_display(&mut self) {
        self.skip_denoiser();
        while let Some(parts) = self.display_division.next_parts_without_waiting() {
            self.submit_parts(parts);
        }
    }

    fn submit_parts(&mut self, parts: PartRange) {
        let Some(recording) = self.display_under_way else { return };
        self.record(recording, Some(parts));
        if parts.are_last() {
            self.display_under_way = None;
            self.note_picture();
        }
    }

    fn note_picture(&mut self) {
        self.shown.note(&self.targets);
        self.histogram_readback.note_picture();
    }

    /// The parts of a display that is made of the film, in order.
    fn parts_of(&self, display: &Display, recording: &Recording) -> Vec<DisplayPart> {
        let has_sub_frames = self.inputs.as_ref().is_some_and(|inputs| inputs.sub_frame.is_some());
        let fills = display.fill || has_sub_frames;
        let tasks = recording.tasks;
        let has_statistics = tasks.mean || tasks.histogram || tasks.adapt.is_some();
        let divided: Vec<_> = match self.pipelines.gpu.cpu {
            Some(_) => Rows::runs(self.region.film_px()).collect(),
            None => vec![Rows::ALL],
        };
        let denoises = recording.denoises.then(|| denoise::parts(divided.iter().copied()));
        // Rows of two pictures are seen together only where one is a finer one of the other.
        let toned = if display.refines { divided.clone() } else { vec![Rows::ALL] };
        let parts = fills.then_some(DisplayPart::Fill).into_iter();
        parts
            .chain(has_statistics.then_some(DisplayPart::Statistics))
            .chain(tasks.bloom.then_some(DisplayPart::Bloom))
            .chain(denoises.into_iter().flatten())
            .chain(toned.into_iter().map(DisplayPart::Tone))
            .collect()
    }

    /// The lattice level from which a display is upsampled; none if it is made of the film.
    fn upsample_level(&mut self, work: Work) -> Option<u32> {
        let picture = &self.inputs.as_ref()?.frame;
        let is_plain = picture.eyes.count == 1
            && self.lent.post.is_none()
            && self.targets.post.need().is_none()
            && !self.histogram_readback.is_wanted();
        self.reconstruction.upsample_level(
            work,
            is_plain,
            self.targets.finest_upsampled_level(picture.size_px),
        )
    }

    /// Makes the buffers of a batch fit a piece of work.
    ///
    /// Pieces are sized by time: a GPU that traces so many rays in one is a large one. Shading alone says nothing of it.
    fn fit_batch(&mut self, work: Work) {
        let (Work::Trace(trace), Some(inputs)) = (work, &self.inputs) else { return };
        let workgroups = trace.samples() / WORKGROUP_THREADS;
        let layouts = &self.pipelines.layouts;
        if trace.from <= Stage::March && self.targets.fit_batch(layouts, workgroups) {
            (self.integrator.fit_targets)(&mut self.targets, layouts, inputs);
        }
    }

    /// Records and submits passes; of a display in parts, those of `parts`.
    fn record(&mut self, recording: Recording, parts: Option<PartRange>) {
        let Recording { work, tasks, upsample_level, denoises } = recording;
        let Some(inputs) = &self.inputs else { return };
        let passes = self.pipelines.of_frame(inputs);
        let (layouts, dispatches) = (&self.pipelines.layouts, &mut self.dispatches);
        let batches = work.batches(self.targets.batch_workgroups);
        let commands = batches.map(|batch| {
            let name = work.name();
            let mut recorder =
                Recorder::named(name, layouts, &passes, &self.targets, inputs, dispatches);
            recorder.parts = parts.unwrap_or(PartRange::ALL);
            recorder.tasks = tasks;
            recorder.upsample_level = upsample_level;
            recorder.denoises = denoises;
            if let Some(lent) = &self.lent.post {
                recorder.post = lent;
            }
            if let Some(lent) = &self.lent.indirect_source {
                recorder.indirect_source = lent.clone();
            }
            frame::record(self.integrator, &mut recorder, batch);
            recorder.finish()
        });
        self.stopwatch.submit(&self.pipelines.gpu, commands, Some(Submitted { work, parts }));
    }

    /// Collects the timings of the work that the GPU has finished.
    pub(super) fn collect(&mut self) {
        self.pipelines.gpu.poll();
        let mut ended = Vec::new();
        while let Some(finished) = self.stopwatch.next_finished() {
            let Some(Submitted { work, parts }) = finished.mark else {
                ended.push((None, finished.busy_ms));
                continue;
            };
            let busy_ms = finished.busy_ms;
            self.times.add(PieceTime { work, parts, busy_ms });
            let whole_ms = match parts {
                Some(parts) => self.display_division.ended(parts, busy_ms),
                None => Some(busy_ms),
            };
            let Some(whole_ms) = whole_ms else { continue };
            if matches!(work, Work::Display(_)) {
                self.times.note_picture();
            }
            ended.push((Some(work), whole_ms));
        }
        self.schedule.collect(&ended);
    }
}
