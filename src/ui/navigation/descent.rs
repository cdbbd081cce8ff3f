//! A descent to a place: zooms about the place, and turns the eye to where the view is best.
//!
//! In: a [`Place`], a camera that sees it, amounts of zoom. Out: the moved camera. With every zoom the eye
//! turns a little about the place toward the planned vantage, the place drifts toward the picture's middle, and
//! the picture turns upright. The plan runs in small steps.

use std::f64::consts::TAU;

use glam::{DQuat, DVec2, DVec3};

use super::{collide, placement::place_pivot, world::World};
use crate::{
    fractal::places::{CameraSearch, Place, Vantage},
    scene::Camera,
};

/// Distance from the place for which a vantage is planned, over the present distance.
const AHEAD: f64 = 0.65;
/// Distance at which the next plan begins, over the distance of the last.
const PLAN_AGAIN: f64 = 1.3;
/// Rate at which the eye turns toward the vantage, per unit of zoom.
const TURN_RATE: f64 = 0.9;
/// Most radians that the eye turns about the place per unit of zoom.
const MAX_TURN_RAD: f64 = 0.5;
/// Radians per unit of zoom that the eye turns toward more room where it has little.
const DETOUR_RAD: f64 = 1.0;
/// Number of directions that a detour tries.
const DETOURS: u32 = 8;
/// Room about the eye, over its distance to the place, that needs no detour.
const COMFORT: f64 = 0.2;
/// Rate at which the place drifts toward the middle, per unit of zoom.
const CENTER_RATE: f64 = 0.35;
/// Rate at which the picture turns upright, per unit of zoom.
const ROLL_RATE: f64 = 0.35;
/// Most radians that the picture turns upright per unit of zoom.
const MAX_ROLL_RAD: f64 = 0.3;
/// Rate at which the pivot comes to the place, per unit of zoom.
const UNIT_RATE: f64 = 1.5;
/// Longest single step, as a natural logarithm: longer zooms take several.
const MAX_STEP: f64 = 0.25;
/// Least room about the eye, over its distance to the place, while it comes nearer.
const MIN_ROOM: f64 = 0.04;

/// A descent in progress.
pub struct Descent {
    place: Place,
    vantage: Option<Vantage>,
    /// The distance for which `vantage` was planned.
    planned: f64,
    plan: Option<CameraSearch>,
}

impl Descent {
    /// A descent to `place`.
    pub fn new(place: Place) -> Self {
        Self { place, vantage: None, planned: f64::INFINITY, plan: None }
    }

    /// The place.
    pub fn place(&self) -> &Place {
        &self.place
    }

    /// The eye's distance to the place, in scene units.
    pub fn distance(&self, camera: &Camera) -> f64 {
        (&camera.position - &self.place.position).length()
    }

    /// Where the place is in the picture, in normalised device coordinates; none behind the eye.
    pub fn ndc(&self, camera: &Camera, world: World<'_>) -> Option<DVec2> {
        world.ndc_of(camera, &self.place.position - &camera.position)
    }

    /// True while a vantage is planned.
    pub fn is_planning(&self) -> bool {
        self.plan.is_some()
    }

    /// Plans the next vantage for about 0.1 ms; returns false while the plan is complete.
    pub fn plan_step(&mut self, camera: &Camera) -> bool {
        let distance = self.distance(camera);
        if self.plan.is_none() && AHEAD * distance * PLAN_AGAIN < self.planned {
            let toward_eye = (&camera.position - &self.place.position).try_normalize();
            self.planned = AHEAD * distance;
            let scale = self.planned.max(self.place.nearest());
            self.plan = Some(self.place.camera_search(scale, toward_eye));
        }
        let Some(plan) = &mut self.plan else { return false };
        if !plan.step() {
            self.vantage = plan.vantage().or(self.vantage);
            self.plan = None;
        }
        true
    }

    /// Zooms in by a factor of `exp(amount)`, at least 1. Returns whether the eye came nearer.
    ///
    /// The viewport is that of `world`; the surface is that about the place.
    pub fn advance(&self, camera: &mut Camera, world: World<'_>, amount: f64) -> bool {
        let amount = amount.max(0.0);
        let world = World { field: self.place.field(), ..world };
        let steps = (amount / MAX_STEP).ceil().clamp(1.0, 64.0);
        (0..steps as u32).fold(false, |came, _| self.step(camera, world, amount / steps) || came)
    }

