//! What a schedule is told, and what it reports: plain types that its other files share.

/// Most pieces of work in flight.
pub const MAX_IN_FLIGHT: usize = 2;

/// How a view spends GPU time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pace {
    /// Someone is watching: sparse lattices while things change, small pieces.
    Interactive,
    /// A still: straight to all samples, larger pieces.
    Still,
}

/// What a piece of work is for. Openings and refining pieces have costs of their own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// The first picture of a change.
    Opening,
    /// The first picture of another view, which may cost many times what the last one cost.
    Jump,
    /// All work that follows that picture.
    Refining,
}

/// How kernels raise a power.
///
/// The cost of a ray depends on this more than on anything else that changes between two moving
/// pictures.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Arithmetic {
    /// By pipelines for one whole power.
    #[default]
    SpecializedPipeline,
    /// By pipelines for any whole power.
    Whole,
    /// By series, for real powers.
    Real,
    /// By differences to an anchor's orbit.
    Deep,
}

/// What an edit makes stale; each level contains those before it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Stale {
    /// Exposure, tone curve: the film stays.
    Tone,
    /// How indirect light is gathered: the centre samples' direct light stays.
    Indirect,
    /// Lights, surface, colours: the centre samples' G-buffer stays, except the bits of lights
    /// that moved, which [`Schedule::set_lights`](super::Schedule::set_lights) names.
    Light,
    /// How normals are found: the centre samples' depths stay.
    Normals,
    /// Camera, fractal, size: nothing stays.
    Geometry,
}

/// State of a schedule, for its view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Status {
    /// Whole samples on the film; 0 while the lattice is incomplete.
    pub samples_done: u32,
    /// `samples_done` with the submitted part of the samples under way.
    pub samples_so_far: f32,
    /// Level of the lattice in the newest display, which may be under way.
    pub shown_level: u32,
    /// True once a display of the last change has begun.
    pub shown: bool,
    /// True while the opening lattice follows a movement.
    pub moving: bool,
    /// True when there is no more work.
    pub idle: bool,
}
