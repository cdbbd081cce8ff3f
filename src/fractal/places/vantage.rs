//! Where to look at a place from: free directions, and the picture's upright.

use std::sync::Arc;

use glam::{DMat3, DQuat, DVec3};

use super::spectrum::spread_directions;
use crate::formula::{DistanceField, Ray};

/// Number of directions that are tried.
const DIRECTIONS: u32 = 96;
/// Hit distance of the rays that try a direction, per unit of depth.
const CONE: f64 = 0.004;
/// Most steps of such a ray.
const MAX_STEPS: u32 = 160;
/// Rays per side of the grid that judges a picture.
const GRID: u32 = 5;
/// Least depth of the surface in the picture's middle, as a part of the place's.
const IN_FRONT: f64 = 0.85;
/// Depth beyond which a ray sees background, in depths of the place.
const FAR: f64 = 30.0;
/// Logarithm of the least depth, over the place's, that does not hide the picture.
const NEAR_LN: f64 = -1.2;
/// Standard deviation of the depths' logarithms beyond which more makes no better picture.
const ENOUGH_RELIEF: f64 = 0.3;
/// Half the height of the judged picture at distance 1.
const HALF_HEIGHT: f64 = 0.36;

/// Number of the most open directions whose pictures are judged.
const JUDGED: usize = 12;
/// Openness beyond which more space makes no better picture.
const ENOUGH_ROOM: f64 = 0.4;
/// How far the wider view is, whose open side becomes the picture's upright.
const WIDER: f64 = 4.0;
/// Loss of liking for a turn by a radian.
const TURN_COST: f64 = 0.15;
/// Part of the framing that relief decides.
const RELIEF_WEIGHT: f64 = 0.3;
/// A small copy's front, in its radii from its centre.
const COPY_FRONT: f64 = 1.2;
/// Least part of the wider view's open direction across the picture that decides the upright.
const MIN_ACROSS: f64 = 0.15;
/// Directions that are tried in one step of a search.
const TRIED_AT_ONCE: u32 = 8;

/// Where a place is looked at from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vantage {
    /// From the place to the eye: a unit vector.
    pub direction: DVec3,
    /// The picture's upright: a unit vector, perpendicular to `direction`.
    pub up: DVec3,
    /// The eye's distance to the surface over its distance to the place: 1 in free space.
    pub openness: f64,
    /// How good the picture is framed, 0 to 1.
    pub framing: f64,
}

impl Vantage {
    /// The rotation `world_from_camera`.
    pub fn rotation(&self) -> DQuat {
        let right = self.up.cross(self.direction);
        DQuat::from_mat3(&DMat3::from_cols(right, self.up, self.direction)).normalize()
    }
}

/// A direction from the place with its openness.
#[derive(Clone, Copy, Debug)]
struct Opening {
    direction: DVec3,
    openness: f64,
    /// Openness up to what is enough, less the cost of the turn.
    liking: f64,
}

/// A search for the best vantage, in progress.
pub struct VantageSearch {
    field: Arc<dyn DistanceField>,
    /// The place, in the field's coordinates.
    point: DVec3,
    radius: f64,
    scale: f64,
    near: Option<DVec3>,
    /// The most open direction of the wider view.
    wide: Opening,
    openings: Vec<Opening>,
    stage: Stage,
    best: Option<(f64, Vantage)>,
}

enum Stage {
    /// The first direction that was not tried in the wider view.
    Wider(u32),
    /// The first direction that was not tried at the scale.
    Openings(u32),
    /// The opening that is judged, and its picture so far.
    Pictures(usize, PictureTest),
    Done,
}

impl VantageSearch {
    /// A search at `scale` from `point`, both in the field's coordinates.
    ///
    /// `radius` is that of a small copy about the point, or 0. With `near`, directions near that one are
    /// preferred.
    pub fn new(
        field: Arc<dyn DistanceField>,
        point: DVec3,
        radius: f64,
        scale: f64,
        near: Option<DVec3>,
    ) -> Self {
        let wide = Opening { direction: DVec3::Z, openness: 0.0, liking: 0.0 };
        let (openings, stage, best) = (Vec::new(), Stage::Wider(0), None);
        Self { field, point, radius, scale, near, wide, openings, stage, best }
    }

    /// Runs one step of about 0.1 ms; returns false once the search has ended.
    pub fn step(&mut self) -> bool {
        let stage = std::mem::replace(&mut self.stage, Stage::Done);
        self.stage = match stage {
            Stage::Wider(from) => {
                let found = self.tried(from, WIDER * self.scale);
                let widest = found.into_iter().max_by(|a, b| a.openness.total_cmp(&b.openness));
                if let Some(widest) = widest.filter(|it| it.openness > self.wide.openness) {
                    self.wide = widest;
                }
                let next = from + TRIED_AT_ONCE;
                if next < DIRECTIONS { Stage::Wider(next) } else { Stage::Openings(0) }
            }
            Stage::Openings(from) => {
                let found = self.tried(from, self.scale);
                self.openings.extend(found);
                let next = from + TRIED_AT_ONCE;
                if next < DIRECTIONS {
                    Stage::Openings(next)
                } else {
                    self.openings.sort_by(|a, b| b.liking.total_cmp(&a.liking));
                    self.openings.truncate(JUDGED);
                    Stage::Pictures(0, PictureTest::default())
                }
            }
            Stage::Pictures(index, mut test) => {
                let Some(opening) = self.openings.get(index).copied() else {
                    self.stage = Stage::Done;
                    return false;
                };
                let Opening { direction, openness, liking } = opening;
                let up = upright(direction, self.wide.direction);
                match test.next_ray(self, direction, up) {
                    Verdict::Unknown => Stage::Pictures(index, test),
                    Verdict::Hidden => Stage::Pictures(index + 1, PictureTest::default()),
                    Verdict::Framing(framing) => {
                        let value = liking + framing;
                        if self.best.is_none_or(|(best, _)| value > best) {
                            let vantage = Vantage { direction, up, openness, framing };
                            self.best = Some((value, vantage));
                        }
                        Stage::Pictures(index + 1, PictureTest::default())
                    }
                }
            }
            Stage::Done => return false,
        };
        true
    }

