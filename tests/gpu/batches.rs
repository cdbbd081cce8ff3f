//! Batches of work, parts of a batch, and runs of blocks: their sizes change nothing in a picture.

use std::sync::Arc;

use glam::DVec3;
use mandelight::{
    gpu::{Cpu, readback::Readback},
    render::{
        Pipelines, Region, frame, integrator,
        recorder::{Dispatches, Recorder},
        schedule::{BATCH_WORKGROUPS, Points, Stage, Trace, Work},
        sky::SkyCache,
        space::RenderSpace,
        targets::Targets,
        uniforms::Inputs,
    },
    scene::{IndirectKind, IntegratorKind, PointLight, RigKind, Scene},
};
use mandelight_test_support::device::{fresh_gpu, pipelines};

/// Width and height of the picture: a sample of each pixel fills two and a half batches.
const SIZE: [u32; 2] = [640, 512];
/// The same of a picture in runs of few blocks: not whole workgroups.
const SMALL: [u32; 2] = [51, 37];

/// How a batch is submitted.
#[derive(Clone, Copy, Debug)]
enum Cut {
    /// In so many parts, each with some of the lights.
    Parts(u32),
    /// In runs of so many blocks.
    Runs(u32),
}

const WHOLE: Cut = Cut::Parts(1);

fn film(scene: &Scene, size_px: [u32; 2], from: Option<u32>, cut: Cut) -> (Vec<Vec<u8>>, Vec<u32>) {
    film_by(pipelines(), scene, size_px, from, cut)
}

/// The film after the centre samples and two more of each pixel. The batches are as large as the work from the sample
/// `from` on; they stay as they are without one.
fn film_by(
    pipelines: &Arc<Pipelines>,
    scene: &Scene,
    size_px: [u32; 2],
    from: Option<u32>,
    cut: Cut,
) -> (Vec<Vec<u8>>, Vec<u32>) {
    let gpu = &pipelines.gpu;
    let region = Region::whole(size_px);
    let sky = SkyCache::default().sky_of(scene, None);
    let space = RenderSpace::of(scene, region);
    let inputs = Inputs::about(scene, region, &space).with_sky(scene, &space, sky.as_ref());
    let integrator = integrator::of(&inputs);
    let mut targets = Targets::new(&pipelines.layouts, region);
    (integrator.fit_targets)(&mut targets, &pipelines.layouts, &inputs);
    targets.upload(&gpu.queue, &inputs);
    pipelines.specialize(scene);
    let passes = pipelines.of_frame(&inputs);
    let mut dispatches = Dispatches::default();
    let center = if inputs.traces_paths() { Stage::Path } else { Stage::March };
    let mut sizes = Vec::new();
    for sample in 0..3 {
        let points = match sample {
            0 => Points::Level(0),
            _ => Points::Samples { first: sample, count: 1 },
        };
        let trace = Trace::whole(points, center, u64::MAX, size_px);
        if from.is_some_and(|from| sample >= from)
            && targets.fit_batch(&pipelines.layouts, trace.workgroups())
        {
            (integrator.fit_targets)(&mut targets, &pipelines.layouts, &inputs);
        }
        let batches = Work::Trace(trace).batches(targets.batch_workgroups);
        for part in batches.flat_map(|batch| cut_up(batch, cut)) {
            let mut recorder =
                Recorder::new(&pipelines.layouts, &passes, &targets, &inputs, &mut dispatches);
            frame::record(integrator, &mut recorder, part);
            gpu.queue.submit([recorder.finish()]);
        }
        sizes.push(targets.batch_workgroups);
    }
    let read = |buffer| Readback::buffer(gpu, buffer).wait(gpu).expect("the buffer's bytes");
    let buffers =
        [&targets.film_rg, &targets.film_bw, &targets.center.surface, &targets.paths.moments];
    (buffers.map(read).to_vec(), sizes)
}

fn cut_up(batch: Work, cut: Cut) -> Vec<Work> {
    let Work::Trace(trace) = batch else { panic!("{batch:?} is no trace") };
    let pieces: Vec<Trace> = match cut {
        Cut::Parts(count) => (0..count).map(|index| trace.part(index, count, u64::MAX)).collect(),
        Cut::Runs(blocks) => trace.runs(blocks).collect(),
    };
    pieces.into_iter().map(Work::Trace).collect()
}

