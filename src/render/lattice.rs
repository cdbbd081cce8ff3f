//! Sparse lattices of pixels, each level twice as dense as the next.
//!
//! Level 0 is every pixel. Level `2m` is every 2ᵐ-th pixel of every 2ᵐ-th row; level `2m + 1`
//! keeps every other one of those, as a chessboard does. A pixel that a level adds to the next
//! coarser level has four neighbours in that level, beside and above it or on its diagonals, which
//! makes the picture easy to fill.

use super::uniforms::DispatchParams;

/// The coarsest level: one pixel in 1024.
pub const COARSEST: u32 = 10;

/// Pixels along a workgroup's side.
pub const WORKGROUP_SIDE: u32 = 8;

/// Most samples of a pixel that are marched together: they form one block of threads.
pub const MAX_SAMPLES_TOGETHER: u32 = 8;

/// Threads in a workgroup.
pub const WORKGROUP_THREADS: u32 = WORKGROUP_SIDE * WORKGROUP_SIDE;

/// Threads in a block; `BLOCK_THREADS` in `shaders/lib/lattice.wgsl`.
pub const BLOCK_THREADS: u32 = 8;

/// Blocks in a workgroup; `BLOCKS` in `shaders/lib/lattice.wgsl`.
pub const WORKGROUP_BLOCKS: u32 = WORKGROUP_THREADS / BLOCK_THREADS;

/// A set of pixels of a region, and the workgroups that visit them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Grid {
    step: [u32; 2],
    offset: [u32; 2],
    stagger: u32,
    row_phase: u32,
    shift: u32,
    /// log2 of the number of threads per pixel.
    samples_shift: u32,
    columns: u32,
    rows: u32,
}

impl Grid {
    /// All pixels, with threads for `together` samples of each, 1 to [`MAX_SAMPLES_TOGETHER`].
    pub fn samples(together: u32, size_px: [u32; 2]) -> Self {
        let shift = together.next_power_of_two().min(MAX_SAMPLES_TOGETHER).ilog2();
        // Two by four blocks; a block has four by two pixels, two by two, two by one, or one.
        let sides = [2 * (4 >> shift.div_ceil(2)), 4 * (2 >> (shift / 2))];
        let [columns, rows] = std::array::from_fn(|axis| size_px[axis].div_ceil(sides[axis]));
        Self { samples_shift: shift, columns, rows, ..Self::level(0, size_px) }
    }

    /// All pixels of a lattice level.
    pub fn level(level: u32, size_px: [u32; 2]) -> Self {
        let shift = level / 2;
        if level.is_multiple_of(2) {
            Self::new([1, 1], [0, 0], 0, 0, shift, size_px)
        } else {
            Self::new([2, 1], [0, 0], 1, 0, shift, size_px)
        }
    }

    /// The pixels that a level adds to the next coarser level.
    pub fn added(level: u32, size_px: [u32; 2]) -> Self {
        let shift = level / 2;
        if level.is_multiple_of(2) {
            Self::new([2, 1], [0, 0], 1, 1, shift, size_px)
        } else {
            Self::new([2, 2], [1, 1], 0, 0, shift, size_px)
        }
    }

    fn new(
        step: [u32; 2],
        offset: [u32; 2],
        stagger: u32,
        row_phase: u32,
        shift: u32,
        size_px: [u32; 2],
    ) -> Self {
        let threads = |axis: usize| {
            let places = size_px[axis].div_ceil(1 << shift).saturating_sub(offset[axis]);
            places.div_ceil(step[axis])
        };
        Self {
            step,
            offset,
            stagger,
            row_phase,
            shift,
            samples_shift: 0,
            columns: threads(0).div_ceil(WORKGROUP_SIDE),
            rows: threads(1).div_ceil(WORKGROUP_SIDE),
        }
    }

    /// Number of threads, including those of the last workgroups that lie outside the region.
    pub fn threads(&self) -> u32 {
        self.workgroups() * WORKGROUP_THREADS
    }

    /// Number of workgroups that cover the grid; 0 for a region without such pixels.
    pub fn workgroups(&self) -> u32 {
        self.columns * self.rows
    }

    /// Number of blocks of these workgroups.
    pub fn blocks(&self) -> u32 {
        self.workgroups() * WORKGROUP_BLOCKS
    }

    /// The parameters of a dispatch that starts at `first_workgroup`.
    ///
    /// The sample is the pixel's centre and replaces the film's value.
    pub fn dispatch_params(&self, first_workgroup: u32) -> DispatchParams {
        DispatchParams {
            step: self.step,
            offset: self.offset,
            stagger: self.stagger,
            row_phase: self.row_phase,
            shift: self.shift,
            workgroups: [self.columns.max(1), self.rows.max(1)],
            scatter: [scatter(self.columns), scatter(self.rows)],
            first_workgroup,
            jitter: [0.5, 0.5],
            samples: 1,
            samples_shift: self.samples_shift,
            jitter_step: JITTER_STEP.map(|step| step as f32),
            ..DispatchParams::default()
        }
    }

