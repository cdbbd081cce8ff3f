//! Where the views are, and their passes in coordinates of one's choice.

use std::sync::Arc;

use glam::DVec2;
use mandelight::{
    formula::{
        DistanceField, Ray, ReferenceOrbit,
        mandelbulb::{
            Mandelbulb,
            deep::{self, DeepField, Reference},
        },
    },
    fractal::{FractalModel, Search, camera_ray},
    gpu::readback::Readback,
    render::{
        Region,
        frame::record,
        gbuffer::Samples,
        integrator::DIRECT,
        pipeline_set,
        recorder::{Dispatches, Recorder},
        schedule::{Points, Stage, Trace, Work},
        space::RenderSpace,
        targets::Targets,
        uniforms::Inputs,
    },
    scene::{PrecisePoint, Scene},
};
use mandelight_test_support::{
    deep::views::{ANCHORS, Anchor},
    device::pipelines,
};

/// The scene that looks at an anchor of `fractal`, of power 8 or 3, from `scale` away.
pub fn at(fractal: Mandelbulb, scale: f64) -> Scene {
    let name = match (fractal.power == 3.0, fractal.julia) {
        (true, _) => "from the other side",
        (_, true) => "of the Julia key, from aside",
        _ => "from aside",
    };
    let is_it = |anchor: &&Anchor| {
        (anchor.power, anchor.julia, anchor.name) == (fractal.power, fractal.julia, name)
    };
    let anchor = ANCHORS.iter().find(is_it).expect("the anchor");
    Scene { camera: anchor.camera(scale), fractal: fractal.into(), ..Scene::default() }
}

/// The scene of power 8.
pub fn scene(scale: f64) -> Scene {
    at(Mandelbulb::default(), scale)
}

/// The anchor that a view of `scene` finds.
pub fn found(scene: &Scene, size: [u32; 2]) -> Arc<dyn ReferenceOrbit> {
    let aspect = Region::whole(size).aspect();
    Search::new(&scene.fractal, &scene.camera, aspect, None).expect("a whole power").finish()
}

/// An anchor on the surface at another place of the picture.
pub fn anchor_at(scene: &Scene, size: [u32; 2], ndc: DVec2) -> Option<Arc<Reference>> {
    let field = field(scene, size);
    let ray = camera_ray(&scene.camera, &field.origin(), ndc, Region::whole(size).aspect());
    let depth = field.march(ray, 1e-4, 100.0 * scene.camera.view_unit())?;
    let anchor = scene.camera.position.moved_by(ray.direction * depth, 1e-12 * depth);
    Reference::new(&Mandelbulb::of(&scene.fractal), anchor).map(Arc::new)
}

/// The set in f64 about the anchor that a view of `scene` finds.
pub fn field(scene: &Scene, size: [u32; 2]) -> DeepField {
    let region = Region::whole(size);
    let reference = found(scene, size);
    let footprint = about(reference.clone(), scene).footprint(scene, region);
    let reference = deep::reference_of(&reference).cloned().map(Arc::new).expect("a Mandelbulb's");
    DeepField::new(reference, &Mandelbulb::of(&scene.fractal), footprint)
}

/// The coordinates about `reference` for what `scene`'s camera sees.
pub fn about(reference: Arc<dyn ReferenceOrbit>, scene: &Scene) -> RenderSpace {
    RenderSpace::about(&FractalModel::new(&scene.fractal), reference, scene)
}

/// The scene's own coordinates.
pub fn plain(scene: &Scene) -> RenderSpace {
    RenderSpace::plain(&FractalModel::new(&scene.fractal))
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
    let mut targets = Targets::new(&pipelines.layouts, region);
    targets.fit_direct(&pipelines.layouts, inputs.has_indirect());
    targets.upload(&gpu.queue, &inputs);
    pipelines.prepare_together(&pipeline_set::specialized(&inputs));
    let passes = pipelines.of_frame(&inputs);
    let mut stages = vec![(Points::Level(0), Stage::March)];
    if inputs.has_indirect() {
        stages.push((Points::Indirect(0), Stage::Indirect));
    }
    let mut dispatches = Dispatches::default();
    for (points, from) in stages {
        let mut recorder =
            Recorder::new(&pipelines.layouts, &passes, &targets, &inputs, &mut dispatches);
        let trace = Trace::whole(points, from, inputs.shining(), size);
        record(&DIRECT, &mut recorder, Work::Trace(trace));
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