    fn step(&self, camera: &mut Camera, world: World<'_>, amount: f64) -> bool {
        let arm = &camera.position - &self.place.position;
        let (distance, from) = (arm.length(), arm.normalize_or(DVec3::Z));
        let wanted =
            (distance * (-amount).exp()).max(self.place.nearest()).max(world.nearest(camera));
        let room = |arm: DVec3| {
            let point = world.field.local(&self.place.position) + arm;
            world.field.clear_distance(point) / arm.length()
        };
        let next = wanted.min(distance);
        let toward = roomiest(self.turn(from, amount) * from, next, amount, room);
        let nearer = toward * next;
        let turn = DQuat::from_rotation_arc(from, toward);
        let is_free = room(nearer) >= MIN_ROOM.min(room(arm))
            && collide::advance(world, camera, nearer - arm) == nearer - arm;
        if is_free && wanted < distance {
            self.place_camera(camera, world, nearer, turn, amount);
            return true;
        }
        // About the place, and along the surface if that is in the way.
        let beside = toward * distance;
        let eye = arm + collide::slide(world, camera, beside - arm);
        if let Some(toward) = eye.try_normalize() {
            let turn = DQuat::from_rotation_arc(from, toward);
            self.place_camera(camera, world, eye, turn, amount);
        }
        false
    }

    /// The rotation about the place that a zoom by `amount` from direction `from` brings.
    fn turn(&self, from: DVec3, amount: f64) -> DQuat {
        let Some(vantage) = &self.vantage else { return DQuat::IDENTITY };
        let angle = from.angle_between(vantage.direction);
        let axis = from.cross(vantage.direction).normalize_or(from.any_orthonormal_vector());
        DQuat::from_axis_angle(axis, part(angle, TURN_RATE, MAX_TURN_RAD, amount))
    }

    /// Sets the eye to the place + `eye`, where the camera turned along by `turn`.
    fn place_camera(
        &self,
        camera: &mut Camera,
        world: World<'_>,
        eye: DVec3,
        turn: DQuat,
        amount: f64,
    ) {
        let rotation = turn * camera.rotation();
        let toward = rotation.inverse() * -eye.normalize_or(DVec3::Z);
        // The camera turns toward the place, so that the place drifts to the middle.
        let aside = toward.angle_between(DVec3::NEG_Z);
        let axis = DVec3::NEG_Z.cross(toward).normalize_or(DVec3::Y);
        let drift = DQuat::from_axis_angle(axis, part(aside, CENTER_RATE, MAX_TURN_RAD, amount));
        let rotation = rotation * drift;
        let roll = self.vantage.as_ref().map_or(0.0, |vantage| {
            let up = rotation.inverse() * vantage.up;
            part(DVec2::Y.angle_to(up.truncate()), ROLL_RATE, MAX_ROLL_RAD, amount)
        });
        let rotation = rotation * DQuat::from_rotation_z(roll);
        let grain = world.grain_at(camera, eye.length());
        // Light reaches as far as the view unit, which must not jump where another place is chosen.
        let unit = camera.view_unit() * eye.length() / self.distance(camera);
        let settled = 1.0 - (-UNIT_RATE * amount).exp();
        let unit = unit * (eye.length() / unit).powf(settled);
        camera.position = self.place.position.moved_by(eye, grain);
        camera.orientation = rotation.normalize().into();
        place_pivot(camera, -eye.normalize_or(DVec3::Z) * unit, grain);
    }
}

/// The direction near `toward` with the most room at `distance`; `toward` itself where that has enough.
fn roomiest(toward: DVec3, distance: f64, amount: f64, room: impl Fn(DVec3) -> f64) -> DVec3 {
    let mut best = (toward, room(toward * distance));
    if best.1 >= COMFORT {
        return toward;
    }
    let (x, y) = toward.any_orthonormal_pair();
    let (aside, along) = (DETOUR_RAD * amount).sin_cos();
    for k in 0..DETOURS {
        let (sin, cos) = (TAU * f64::from(k) / f64::from(DETOURS)).sin_cos();
        let direction = (along * toward + aside * (cos * x + sin * y)).normalize();
        let found = room(direction * distance);
        if found > best.1 {
            best = (direction, found);
        }
    }
    best.0
}

/// The part of `angle` that a zoom by `amount` covers: at `rate`, and at most `most` per unit of zoom.
fn part(angle: f64, rate: f64, most: f64, amount: f64) -> f64 {
    let covered = angle * (1.0 - (-rate * amount).exp());
    if covered.is_finite() { covered.clamp(-most * amount, most * amount) } else { 0.0 }
}
