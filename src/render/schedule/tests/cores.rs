//! GPUs on which workgroups run side by side, each for longer than a piece may take, as in expensive scenes.

use super::*;
use crate::gpu::Cpu;
use crate::render::{
    lattice::{BLOCK_THREADS, WORKGROUP_BLOCKS, WORKGROUP_THREADS},
    occupancy::Occupancy,
};

const SMALL_PX: [u32; 2] = [160, 90];

/// What a picture of 8 samples took.
struct Took {
    /// Times of the refining pieces, milliseconds, in order.
    pieces_ms: Vec<f64>,
    /// Time of the whole picture over the least possible.
    whole: f64,
}

/// What computes workgroups.
#[derive(Clone, Copy, Debug)]
enum Cores {
    /// A GPU that computes so many side by side, each as fast with one block as with eight.
    Gpu(u32),
    /// A CPU adapter, each of whose cores computes the samples of its workgroup one after another, as many at once as it has lanes.
    Cpu(Cpu),
}

impl Cores {
    fn count(self) -> u32 {
        let (Self::Gpu(count) | Self::Cpu(Cpu { cores: count, .. })) = self;
        count
    }

    fn occupancy(self) -> Occupancy {
        match self {
            Self::Gpu(_) => Occupancy::of(None),
            Self::Cpu(cpu) => Occupancy::of(Some(cpu)),
        }
    }

    /// Time of so many blocks, milliseconds. A workgroup takes `workgroup_ms`.
    fn blocks_ms(self, blocks: u32, workgroup_ms: f64) -> f64 {
        let threads = self.occupancy().queue_threads(blocks);
        let workgroups = (blocks * BLOCK_THREADS).div_ceil(threads);
        let part = f64::from(threads) / f64::from(WORKGROUP_THREADS);
        f64::from(workgroups.div_ceil(self.count())) * part * workgroup_ms
    }
}

/// GPUs and CPU adapters of 1 to 64 cores.
fn all_cores() -> impl Iterator<Item = Cores> {
    [1, 2, 4, 16, 64].into_iter().flat_map(|count| {
        let cpu = |lanes| Cores::Cpu(Cpu { cores: count, lanes });
        [Cores::Gpu(count), cpu(4), cpu(8)]
    })
}

/// Draws a picture where `cores` workgroups run side by side, each for `workgroup_ms` with all of `lights`; each piece takes
/// `overhead_ms` more. The time of one of `merged_of` pieces, if any, is reported as that of the next one.
fn draw(
    cores: Cores,
    workgroup_ms: f64,
    overhead_ms: f64,
    lights: u64,
    merged_of: Option<usize>,
) -> Took {
    let mut schedule = Schedule::new(DIRECT.plan, Pace::Interactive, SMALL_PX);
    schedule.set_lights(lights, lights);
    schedule.set_occupancy(cores.occupancy());
    schedule.aim(16.0, 8);
    let share = |from, lights: u64| share_of_frame(from, lights.count_ones().into());
    let (mut now, mut pieces_ms, mut blocks, mut late_ms) = (0.0, Vec::new(), 0, 0.0);
    while let Some(work) = schedule.next(now) {
        let is_refining = schedule.status(now).shown;
        let ms = match work {
            Work::Trace(trace) => {
                blocks += if trace.shades() { trace.blocks } else { 0 };
                let part = share(trace.from, trace.lights) / share(Stage::March, lights);
                overhead_ms + cores.blocks_ms(trace.blocks, workgroup_ms) * part
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
    let least_ms = f64::from(blocks / WORKGROUP_BLOCKS) / f64::from(cores.count()) * workgroup_ms;
    Took { pieces_ms, whole: now * 1e3 / least_ms }
}

/// On two cores or more, pieces of one and of two workgroups of a GPU take the same time, as if all of it were fixed.
#[test]
fn workgroups_side_by_side_do_not_make_pieces_long() {
    for overhead in [0.0, 0.15] {
        for cores in all_cores() {
            for workgroup_ms in [20.0, 50.0, 100.0, 1000.0] {
                let Took { pieces_ms, whole } =
                    draw(cores, workgroup_ms, overhead * workgroup_ms, 0b1, None);
                let longest = pieces_ms.into_iter().fold(0.0, f64::max) / workgroup_ms;
                let case = format!("{cores:?} of {workgroup_ms} ms, {overhead} more");
                println!("{case}: the longest {longest:.2}, the picture {whole:.2}");
                // Pieces of a CPU adapter are less than a workgroup for each core.
                let most = if matches!(cores, Cores::Cpu(_)) { 0.5 } else { 2.0 } + overhead;
                assert!(longest <= most + 1e-6, "{case}: a piece takes {longest} times");
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
    for (cores, merged_of) in all_cores().flat_map(|cores| [(cores, None), (cores, Some(10))]) {
        for workgroup_ms in [50.0, 100.0, 400.0] {
            let Took { pieces_ms, whole } = draw(cores, workgroup_ms, 0.2, u64::MAX, merged_of);
            let longest_ms = pieces_ms.iter().skip(FIRST_PIECES).copied().fold(0.0, f64::max);
            let case = format!("{cores:?} of {workgroup_ms} ms, merged: 1 of {merged_of:?}");
            println!("{case}: the longest {longest_ms:.1} ms, the picture {whole:.2}");
            // Undivided, a piece of a GPU takes as long as a workgroup, on one core as long as two.
            let most_ms = match cores {
                Cores::Gpu(_) => f64::max(30.0, 0.35 * workgroup_ms),
                Cores::Cpu(_) => 16.0,
            };
            assert!(longest_ms < most_ms, "{case}: a piece takes {longest_ms} ms");
            assert!(whole < 2.2, "{case}: the picture takes {whole} times");
        }
    }
}

/// With three lights, every part has one: trials have fewer parts.
#[test]
fn few_lights_stay_divided() {
    for cores in [Cores::Gpu(2), Cores::Gpu(4)] {
        let Took { pieces_ms, whole } = draw(cores, 100.0, 0.2, 0b111, None);
        let later = &pieces_ms[FIRST_PIECES..];
        let undivided = later.iter().filter(|ms| **ms > 90.0).count();
        println!("{cores:?}: {undivided} of {} undivided, {whole:.2}", later.len());
        assert!(undivided * 8 < later.len(), "{cores:?}: {undivided} of {}", later.len());
    }
}
