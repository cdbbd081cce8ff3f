//! The anchors of a view that moves: one at hand, and the next on its way.
//!
//! In: scenes as they come. Out: the [`RenderSpace`] of each. A search is made in pieces beside the
//! frames, and begins before it is needed: an anchor serves views some hundred times as fine as the
//! one that it was found for, and is replaced long before.

use std::sync::Arc;

use web_time::Instant;

use super::{
    Region,
    schedule::Pace,
    space::{RenderSpace, plain_footprint, wants_anchor},
};
use crate::{
    fractal::{
        Reference,
        deep::{self, Search},
    },
    scene::{PrecisePoint, Scene},
};

/// The time that a frame has for a search, milliseconds.
const BUDGET_MS: f64 = 2.0;
/// A search begins once the eye has moved by so much of the depth that the anchor was found at.
const RENEWED_AFTER: f64 = 0.5;
/// The anchor is no good any more where it is so many times as far from the eye as what is seen.
const MOST_AWAY: f64 = 300.0;
/// Plain views have an anchor ready whose pixels are so many times as large as those that want one.
const AHEAD: f64 = 30.0;

/// The anchors of one view.
#[derive(Default)]
pub struct Anchors {
    at_hand: Option<Found>,
    search: Option<(Search, PrecisePoint)>,
    took_ms: f64,
}

/// An anchor, and where it was looked for.
struct Found {
    reference: Arc<Reference>,
    eye: PrecisePoint,
}

impl Found {
    /// How far the eye is from where the anchor was found, in depths of the anchor then.
    fn moved(&self, scene: &Scene) -> f64 {
        let depth = (&self.eye - self.reference.anchor()).length();
        (&scene.camera.position - &self.eye).length() / depth.max(f64::MIN_POSITIVE)
    }

    fn serves(&self, scene: &Scene) -> bool {
        if !self.reference.is_of(&scene.fractal) {
            return false;
        }
        let space = RenderSpace::about(self.reference.clone(), scene);
        let nearest = space.nearest(scene);
        self.moved(scene) <= RENEWED_AFTER || space.scale() <= MOST_AWAY * nearest
    }
}

impl Anchors {
    /// Where the coordinates of a scene begin; none yet where it has to wait for an anchor, which
    /// further calls bring nearer. What a still has depends on nothing but itself.
    pub fn space(&mut self, scene: &Scene, region: Region, pace: Pace) -> Option<RenderSpace> {
        if pace == Pace::Still {
            return Some(RenderSpace::of(scene, region));
        }
        let began = Instant::now();
        let space = self.space_of_frame(scene, region);
        self.took_ms = began.elapsed().as_secs_f64() * 1e3;
        space
    }

    /// CPU milliseconds that the last scene took.
    pub fn took_ms(&self) -> f64 {
        self.took_ms
    }

    fn space_of_frame(&mut self, scene: &Scene, region: Region) -> Option<RenderSpace> {
        if !wants_anchor(scene, region) {
            if deep::has_depth(&scene.fractal)
                && plain_footprint(scene, region) < AHEAD * deep::COARSEST_FOOTPRINT
            {
                self.renew(scene, region);
            } else {
                *self = Self::default();
            }
            return Some(RenderSpace::plain());
        }
        self.renew(scene, region);
        let found = self.at_hand.as_ref().filter(|found| found.serves(scene))?;
        Some(RenderSpace::about(found.reference.clone(), scene))
    }

    /// Whether views want an anchor, or are about to.
    pub fn are_near(&self) -> bool {
        self.at_hand.is_some() || self.search.is_some()
    }

    /// The newest anchor's orbit.
    pub fn reference(&self) -> Option<Arc<Reference>> {
        Some(self.at_hand.as_ref()?.reference.clone())
    }

    /// Goes on with a search, for as long as a frame has time for it.
    fn renew(&mut self, scene: &Scene, region: Region) {
        let at_hand = self.at_hand.as_ref().filter(|found| found.reference.is_of(&scene.fractal));
        if self.search.is_none() && at_hand.is_none_or(|found| found.moved(scene) > RENEWED_AFTER) {
            let older = at_hand.map(|found| &found.reference);
            let search = Search::new(&scene.fractal, &scene.camera, region.aspect(), older);
            self.search = search.map(|search| (search, scene.camera.position.clone()));
        }
        let began = Instant::now();
        while let Some((search, eye)) = &mut self.search {
            if let Some(reference) = search.step() {
                self.at_hand = Some(Found { reference, eye: eye.clone() });
                self.search = None;
            } else if began.elapsed().as_secs_f64() * 1e3 > BUDGET_MS {
                break;
            }
        }
    }
}
