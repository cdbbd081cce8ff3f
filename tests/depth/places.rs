//! Where the views are, and their passes in coordinates of one's choice.

use std::sync::Arc;

use glam::{DVec2, DVec3};
use mandelight::{
    fractal::{DeepField, DistanceField, Ray, Reference, camera_ray, deep::Search},
    gpu::readback::Readback,
    render::{
        Region,
        frame::{Dispatches, Recorder, record},
        gbuffer::Samples,
        schedule::{Points, Stage, Trace, Work},
        space::RenderSpace,
        targets::Targets,
        uniforms::Inputs,
    },
    scene::{Camera, Fractal, PrecisePoint, Scene},
};

use crate::harness::pipelines;

/// A point of the surface of power 8 to less than 1e-30, and the direction it is looked at along.
const POWER_8: ([&str; 3], [f64; 3]) = (
    [
        "-0.29601176724531189050911006306022274230736161",
        "-0.84328481599099249352515910401335034767521926",
        "0.37077988123915841580698601171728158967365266",
    ],
    [0.373, 0.8337, -0.4073],
);

/// The same of power 3.
const POWER_3: ([&str; 3], [f64; 3]) = (
    [
        "-0.61984950289083675921081670677882479678813811",
        "0.05914404510058610768248565359616913277999471",
        "0.21621421310774659890823180171396924110898232",
    ],
    [0.9133, -0.3815, -0.1425],
);

/// The same of the Julia form of power 8.
const JULIA: ([&str; 3], [f64; 3]) = (
    [
        "-0.30888984218751890347855344843486610538809678",
        "0.98597146898507521586390400044472522307089860",
        "-0.18819905768768892099979488397141155059571933",
    ],
    [-0.0731, -0.7977, 0.5986],
);

/// The scene that looks at such a point of `fractal`, of power 8 or 3, from `scale` away.
pub fn at(fractal: Fractal, scale: f64) -> Scene {
    let (point, toward) = match (fractal.power == 3.0, fractal.julia) {
        (true, _) => POWER_3,
        (_, true) => JULIA,
        _ => POWER_8,
    };
    let anchor = PrecisePoint(point.map(|text| text.parse().expect("a decimal number")));
    let toward = DVec3::from_array(toward).normalize();
    let mut camera = Camera::looking_at(-toward, DVec3::ZERO, toward.any_orthonormal_vector());
    camera.position = anchor.moved_by(-toward * scale, 1e-6 * scale);
    camera.pivot = anchor;
    Scene { fractal, camera, ..Scene::default() }
}

/// The scene of power 8.
pub fn scene(scale: f64) -> Scene {
    at(Fractal::default(), scale)
}

/// The anchor that a view of `scene` finds.
pub fn found(scene: &Scene, size: [u32; 2]) -> Arc<Reference> {
    let aspect = Region::whole(size).aspect();
    Search::new(&scene.fractal, &scene.camera, aspect, None).expect("a whole power").finish()
}

/// An anchor on the surface at another place of the picture.
pub fn anchor_at(scene: &Scene, size: [u32; 2], ndc: DVec2) -> Option<Arc<Reference>> {
    let field = field(scene, size);
    let ray = camera_ray(&scene.camera, &field.origin(), ndc, Region::whole(size).aspect());
    let depth = field.march(ray, 1e-4, 100.0 * scene.camera.view_unit())?;
    let anchor = scene.camera.position.moved_by(ray.direction * depth, 1e-12 * depth);
    Reference::new(&scene.fractal, anchor).map(Arc::new)
}

/// The set in f64 about the anchor that a view of `scene` finds.
pub fn field(scene: &Scene, size: [u32; 2]) -> DeepField {
    let region = Region::whole(size);
    let reference = found(scene, size);
    let footprint = RenderSpace::about(reference.clone(), scene).footprint(scene, region);
    DeepField::new(reference, &scene.fractal, footprint)
}

/// What the passes over centre samples leave.
pub struct Drawn {
    pub samples: Samples,
    /// Radiance of each pixel.
    pub film: Vec<[f32; 3]>,
}

/// Draws the centre samples of `scene` in the coordinates of `space`.
pub fn drawn(scene: &Scene, size: [u32; 2], space: &RenderSpace) -> Drawn {
    let pipelines = pipelines();
    let gpu = &pipelines.gpu;
    let region = Region::whole(size);
    let inputs = Inputs::about(scene, region, space);
    let mut targets = Targets::new(pipelines, region);
    targets.fit_direct(pipelines, inputs.has_indirect());
    targets.upload(&gpu.queue, &inputs);
    for variant in mandelight::render::pipelines::PipelineVariant::special(&inputs.frame) {
        pipelines.prepare(variant);
    }
    let passes = pipelines.passes(&inputs.frame);
    let mut stages = vec![(Points::Level(0), Stage::March)];
    if inputs.has_indirect() {
        stages.push((Points::Indirect(0), Stage::Indirect));
    }
    let mut dispatches = Dispatches::default();
    for (points, from) in stages {
        let mut recorder = Recorder::new(pipelines, &passes, &targets, &inputs, &mut dispatches);
        let workgroups = points.grid(size).workgroups();
        let lights = inputs.shining();
        let trace = Trace { points, from, lights, first_workgroup: 0, workgroups };
        record(&mut recorder, Work::Trace(trace));
        gpu.queue.submit([recorder.finish()]);
        gpu.wait();
    }
    assert_eq!(gpu.faults(), 0);
    let read = |buffer| Readback::buffer(gpu, buffer).wait(gpu).expect("bytes");
    let center = &targets.center;
    let samples = Samples::decode(&read(&center.surface), &read(&center.visibility), space.scale());
    let pairs = |buffer| -> Vec<[f32; 2]> {
        read(buffer).as_chunks::<8>().0.iter().map(|pair| bytemuck::cast(*pair)).collect()
    };
    let film = pairs(&targets.film_rg).into_iter().zip(pairs(&targets.film_bw));
    let film = film.map(|([r, g], [b, weight])| [r, g, b].map(|sum| sum / weight.max(1.0)));
    Drawn { samples, film: film.collect() }
}

/// The ray through the centre of a pixel, counted row by row, in coordinates relative to `origin`.
pub fn ray(scene: &Scene, [width, height]: [u32; 2], index: usize, origin: &PrecisePoint) -> Ray {
    let [x, y] = [index as u32 % width, index as u32 / width].map(|v| f64::from(v) + 0.5);
    let ndc = DVec2::new(2.0 * x / f64::from(width) - 1.0, 1.0 - 2.0 * y / f64::from(height));
    camera_ray(&scene.camera, origin, ndc, Region::whole([width, height]).aspect())
}

/// Radius of a pixel's cone at depth one.
pub fn cone(scene: &Scene, size: [u32; 2]) -> f64 {
    mandelight::fractal::pixel_cone(&scene.camera, Region::whole(size).aspect(), size[1].into())
}
