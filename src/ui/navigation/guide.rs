//! The guide: draws the zoom to good places, and dives by itself.
//!
//! In: the zooms of wheel and pinch, or the time of a dive. Out: the moved camera. The guide searches the view
//! about the pointer for [places](crate::fractal::places) and descends to the best. Searches and plans run in
//! small steps beside the frames, through [`Guide::work`].

use glam::DVec2;

use super::{descent::Descent, world::World};
use crate::{
    fractal::{
        FractalModel,
        places::{Place, PlaceSearch, SearchArea},
    },
    scene::Camera,
};

/// The part of the picture that is searched about the pointer.
const NEAR_POINTER: SearchArea =
    SearchArea { center: DVec2::ZERO, radius: 0.5, rays: 80, count: 4, has_copies: false };
/// The part of the picture that a dive searches.
const NEAR_MIDDLE: SearchArea = SearchArea { radius: 0.7, rays: 96, ..NEAR_POINTER };
/// Distance that the pointer moves, in half heights, until another place is chosen.
const ELSEWHERE: f64 = 0.3;
/// Zoom of a dive per second, as a natural logarithm.
const DIVE_PER_SEC: f64 = 1.1;
/// Seconds in which a dive comes to full speed.
const DIVE_START_SECS: f64 = 1.5;
/// Zoom after which a dive chooses again, as a natural logarithm.
const CHOOSE_AGAIN: f64 = 6.0;
/// Most logarithmic elongation that another place may have beyond the present one.
const WORSE: f64 = 0.2;
/// Distance at which a dive is at its end, over the least that can be drawn.
const AT_END: f64 = 5.0;
/// Zooms without coming nearer after which another place is chosen.
const MAX_BLOCKED: u32 = 4;
/// Least distance from a replaced place to the next, over the eye's distance.
const ASIDE: f64 = 0.02;
/// Zoom between two cameras of a dive's record, as a natural logarithm.
const RECORD_STEP: f64 = 1.0;

/// What the guide does, for the interface to show.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GuideStatus {
    /// Nothing.
    Idle,
    /// A dive looks for a place.
    Searching,
    /// A dive goes down.
    Diving,
    /// A dive found no place in view.
    NoPlace,
    /// A dive is as deep as the fractal can be drawn.
    AtEnd,
}

/// A search of a part of the picture, in progress.
struct AreaSearch {
    search: PlaceSearch,
    /// The pointer's position for which the search runs, in normalised device coordinates.
    pointer: DVec2,
    /// True if the surface blocks the present place: any other is better.
    is_blocked: bool,
}

/// A dive in progress.
struct Dive {
    secs: f64,
    /// The eye's distance to the place at the last choice.
    chosen_at: f64,
    /// The cameras with their times in seconds; the last is the newest.
    record: Vec<(f64, Camera)>,
}

impl Dive {
    /// Adds the newest camera, instead of the last if that is not a step from the one before.
    fn add_to_record(&mut self, camera: &Camera) {
        let newest = (self.secs, camera.clone());
        match self.record.as_mut_slice() {
            // No time has passed.
            [.., (secs, _)] if *secs >= self.secs => {}
            [.., (_, before), last]
                if (before.view_unit() / last.1.view_unit()).ln() < RECORD_STEP =>
            {
                *last = newest;
            }
            _ => self.record.push(newest),
        }
    }
}

/// The guide's state.
#[derive(Default)]
pub struct Guide {
    area_search: Option<AreaSearch>,
    /// The descent, and the pointer's position for which its place was chosen.
    descent: Option<(Descent, DVec2)>,
    /// Number of successive zooms that did not bring the eye nearer to the place.
    blocked: u32,
    dive: Option<Dive>,
    ended: Option<GuideStatus>,
    /// The cameras of the last dive with their times in seconds.
    record: Vec<(f64, Camera)>,
}

impl std::fmt::Debug for Guide {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Guide").field("status", &self.status()).finish_non_exhaustive()
    }
}

