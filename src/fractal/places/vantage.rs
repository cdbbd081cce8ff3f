//! Where to look at a place from: free directions, and the picture's upright.

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

/// The greatest openness about `point` at `scale`, and its direction.
pub fn most_open(field: &dyn DistanceField, point: DVec3, scale: f64) -> (DVec3, f64) {
    openings(field, point, scale).max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((DVec3::Z, 0.0))
}

/// Directions about `point` with their openness at `scale`.
fn openings(
    field: &dyn DistanceField,
    point: DVec3,
    scale: f64,
) -> impl Iterator<Item = (DVec3, f64)> + '_ {
    spread_directions(DIRECTIONS).map(move |direction| {
        let distance = field.clear_distance(point + direction * scale);
        (direction, (distance / scale).min(1.0))
    })
}

impl Vantage {
    /// The best vantage at `scale` from `point`, both in the field's coordinates.
    ///
    /// `radius` is that of a small copy about the point, or 0. With `near`, directions near that one are
    /// preferred. None where no free direction sees the place.
    pub fn find(
        field: &dyn DistanceField,
        point: DVec3,
        radius: f64,
        scale: f64,
        near: Option<DVec3>,
    ) -> Option<Self> {
        let mut directions: Vec<_> = openings(field, point, scale)
            .map(|(direction, openness)| {
                let turned = near.map_or(0.0, |near| direction.angle_between(near));
                (direction, openness, openness.min(ENOUGH_ROOM) - TURN_COST * turned)
            })
            .collect();
        directions.sort_by(|a, b| b.2.total_cmp(&a.2));
        let (wide, _) = most_open(field, point, WIDER * scale);
        directions
            .into_iter()
            .take(JUDGED)
            .filter_map(|(direction, openness, liking)| {
                let up = upright(direction, wide);
                let in_front = IN_FRONT * (scale - 1.2 * radius);
                let framing =
                    framing(field, point + direction * scale, scale, direction, up, in_front)?;
                Some((Self { direction, up, openness, framing }, liking + framing))
            })
            .max_by(|a, b| a.1.total_cmp(&b.1))
            .map(|(vantage, _)| vantage)
    }

    /// The rotation `world_from_camera`.
    pub fn rotation(&self) -> DQuat {
        let right = self.up.cross(self.direction);
        DQuat::from_mat3(&DMat3::from_cols(right, self.up, self.direction)).normalize()
    }
}

/// The part of `wide` across `direction`, as a unit vector; any such if there is none.
fn upright(direction: DVec3, wide: DVec3) -> DVec3 {
    let across = wide.reject_from_normalized(direction);
    let level = DVec3::Z.reject_from_normalized(direction);
    across
        .try_normalize()
        .filter(|_| across.length() > 0.15)
        .or_else(|| level.try_normalize())
        .unwrap_or_else(|| direction.any_orthonormal_vector())
}

/// How much the picture from `eye` shows, 0 to 1; none if a surface nearer than `in_front` hides the place.
///
/// A grid of rays counts what is surface, neither background nor far nearer than the place, and how much the
/// depths differ. `direction` leads from the place to the eye.
fn framing(
    field: &dyn DistanceField,
    eye: DVec3,
    scale: f64,
    direction: DVec3,
    up: DVec3,
    in_front: f64,
) -> Option<f64> {
    let right = up.cross(direction);
    let march = |x: f64, y: f64| {
        let toward = (HALF_HEIGHT * (1.5 * x * right + y * up) - direction).normalize();
        let ray = Ray { origin: eye, direction: toward };
        field.trace(ray, CONE, FAR * scale, MAX_STEPS).unwrap_or_else(Some)
    };
    if march(0.0, 0.0).is_some_and(|depth| depth < in_front) {
        return None;
    }
    let side = |k: u32| 2.0 * (f64::from(k) + 0.5) / f64::from(GRID) - 1.0;
    let depths = (0..GRID * GRID).filter_map(|k| march(side(k % GRID), side(k / GRID)));
    let logs: Vec<_> = depths.map(|it| (it / scale).ln()).filter(|it| *it > NEAR_LN).collect();
    let count = logs.len().max(1) as f64;
    let mean = logs.iter().sum::<f64>() / count;
    let variance = logs.iter().map(|it| (it - mean).powi(2)).sum::<f64>() / count;
    let relief = (variance.sqrt() / ENOUGH_RELIEF).min(1.0);
    Some(0.7 * logs.len() as f64 / f64::from(GRID * GRID) + 0.3 * relief)
}
