//! Stills in tiles against the same picture in one piece, and stills that come to nothing.

use std::{
    cell::Cell,
    io::{self, Write},
    ops::ControlFlow,
    rc::Rc,
};

use mandelight::{
    export::{ExportError, StillJob, StillOptions, StillStatus},
    render::{Pace, Region, View},
    scene::{Bloom, BloomOrder, Indirect, IndirectKind, Scene, presets},
};
use mandelight_test_support::{
    compare::difference,
    device::pipelines,
    picture::Picture,
    view::{finished, rgb, sampled},
};

fn options(size_px: [u32; 2], samples: u32, tile_px: [u32; 2]) -> StillOptions {
    StillOptions { samples: Some(samples), tile_px, ..StillOptions::new(size_px) }
}

fn still(scene: &Scene, options: StillOptions) -> Vec<u8> {
    let job = StillJob::new(pipelines(), scene, options.clone(), Vec::new()).unwrap();
    let picture = Picture::of(&job.run(|_| ControlFlow::Continue(())).unwrap());
    assert_eq!(picture.size_px, options.size_px);
    picture.bytes
}

/// The picture as a view of the whole shows it.
fn whole_view(scene: &Scene, size_px: [u32; 2], samples: u32) -> Vec<u8> {
    let view = finished(&sampled(scene.clone(), samples), size_px, Pace::Still);
    rgb(&view).into_flattened()
}

fn largest_difference(a: &[u8], b: &[u8]) -> u8 {
    difference(a, b).1
}

fn is_a_picture(rgb: &[u8]) -> bool {
    rgb.chunks_exact(3).collect::<std::collections::HashSet<_>>().len() > 100
}

#[test]
fn tiles_join_without_a_seam() {
    // A size that no tile divides; lights, point lights and traps all at work.
    let size_px = [101, 67];
    for preset in presets::opening_scenes() {
        let scene = (preset.scene)();
        let whole = whole_view(&scene, size_px, 2);
        assert!(is_a_picture(&whole), "{} is empty", preset.name);
        for tile_px in [[32, 24], [101, 67], [101, 13], [51, 67]] {
            let tiled = still(&scene, options(size_px, 2, tile_px));
            assert_eq!(largest_difference(&whole, &tiled), 0, "{} in {tile_px:?}", preset.name);
        }
    }
}

/// Exposure and bloom are those of the whole picture, not of a tile: the same for any tiles, and
/// those of the live view.
#[test]
fn tiles_share_the_exposure_and_the_bloom_of_the_whole() {
    let size_px = [101, 67];
    let mut scene = Scene::default();
    scene.tone.auto_exposure = true;
    for order in [BloomOrder::Before, BloomOrder::After] {
        scene.bloom = Bloom { strength: 0.8, threshold: 0.2, order, ..Bloom::default() };
        let tiled = still(&scene, options(size_px, 8, [32, 24]));
        for tile_px in [[101, 67], [101, 8], [51, 40]] {
            let other = still(&scene, options(size_px, 8, tile_px));
            assert_eq!(largest_difference(&tiled, &other), 0, "{order:?} in {tile_px:?}");
        }
        let whole = whole_view(&scene, size_px, 8);
        assert_eq!(largest_difference(&tiled, &whole), 0, "{order:?}: not as in the live view");
        // That the tiles are small pictures of their own would be seen.
        scene.bloom.strength = 0.0;
        scene.tone.auto_exposure = false;
        let plain = still(&scene, options(size_px, 8, [32, 24]));
        assert!(largest_difference(&tiled, &plain) > 40);
        scene.tone.auto_exposure = true;
    }
}

/// Indirect light reaches over the borders of tiles.
#[test]
fn tiles_take_indirect_light_from_the_whole_picture() {
    let size_px = [101, 67];
    for kind in [IndirectKind::Uniform, IndirectKind::Horizon] {
        let indirect = Indirect { kind, radius: 0.2, ..Indirect::default() };
        let scene = Scene { indirect, ..Scene::default() };
        let whole = whole_view(&scene, size_px, 2);
        for tile_px in [[32, 24], [101, 67], [101, 8]] {
            let tiled = still(&scene, options(size_px, 2, tile_px));
            assert_eq!(largest_difference(&whole, &tiled), 0, "{kind:?} in {tile_px:?}");
        }
        let plain = still(&Scene::default(), options(size_px, 2, [32, 24]));
        assert!(largest_difference(&whole, &plain) > 20);
    }
}

/// Where the overview has fewer samples than the picture, it still sees nearly the same.
#[test]
fn a_large_picture_is_nearly_that_of_the_live_view() {
    let size_px = [600, 420];
    let mut scene = Scene::default();
    scene.fractal.iterations = 5;
    scene.tone.auto_exposure = true;
    scene.bloom = Bloom { strength: 0.4, threshold: 0.5, ..Bloom::default() };
    let tiled = still(&scene, options(size_px, 6, [300, 420]));
    let whole = whole_view(&scene, size_px, 6);
    let difference = largest_difference(&tiled, &whole);
    assert!((1..=3).contains(&difference), "{difference} from the live view");
}

#[test]
fn a_picture_may_be_one_pixel_wide_or_high() {
    for size_px in [[1, 1], [1, 40], [40, 1]] {
        let rgb = still(&Scene::default(), options(size_px, 1, [16, 16]));
        assert_eq!(rgb.len(), (size_px[0] * size_px[1] * 3) as usize);
    }
}

