//! How few blocks occupy all cores of a CPU adapter, such as llvmpipe.
//!
//! In: the cores, and the lanes of their vectors. Out: how many blocks pieces of work are multiples of, and how many samples of them
//! a workgroup of a queue computes. A GPU computes the threads of many workgroups side by side. A core of a processor computes those
//! of one workgroup one after another, as many at once as it has lanes, so that small queues have as many workgroups as there are
//! cores, with idle threads in each.

use super::lattice::{BLOCK_THREADS, WORKGROUP_BLOCKS, WORKGROUP_THREADS};
use crate::gpu::Cpu;

/// Most workgroups for each core of a queue that fills no whole workgroups: some take longer than others.
const WORKGROUPS_OF_A_CORE: u32 = 2;

/// What occupies an adapter.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Occupancy {
    /// None for a GPU. At least one core, and at most so many lanes as a block has threads.
    cpu: Option<Cpu>,
}

impl Occupancy {
    /// Of a CPU adapter; none for a GPU. Lanes are powers of two; others count as those of whole blocks.
    pub fn of(cpu: Option<Cpu>) -> Self {
        let occupied = |Cpu { cores, lanes }: Cpu| Cpu {
            cores: cores.max(1),
            lanes: if lanes.is_power_of_two() { lanes.min(BLOCK_THREADS) } else { BLOCK_THREADS },
        };
        Self { cpu: cpu.map(occupied) }
    }

    /// Whether the adapter is a processor.
    pub fn is_cpu(self) -> bool {
        self.cpu.is_some()
    }

    /// Blocks that pieces of work are multiples of: others leave cores, or threads of a GPU's workgroups, idle.
    pub fn unit_blocks(self) -> u32 {
        self.cpu.map_or(WORKGROUP_BLOCKS, |cpu| cpu.cores)
    }

    /// Blocks of the least piece, in which each lane of all cores has a sample: part of a unit if there are fewer lanes than
    /// threads of a block.
    pub fn least_blocks(self) -> u32 {
        self.cpu.map_or(WORKGROUP_BLOCKS, |Cpu { cores, lanes }| {
            (cores * lanes).div_ceil(BLOCK_THREADS)
        })
    }

    /// Threads of each workgroup over a queue of at most `blocks` that compute a sample: a power of two, at least a core's lanes.
    pub fn queue_threads(self, blocks: u32) -> u32 {
        self.cpu.map_or(WORKGROUP_THREADS, |Cpu { cores, lanes }| {
            let of_core = (blocks * BLOCK_THREADS).div_ceil(WORKGROUPS_OF_A_CORE * cores);
            of_core.next_power_of_two().clamp(lanes, WORKGROUP_THREADS)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// However many blocks there are, no core computes over twice its share.
    #[test]
    fn blocks_occupy_all_cores() {
        for (cores, lanes) in [1, 2, 3, 4, 7, 16, 64].map(|cores| [(cores, 4), (cores, 8)]).concat()
        {
            let occupancy = Occupancy::of(Some(Cpu { cores, lanes }));
            for blocks in 1..=4096_u32 {
                let samples = blocks * BLOCK_THREADS;
                let threads = occupancy.queue_threads(blocks);
                assert!([4, 8, 16, 32, 64].contains(&threads) && threads >= lanes);
                let of_busiest = samples.div_ceil(threads).div_ceil(cores) * threads;
                let least = samples.div_ceil(cores).next_multiple_of(lanes);
                assert!(of_busiest <= 2 * least, "{blocks} on {cores}: {of_busiest}");
            }
        }
    }

    #[test]
    fn the_least_piece_has_a_sample_for_each_lane() {
        let least = |cores, lanes| {
            let occupancy = Occupancy::of(Some(Cpu { cores, lanes }));
            (occupancy.least_blocks(), occupancy.queue_threads(occupancy.least_blocks()))
        };
        assert_eq!([least(1, 4), least(2, 4), least(8, 4)], [(1, 4), (1, 4), (4, 4)]);
        assert_eq!([least(1, 8), least(2, 8), least(8, 8)], [(1, 8), (2, 8), (8, 8)]);
        // Wider ones, and numbers that say nothing.
        assert_eq!([least(2, 16), least(2, 0), least(2, 3)], [(2, 8); 3]);
    }

    #[test]
    fn a_gpu_has_whole_workgroups() {
        let occupancy = Occupancy::of(None);
        assert_eq!([occupancy.unit_blocks(), occupancy.least_blocks()], [WORKGROUP_BLOCKS; 2]);
        assert!((1..100).all(|blocks| occupancy.queue_threads(blocks) == 64));
    }
}