impl Guide {
    /// What the guide does.
    pub fn status(&self) -> GuideStatus {
        match (&self.dive, &self.descent) {
            (Some(_), Some(_)) => GuideStatus::Diving,
            (Some(_), None) => GuideStatus::Searching,
            (None, _) => self.ended.unwrap_or(GuideStatus::Idle),
        }
    }

    /// True during a dive.
    pub fn is_diving(&self) -> bool {
        self.dive.is_some()
    }

    /// The cameras of the last dive with their times, to keep as a path; empty without a dive.
    pub fn record(&self) -> &[(f64, Camera)] {
        self.dive.as_ref().map_or(&self.record, |dive| &dive.record)
    }

    /// Forgets places and stops a dive: the person moves the camera, or the scene was replaced.
    ///
    /// The last dive's record stays.
    pub fn cancel(&mut self) {
        self.stop_dive();
        (self.area_search, self.descent, self.ended) = (None, None, None);
    }

    /// Forgets the last dive's record.
    pub fn forget_record(&mut self) {
        self.record.clear();
    }

    /// Zooms in at the pointer by a factor of `exp(amount)`, drawn to a place near the pointer.
    ///
    /// Returns whether it did; without a place yet, it begins to look for one and leaves the zoom to the caller.
    pub fn zoom(
        &mut self,
        model: &FractalModel,
        camera: &mut Camera,
        world: World<'_>,
        pointer: DVec2,
        amount: f64,
    ) -> bool {
        self.stop_dive();
        self.ended = None;
        let wide = DVec2::new(world.viewport.aspect, 1.0);
        let is_elsewhere = |chosen: DVec2| ((chosen - pointer) * wide).length() > ELSEWHERE;
        if self.descent.as_ref().is_some_and(|(_, chosen)| is_elsewhere(*chosen)) {
            self.descent = None;
        }
        if self.descent.is_none()
            && self.area_search.as_ref().is_none_or(|area_search| is_elsewhere(area_search.pointer))
        {
            let area = SearchArea { center: pointer, ..NEAR_POINTER };
            self.begin_search(model, camera, world, area);
        }
        self.descend(model, camera, world, amount)
    }

    /// Descends by a zoom of `amount`, or chooses another place where the surface is in the way.
    ///
    /// Returns false without a descent.
    fn descend(
        &mut self,
        model: &FractalModel,
        camera: &mut Camera,
        world: World<'_>,
        amount: f64,
    ) -> bool {
        let Some((descent, _)) = &self.descent else { return false };
        let is_blocked = !descent.advance(camera, world, amount);
        self.blocked = if is_blocked && !descent.is_planning() { self.blocked + 1 } else { 0 };
        if self.blocked > MAX_BLOCKED && self.area_search.is_none() {
            self.blocked = 0;
            self.search_about_place(model, camera, world, true);
        }
        true
    }

    /// Begins a dive from the present view.
    pub fn begin_dive(&mut self, model: &FractalModel, camera: &Camera, world: World<'_>) {
        self.cancel();
        self.record.clear();
        let record = vec![(0.0, camera.clone())];
        self.dive = Some(Dive { secs: 0.0, chosen_at: f64::INFINITY, record });
        self.begin_search(model, camera, world, NEAR_MIDDLE);
    }

