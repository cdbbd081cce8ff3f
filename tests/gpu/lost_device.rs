//! Exports whose device is lost on the way: they go on with another one, after the last finished tile or frame.

use std::{cell::Cell, ops::ControlFlow, sync::Arc};

use mandelight::{
    export::{
        self, ExportError, PictureFormat, RunDevice, StillJob, StillOptions, StillStatus,
        sequence::{FrameSink, SequenceJob},
    },
    render::Pipelines,
    scene::{
        Bloom, IntegratorKind, Path, Scene,
        path::{Easing, Key},
    },
};
use mandelight_test_support::{
    device::{fresh_pipelines, pipelines},
    view::sampled,
};

/// Width and height of the pictures: twelve tiles.
const SIZE: [u32; 2] = [101, 67];

/// Steps until `is_enough`, or until the job is done; the clock stands still.
fn step_until<T>(
    job: &mut T,
    gpu: &Arc<Pipelines>,
    mut step: impl FnMut(&mut T) -> Result<StillStatus, ExportError>,
    mut is_enough: impl FnMut(&T) -> bool,
) {
    while !is_enough(job) {
        let status = step(job).expect("a device that works");
        if matches!(status, StillStatus::Done { .. }) {
            return;
        }
        gpu.gpu.wait();
    }
}

fn still(scene: &Scene, format: PictureFormat, on: &Arc<Pipelines>) -> StillJob<Vec<u8>> {
    let options = StillOptions { format, tile_px: [32, 24], ..StillOptions::new(SIZE) };
    StillJob::new(on, scene, options, Vec::new()).expect("a still")
}

fn finished(mut job: StillJob<Vec<u8>>, on: &Arc<Pipelines>) -> Vec<u8> {
    step_until(&mut job, on, |job| job.step(0.0), |_| false);
    job.finish().expect("a file")
}

/// A file without the header of OpenEXR files, whose attributes are in another order each time.
fn pixel_bytes(file: &[u8]) -> &[u8] {
    if !export::is_exr(file) {
        return file;
    }
    // Rows of ten channels of 32 bits, each row after its number and its length.
    &file[file.len() - SIZE[1] as usize * (8 + SIZE[0] as usize * 40)..]
}

/// Uses a lost device for a while, as a page does until it is told: nothing but errors of the GPU come of it.
fn lose<T>(
    job: &mut T,
    lost: &Arc<Pipelines>,
    mut step: impl FnMut(&mut T) -> Result<StillStatus, ExportError>,
) {
    lost.gpu.device.destroy();
    for _ in 0..5 {
        let result = step(job);
        let is_expected =
            matches!(result, Ok(StillStatus::Working { .. }) | Err(ExportError::Gpu(_)));
        assert!(is_expected, "{result:?}");
    }
}

#[test]
fn a_still_goes_on_after_its_last_tile() {
    // Exposure and bloom are of the whole picture, which another device has to draw again.
    let mut direct = sampled(Scene::default(), 2);
    direct.tone.auto_exposure = true;
    direct.bloom = Bloom { strength: 0.5, threshold: 0.2, ..Bloom::default() };
    let mut paths = sampled(Scene::default(), 3);
    paths.integrator.kind = IntegratorKind::Path;
    for (scene, format) in
        [(&direct, PictureFormat::Png), (&paths, PictureFormat::Png), (&direct, PictureFormat::Exr)]
    {
        let whole = finished(still(scene, format, pipelines()), pipelines());
        let lost = fresh_pipelines();
        let mut job = still(scene, format, &lost);
        step_until(&mut job, &lost, |job| job.step(0.0), |job| job.finished_tiles() == 5);
        lose(&mut job, &lost, |job| job.step(0.0));
        let tiles = job.finished_tiles();
        assert!((5..12).contains(&tiles), "{tiles} of 12 tiles");
        job.resume_on(pipelines());
        assert_eq!(job.finished_tiles(), tiles, "finished tiles are kept");
        let resumed = finished(job, pipelines());
        assert!(pixel_bytes(&resumed) == pixel_bytes(&whole), "{format:?}: other pixels");
    }
}

/// Losses one after the other, each a tile later, and one where all tiles are finished.
#[test]
fn a_still_survives_a_loss_at_every_tile() {
    let scene = sampled(Scene::default(), 1);
    let whole = finished(still(&scene, PictureFormat::Png, pipelines()), pipelines());
    let mut device = fresh_pipelines();
    let mut job = still(&scene, PictureFormat::Png, &device);
    for tiles in [0, 1, 1, 6, 12] {
        step_until(&mut job, &device, |job| job.step(0.0), |job| job.finished_tiles() >= tiles);
        device.gpu.device.destroy();
        device = fresh_pipelines();
        job.resume_on(&device);
        assert!(job.finished_tiles() >= tiles);
    }
    assert!(finished(job, &device) == whole, "the file is another one");
}

