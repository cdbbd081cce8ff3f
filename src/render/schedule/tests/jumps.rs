//! Jumps to views that cost many times what the one before cost.

use super::*;

/// Traces that take more than `limit_ms`, from a jump to a view of `factor` times the cost until it rests.
///
/// A movement and a rest come before it, so that openings and pieces are as large as the budget allows.
fn long_traces(slowness: f64, budget_ms: f64, factor: f64, limit_ms: f64) -> usize {
    let mut device = Device::new(slowness, 0.0);
    let mut schedule = schedule_of_lights(Pace::Interactive, SIZE);
    schedule.aim(budget_ms, 64);
    let mut now = 0.0;
    let mut pictures = 0;
    run(&mut schedule, &mut device, &mut now, 4000, |s, now, new| {
        pictures += new;
        if s.accepts_changes() {
            s.change(Stale::Geometry, true, now);
        }
        pictures >= 12
    });
    settle(&mut schedule, &mut device, &mut now);
    device.pixel_ns *= factor;
    schedule.change(Stale::Geometry, false, now);
    let mut long = 0;
    while !schedule.status(now).idle {
        device.collect(&mut schedule, now);
        while let Some(work) = schedule.next(now) {
            device.submit(work, now);
            let is_long = device.queue.last().is_some_and(|(.., ms)| *ms > limit_ms);
            long += usize::from(is_long && matches!(work, Work::Trace(_)));
        }
        now += FRAME_SECS;
    }
    long
}

/// The opening of the other view may be long, but no piece after it.
#[test]
fn only_the_opening_of_a_dearer_view_is_long() {
    let long = [5.0, 20.0, 100.0].map(|factor| long_traces(1.0, 16.0, factor, 32.0));
    println!("pieces above two budgets: {long:?}");
    assert!(long.iter().all(|&long| long <= 1), "{long:?}");
}

/// What fills a large budget in a cheap view would hold up the page in an expensive one.
#[test]
fn a_jump_does_not_spend_a_large_budget() {
    assert_eq!(long_traces(5.0, 200.0, 10.0, 250.0), 0);
}