    /// The pixel of a thread, as `lattice_pixel` in `shaders/lib/lattice.wgsl` computes it.
    ///
    /// `place` is its position in the workgroup, (0, 0) to (7, 7). The pixel may be outside the region.
    pub fn pixel(&self, workgroup: u32, place: [u32; 2]) -> [u32; 2] {
        let columns = self.columns.max(1);
        let rows = self.rows.max(1);
        let column = (workgroup % columns) * scatter(columns) % columns;
        let row = (workgroup / columns + column) * scatter(rows) % rows;
        let x = column * WORKGROUP_SIDE + place[0];
        let y = row * WORKGROUP_SIDE + place[1];
        let shifted = self.stagger * ((y + self.row_phase) & 1);
        [
            (x * self.step[0] + self.offset[0] + shifted) << self.shift,
            (y * self.step[1] + self.offset[1]) << self.shift,
        ]
    }
}

/// A stride that visits `count` positions in a scattered order, each once.
///
/// The stride is coprime to `count` and near its golden section, so that every piece of a picture costs
/// about the same, wherever the expensive pixels are.
fn scatter(count: u32) -> u32 {
    let coprime = |a: u32| {
        let (mut a, mut b) = (a, count);
        while b != 0 {
            (a, b) = (b, a % b);
        }
        a == 1
    };
    let golden = (f64::from(count) * 0.618_034) as u32;
    (golden.max(1)..=count).find(|&stride| coprime(stride)).unwrap_or(1)
}

/// Offset from each sample of a pixel to the next: the plastic number's inverse and its square.
const JITTER_STEP: [f64; 2] = [0.754_877_666_246_692_8, 0.569_840_290_998_053_3];

/// The position of sample `index` in its pixel, 0 to 1; sample 0 is the centre.
///
/// The samples follow Roberts' R2 sequence ("The Unreasonable Effectiveness of Quasirandom Sequences",
/// 2018), which fills the square evenly at every count. All pixels share it: offsets per pixel
/// (Cranley and Patterson 1976, by a hash, by gradient noise, by R2 over the pixels) give the same
/// error at every count from 4 to 1024, within an eighth, and rougher edges at few samples.
pub fn jitter(index: u32) -> [f32; 2] {
    JITTER_STEP.map(|a| (0.5 + a * f64::from(index)).fract() as f32)
}

/// How many samples a lattice level's rows have room for.
pub fn sample_places(level: u32, size_px: [u32; 2]) -> u64 {
    let [columns, rows] = size_px.map(|side| u64::from(side.div_ceil(1 << (level / 2))));
    columns * rows
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pixels(grid: Grid, size: [u32; 2]) -> Vec<[u32; 2]> {
        let mut all: Vec<_> = (0..grid.workgroups())
            .flat_map(|workgroup| {
                (0..WORKGROUP_THREADS).map(move |i| grid.pixel(workgroup, [i % 8, i / 8]))
            })
            .filter(|p| p[0] < size[0] && p[1] < size[1])
            .collect();
        all.sort_unstable();
        all
    }

    #[test]
    fn every_level_is_the_next_coarser_one_and_what_it_adds() {
        for size in [[1, 1], [7, 3], [64, 64], [101, 67], [33, 130]] {
            for level in 0..COARSEST {
                let mut parts = pixels(Grid::level(level + 1, size), size);
                parts.extend(pixels(Grid::added(level, size), size));
                parts.sort_unstable();
                assert_eq!(parts, pixels(Grid::level(level, size), size), "{size:?} {level}");
            }
            assert_eq!(pixels(Grid::level(0, size), size).len() as u32, size[0] * size[1]);
        }
    }

    #[test]
    fn added_pixels_have_a_known_neighbour_toward_the_origin() {
        let size = [101, 67];
        for level in 0..COARSEST {
            let known = pixels(Grid::level(level + 1, size), size);
            let spacing = 1 << (level / 2);
            for [x, y] in pixels(Grid::added(level, size), size) {
                let sure = if level % 2 == 1 {
                    [x - spacing, y - spacing]
                } else if x >= spacing {
                    [x - spacing, y]
                } else {
                    [x, y - spacing]
                };
                assert!(known.binary_search(&sure).is_ok(), "level {level}: {x},{y}");
            }
        }
    }

    #[test]
    fn samples_spread_evenly() {
        assert_eq!(jitter(0), [0.5, 0.5]);
        // At every count, each of 16 cells of the square has its share of the samples, within six samples.
        let mut counts = [0_u32; 16];
        for index in 0..1024 {
            let [x, y] = jitter(index);
            counts[(x * 4.0) as usize + 4 * (y * 4.0) as usize] += 1;
            let share = f64::from(index + 1) / 16.0;
            assert!(counts.iter().all(|&n| (f64::from(n) - share).abs() <= 6.0), "{counts:?}");
        }
    }
}
