//! Another size: what is kept of the picture before it.

use super::*;

const NARROW: [u32; 2] = [960, 720];

/// What the narrow picture is of the wide one.
const OVERLAP: Overlap = Overlap { first: [160, 0], first_in_other: [0, 0], size_px: [960, 720] };

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
    assert!(schedule.resize(SIZE, Some(OVERLAP), Some(0)));
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
        let part = f64::from(trace.workgroups) / f64::from(trace.points.grid(SIZE).workgroups());
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
    let overlap = Overlap { first: [0, 0], first_in_other: [160, 0], size_px: NARROW };
    assert!(schedule.resize(NARROW, Some(overlap), Some(0)));
    assert!(matches!(first_piece(&mut schedule), Work::Display(Display { level: 0, .. })));
    assert!(finish(&mut schedule).is_empty());
    assert_eq!(schedule.status(0.0).samples_done, 3);
}

#[test]
fn centre_samples_stay_where_the_film_does_not() {
    // The light is another, or samples are under way.
    for is_under_way in [false, true] {
        let mut schedule = finished_narrow(3);
        if is_under_way {
            schedule.aim(16.0, 9);
            assert!(matches!(first_piece(&mut schedule), Work::Trace(_)));
            assert!(!schedule.is_between_samples());
        }
        assert!(schedule.resize(SIZE, Some(OVERLAP), is_under_way.then_some(0)));
        let traces = finish(&mut schedule);
        let is_centre = |trace: &&Trace| !matches!(trace.points, Points::Samples { .. });
        let (kept, all): (Vec<&Trace>, Vec<&Trace>) =
            traces.iter().filter(is_centre).partition(|trace| trace.kept.share > 0.0);
        assert!(kept.iter().all(|trace| trace.from == Stage::March) && !kept.is_empty());
        assert!(all.iter().all(|trace| trace.from == Stage::Shade) && !all.is_empty());
        assert!(
            traces.iter().filter(|trace| !is_centre(trace)).all(|trace| trace.kept.share == 0.0)
        );
    }
}

#[test]
fn an_edit_ends_what_is_kept() {
    let mut schedule = finished_narrow(9);
    schedule.resize(SIZE, Some(OVERLAP), Some(0));
    schedule.change(Stale::Geometry, false, 0.0);
    assert!(finish(&mut schedule).iter().all(|trace| trace.kept.share == 0.0));
    // Nothing is there of a picture whose rays are under way.
    let mut schedule = schedule_of_lights(Pace::Interactive, NARROW);
    schedule.next(0.0);
    assert!(!schedule.resize(SIZE, Some(OVERLAP), Some(0)));
}

/// Fewer samples than kept pixels have: they can't be reduced.
#[test]
fn fewer_samples_end_what_is_kept() {
    let mut schedule = finished_narrow(9);
    schedule.resize(SIZE, Some(OVERLAP), Some(0));
    schedule.aim(16.0, 4);
    assert!(finish(&mut schedule).iter().all(|trace| trace.kept.share == 0.0));
    assert_eq!(schedule.status(0.0).samples_done, 4);
}

/// The pixels that stay cost nothing, and must not make the next ones look cheap.
#[test]
fn pieces_stay_short_after_a_size_that_keeps_pixels() {
    let mut schedule = finished_narrow(20);
    schedule.resize(SIZE, Some(OVERLAP), Some(0));
    schedule.aim(16.0, 60);
    let longest = finish(&mut schedule)
        .iter()
        .filter(|trace| matches!(trace.points, Points::Samples { .. }))
        .map(|trace| f64::from(trace.samples()) * 2e-4)
        .fold(0.0, f64::max);
    assert!((4.0..=1.2 * PIECE_MS).contains(&longest), "{longest} ms");
}

/// Light from neighbours is another near a border that moves.
#[test]
fn light_from_neighbours_is_kept_away_from_moved_borders() {
    let mut schedule = finished_narrow(9);
    assert!(schedule.resize(SIZE, Some(OVERLAP), Some(40)));
    let traces = finish(&mut schedule);
    assert!(
        traces.iter().all(|trace| trace.kept.first == [200, 0] && trace.kept.end == [1080, 720])
    );
    // Back again: the narrow picture's own borders are others than in the wide one.
    let overlap = Overlap { first: [0, 0], first_in_other: [160, 0], size_px: NARROW };
    assert!(schedule.resize(NARROW, Some(overlap), Some(40)));
    let traces = finish(&mut schedule);
    assert!(traces.iter().all(|trace| trace.kept.first == [40, 0] && trace.kept.end == [920, 720]));
    // Little would be left.
    assert!(schedule.resize(SIZE, Some(OVERLAP), Some(300)));
    assert!(finish(&mut schedule)[0].kept.first == OVERLAP.first);
}
