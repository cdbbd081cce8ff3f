//! Post passes: statistics of the whole film (mean, histogram), exposure and bloom.
//!
//! In: a film. Out: the statistics and the mip level with the bloom, which [`tone`](super::pass::tone)
//! reads. Both belong to the whole picture: a view that draws a tile uses the [`Post`] of a view that draws
//! all of the picture
//! ([`View::lend_post`](super::View::lend_post)), in which the tile's pixels are looked up by
//! their place in the picture.
//!
//! The mip levels start with the one of 4×4 pixels and serve twice in one submit: first for the
//! mean, which ends in the statistics, then for the bloom. Bytes a pixel: 4/3 for the levels, 1
//! more for the blur; what the scene does not need is not allocated.

use super::{
    lattice::WORKGROUP_THREADS,
    pipelines::Pipelines,
    region::Region,
    report::{HISTOGRAM_BINS, Histogram},
    targets,
    uniforms::{FrameUniforms, Statistics},
};
use crate::scene::Scene;

/// The finest mip level: one element for 4×4 pixels.
pub const FIRST_LEVEL: u32 = 2;

/// Most elements of a mip level that half the width of a blur's kernel spans. A coarser level is
/// faster, a finer one follows what moves with smaller steps.
pub const MOST_HALF_WIDTH: f32 = 6.0;

const ELEMENT_BYTES: u64 = 16;

/// Film statistics that a scene needs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Need {
    /// The film's mean, for auto exposure.
    pub mean: bool,
    /// The light that blooms.
    pub bloom: bool,
}

impl Need {
    /// What the tone pass of a picture reads.
    pub fn of(picture: &FrameUniforms) -> Self {
        Self { mean: picture.tone.auto_exposure != 0, bloom: picture.bloom.strength > 0.0 }
    }

    /// The same of a scene's pictures.
    pub fn of_scene(scene: &Scene) -> Self {
        Self { mean: scene.tone.auto_exposure, bloom: scene.bloom.strength as f32 > 0.0 }
    }

    /// Nothing at all.
    pub fn is_none(self) -> bool {
        self == Self::default()
    }
}

/// Statistics and mip levels of a film of one size.
pub struct Post {
    levels: Levels,
    need: Need,
    /// [`Statistics`].
    pub statistics: wgpu::Buffer,
    /// 4 × f32 an element: the levels from [`FIRST_LEVEL`] on, rows packed.
    pub mips: wgpu::Buffer,
    half_blurred: wgpu::Buffer,
    /// All three.
    pub group: wgpu::BindGroup,
}

impl Post {
    /// Allocates what `need` takes for the film of `region`.
    pub fn new(pipelines: &Pipelines, region: Region, need: Need) -> Self {
        let levels = Levels::of_region(region);
        let bytes = size_of::<Statistics>() as u64;
        let statistics = targets::storage(&pipelines.gpu.device, "statistics", bytes);
        // New buffers hold zeros; the size is all that no pass writes.
        pipelines.gpu.queue.write_buffer(&statistics, 0, bytemuck::bytes_of(&levels.eye_px));
        Self::around(pipelines, levels, need, statistics)
    }

    /// One for the same film with room for `need`. The statistics stay: exposure goes on from
    /// where it is.
    pub fn with_need(&self, pipelines: &Pipelines, need: Need) -> Self {
        Self::around(pipelines, self.levels, need, self.statistics.clone())
    }

    fn around(pipelines: &Pipelines, levels: Levels, need: Need, statistics: wgpu::Buffer) -> Self {
        let device = &pipelines.gpu.device;
        let finest = u64::from(levels.elements(FIRST_LEVEL));
        let all: u64 = (FIRST_LEVEL..=levels.last()).map(|n| u64::from(levels.elements(n))).sum();
        let room = |wanted: bool, count: u64| ELEMENT_BYTES * if wanted { count } else { 1 };
        let mips = targets::storage(device, "mip levels", room(!need.is_none(), all));
        let half_blurred = targets::storage(device, "half blurred", room(need.bloom, finest));
        let group = targets::group(
            device,
            &pipelines.layouts.post,
            "post",
            [&statistics, &mips, &half_blurred].map(wgpu::Buffer::as_entire_binding),
        );
        Self { levels, need, statistics, mips, half_blurred, group }
    }

    /// What there is room for.
    pub fn need(&self) -> Need {
        self.need
    }

    /// GPU memory of the mip levels, and of what the blur needs beside them.
    pub fn bytes(&self) -> [u64; 2] {
        [&self.mips, &self.half_blurred].map(wgpu::Buffer::size)
    }
}

/// Post passes that one display runs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Tasks {
    /// The film's mean.
    pub mean: bool,
    /// The film's histogram.
    pub histogram: bool,
    /// Auto exposure: how far it moves toward its goal, above 0 to 1. None leaves it.
    pub adapt: Option<f32>,
    /// The light that blooms.
    pub bloom: bool,
}

