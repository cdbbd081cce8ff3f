//! What a view says that it holds of the GPU's memory, and the most that it may.

use mandelight::{
    render::{Pace, Region, View, memory},
    scene::Scene,
};
use mandelight_test_support::device::{fresh_pipelines, pipelines};

/// Table 4.1 of the thesis: its total in single precision, 116.5 MiB.
const MAX_BYTES: u64 = 116 * 1024 * 1024 + 512 * 1024;

/// A view on a device of its own, with all buffers made, and what that device's allocator counts.
fn allocated(scene: &Scene, with_environment_map: bool, size: [u32; 2]) -> (u64, u64) {
    let pipelines = fresh_pipelines();
    let gpu = &pipelines.gpu;
    let counted = || {
        let report = gpu.device.generate_allocator_report().expect("a report of the allocator");
        report.allocations.iter().map(|allocation| allocation.size).sum::<u64>()
    };
    let before = counted();
    let region = Region::whole(size).shared_by(scene.camera.stereo.layout);
    let mut view = View::new(&pipelines, region, Pace::Interactive);
    let (_, environment_map) = memory::everything_on();
    view.set_environment_map(with_environment_map.then_some(&environment_map));
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
    let (scene, _) = memory::everything_on();
    assert_eq!(scene.validate(), Ok(()));
    let (told, held) = allocated(&scene, true, [1920, 1080]);
    assert!(told < MAX_BYTES, "{}", memory::mebibytes(told));
    let readme = include_str!("../../README.md").replace(',', "");
    assert!(readme.contains(&format!("| all | | {told} |")), "README.md does not say {told}");
    // Buffers are rounded up, and drivers need a little of their own.
    let off = held as f64 / told as f64;
    assert!((0.99..1.06).contains(&off), "{told} told, {held} held");
}

#[test]
fn what_is_off_takes_nothing() {
    let (told, held) = allocated(&Scene::default(), false, [960, 540]);
    let pixels = 960 * 540;
    let view = View::new(pipelines(), Region::whole([960, 540]), Pace::Still);
    let memory = view.report().memory;
    assert_eq!(memory.sample_points, 24 * pixels);
    assert_eq!((memory.film, memory.display), (16 * pixels, 4 * pixels));
    let else_ = [memory.direct_light, memory.mip_levels, memory.blur, memory.environment_map];
    assert!(else_.iter().all(|bytes| *bytes <= 16), "{memory:?}");
    assert!((0.98..1.08).contains(&(held as f64 / told as f64)), "{told} told, {held} held");
}
