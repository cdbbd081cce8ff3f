//! GPUs on which workgroups run side by side, each for longer than a piece may take, as in expensive scenes.

use super::*;

const SMALL_PX: [u32; 2] = [160, 90];

/// What a picture of 8 samples took.
struct Took {
    /// Times of the refining pieces, milliseconds, in order.
    pieces_ms: Vec<f64>,
    /// Time of the whole picture over the least possible.
    whole: f64,
}

/// Draws a picture where `cores` workgroups run side by side, each for `workgroup_ms` with all of `lights`; each piece takes
/// `overhead_ms` more. The time of one of `merged_of` pieces, if any, is reported as that of the next one.
fn draw(
    cores: u32,
    workgroup_ms: f64,
    overhead_ms: f64,
    lights: u64,
    merged_of: Option<usize>,
) -> Took {
    let mut schedule = Schedule::new(DIRECT.plan, Pace::Interactive, SMALL_PX);
    schedule.set_lights(lights, lights);
    schedule.aim(16.0, 8);
    let share = |from, lights: u64| share_of_frame(from, lights.count_ones().into());
    let (mut now, mut pieces_ms, mut workgroups, mut late_ms) = (0.0, Vec::new(), 0, 0.0);
    while let Some(work) = schedule.next(now) {
        let is_refining = schedule.status(now).shown;
        let ms = match work {
            Work::Trace(trace) => {
                workgroups += if trace.shades() { trace.workgroups } else { 0 };
                let part = share(trace.from, trace.lights) / share(Stage::March, lights);
                overhead_ms + f64::from(trace.workgroups.div_ceil(cores)) * workgroup_ms * part
            }
            Work::Display(_) => 1.0,
        };
        if is_refining {
            pieces_ms.push(ms);
        }
        late_ms += ms;
        let is_merged = merged_of.is_some_and(|of| pieces_ms.len() % of == of - 1);
        let reported_ms = if is_merged { 0.0 } else { std::mem::take(&mut late_ms) };
        schedule.collect(&[(Some(work), reported_ms)]);
        now += ms * 1e-3;
    }
    let status = schedule.status(now);
    assert!(status.idle && status.samples_done == 8 && !pieces_ms.is_empty());
    let least_ms = f64::from(workgroups) / f64::from(cores) * workgroup_ms;
    Took { pieces_ms, whole: now * 1e3 / least_ms }
}

/// On two cores or more, pieces of one and of two workgroups take the same time, as if all of it were fixed.
#[test]
fn workgroups_side_by_side_do_not_make_pieces_long() {
    for overhead in [0.0, 0.15] {
        for cores in [1, 2, 4, 16, 64] {
            for workgroup_ms in [20.0, 50.0, 100.0, 1000.0] {
                let Took { pieces_ms, whole } =
                    draw(cores, workgroup_ms, overhead * workgroup_ms, 0b1, None);
                let longest = pieces_ms.into_iter().fold(0.0, f64::max) / workgroup_ms;
                let case = format!("{cores} of {workgroup_ms} ms, {overhead} more");
                println!("{case}: the longest {longest:.2}, the picture {whole:.2}");
                assert!(longest <= 2.0 + overhead + 1e-6, "{case}: a piece takes {longest} times");
                assert!(whole < 2.2, "{case}: the picture takes {whole} times");
            }
        }
    }
}

/// Of the first pieces it is not known yet what a part costs beside its rays.
const FIRST_PIECES: usize = 100;

/// A workgroup's rays to 64 lights are many pieces of work, also where the time of some is reported as that of others, as
/// browsers do beside frames of the interface.
#[test]
fn many_lights_are_marched_in_parts() {
    for (cores, merged_of) in
        [1, 2, 4, 16, 64].into_iter().flat_map(|cores| [(cores, None), (cores, Some(10))])
    {
        for workgroup_ms in [50.0, 100.0, 400.0] {
            let Took { pieces_ms, whole } = draw(cores, workgroup_ms, 0.2, u64::MAX, merged_of);
            let longest_ms = pieces_ms.iter().skip(FIRST_PIECES).copied().fold(0.0, f64::max);
            let case = format!("{cores} of {workgroup_ms} ms, merged: 1 of {merged_of:?}");
            println!("{case}: the longest {longest_ms:.1} ms, the picture {whole:.2}");
            // Undivided, a piece takes as long as a workgroup, on one core as long as two.
            let most_ms = f64::max(30.0, 0.35 * workgroup_ms);
            assert!(longest_ms < most_ms, "{case}: a piece takes {longest_ms} ms");
            assert!(whole < 2.2, "{case}: the picture takes {whole} times");
        }
    }
}

/// With three lights, every part has one: trials have fewer parts.
#[test]
fn few_lights_stay_divided() {
    for cores in [2, 4] {
        let Took { pieces_ms, whole } = draw(cores, 100.0, 0.2, 0b111, None);
        let later = &pieces_ms[FIRST_PIECES..];
        let undivided = later.iter().filter(|ms| **ms > 90.0).count();
        println!("{cores}: {undivided} of {} undivided, {whole:.2}", later.len());
        assert!(undivided * 8 < later.len(), "{cores}: {undivided} of {}", later.len());
    }
}
