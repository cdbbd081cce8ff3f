//! What a schedule is told, and what it says of itself.

/// How a view spends GPU time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pace {
    /// Someone is watching: sparse lattices while things change, small slices.
    Interactive,
    /// A still: straight to all samples, larger slices.
    Still,
}

/// What an edit makes stale; each level contains those before it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Stale {
    /// Exposure, tone curve: the film stays.
    Tone,
    /// How indirect light is gathered: the centre samples' direct light stays.
    Indirect,
    /// Lights, surface, colours: the centre samples' G-buffer stays, but for the bits of lights
    /// that moved. Those are told apart by [`Schedule::set_lights`](super::Schedule::set_lights).
    Light,
    /// How normals are found: the centre samples' depths stay.
    Normals,
    /// Camera, fractal, size: nothing stays.
    Geometry,
}

/// What the schedule says of itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Status {
    /// Whole samples on the film; 0 while the lattice is incomplete.
    pub samples_done: u32,
    /// The same with what has been submitted of those under way.
    pub samples_so_far: f32,
    /// Level of the lattice in the picture shown last.
    pub shown_level: u32,
    /// True once something of the last change has been shown.
    pub shown: bool,
    /// True while the opening lattice follows a movement.
    pub moving: bool,
    /// True when there is no more work.
    pub idle: bool,
}
