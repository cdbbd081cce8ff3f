//! Random scenes that are worth seeing: neither empty, nor flat, nor dark, nor inside the set.
//!
//! In: a seed. Out: a scene, after some tries, each short enough for a frame. A try varies a preset, and
//! marches a coarse grid of camera rays to see what would be in the picture.

use glam::{DVec2, DVec3};

use super::{FractalModel, camera_ray, pixel_cone};
use crate::scene::{
    Camera, EnvironmentLight, GradientStop, Lights, Scene, color,
    dice::Dice,
    follow,
    presets::{self, Preset},
    variation::{Locks, vary},
};

/// Tries until a preset is shown as it is.
const MAX_TRIES: u32 = 12;
/// How far a surprise is from its preset.
const AMOUNT: f64 = 0.7;
/// Rays of a grid, across and down.
const GRID: [u32; 2] = [12, 8];
/// Width over height, and height in pixels, of the picture that is judged.
const ASPECT: f64 = 1.5;
const HEIGHT_PX: f64 = 160.0;
/// Most steps of a ray; a ray with more creeps along the surface, and counts as a hit.
const MAX_STEPS: u32 = 300;
/// Parts of the rays that hit, in a picture worth seeing.
const HITS: std::ops::RangeInclusive<f64> = 0.2..=0.98;
/// Part of the hits that the lights must reach, not counting shadows.
const MIN_LIT: f64 = 0.45;
/// Mean luminance of the colours that the surface may have, linear.
const MIN_LUMINANCE: f64 = 0.12;
/// Length of the hits' mean normal, above which the surface is flat.
const MAX_FLATNESS: f64 = 0.93;
/// Distance from the eye to the surface, as a part of the bounding radius, below which something
/// stands before the eye.
const MIN_CLEARANCE: f64 = 0.02;

/// A search for a surprise.
#[derive(Clone, Debug)]
pub struct Surprise {
    dice: Dice,
    tries: u32,
}

impl Surprise {
    /// The search from `seed`.
    pub fn new(seed: u64) -> Self {
        Self { dice: Dice::new(seed), tries: 0 }
    }

    /// Tries another scene; some if it is worth seeing, or if all tries are used up.
    ///
    /// One try takes some milliseconds, tens where a formula is slow.
    pub fn step(&mut self) -> Option<Scene> {
        self.tries += 1;
        if self.tries > MAX_TRIES {
            return self.preset().map(|preset| (preset.scene)());
        }
        let scene = self.candidate()?;
        is_worth_seeing(&scene).then_some(scene)
    }

    /// The surprise of this search.
    pub fn finish(mut self) -> Scene {
        loop {
            if let Some(scene) = self.step() {
                return scene;
            }
        }
    }

    /// A preset that shows a set from outside, in direct light.
    fn preset(&mut self) -> Option<&'static Preset> {
        let lists = [presets::opening_scenes(), presets::formulas(), presets::mixes()];
        self.dice.pick(self.dice.clone().pick(&lists)?)
    }

    fn candidate(&mut self) -> Option<Scene> {
        let scene = (self.preset()?.scene)();
        let locks = Locks { view: true, ..Locks::default() };
        let mut scene = vary(&scene, AMOUNT, locks, self.dice.bits());
        if mean_luminance(&scene.surface.gradient) < MIN_LUMINANCE {
            return None;
        }
        // Half of the surprises keep the preset's view: somebody chose it.
        if self.dice.chance(0.5) {
            scene.camera = self.around(&scene);
        }
        scene.lights = self.lights();
        scene.validate().is_ok().then_some(scene)
    }

    /// A camera that looks at the set from any side, near enough to fill the picture.
    fn around(&mut self, scene: &Scene) -> Camera {
        let model = FractalModel::new(&scene.fractal);
        let field = model.whole();
        let up = self.dice.signed() * 0.7;
        let angle = self.dice.unit() * std::f64::consts::TAU;
        let direction = DVec3::new(angle.cos(), angle.sin(), up).normalize();
        let half_angle = scene.camera.half_height(1.0).atan();
        let distance = field.bounding_radius() / half_angle.sin() * (0.6 + 0.35 * self.dice.unit());
        let center = field.origin().to_dvec3() + field.center();
        let camera = Camera::looking_at(center + direction * distance, center, DVec3::Z);
        Camera { vertical_fov_deg: scene.camera.vertical_fov_deg, ..camera }
    }

    /// A key light over the viewer's shoulder and a rim light from behind, of two colours.
    fn lights(&mut self) -> Lights {
        const KEYS: [[f32; 3]; 4] =
            [[1.0, 0.86, 0.68], [1.0, 0.95, 0.88], [0.86, 0.92, 1.0], [1.0, 0.8, 0.74]];
        const RIMS: [[f32; 3]; 4] =
            [[0.45, 0.62, 1.0], [1.0, 0.5, 0.25], [0.4, 0.9, 0.85], [0.85, 0.45, 1.0]];
        let side = if self.dice.chance(0.5) { 1.0 } else { -1.0 };
        let key = [-0.55 * side, 0.45 + 0.2 * self.dice.signed(), 0.7];
        let rim = [0.75 * side, 0.35, -0.5];
        let mut color = |of: &[[f32; 3]]| self.dice.pick(of).copied().unwrap_or([1.0; 3]);
        let key = EnvironmentLight::headlight(key, color(&KEYS), 2.6);
        let rim = EnvironmentLight::headlight(rim, color(&RIMS), 1.6);
        Lights { environment: vec![key, rim], ..Lights::default() }
    }
}

