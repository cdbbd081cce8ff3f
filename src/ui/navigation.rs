//! Movements of the camera: orbit, pan, dolly, fly, home and frame-all.
//!
//! In: a [`Camera`], a [`DistanceField`](crate::formula::DistanceField), the picture's size, pointer
//! positions and time steps. Out: the moved camera. This module does not depend on egui and keeps
//! no clock.
//!
//! | file | contents |
//! |---|---|
//! | `navigation.rs` | the navigator: the pointer's gestures, and which movement is active |
//! | `world` | the surface around the camera: picking, limits, rounding |
//! | `aim` | the surface in the picture nearest to the pointer |
//! | `placement` | rounded positions of eye and pivot |
//! | [`collide`] | collision of the eye with the surface, and sliding along it |
//! | `recovery` | turns a view that shows no surface toward the nearest |
//! | [`turntable`] | rotations that keep the horizon level |
//! | [`focus`] | the focus of the lens |
//! | [`fly`] | flying by keys, at a speed that follows the distance to the surface |
//! | [`descent`] | zooms about a place, with a turn toward the best view |
//! | [`guide`] | draws the zoom to places, and dives by itself |
//! | [`flight`] | animated flights: home, frame-all, level, a point of the surface |
//! | `route` | collision-free routes of flights |
//!
//! Pointer positions are normalised device coordinates: −1 to 1, x right, y up. Zoom amounts are
//! natural logarithms: +1 reduces the distance by a factor of e.
//!
//! Rules of every movement:
//! - the eye never passes the surface, and stays [`World::clearance`] away from the surface;
//! - the eye comes no nearer to its target than [`World::nearest`], the limit of the renderer's
//!   precision, and goes no farther from the scene's origin than [`MAX_EYE_DISTANCE`];
//! - positions are rounded to 10⁻⁴ of a pixel at the surface's distance, so that documents have
//!   no invisible digits;
//! - no measurement uses absolute f64 coordinates: positions are exact points, and nearby positions
//!   are vectors from the field's origin, so that all zoom levels behave alike.

mod aim;
pub mod collide;
pub mod descent;
pub mod flight;
pub mod fly;
pub mod focus;
pub mod guide;
mod placement;
mod recovery;
mod route;
pub mod turntable;
mod world;

use std::ops::RangeInclusive;

use glam::{DVec2, DVec3};

use crate::scene::{Camera, PrecisePoint};
use flight::Flight;
pub use fly::FlyInput;
use fly::FlySpeed;
use placement::{glide_pivot, place_pivot, shift};
use turntable::Turntable;
pub use world::{CameraStatus, MAX_EYE_DISTANCE, Viewport, World};

/// Range of the pivot's distance during a dolly, as a fraction of the target's depth.
const PIVOT_PARTS: RangeInclusive<f64> = 0.02..=50.0;
/// Turn of an orbit, in radians, that brings the pivot nearer to the centre by a factor of e.
const GLIDE_RAD: f64 = 0.12;
/// Movement of the pointer, in pixels, within which a run of zooms holds on to its target.
const REST_PX: f64 = 3.0;
/// Rotation for a drag over half the picture's height, in radians.
const TURN_PER_HALF_HEIGHT_RAD: f64 = std::f64::consts::FRAC_PI_2;

/// A pointer's gesture in progress.
#[derive(Clone, Debug)]
enum Gesture {
    Orbit { last: DVec2, turntable: Turntable, center: PrecisePoint },
    Pan(Pan),
}

/// A pan in progress.
#[derive(Clone, Debug)]
struct Pan {
    grabbed: PrecisePoint,
    /// Where the grabbed point is seen from the pointer, in normalised device coordinates.
    from_pointer: DVec2,
    /// False if the picture shows no surface.
    is_surface: bool,
}

/// What a run of zooms holds on to while the pointer rests.
#[derive(Clone, Debug)]
struct Hold {
    pointer: DVec2,
    /// The eye after the last zoom: other movements end the run.
    eye: PrecisePoint,
    /// Where the target is in the picture: zooming toward it keeps it there.
    aim: DVec2,
}