/// The frames that came, in order.
#[derive(Default)]
struct Frames(Vec<(String, Vec<u8>)>);

impl FrameSink for Frames {
    fn add(&mut self, name: &str, picture: Vec<u8>) -> Result<(), ExportError> {
        self.0.push((name.to_owned(), picture));
        Ok(())
    }
}

/// A path of two keys and three frames.
fn path() -> Path {
    let key = |time_secs, power| {
        let mut scene = sampled(Scene::default(), 1);
        scene.fractal.set("power", power);
        Key { time_secs, easing: Easing::Linear, scene: scene.into() }
    };
    Path { frames_per_second: 2, keys: vec![key(0.0, 8.0), key(1.0, 7.0)], ..Path::default() }
}

#[test]
fn a_sequence_goes_on_with_the_frame_that_was_lost() {
    let start = |on: &Arc<Pipelines>| {
        let options = StillOptions { tile_px: [32, 24], ..StillOptions::new([48, 40]) };
        SequenceJob::new(on, path(), 0..3, options, false, Frames::default()).expect("a sequence")
    };
    let mut whole = start(pipelines());
    step_until(&mut whole, pipelines(), |job| job.step(0.0), |_| false);
    let whole = whole.finish().expect("all frames").0;
    assert_eq!(whole.len(), 3);

    let lost = fresh_pipelines();
    let mut job = start(&lost);
    step_until(&mut job, &lost, |job| job.step(0.0), |job| job.progress() >= (1, 2));
    lose(&mut job, &lost, |job| job.step(0.0));
    let progress = job.progress();
    job.resume_on(pipelines());
    assert_eq!(job.progress(), progress, "finished frames and tiles are kept");
    step_until(&mut job, pipelines(), |job| job.step(0.0), |_| false);
    let resumed = job.finish().expect("all frames").0;
    assert!(resumed == whole, "the frames are others");
}

/// Devices that are lost after so many steps each.
struct Failing {
    lifetimes: std::vec::IntoIter<u32>,
    steps_left: Cell<u32>,
    pipelines: Arc<Pipelines>,
}

impl Failing {
    fn new(lifetimes: &[u32]) -> Self {
        let mut lifetimes = Vec::from(lifetimes).into_iter();
        let steps_left = Cell::new(lifetimes.next().expect("a device"));
        Self { lifetimes, steps_left, pipelines: fresh_pipelines() }
    }
}

impl RunDevice for Failing {
    fn is_lost(&self) -> bool {
        if self.steps_left.get() == 0 {
            self.pipelines.gpu.device.destroy();
            return true;
        }
        self.steps_left.set(self.steps_left.get() - 1);
        false
    }

    fn replace(&mut self) -> Option<Arc<Pipelines>> {
        self.steps_left.set(self.lifetimes.next()?);
        self.pipelines = fresh_pipelines();
        Some(self.pipelines.clone())
    }
}

/// Runs a still on devices that live for so many steps.
fn run_on(lifetimes: &[u32]) -> Result<Vec<u8>, ExportError> {
    let mut device = Failing::new(lifetimes);
    let job = still(&sampled(Scene::default(), 2), PictureFormat::Png, &device.pipelines);
    let file = job.run_on(&mut device, |_| ControlFlow::Continue(()))?;
    assert_eq!(device.lifetimes.len(), 0, "{lifetimes:?}: the job was faster");
    Ok(file)
}

#[test]
fn a_run_goes_on_with_another_device() {
    let whole = run_on(&[u32::MAX]).expect("a file");
    // At the start, amid the tiles, twice.
    for lifetimes in [&[0, u32::MAX][..], &[20, u32::MAX], &[12, 15, u32::MAX]] {
        assert!(run_on(lifetimes).expect("a file") == whole, "{lifetimes:?}: another picture");
    }
}

#[test]
fn a_run_ends_without_another_device_or_if_each_is_lost_at_one_tile() {
    for lifetimes in [&[20][..], &[0, 0, u32::MAX]] {
        let result = run_on(lifetimes);
        assert!(matches!(result, Err(ExportError::Gpu(_))), "{lifetimes:?}");
    }
}
