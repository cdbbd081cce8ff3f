//! Movements that begin while a picture refines, and releases that end them.

use super::*;
use crate::render::schedule::point_selection::PREVIEW_LEVEL;

const BUDGET_MS: f64 = 16.0;

/// A schedule and a device after two seconds of refinement. A full frame takes twenty budgets.
fn at_rest(sparser: f64) -> (Schedule, Device, f64) {
    let mut device = Device::new(20.0 * BUDGET_MS / 18.4, 0.0);
    device.sparser = sparser;
    let mut schedule = schedule_of_lights(Pace::Interactive, SIZE);
    schedule.aim(BUDGET_MS, 16);
    let mut now = 0.0;
    refine(&mut schedule, &mut device, &mut now, 2.0);
    (schedule, device, now)
}

/// Refines for so many seconds, pumping as often as the page does.
fn refine(schedule: &mut Schedule, device: &mut Device, now: &mut f64, secs: f64) {
    let end = *now + secs;
    while *now < end {
        device.collect(schedule, *now);
        while let Some(work) = schedule.next(*now) {
            device.submit(work, *now);
        }
        *now += 0.004;
    }
}

/// Time from a change to the end of its picture, in budgets.
fn picture_of_a_move(schedule: &mut Schedule, device: &mut Device, now: &mut f64) -> f64 {
    let moved_at = *now;
    schedule.change(Stale::Geometry, true, moved_at);
    loop {
        while let Some(work) = schedule.next(*now) {
            let is_display = matches!(work, Work::Display(_));
            device.submit(work, *now);
            if is_display {
                let end = device.busy_until;
                *now = end;
                device.collect(schedule, end);
                return (end - moved_at) * 1e3 / BUDGET_MS;
            }
        }
        *now += 0.001;
        device.collect(schedule, *now);
    }
}

/// Refining work in flight, and the higher cost of sparse rays, don't make the first picture of a
/// movement late.
#[test]
fn the_first_picture_of_a_movement_is_in_time() {
    for sparser in (0..=10).map(|tenths| 1.0 + 0.1 * f64::from(tenths)) {
        let (mut schedule, mut device, mut now) = at_rest(sparser);
        let mut first = Vec::new();
        for movement in 0..40 {
            let mut times = Vec::new();
            for _ in 0..6 {
                times.push(picture_of_a_move(&mut schedule, &mut device, &mut now));
            }
            // The very first movement measures what openings cost.
            if movement > 0 {
                first.push(times[0]);
                assert!(times[1..].iter().all(|&time| time <= 1.0), "{sparser}: {times:?}");
            }
            schedule.set_moving(false);
            refine(&mut schedule, &mut device, &mut now, 1.0 + 0.0137 * f64::from(movement));
        }
        let worst = first.iter().copied().fold(0.0, f64::max);
        assert!(worst <= 1.2, "sparser {sparser}: {first:?}");
    }
}

/// Short pieces that other programs hold up now and then don't make other pieces long.
#[test]
fn pieces_that_were_held_up_do_not_make_others_long() {
    let longest = |seed: u32, has_stalls: bool| {
        let (mut schedule, mut device, mut now) = at_rest(1.4);
        let (mut seed, mut longest) = (seed, 0.0_f64);
        let end = now + 20.0;
        while now < end {
            device.collect(&mut schedule, now);
            while let Some(work) = schedule.next(now) {
                device.submit(work, now);
                let (_, ends_at, ms) = device.queue.last_mut().expect("a piece");
                longest = longest.max(*ms);
                seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                if has_stalls && seed >> 24 < 25 {
                    *ms += 12.0;
                    *ends_at += 0.012;
                    device.busy_until = *ends_at;
                }
            }
            now += 0.004;
            if schedule.status(now).idle {
                schedule.change(Stale::Geometry, false, now);
            }
        }
        longest
    };
    let steady_ms = longest(0, false);
    for seed in 0..20 {
        let held_up_ms = longest(seed, true);
        assert!(held_up_ms <= 2.0 * steady_ms, "{held_up_ms} ms instead of {steady_ms} ms");
    }
}

/// An expensive view on a coarse lattice and a cheap one on a fine lattice must not look like a fixed
/// cost.
#[test]
fn a_movement_through_views_of_varying_cost_stays_in_time() {
    for seed in 0..20 {
        let (mut schedule, mut device, mut now) = at_rest(1.4);
        let (mut seed, mut log_cost) = (seed as u32, 0.0_f64);
        let pixel_ns = device.pixel_ns;
        let mut times = Vec::new();
        for _ in 0..300 {
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            log_cost += 0.2 * (f64::from(seed) / f64::from(u32::MAX) - 0.5) - 0.01 * log_cost;
            device.pixel_ns = pixel_ns * log_cost.exp();
            times.push(picture_of_a_move(&mut schedule, &mut device, &mut now));
        }
        let worst = times[1..].iter().copied().fold(0.0, f64::max);
        assert!(worst <= 1.4, "seed {seed}: {worst} budgets");
    }
}

