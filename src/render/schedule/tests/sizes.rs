//! Another size: what is kept of the picture before it.

use std::collections::BTreeMap;

use super::*;
use crate::render::lattice::{BLOCK_THREADS, WORKGROUP_BLOCKS};

const NARROW: [u32; 2] = [960, 720];

/// What the narrow picture is of the wide one.
const OVERLAP: Overlap = Overlap { first: [160, 0], first_in_old: [0, 0], size_px: [960, 720] };

/// Runs to the end, each sample in 200 ns; returns the traces.
fn finish(schedule: &mut Schedule) -> Vec<Trace> {
    let (mut traces, mut now) = (Vec::new(), 0.0);
    while let Some(work) = schedule.next(now) {
        let ms = match work {
            Work::Trace(trace) => {
                traces.push(trace);
                f64::from(trace.samples()) * 2e-4
            }
            Work::Display(_) => 0.1,
        };
        schedule.collect(&[(Some(work), ms)]);
        now += ms * 1e-3;
    }
    assert!(schedule.status(now).idle);
    traces
}

/// Runs one piece of work.
fn first_piece(schedule: &mut Schedule) -> Work {
    let work = schedule.next(0.0).expect("work");
    schedule.collect(&[(Some(work), 1.0)]);
    work
}

fn finished_narrow(samples: u32) -> Schedule {
    let mut schedule = schedule_of_lights(Pace::Interactive, NARROW);
    schedule.aim(16.0, samples);
    finish(&mut schedule);
    schedule
}

#[test]
fn kept_pixels_wait_for_the_samples_of_the_others() {
    let mut schedule = finished_narrow(20);
    assert_eq!(schedule.resize(SIZE, Some(OVERLAP), 0), Reuse::Samples);
    schedule.aim(16.0, 45);
    let traces = finish(&mut schedule);
    let [mut computed, mut rounds] = [0.0; 2];
    for trace in &traces {
        let Points::Samples { first, count } = trace.points else {
            assert_eq!((trace.kept.first, trace.kept.end), ([160, 0], [1120, 720]));
            continue;
        };
        assert!(first >= 20 || first + count <= 20, "{first} to {} crosses", first + count);
        assert_eq!(trace.kept.share, if first < 20 { 0.75 } else { 0.0 });
        let part = f64::from(trace.blocks) / f64::from(trace.points.grid(SIZE).blocks());
        rounds += part * f64::from(count);
        computed += part * f64::from(count) * f64::from(1.0 - trace.kept.share);
    }
    assert!((rounds - 44.0).abs() < 1e-6 && (computed - (0.25 * 19.0 + 25.0)).abs() < 1e-6);
    assert_eq!(schedule.status(0.0).samples_done, 45);
}

#[test]
fn a_part_of_a_finished_picture_is_only_displayed() {
    let mut schedule = schedule_of_lights(Pace::Interactive, SIZE);
    schedule.aim(16.0, 3);
    finish(&mut schedule);
    let overlap = Overlap { first: [0, 0], first_in_old: [160, 0], size_px: NARROW };
    assert_eq!(schedule.resize(NARROW, Some(overlap), 0), Reuse::Film);
    assert!(matches!(first_piece(&mut schedule), Work::Display(Display { level: 0, .. })));
    assert!(finish(&mut schedule).is_empty());
    assert_eq!(schedule.status(0.0).samples_done, 3);
}

#[test]
fn centre_samples_stay_amid_a_round_of_samples() {
    let mut schedule = finished_narrow(3);
    schedule.aim(16.0, 9);
    assert!(matches!(first_piece(&mut schedule), Work::Trace(_)));
    assert!(!schedule.is_between_samples());
    assert_eq!(schedule.resize(SIZE, Some(OVERLAP), 0), Reuse::Samples);
    let traces = finish(&mut schedule);
    let (samples, centres): (Vec<&Trace>, Vec<&Trace>) =
        traces.iter().partition(|trace| matches!(trace.points, Points::Samples { .. }));
    let (kept, all): (Vec<&Trace>, Vec<&Trace>) =
        centres.into_iter().partition(|trace| trace.kept.share > 0.0);
    assert!(kept.iter().all(|trace| trace.from == Stage::March) && !kept.is_empty());
    assert!(all.iter().all(|trace| trace.from == Stage::Shade) && !all.is_empty());
    assert!(samples.iter().all(|trace| trace.kept.share == 0.0));
    assert_eq!(schedule.status(0.0).samples_done, 9);
}

/// What a lattice has of a light stays with the lattice, which a part of the picture does not share.
#[test]
fn a_part_of_a_picture_keeps_no_light_of_a_lattice() {
    let overlap = Overlap { first: [0, 0], first_in_old: [160, 0], size_px: NARROW };
    for is_shining in [true, false] {
        let mut schedule = schedule_of_lights(Pace::Interactive, SIZE);
        schedule.aim(2.0, 1);
        finish(&mut schedule);
        schedule.set_lights(LIGHTS, 0b010);
        schedule.change(Stale::Light, false, 10.0);
        let Work::Trace(opening) = first_piece(&mut schedule) else { panic!("no opening") };
        assert!(opening.points.level() > 0 && opening.lights == 0b010, "{opening:?}");
        if !is_shining {
            schedule.set_lights(LIGHTS & !0b010, 0);
        }
        assert_ne!(schedule.resize(NARROW, Some(overlap), 0), Reuse::Nothing);
        schedule.set_lights(LIGHTS, 0);
        schedule.change(Stale::Light, false, 11.0);
        let Work::Trace(next) = first_piece(&mut schedule) else { panic!("no opening") };
        assert_eq!((next.from, next.lights & 0b010), (Stage::Shadow, 0b010));
    }
}

