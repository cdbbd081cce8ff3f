//! The path tracer: against closed forms, against itself, and what it must never do.
//!
//! | file | contents |
//! |---|---|
//! | `denoise` | the denoiser |
//! | `media` | fog, and sets that are a medium |
//! | `truth` | white furnaces and closed forms |
//! | `sampling` | kinds of samples, convergence, pieces of a picture |

mod denoise;
mod media;
mod sampling;
mod truth;

use mandelight::{
    formula::{Fractal, own},
    gpu::readback::Readback,
    render::{
        Region, frame, integrator,
        recorder::{Dispatches, Recorder},
        samples::means,
        schedule::{Points, Stage, Trace, Work},
        sky::SkyCache,
        space::RenderSpace,
        targets::Targets,
        uniforms::Inputs,
    },
    scene::{Background, GradientStop, IntegratorKind, Lights, RigKind, Scene, param},
};
use mandelight_test_support::device::pipelines;

const SIZE: [u32; 2] = [48, 36];

/// The strategy that gathers light: `STRATEGY_` of `shaders/lib/path_light.wgsl`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Gather {
    Both,
    Lights,
    Surfaces,
}

/// A picture of which any samples can be drawn.
struct Tracer {
    targets: Targets,
    inputs: Inputs,
}

impl Tracer {
    fn new(scene: &Scene, gather: Gather) -> Self {
        let pipelines = pipelines();
        let region = Region::whole(SIZE);
        let sky = SkyCache::default().sky_of(scene, None);
        let space = RenderSpace::of(scene, region);
        let mut inputs = Inputs::about(scene, region, &space).with_sky(scene, &space, sky.as_ref());
        assert!(inputs.traces_paths());
        inputs.frame.paths.strategy = gather as u32;
        let mut targets = Targets::new(&pipelines.layouts, region);
        (integrator::of(&inputs).fit_targets)(&mut targets, &pipelines.layouts, &inputs);
        targets.upload(&pipelines.gpu.queue, &inputs);
        pipelines.specialize(scene);
        Self { targets, inputs }
    }

    /// Each pixel's mean over `count` path samples, at most eight, from the number `first` on.
    fn film(&self, first: u32, count: u32) -> Vec<[f32; 3]> {
        let pipelines = pipelines();
        let passes = pipelines.of_frame(&self.inputs);
        let mut dispatches = Dispatches::default();
        // Samples are numbered from the first jittered one on, and a first one replaces the film.
        let points = Points::Samples { first: first + 1, count };
        let trace = Trace::whole(points, Stage::Path, 0, SIZE);
        let gpu = &pipelines.gpu;
        for half in [&self.targets.film_rg, &self.targets.film_bw] {
            gpu.queue.write_buffer(half, 0, &vec![0; half.size() as usize]);
        }
        for batch in Work::Trace(trace).batches(self.targets.batch_workgroups) {
            let mut recorder = Recorder::new(
                &pipelines.layouts,
                &passes,
                &self.targets,
                &self.inputs,
                &mut dispatches,
            );
            frame::record(integrator::of(&self.inputs), &mut recorder, batch);
            gpu.queue.submit([recorder.finish()]);
        }
        let read = |buffer| Readback::buffer(gpu, buffer).wait(gpu).expect("the film's bytes");
        let (rg, bw) = (read(&self.targets.film_rg), read(&self.targets.film_bw));
        means(&rg, &bw).collect()
    }
}

/// A scene of the formula with this estimate of the distance, in one colour, without lights, on a black background.
fn scene_of(distance: &str, color: [f32; 3]) -> Scene {
    let text = format!(
        "name \"Solid\"; step {{ z = z; }} estimate distance {distance}; bound 4; iterations 2;"
    );
    plain(Fractal::new(own::alone(&text).expect("a formula")), color)
}

/// A scene of `fractal` in one colour, diffuse, without lights, on a black background.
fn plain(fractal: Fractal, color: [f32; 3]) -> Scene {
    let mut scene = Scene { fractal, ..Scene::default() };
    scene.lights = Lights { environment: Vec::new(), ..Lights::default() };
    scene.background = Background::gradient([0.0; 3], [0.0; 3]);
    scene.surface.gradient = vec![GradientStop { position: 0.0, color }];
    (scene.surface.ambient, scene.surface.diffuse, scene.surface.specular) = (0.0, 1.0, 0.0);
    scene.integrator.kind = IntegratorKind::Path;
    scene.integrator.reach = None;
    scene.quality.detail = param::DETAIL.min;
    scene
}

/// Adds a sky of radiance 1 on all sides.
fn under_white_sky(mut scene: Scene) -> Scene {
    let rig = &mut scene.lights.rig;
    rig.kind = RigKind::Sky;
    rig.shadow_reach = None;
    (rig.sky.zenith, rig.sky.horizon, rig.sky.ground) = ([1.0; 3], [1.0; 3], [1.0; 3]);
    rig.sky.sun_strength = 0.0;
    scene
}

/// The mean over all pixels and channels.
fn mean(film: &[[f32; 3]]) -> f64 {
    let sum: f64 = film.iter().flatten().map(|&channel| f64::from(channel)).sum();
    sum / (3 * film.len()) as f64
}

/// Checks that every value of a film is finite and not negative.
fn assert_is_light(film: &[[f32; 3]]) {
    let wrong = film.iter().flatten().filter(|c| !c.is_finite() || **c < 0.0).count();
    assert_eq!(wrong, 0, "values that are no light");
}