/// The state of movements between events.
#[derive(Clone, Debug, Default)]
pub struct Navigator {
    gesture: Option<Gesture>,
    hold: Option<Hold>,
    nothing_ahead: bool,
    /// True while zooming out turns a view without a surface toward the nearest.
    is_recovering: bool,
    fly_speed: FlySpeed,
    flight: Option<Flight>,
    /// True if flights jump to their targets.
    jumps: bool,
}

impl Navigator {
    /// Sets whether flights jump to their targets, for people whom motion on a screen makes ill.
    pub fn set_jumps(&mut self, jumps: bool) {
        self.jumps = jumps;
    }

    /// True between the start and the end of a gesture, or during a flight.
    pub fn is_active(&self) -> bool {
        self.gesture.is_some() || self.flight.is_some()
    }

    /// Begins an orbit, and chooses its centre. Nothing changes until [`Self::drag`].
    ///
    /// The set's centre, while the picture shows the whole set. In closer views the surface point
    /// under the pointer; over the background the present pivot if it is on a surface in the
    /// picture, else the surface point nearest to the pointer. While the orbit turns, the pivot
    /// glides to its centre.
    pub fn begin_orbit(&mut self, camera: &Camera, world: World<'_>, ndc: DVec2) {
        self.cancel();
        let pivot = &camera.pivot - &camera.position;
        let center = if world.shows_whole(camera) {
            world.field.center() - world.eye(camera)
        } else if let Some(picked) = world.pick(camera, ndc) {
            picked
        } else if world.is_surface_in_picture(camera, pivot) {
            pivot
        } else {
            let nearest = aim::nearest(world, camera, ndc);
            nearest.map_or_else(|| world.target(camera, ndc), |aim| aim.offset)
        };
        let grain = world.grain(camera);
        let center = if center.distance(pivot) <= grain {
            camera.pivot.clone()
        } else {
            camera.position.moved_by(center, grain)
        };
        self.gesture = Some(Gesture::Orbit { last: ndc, turntable: Turntable::of(camera), center });
    }

    /// The point that the orbit in progress turns about.
    pub fn orbit_center(&self) -> Option<&PrecisePoint> {
        match &self.gesture {
            Some(Gesture::Orbit { center, .. }) => Some(center),
            _ => None,
        }
    }

    /// Begins a pan: [`Self::drag`] keeps the grabbed surface point at its place from the pointer.
    ///
    /// Over the background, that is the surface point nearest to the pointer.
    pub fn begin_pan(&mut self, camera: &Camera, world: World<'_>, ndc: DVec2) {
        self.cancel();
        let aim = aim::nearest(world, camera, ndc);
        let target = aim.map_or_else(|| world.target(camera, ndc), |aim| aim.offset);
        self.gesture = Some(Gesture::Pan(Pan {
            grabbed: camera.position.moved_by(target, world.grain(camera)),
            from_pointer: aim.map_or(DVec2::ZERO, |aim| aim.ndc - ndc),
            is_surface: aim.is_some(),
        }));
    }

    /// Continues the gesture with the pointer at `ndc`. Returns whether the camera changed.
    pub fn drag(&mut self, camera: &mut Camera, world: World<'_>, ndc: DVec2) -> bool {
        let before = camera.clone();
        match &mut self.gesture {
            Some(Gesture::Orbit { last, turntable, center }) => {
                let moved = (ndc - *last)
                    * DVec2::new(world.viewport.aspect, 1.0)
                    * TURN_PER_HALF_HEIGHT_RAD;
                *last = ndc;
                // The scene follows the pointer, so the eye moves in the opposite direction.
                turntable.orbit(camera, world, center, DVec2::new(-moved.x, moved.y));
                glide_pivot(camera, center, -(-moved.length() / GLIDE_RAD).exp_m1());
            }
            // Recovery turns the view, so the grabbed point is no longer where it was.
            Some(Gesture::Pan(held)) if !self.is_recovering => {
                pan(camera, world, &held.grabbed, ndc + held.from_pointer);
            }
            _ => {}
        }
        *camera != before
    }

