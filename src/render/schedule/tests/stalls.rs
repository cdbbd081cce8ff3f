//! What holds pieces up that is none of their own: work that is done once, and the interface.

use super::*;

/// Seconds until a picture is complete, on a device that takes so much longer for one piece, and the
/// lattice level of the fifth picture of a movement that follows.
fn with_one_held_up(slowness: f64, which: u32, held_up_ms: f64) -> (f64, u32) {
    let mut device = Device::new(slowness, 0.0);
    let mut schedule = schedule_of_lights(Pace::Interactive, SIZE);
    schedule.aim(16.0, 1);
    let mut now = 0.0;
    while !schedule.status(now).idle {
        device.collect(&mut schedule, now);
        while let Some(work) = schedule.next(now) {
            device.overhead_ms = if device.submits == which { held_up_ms } else { 0.05 };
            device.submit(work, now);
        }
        now += FRAME_SECS;
    }
    let (complete_secs, mut pictures) = (now, 0);
    run(&mut schedule, &mut device, &mut now, 1000, |s, now, shows| {
        pictures += shows;
        if pictures < 5 && s.accepts_changes() {
            s.change(Stale::Geometry, true, now);
        }
        pictures == 5
    });
    (complete_secs, schedule.status(now).shown_level)
}

/// Drivers may leave for a pipeline's first use what takes them many seconds.
#[test]
fn a_first_piece_that_was_held_up_says_nothing_of_others() {
    for slowness in [1.0, 20.0] {
        let (usual_secs, usual_level) = with_one_held_up(slowness, 0, 0.05);
        // Two of an opening, a display, the first of what refines.
        for (which, held_up_ms) in (0..4).flat_map(|k| [(k, 500.0), (k, 20_000.0)]) {
            let (secs, level) = with_one_held_up(slowness, which, held_up_ms);
            let secs = secs - 1e-3 * held_up_ms;
            assert!(secs < 1.5 * usual_secs + 0.5, "{secs} s instead of {usual_secs} s");
            assert!(level <= usual_level + 2, "level {level} instead of {usual_level}");
        }
    }
}

/// Displays, and seconds, until a picture of many samples is complete.
fn displays(interface_ms: f64) -> (usize, f64) {
    let mut device = Device::new(20.0, 0.0);
    let mut schedule = schedule_of_lights(Pace::Interactive, SIZE);
    schedule.aim(16.0, 64);
    let (mut now, mut displays) = (0.0, 0);
    run(&mut schedule, &mut device, &mut now, 400_000, |s, now, shows| {
        displays += shows;
        s.collect(&[(None, interface_ms)]);
        s.status(now).idle
    });
    (displays, now)
}

/// Each display has the interface drawn once more. On a software GPU that takes a third of a second.
#[test]
fn a_dear_interface_is_not_drawn_often() {
    let (often, secs) = displays(2.0);
    assert!(often as f64 > 0.8 * secs, "{often} displays in {secs} s");
    let (seldom, secs) = displays(150.0);
    assert!((seldom as f64) < secs / 1.5 + 4.0, "{seldom} displays in {secs} s");
}

#[test]
fn what_held_the_interface_up_does_not_hold_displays_up() {
    let mut schedule = schedule_of_lights(Pace::Interactive, SIZE);
    for _ in 0..20 {
        schedule.collect(&[(None, 60_000.0)]);
    }
    assert!(schedule.frame_interval_secs() <= 2.0);
}

/// Some browsers run two pieces as one: the end of the first is told with that of the second. Pieces
/// of any size seem to take the same time then, and yet they must not grow on that account.
#[test]
fn pieces_whose_ends_are_told_together_stay_short() {
    for (slowness, overhead_ms) in [(20.0, 0.05), (200.0, 0.05), (20.0, 5.0), (20.0, 300.0)] {
        let mut device = Device::with_overhead(slowness, 0.0, overhead_ms);
        let mut schedule = schedule_of_lights(Pace::Interactive, SIZE);
        schedule.aim(16.0, 4);
        let mut now = 0.0;
        let mut longest_ms = 0.0_f64;
        while !schedule.status(now).idle {
            while let Some(work) = schedule.next(now) {
                device.submit(work, now);
            }
            now = device.busy_until.max(now + 1e-3);
            let mut ms: f64 = device.queue.iter().map(|(_, _, ms)| ms).sum();
            let ended: Vec<_> = device.queue.drain(..).map(|(work, ..)| Some(work)).collect();
            let pieces = ended.iter().all(|work| matches!(work, Some(Work::Trace(_))));
            longest_ms = longest_ms.max(if pieces { ms } else { 0.0 });
            let told = |work| (work, std::mem::take(&mut ms));
            schedule.collect(&ended.into_iter().map(told).collect::<Vec<_>>());
        }
        let bound = 2.0 * (1.5 * SLICE_MS).min(16.0) + 2.0 * overhead_ms;
        assert!(longest_ms < bound, "slowness {slowness}: {longest_ms} ms");
        // Nor do they stay so short that what each takes by itself is all of the time.
        assert!(device.submits < 6000, "slowness {slowness}: {} pieces", device.submits);
        assert!(now < 40.0, "slowness {slowness}: {now} s");
    }
}
