//! Light paths: their cost depends on the view more than that of rays.

use super::*;

/// A schedule of a picture of 64 paths a pixel.
fn schedule_of_paths() -> Schedule {
    let mut schedule = Schedule::new(PATH.plan, Pace::Interactive, SIZE);
    schedule.set_lights(LIGHTS, LIGHTS);
    schedule.aim(16.0, 64);
    schedule
}

/// From the background into a crevice, paths get a hundred times as long: no piece takes a hundred times its time.
#[test]
fn paths_of_another_view_start_with_small_pieces() {
    let (mut device, mut now) = (Device::new(1.0, 0.0), 0.0);
    let mut schedule = schedule_of_paths();
    for path in [0.5, 50.0] {
        (device.path, device.longest_ms) = (path, 0.0);
        schedule.change(Stale::Geometry, false, now);
        settle(&mut schedule, &mut device, &mut now);
        assert_eq!(schedule.status(now).samples_done, 64);
        let budget_ms = 16.0;
        assert!(device.longest_ms < 2.0 * budget_ms, "{path}: {} ms", device.longest_ms);
    }
}

/// The last pieces of a picture end after the next one has begun, and say nothing of it.
#[test]
fn paths_in_flight_say_nothing_of_another_view() {
    let (mut device, mut now) = (Device::new(1.0, 0.0), 0.0);
    let mut schedule = schedule_of_paths();
    device.path = 0.5;
    let are_paths = |(work, ..): &(Work, f64, f64)| match work {
        Work::Trace(trace) => trace.from == Stage::Path && trace.samples() > 10_000,
        Work::Display(_) => false,
    };
    while !device.queue.iter().any(are_paths) {
        now += FRAME_SECS;
        device.collect(&mut schedule, now);
        while let Some(work) = schedule.next(now) {
            device.submit(work, now);
        }
    }
    (device.path, device.longest_ms) = (50.0, 0.0);
    schedule.change(Stale::Geometry, false, now);
    settle(&mut schedule, &mut device, &mut now);
    assert!(device.longest_ms < 32.0, "{} ms", device.longest_ms);
}

/// Of paths nothing is known at first but what rays take, and many bounces make a path take as long as hundreds of them.
#[test]
fn the_first_piece_of_paths_has_few() {
    let (mut device, mut now) = (Device::new(1.0, 0.0), 0.0);
    let mut schedule = schedule_of_paths();
    schedule.change(Stale::Geometry, false, now);
    let works = works_until_rest(&mut schedule, &mut device, &mut now);
    let first = works.iter().find_map(|work| match work {
        Work::Trace(trace) if trace.from == Stage::Path => Some(trace.samples()),
        _ => None,
    });
    assert!((128..=704).contains(&first.expect("paths")), "{first:?}");
}
