//! Where to look at a place from: free directions, and the picture's upright.

use std::sync::Arc;

use glam::{DMat3, DQuat, DVec3};

use crate::{
    formula::{DistanceField, Ray},
    fractal::spiral::directions,
    scene::{Camera, PrecisePoint},
};

/// Number of directions that are tried.
const DIRECTIONS: u32 = 96;
/// Directions that one step measures.
const DIRECTIONS_PER_STEP: usize = 8;
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

/// Number of the best directions whose pictures are judged; more if surfaces hide the place from all of them.
const JUDGED: usize = 12;
/// Openness beyond which more space makes no better picture.
pub const ENOUGH_ROOM: f64 = 0.4;
/// How far the wider view is, whose open side becomes the picture's upright.
const WIDER: f64 = 4.0;
/// Radius about an eye where estimates must agree with the eye's own, as a part of that.
const STEADY_RADIUS: f64 = 0.3;
/// Greatest factor between those estimates and the eye's own.
const STEADY_FACTOR: f64 = 4.0;
/// Number of those estimates.
const STEADY_SAMPLES: u32 = 12;
/// Part of the framing that relief decides.
const RELIEF_WEIGHT: f64 = 0.3;
/// A small copy's front, in its radii from its centre.
const COPY_FRONT: f64 = 1.2;
/// Least part of the wider view's open direction across the picture that decides the upright.
const MIN_ACROSS: f64 = 0.15;
/// Loss of liking for a turn by a radian.
const TURN_COST: f64 = 0.15;

/// Where a place is looked at from.
#[derive(Clone, Copy, Debug)]
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

/// The openness of directions about a point, measured in steps.
#[derive(Clone, Debug)]
pub struct Openings {
    point: DVec3,
    scale: f64,
    /// Directions with their openness.
    measured: Vec<(DVec3, f64)>,
}

impl Openings {
    /// Openings about `point` at `scale`, both in a field's coordinates.
    pub fn new(point: DVec3, scale: f64) -> Self {
        Self { point, scale, measured: Vec::new() }
    }

    /// Measures some directions; returns false once all are measured.
    pub fn step(&mut self, field: &dyn DistanceField) -> bool {
        let from = self.measured.len();
        let next = directions(DIRECTIONS).skip(from).take(DIRECTIONS_PER_STEP);
        self.measured.extend(next.map(|direction| {
            let distance = field.clear_distance(self.point + direction * self.scale);
            // The point is part of the surface: larger estimates are noise of orbits that never escape.
            (direction, Some(distance / self.scale).filter(|it| *it <= 1.0).unwrap_or(0.0))
        }));
        self.measured.len() > from
    }

    /// The most open direction measured, and its openness.
    pub fn most_open(&self) -> (DVec3, f64) {
        let open = self.measured.iter().copied().max_by(|a, b| a.1.total_cmp(&b.1));
        open.unwrap_or((DVec3::Z, 0.0))
    }
}

impl Vantage {
    /// The rotation `world_from_camera`.
    pub fn rotation(&self) -> DQuat {
        let right = self.up.cross(self.direction);
        DQuat::from_mat3(&DMat3::from_cols(right, self.up, self.direction)).normalize()
    }
}

/// The search for the best vantage, in steps.
#[derive(Clone, Debug)]
pub struct VantageSearch {
    point: DVec3,
    radius: f64,
    scale: f64,
    near: Option<DVec3>,
    openings: Openings,
    /// The wider view's openings.
    wider: Openings,
    /// Direction, openness and liking of those to judge, the last first; none until all are measured.
    pending: Option<Vec<(DVec3, f64, f64)>>,
    /// Number of directions judged so far.
    judged: usize,
    framing: Option<Framing>,
    best: Option<(Vantage, f64)>,
}

impl VantageSearch {
    /// A search at `scale` from `point`, both in the field's coordinates.
    ///
    /// `radius` is that of a small copy about the point, or 0. With `near`, directions near that one are
    /// preferred.
    pub fn new(point: DVec3, radius: f64, scale: f64, near: Option<DVec3>) -> Self {
        let openings = Openings::new(point, scale);
        let wider = Openings::new(point, WIDER * scale);
        let (pending, judged, framing, best) = (None, 0, None, None);
        Self { point, radius, scale, near, openings, wider, pending, judged, framing, best }
    }

    /// Measures some directions or one ray; returns false once the search has ended.
    pub fn step(&mut self, field: &dyn DistanceField) -> bool {
        if self.openings.step(field) || self.wider.step(field) {
            return true;
        }
        if let Some(framing) = &mut self.framing {
            if framing.step(field) {
                return true;
            }
            if let Some((vantage, liking)) = framing.judged()
                && self.best.as_ref().is_none_or(|(_, most)| liking >= *most)
            {
                self.best = Some((vantage, liking));
            }
        }
        let pending = match &mut self.pending {
            Some(pending) => pending,
            None => self.pending.insert(self.openings.to_judge(self.near)),
        };
        let has_enough = self.judged >= JUDGED && self.best.is_some();
        let next = pending.pop().filter(|_| !has_enough);
        self.judged += 1;
        let next = next.map(|(direction, openness, liking)| {
            let up = upright(direction, self.wider.most_open().0);
            let vantage = Vantage { direction, up, openness, framing: 0.0 };
            let in_front = IN_FRONT * (self.scale - COPY_FRONT * self.radius);
            Framing::new(vantage, liking, self.point, self.scale, in_front)
        });
        self.framing = next;
        self.framing.is_some()
    }

    /// The best vantage so far; none where no free direction sees the place.
    pub fn best(&self) -> Option<Vantage> {
        self.best.as_ref().map(|(vantage, _)| *vantage)
    }
}

