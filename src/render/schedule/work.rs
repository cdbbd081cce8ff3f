//! What a schedule hands out: one piece of work.

use crate::render::{
    lattice::{BLOCK_THREADS, Grid, WORKGROUP_BLOCKS},
    region::Overlap,
};

/// Workgroups in one submit at first: a view's buffers of rays, jittered samples and work queues have this size.
///
/// The size keeps a view of 1920×1080 with everything on below the memory of the thesis
/// ([`memory`](crate::render::memory)).
pub const BATCH_WORKGROUPS: u32 = 2048;

/// Most workgroups in one submit.
///
/// Each pass of a batch waits for the longest ray of the pass before it. On a large GPU that takes longer than all other
/// rays together, so that batches grow there ([`Targets::fit_batch`](crate::render::targets::Targets::fit_batch)).
pub const MAX_BATCH_WORKGROUPS: u32 = 8 * BATCH_WORKGROUPS;

/// Most blocks in a piece of work: a megapixel, and one of the largest batches.
pub const MAX_PIECE_BLOCKS: u32 = MAX_BATCH_WORKGROUPS * WORKGROUP_BLOCKS;

/// Which sample points a trace computes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Points {
    /// Centre samples of every pixel of a lattice level.
    Level(u32),
    /// Centre samples of the pixels that a level adds to the next coarser one.
    Added(u32),
    /// Centre samples of every pixel.
    ///
    /// Pixels of the lattice are computed again: rays of a dense lattice cost less.
    All,
    /// Indirect light of a lattice level whose centre samples have their direct light.
    Indirect(u32),
    /// Jittered samples of every pixel, computed together.
    Samples {
        /// The index of the first one.
        first: u32,
        /// How many, 1 to [`MAX_SAMPLES_TOGETHER`](crate::render::lattice::MAX_SAMPLES_TOGETHER).
        count: u32,
    },
}

impl Points {
    /// The lattice level that these points complete; 0 for `All` and `Samples`.
    pub fn level(self) -> u32 {
        match self {
            Self::Level(level) | Self::Added(level) | Self::Indirect(level) => level,
            Self::All | Self::Samples { .. } => 0,
        }
    }

    /// The grid of the points.
    pub fn grid(self, size_px: [u32; 2]) -> Grid {
        match self {
            Self::Level(level) | Self::Indirect(level) => Grid::level(level, size_px),
            Self::Added(level) => Grid::added(level, size_px),
            Self::All => Grid::level(0, size_px),
            Self::Samples { count, .. } => Grid::samples(count, size_px),
        }
    }
}

/// The first stage that a trace computes; later stages follow.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Stage {
    /// Traces light paths from the camera on.
    Path,
    /// Marches camera rays.
    March,
    /// Normals; depths are in the G-buffer.
    Normal,
    /// Shadow rays; depths and normals are in the G-buffer.
    Shadow,
    /// Light and colours; visibility is in the G-buffer too.
    Shade,
    /// Indirect light; direct light is there.
    Indirect,
}

/// What has to be done for some sample points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Job {
    /// Where it starts: what comes before is in the G-buffer.
    pub from: Stage,
    /// The lights whose shadow rays are marched, by their visibility bits.
    pub lights: u64,
}

/// Pixels that work leaves as they are: they already hold what it would compute.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct KeptPixels {
    /// The upper left one.
    pub first: [u32; 2],
    /// One past the lower right one.
    pub end: [u32; 2],
    /// Fraction of the region's pixels, 0 to 1.
    pub share: f32,
}

impl KeptPixels {
    /// The pixels of an overlap in a region of `size_px`.
    pub fn of(overlap: &Overlap, size_px: [u32; 2]) -> Self {
        let Overlap { first, size_px: kept_px, .. } = *overlap;
        let all = f64::from(size_px[0]) * f64::from(size_px[1]);
        Self {
            first,
            end: [first[0] + kept_px[0], first[1] + kept_px[1]],
            share: (overlap.pixels() as f64 / all) as f32,
        }
    }

