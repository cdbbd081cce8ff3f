//! GPUs on which workgroups run side by side, each for longer than a piece may take, as in expensive scenes.

use super::*;

const SMALL_PX: [u32; 2] = [160, 90];

/// The time of the longest refining piece over that of a workgroup, and the time of the whole picture over the least possible.
///
/// `cores` workgroups run side by side, each for `workgroup_ms`; each piece takes `overhead_ms` more.
fn longest_and_whole(cores: u32, workgroup_ms: f64, overhead_ms: f64) -> (f64, f64) {
    let mut schedule = schedule_of_lights(Pace::Interactive, SMALL_PX);
    schedule.aim(16.0, 8);
    let (mut now, mut longest_ms, mut workgroups) = (0.0, 0.0_f64, 0);
    while let Some(work) = schedule.next(now) {
        let is_refining = schedule.status(now).shown;
        let ms = match work {
            Work::Trace(trace) => {
                workgroups += trace.workgroups;
                overhead_ms + f64::from(trace.workgroups.div_ceil(cores)) * workgroup_ms
            }
            Work::Display(_) => 1.0,
        };
        if is_refining {
            longest_ms = longest_ms.max(ms);
        }
        schedule.collect(&[(Some(work), ms)]);
        now += ms * 1e-3;
    }
    let status = schedule.status(now);
    assert!(status.idle && status.samples_done == 8 && longest_ms > 0.0);
    let least_ms = f64::from(workgroups) / f64::from(cores) * workgroup_ms;
    (longest_ms / workgroup_ms, now * 1e3 / least_ms)
}

/// On two cores or more, pieces of one and of two workgroups take the same time, as if all of it were fixed.
#[test]
fn workgroups_side_by_side_do_not_make_pieces_long() {
    for overhead in [0.0, 0.15] {
        for cores in [1, 2, 4, 16, 64] {
            for workgroup_ms in [20.0, 50.0, 100.0, 1000.0] {
                let (longest, whole) =
                    longest_and_whole(cores, workgroup_ms, overhead * workgroup_ms);
                let case = format!("{cores} of {workgroup_ms} ms, {overhead} more");
                println!("{case}: the longest {longest:.2}, the picture {whole:.2}");
                assert!(longest <= 2.0 + overhead + 1e-6, "{case}: a piece takes {longest} times");
                assert!(whole < 2.2, "{case}: the picture takes {whole} times");
            }
        }
    }
}