/// True if a picture of the scene is neither empty, nor flat, nor dark, nor taken inside the set.
pub fn is_worth_seeing(scene: &Scene) -> bool {
    let model = FractalModel::new(&scene.fractal);
    let field = &**model.whole();
    let camera = &scene.camera;
    let eye = field.local(&camera.position);
    let cone = pixel_cone(camera, ASPECT, HEIGHT_PX);
    if field.clear_distance(eye) < MIN_CLEARANCE * field.bounding_radius() {
        return false;
    }
    let lights = toward_lights(scene);
    let (mut hits, mut lit, mut normals) = (0.0, 0.0, DVec3::ZERO);
    let [columns, rows] = GRID;
    for (x, y) in (0..rows).flat_map(|y| (0..columns).map(move |x| (x, y))) {
        let part = |i: u32, count: u32| 2.0 * (f64::from(i) + 0.5) / f64::from(count) - 1.0;
        let ndc = DVec2::new(part(x, columns), part(y, rows));
        let ray = camera_ray(camera, &field.origin(), ndc, ASPECT);
        let traced = field.trace(ray, cone, f64::INFINITY, MAX_STEPS);
        let Some(depth) = traced.unwrap_or_else(Some) else { continue };
        let footprint = (cone * depth).max(1e-9);
        let normal = field.normal(ray.at(depth - footprint), footprint);
        hits += 1.0;
        normals += normal;
        lit += f64::from(u8::from(lights.iter().any(|light| light.dot(normal) > 0.15)));
    }
    let part = hits / f64::from(columns * rows);
    HITS.contains(&part) && lit >= MIN_LIT * hits && normals.length() <= MAX_FLATNESS * hits
}

/// Mean luminance of a gradient, linear.
fn mean_luminance(gradient: &[GradientStop]) -> f64 {
    let table = color::gradient_lut(gradient);
    let of = |[r, g, b, _]: [f32; 4]| color::luminance(DVec3::new(r.into(), g.into(), b.into()));
    table.iter().map(|entry| of(*entry)).sum::<f64>() / table.len() as f64
}

/// Unit vectors toward the environment lights of a scene, in its coordinates.
fn toward_lights(scene: &Scene) -> Vec<DVec3> {
    let lights = follow::effective(&scene.lights, &scene.camera);
    let direction = |light: &EnvironmentLight| {
        light.frame.to_world(DVec3::from_array(light.direction), &scene.camera)
    };
    lights.environment.iter().filter(|light| !light.muted).map(direction).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::LightFrame;

    #[test]
    fn empty_close_and_dark_views_are_not_worth_seeing() {
        let good = presets::opening();
        assert!(is_worth_seeing(&good));
        let mut away = good.clone();
        away.camera =
            Camera::looking_at(DVec3::new(3.0, 0.0, 0.0), DVec3::new(9.0, 0.0, 0.0), DVec3::Z);
        assert!(!is_worth_seeing(&away), "nothing in the picture");
        let mut inside = good.clone();
        inside.camera = Camera::looking_at(DVec3::new(0.1, 0.0, 0.0), DVec3::ZERO, DVec3::Z);
        assert!(!is_worth_seeing(&inside), "inside the set");
        let mut dark = good.clone();
        for light in &mut dark.lights.environment {
            (light.frame, light.direction) = (LightFrame::View, [0.0, 0.0, -1.0]);
        }
        assert!(!is_worth_seeing(&dark), "lit from behind alone");
    }

    #[test]
    fn surprises_are_valid_differ_and_come_again_from_their_seed() {
        let scenes: Vec<Scene> = (0..8).map(|seed| Surprise::new(seed).finish()).collect();
        for (seed, scene) in (0..).zip(&scenes) {
            assert_eq!(scene.validate(), Ok(()), "{seed}");
            assert!(scenes.iter().filter(|other| *other == scene).count() == 1, "{seed}");
        }
        assert_eq!(Surprise::new(5).finish(), scenes[5]);
    }
}
