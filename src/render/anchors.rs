//! The anchors of a moving view: the current anchor, and a search for the next.
//!
//! In: successive scenes. Out: the [`RenderSpace`] of each. A search runs in steps between
//! frames and begins before its anchor is needed: an anchor serves views some hundred times as fine as
//! the view that it was found for, and is replaced long before.

use std::sync::Arc;

use web_time::Instant;

use super::{
    Region,
    schedule::Pace,
    space::{RenderSpace, plain_footprint},
};
use crate::{
    formula::{ReferenceOrbit, march::COARSEST_FOOTPRINT},
    fractal::{FractalModel, Search},
    scene::{PrecisePoint, Scene},
};

/// Time for the search in one frame, milliseconds.
const BUDGET_MS: f64 = 2.0;
/// Movement of the eye that starts a new search, in depths of the anchor.
///
/// The depth is the anchor's distance from the eye when it was found.
const RENEWED_AFTER: f64 = 0.5;
/// Greatest distance of a usable anchor, in distances from the eye to the surface.
const MAX_AWAY: f64 = 300.0;
/// Greatest footprint of plain views that search for an anchor, over [`COARSEST_FOOTPRINT`].
const AHEAD: f64 = 30.0;

/// The anchors of one view: the current one, and the search for the next.
#[derive(Default)]
pub struct Anchors {
    at_hand: Option<Found>,
    search: Option<(Search, PrecisePoint)>,
    took_ms: f64,
}

/// An anchor, and the eye position for which it was found.
struct Found {
    reference: Arc<dyn ReferenceOrbit>,
    eye: PrecisePoint,
}

impl Found {
    /// Movement of the eye since the anchor was found, in depths of the anchor.
    fn moved(&self, scene: &Scene) -> f64 {
        let depth = (&self.eye - self.reference.anchor()).length();
        (&scene.camera.position - &self.eye).length() / depth.max(f64::MIN_POSITIVE)
    }

    fn serves(&self, model: &FractalModel, scene: &Scene) -> bool {
        if !self.reference.is_of(&scene.fractal) {
            return false;
        }
        let space = RenderSpace::about(model, self.reference.clone(), scene);
        let nearest = space.nearest(scene);
        self.moved(scene) <= RENEWED_AFTER || space.scale() <= MAX_AWAY * nearest
    }
}

impl Anchors {
    /// The render space of a scene; none while the scene waits for an anchor.
    ///
    /// Further calls continue the search. A still always searches to the end, so that its space depends only
    /// on its scene and region.
    pub fn space(
        &mut self,
        model: &FractalModel,
        scene: &Scene,
        region: Region,
        pace: Pace,
    ) -> Option<RenderSpace> {
        if pace == Pace::Still {
            return Some(RenderSpace::of_model(model, scene, region));
        }
        let began = Instant::now();
        let space = self.space_of_frame(model, scene, region);
        self.took_ms = began.elapsed().as_secs_f64() * 1e3;
        space
    }

    /// CPU time that the last scene took, milliseconds.
    pub fn took_ms(&self) -> f64 {
        self.took_ms
    }

    fn space_of_frame(
        &mut self,
        model: &FractalModel,
        scene: &Scene,
        region: Region,
    ) -> Option<RenderSpace> {
        let footprint = plain_footprint(model, scene, region);
        let is_below = |limit| footprint.is_some_and(|footprint| footprint < limit);
        if is_below(COARSEST_FOOTPRINT) {
            self.renew(scene, region);
            let found = self.at_hand.as_ref().filter(|found| found.serves(model, scene))?;
            return Some(RenderSpace::about(model, found.reference.clone(), scene));
        }
        if is_below(AHEAD * COARSEST_FOOTPRINT) {
            self.renew(scene, region);
        } else {
            *self = Self::default();
        }
        Some(RenderSpace::plain(model))
    }

    /// Whether the view is drawn about an anchor, or may be soon.
    pub fn are_near(&self) -> bool {
        self.at_hand.is_some() || self.search.is_some()
    }

    /// The newest anchor's reference orbit.
    pub fn reference(&self) -> Option<Arc<dyn ReferenceOrbit>> {
        Some(self.at_hand.as_ref()?.reference.clone())
    }

    /// Continues or starts a search, for as long as the frame's time allows.
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