    /// About how many of `threads` compute something: workgroups are visited in a scattered order, so that each run of
    /// them has its share of kept pixels.
    pub fn computed(&self, threads: u32) -> u32 {
        (f64::from(threads) * (1.0 - f64::from(self.share))) as u32
    }
}

/// One of the parts that march rays to some of a trace's lights each, in order; the last one shades the samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Part {
    /// 0 for the first part.
    pub index: u32,
    /// Number of parts, at least 1.
    pub count: u32,
    /// What all parts together do.
    pub whole: Job,
}

/// A run of blocks over some sample points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trace {
    /// The sample points.
    pub points: Points,
    /// Where it starts: what comes before is in the G-buffer.
    pub from: Stage,
    /// The lights whose shadow rays are marched, by their visibility bits; the bits of others stay.
    pub lights: u64,
    /// First block of the points' grid, in the order of its workgroups.
    pub first_block: u32,
    /// How many blocks.
    pub blocks: u32,
    /// The pixels that are not computed.
    pub kept: KeptPixels,
    /// Which part of the samples' lights it is; none for all of them.
    pub part: Option<Part>,
}

impl Trace {
    /// All of `points`, in a region of `size_px`.
    pub fn whole(points: Points, from: Stage, lights: u64, size_px: [u32; 2]) -> Self {
        let blocks = points.grid(size_px).blocks();
        let kept = KeptPixels::default();
        Self { points, from, lights, first_block: 0, blocks, kept, part: None }
    }

    /// Part `index` of `count`, each with about as many of the lights that cast shadows. The first part has all others, and
    /// later parts find depths and normals in the G-buffer.
    pub fn part(self, index: u32, count: u32, casting: u64) -> Self {
        let casting = self.lights & casting;
        let lights = casting.count_ones();
        let [first, end] = [index, index + 1].map(|index| (lights * index / count) as usize);
        let bits = (0..u64::BITS).filter(|bit| casting >> bit & 1 == 1);
        let (from, others) =
            if index == 0 { (self.from, self.lights & !casting) } else { (Stage::Shadow, 0) };
        Self {
            from,
            lights: bits
                .skip(first)
                .take(end - first)
                .fold(others, |lights, bit| lights | 1 << bit),
            part: Some(Part { index, count, whole: self.job() }),
            ..self
        }
    }

    /// Whether its samples get their light: all of their lights' rays are marched then.
    pub fn shades(&self) -> bool {
        self.part.is_none_or(|part| part.index + 1 == part.count)
    }

    /// Number of parts that the trace is divided into.
    pub fn parts(&self) -> u32 {
        self.part.map_or(1, |part| part.count)
    }

    /// Parts of the trace that have at most so many workgroups, in order.
    pub fn batches(self, batch_workgroups: u32) -> impl Iterator<Item = Self> {
        self.runs(batch_workgroups * WORKGROUP_BLOCKS)
    }

    /// Parts of the trace that have at most so many blocks, in order.
    pub fn runs(self, most_blocks: u32) -> impl Iterator<Item = Self> {
        let end = self.first_block + self.blocks;
        (self.first_block..end).step_by(most_blocks as usize).map(move |first| Self {
            first_block: first,
            blocks: most_blocks.min(end - first),
            ..self
        })
    }

    /// How many workgroups hold its blocks.
    pub fn workgroups(&self) -> u32 {
        self.blocks.div_ceil(WORKGROUP_BLOCKS)
    }

    /// About how many samples it computes, with those of the last workgroups that lie outside the region.
    pub fn samples(&self) -> u32 {
        self.kept.computed(self.blocks * BLOCK_THREADS)
    }

    /// What is done for each of its points, by all parts.
    pub fn job(&self) -> Job {
        self.part.map_or(Job { from: self.from, lights: self.lights }, |part| part.whole)
    }
}