/// Centre samples under light paths hold guides of the denoiser in place of visibility.
#[test]
fn another_width_finds_no_visibility_under_paths() {
    let mut schedule = Schedule::new(PATH.plan, Pace::Interactive, NARROW);
    schedule.set_lights(LIGHTS, LIGHTS);
    schedule.aim(16.0, 9);
    finish(&mut schedule);
    assert_eq!(schedule.resize(SIZE, Some(OVERLAP), 0), Reuse::Samples);
    // The centre samples of the borders, and then a wider picture once more.
    while schedule.center_level() != Some(0) {
        first_piece(&mut schedule);
    }
    let wider = Overlap { first: [100, 0], first_in_old: [0, 0], size_px: SIZE };
    assert_eq!(schedule.resize([1480, 720], Some(wider), 0), Reuse::Samples);
    let traces = finish(&mut schedule);
    let relit =
        traces.iter().find(|trace| trace.points == Points::Level(0) && trace.kept.share == 0.0);
    assert_eq!(relit.map(|trace| (trace.from, trace.lights)), Some((Stage::Shadow, LIGHTS)));
}

#[test]
fn an_edit_ends_what_is_kept() {
    let mut schedule = finished_narrow(9);
    schedule.resize(SIZE, Some(OVERLAP), 0);
    schedule.change(Stale::Geometry, false, 0.0);
    assert!(finish(&mut schedule).iter().all(|trace| trace.kept.share == 0.0));
    // Nothing is there of a picture whose rays are under way.
    let mut schedule = schedule_of_lights(Pace::Interactive, NARROW);
    schedule.next(0.0);
    assert_eq!(schedule.resize(SIZE, Some(OVERLAP), 0), Reuse::Nothing);
}

/// Fewer samples than kept pixels have: they can't be reduced.
#[test]
fn fewer_samples_end_what_is_kept() {
    let mut schedule = finished_narrow(9);
    schedule.resize(SIZE, Some(OVERLAP), 0);
    schedule.aim(16.0, 4);
    assert!(finish(&mut schedule).iter().all(|trace| trace.kept.share == 0.0));
    assert_eq!(schedule.status(0.0).samples_done, 4);
}

/// The pixels that stay cost nothing, and must not make the next ones look cheap.
#[test]
fn pieces_stay_short_after_a_size_that_keeps_pixels() {
    let mut schedule = finished_narrow(20);
    schedule.resize(SIZE, Some(OVERLAP), 0);
    schedule.aim(16.0, 60);
    let mut columns_of = BTreeMap::new();
    let (mut now, mut longest_ms) = (0.0, 0.0_f64);
    while let Some(work) = schedule.next(now) {
        let mut ms = 0.1;
        if let Work::Trace(Trace { points, first_block, blocks, kept, .. }) = work {
            let grid = points.grid(SIZE);
            let column = |block| grid.pixel(block / WORKGROUP_BLOCKS, [0, 0])[0];
            let columns = *columns_of
                .entry(grid.blocks())
                .or_insert_with(|| 8 + (0..grid.blocks()).map(column).max().expect("a block"));
            // Part of the way across the picture.
            let kept = kept.first[0] * columns..kept.end[0] * columns;
            let computed = (first_block..first_block + blocks)
                .filter(|&block| !kept.contains(&(column(block) * SIZE[0])))
                .count();
            ms = f64::from(BLOCK_THREADS) * computed as f64 * 2e-4;
            if matches!(points, Points::Samples { .. }) {
                longest_ms = longest_ms.max(ms);
            }
        }
        schedule.collect(&[(Some(work), ms)]);
        now += ms * 1e-3;
    }
    assert!((4.0..=1.3 * PIECE_MS).contains(&longest_ms), "{longest_ms} ms");
}

/// Light from neighbours is another near a border that moves.
#[test]
fn light_from_neighbours_is_kept_away_from_moved_borders() {
    let mut schedule = finished_narrow(9);
    assert_eq!(schedule.resize(SIZE, Some(OVERLAP), 40), Reuse::Samples);
    let traces = finish(&mut schedule);
    assert!(
        traces.iter().all(|trace| trace.kept.first == [200, 0] && trace.kept.end == [1080, 720])
    );
    // Back again: the narrow picture's own borders are others than in the wide one.
    let overlap = Overlap { first: [0, 0], first_in_old: [160, 0], size_px: NARROW };
    assert_eq!(schedule.resize(NARROW, Some(overlap), 40), Reuse::Samples);
    let traces = finish(&mut schedule);
    assert!(traces.iter().all(|trace| trace.kept.first == [40, 0] && trace.kept.end == [920, 720]));
    // Little would be left.
    assert_eq!(schedule.resize(SIZE, Some(OVERLAP), 300), Reuse::Samples);
    assert!(finish(&mut schedule)[0].kept.first == OVERLAP.first);
}
