//! Scenes that are hard on the kernels: any values of all parameters, any formula, any depth.
//!
//! In: a seed. Out: one valid scene after another. Values and their extremes are those of [`crate::scenes`], the
//! eye is where surface is, and half of the views are closer than an f32 resolves.

use std::sync::Arc;

use glam::{DQuat, DVec3};
use mandelight::{
    formula::{Fractal, contract::HybridSteps, hybrid, mandelbulb::Mandelbulb, march::Ray, own},
    fractal::model::FractalModel,
    scene::{
        BackgroundKind, Camera, EnvironmentLight, EnvironmentMap, IntegratorKind, MAX_LIGHTS,
        PointLight, PrecisePoint, RigKind, Scene, environment_map::MAX_RADIANCE, param,
    },
};
use proptest::{
    strategy::{BoxedStrategy, Strategy, ValueTree},
    test_runner::{Config, RngAlgorithm, TestRng, TestRunner},
};

use crate::{
    deep::random_views::random_view,
    expressions::Expressions,
    random::Random,
    scenes::{fill, scene},
};

/// The closest views, scene units.
const NEAREST: f64 = 1e-26;
/// Name of the environment map, which scenes have as their rig's or background's.
const MAP_NAME: &str = "hostile.hdr";
/// Typed formulas and sets of hybrid steps of a run: each takes a driver seconds to compile.
const TYPED_FORMULAS: u64 = 4;
const HYBRID_SETS: usize = 4;

/// A scene, and the environment map that it is shown with.
pub struct HostileScene {
    /// What the fractal and the view are, for messages.
    pub name: String,
    /// The scene.
    pub scene: Scene,
    /// The loaded environment map; none where the scene names none or where it is missing.
    pub environment_map: Option<Arc<EnvironmentMap>>,
}

/// One hostile scene after another, the same of the same seed.
pub struct HostileScenes {
    random: Random,
    runner: TestRunner,
    scenes: BoxedStrategy<Scene>,
    /// Steps of hybrids: few sets of formulas, any values.
    hybrids: Vec<HybridSteps>,
    typed: Vec<String>,
}

impl HostileScenes {
    /// The scenes of `seed`.
    ///
    /// # Panics
    ///
    /// If the library has no formula that can be a step of hybrids.
    pub fn new(seed: u64) -> Self {
        let mut random = Random(seed | 1);
        let mut bytes = [0; 32];
        bytes.fill_with(|| (random.unit() * 256.0) as u8);
        let rng = TestRng::from_seed(RngAlgorithm::ChaCha, &bytes);
        let hybrids = (0..HYBRID_SETS).map(|_| hybrid_steps(&mut random)).collect();
        let texts = (0..TYPED_FORMULAS).map(|i| Expressions::new(seed.wrapping_add(i)).formula());
        Self {
            random,
            runner: TestRunner::new_with_rng(Config::default(), rng),
            scenes: scene().boxed(),
            hybrids,
            typed: texts.collect(),
        }
    }

    /// The next scene.
    ///
    /// # Panics
    ///
    /// If the generator of scenes refuses all values that it draws.
    pub fn next_scene(&mut self) -> HostileScene {
        let tree = self.scenes.new_tree(&mut self.runner);
        let mut scene = tree.expect("values that make a scene").current();
        self.set_fractal(&mut scene);
        let view = self.set_view(&mut scene);
        let light = self.set_light(&mut scene);
        let environment_map = self.set_environment_map(&mut scene);
        // A centre sample, jittered ones, and no more: each takes as long as the first.
        scene.quality.samples = 1 + self.below(3) as u32;
        let Fractal { iterations, bailout, .. } = scene.fractal;
        let fractal = scene.fractal.formula().name();
        let name =
            format!("{fractal}, {iterations} iterations, bailout {bailout}, {view}, {light}");
        HostileScene { name, scene, environment_map }
    }

    fn below(&mut self, count: usize) -> usize {
        (self.random.unit() * count as f64) as usize
    }

    fn is_one_of(&mut self, count: usize) -> bool {
        self.below(count) == 0
    }

    /// Replaces some of the fractals by hybrids, by typed formulas and by plain powers.
    fn set_fractal(&mut self, scene: &mut Scene) {
        let Fractal { iterations, bailout, section_planes, .. } = scene.fractal.clone();
        let other = match self.below(8) {
            0 => {
                let which = self.below(HYBRID_SETS);
                let mut steps = self.hybrids[which].clone();
                for step in &mut steps.steps {
                    step.repeats = 1 + self.below(3) as u32;
                    fill(step.fields_mut(), || self.random.unit());
                }
                hybrid::fractal(steps).ok()
            }
            1 => {
                let which = self.below(self.typed.len());
                own::alone(&self.typed[which]).ok().map(Fractal::new)
            }
            2..5 => {
                let power = (2.0 + 15.0 * self.random.unit()).floor();
                Some(Mandelbulb { power, julia: self.is_one_of(4), ..Mandelbulb::default() }.into())
            }
            _ => None,
        };
        if let Some(mut fractal) = other {
            fractal.iterations = iterations;
            fractal.bailout = bailout.min(fractal.max_bailout());
            // Planes leave little of most sets.
            if self.is_one_of(4) {
                fractal.section_planes = section_planes;
            }
            scene.fractal = fractal;
        }
    }