    /// Continues a dive by `dt_secs`. Returns whether a dive is in progress.
    pub fn advance(
        &mut self,
        model: &FractalModel,
        camera: &mut Camera,
        world: World<'_>,
        dt_secs: f64,
    ) -> bool {
        let Some(dive) = &mut self.dive else { return false };
        // A slow frame must not jump.
        let dt_secs = if dt_secs.is_finite() { dt_secs.clamp(0.0, 0.1) } else { 0.0 };
        if self.descent.is_some() {
            dive.secs += dt_secs;
        }
        let speed = DIVE_PER_SEC * (dive.secs / DIVE_START_SECS).min(1.0);
        if !self.descend(model, camera, world, speed * dt_secs) && self.area_search.is_none() {
            self.end_dive(GuideStatus::NoPlace);
        }
        let (Some(dive), Some((descent, _))) = (&mut self.dive, &self.descent) else {
            return self.dive.is_some();
        };
        let distance = descent.distance(camera);
        dive.add_to_record(camera);
        if dive.chosen_at.is_infinite() {
            dive.chosen_at = distance;
        }
        let is_due = (dive.chosen_at / distance).ln() > CHOOSE_AGAIN;
        let limit = World { field: descent.place().field(), ..world }.nearest(camera);
        if distance <= AT_END * limit {
            self.end_dive(GuideStatus::AtEnd);
        } else if is_due && self.area_search.is_none() {
            dive.chosen_at = distance;
            self.search_about_place(model, camera, world, false);
        }
        self.dive.is_some()
    }

    /// Runs one step of the searches and plans, about 0.2 ms; returns false if there is nothing to do.
    pub fn work(&mut self, camera: &Camera, world: World<'_>) -> bool {
        if let Some(area_search) = &mut self.area_search {
            if !area_search.search.step() {
                let Some(area_search) = self.area_search.take() else { return false };
                self.choose(&area_search, camera, world);
            }
            return true;
        }
        self.descent.as_mut().is_some_and(|(descent, _)| descent.plan_step(camera))
    }

    /// Begins a search about the present place, if there is one; what it finds is for the same pointer.
    fn search_about_place(
        &mut self,
        model: &FractalModel,
        camera: &Camera,
        world: World<'_>,
        is_blocked: bool,
    ) {
        let Some((descent, pointer)) = &self.descent else { return };
        let center = descent.ndc(camera, world).unwrap_or(DVec2::ZERO);
        let area = SearchArea { center, ..NEAR_MIDDLE };
        let search = PlaceSearch::new(model, camera, world.viewport.aspect, area);
        self.area_search = Some(AreaSearch { search, pointer: *pointer, is_blocked });
    }

    /// Begins a search of `area`, whose centre is the pointer.
    fn begin_search(
        &mut self,
        model: &FractalModel,
        camera: &Camera,
        world: World<'_>,
        area: SearchArea,
    ) {
        let search = PlaceSearch::new(model, camera, world.viewport.aspect, area);
        self.area_search = Some(AreaSearch { search, pointer: area.center, is_blocked: false });
    }

    /// Descends to the best found place that is still in view.
    ///
    /// Keeps the present one if all are more drawn out than it by over [`WORSE`], unless the surface blocks it.
    fn choose(&mut self, area_search: &AreaSearch, camera: &Camera, world: World<'_>) {
        let present = self.descent.as_ref().map(|(descent, _)| descent.place());
        let is_in_view = |place: &&Place| {
            let offset = &place.position - &camera.position;
            world.ndc_of(camera, offset).is_some_and(|ndc| ndc.abs().max_element() < 1.0)
        };
        let is_as_good = |place: &&Place| {
            present.is_none_or(|present| {
                let away = (&camera.position - &present.position).length();
                let aside = (&place.position - &present.position).length();
                let is_drawn_out = place.drawn_out() > present.drawn_out() + WORSE;
                aside > ASIDE * away && (area_search.is_blocked || !is_drawn_out)
            })
        };
        let places = area_search.search.places();
        if let Some(best) = places.iter().filter(is_in_view).find(is_as_good) {
            self.descent = Some((Descent::new(best.clone()), area_search.pointer));
        }
    }

    /// Stops a dive, and forgets its place; the record stays.
    pub fn stop_dive(&mut self) {
        if let Some(dive) = self.dive.take() {
            self.record = dive.record;
            self.descent = None;
            self.area_search = None;
        }
    }

    fn end_dive(&mut self, status: GuideStatus) {
        self.stop_dive();
        self.ended = Some(status);
    }
}