    /// Runs the remaining steps; none where no free direction sees the place.
    pub fn finish(mut self) -> Option<Vantage> {
        while self.step() {}
        self.vantage()
    }

    /// The best vantage so far.
    pub fn vantage(&self) -> Option<Vantage> {
        self.best.map(|(_, vantage)| vantage)
    }

    /// The distance between place and eye for which the search looks.
    pub fn scale(&self) -> f64 {
        self.scale
    }

    /// The next directions from the `from`-th, at `scale`.
    fn tried(&self, from: u32, scale: f64) -> Vec<Opening> {
        let directions = spread_directions(DIRECTIONS).skip(from as usize);
        directions
            .take(TRIED_AT_ONCE as usize)
            .map(|direction| {
                let openness = openness(self.field.as_ref(), self.point, direction, scale);
                let turned = self.near.map_or(0.0, |near| direction.angle_between(near));
                let liking = openness.min(ENOUGH_ROOM) - TURN_COST * turned;
                Opening { direction, openness, liking }
            })
            .collect()
    }
}

/// The greatest openness about `point` at `scale`.
pub fn most_open(field: &dyn DistanceField, point: DVec3, scale: f64) -> f64 {
    spread_directions(DIRECTIONS)
        .map(|direction| openness(field, point, direction, scale))
        .fold(0.0, f64::max)
}

/// The distance to the surface from `scale` away in `direction`, over `scale`; at most 1.
fn openness(field: &dyn DistanceField, point: DVec3, direction: DVec3, scale: f64) -> f64 {
    (field.clear_distance(point + direction * scale) / scale).min(1.0)
}

/// The part of `wide` across `direction`, as a unit vector; any such if there is none.
fn upright(direction: DVec3, wide: DVec3) -> DVec3 {
    let across = wide.reject_from_normalized(direction);
    let level = DVec3::Z.reject_from_normalized(direction);
    across
        .try_normalize()
        .filter(|_| across.length() > MIN_ACROSS)
        .or_else(|| level.try_normalize())
        .unwrap_or_else(|| direction.any_orthonormal_vector())
}

/// How much a picture shows, one ray at a time.
///
/// A grid of rays counts what is surface, neither background nor far nearer than the place, and how much the
/// depths differ. The first ray leads to the place.
#[derive(Default)]
struct PictureTest {
    rays: u32,
    /// Logarithms of the counted depths over the place's.
    logs: Vec<f64>,
}

enum Verdict {
    Unknown,
    /// A surface in front hides the place.
    Hidden,
    /// How good the picture is framed, 0 to 1.
    Framing(f64),
}

impl PictureTest {
    fn next_ray(&mut self, search: &VantageSearch, direction: DVec3, up: DVec3) -> Verdict {
        let (scale, right) = (search.scale, up.cross(direction));
        let march = |x: f64, y: f64| {
            let toward = (HALF_HEIGHT * (1.5 * x * right + y * up) - direction).normalize();
            let ray = Ray { origin: search.point + direction * scale, direction: toward };
            search.field.trace(ray, CONE, FAR * scale, MAX_STEPS).unwrap_or_else(Some)
        };
        let Some(index) = self.rays.checked_sub(1) else {
            self.rays = 1;
            let in_front = IN_FRONT * (scale - COPY_FRONT * search.radius);
            let is_hidden = march(0.0, 0.0).is_some_and(|depth| depth < in_front);
            return if is_hidden { Verdict::Hidden } else { Verdict::Unknown };
        };
        let side = |k: u32| 2.0 * (f64::from(k) + 0.5) / f64::from(GRID) - 1.0;
        let depth = march(side(index % GRID), side(index / GRID));
        self.logs.extend(depth.map(|it| (it / scale).ln()).filter(|it| *it > NEAR_LN));
        self.rays += 1;
        if self.rays <= GRID * GRID {
            return Verdict::Unknown;
        }
        let count = self.logs.len().max(1) as f64;
        let mean = self.logs.iter().sum::<f64>() / count;
        let variance = self.logs.iter().map(|it| (it - mean).powi(2)).sum::<f64>() / count;
        let relief = (variance.sqrt() / ENOUGH_RELIEF).min(1.0);
        let seen = self.logs.len() as f64 / f64::from(GRID * GRID);
        Verdict::Framing((1.0 - RELIEF_WEIGHT) * seen + RELIEF_WEIGHT * relief)
    }
}
