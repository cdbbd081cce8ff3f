//! The way of a journey: from where the camera is to where it was asked to go, free of the surface.
//!
//! In: two cameras and the field about the first. Out: legs, each with an even zoom. Where a
//! straight line is free, that is the way. Otherwise the eye backs out of the bounding sphere
//! along free rays, turns about the sphere's centre and comes in the same way; while it backs out
//! it looks at what it leaves. A leg's ends are exact points, and what lies between is measured
//! from the end that is nearer to the surface: twenty-seven orders of magnitude are one leg.

use glam::{DQuat, DVec3};

use super::{World, collide};
use crate::{
    fractal::{DistanceField, Ray},
    scene::{Camera, PrecisePoint},
};

/// Straight pieces that a line is tried in.
const TRIED_PIECES: u32 = 48;
/// Farthest that a line may lead, in the larger of its ends' view units: from one deep place to
/// another one goes out and in again.
const STRAIGHT_MOST: f64 = 16.0;
/// Room around the bounding sphere, outside of which the eye turns about its centre.
pub(super) const ROOM: f64 = 1.04;
/// What a ray out keeps from the surface, in parts of the way gone.
const FREE_CONE: f64 = 0.01;
/// Rays that are tried at one place.
const TRIED_RAYS: u32 = 48;
/// Places from which rays are tried, where none leads out at once.
const MAX_PLACES: u32 = 40;
/// A step of such a ray, in parts of the estimated distance, and its least, in parts of the way gone:
/// it is looked at where it leads, and need not find every hair.
const STEP: f64 = 0.7;
const LEAST_STEP: f64 = 0.08;
/// Part of the longest free ray that leads to the next such place.
const ONWARD: f64 = 0.5;
/// How coarse the eye's places on the way are, in view units.
const GRAIN: f64 = 1e-10;
/// Ways shorter than this, in parts of a place's f64 coordinates, say nothing of the surface.
const UNRESOLVED: f64 = 1e-10;

/// A camera on its way, without its lens.
#[derive(Clone, Debug)]
pub(super) struct Stop {
    pub eye: PrecisePoint,
    /// The view unit.
    pub unit: f64,
    pub rotation: DQuat,
}

impl Stop {
    pub fn of(camera: &Camera) -> Self {
        Self { eye: camera.position.clone(), unit: camera.view_unit(), rotation: camera.rotation() }
    }

    /// The stop `way` from here, from which this one is in view.
    fn onward(&self, way: DVec3) -> Self {
        let forward = self.rotation * DVec3::NEG_Z;
        let length = way.length();
        let turn = DQuat::from_rotation_arc(forward, -way / length);
        let unit = self.unit + length;
        Self {
            eye: self.eye.moved_by(way, GRAIN * self.unit),
            unit,
            rotation: (turn * self.rotation).normalize(),
        }
    }
}

#[derive(Clone, Debug)]
enum Shape {
    /// A line by this vector.
    Line(DVec3),
    /// Around a centre, from one vector about it to another.
    Around { center: PrecisePoint, ends: [DVec3; 2] },
}

/// A part of a journey.
#[derive(Clone, Debug)]
pub(super) struct Leg {
    ends: [Stop; 2],
    shape: Shape,
    /// How long it looks: logarithms of zoom, view units aside and radians together.
    pub length: f64,
}

impl Leg {
    fn line(from: Stop, to: Stop) -> Self {
        let way = &to.eye - &from.eye;
        let aside = way.length() / from.unit.max(to.unit);
        Self::new([from, to], Shape::Line(way), aside)
    }

    fn around(center: PrecisePoint, from: Stop, to: Stop) -> Self {
        let ends = [&from.eye - &center, &to.eye - &center];
        let aside = ends[0].angle_between(ends[1]);
        let aside = if aside.is_finite() { aside } else { 0.0 };
        Self::new([from, to], Shape::Around { center, ends }, aside)
    }

    fn new(ends: [Stop; 2], shape: Shape, aside: f64) -> Self {
        let turn = ends[0].rotation.angle_between(ends[1].rotation);
        let length = growth(&ends).abs() + aside + turn;
        Self { ends, shape, length }
    }

    /// The stop at `part` of the leg, 0 to 1; the zoom changes evenly.
    pub fn at(&self, part: f64) -> Stop {
        let [from, to] = &self.ends;
        let growth = growth(&self.ends);
        let unit = from.unit * (growth * part).exp();
        let grain = GRAIN * unit;
        let eye = match &self.shape {
            // From the end with the closer view: seen from there, every digit is there.
            Shape::Line(way) if growth >= 0.0 => {
                from.eye.moved_by(*way * geometric(part, growth), grain)
            }
            Shape::Line(way) => to.eye.moved_by(*way * -geometric(1.0 - part, -growth), grain),
            Shape::Around { center, ends: [a, b] } => {
                let [near, far] = [a, b].map(|end| end.length().max(f64::MIN_POSITIVE));
                let [a, b] = [a, b].map(|end| end.normalize_or(DVec3::Z));
                let radius = near * (far / near).powf(part);
                center.moved_by(a.slerp(b, part) * radius, grain)
            }
        };
        Stop { eye, unit, rotation: from.rotation.slerp(to.rotation, part) }
    }
}

/// The logarithm of how much larger the view unit is at the second end.
fn growth(ends: &[Stop; 2]) -> f64 {
    (ends[1].unit / ends[0].unit).ln()
}