    /// Ends the gesture.
    pub fn end(&mut self) {
        self.gesture = None;
    }

    /// Cancels the gesture, flying and the flight; the camera stays in place.
    pub fn cancel(&mut self) {
        self.gesture = None;
        self.hold = None;
        self.nothing_ahead = false;
        self.is_recovering = false;
        self.flight = None;
        self.fly_speed.reset();
    }

    /// True if the last zoom found no surface in the picture to come nearer to.
    pub fn found_nothing(&self) -> bool {
        self.nothing_ahead
    }

    /// Moves the eye toward the target at the pointer, nearer by a factor of `exp(amount)`.
    ///
    /// The target is the surface under the pointer, or the nearest in the picture; it stays the
    /// same while the pointer rests. It keeps its place in the picture, and so does the pivot. A
    /// negative `amount` moves the eye away. During a pan (two fingers), the target is the grabbed
    /// point. In a picture without a surface the eye comes no nearer, and moving away turns toward
    /// the surface. Returns whether the camera changed.
    pub fn dolly(
        &mut self,
        camera: &mut Camera,
        world: World<'_>,
        ndc: DVec2,
        amount: f64,
    ) -> bool {
        self.flight = None;
        self.fly_speed.reset();
        if !amount.is_finite() || amount == 0.0 {
            return false;
        }
        let target = match &self.gesture {
            Some(Gesture::Pan(held)) => held.is_surface.then(|| &held.grabbed - &camera.position),
            _ => self.held_target(camera, world, ndc),
        };
        self.nothing_ahead = target.is_none() && amount > 0.0;
        self.is_recovering = target.is_none() || (self.is_recovering && amount < 0.0);
        let before = camera.clone();
        let Some(target) = target.filter(|_| !self.is_recovering) else {
            if amount < 0.0 {
                self.is_recovering = !recovery::step(camera, world, -amount);
            }
            return *camera != before;
        };
        let depth = target.length();
        if !(depth > 0.0 && depth.is_finite()) {
            return false;
        }
        let wanted = depth * (-amount.clamp(-20.0, 20.0)).exp();
        let nearest = world.nearest(camera).min(depth);
        let displacement = target * ((depth - wanted.max(nearest)) / depth);
        let moved = collide::advance(world, camera, displacement);
        // The pivot's offset scales by the same factor as the target's depth.
        let new_depth = (target - moved).length();
        let grain = world.grain(camera).min(world.grain_after(camera, moved));
        let pivot_offset = (&camera.pivot - &camera.position) * (new_depth / depth);
        // A pivot much nearer or farther than the target gives a useless view unit, and would
        // exceed all limits after enough steps.
        let pivot_distance = pivot_offset
            .length()
            .max(PIVOT_PARTS.start() * new_depth)
            .min(PIVOT_PARTS.end() * new_depth)
            .max(world.clearance(camera));
        camera.position =
            camera.position.moved_by(moved, grain.min(world.grain_at(camera, new_depth)));
        let pivot_offset = pivot_offset.normalize_or(camera.forward()) * pivot_distance;
        place_pivot(camera, pivot_offset, grain);
        if let Some(hold) = &mut self.hold {
            hold.eye = camera.position.clone();
        }
        *camera != before
    }

    /// The target of a zoom; beside the pointer, it stays the same while the pointer rests.
    fn held_target(&mut self, camera: &Camera, world: World<'_>, pointer: DVec2) -> Option<DVec3> {
        let to_px = DVec2::new(world.viewport.aspect, 1.0) * 0.5 * world.viewport.height_px;
        let lasts = |hold: &Hold| {
            ((pointer - hold.pointer) * to_px).length() <= REST_PX && hold.eye == camera.position
        };
        let hold = self.hold.take().filter(lasts);
        let start = hold.as_ref().map_or(pointer, |hold| hold.aim);
        let found = aim::nearest(world, camera, start);
        let pointer = hold.map_or(pointer, |hold| hold.pointer);
        self.hold = found.filter(|found| found.ndc != pointer).map(|found| Hold {
            pointer,
            eye: camera.position.clone(),
            aim: found.ndc,
        });
        found.map(|found| found.offset)
    }

