//! What a view says that it holds of the GPU's memory, and the most that it may.

use std::sync::Arc;

use mandelight::{
    render::{Pace, Region, View, memory},
    scene::{EnvironmentMap, Scene},
};
use mandelight_test_support::device::{fresh_pipelines, pipelines};

/// Table 4.1 of the thesis: its total in single precision, 116.5 MiB.
const MAX_BYTES: u64 = 116 * 1024 * 1024 + 512 * 1024;

/// Most for a picture in path-traced light.
const MAX_TRACED_BYTES: u64 = 160 * 1024 * 1024;

/// A view on a device of its own, with all buffers made, and what that device's allocator counts.
fn allocated(
    scene: &Scene,
    environment_map: Option<&Arc<EnvironmentMap>>,
    size: [u32; 2],
) -> (u64, u64) {
    let pipelines = fresh_pipelines();
    let gpu = &pipelines.gpu;
    let counted = || {
        let report = gpu.device.generate_allocator_report().expect("a report of the allocator");
        report.allocations.iter().map(|allocation| allocation.size).sum::<u64>()
    };
    let before = counted();
    let region = Region::whole(size).shared_by(scene.camera.stereo.layout);
    let mut view = View::new(&pipelines, region, Pace::Interactive);
    view.set_environment_map(environment_map);
    view.set_scene(scene, false);
    view.pump(0.0);
    gpu.wait();
    // What uploads went through is given back after the next submit.
    gpu.queue.submit([]);
    gpu.wait();
    let held = counted() - before;
    assert_eq!(gpu.faults(), 0);
    (view.report().memory.total(), held)
}

#[test]
fn everything_on_stays_below_the_thesis() {
    let (scene, map) = memory::everything_on();
    assert_everything_stays_below(MAX_BYTES, "all", &scene, &map);
}

#[test]
fn traced_light_stays_below_its_limit() {
    let (scene, map) = memory::everything_traced();
    assert_everything_stays_below(MAX_TRACED_BYTES, "all, in path-traced light", &scene, &map);
}

/// Checks a scene with everything on against a limit, and against its line in the README.
fn assert_everything_stays_below(
    limit: u64,
    line: &str,
    scene: &Scene,
    environment_map: &Arc<EnvironmentMap>,
) {
    assert_eq!(scene.validate(), Ok(()));
    let (told, held) = allocated(scene, Some(environment_map), [1920, 1080]);
    assert!(told < limit, "{}", memory::mebibytes(told));
    let readme = include_str!("../../README.md").replace(',', "");
    let wanted = format!("| {} | | {told} |", line.replace(',', ""));
    assert!(readme.contains(&wanted), "README.md does not say {wanted}");
    // Buffers are rounded up, and drivers need a little of their own.
    let off = held as f64 / told as f64;
    assert!((0.99..1.06).contains(&off), "{told} told, {held} held");
}

#[test]
fn what_is_off_takes_nothing() {
    let (told, held) = allocated(&Scene::default(), None, [960, 540]);
    let pixels = 960 * 540;
    let view = View::new(pipelines(), Region::whole([960, 540]), Pace::Still);
    let memory = view.report().memory;
    assert_eq!(memory.sample_points, 24 * pixels);
    assert_eq!((memory.film, memory.display), (16 * pixels, 4 * pixels));
    let else_ = [memory.direct_light, memory.mip_levels, memory.blur, memory.environment_map];
    assert!(else_.iter().all(|bytes| *bytes <= 16), "{memory:?}");
    assert!((0.98..1.08).contains(&(held as f64 / told as f64)), "{told} told, {held} held");
}
