//! Routes of flights: collision-free legs from one camera to another.
//!
//! In: two cameras and the field around the first. Out: legs, each with a constant zoom rate. A
//! free straight line is the first choice. Otherwise the eye moves backward out of the bounding
//! sphere along free rays, moves around the sphere's centre, and enters in the same manner. While
//! it moves out, it looks at its start. A leg's ends are exact points, and positions on the leg are
//! offsets from the end with the smaller view unit, so one leg can span 27 orders of magnitude.

use glam::{DQuat, DVec3};

use super::{collide, world::World};
use crate::{
    formula::{DistanceField, Ray},
    fractal::spiral,
    scene::{Camera, PrecisePoint},
};

/// Number of pieces of a straight line that are checked for collision.
const LINE_PIECES: u32 = 48;
/// Maximum length of a straight line, in the larger view unit of its ends.
///
/// A longer route, such as from one deep view to another, zooms out and in again.
const MAX_LINE: f64 = 16.0;
/// Factor on the bounding sphere's radius, outside of which the eye moves around the centre.
pub(super) const ROOM: f64 = 1.04;
/// Minimum distance between outward ray and surface, as a fraction of the travelled length.
const FREE_CONE: f64 = 0.01;
/// Number of rays to try at each waypoint.
const RAYS: u32 = 48;
/// Maximum number of waypoints on the way out.
const MAX_WAYPOINTS: u32 = 40;
/// Step of an outward ray, as a fraction of the estimated distance.
///
/// The ray is checked at its steps only, so it may miss thin features.
const STEP: f64 = 0.7;
/// Minimum step of an outward ray, as a fraction of its travelled length.
const MIN_STEP: f64 = 0.08;
/// Fraction of the longest free ray at which the next waypoint is placed.
const ONWARD: f64 = 0.5;
/// Rounding of the eye's positions, in view units.
const GRAIN: f64 = 1e-10;
/// Length, as a fraction of a point's f64 coordinates, that does not resolve the surface.
const UNRESOLVED: f64 = 1e-10;

/// A camera's position, view unit and rotation on a route.
#[derive(Clone, Debug)]
pub(super) struct Waypoint {
    pub eye: PrecisePoint,
    /// The view unit.
    pub unit: f64,
    pub rotation: DQuat,
}

impl Waypoint {
    pub fn of(camera: &Camera) -> Self {
        Self { eye: camera.position.clone(), unit: camera.view_unit(), rotation: camera.rotation() }
    }

    /// The waypoint at `displacement`, which looks back at this waypoint.
    fn onward(&self, displacement: DVec3) -> Self {
        let forward = self.rotation * DVec3::NEG_Z;
        let length = displacement.length();
        let turn = DQuat::from_rotation_arc(forward, -displacement / length);
        let unit = self.unit + length;
        Self {
            eye: self.eye.moved_by(displacement, GRAIN * self.unit),
            unit,
            rotation: (turn * self.rotation).normalize(),
        }
    }
}

/// The curve of a leg.
#[derive(Clone, Debug)]
enum Shape {
    /// A straight line with this displacement.
    Line(DVec3),
    /// A spherical arc around a centre, between two vectors from the centre.
    Arc { center: PrecisePoint, ends: [DVec3; 2] },
}

/// A part of a route.
#[derive(Clone, Debug)]
pub(super) struct Leg {
    ends: [Waypoint; 2],
    shape: Shape,
    /// Perceived length: natural logarithm of the zoom + pan in view units + rotation in radians.
    pub length: f64,
}

impl Leg {
    fn line(from: Waypoint, to: Waypoint) -> Self {
        let displacement = &to.eye - &from.eye;
        let pan = displacement.length() / from.unit.max(to.unit);
        Self::new([from, to], Shape::Line(displacement), pan)
    }

    fn arc(center: PrecisePoint, from: Waypoint, to: Waypoint) -> Self {
        let ends = [&from.eye - &center, &to.eye - &center];
        let angle = ends[0].angle_between(ends[1]);
        let angle = if angle.is_finite() { angle } else { 0.0 };
        Self::new([from, to], Shape::Arc { center, ends }, angle)
    }

    fn new(ends: [Waypoint; 2], shape: Shape, pan: f64) -> Self {
        let turn = ends[0].rotation.angle_between(ends[1].rotation);
        let length = growth(&ends).abs() + pan + turn;
        Self { ends, shape, length }
    }

    /// The waypoint at the fraction `part` of the leg, 0 to 1; the zoom rate is constant.
    pub fn at(&self, part: f64) -> Waypoint {
        let [from, to] = &self.ends;
        let growth = growth(&self.ends);
        let unit = from.unit * (growth * part).exp();
        let grain = GRAIN * unit;
        let eye = match &self.shape {
            // Offsets start at the end with the smaller view unit, where digits matter most.
            Shape::Line(displacement) if growth >= 0.0 => {
                from.eye.moved_by(*displacement * geometric(part, growth), grain)
            }
            Shape::Line(displacement) => {
                to.eye.moved_by(*displacement * -geometric(1.0 - part, -growth), grain)
            }
            Shape::Arc { center, ends: [a, b] } => {
                let [near, far] = [a, b].map(|end| end.length().max(f64::MIN_POSITIVE));
                let [a, b] = [a, b].map(|end| end.normalize_or(DVec3::Z));
                let radius = near * (far / near).powf(part);
                center.moved_by(a.slerp(b, part) * radius, grain)
            }
        };
        Waypoint { eye, unit, rotation: from.rotation.slerp(to.rotation, part) }
    }
}