#[test]
fn a_view_that_is_drawn_meanwhile_leaves_a_still_as_it_was() {
    let mut scene = Scene::default();
    scene.tone.auto_exposure = true;
    let start =
        || StillJob::new(pipelines(), &scene, options([101, 67], 2, [32, 24]), Vec::new()).unwrap();
    let whole = start().run(|_| ControlFlow::Continue(())).unwrap();
    let mut job = start();
    let mut view = View::new(pipelines(), Region::whole([64, 48]), Pace::Interactive);
    let others = presets::opening_scenes();
    let mut steps = 0;
    while !matches!(job.step(0.0).unwrap(), StillStatus::Done { .. }) {
        view.set_scene(&(others[steps % others.len()].scene)(), false);
        view.pump(0.0);
        pipelines().gpu.wait();
        steps += 1;
    }
    assert!(steps > 5, "{steps} scenes");
    assert!(job.finish().unwrap() == whole, "another file after {steps} other scenes");
}

#[test]
fn more_samples_are_other_pixels() {
    let [one, many] = [1, 8].map(|n| still(&Scene::default(), options([48, 32], n, [48, 32])));
    assert!(largest_difference(&one, &many) > 0);
}

/// A sink that tells how much it has, and whether it is still held.
#[derive(Clone, Default)]
struct Counter(Rc<Cell<usize>>);

impl Write for Counter {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.set(self.0.get() + bytes.len());
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[test]
fn progress_grows_to_the_end_and_rows_leave_on_the_way() {
    let sink = Counter::default();
    let job = StillJob::new(
        pipelines(),
        &Scene::default(),
        options([500, 400], 1, [250, 20]),
        sink.clone(),
    )
    .unwrap();
    let header_bytes = sink.0.get();
    assert!(header_bytes > 0);

    let mut parts = Vec::new();
    let mut half_way_bytes = 0;
    let mut ended = false;
    job.run(|status| {
        assert!(!ended, "a status after the last");
        match status {
            StillStatus::Working { done, remaining_secs } => {
                assert!((0.0..=1.0).contains(&done));
                assert!(remaining_secs.is_none_or(|secs| secs.is_finite() && secs >= 0.0));
                parts.push(done);
                if done < 0.6 {
                    half_way_bytes = sink.0.get();
                }
            }
            StillStatus::Done { .. } => ended = true,
        }
        ControlFlow::Continue(())
    })
    .unwrap();
    assert!(ended && parts.is_sorted());
    assert!(parts.first() < Some(&0.05) && parts.last() > Some(&0.95), "{parts:?}");
    // A band is 30 kB of rows and a chunk 64 kB, so by then some have been written.
    assert!(half_way_bytes > header_bytes, "nothing was written before the picture was whole");
    assert!(sink.0.get() > half_way_bytes);
}

#[test]
fn a_cancelled_still_lets_go_of_its_sink() {
    let sink = Counter::default();
    let job =
        StillJob::new(pipelines(), &Scene::default(), options([64, 48], 4, [16, 16]), sink.clone())
            .unwrap();
    let result = job.run(|status| match status {
        StillStatus::Working { done, .. } if done < 0.3 => ControlFlow::Continue(()),
        _ => ControlFlow::Break(()),
    });
    assert!(matches!(result, Err(ExportError::Cancelled)));
    assert_eq!(Rc::strong_count(&sink.0), 1);

    // The device is as good as before.
    assert!(is_a_picture(&still(&Scene::default(), options([64, 48], 1, [64, 48]))));
}

/// A disk with room for a header and little more.
struct Full(usize);

impl Write for Full {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if bytes.len() > self.0 {
            return Err(io::ErrorKind::StorageFull.into());
        }
        self.0 -= bytes.len();
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[test]
fn a_full_disk_ends_the_job() {
    let options = options([64, 48], 1, [64, 48]);
    assert!(matches!(
        StillJob::new(pipelines(), &Scene::default(), options.clone(), Full(100)),
        Err(ExportError::Write(_))
    ));
    let job = StillJob::new(pipelines(), &Scene::default(), options, Full(6000)).unwrap();
    assert!(matches!(job.run(|_| ControlFlow::Continue(())), Err(ExportError::Write(_))));
}

#[test]
fn what_is_out_of_range_is_refused_by_name() {
    let refused = |scene: &Scene, options| {
        StillJob::new(pipelines(), scene, options, Vec::new()).err().unwrap().to_string()
    };
    let fine = Scene::default();
    for size_px in [[0, 10], [10, 0], [16_385, 1], [1, u32::MAX]] {
        assert!(refused(&fine, StillOptions::new(size_px)).contains("1 to 16384"));
    }
    for samples in [0, 65_537, u32::MAX] {
        assert!(refused(&fine, options([8, 8], samples, [8, 8])).starts_with("quality.samples: "));
    }
    let mut wild = Scene::default();
    wild.fractal.set("power", f64::NAN);
    assert!(refused(&wild, StillOptions::new([8, 8])).starts_with("fractal.power: "));
}

#[test]
fn an_unfinished_job_does_not_pass_for_a_file() {
    let mut job =
        StillJob::new(pipelines(), &Scene::default(), options([64, 48], 1, [64, 48]), Vec::new())
            .unwrap();
    job.step(0.0).unwrap();
    assert!(matches!(job.finish(), Err(ExportError::Encode(_))));
}
