//! Views of random places of random sets, at random depths.
//!
//! In: a generator of random numbers. Out: scenes, each found by a descent: from the eye along a ray to the
//! surface, closer to that point, along another ray, and so on.

use glam::{DQuat, DVec3};
use mandelight::{
    formula::mandelbulb::{Mandelbulb, Sine},
    scene::{Camera, PrecisePoint, Scene},
};

use super::{
    rays::{SetView, Size},
    views::plenty,
};
use crate::random::Random;

/// Whole powers of the sets, of which a quarter have any power instead.
const POWERS: [f64; 9] = [2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 9.0, 12.0, 16.0];
/// Part of the sets whose power is any number.
const REAL_PART: f64 = 0.25;
/// The least and the greatest of those powers.
const REAL: [f64; 2] = [2.0, 16.0];
/// The nearest views of those, scene units: they have no depth.
const NEAREST_REAL: f64 = 1e-4;
/// Part of the sets that are Julia sets.
const JULIA_PART: f64 = 0.25;
/// Constants of the Julia sets: around that of a new scene.
const JULIA_SPREAD: f64 = 0.1;
/// Greatest distance of a view from the surface, scene units.
const WIDEST_VIEW: f64 = 1.0;
/// Distance of the first eye from the origin, scene units.
const FIRST_EYE: f64 = 2.4;
/// Hit distances within which a ray has met the surface.
const MET: f64 = 1.5;
/// How much closer each step of the descent gets.
const CLOSER: f64 = 0.12;
/// Size of the pictures whose rays the descent takes.
const SIZE: Size = [96, 64];
/// Size of the smallest pictures of the views, which take the fewest iterations.
const COARSEST: Size = [36, 24];

/// A random view.
pub struct RandomView {
    /// What the set and the depth are, for messages.
    pub name: String,
    /// The view, with a new scene's light.
    pub scene: Scene,
}

/// A random view of a distance from `nearest` to 1 scene unit.
///
/// None where the descent's rays meet no surface.
pub fn random_view(random: &mut Random, nearest: f64) -> Option<RandomView> {
    let power = random_power(random);
    random_view_of(power, random, nearest)
}

/// A random view of a set of this power, as [`random_view`] draws them.
pub fn random_view_of(power: f64, random: &mut Random, nearest: f64) -> Option<RandomView> {
    let fractal = random_set(power, random);
    let nearest = if fractal.power.fract() == 0.0 { nearest } else { nearest.max(NEAREST_REAL) };
    let scale = nearest.powf(random.unit()) * WIDEST_VIEW;
    let toward = random.in_ball(1.0).normalize();
    let mut eye = PrecisePoint::from(toward * -FIRST_EYE);
    let mut direction = toward;
    let mut distance = FIRST_EYE;
    loop {
        let scene = scene_of(&fractal, &eye, direction, distance, random);
        if distance <= scale {
            if !is_outside(&scene, distance) {
                return None;
            }
            let Mandelbulb { power, julia, sine, .. } = fractal;
            let name = format!("power {power}, {sine:?}, julia {julia}, from {distance:.1e}");
            return Some(RandomView { name, scene });
        }
        let looking = SetView::exact(&scene, SIZE, plenty(&scene));
        // A ray near to the middle of the picture, of some that meet the surface.
        let depth = (0..8).find_map(|_| {
            let at = random.ndc() * 0.25 + 0.5;
            direction = looking.direction([at.x * f64::from(SIZE[0]), at.y * f64::from(SIZE[1])]);
            // A ray that creeps on and on has met nothing.
            let depth = looking.march(direction, |estimate| estimate.step)?;
            (looking.nearness(direction, depth) < MET).then_some(depth)
        })?;
        let closer = (depth * CLOSER).max(scale);
        eye = eye.moved_by(direction * (depth - closer), 1e-6 * closer);
        distance = closer;
    }
}

/// True if the eye is outside of the set that the program draws.
///
/// Where orbits are slow, the set of the scene's own iterations is thicker than the set itself, and may hold the eye.
fn is_outside(scene: &Scene, distance: f64) -> bool {
    let footprint = SetView::exact(scene, COARSEST, 0).footprint(distance);
    let own = scene.fractal.formula().iterations_for(&scene.fractal, footprint);
    let looking = SetView::exact(scene, COARSEST, own);
    looking.estimate(looking.direction([0.0, 0.0]), 0.0).distance > 0.0
}

fn random_power(random: &mut Random) -> f64 {
    if random.unit() < REAL_PART {
        REAL[0] + (REAL[1] - REAL[0]) * random.unit()
    } else {
        POWERS[(random.unit() * POWERS.len() as f64) as usize]
    }
}

fn random_set(power: f64, random: &mut Random) -> Mandelbulb {
    let sine = if random.unit() < 0.3 { Sine::Negative } else { Sine::Positive };
    let julia = random.unit() < JULIA_PART;
    let mut fractal = Mandelbulb { power, sine, julia, ..Mandelbulb::default() };
    if julia {
        fractal.julia_constant = fractal.julia_constant.map(|v| v + JULIA_SPREAD * random.signed());
    }
    // Orbits of low powers are long already where views are shallow.
    if power < 4.0 {
        fractal.iterations = 100;
    }
    fractal
}

/// The view from `eye` along `direction`, of a surface `distance` away.
fn scene_of(
    fractal: &Mandelbulb,
    eye: &PrecisePoint,
    direction: DVec3,
    distance: f64,
    random: &mut Random,
) -> Scene {
    let up = DQuat::from_axis_angle(direction, random.unit() * std::f64::consts::TAU)
        * direction.any_orthonormal_vector();
    let mut camera = Camera::looking_at(-direction, DVec3::ZERO, up);
    camera.position = eye.clone();
    camera.pivot = eye.moved_by(direction * distance, 1e-6 * distance);
    camera.vertical_fov_deg = 25.0 + 50.0 * random.unit();
    Scene { fractal: fractal.clone().into(), camera, ..Scene::default() }
}
