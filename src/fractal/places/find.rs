//! The search for the places of a view.
//!
//! Rays through the picture find surface points, and Newton's method finds the recurring points beside them.
//! The best of those are made exact, and the space about them is probed. The search runs in small steps, so
//! that a frame can run as many as fit its time.

use std::{collections::HashMap, sync::Arc};

use glam::{DVec2, DVec3};

use super::{
    newton::{Refined, Refinement, Solution, solve},
    probe::{ARRIVAL_AT_COPY, COPY_DISTANCE, Probe},
    vantage::{CameraSearch, ENOUGH_ROOM},
};
use crate::{
    formula::{
        DistanceField, Recurrence, ReferenceSteps, march::COARSEST_FOOTPRINT,
        march::DEEP_FOOTPRINT, recurrence::norm,
    },
    fractal::{FractalModel, Search, camera_ray, ndc_of, pixel_cone, spiral::in_disc},
    scene::{Camera, PrecisePoint},
};

/// Size of the finest shapes in a view at [`DEEP`], in scene units: a view's iterations must reach them.
const FINEST_SHAPES: f64 = 1e-3 * DEEP;
/// Rows of the picture whose pixels set the search's detail.
const ROWS: f64 = 200.0;
/// Distance from the surface at which Newton's method starts, in half heights of the picture at its depth.
///
/// Orbits of points farther out escape before they come near a cycle.
const NEARNESS: f64 = 1e-7;
/// Most steps of one ray.
const MAX_STEPS: u32 = 500;
/// Enlargement of the view's height, along an orbit, after which its shapes begin to repeat.
const ORDER_ONE: f64 = 0.5;
/// Longest orbit of a search.
const MAX_ORBIT: usize = 160;
/// Most positions before a cycle, after the view's height has grown to order one.
const PREPERIODS: usize = 5;
/// Longest cycle.
const MAX_PERIOD: usize = 3;
/// Greatest elongation of a place.
const MAX_ELONGATION: f64 = 1.06;
/// Greatest distortion of a place.
const MAX_DISTORTION: f64 = 6.0;
/// The depth at which elongations are compared.
const DEEP: f64 = 1e-20;
/// How far behind the visible surface a place may be, as a part of the view's height.
const BEHIND: f64 = 0.02;
/// Cost of a place as far from the area's centre as the area's edge.
const ASIDE_COST: f64 = 0.7;
/// Equations that are solved in one step of a search.
const SOLVED_AT_ONCE: usize = 4;
/// Positions of a reference orbit that are computed in one step of a search.
const TRACED_AT_ONCE: u32 = 8;
/// Places nearer to each other than this part of the view's height count as one.
const SAME: f64 = 0.006;
/// Greatest normalised device coordinate of a place: not at the picture's very edge.
const IN_PICTURE: f64 = 0.95;
/// Footprint of the field about places of fractals without depth, in scene units.
const FOOTPRINT_WITHOUT_DEPTH: f64 = 1e-6;
/// Finest detail of rays in a deep view, over the eye's distance to the anchor.
const GRAIN: f64 = 1e-4;
/// Distance of an eye that has arrived at a cycle, over its distance before.
const ARRIVAL: f64 = 1.0 / 30.0;
/// Part of a search's time that its rays take.
const RAYS_SHARE: f64 = 0.7;

/// A place that a dive can go to.
#[derive(Clone, Debug)]
pub struct Place {
    /// The point, as exact as the deepest dive needs.
    pub position: PrecisePoint,
    /// The equation that its orbit fulfils.
    pub recurrence: Recurrence,
    /// How shapes are drawn out with depth; see [`Solution::elongation`].
    pub elongation: f64,
    /// How much the place is drawn out at every depth; see [`Solution::distortion`].
    pub distortion: f64,
    /// Least openness at the probed scales; see [`super::Vantage`](super::vantage::Vantage::openness).
    pub openness: f64,
    /// Radius of the small copy about the point, in scene units; 0 at a cycle, where shapes go on for ever.
    pub radius: f64,
    /// Where the place is in the picture, in normalised device coordinates.
    pub ndc: DVec2,
    /// The place's cost: the lower, the better.
    pub cost: f64,
    field: PlaceField,
}