/// A display picture to make.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Display {
    /// The finest complete lattice level; 0 if the film is complete.
    pub level: u32,
    /// Whether the pixels between those of the lattice must be filled first.
    pub fill: bool,
    /// True if the display shows the film although a finer level is under way.
    pub from_film: bool,
    /// Part of the way to its goal that auto exposure moves, above 0; 1 arrives at once.
    pub adapt: f32,
    /// The pixels that are not filled.
    pub kept: KeptPixels,
    /// Whether it refines the picture that is shown: of the same scene and view.
    pub refines: bool,
}

/// One piece of work.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Work {
    /// Compute sample points, up to the film.
    Trace(Trace),
    /// Make the display picture.
    Display(Display),
}

impl Work {
    /// What its submits are called in tools of the GPU.
    pub fn name(self) -> &'static str {
        match self {
            Self::Trace(_) => "trace",
            Self::Display(_) => "display",
        }
    }

    /// Parts to submit one after another: each part reuses the buffers of a batch, which hold so many workgroups.
    pub fn batches(self, batch_workgroups: u32) -> impl Iterator<Item = Self> {
        let (trace, display) = match self {
            Self::Trace(trace) => (Some(trace), None),
            Self::Display(_) => (None, Some(self)),
        };
        trace
            .into_iter()
            .flat_map(move |trace| trace.batches(batch_workgroups))
            .map(Self::Trace)
            .chain(display)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn batches_cover_a_trace_once_and_in_order() {
        let most = BATCH_WORKGROUPS * WORKGROUP_BLOCKS;
        for (first_block, blocks) in [(0, 1), (7, most), (100, 40_003)] {
            let points = Points::Level(0);
            let trace = Trace {
                points,
                from: Stage::Normal,
                lights: 5,
                first_block,
                blocks,
                kept: KeptPixels::default(),
                part: None,
            };
            let mut next = first_block;
            for batch in Work::Trace(trace).batches(BATCH_WORKGROUPS) {
                let Work::Trace(batch) = batch else { panic!("{batch:?} is no trace") };
                assert_eq!((batch.job(), batch.points), (trace.job(), points));
                assert_eq!(batch.first_block, next);
                assert!((1..=most).contains(&batch.blocks));
                next += batch.blocks;
            }
            assert_eq!(next, first_block + blocks);
        }
        let display = Work::Display(Display {
            level: 3,
            fill: true,
            from_film: false,
            adapt: 1.0,
            kept: KeptPixels::default(),
            refines: false,
        });
        assert_eq!(display.batches(BATCH_WORKGROUPS).collect::<Vec<_>>(), [display]);
    }

    #[test]
    fn parts_march_to_each_light_once_and_shade_at_last() {
        let casting = 0b1101_0110_1001;
        let whole = Trace::whole(Points::All, Stage::Normal, casting | 0b10010, [100, 100]);
        for count in 2..=7 {
            let parts: Vec<_> = (0..count).map(|index| whole.part(index, count, casting)).collect();
            let lights = parts.iter().map(|part| part.lights);
            assert_eq!(lights.clone().fold(0, |all, lights| all | lights), whole.lights);
            assert_eq!(lights.clone().map(u64::count_ones).sum::<u32>(), 9, "each light once");
            let most = 7_u32.div_ceil(count);
            let of_parts = lights.map(|lights| (lights & casting).count_ones());
            assert!(of_parts.clone().all(|lights| (1..=most).contains(&lights)));
            for (part, index) in parts.iter().zip(0..) {
                let starts = if index == 0 { Stage::Normal } else { Stage::Shadow };
                assert_eq!((part.from, part.shades()), (starts, index + 1 == count));
                assert_eq!(part.job(), whole.job());
                assert_eq!(part.blocks, whole.blocks);
            }
        }
        assert!(whole.shades());
    }
}
