//! Displays in parts: which there are, and what a change between two parts leaves.

use mandelight::{
    render::{
        Pace, Region, View,
        display_parts::{DisplayPart, PartRange, Rows},
        pass::denoise,
        view::PieceTime,
    },
    scene::{Bloom, IntegratorKind, Scene},
};
use mandelight_test_support::{
    compare::assert_same,
    patience::HANG,
    view::{finished, pipelines, pixels, sampled, settle},
};

const SIZE: [u32; 2] = [64, 48];

/// Tone mapping, undivided.
const TONE: DisplayPart = DisplayPart::Tone(Rows::ALL);

fn blooming() -> Scene {
    let mut scene = sampled(Scene::default(), 2);
    scene.bloom = Bloom { strength: 0.5, threshold: 0.0, ..Bloom::default() };
    scene
}

fn denoised(mut scene: Scene) -> Scene {
    scene.integrator.kind = IntegratorKind::Path;
    scene.integrator.denoise = true;
    scene
}

/// The parts of displays among pieces that have finished.
fn parts(pieces: &[PieceTime]) -> Vec<PartRange> {
    pieces.iter().filter_map(|piece| piece.parts).collect()
}

/// The first display of a view has one part after the other, since nothing is known of their times.
#[test]
fn a_first_display_is_submitted_part_by_part() {
    let denoiser = denoise::parts([Rows::ALL].into_iter());
    let of_denoised = [DisplayPart::Bloom].into_iter().chain(denoiser);
    let cases = [
        (sampled(Scene::default(), 2), Vec::new()),
        (blooming(), vec![DisplayPart::Bloom]),
        (denoised(blooming()), of_denoised.collect()),
    ];
    for (scene, before_tone) in cases {
        let mut view = View::new(pipelines(), Region::whole(SIZE), Pace::Still);
        view.watch_piece_times(true);
        view.set_scene(&scene, false);
        settle(&mut view);
        let expected: Vec<_> = before_tone.into_iter().chain([TONE]).map(PartRange::only).collect();
        assert_eq!(parts(&view.take_piece_times()), expected);
        assert_eq!(view.report().pictures, 1);
    }
}

/// Where a finer picture replaces a coarser one row by row, it is the same in the end.
#[test]
fn a_picture_that_was_refined_in_rows_is_that_of_one_submit() {
    let size = [320, 640];
    let scene = sampled(Scene::default(), 2);
    let mut view = View::new(pipelines(), Region::whole(size), Pace::Interactive);
    view.watch_piece_times(true);
    view.set_scene(&scene, false);
    settle(&mut view);
    let parts = parts(&view.take_piece_times());
    let is_divided = parts.iter().any(|range| range.rows_of(DisplayPart::Tone).start > 0);
    assert_eq!(is_divided, pipelines().gpu.cpu.is_some(), "{parts:?}");
    let still = finished(&scene, size, Pace::Still);
    assert_same(&pixels(&view), &pixels(&still), size, "in rows");
}

/// A view whose display has parts that are not submitted yet.
fn amid_a_display(scene: &Scene) -> View {
    let mut view = View::new(pipelines(), Region::whole(SIZE), Pace::Interactive);
    view.set_scene(scene, false);
    let (start, mut now_secs) = (std::time::Instant::now(), 0.0);
    loop {
        assert!(start.elapsed() < HANG, "no display has parts: {:?}", view.report());
        now_secs += 1e-4;
        view.pump(now_secs);
        pipelines().gpu.wait();
        if view.is_amid_display() {
            return view;
        }
    }
}

#[test]
fn what_changes_amid_a_display_is_as_in_a_new_view() {
    // The first display with parts is with bloom in one of them, and with the denoiser in the other.
    for scene in [blooming(), denoised(sampled(Scene::default(), 4))] {
        let mut brighter = scene.clone();
        brighter.tone.exposure += 1.0;
        let mut moved = scene.clone();
        moved.camera.vertical_fov_deg *= 0.8;
        for changed in [&scene, &brighter, &moved] {
            let mut view = amid_a_display(&scene);
            view.set_scene(changed, false);
            settle(&mut view);
            let expected = pixels(&finished(changed, SIZE, Pace::Interactive));
            assert_same(&pixels(&view), &expected, SIZE, "a change");
        }
    }
    // Light paths of pixels that a resized view keeps are not those of a new view.
    let scene = blooming();
    let larger = [80, 48];
    let mut view = amid_a_display(&scene);
    view.set_region(Region::whole(larger));
    settle(&mut view);
    let expected = pixels(&finished(&scene, larger, Pace::Interactive));
    assert_same(&pixels(&view), &expected, larger, "another size");
}

/// Nobody waits for the denoiser whose change is to be shown: it is left out, and runs again after the change.
#[test]
fn a_change_amid_a_denoised_display_leaves_the_denoiser_out() {
    let scene = denoised(sampled(Scene::default(), 4));
    let rows_of_stage =
        |range: &PartRange, stage| range.rows_of(|rows| DisplayPart::Denoise(stage, rows));
    let mut view = amid_a_display(&scene);
    view.watch_piece_times(true);
    let mut brighter = scene.clone();
    brighter.tone.exposure += 1.0;
    view.set_scene(&brighter, false);
    settle(&mut view);
    let parts = parts(&view.take_piece_times());
    // The part in flight at the change.
    assert!(rows_of_stage(&parts[0], 0).end > 0, "{parts:?}");
    assert_eq!(parts[1], PartRange::only(TONE));
    assert!(parts[2..].iter().any(|range| rows_of_stage(range, 5).end > 0), "{parts:?}");
}

/// The statistics of a display that began before a histogram was wanted have none.
#[test]
fn a_histogram_that_is_wanted_amid_a_display_is_of_the_film() {
    let scene = blooming();
    let mut view = amid_a_display(&scene);
    view.watch_histogram(true);
    assert!(view.report().histogram.is_none());
    let mut fresh = View::new(pipelines(), Region::whole(SIZE), Pace::Interactive);
    fresh.watch_histogram(true);
    fresh.set_scene(&scene, false);
    settle(&mut fresh);
    let bins = |view: &View| view.report().histogram.map(|histogram| histogram.bins);
    let start = std::time::Instant::now();
    while view.pump(start.elapsed().as_secs_f64()) {
        pipelines().gpu.wait();
        assert!(start.elapsed() < HANG, "the view never rests: {:?}", view.report());
        if let Some(found) = bins(&view) {
            assert_eq!(found.iter().sum::<u32>(), SIZE[0] * SIZE[1]);
        }
    }
    assert_eq!(bins(&view), bins(&fresh));
}