/// The distance field about a place.
#[derive(Clone)]
struct PlaceField(Arc<dyn DistanceField>);

impl std::fmt::Debug for PlaceField {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("PlaceField")
    }
}

/// The part of the picture in which places are searched, and how many.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SearchArea {
    /// Where the nearest places count most, in normalised device coordinates.
    pub center: DVec2,
    /// Radius of the disc of rays about the centre, in half heights of the picture.
    ///
    /// From 1 up, the disc is as much wider than high as the picture.
    pub radius: f64,
    /// Number of rays.
    pub rays: u32,
    /// Most places.
    pub count: usize,
    /// Whether small copies count as places, at which dives end.
    pub has_copies: bool,
}

impl SearchArea {
    /// The whole picture.
    pub const PICTURE: Self =
        Self { center: DVec2::ZERO, radius: 1.0, rays: 256, count: 40, has_copies: true };
}

/// A search in progress.
pub struct PlaceSearch {
    model: FractalModel,
    camera: Camera,
    aspect: f64,
    area: SearchArea,
    stage: Stage,
    candidates: Vec<Candidate>,
    places: Vec<Place>,
}

enum Stage {
    Anchor(Box<Search>),
    Rays { field: Arc<dyn DistanceField>, ray: u32, pending: Vec<(DVec3, f64, Recurrence)> },
    Candidates { field: Arc<dyn DistanceField>, index: usize, pending: Option<Pending> },
    Done,
}

/// What is computed of a candidate that no surface hides.
enum Pending {
    /// The exact point.
    Refinement(Box<Refinement>),
    /// The reference orbit about it.
    Reference { position: PrecisePoint, steps: Box<dyn ReferenceSteps> },
    /// The space about it.
    Probe(Box<Probe>),
}

/// A solution that is in the picture.
struct Candidate {
    solution: Solution,
    ndc: DVec2,
    cost: f64,
}

impl PlaceSearch {
    /// A search for places in `area` of the picture that `camera` sees; its width over height is `aspect`.
    pub fn new(model: &FractalModel, camera: &Camera, aspect: f64, area: SearchArea) -> Self {
        let cone = pixel_cone(camera, aspect, ROWS);
        let footprint = cone * model.clear_distance(&camera.position);
        let deep = (footprint < COARSEST_FOOTPRINT)
            .then(|| Search::new(model.fractal(), camera, aspect, None))
            .flatten();
        let stage = match deep {
            Some(search) => Stage::Anchor(Box::new(search)),
            None => Stage::of_rays(model.finer(NEARNESS * footprint)),
        };
        let (model, camera) = (model.clone(), camera.clone());
        Self { model, camera, aspect, area, stage, candidates: Vec::new(), places: Vec::new() }
    }

    /// The places found so far, the best first.
    pub fn places(&self) -> &[Place] {
        &self.places
    }

    /// The part of the search that is done, 0 to 1.
    ///
    /// An estimate: the number of candidates is not known before all rays are.
    pub fn progress(&self) -> f64 {
        let part = |done: usize, of: usize| (done as f64 / of.max(1) as f64).min(1.0);
        match &self.stage {
            Stage::Anchor(_) => 0.0,
            Stage::Rays { ray, .. } => {
                RAYS_SHARE * f64::from(*ray) / f64::from(self.area.rays.max(1))
            }
            Stage::Candidates { index, .. } => {
                let probed = part(*index, self.candidates.len());
                let found = part(self.places.len(), self.area.count);
                RAYS_SHARE + (1.0 - RAYS_SHARE) * probed.max(found)
            }
            Stage::Done => 1.0,
        }
    }

    /// Runs all steps and returns the places, the best first.
    pub fn finish(mut self) -> Vec<Place> {
        while self.step() {}
        self.places
    }

