//! What a view says of itself, as plain data that the interface can show.

pub use super::memory::{Memory, mebibytes};

use std::sync::Arc;

/// What the renderer is doing.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Activity {
    /// Nothing: the picture is finished and the GPU rests.
    #[default]
    Idle,
    /// Following a movement on a sparse lattice.
    Moving,
    /// Completing the lattice or adding samples.
    Refining,
    /// A kernel is being prepared; the text names it ("power 5").
    Compiling(String),
}

/// Light of a picture's paths, and what the firefly limit removed; in the same unit.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ClampedLight {
    /// All light, with what was taken away.
    pub light: f64,
    /// What was taken away.
    pub clamped: f64,
}

impl ClampedLight {
    /// The part that was taken away, 0 to 1.
    pub fn fraction(self) -> f64 {
        if self.light > 0.0 { self.clamped / self.light } else { 0.0 }
    }
}

/// The part of the light that the firefly limit removed, as text: `0.34 %`.
pub fn clamped_text(fraction: f64) -> String {
    let percent = 100.0 * fraction;
    if percent > 0.0 && percent < 0.01 {
        "less than 0.01 %".to_owned()
    } else {
        format!("{percent:.2} %")
    }
}

/// Bins of a [`Histogram`].
pub const HISTOGRAM_BINS: usize = 128;

/// log2 of the luminance at which the first bin of a [`Histogram`] begins.
pub const HISTOGRAM_LOW_STOPS: f64 = -14.0;

/// Bins of a [`Histogram`] to each doubling of luminance.
pub const HISTOGRAM_BINS_PER_STOP: f64 = 5.0;

/// The film's pixels by the logarithm of their luminance, before any exposure.
#[derive(Clone, Debug, PartialEq)]
pub struct Histogram {
    /// [`HISTOGRAM_BINS`] counts, from dark to bright; the first and the last also count what lies
    /// beyond them.
    pub bins: Arc<[u32]>,
    /// Stops that auto exposure adds, where it is on.
    pub adapted_stops: f32,
}

/// A view's state, for the status line.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Report {
    /// What it is doing.
    pub activity: Activity,
    /// Width and height of the picture in pixels.
    pub size_px: [u32; 2],
    /// Whole samples that each pixel holds; 0 while the lattice is incomplete.
    pub samples_done: u32,
    /// The same with what there is of those under way, as a share of the pixels; below 1 while the
    /// lattice is incomplete.
    pub samples_so_far: f32,
    /// Samples that each pixel will hold.
    pub samples_wanted: u32,
    /// Share of the pixels that have as little noise as asked for; none without a noise target.
    pub converged_fraction: Option<f32>,
    /// What the firefly limit removed; none without a limit.
    pub clamped_light: Option<ClampedLight>,
    /// One pixel of this many has been computed in the picture shown; 1 once the lattice is complete.
    pub pixels_per_sample: u32,
    /// Seconds of work on the picture since the last change; time at rest is not counted.
    pub elapsed_secs: f64,
    /// GPU milliseconds of the last displayed frame's work, as far as could be measured.
    pub frame_ms: f64,
    /// Least time between two frames of the interface that only report progress, seconds.
    ///
    /// Frames of the interface take GPU time from the picture.
    pub frame_interval_secs: f64,
    /// CPU milliseconds that the last frame of a moving view spent on its anchors.
    pub anchor_ms: f64,
    /// The film's histogram, while the interface [asks](super::View::watch_histogram) for it.
    pub histogram: Option<Histogram>,
    /// What the view holds of the GPU's memory.
    pub memory: Memory,
    /// Pictures finished since the view was made (each display update counts).
    pub pictures: u64,
}

impl Report {
    /// True once the picture is finished. A view without a picture has not started.
    pub fn is_finished(&self) -> bool {
        self.activity == Activity::Idle && self.pictures > 0
    }
}
