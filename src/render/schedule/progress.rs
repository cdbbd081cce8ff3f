//! How much of the current picture has been computed, and what is still to be done for a sample.
//!
//! In: what became stale, and which points have been submitted. Out: the finest levels that are
//! shaded and on the film, samples so far, and the job of any points.

use super::{
    gbuffer_validity::GBufferValidity,
    plan::Plan,
    types::Stale,
    work::{Job, KeptPixels, Points, Stage, Trace},
};
use crate::render::region::Overlap;

/// Pixels of the picture before a change of width, while the other pixels catch up with them.
#[derive(Clone, Copy, Debug)]
struct ReusedPixels {
    pixels: KeptPixels,
    /// Whole samples on the film; 0 if it needs other light.
    samples: u32,
    /// Whether the centre samples have the visibility of the lights that shine.
    has_visibility: bool,
}

/// What comes next of a trace that is submitted in parts.
#[derive(Clone, Copy, Debug)]
struct NextPart {
    /// All parts together.
    whole: Trace,
    index: u32,
    count: u32,
    /// The lights that cast shadows, by their visibility bits.
    casting: u64,
}

/// What a picture keeps of the one before it, of another width.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reuse {
    /// Nothing: all pixels are computed.
    Nothing,
    /// Depths and normals of some or all pixels, perhaps with their film.
    Samples,
    /// The film of all pixels: the picture is only displayed.
    Film,
}

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
    /// The points under way and the next block to submit.
    pub under_way: Option<(Points, u32)>,
    /// The next part of the next blocks, if these are submitted in parts.
    next_part: Option<NextPart>,
    /// Whether a filled preview is on the film while pixels are under way.
    pub is_filled: bool,
    /// The pixels that are not computed.
    reused: Option<ReusedPixels>,
    /// Whether all centre samples are there and await their light.
    pub awaits_light: bool,
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
            next_part: None,
            is_filled: false,
            reused: None,
            awaits_light: false,
        }
    }

    /// Sets another region, and returns what of its pixels is there: the caller moves it to its place.
    ///
    /// `overlap`: the pixels that are the same as before. `indirect_radius_px`: how far around a pixel its indirect light
    /// comes from; 0 without indirect light.
    pub fn resize(
        &mut self,
        size_px: [u32; 2],
        overlap: Option<Overlap>,
        indirect_radius_px: u32,
    ) -> Reuse {
        self.size_px = size_px;
        let (first_missing, _) = self.gbuffer_validity.first_missing(0, self.shining);
        let Some(overlap) = overlap.filter(|_| first_missing >= Stage::Shadow) else {
            self.restart(Stale::Geometry);
            return Reuse::Nothing;
        };
        let reused = self.reused_pixels(&overlap, indirect_radius_px, first_missing);
        let KeptPixels { first, end, .. } = reused.pixels;
        if (first, end) != ([0, 0], size_px) {
            self.restart(Stale::Geometry);
            self.reused = Some(reused);
            return Reuse::Samples;
        }
        self.gbuffer_validity.discard_sparse();
        if reused.samples > 0 {
            return Reuse::Film;
        }
        self.restart(Stale::Light);
        Reuse::Samples
    }

    /// The pixels of an overlap whose film is true, or else all of its pixels.
    fn reused_pixels(
        &self,
        overlap: &Overlap,
        indirect_radius_px: u32,
        first_missing: Stage,
    ) -> ReusedPixels {
        // Samples under way are on the film of some pixels only.
        let is_film_even = self.under_way.is_none() && self.reused.is_none();
        let lit = overlap.inset(indirect_radius_px);
        let has_film =
            is_film_even && self.samples_done > 0 && 2 * lit.pixels() >= overlap.pixels();
        ReusedPixels {
            pixels: KeptPixels::of(if has_film { &lit } else { overlap }, self.size_px),
            samples: if has_film { self.samples_done } else { 0 },
            has_visibility: first_missing > Stage::Shadow
                && self.reused.is_none_or(|reused| reused.has_visibility),
        }
    }

    /// The pixels that need not be computed for `points`.
    pub fn kept_pixels(&self, points: Points) -> KeptPixels {
        let kept = self.reused.filter(|reused| match points {
            Points::Samples { first, .. } => first < reused.samples,
            _ => true,
        });
        kept.map_or_else(KeptPixels::default, |kept| kept.pixels)
    }

    /// Samples of the kept pixels, up to which the others catch up; 0 without such pixels.
    pub fn kept_samples(&self) -> u32 {
        self.reused.map_or(0, |reused| reused.samples)
    }

    /// Computes all pixels from now on.
    fn end_reuse(&mut self) {
        let Some(reused) = self.reused.take() else { return };
        if !reused.has_visibility {
            self.gbuffer_validity.invalidate_lights(u64::MAX);
        }
        if reused.samples == 0 {
            // They have the light of another picture.
            self.shaded = None;
        }
    }

    /// Discards what a change makes stale: of [`Stale::Tone`] nothing.
    pub fn restart(&mut self, stale: Stale) {
        if stale == Stale::Tone {
            return;
        }
        self.end_reuse();
        self.awaits_light = false;
        self.gbuffer_validity.invalidate(stale);
        if stale >= Stale::Light {
            self.shaded = None;
        }
        self.indirect_shaded = None;
        self.samples_done = 0;
        self.under_way = None;
        self.next_part = None;
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
                self.awaits_light = false;
                if level == 0 && self.reused.is_some_and(|reused| reused.samples == 0) {
                    self.restart(Stale::Light);
                    self.awaits_light = true;
                    return !self.has_indirect;
                }
                // Levels that wait for indirect light are not on the film yet.
                !self.has_indirect
            }
            Points::Indirect(level) => {
                self.indirect_shaded = Some(level);
                true
            }
            Points::Samples { first, count } => {
                self.samples_done = first + count;
                self.end_reuse_if_even();
                return true;
            }
        };
        self.samples_done = u32::from(self.filmed() == Some(0));
        self.end_reuse_if_even();
        is_filmed
    }

    /// Computes all pixels from now on if the others have as many samples as the kept ones.
    fn end_reuse_if_even(&mut self) {
        if self.samples_done > 0 && self.samples_done >= self.kept_samples() {
            self.reused = None;
        }
    }

    /// Discards the visibility of centre samples if `points` are paths, which keep guides of the denoiser in its place.
    fn invalidate_visibility_under_paths(&mut self, points: Points) {
        let is_sampled = matches!(points, Points::Samples { .. });
        if is_sampled && self.job(points).from == Stage::Path {
            self.gbuffer_validity.invalidate_lights(u64::MAX);
        }
    }

    /// Marks points as submitted up to a block. True where the film can be shown meanwhile.
    pub fn advance(&mut self, points: Points, next_block: u32) -> bool {
        self.invalidate_visibility_under_paths(points);
        self.under_way = Some((points, next_block));
        // The film holds a complete lattice, and pixels under way that need no indirect light.
        let is_filmed = match points {
            Points::All => self.is_filled,
            Points::Level(_) | Points::Added(_) => !self.has_indirect,
            Points::Indirect(_) | Points::Samples { .. } => true,
        };
        is_filmed && self.filmed().is_some()
    }

    /// Begins to submit `whole` in `count` parts: returns the first one. `casting`: the lights that cast shadows.
    pub fn divide(&mut self, whole: Trace, count: u32, casting: u64) -> Trace {
        self.under_way = Some((whole.points, whole.first_block));
        self.begin_part(NextPart { whole, index: 0, count, casting })
    }

    /// Takes the next part of the blocks that are submitted in parts; none if there are none.
    pub fn take_part(&mut self) -> Option<Trace> {
        self.next_part.take().map(|next| self.begin_part(next))
    }

    fn begin_part(&mut self, next: NextPart) -> Trace {
        let NextPart { whole, index, count, casting } = next;
        let part = whole.part(index, count, casting);
        self.next_part = (!part.shades()).then_some(NextPart { index: index + 1, ..next });
        part
    }

    /// The stage that points start with, and the lights toward which rays are marched.
    pub fn job(&self, points: Points) -> Job {
        (self.plan.job)(points, &self.gbuffer_validity, self.shining)
    }

    /// Samples done, with the submitted part of those under way.
    pub fn samples_so_far(&self) -> f32 {
        let pixels_at = |level: u32| 1.0 / (1_u64 << level) as f32;
        let share = self.under_way.map_or(0.0, |(points, next)| {
            next as f32 / points.grid(self.size_px).blocks().max(1) as f32
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
