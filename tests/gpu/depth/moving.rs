//! A dive from the whole scene to 1e-20 in a view that moves.

use std::time::Instant;

use mandelight::{
    formula::{Kernel, mandelbulb::Mandelbulb},
    fractal::{Search, SharedModel},
    render::{
        Pace, Region, View,
        pipeline_set::{NORMALS, RAYS},
        pipelines::PipelineVariant,
        uniforms::Inputs,
    },
    scene::Scene,
};
use mandelight_test_support::{
    compare::{Tolerance, assert_within},
    view::{pipelines, pixels, settle, still},
};

use super::places;

const SIZE: [u32; 2] = [48, 32];
/// Natural logarithm of the approach from frame to frame: half a notch of the wheel.
const NEARER: f64 = 0.1;

/// A view that moved keeps an anchor of another frame, whose orbit rounds otherwise. Measured: 4 pixels
/// of a region, a mean of 5.4, 1.4 % of a picture at 1e-5, where grains are as wide as a pixel.
const OTHER_ANCHOR: Tolerance = Tolerance { pixels: 8, mean: 8.0, part: 0.02 };

/// The scene of a frame of the dive.
fn frame(index: u32) -> Scene {
    let mut scene = places::scene(2.0 * (-NEARER * f64::from(index)).exp());
    scene.quality.samples = 1;
    scene
}

#[test]
fn what_a_dive_shows_is_what_stills_show() {
    let frames = (2e20_f64.ln() / NEARER) as u32;
    let mut view = View::new(pipelines(), Region::whole(SIZE), Pace::Interactive);
    // Frames would wait for pipelines that no other test has had compiled.
    for index in (0..=frames).step_by(3) {
        pipelines().specialize(&frame(index));
    }
    let inputs = Inputs::new(&frame(0), Region::whole(SIZE));
    let kernel = inputs.formula.kernel;
    for variant in kernel.formula.dive_variants(&frame(0).fractal, kernel.variant) {
        let kernel = Kernel { variant, ..kernel };
        for set in [&RAYS, &NORMALS] {
            pipelines().prepare(&PipelineVariant::with_kernel(set, &inputs, kernel));
        }
    }
    let models = SharedModel::default();
    view.share_models(&models);
    view.set_scene(&frame(0), false);
    settle(&mut view);
    let start = Instant::now();
    let (mut late, mut longest, mut anchors) = (0, 0, 0);
    let (mut waited, mut known) = (0, None);
    for index in 1..=frames {
        let scene = frame(index);
        let pictures = view.report().pictures;
        view.set_scene(&scene, true);
        view.pump(start.elapsed().as_secs_f64());
        pipelines().gpu.wait();
        view.pump(start.elapsed().as_secs_f64());
        pipelines().gpu.wait();
        let is_late = view.report().pictures == pictures;
        waited = if is_late { waited + 1 } else { 0 };
        late += u32::from(is_late);
        longest = longest.max(waited);
        let anchor = models.of(&scene.fractal).deep().map(|field| field.origin());
        anchors += u32::from(anchor != known);
        known = anchor;
        if index % 40 != 0 {
            continue;
        }
        // As it moves: samples on a lattice, those of the whole picture.
        settle(&mut view);
        let level = view.report().pixels_per_sample.ilog2();
        let (spacing, is_staggered) = (1 << (level / 2), level % 2 == 1);
        let (shown, whole) = (pixels(&view), still(&scene, SIZE));
        let (mut samples, mut far) = (0, 0);
        for (at, (a, b)) in shown.chunks(4).zip(whole.chunks(4)).enumerate() {
            let [x, y] = [at as u32 % SIZE[0], at as u32 / SIZE[0]];
            let is_on = x % spacing == 0 && y % spacing == 0;
            if is_on && !(is_staggered && (x + y) / spacing % 2 == 1) {
                samples += 1;
                far += usize::from(a.iter().zip(b).any(|(a, b)| a.abs_diff(*b) > 12));
            }
        }
        let scale = scene.camera.view_unit();
        println!("{scale:.1e}: {far} of {samples} samples of the lattice are off");
        assert!(far <= 3 + samples / 50, "{scale:e}: {far} of {samples} samples are off");
        // At rest.
        view.set_scene(&scene, false);
        settle(&mut view);
        assert_within(&pixels(&view), &whole, SIZE, OTHER_ANCHOR, &format!("at rest at {scale:e}"));
    }
    println!("{frames} frames, {late} without a picture, {longest} in a row, {anchors} anchors");
    assert!(anchors > 20, "{anchors} anchors");
    assert!(longest <= 8, "{longest} frames without a picture");
}

/// What a frame's share of a search and of an anchor's upload takes at most, milliseconds.
#[test]
#[ignore = "a tool: prints times, which other programs make longer"]
fn times_of_anchors() {
    let set = |power: f64, iterations: u32, julia: bool| Mandelbulb {
        power,
        iterations,
        julia,
        ..Mandelbulb::default()
    };
    for fractal in
        [set(8.0, 16, false), set(8.0, 16, true), set(3.0, 60, false), set(3.0, 100, false)]
    {
        for scale in [1e-6, 1e-13, 1e-20, 1e-27] {
            let scene = places::at(fractal.clone(), scale);
            let ms = |start: Instant| start.elapsed().as_secs_f64() * 1e3;
            let search = |older: Option<&_>| {
                let mut search =
                    Search::new(&scene.fractal, &scene.camera, 1.5, older).expect("whole");
                let mut pieces = Vec::new();
                loop {
                    let start = Instant::now();
                    let found = search.step();
                    pieces.push(ms(start));
                    if let Some(found) = found {
                        return (pieces, found);
                    }
                }
            };
            let (mut longest, mut all) = (f64::MAX, f64::MAX);
            let (mut again, mut begin) = (f64::MAX, f64::MAX);
            let (mut upload, mut pieces) = (f64::MAX, 0);
            for _ in 0..5 {
                let (times, found) = search(None);
                pieces = times.len();
                longest = longest.min(times.iter().fold(0.0, |a, b| f64::max(a, *b)));
                all = all.min(times.iter().sum());
                again = again.min(search(Some(&found)).0.iter().sum());
                let start = Instant::now();
                drop(Search::new(&scene.fractal, &scene.camera, 1.5, None));
                begin = begin.min(ms(start));
                let space = places::about(found.clone(), &scene);
                let start = Instant::now();
                drop(Inputs::about(&scene, Region::whole([1920, 1080]), &space));
                upload = upload.min(ms(start));
            }
            println!(
                "power {} julia {} at {scale:e}: search {all:.2} ms in {pieces} pieces of up to \
                 {longest:.3}, with an older anchor {again:.2}, begun in {begin:.3}; upload {upload:.3}",
                fractal.power, fractal.julia,
            );
        }
    }
}