/// Refining pieces of a more expensive view are sized by the cost of its openings.
#[test]
fn pieces_of_an_expensive_view_are_no_longer() {
    let (mut schedule, mut device, mut now) = at_rest(1.4);
    for _ in 0..6 {
        picture_of_a_move(&mut schedule, &mut device, &mut now);
    }
    device.pixel_ns *= 3.0;
    for _ in 0..6 {
        picture_of_a_move(&mut schedule, &mut device, &mut now);
    }
    schedule.set_moving(false);
    let (end, mut longest) = (now + 0.5, 0.0_f64);
    while now < end {
        device.collect(&mut schedule, now);
        while let Some(work) = schedule.next(now) {
            device.submit(work, now);
            if matches!(work, Work::Trace(_)) {
                longest = longest.max(device.queue.last().expect("a piece").2);
            }
        }
        now += 0.001;
    }
    assert!(longest <= 1.1 * BUDGET_MS, "{longest} ms");
}

/// After a short first picture that was held up, the next one is at most two levels finer.
#[test]
fn pictures_get_finer_step_by_step() {
    for held_up_ms in [0.0, 1.0, 3.0, 10.0] {
        let (mut schedule, mut device, mut now) = at_rest(1.4);
        // Nearly all of a refining piece's time is fixed.
        device.overhead_ms = 5.0;
        refine(&mut schedule, &mut device, &mut now, 2.0);
        device.overhead_ms = held_up_ms;
        let mut before = None;
        for _ in 0..10 {
            schedule.set_lights(LIGHTS, 0b001);
            schedule.change(Stale::Light, true, now);
            while !schedule.status(now).shown || !schedule.in_flight.is_empty() {
                while let Some(work) = schedule.next(now) {
                    device.submit(work, now);
                }
                now = now.max(device.busy_until);
                device.collect(&mut schedule, now);
            }
            let level = schedule.status(now).shown_level;
            assert!(before.is_none_or(|before| level + 2 >= before), "{before:?}, then {level}");
            before = Some(level);
        }
    }
}

/// Time from the release to the picture of all pixels, in full frames, and the displays meanwhile.
fn release(full_ms: f64, piece_ms: f64) -> (f64, Vec<Work>) {
    let budget_ms = full_ms / 20.0;
    let mut device = Device::with_overhead(full_ms / 18.4, 0.0, piece_ms);
    device.sparser = 1.35;
    let mut schedule = schedule_of_lights(Pace::Interactive, SIZE);
    schedule.aim(budget_ms, 16);
    let mut now = 0.0;
    refine(&mut schedule, &mut device, &mut now, 4e-3 * full_ms);
    for _ in 0..10 {
        picture_of_a_move(&mut schedule, &mut device, &mut now);
    }
    schedule.set_moving(false);
    let released_at = now;
    let mut displays = Vec::new();
    while schedule.status(now).shown_level > 0 {
        while let Some(work) = schedule.next(now) {
            device.submit(work, now);
            if matches!(work, Work::Display(_)) {
                displays.push(work);
            }
        }
        now += 0.001;
        device.collect(&mut schedule, now);
    }
    ((now - released_at) * 1e3 / full_ms, displays)
}

/// After a release all pixels take little longer than a full frame in one piece.
#[test]
fn all_pixels_come_soon_after_a_release() {
    for full_ms in [100.0, 300.0, 500.0, 900.0] {
        let (took, displays) = release(full_ms, 0.01 * full_ms / 20.0);
        assert!(took <= 1.2, "{full_ms} ms: {took}");
        // There is no display between the lattice and the whole picture.
        assert_eq!(displays.len(), 1, "{full_ms} ms: {displays:?}");
    }
}

/// Where a full frame takes seconds, the filled film is displayed meanwhile.
#[test]
fn a_long_full_frame_is_displayed_on_its_way() {
    for full_ms in [1500.0, 4000.0] {
        let (took, displays) = release(full_ms, 0.5);
        assert!(took <= 1.2, "{full_ms} ms: {took}");
        let is_film = |work: &&Work| matches!(work, Work::Display(Display { from_film: true, .. }));
        let films: Vec<_> = displays.iter().filter(is_film).collect();
        assert!(
            matches!(films[0], Work::Display(Display { fill: true, level: PREVIEW_LEVEL, .. })),
            "{films:?}"
        );
        assert!(films.len() >= 3, "{films:?}");
        assert!(
            films[1..]
                .iter()
                .all(|work| matches!(work, Work::Display(Display { fill: false, .. })))
        );
    }
}