    /// Runs one step of about 0.2 ms; returns false once the search has ended.
    pub fn step(&mut self) -> bool {
        let stage = std::mem::replace(&mut self.stage, Stage::Done);
        self.stage = match stage {
            Stage::Anchor(mut search) => match search.step() {
                Some(reference) => {
                    let fractal = self.model.fractal();
                    let away = &self.camera.position - reference.anchor();
                    let grain = (GRAIN * away.length()).max(DEEP_FOOTPRINT);
                    let field = fractal.field_about(reference, DEEP_FOOTPRINT, grain);
                    Stage::of_rays(field)
                }
                None => Stage::Anchor(search),
            },
            Stage::Rays { field, ray, mut pending } => {
                if !pending.is_empty() {
                    let first = pending.len().saturating_sub(SOLVED_AT_ONCE);
                    for (start, extent, recurrence) in pending.drain(first..) {
                        if let Some(solution) = solve(field.as_ref(), start, recurrence, extent) {
                            self.add(field.as_ref(), &solution);
                        }
                    }
                    Stage::Rays { field, ray, pending }
                } else if ray < self.area.rays {
                    match self.starts(field.as_ref(), ray) {
                        Some(pending) => Stage::Rays { field, ray: ray + 1, pending },
                        None => self.done(),
                    }
                } else {
                    self.sort_candidates();
                    Stage::Candidates { field, index: 0, pending: None }
                }
            }
            Stage::Candidates { field, index, pending } => {
                self.candidate_step(field, index, pending)
            }
            Stage::Done => return false,
        };
        true
    }

    /// The Newton searches that start at the surface point of ray `ray`; none if the field has no orbits.
    fn starts(&self, field: &dyn DistanceField, ray: u32) -> Option<Vec<(DVec3, f64, Recurrence)>> {
        let ndc = self.area.ndc(ray, self.aspect);
        let half_height = self.camera.half_height(self.aspect);
        let ray = camera_ray(&self.camera, &field.origin(), ndc, self.aspect);
        let cone = NEARNESS * half_height;
        let Some(depth) = field.trace(ray, cone, f64::INFINITY, MAX_STEPS).unwrap_or_else(Some)
        else {
            return Some(Vec::new());
        };
        let (start, extent) = (ray.at(depth), 2.0 * half_height * depth);
        let orbit = field.orbit(start, MAX_ORBIT);
        if orbit.is_empty() {
            return None;
        }
        let enlarged = orbit
            .iter()
            .position(|position| norm(&position.jacobian) * extent > ORDER_ONE)
            .unwrap_or(orbit.len());
        // Without the point among the addends, as in Julia forms, no copies surround such points.
        let has_copies = self.area.has_copies
            && orbit.get(1).is_some_and(|second| second.jacobian != orbit[0].step);
        let cycles = (1..=PREPERIODS).flat_map(move |more| {
            (1..=MAX_PERIOD)
                .map(move |period| Recurrence::Cycle { preperiod: enlarged + more, period })
        });
        let copies = (1..=PREPERIODS).map(|more| Recurrence::Center { returns: enlarged + more });
        Some(cycles.chain(copies.filter(|_| has_copies)).map(|it| (start, extent, it)).collect())
    }

    /// Adds a solution to the candidates if a dive there keeps its shapes, and the picture shows it.
    fn add(&mut self, field: &dyn DistanceField, solution: &Solution) {
        let (elongation, distortion) = (solution.elongation(), solution.distortion());
        // Also false for what is not a number.
        let keeps_shapes = elongation <= MAX_ELONGATION && distortion <= MAX_DISTORTION;
        if !keeps_shapes {
            return;
        }
        let fractal = self.model.fractal();
        let most = self.model.iterations_for(FINEST_SHAPES);
        if fractal.formula().has_depth(fractal)
            && solution.iterations_to(FINEST_SHAPES) > f64::from(most)
        {
            return;
        }
        let offset = solution.point - field.local(&self.camera.position);
        let seen = ndc_of(&self.camera, offset, self.aspect);
        let Some(ndc) = seen.filter(|ndc| ndc.abs().max_element() <= IN_PICTURE) else { return };
        let aside = (ndc - self.area.center) * DVec2::new(self.aspect, 1.0);
        let cost =
            drawn_out(elongation, distortion) + ASIDE_COST * aside.length() / self.area.radius;
        self.candidates.push(Candidate { solution: *solution, ndc, cost });
    }

