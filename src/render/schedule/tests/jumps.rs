//! Jumps to views that cost many times what the one before cost.

use super::*;
use crate::gpu::Cpu;
use crate::render::{lattice::BLOCK_THREADS, occupancy::Occupancy};

/// Times of the traces from a jump until the picture rests, milliseconds: the other view's opening costs
/// `of_opening` times as much as before, the rest of it `of_rest` times.
///
/// A movement and a rest come before it, so that openings and pieces are as large as the budget allows.
fn traces(slowness: f64, budget_ms: f64, factors: [f64; 2]) -> Vec<f64> {
    traces_on(Occupancy::default(), slowness, budget_ms, factors)
}

/// [`traces`] on an adapter of `occupancy`.
fn traces_on(
    occupancy: Occupancy,
    slowness: f64,
    budget_ms: f64,
    [of_opening, of_rest]: [f64; 2],
) -> Vec<f64> {
    let mut device = Device::new(slowness, 0.0);
    let mut schedule = schedule_of_lights(Pace::Interactive, SIZE);
    schedule.set_occupancy(occupancy);
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

/// Blocks of the traces up to another view's first picture, in so many lights.
fn opening_blocks(light_count: u32) -> Vec<u32> {
    let lights = u64::MAX >> (u64::BITS - light_count);
    let mut device = Device::new(100.0, 0.0);
    let mut schedule = schedule_of_lights(Pace::Interactive, SIZE);
    schedule.set_lights(lights, lights);
    schedule.aim(4.0, 1);
    let mut now = 0.0;
    settle(&mut schedule, &mut device, &mut now);
    schedule.change(Stale::Geometry, false, now);
    let mut blocks = Vec::new();
    while !schedule.status(now).shown {
        device.collect(&mut schedule, now);
        while let Some(work) = schedule.next(now) {
            if let Work::Trace(trace) = work
                && !schedule.status(now).shown
            {
                assert_eq!(trace.points, Points::Level(COARSEST));
                blocks.push(trace.blocks);
            }
            device.submit(work, now);
        }
        now += FRAME_SECS;
    }
    blocks
}

#[test]
fn another_view_in_many_lights_opens_in_pieces_of_few_rays() {
    let whole = opening_blocks(3);
    assert_eq!(whole.len(), 1, "{whole:?}");
    let divided = opening_blocks(64);
    println!("{divided:?} of {whole:?} blocks");
    assert_eq!(divided.iter().sum::<u32>(), whole[0]);
    // 4096 rays, and what makes them whole workgroups.
    assert!(divided[0] * BLOCK_THREADS * 65 <= 4200, "{divided:?}");
    let mut begun = divided[0];
    for blocks in &divided[1..] {
        assert!(*blocks < 2 * begun, "{divided:?}");
        begun += blocks;
    }
}

/// What shading took in a cheap scene says nothing of an expensive one, however long the rays of both take.
#[test]
fn shading_of_another_view_starts_with_small_pieces() {
    let (mut device, mut now) = (Device::new(100.0, 0.0), 0.0);
    let mut schedule = schedule_of_lights(Pace::Interactive, SIZE);
    schedule.aim(200.0, 1);
    for shade in [1.0, 60.0] {
        device.shade = shade;
        schedule.change(Stale::Geometry, false, now);
        settle(&mut schedule, &mut device, &mut now);
        device.longest_ms = 0.0;
        for _ in 0..3 {
            schedule.change(Stale::Light, false, now);
            settle(&mut schedule, &mut device, &mut now);
        }
        assert!(device.longest_ms < 150.0, "{shade}: {} ms", device.longest_ms);
    }
}

/// While a view refines by general pipelines, special ones are compiled that were used in a much cheaper view.
#[test]
fn pipelines_of_a_cheap_view_are_sized_by_what_the_present_one_costs() {
    let (mut device, mut now) = (Device::new(1.0, 0.0), 0.0);
    let mut schedule = schedule_of_lights(Pace::Interactive, SIZE);
    schedule.aim(200.0, 1);
    schedule.set_arithmetic(Arithmetic::SpecializedPipeline);
    for _ in 0..3 {
        schedule.change(Stale::Geometry, false, now);
        settle(&mut schedule, &mut device, &mut now);
    }
    device.pixel_ns *= 100.0;
    schedule.set_arithmetic(Arithmetic::Real);
    schedule.change(Stale::Geometry, false, now);
    let mut pieces = 0;
    while !schedule.status(now).idle {
        device.collect(&mut schedule, now);
        while let Some(work) = schedule.next(now) {
            if schedule.status(now).shown && matches!(work, Work::Trace(_)) {
                pieces += 1;
                if pieces == 6 {
                    schedule.set_arithmetic(Arithmetic::SpecializedPipeline);
                    device.longest_ms = 0.0;
                }
            }
            device.submit(work, now);
        }
        now += FRAME_SECS;
    }
    println!("{pieces} pieces, the longest {:.0} ms", device.longest_ms);
    assert!(pieces > 6 && device.longest_ms < 2.0 * PIECE_MS, "{} ms", device.longest_ms);
}

/// Where a processor draws the picture, a lattice that was expected to fit the budget does not come at once.
#[test]
fn a_processor_opens_another_view_in_pieces() {
    for slowness in [5.0, 20.0] {
        let [undivided, divided] = [None, Some(Cpu { cores: 2, lanes: 4 })].map(|cpu| {
            let times = traces_on(Occupancy::of(cpu), slowness, 16.0, [20.0; 2]);
            (count_above(&times, 32.0), times.into_iter().fold(0.0, f64::max))
        });
        println!("slowness {slowness}: {undivided:?}, in pieces {divided:?}");
        assert!(divided.0 == 0 && undivided.1 > 100.0, "{undivided:?}, {divided:?}");
    }
}