/// How the mip levels of a film lie: each eye's part of it has its own elements, so that none
/// holds light of both. Twin of `shaders/lib/mip.wgsl`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Levels {
    /// Width and height of one eye's part, pixels.
    eye_px: [u32; 2],
    /// Columns and rows of eyes.
    eyes: [u32; 2],
}

impl Levels {
    /// Those of a region's film.
    pub fn of_region(region: Region) -> Self {
        Self { eye_px: region.size_px, eyes: region.second_eye_at().map(|at| 1 + at.min(1)) }
    }

    /// Those of the film that a picture's passes write.
    pub fn of(picture: &FrameUniforms) -> Self {
        let eyes = picture.eyes.second_at.map(|at| 1 + at.min(1));
        Self { eye_px: std::array::from_fn(|i| picture.size_px[i] / eyes[i]), eyes }
    }

    /// The level of one element an eye.
    pub fn last(self) -> u32 {
        let longest = self.eye_px[0].max(self.eye_px[1]).max(1);
        longest.next_power_of_two().trailing_zeros().max(FIRST_LEVEL)
    }

    /// Elements of a level: as many as cover the film.
    pub fn elements(self, level: u32) -> u32 {
        let eyes: u32 = self.eyes.iter().product();
        eyes * self.eye_px.map(|side| side.div_ceil(1 << level)).iter().product::<u32>()
    }

    /// Workgroups of a dispatch over a level's elements; fewer than 65,536 for any region that
    /// [fits](super::Region::fits).
    pub fn workgroups(self, level: u32) -> u32 {
        self.elements(level).div_ceil(WORKGROUP_THREADS)
    }
}

/// One uniform kernel: the mip level it works on, and half its width in that level's elements.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kernel {
    /// The mip level.
    pub level: u32,
    /// Half the width, elements; at most [`MOST_HALF_WIDTH`] unless the level is the last.
    pub half_width: f32,
}

impl Kernel {
    /// The kernel for a radius in parts of the height of an eye's picture. Applied `passes`
    /// times, it spreads light with the variance of a single one with that half width.
    pub fn new(radius: f32, passes: u32, levels: Levels) -> Self {
        let half_width_px = radius * levels.eye_px[1] as f32 / (passes.max(1) as f32).sqrt();
        let at = |level: u32| half_width_px / (1_u32 << level) as f32;
        let last = levels.last();
        let level = (FIRST_LEVEL..last).find(|&n| at(n) <= MOST_HALF_WIDTH).unwrap_or(last);
        Self { level, half_width: at(level) }
    }
}

/// What the interface shows of the statistics.
pub(super) fn histogram(bytes: &[u8]) -> Option<Histogram> {
    let statistics: Statistics = bytemuck::try_pod_read_unaligned(bytes).ok()?;
    let bins: [u32; HISTOGRAM_BINS] = statistics.bins;
    Some(Histogram { bins: bins.into(), adapted_stops: statistics.adapted_stops })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn levels(size_px: [u32; 2]) -> Levels {
        Levels::of_region(Region::whole(size_px))
    }

    #[test]
    fn levels_end_in_one_element() {
        for size_px in [[1, 1], [4, 4], [5, 1], [7, 3], [101, 67], [1920, 1080], [8192, 2048]] {
            let levels = levels(size_px);
            assert_eq!(levels.elements(levels.last()), 1, "{size_px:?}");
        }
        assert_eq!(levels([1920, 1080]).last(), 11);
    }

    #[test]
    fn every_region_takes_one_dispatch_a_level() {
        for size_px in [[8192, 2048], [2048, 8192], [4096, 4096]] {
            assert!(levels(size_px).workgroups(FIRST_LEVEL) < 65_536);
        }
    }

    #[test]
    fn kernels_are_short_and_as_wide_as_they_should_be() {
        for size_px in [[96, 64], [1920, 1080], [4096, 4096]] {
            for radius in [0.005, 0.04, 0.25] {
                for passes in 1..=4 {
                    let kernel = Kernel::new(radius, passes, levels(size_px));
                    assert!(kernel.half_width <= MOST_HALF_WIDTH);
                    // Coarser only where a finer one would be too long.
                    assert!(
                        kernel.level == FIRST_LEVEL || kernel.half_width > MOST_HALF_WIDTH / 2.0
                    );
                    let px = f64::from(kernel.half_width) * f64::from(1_u32 << kernel.level);
                    let variance = f64::from(passes) * px * px;
                    let single = f64::from(radius) * f64::from(size_px[1]);
                    assert!((variance / (single * single) - 1.0).abs() < 1e-5);
                }
            }
        }
    }
}
