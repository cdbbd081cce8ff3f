//! How much of the current picture has been computed, and what is still to be done for a sample.
//!
//! In: what became stale, and which points have been submitted. Out: the finest levels that are
//! shaded and on the film, samples so far, and the job of any points.

use super::{
    gbuffer_validity::GBufferValidity,
    plan::Plan,
    types::Stale,
    work::{Job, Points, Stage},
};

/// Progress of one picture, from a change to the last sample.
#[derive(Clone, Debug)]
pub struct Progress {
    /// Where the integrator's work starts.
    pub plan: &'static Plan,
    /// Width and height of the region, pixels.
    pub size_px: [u32; 2],
    /// Validity of the centre samples' G-buffer.
    pub gbuffer_validity: GBufferValidity,
    /// The visibility bits of the lights that shine.
    pub shining: u64,
    /// Finest level whose every centre sample is shaded.
    pub shaded: Option<u32>,
    /// Whether there is indirect light.
    pub has_indirect: bool,
    /// Finest level that has its indirect light.
    indirect_shaded: Option<u32>,
    /// Whole samples of every pixel.
    pub samples_done: u32,
    /// The points under way and the next workgroup to submit.
    pub under_way: Option<(Points, u32)>,
    /// Whether a filled preview is on the film while pixels are under way.
    pub is_filled: bool,
}

impl Progress {
    /// Progress of a region of which nothing is computed.
    pub fn new(plan: &'static Plan, size_px: [u32; 2]) -> Self {
        Self {
            plan,
            size_px,
            gbuffer_validity: GBufferValidity::default(),
            shining: 0,
            shaded: None,
            has_indirect: false,
            indirect_shaded: None,
            samples_done: 0,
            under_way: None,
            is_filled: false,
        }
    }

    /// Discards what a change makes stale: of [`Stale::Tone`] nothing.
    pub fn restart(&mut self, stale: Stale) {
        if stale == Stale::Tone {
            return;
        }
        self.gbuffer_validity.invalidate(stale);
        if stale >= Stale::Light {
            self.shaded = None;
        }
        self.indirect_shaded = None;
        self.samples_done = 0;
        self.under_way = None;
        self.is_filled = false;
    }

    /// The finest level that is on the film.
    pub fn filmed(&self) -> Option<u32> {
        if self.has_indirect { self.indirect_shaded } else { self.shaded }
    }

    /// Samples that are done or under way.
    pub fn samples_begun(&self) -> u32 {
        match self.under_way {
            Some((Points::Samples { first, count }, _)) => first + count,
            _ => self.samples_done,
        }
    }

    /// Marks points as completely submitted. True where the film has changed.
    pub fn complete(&mut self, points: Points) -> bool {
        self.invalidate_visibility_under_paths(points);
        self.under_way = None;
        let is_filmed = match points {
            Points::Level(_) | Points::Added(_) | Points::All => {
                let level = points.level();
                self.shaded = Some(level);
                self.gbuffer_validity.complete(level, self.shining);
                // Levels that wait for indirect light are not on the film yet.
                !self.has_indirect
            }
            Points::Indirect(level) => {
                self.indirect_shaded = Some(level);
                true
            }
            Points::Samples { first, count } => {
                self.samples_done = first + count;
                return true;
            }
        };
        self.samples_done = u32::from(self.filmed() == Some(0));
        is_filmed
    }

    /// Discards the visibility of centre samples if `points` are paths, which keep guides of the denoiser in its place.
    fn invalidate_visibility_under_paths(&mut self, points: Points) {
        let is_sampled = matches!(points, Points::Samples { .. });
        if is_sampled && self.job(points).from == Stage::Path {
            self.gbuffer_validity.invalidate_lights(u64::MAX);
        }
    }

    /// Marks points as submitted up to a workgroup. True where the film can be shown meanwhile.
    pub fn advance(&mut self, points: Points, next_workgroup: u32) -> bool {
        self.invalidate_visibility_under_paths(points);
        self.under_way = Some((points, next_workgroup));
        // The film holds a complete lattice, and pixels under way that need no indirect light.
        let is_filmed = match points {
            Points::All => self.is_filled,
            Points::Level(_) | Points::Added(_) => !self.has_indirect,
            Points::Indirect(_) | Points::Samples { .. } => true,
        };
        is_filmed && self.filmed().is_some()
    }

    /// The stage that points start with, and the lights toward which rays are marched.
    pub fn job(&self, points: Points) -> Job {
        (self.plan.job)(points, &self.gbuffer_validity, self.shining)
    }

    /// Samples done, with the submitted part of those under way.
    pub fn samples_so_far(&self) -> f32 {
        let pixels_at = |level: u32| 1.0 / (1_u64 << level) as f32;
        let share = self.under_way.map_or(0.0, |(points, next)| {
            next as f32 / points.grid(self.size_px).workgroups().max(1) as f32
        });
        let before = match self.samples_done {
            0 => self.shaded.map_or(0.0, pixels_at),
            done => done as f32,
        };
        match self.under_way {
            Some((Points::Samples { count, .. }, _)) => before + count as f32 * share,
            Some((Points::Level(level) | Points::Added(level), _)) => {
                before + (pixels_at(level) - before).max(0.0) * share
            }
            // All points include those of the lattice before.
            Some((Points::All, _)) => before.max(share),
            Some((Points::Indirect(_), _)) | None => before,
        }
    }
}