fn assert_same(found: &[Vec<u8>], expected: &[Vec<u8>], name: &str) {
    for (buffer, (found, expected)) in found.iter().zip(expected).enumerate() {
        let differing = found.iter().zip(expected).filter(|(a, b)| a != b).count();
        assert_eq!((found.len(), differing), (expected.len(), 0), "{name}, {buffer}");
    }
}

/// Lights of both kinds, one with a soft shadow, all of which cast.
fn with_six_lights() -> Scene {
    let mut scene = Scene::default();
    scene.lights.environment[0].size_deg = 20.0;
    let at = |position| PointLight {
        position: DVec3::from_array(position).into(),
        ..Default::default()
    };
    let missing = 6 - scene.lights.len();
    scene.lights.point.extend((0..missing).map(|index| at([index as f64, -2.0, 1.0])));
    scene
}

#[test]
fn parts_draw_the_same_picture() {
    for indirect in [IndirectKind::Off, IndirectKind::Horizon] {
        let mut scene = with_six_lights();
        scene.indirect.kind = indirect;
        let (expected, _) = film(&scene, SIZE, None, WHOLE);
        for parts in [2, 5] {
            let (found, _) = film(&scene, SIZE, None, Cut::Parts(parts));
            assert_same(&found, &expected, &format!("{parts} parts, {indirect:?}"));
        }
    }
}

fn direct_and_traced() -> [(&'static str, Scene); 2] {
    let mut traced = Scene::default();
    (traced.integrator.kind, traced.integrator.bounces) = (IntegratorKind::Path, 2);
    traced.lights.rig.kind = RigKind::Sky;
    [("direct light", Scene::default()), ("light paths", traced)]
}

/// Runs begin and end within workgroups. On a CPU adapter, few blocks have more workgroups than they fill: with four lanes to a
/// core, a block may have two.
#[test]
fn runs_of_few_blocks_draw_the_same_picture() {
    let of_lanes = |lanes| {
        let mut gpu = fresh_gpu();
        gpu.cpu = Some(Cpu { cores: 2, lanes });
        Pipelines::new(&gpu)
    };
    let all_lanes = [4, 8].map(|lanes| (lanes, of_lanes(lanes)));
    for (name, scene) in direct_and_traced() {
        let (expected, _) = film(&scene, SMALL, None, WHOLE);
        for (lanes, pipelines) in &all_lanes {
            for blocks in [1, 3, 7, 11, 50] {
                let (found, _) = film_by(pipelines, &scene, SMALL, None, Cut::Runs(blocks));
                assert_same(&found, &expected, &format!("{name}, {lanes} lanes, runs of {blocks}"));
            }
        }
    }
}

#[test]
fn larger_batches_draw_the_same_picture() {
    for (name, scene) in direct_and_traced() {
        let (expected, small) = film(&scene, SIZE, None, WHOLE);
        assert_eq!(small, [BATCH_WORKGROUPS; 3], "{name}");
        for from in 0..3 {
            let (found, sizes) = film(&scene, SIZE, Some(from), WHOLE);
            let has_grown = sizes
                .iter()
                .zip(0..)
                .all(|(&size, sample)| (size >= 2 * BATCH_WORKGROUPS) == (sample >= from));
            assert!(has_grown, "{name}: {sizes:?} from {from}");
            assert_same(&found, &expected, &format!("{name} from {from}"));
        }
    }
}

#[test]
fn batches_are_no_larger_than_the_region_and_seldom_change() {
    let layouts = &pipelines().layouts;
    let mut targets = Targets::new(layouts, Region::whole(SIZE));
    assert!(!targets.fit_batch(layouts, BATCH_WORKGROUPS));
    assert!(!targets.fit_batch(layouts, 2 * BATCH_WORKGROUPS - 1));
    assert!(targets.fit_batch(layouts, 2 * BATCH_WORKGROUPS + 1));
    assert_eq!(targets.batch_workgroups, 4 * BATCH_WORKGROUPS);
    assert!(!targets.fit_batch(layouts, 8 * BATCH_WORKGROUPS - 1));
    assert!(targets.fit_batch(layouts, u32::MAX / 2));
    assert!(!targets.fit_batch(layouts, u32::MAX / 2));
    let mut small = Targets::new(layouts, Region::whole([40, 30]));
    let before = small.memory().total();
    assert!(!small.fit_batch(layouts, u32::MAX / 2));
    assert_eq!(small.memory().total(), before);
}
