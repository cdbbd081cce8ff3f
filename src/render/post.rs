//! Post passes: statistics of the whole film (mean, histogram), exposure and bloom.
//!
//! In: a film. Out: the statistics, and the mip level with the bloom, which [`tone`](super::pass::tone)
//! reads. Both belong to the whole picture: a view of a tile uses the [`Post`] of a view of the whole
//! picture ([`View::lend_post`](super::View::lend_post)), and looks its pixels up by
//! their position in the picture.
//!
//! The finest mip level has one element per 4×4 pixels. The levels serve twice in one submit: for the
//! mean, which ends in the statistics, then for the bloom. Bytes per pixel: 4/3 for the levels, 1
//! more for the blur; buffers that the scene does not need are not allocated.

use crate::gpu::host_shared::HostShared;

use super::{
    buffers,
    lattice::WORKGROUP_THREADS,
    layouts::Layouts,
    region::Region,
    report::Histogram,
    uniforms::{FrameUniforms, Statistics},
};
use crate::scene::Scene;

/// The finest mip level: one element per 4×4 pixels.
pub const FIRST_LEVEL: u32 = 2;

/// Greatest half width of a blur's kernel, in elements of its mip level.
///
/// A coarser level is faster; a finer level follows moving light in smaller steps.
pub const MAX_HALF_WIDTH: f32 = 6.0;

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

    /// What the tone pass of a scene's pictures reads.
    pub fn of_scene(scene: &Scene) -> Self {
        Self { mean: scene.tone.auto_exposure, bloom: scene.bloom.strength as f32 > 0.0 }
    }

    /// True if no statistics are needed.
    pub fn is_none(self) -> bool {
        self == Self::default()
    }
}

/// Statistics and mip levels of a film of one size.
pub struct Post {
    levels: Levels,
    need: Need,
    /// The buffer of [`Statistics`].
    pub statistics: wgpu::Buffer,
    /// 4 × f32 an element: the levels from [`FIRST_LEVEL`] on, rows packed.
    pub mips: wgpu::Buffer,
    half_blurred: wgpu::Buffer,
    /// The bind group of all three buffers.
    pub group: wgpu::BindGroup,
}

impl Post {
    /// Allocates the buffers that `need` requires for the film of `region`.
    pub fn new(layouts: &Layouts, region: Region, need: Need) -> Self {
        let levels = Levels::of_region(region);
        let bytes = Statistics::SIZE as u64;
        let statistics = buffers::storage(&layouts.gpu.device, "statistics", bytes);
        // New buffers hold zeros; no pass writes the size.
        layouts.gpu.queue.write_buffer(&statistics, 0, &levels.eye_px.to_bytes());
        Self::around(layouts, levels, need, statistics)
    }

    /// Buffers of the same film for another `need`, with the same statistics.
    ///
    /// Auto exposure continues from its current value.
    pub fn with_need(&self, layouts: &Layouts, need: Need) -> Self {
        Self::around(layouts, self.levels, need, self.statistics.clone())
    }

    fn around(layouts: &Layouts, levels: Levels, need: Need, statistics: wgpu::Buffer) -> Self {
        let device = &layouts.gpu.device;
        let finest = u64::from(levels.elements(FIRST_LEVEL));
        let all: u64 = (FIRST_LEVEL..=levels.last()).map(|n| u64::from(levels.elements(n))).sum();
        let room = |wanted: bool, count: u64| ELEMENT_BYTES * if wanted { count } else { 1 };
        let mips = buffers::storage(device, "mip levels", room(!need.is_none(), all));
        let half_blurred = buffers::storage(device, "half blurred", room(need.bloom, finest));
        let group = buffers::group(
            device,
            &layouts.post,
            "post",
            [&statistics, &mips, &half_blurred].map(wgpu::Buffer::as_entire_binding),
        );
        Self { levels, need, statistics, mips, half_blurred, group }
    }

    /// The statistics that the buffers have room for.
    pub fn need(&self) -> Need {
        self.need
    }

    /// GPU memory of the mip levels, and of the blur's own buffer, in bytes.
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
    /// How far auto exposure moves toward its goal, above 0 to 1; none keeps it.
    pub adapt: Option<f32>,
    /// The light that blooms.
    pub bloom: bool,
}

/// The layout of a film's mip levels. Twin of `shaders/lib/mip.wgsl`.
///
/// Each eye's part of the film has its own elements, so that no element mixes light of both eyes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Levels {
    /// Width and height of one eye's part, in pixels.
    eye_px: [u32; 2],
    /// Columns and rows of eyes.
    eyes: [u32; 2],
}

impl Levels {
    /// The mip levels of a region's film.
    pub fn of_region(region: Region) -> Self {
        Self { eye_px: region.size_px, eyes: region.second_eye_at().map(|at| 1 + at.min(1)) }
    }

    /// The mip levels of the film that a picture's passes write.
    pub fn of(picture: &FrameUniforms) -> Self {
        let eyes = picture.eyes.second_at.map(|at| 1 + at.min(1));
        Self { eye_px: std::array::from_fn(|i| picture.size_px[i] / eyes[i]), eyes }
    }

    /// The coarsest level, with one element per eye.
    pub fn last(self) -> u32 {
        let longest = self.eye_px[0].max(self.eye_px[1]).max(1);
        longest.next_power_of_two().trailing_zeros().max(FIRST_LEVEL)
    }

    /// Number of elements of a level: as many as cover the film.
    pub fn elements(self, level: u32) -> u32 {
        let eyes: u32 = self.eyes.iter().product();
        eyes * self.eye_px.map(|side| side.div_ceil(1 << level)).iter().product::<u32>()
    }

    /// Number of workgroups of a dispatch over a level's elements.
    ///
    /// Fewer than 65,536 for any region that [fits](super::Region::fits).
    pub fn workgroups(self, level: u32) -> u32 {
        self.elements(level).div_ceil(WORKGROUP_THREADS)
    }
}

/// A uniform kernel: its mip level, and its half width in that level's elements.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BlurKernel {
    /// The mip level.
    pub level: u32,
    /// Half the width, in elements; at most [`MAX_HALF_WIDTH`] unless the level is the last.
    pub half_width: f32,
}

impl BlurKernel {
    /// The kernel for a radius relative to the height of an eye's picture.
    ///
    /// Applied `passes` times, it spreads light with the variance of a single kernel of that half width.
    pub fn new(radius: f32, passes: u32, levels: Levels) -> Self {
        let half_width_px = radius * levels.eye_px[1] as f32 / (passes.max(1) as f32).sqrt();
        let at = |level: u32| half_width_px / (1_u32 << level) as f32;
        let last = levels.last();
        let level = (FIRST_LEVEL..last).find(|&n| at(n) <= MAX_HALF_WIDTH).unwrap_or(last);
        Self { level, half_width: at(level) }
    }
}

/// The histogram in the bytes of [`Statistics`].
pub(super) fn histogram(bytes: &[u8]) -> Option<Histogram> {
    let bytes = bytes.get(..Statistics::SIZE)?;
    let statistics = Statistics::read(bytes);
    Some(Histogram { bins: (*statistics.bins).into(), adapted_stops: statistics.adapted_stops })
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
                    let kernel = BlurKernel::new(radius, passes, levels(size_px));
                    assert!(kernel.half_width <= MAX_HALF_WIDTH);
                    // The level is coarser only if a finer level's kernel would be too wide.
                    assert!(
                        kernel.level == FIRST_LEVEL || kernel.half_width > MAX_HALF_WIDTH / 2.0
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
