//! Division of a sheet of pictures into tiles: pure arithmetic, no GPU.
//!
//! Tiles are in reading order, so that each row of tiles (a band) can be written and freed before
//! the next band is complete.

use super::sheet::Sheet;
use crate::render::{Region, lattice::WORKGROUP_SIDE};

/// A sheet divided into tiles of nearly equal size. Each tile is a part of one picture.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tiling {
    sheet: Sheet,
    tile_px: [u32; 2],
    /// Columns and rows of tiles in each picture.
    columns: u32,
    rows: u32,
    /// Pixels around a tile that are rendered too.
    apron_px: u32,
}

/// One tile of a sheet.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tile {
    /// The part of the picture that the tile shows.
    pub region: Region,
    /// The part that is rendered: the tile with its apron, as far as the picture goes.
    pub rendered: Region,
    /// Distance from the sheet's left edge, pixels.
    pub left_px: u32,
    /// True for the last tile of a band.
    pub ends_band: bool,
}

impl Tiling {
    /// Divides every picture into the fewest tiles of at most `max_tile_px`.
    ///
    /// The tiles are as equal as whole pixels allow, because the view reallocates its buffers when
    /// the size changes; with aprons it changes at the picture's edges. All sides are at least 1.
    /// Tiles start at multiples of the workgroup's side, so that rays form the same cones as in the
    /// whole picture; smaller tiles are not aligned.
    ///
    /// `apron_px`: how far beyond a tile its pixels depend on the picture, a multiple of the workgroup's side.
    pub fn new(sheet: Sheet, max_tile_px: [u32; 2], apron_px: u32) -> Self {
        let picture_px = sheet.picture_px;
        let tile_px = std::array::from_fn(|i| {
            let side = if max_tile_px[i] < WORKGROUP_SIDE { 1 } else { WORKGROUP_SIDE };
            let max_px = (max_tile_px[i].max(1) / side) * side;
            let count = picture_px[i].div_ceil(max_px).max(1);
            picture_px[i].div_ceil(count).next_multiple_of(side)
        });
        // Rounding up to workgroups can make one tile fewer enough.
        let [columns, rows] = std::array::from_fn(|i| picture_px[i].div_ceil(tile_px[i]));
        Self { sheet, tile_px, columns, rows, apron_px }
    }

    /// One tile for each picture.
    pub fn whole(sheet: Sheet) -> Self {
        Self::new(sheet, sheet.picture_px.map(|px| px.next_multiple_of(WORKGROUP_SIDE)), 0)
    }

    /// The sheet.
    pub fn sheet(&self) -> Sheet {
        self.sheet
    }

    /// Width and height of the whole sheet, pixels.
    pub fn sheet_px(&self) -> [u32; 2] {
        self.sheet.size_px()
    }

    /// Number of tiles.
    pub fn count(&self) -> u32 {
        self.columns * self.rows * self.sheet.pictures.len() as u32
    }

    /// Tile `index` in reading order, below [`Self::count`].
    pub fn tile(&self, index: u32) -> Tile {
        let band_tiles = self.columns * self.sheet.columns;
        let (band, column) = (index / band_tiles, index % band_tiles);
        let picture_column = column / self.columns;
        let picture = band / self.rows * self.sheet.columns + picture_column;
        let cell = [column % self.columns, band % self.rows];
        let picture_px = self.sheet.picture_px;
        let origin_px = std::array::from_fn(|i| cell[i] * self.tile_px[i]);
        let size_px = std::array::from_fn(|i| self.tile_px[i].min(picture_px[i] - origin_px[i]));
        let eyes = self.sheet.pictures[picture as usize];
        let start = origin_px.map(|px| px.saturating_sub(self.apron_px));
        let rendered_px = std::array::from_fn(|i| {
            (origin_px[i] + size_px[i] + self.apron_px).min(picture_px[i]) - start[i]
        });
        Tile {
            region: Region { picture_px, origin_px, size_px, eyes },
            rendered: Region { picture_px, origin_px: start, size_px: rendered_px, eyes },
            left_px: picture_column * picture_px[0] + origin_px[0],
            ends_band: column == band_tiles - 1,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::Eyes;

    fn cut(picture_px: [u32; 2], max_tile_px: [u32; 2]) -> Tiling {
        Tiling::new(Sheet::single(picture_px), max_tile_px, 0)
    }

    #[test]
    fn every_pixel_is_in_exactly_one_tile() {
        for (picture_px, max_tile_px) in [
            ([101, 67], [32, 24]),
            ([1, 1], [8, 8]),
            ([64, 48], [64, 48]),
            ([7, 9], [3, 1]),
            ([10, 10], [4, 9]),
        ] {
            let tiling = cut(picture_px, max_tile_px);
            let mut times_covered = vec![0; (picture_px[0] * picture_px[1]) as usize];
            for region in (0..tiling.count()).map(|index| tiling.tile(index).region) {
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
    fn common_sizes_are_divided_into_equal_tiles() {
        for (picture_px, tile_px) in
            [([1280, 720], [1280, 240]), ([3840, 2160], [1920, 240]), ([16384, 16384], [2048, 256])]
        {
            let tiling = cut(picture_px, [2048, 256]);
            assert!(
                (0..tiling.count()).all(|index| tiling.tile(index).region.size_px == tile_px),
                "{picture_px:?}"
            );
        }
    }

    #[test]
    fn bands_end_at_the_right_edge() {
        let tiling = cut([101, 67], [32, 24]);
        for index in 0..tiling.count() {
            let Tile { region, ends_band, left_px, .. } = tiling.tile(index);
            assert_eq!(ends_band, region.origin_px[0] + region.size_px[0] == 101);
            assert_eq!(left_px, region.origin_px[0]);
        }
    }

    /// The bands fill a sheet from top to bottom without a gap.
    #[test]
    fn tiles_of_both_eyes_fill_their_sheet_in_row_order() {
        for columns in [1, 2] {
            let pictures = &[Eyes::Left, Eyes::Right];
            let sheet = Sheet { picture_px: [101, 67], pictures, columns };
            let tiling = Tiling::new(sheet, [32, 24], 0);
            let [width, height] = tiling.sheet_px();
            let (mut x, mut y) = (0, 0);
            for tile in (0..tiling.count()).map(|index| tiling.tile(index)) {
                let Region { picture_px, origin_px, size_px, eyes } = tile.region;
                assert_eq!(tile.left_px, x);
                x += size_px[0];
                let (right, below) = (tile.left_px / 101 == 1, y / 67 == 1);
                assert_eq!(eyes, if right || below { Eyes::Right } else { Eyes::Left });
                assert_eq!(([tile.left_px % 101, y % 67], picture_px), (origin_px, [101, 67]));
                assert_eq!(tile.ends_band, x == width);
                if tile.ends_band {
                    y += size_px[1];
                    x = 0;
                }
            }
            assert_eq!(y, height);
        }
    }

    #[test]
    fn aprons_end_at_the_pictures_edges() {
        let tiling = Tiling::new(Sheet::single([100, 60]), [40, 24], 8);
        for index in 0..tiling.count() {
            let Tile { region, rendered, .. } = tiling.tile(index);
            for axis in 0..2 {
                let start = region.origin_px[axis];
                let end = start + region.size_px[axis];
                assert_eq!(rendered.origin_px[axis], start.saturating_sub(8));
                let rendered_end = rendered.origin_px[axis] + rendered.size_px[axis];
                assert_eq!(rendered_end, (end + 8).min(region.picture_px[axis]));
            }
        }
    }
}
