//! Parts of a view: what its pictures took, the newest of them, what is submitted, what other views lend.

use std::sync::Arc;

use crate::render::{
    display_parts::PartRange,
    histogram_readback::HistogramReadback,
    indirect::IndirectSource,
    post::{Need, Post, Tasks},
    schedule::{Display, Work},
    targets::Targets,
};

/// The longest time between two pumps that counts as work, seconds: a hidden page isn't pumped.
const MAX_WORK_STEP_SECS: f64 = 5.0;

/// When a view changed, how long it has worked since, and what its pictures took.
#[derive(Clone, Debug, Default)]
pub struct Times {
    /// The present moment on the caller's clock, seconds.
    now_secs: f64,
    /// The moment of the last change, seconds.
    changed_secs: f64,
    /// Time since the last change during which there was work to do, seconds.
    worked_secs: f64,
    /// True if there was work to do at the present moment.
    pub is_working: bool,
    /// GPU time of the work since the newest picture, milliseconds.
    busy_ms: f64,
    /// GPU time that the newest picture took, milliseconds.
    pub frame_ms: f64,
    /// Pictures so far.
    pub pictures: u64,
    /// The GPU times of pieces of work, if they are recorded.
    pieces: Option<Vec<PieceTime>>,
}

/// The GPU time of one submit of a view, a piece of work or parts of a display, as
/// [`Stopwatch`](crate::gpu::timing::Stopwatch) measures it.
#[derive(Clone, Copy, Debug)]
pub struct PieceTime {
    /// The piece.
    pub work: Work,
    /// The parts of a display in parts; none of other work.
    pub parts: Option<PartRange>,
    /// Its time, milliseconds.
    pub busy_ms: f64,
}

/// What a view has submitted, for its stopwatch.
#[derive(Clone, Copy, Debug)]
pub struct Submitted {
    /// The piece of work.
    pub work: Work,
    /// The parts of a display in parts; none of other work.
    pub parts: Option<PartRange>,
}

/// What a piece of work is recorded from, beside the scene.
#[derive(Clone, Copy, Debug)]
pub struct Recording {
    /// The piece of work.
    pub work: Work,
    /// The post passes of a display.
    pub tasks: Tasks,
    /// The lattice level that a display is upsampled from.
    pub upsample_level: Option<u32>,
    /// Whether a display shows denoised light.
    pub denoises: bool,
}

impl Times {
    /// Adds the GPU time of a piece of work that has finished, or of parts of a display.
    pub fn add(&mut self, piece: PieceTime) {
        if let Some(pieces) = &mut self.pieces {
            pieces.push(piece);
        }
        self.busy_ms += piece.busy_ms;
    }

    /// Notes that a picture is complete.
    pub fn note_picture(&mut self) {
        self.frame_ms = std::mem::take(&mut self.busy_ms);
        self.pictures += 1;
    }

    /// Sets whether the times of pieces are recorded; those recorded before are dropped at a change.
    pub fn watch_pieces(&mut self, wanted: bool) {
        if wanted != self.pieces.is_some() {
            self.pieces = wanted.then(Vec::new);
        }
    }

    /// Returns the times of the pieces that have been recorded since the last call.
    pub fn take_pieces(&mut self) -> Vec<PieceTime> {
        self.pieces.as_mut().map(std::mem::take).unwrap_or_default()
    }

    /// Moves the present moment on.
    pub fn advance(&mut self, now_secs: f64) {
        if self.is_working {
            self.worked_secs += (now_secs - self.now_secs).clamp(0.0, MAX_WORK_STEP_SECS);
        }
        self.now_secs = now_secs;
    }

    /// Notes a change of the picture.
    pub fn note_change(&mut self) {
        self.changed_secs = self.now_secs;
        self.worked_secs = 0.0;
    }

    /// The present moment on the caller's clock, seconds.
    pub fn now_secs(&self) -> f64 {
        self.now_secs
    }

    /// Seconds of work since the last change, without the time at which there was nothing to do.
    pub fn elapsed_secs(&self) -> f64 {
        self.worked_secs
    }

    /// Seconds since the last change.
    pub fn unchanged_secs(&self) -> f64 {
        self.now_secs - self.changed_secs
    }
}

/// The texture of the newest picture; while a new region has none, that of the old one.
#[derive(Debug, Default)]
pub struct Shown {
    texture: Option<wgpu::Texture>,
    generation: u64,
}

impl Shown {
    /// Notes that the display texture of `targets` holds a picture.
    pub fn note(&mut self, targets: &Targets) {
        if self.texture.as_ref() != Some(&targets.texture) {
            self.texture = Some(targets.texture.clone());
            self.generation += 1;
        }
    }

    /// The texture; none before the first picture.
    pub fn texture(&self) -> Option<&wgpu::Texture> {
        self.texture.as_ref()
    }

    /// Changes whenever [`Self::texture`] is another texture than before.
    pub fn generation(&self) -> u64 {
        self.generation
    }

    /// The texture that is shown beside that of `targets`, of an old size.
    pub fn older_than(&self, targets: &Targets) -> Option<&wgpu::Texture> {
        self.texture.as_ref().filter(|texture| **texture != targets.texture)
    }
}

/// Results that a view of a part of a picture borrows from a view of the whole.
#[derive(Default)]
pub struct Lent {
    /// What is known of the whole film.
    pub post: Option<Arc<Post>>,
    /// Where indirect light comes from.
    pub indirect_source: Option<IndirectSource>,
}

/// Which statistics describe the film as it is.
#[derive(Clone, Copy, Debug, Default)]
pub struct StatsValidity {
    /// The mean.
    pub mean: bool,
    /// The histogram.
    pub histogram: bool,
}

impl StatsValidity {
    /// The post passes that the next piece of work runs; afterwards their statistics are valid.
    ///
    /// `need`: the passes of the scene; none if another view lends their results.
    pub fn tasks(
        &mut self,
        work: Work,
        need: Option<Need>,
        histogram: &HistogramReadback,
    ) -> Tasks {
        let Work::Display(Display { fill, adapt, .. }) = work else {
            *self = Self::default();
            return Tasks::default();
        };
        if fill {
            *self = Self::default();
        }
        let Some(need) = need else { return Tasks::default() };
        let tasks = Tasks {
            mean: need.mean && !self.mean,
            histogram: histogram.is_wanted() && !self.histogram,
            adapt: need.mean.then_some(adapt),
            bloom: need.bloom,
        };
        self.mean |= tasks.mean;
        self.histogram |= tasks.histogram;
        tasks
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::schedule::KeptPixels;

    #[test]
    fn pieces_are_recorded_only_while_their_times_are_wanted() {
        let work = Work::Display(Display {
            level: 0,
            fill: false,
            from_film: false,
            adapt: 1.0,
            kept: KeptPixels::default(),
            refines: false,
        });
        let mut times = Times::default();
        let recorded = |times: &mut Times, busy_ms: f64| {
            times.add(PieceTime { work, parts: None, busy_ms });
            times.take_pieces().iter().map(|piece| piece.busy_ms).collect::<Vec<_>>()
        };
        assert!(recorded(&mut times, 1.0).is_empty(), "not yet");
        times.watch_pieces(true);
        assert_eq!(recorded(&mut times, 2.0), [2.0], "from the first one on");
        times.add(PieceTime { work, parts: None, busy_ms: 3.0 });
        times.watch_pieces(true);
        assert_eq!(recorded(&mut times, 4.0), [3.0, 4.0]);
        times.watch_pieces(false);
        assert!(recorded(&mut times, 5.0).is_empty());
    }
}