/// The part of a line covered at `part` of its time if each step is as large as the view unit,
/// which grows by `exp(growth)` along it.
fn geometric(part: f64, growth: f64) -> f64 {
    if growth.abs() < 1e-3 { part } else { (growth * part).exp_m1() / growth.exp_m1() }
}

/// The way from one camera to another; none where the surface bars every one that was tried.
pub(super) fn plan(world: World<'_>, from: &Camera, to: &Camera) -> Option<Vec<Leg>> {
    let (start, end) = (Stop::of(from), Stop::of(to));
    let straight = Leg::line(start.clone(), end.clone());
    if is_free(world, from, &straight) {
        return Some(vec![straight]);
    }
    let field = world.field;
    let centre = field.origin().moved_by(field.center(), 0.0);
    let (out, back) = (way_out(field, start)?, way_out(field, end)?);
    let (outside, entry) = (out.last()?.clone(), back.last()?.clone());
    let mut legs = lines(out);
    legs.push(Leg::around(centre, outside, entry));
    let inward = back.into_iter().rev().collect();
    legs.extend(lines(inward));
    Some(legs)
}

fn lines(stops: Vec<Stop>) -> Vec<Leg> {
    stops.windows(2).map(|pair| Leg::line(pair[0].clone(), pair[1].clone())).collect()
}

fn is_free(world: World<'_>, camera: &Camera, leg: &Leg) -> bool {
    let Shape::Line(way) = leg.shape else { return false };
    let [from, to] = &leg.ends;
    if way.length() > STRAIGHT_MOST * from.unit.max(to.unit) {
        return false;
    }
    let room = |eye: &PrecisePoint| world.field.clear_distance(world.field.local(eye));
    let least_room = room(&from.eye).min(room(&to.eye));
    let clearance = world.clearance(camera).min(0.5 * least_room);
    let places: Vec<_> = (0..=TRIED_PIECES)
        .map(|i| world.field.local(&leg.at(f64::from(i) / f64::from(TRIED_PIECES)).eye))
        .collect();
    places.windows(2).all(|pair| collide::is_free(world.field, pair[0], pair[1], clearance))
}

/// Stops from `start` to one outside the bounding sphere, with free lines between them.
fn way_out(field: &dyn DistanceField, start: Stop) -> Option<Vec<Stop>> {
    let mut stops = vec![start];
    for _ in 0..MAX_PLACES {
        let stop = stops.last()?;
        let eye = field.local(&stop.eye);
        let radius = field.bounding_radius() * ROOM;
        if eye.distance(field.center()) >= field.bounding_radius() {
            return Some(stops);
        }
        let (direction, free) = freest(field, eye, stop);
        let (_, exit) = Ray { origin: eye, direction }.sphere_span(field.center(), radius)?;
        let length = if free < exit { ONWARD * free } else { exit };
        // Out of a hollow it has to get larger each time.
        if length <= field.clear_distance(eye) && free < exit {
            return None;
        }
        let onward = stop.onward(direction * length);
        stops.push(onward);
    }
    None
}

/// The first direction in which a ray leads out, those first that go backward; else the one in
/// which it goes farthest; and how far it goes.
fn freest(field: &dyn DistanceField, eye: DVec3, stop: &Stop) -> (DVec3, f64) {
    let backward = stop.rotation * DVec3::Z;
    let unresolved = UNRESOLVED * eye.length();
    let spacing = 0.5 * field.clear_distance(eye).max(unresolved);
    let mut directions: Vec<_> = (0..TRIED_RAYS).map(spread_direction).collect();
    directions.sort_by(|a, b| b.dot(backward).total_cmp(&a.dot(backward)));
    let likely = [backward, field.normal(eye, spacing)];
    let mut best = (backward, 0.0);
    for direction in likely.into_iter().chain(directions) {
        // Where the field's coordinates are too coarse for this place, from where they are not.
        let origin = if stop.unit < unresolved { eye + direction * unresolved } else { eye };
        let free = free_way(field, Ray { origin, direction });
        if free > best.1 {
            best = (direction, free);
        }
        if free.is_infinite() {
            break;
        }
    }
    best
}

/// How far a ray goes before it comes close to the surface; without end where it leads out.
fn free_way(field: &dyn DistanceField, ray: Ray) -> f64 {
    let Some((_, exit)) = ray.sphere_span(field.center(), field.bounding_radius()) else {
        return f64::INFINITY;
    };
    let mut gone = 0.0;
    while gone < exit {
        let distance = field.clear_distance(ray.at(gone));
        if distance.is_nan() || distance <= FREE_CONE * gone {
            return gone;
        }
        gone += (STEP * distance).max(LEAST_STEP * gone);
    }
    f64::INFINITY
}

/// The `index`-th of [`TRIED_RAYS`] directions, spread evenly on a golden spiral.
fn spread_direction(index: u32) -> DVec3 {
    const GOLDEN_RAD: f64 = 2.399_963_229_728_653;
    let z = 1.0 - (2.0 * f64::from(index) + 1.0) / f64::from(TRIED_RAYS);
    let (sin, cos) = (GOLDEN_RAD * f64::from(index)).sin_cos();
    let ring = (1.0 - z * z).sqrt();
    DVec3::new(ring * cos, ring * sin, z)
}