/// Natural logarithm of the ratio of the second end's view unit to the first end's.
fn growth(ends: &[Waypoint; 2]) -> f64 {
    (ends[1].unit / ends[0].unit).ln()
}

/// The covered fraction of a line at the fraction `part` of its duration.
///
/// The speed is proportional to the view unit, which grows by `exp(growth)` along the line.
fn geometric(part: f64, growth: f64) -> f64 {
    if growth.abs() < 1e-3 { part } else { (growth * part).exp_m1() / growth.exp_m1() }
}

/// The route from one camera to another; none if the surface blocks every tried route.
pub(super) fn plan(world: World<'_>, from: &Camera, to: &Camera) -> Option<Vec<Leg>> {
    let (start, end) = (Waypoint::of(from), Waypoint::of(to));
    let straight = Leg::line(start.clone(), end.clone());
    if is_free(world, from, &straight) {
        return Some(vec![straight]);
    }
    let field = world.field;
    let centre = field.origin().moved_by(field.center(), 0.0);
    let (out, back) = (way_out(field, start)?, way_out(field, end)?);
    let (outside, entry) = (out.last()?.clone(), back.last()?.clone());
    let mut legs = lines(out);
    legs.push(Leg::arc(centre, outside, entry));
    let inward = back.into_iter().rev().collect();
    legs.extend(lines(inward));
    Some(legs)
}

fn lines(waypoints: Vec<Waypoint>) -> Vec<Leg> {
    waypoints.windows(2).map(|pair| Leg::line(pair[0].clone(), pair[1].clone())).collect()
}

fn is_free(world: World<'_>, camera: &Camera, leg: &Leg) -> bool {
    let Shape::Line(displacement) = leg.shape else { return false };
    let [from, to] = &leg.ends;
    if displacement.length() > MAX_LINE * from.unit.max(to.unit) {
        return false;
    }
    let room = |eye: &PrecisePoint| world.field.clear_distance(world.field.local(eye));
    let min_room = room(&from.eye).min(room(&to.eye));
    let clearance = world.clearance(camera).min(0.5 * min_room);
    let points: Vec<_> = (0..=LINE_PIECES)
        .map(|i| world.field.local(&leg.at(f64::from(i) / f64::from(LINE_PIECES)).eye))
        .collect();
    points.windows(2).all(|pair| collide::is_free(world.field, pair[0], pair[1], clearance))
}

/// Waypoints from `start` to the outside of the bounding sphere, with free lines in between.
fn way_out(field: &dyn DistanceField, start: Waypoint) -> Option<Vec<Waypoint>> {
    let mut waypoints = vec![start];
    for _ in 0..MAX_WAYPOINTS {
        let waypoint = waypoints.last()?;
        let eye = field.local(&waypoint.eye);
        let radius = field.bounding_radius() * ROOM;
        if eye.distance(field.center()) >= field.bounding_radius() {
            return Some(waypoints);
        }
        let (direction, free) = longest_free_ray(field, eye, waypoint);
        let (_, exit) = Ray { origin: eye, direction }.sphere_span(field.center(), radius)?;
        let length = if free < exit { ONWARD * free } else { exit };
        // A waypoint must be farther than the surface, else the route is stuck in a cavity.
        if length <= field.clear_distance(eye) && free < exit {
            return None;
        }
        let onward = waypoint.onward(direction * length);
        waypoints.push(onward);
    }
    None
}

/// The direction of the longest free ray, and its length.
///
/// Backward directions come first, and the first ray that leaves the bounding sphere is taken.
fn longest_free_ray(field: &dyn DistanceField, eye: DVec3, waypoint: &Waypoint) -> (DVec3, f64) {
    let backward = waypoint.rotation * DVec3::Z;
    let unresolved = UNRESOLVED * eye.length();
    let spacing = 0.5 * field.clear_distance(eye).max(unresolved);
    let mut directions: Vec<_> = spiral::directions(RAYS).collect();
    directions.sort_by(|a, b| b.dot(backward).total_cmp(&a.dot(backward)));
    let likely = [backward, field.normal(eye, spacing)];
    let mut best = (backward, 0.0);
    for direction in likely.into_iter().chain(directions) {
        // If the field's coordinates are too coarse at the eye, the ray starts farther away.
        let origin = if waypoint.unit < unresolved { eye + direction * unresolved } else { eye };
        let free = free_length(field, Ray { origin, direction });
        if free > best.1 {
            best = (direction, free);
        }
        if free.is_infinite() {
            break;
        }
    }
    best
}

/// The length of a ray until it is close to the surface; infinite if it leaves the sphere.
fn free_length(field: &dyn DistanceField, ray: Ray) -> f64 {
    let Some((_, exit)) = ray.sphere_span(field.center(), field.bounding_radius()) else {
        return f64::INFINITY;
    };
    let mut travelled = 0.0;
    while travelled < exit {
        let distance = field.clear_distance(ray.at(travelled));
        if distance.is_nan() || distance <= FREE_CONE * travelled {
            return travelled;
        }
        travelled += (STEP * distance).max(MIN_STEP * travelled);
    }
    f64::INFINITY
}