    /// Sorts the candidates by cost and drops those beside a better one.
    fn sort_candidates(&mut self) {
        self.candidates.sort_by(|a, b| a.cost.total_cmp(&b.cost));
        // Kept points by cells of a grid, as wide as the least distance: nearer ones are in cells beside.
        let mut kept: HashMap<[i64; 2], Vec<DVec2>> = HashMap::new();
        let least = 2.0 * SAME;
        self.candidates.retain(|candidate| {
            let point = candidate.ndc * DVec2::new(self.aspect, 1.0);
            let [x, y] = (point / least).to_array().map(|it| it.floor() as i64);
            let mut around = (0..9).filter_map(|k| kept.get(&[x + k % 3 - 1, y + k / 3 - 1]));
            let is_apart = !around.any(|cell| cell.iter().any(|it| it.distance(point) < least));
            if is_apart {
                kept.entry([x, y]).or_default().push(point);
            }
            is_apart
        });
    }

    fn candidate_step(
        &mut self,
        field: Arc<dyn DistanceField>,
        index: usize,
        pending: Option<Pending>,
    ) -> Stage {
        let Some(candidate) = self.candidates.get(index) else { return self.done() };
        if self.places.len() >= self.area.count {
            return self.done();
        }
        let (next, pending) = match pending {
            None if !self.is_visible(field.as_ref(), candidate) => (index + 1, None),
            None => {
                let Solution { point, recurrence, derivative, .. } = candidate.solution;
                let guess = field.origin().moved_by(point, 0.0);
                let fractal = self.model.fractal();
                let refinement = Refinement::new(fractal, guess, recurrence, derivative);
                (index, Some(Pending::Refinement(Box::new(refinement))))
            }
            Some(Pending::Refinement(mut refinement)) => match refinement.step() {
                Refined::Unfinished => (index, Some(Pending::Refinement(refinement))),
                Refined::Diverging => (index + 1, None),
                Refined::Exact(position) => (index, Some(self.at_exact(index, position))),
            },
            Some(Pending::Reference { position, mut steps }) => {
                let pending = if (0..TRACED_AT_ONCE).all(|_| steps.step()) {
                    Pending::Reference { position, steps }
                } else {
                    let fractal = self.model.fractal();
                    let reference = steps.finish();
                    let about = fractal.field_about(reference, DEEP_FOOTPRINT, DEEP_FOOTPRINT);
                    self.probe(index, position, about)
                };
                (index, Some(pending))
            }
            Some(Pending::Probe(mut probe)) => {
                if probe.step() {
                    (index, Some(Pending::Probe(probe)))
                } else {
                    self.add_place(index, *probe);
                    (index + 1, None)
                }
            }
        };
        Stage::Candidates { field, index: next, pending }
    }

    /// True if no surface hides the candidate.
    fn is_visible(&self, field: &dyn DistanceField, candidate: &Candidate) -> bool {
        let ray = camera_ray(&self.camera, &field.origin(), candidate.ndc, self.aspect);
        let depth = candidate.solution.point.distance(ray.origin);
        let half_height = self.camera.half_height(self.aspect);
        let cone = pixel_cone(&self.camera, self.aspect, ROWS);
        let hit = field.trace(ray, cone, depth, MAX_STEPS).unwrap_or_else(Some);
        hit.is_none_or(|hit| depth - hit < 2.0 * BEHIND * half_height * depth)
    }

    /// What follows once the exact point of a candidate is known.
    fn at_exact(&self, index: usize, position: PrecisePoint) -> Pending {
        let fractal = self.model.fractal();
        match fractal.formula().begin_reference(fractal, position.clone()) {
            Some(steps) => Pending::Reference { position, steps },
            None => self.probe(index, position, self.model.finer(FOOTPRINT_WITHOUT_DEPTH)),
        }
    }

