//! Jumps to views that cost many times what the one before cost.

use super::*;

/// Times of the traces from a jump until the picture rests, milliseconds: the other view's opening costs
/// `of_opening` times as much as before, the rest of it `of_rest` times.
///
/// A movement and a rest come before it, so that openings and pieces are as large as the budget allows.
fn traces(slowness: f64, budget_ms: f64, [of_opening, of_rest]: [f64; 2]) -> Vec<f64> {
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
    let pixel_ns = device.pixel_ns;
    schedule.change(Stale::Geometry, false, now);
    let mut times = Vec::new();
    while !schedule.status(now).idle {
        device.collect(&mut schedule, now);
        loop {
            device.pixel_ns =
                pixel_ns * if schedule.status(now).shown { of_rest } else { of_opening };
            let Some(work) = schedule.next(now) else { break };
            device.submit(work, now);
            if matches!(work, Work::Trace(_)) {
                times.extend(device.queue.last().map(|(.., ms)| *ms));
            }
        }
        now += FRAME_SECS;
    }
    times
}

fn count_above(times: &[f64], limit_ms: f64) -> usize {
    times.iter().filter(|&&ms| ms > limit_ms).count()
}

/// The opening of the other view may be long, but no piece after it.
#[test]
fn only_the_opening_of_an_expensive_view_is_long() {
    let long = [5.0, 20.0, 100.0].map(|factor| count_above(&traces(1.0, 16.0, [factor; 2]), 32.0));
    println!("pieces above two budgets: {long:?}");
    assert!(long.iter().all(|&long| long <= 1), "{long:?}");
}

/// What fills a large budget in a cheap view would hold up the page in an expensive one.
#[test]
fn a_jump_does_not_spend_a_large_budget() {
    assert_eq!(count_above(&traces(5.0, 200.0, [10.0; 2]), 250.0), 0);
}

/// An opening may miss all that is expensive: the pieces in flight after it are long, and few others.
#[test]
fn an_opening_that_misses_what_is_expensive_makes_few_pieces_long() {
    for factor in [5.0, 20.0, 100.0] {
        let times = traces(1.0, 16.0, [1.0, factor]);
        let long = count_above(&times, 32.0);
        let longest = times.iter().copied().fold(0.0, f64::max);
        println!("{factor}: longest {longest:.0} ms, {long} of {}", times.len());
        assert!(long <= 10 && longest <= 8.5 * factor, "{long} of {}, {longest} ms", times.len());
    }
}