    /// Moves the eye to where surface is, in most scenes.
    fn set_view(&mut self, scene: &mut Scene) -> String {
        match self.below(8) {
            0 => "anywhere".to_owned(),
            1 => match random_view(&mut self.random, NEAREST) {
                Some(view) => {
                    scene.fractal = view.scene.fractal;
                    place(&mut scene.camera, &view.scene.camera);
                    view.name
                }
                None => "anywhere".to_owned(),
            },
            _ => {
                let camera = self.camera_near(&scene.fractal);
                place(&mut scene.camera, &camera);
                format!("from {:.1e}", camera.view_unit())
            }
        }
    }

    /// A camera at a random distance from a point of the surface: before it, or at the deepest behind it.
    fn camera_near(&mut self, fractal: &Fractal) -> Camera {
        let model = FractalModel::new(fractal);
        let (field, radius) = (model.whole(), model.bounding_radius().clamp(1e-3, 25.0));
        let direction = self.random.in_ball(1.0).normalize();
        let beside = self.random.in_ball(0.3 * radius);
        let start = beside - direction * 3.0 * radius;
        let depth = field.march(Ray { origin: start, direction }, 1e-12, 10.0 * radius);
        let depth = depth.unwrap_or(3.0 * radius);
        let distance = match self.below(2) {
            0 => radius * (0.01 + 3.0 * self.random.unit()),
            _ => NEAREST.powf(self.random.unit()),
        };
        let surface = PrecisePoint::from(start).moved_by(direction * depth, 1e-16);
        let turn = DQuat::from_axis_angle(direction, self.random.unit() * std::f64::consts::TAU);
        let up = turn * direction.any_orthonormal_vector();
        let mut camera = Camera::looking_at(-direction, DVec3::ZERO, up);
        camera.position = surface.moved_by(direction * -distance, 1e-6 * distance);
        camera.pivot = camera.position.moved_by(direction * distance, 1e-6 * distance);
        camera
    }

    /// Gives some scenes as many lights as there may be, at their brightest.
    fn set_light(&mut self, scene: &mut Scene) -> &'static str {
        if self.is_one_of(2) {
            scene.integrator.kind = IntegratorKind::Direct;
        }
        if !self.is_one_of(8) {
            return "few lights";
        }
        scene.lights.rig.kind = RigKind::None;
        let brightest = EnvironmentLight {
            intensity: param::ENVIRONMENT_INTENSITY.max,
            shadow_reach: None,
            ..EnvironmentLight::default()
        };
        scene.lights.environment = vec![brightest; MAX_LIGHTS / 2];
        for light in &mut scene.lights.environment {
            light.direction = self.random.in_ball(1.0).normalize().to_array();
        }
        let position = scene.camera.pivot.clone();
        let lamp =
            PointLight { intensity: param::POINT_INTENSITY.max, position, ..PointLight::default() };
        scene.lights.point = vec![lamp; MAX_LIGHTS / 2];
        "all lights"
    }

    /// An environment map of few pixels, each black or as bright as may be, for scenes that show one.
    fn set_environment_map(&mut self, scene: &mut Scene) -> Option<Arc<EnvironmentMap>> {
        let is_rig = scene.lights.rig.kind == RigKind::EnvironmentMap;
        let is_shown = is_rig || scene.background.kind == BackgroundKind::EnvironmentMap;
        if !is_shown || self.is_one_of(4) {
            return None;
        }
        MAP_NAME.clone_into(&mut scene.lights.rig.environment_map.name);
        let map = EnvironmentMap::from_fn(MAP_NAME, [8, 4], |_| {
            let level = [0.0, self.random.unit(), f64::from(MAX_RADIANCE)][self.below(3)];
            DVec3::splat(level)
        });
        Some(Arc::new(map))
    }
}

/// Moves `camera` to where `other` is; lens, field of view and stereo stay.
fn place(camera: &mut Camera, other: &Camera) {
    camera.position = other.position.clone();
    camera.pivot = other.pivot.clone();
    camera.orientation = other.orientation;
}

/// One to three random steps that fit together.
fn hybrid_steps(random: &mut Random) -> HybridSteps {
    let formulas: Vec<_> = hybrid::step_formulas().collect();
    let mut below = |count: usize| (random.unit() * count as f64) as usize;
    loop {
        let count = 1 + below(3);
        let steps: Vec<_> =
            (0..count).filter_map(|_| hybrid::step(formulas[below(formulas.len())]).ok()).collect();
        if steps.is_empty() {
            continue;
        }
        let steps = HybridSteps { loop_start: below(steps.len()), steps };
        if hybrid::fractal(steps.clone()).is_ok() {
            return steps;
        }
    }
}
