//! How a picture is cut into tiles: pure arithmetic, no GPU.
//!
//! Tiles come in reading order, so that each row of them (a band) can be written and
//! forgotten before the next is finished.

use crate::render::{Eyes, Region};

/// A picture cut into tiles of nearly equal size.
#[derive(Clone, Copy, Debug)]
pub struct Tiling {
    picture_px: [u32; 2],
    tile_px: [u32; 2],
    columns: u32,
    rows: u32,
}

impl Tiling {
    /// Cuts `picture_px` into the fewest tiles that are at most `max_tile_px` large, then makes
    /// them as equal as whole pixels allow: buffers are made anew only where sizes differ.
    /// All sides are at least 1.
    pub fn new(picture_px: [u32; 2], max_tile_px: [u32; 2]) -> Self {
        let counts: [u32; 2] =
            std::array::from_fn(|i| picture_px[i].div_ceil(max_tile_px[i].max(1)));
        let tile_px = std::array::from_fn(|i| picture_px[i].div_ceil(counts[i].max(1)));
        // Equal tiles can be so much larger than needed that one fewer of them is enough.
        let [columns, rows] = std::array::from_fn(|i| picture_px[i].div_ceil(tile_px[i]));
        Self { picture_px, tile_px, columns, rows }
    }

    /// How many tiles there are.
    pub fn count(&self) -> u32 {
        self.columns * self.rows
    }

    /// Tile `index` in reading order, below [`Self::count`].
    pub fn tile(&self, index: u32) -> Region {
        let cell = [index % self.columns, index / self.columns];
        let origin_px = std::array::from_fn(|i| cell[i] * self.tile_px[i]);
        let size_px =
            std::array::from_fn(|i| self.tile_px[i].min(self.picture_px[i] - origin_px[i]));
        Region { picture_px: self.picture_px, origin_px, size_px, eyes: Eyes::Camera }
    }

    /// Whether tile `index` is the last of its band.
    pub fn ends_band(&self, index: u32) -> bool {
        index % self.columns == self.columns - 1
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_pixel_is_in_exactly_one_tile() {
        for (picture_px, max_tile_px) in [
            ([101, 67], [32, 24]),
            ([1, 1], [8, 8]),
            ([64, 48], [64, 48]),
            ([7, 9], [3, 1]),
            ([10, 10], [4, 9]),
        ] {
            let tiling = Tiling::new(picture_px, max_tile_px);
            let mut times_covered = vec![0; (picture_px[0] * picture_px[1]) as usize];
            for region in (0..tiling.count()).map(|index| tiling.tile(index)) {
                assert!(region.size_px[0] <= max_tile_px[0] && region.size_px[1] <= max_tile_px[1]);
                for y in 0..region.size_px[1] {
                    for x in 0..region.size_px[0] {
                        let [left, top] = region.origin_px;
                        times_covered[((top + y) * picture_px[0] + left + x) as usize] += 1;
                    }
                }
            }
            assert!(
                times_covered.iter().all(|&times| times == 1),
                "{picture_px:?} in {max_tile_px:?}"
            );
        }
    }

    #[test]
    fn common_sizes_divide_into_equal_tiles() {
        for (picture_px, tile_px) in
            [([1280, 720], [1280, 240]), ([3840, 2160], [1920, 240]), ([16384, 16384], [2048, 256])]
        {
            let tiling = Tiling::new(picture_px, [2048, 256]);
            assert!(
                (0..tiling.count()).all(|index| tiling.tile(index).size_px == tile_px),
                "{picture_px:?}"
            );
        }
    }

    #[test]
    fn bands_end_at_the_right_edge() {
        let tiling = Tiling::new([101, 67], [32, 24]);
        for index in 0..tiling.count() {
            let tile = tiling.tile(index);
            assert_eq!(tiling.ends_band(index), tile.origin_px[0] + tile.size_px[0] == 101);
        }
    }
}
