//! The seam of integrators: others than `direct` share its passes, buffers and rays.

use bytemuck::{cast_slice, pod_read_unaligned};
use glam::{DVec3, Vec3};
use mandelight::{
    gpu::readback::Readback,
    render::{
        Region, frame,
        gbuffer::Samples,
        integrator::{DIRECT, Integrator},
        pass::{camera_cone, camera_rays, march},
        recorder::{Dispatches, Recorder},
        schedule::{Points, Stage, Trace, Work},
        targets::Targets,
        uniforms::Inputs,
    },
    scene::Scene,
};
use mandelight_test_support::{
    device::pipelines,
    oracle::{rays, views},
};

use super::oracle::pictures::{draw, pixels, point_at};

/// Rays to the surface, and no light.
static RAYS_ALONE: Integrator = Integrator {
    center_passes: &[&camera_rays::PASS, &camera_cone::PASS, &march::PASS],
    jittered_passes: &[],
    plan: DIRECT.plan,
    gathers: |_| false,
    fit_targets: |_, _, _| {},
};

#[test]
fn rays_lie_at_the_surface_points_of_their_pixels() {
    let pipelines = pipelines();
    let gpu = &pipelines.gpu;
    let scene = Scene::default();
    let region = Region::whole(views::SIZE);
    let mut targets = Targets::new(&pipelines.layouts, region);
    let inputs = Inputs::new(&scene, region);
    (RAYS_ALONE.fit_targets)(&mut targets, &pipelines.layouts, &inputs);
    targets.upload(&gpu.queue, &inputs);
    pipelines.specialize(&scene);
    let passes = pipelines.of_frame(&inputs);
    let mut dispatches = Dispatches::default();
    let points = Points::Level(0);
    let trace = Trace::whole(points, Stage::March, 0, views::SIZE);
    for batch in Work::Trace(trace).batches(targets.batch_workgroups) {
        let mut recorder =
            Recorder::new(&pipelines.layouts, &passes, &targets, &inputs, &mut dispatches);
        frame::record(&RAYS_ALONE, &mut recorder, batch);
        gpu.queue.submit([recorder.finish()]);
    }
    assert_eq!(dispatches.passes(), ["camera_cone", "camera_rays", "march"]);

    let read = |buffer| Readback::buffer(gpu, buffer).wait(gpu).expect("the buffer's bytes");
    let samples =
        Samples::decode(&read(&targets.center.surface), &read(&targets.center.visibility), 1.0);
    assert!(
        samples.depth == draw(&scene).samples.depth,
        "depths differ from those of direct light"
    );
    assert!(cast_slice::<u8, f32>(&read(&targets.film_bw)).iter().all(|sum| *sum == 0.0));

    // Rays lie in the order of threads: each is known by its direction.
    let bytes = read(&targets.rays);
    let rays: Vec<[f32; 8]> =
        bytes.as_chunks::<32>().0.iter().map(|ray| pod_read_unaligned(ray)).collect();
    let direction_of = |[.., x, y, z, _]: [f32; 8]| Vec3::new(x, y, z).as_dvec3();
    let mut hits = 0;
    for (pixel, depth) in pixels().into_iter().zip(&samples.depth) {
        let direction = rays::direction(&scene.camera, views::SIZE, pixel);
        let ray = rays
            .iter()
            .find(|ray| direction_of(**ray).distance(direction) < 1e-5)
            .unwrap_or_else(|| panic!("no ray through {pixel:?}"));
        let [x, y, z, radius, ..] = *ray;
        let origin = Vec3::new(x, y, z).as_dvec3();
        // On a miss the depth is 0, and the ray still starts at the eye.
        let expected: DVec3 = point_at(&scene, pixel, *depth);
        assert!(origin.distance(expected) < 1e-5, "{pixel:?}: {origin} is not {expected}");
        if *depth > 0.0 {
            hits += 1;
            let expected = rays::hit_distance(&scene, views::SIZE, f64::from(*depth));
            assert!((f64::from(radius) / expected - 1.0).abs() < 1e-4, "{pixel:?}: {radius}");
        }
    }
    assert!(hits * 10 > samples.depth.len(), "{hits} hits");
}