impl Openings {
    /// The most open directions with openness and liking, the best last.
    fn to_judge(&self, near: Option<DVec3>) -> Vec<(DVec3, f64, f64)> {
        let mut directions: Vec<_> = self
            .measured
            .iter()
            .filter(|(_, openness)| *openness > 0.0)
            .map(|&(direction, openness)| {
                let turned = near.map_or(0.0, |near| direction.angle_between(near));
                (direction, openness, openness.min(ENOUGH_ROOM) - TURN_COST * turned)
            })
            .collect();
        directions.sort_by(|a, b| a.2.total_cmp(&b.2));
        directions
    }
}

/// The search for the camera that looks at a place, in steps.
pub struct CameraSearch {
    field: Arc<dyn DistanceField>,
    position: PrecisePoint,
    depth: f64,
    vantage: VantageSearch,
}

impl CameraSearch {
    /// A search for the camera `depth` scene units from `position`, by the field about that place.
    ///
    /// `radius` is that of a small copy about the place, or 0. With `near`, directions near that one are
    /// preferred.
    pub fn new(
        field: Arc<dyn DistanceField>,
        position: PrecisePoint,
        radius: f64,
        depth: f64,
        near: Option<DVec3>,
    ) -> Self {
        let vantage = VantageSearch::new(field.local(&position), radius, depth, near);
        Self { field, position, depth, vantage }
    }

    /// Runs one step of about 0.2 ms; returns false once the search has ended.
    pub fn step(&mut self) -> bool {
        self.vantage.step(self.field.as_ref())
    }

    /// The best vantage so far; none where nothing free sees the place.
    pub fn vantage(&self) -> Option<Vantage> {
        self.vantage.best()
    }

    /// The best camera so far, with the rest of `camera`; none where nothing free sees the place.
    pub fn camera(&self, camera: &Camera) -> Option<Camera> {
        let vantage = self.vantage.best()?;
        let grain = 1e-9 * self.depth;
        Some(Camera {
            position: self.position.moved_by(vantage.direction * self.depth, grain),
            pivot: self.position.clone(),
            orientation: vantage.rotation().into(),
            ..camera.clone()
        })
    }
}

/// True if estimates near `eye` agree with `distance`, the one there.
///
/// Where orbits never escape, estimates are noise, and some look like room.
fn is_steady(field: &dyn DistanceField, eye: DVec3, distance: f64) -> bool {
    directions(STEADY_SAMPLES).all(|toward| {
        let near = field.clear_distance(eye + toward * STEADY_RADIUS * distance);
        (distance / STEADY_FACTOR..distance * STEADY_FACTOR).contains(&near)
    })
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

/// How much the picture of a vantage shows, by a grid of rays.
///
/// The rays count what is surface, neither background nor far nearer than the place, and how much the depths
/// differ.
#[derive(Clone, Debug)]
struct Framing {
    vantage: Vantage,
    liking: f64,
    eye: DVec3,
    scale: f64,
    /// Least depth of the surface in the picture's middle.
    in_front: f64,
    /// Number of rays so far: the first through the middle, then those of the grid.
    rays: u32,
    is_hidden: bool,
    /// Logarithms of the depths in depths of the place.
    depths_ln: Vec<f64>,
}

impl Framing {
    fn new(vantage: Vantage, liking: f64, point: DVec3, scale: f64, in_front: f64) -> Self {
        let eye = point + vantage.direction * scale;
        let (rays, is_hidden, depths_ln) = (0, false, Vec::new());
        Self { vantage, liking, eye, scale, in_front, rays, is_hidden, depths_ln }
    }

    /// Marches one ray; returns false once no ray is left, or a surface in front hides the place.
    fn step(&mut self, field: &dyn DistanceField) -> bool {
        if self.is_hidden || self.rays > GRID * GRID {
            return false;
        }
        let side = |k: u32| 2.0 * (f64::from(k) + 0.5) / f64::from(GRID) - 1.0;
        let at = self.rays.checked_sub(1).map(|k| (side(k % GRID), side(k / GRID)));
        let depth = self.march(field, at.unwrap_or((0.0, 0.0)));
        self.rays += 1;
        if at.is_none() {
            let is_blocked = depth.is_some_and(|depth| depth < self.in_front);
            let room = self.vantage.openness * self.scale;
            self.is_hidden = is_blocked || !is_steady(field, self.eye, room);
        } else if let Some(depth) = depth {
            self.depths_ln.extend(Some((depth / self.scale).ln()).filter(|it| *it > NEAR_LN));
        }
        true
    }

    fn march(&self, field: &dyn DistanceField, (x, y): (f64, f64)) -> Option<f64> {
        let Vantage { direction, up, .. } = self.vantage;
        let right = up.cross(direction);
        let toward = HALF_HEIGHT * (1.5 * x * right + y * up) - direction;
        let ray = Ray { origin: self.eye, direction: toward.normalize() };
        field.trace(ray, CONE, FAR * self.scale, MAX_STEPS).unwrap_or_else(Some)
    }

    /// The vantage and how much it is liked; none if a surface in front hides the place.
    fn judged(&self) -> Option<(Vantage, f64)> {
        let logs = &self.depths_ln;
        let count = logs.len().max(1) as f64;
        let mean = logs.iter().sum::<f64>() / count;
        let variance = logs.iter().map(|it| (it - mean).powi(2)).sum::<f64>() / count;
        let relief = (variance.sqrt() / ENOUGH_RELIEF).min(1.0);
        let seen = logs.len() as f64 / f64::from(GRID * GRID);
        let framing = (1.0 - RELIEF_WEIGHT) * seen + RELIEF_WEIGHT * relief;
        let vantage = Vantage { framing, ..self.vantage };
        (!self.is_hidden).then_some((vantage, self.liking + framing))
    }
}