    /// Flies for `dt_secs`. Returns whether the camera changed.
    ///
    /// Call it once per frame while a key is down or the pointer looks around. A call with empty
    /// input resets the speed. While the eye moves, the pivot is in front of the eye at the
    /// smoothed distance, so that the view unit follows the distance to the surface.
    pub fn fly(
        &mut self,
        camera: &mut Camera,
        world: World<'_>,
        input: FlyInput,
        dt_secs: f64,
    ) -> bool {
        if input.is_empty() {
            self.fly_speed.reset();
            return false;
        }
        self.gesture = None;
        self.hold = None;
        self.nothing_ahead = false;
        self.is_recovering = false;
        self.flight = None;
        fly::fly(&mut self.fly_speed, camera, world, input, dt_secs)
    }

    /// The last speed of [`Self::fly`] without the fast key, scene units per second; none at rest.
    pub fn speed(&self) -> Option<f64> {
        self.fly_speed.per_sec()
    }

    /// Starts a flight to `to`.
    ///
    /// Jumps there if the surface blocks every route, if a flight to `to` is in progress, or if all
    /// flights jump.
    pub fn fly_to(&mut self, camera: &mut Camera, world: World<'_>, to: &Camera) {
        let current = self.flight.take();
        self.cancel();
        // A flight changes the eye's position, not the lens nor the viewer's screen.
        let Camera { lens, stereo, .. } = camera.clone();
        let to = Camera { lens, stereo, ..to.clone() };
        if !self.jumps && current.is_none_or(|flight| !flight.leads_to(&to)) {
            self.flight = Flight::plan(world, camera, &to);
        }
        if self.flight.is_none() {
            *camera = to;
        }
    }

    /// Starts a flight to where the bounding sphere fits the picture, in the current direction.
    pub fn frame_all(&mut self, camera: &mut Camera, world: World<'_>) {
        let to = flight::framing_all(camera, world);
        self.fly_to(camera, world, &to);
    }

    /// Starts a flight toward the surface at `ndc`, which ends in the middle of the picture.
    ///
    /// Nothing happens where no surface is seen.
    pub fn approach(&mut self, camera: &mut Camera, world: World<'_>, ndc: DVec2) {
        if let Some(offset) = world.pick(camera, ndc) {
            let to = flight::approaching(camera, world, offset);
            self.fly_to(camera, world, &to);
        }
    }

    /// Starts a flight that turns a rolled camera upright in place.
    pub fn level(&mut self, camera: &mut Camera, world: World<'_>) {
        let to = flight::upright(camera);
        self.fly_to(camera, world, &to);
    }

    /// Continues a flight by `dt_secs`. Returns whether a flight was in progress.
    ///
    /// Call it once per frame until it returns false.
    pub fn advance(&mut self, camera: &mut Camera, dt_secs: f64) -> bool {
        let Some(flight) = &mut self.flight else { return false };
        *camera = flight.advance(dt_secs);
        if flight.is_over() {
            self.flight = None;
        }
        true
    }
}

/// Moves the camera parallel to the image plane until `grabbed` appears at `ndc`.
fn pan(camera: &mut Camera, world: World<'_>, grabbed: &PrecisePoint, ndc: DVec2) {
    let rotation = camera.rotation();
    let seen = rotation.inverse() * (grabbed - &camera.position);
    let depth = -seen.z;
    if depth <= 0.0 {
        return;
    }
    let half_height = camera.half_height(world.viewport.aspect);
    let wanted = DVec2::new(ndc.x * world.viewport.aspect, ndc.y) * half_height * depth;
    let displacement = rotation * DVec3::new(seen.x - wanted.x, seen.y - wanted.y, 0.0);
    let moved = collide::slide(world, camera, displacement);
    shift(camera, world, moved);
}