    /// The probe of a candidate whose exact `position` is known.
    fn probe(
        &self,
        index: usize,
        position: PrecisePoint,
        about: Arc<dyn DistanceField>,
    ) -> Pending {
        let solution = &self.candidates[index].solution;
        let depth = (&position - &self.camera.position).length();
        let most_radius = match solution.recurrence {
            Recurrence::Cycle { .. } => None,
            Recurrence::Center { .. } => Some(1.0 / solution.derivative.determinant().abs().cbrt()),
        };
        Pending::Probe(Box::new(Probe::new(about, position, depth, most_radius)))
    }

    /// Adds the probed candidate to the places if there is space about it at every depth.
    fn add_place(&mut self, index: usize, probe: Probe) {
        let Some((radius, openness)) = probe.finish() else { return };
        let Candidate { solution, ndc, cost } = &self.candidates[index];
        let place = Place {
            position: probe.position,
            recurrence: solution.recurrence,
            elongation: solution.elongation(),
            distortion: solution.distortion(),
            openness,
            radius,
            ndc: *ndc,
            cost: cost - openness.min(ENOUGH_ROOM).ln(),
            field: PlaceField(probe.about),
        };
        let at = self.places.partition_point(|other| other.cost <= place.cost);
        self.places.insert(at, place);
    }

    fn done(&mut self) -> Stage {
        self.candidates.clear();
        Stage::Done
    }
}

impl Stage {
    fn of_rays(field: Arc<dyn DistanceField>) -> Self {
        Self::Rays { field, ray: 0, pending: Vec::new() }
    }
}

impl SearchArea {
    /// Where ray `ray` passes through the picture: rays spiral outward from the centre.
    fn ndc(&self, ray: u32, aspect: f64) -> DVec2 {
        let offset = self.radius * in_disc(ray, self.rays);
        let wide = if self.radius < 1.0 { offset / DVec2::new(aspect, 1.0) } else { offset };
        self.center + wide
    }
}

impl Place {
    /// The distance from which the place's own shapes fill the picture, in scene units.
    ///
    /// At a cycle, a thirtieth of the distance from which `camera` sees it.
    pub fn arrival(&self, camera: &Camera) -> f64 {
        let away = (&self.position - &camera.position).length();
        if self.radius > 0.0 { ARRIVAL_AT_COPY * self.radius } else { ARRIVAL * away }
    }

    /// The logarithm of how much a deep view of the place is drawn out, at least 0.
    pub fn drawn_out(&self) -> f64 {
        drawn_out(self.elongation, self.distortion)
    }

    /// Least distance of an eye from the place, in scene units: outside of its small copy, or 0.
    pub fn nearest(&self) -> f64 {
        COPY_DISTANCE * self.radius
    }

    /// The camera that looks at the place from `depth` scene units, with the rest of `camera`.
    ///
    /// None below [`Self::nearest`], and where nothing free sees the place.
    pub fn camera(&self, camera: &Camera, depth: f64) -> Option<Camera> {
        let mut search = self.begin_camera(depth)?;
        while search.step() {}
        search.camera(camera)
    }

    /// The search of [`Self::camera`], in steps; none below [`Self::nearest`].
    pub fn begin_camera(&self, depth: f64) -> Option<CameraSearch> {
        (depth >= self.nearest()).then(|| self.camera_search(depth, None))
    }

    /// A search for the best camera `depth` scene units from the place, preferably from near direction `near`.
    pub fn camera_search(&self, depth: f64, near: Option<DVec3>) -> CameraSearch {
        let (field, position) = (self.field.0.clone(), self.position.clone());
        CameraSearch::new(field, position, self.radius, depth, near)
    }

    /// The distance field about the place, exact from the whole scene down to the deepest views of it.
    pub fn field(&self) -> &dyn DistanceField {
        self.field.0.as_ref()
    }
}

/// The logarithm of how much the elongation at depth and the constant distortion draw shapes out.
fn drawn_out(elongation: f64, distortion: f64) -> f64 {
    (1.0 - elongation.recip()) * -DEEP.ln() + distortion.ln()
}
