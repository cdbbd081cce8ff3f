//! Pictures from two GPUs, and their difference.

use std::{fs::File, io::BufReader, path::Path};

use image::{
    Rgba, RgbaImage,
    imageops::{self, FilterType},
};
use mandelight_test_support::beauty::Beauty;

/// An RGBA picture, eight bits a channel, row by row from the top.
pub struct Picture {
    /// Width and height in pixels.
    pub size_px: [u32; 2],
    /// Four bytes a pixel, row by row from the top.
    pub rgba: Vec<u8>,
}

/// The difference between two pictures.
#[derive(Debug)]
pub struct Difference {
    /// Mean absolute difference of the colour channels, in 8-bit steps (0 to 255).
    pub mean: f64,
    /// Fraction of pixels with a channel over [`Difference::NOTABLE`] steps apart.
    pub notable: f64,
}

impl Difference {
    /// 8-bit steps that are visible on a smooth surface.
    pub const NOTABLE: u8 = 12;
}

impl Picture {
    /// A picture of `size_px` from its RGBA bytes.
    pub fn new(size_px: [u32; 2], rgba: Vec<u8>) -> Self {
        assert_eq!(rgba.len(), 4 * size_px[0] as usize * size_px[1] as usize);
        Self { size_px, rgba }
    }

    /// Reads a PNG as eight bits a channel.
    pub fn read_png(file: &Path) -> Self {
        let file = BufReader::new(File::open(file).unwrap());
        let mut decoder = png::Decoder::new(file);
        decoder.set_transformations(png::Transformations::ALPHA | png::Transformations::STRIP_16);
        let mut reader = decoder.read_info().unwrap();
        let mut rgba = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut rgba).unwrap();
        assert_eq!(info.color_type, png::ColorType::Rgba);
        Self::new([info.width, info.height], rgba)
    }

    /// The part of `size_px` whose upper left corner is at `corner`.
    pub fn crop(&self, corner: [u32; 2], size_px: [u32; 2]) -> Self {
        let width = self.size_px[0] as usize;
        let [left, top] = corner.map(|at| at as usize);
        let [columns, rows] = size_px.map(|side| side as usize);
        let row = |y: usize| {
            let start = 4 * ((top + y) * width + left);
            &self.rgba[start..start + 4 * columns]
        };
        Self::new(size_px, (0..rows).flat_map(row).copied().collect())
    }

    /// The picture with one pixel for `factor` × `factor` pixels.
    pub fn shrunk(&self, factor: u32) -> Self {
        let [width, height] = self.size_px;
        let picture = RgbaImage::from_raw(width, height, self.rgba.clone()).expect("all pixels");
        let size_px = self.size_px.map(|side| side / factor);
        let small = imageops::resize(&picture, size_px[0], size_px[1], FilterType::Triangle);
        Self::new(size_px, small.into_raw())
    }

    /// The difference between this picture and `other`, of the same size.
    pub fn difference(&self, other: &Self) -> Difference {
        assert_eq!(self.size_px, other.size_px);
        let (mut sum, mut notable) = (0_u64, 0_usize);
        let pixels = self.rgba.chunks_exact(4).zip(other.rgba.chunks_exact(4));
        let count = pixels.len();
        for (a, b) in pixels {
            let steps: [u8; 3] = std::array::from_fn(|i| a[i].abs_diff(b[i]));
            sum += steps.iter().map(|&step| u64::from(step)).sum::<u64>();
            notable += usize::from(steps.iter().any(|&step| step > Difference::NOTABLE));
        }
        Difference { mean: sum as f64 / (3 * count) as f64, notable: notable as f64 / count as f64 }
    }

    /// Measures of whether the picture is worth seeing, at the height that their limits are for.
    pub fn beauty(&self) -> Beauty {
        let [width, height] = self.size_px;
        let picture = RgbaImage::from_raw(width, height, self.rgba.clone()).expect("all pixels");
        let small_width = (width * Beauty::HEIGHT_PX).div_ceil(height);
        let small =
            imageops::resize(&picture, small_width, Beauty::HEIGHT_PX, FilterType::Triangle);
        let rgb: Vec<[u8; 3]> = small.pixels().map(|&Rgba([r, g, b, _])| [r, g, b]).collect();
        Beauty::of(&rgb, small_width as usize)
    }

    /// The mean of each channel, 0 to 255.
    pub fn mean_color(&self) -> [f64; 3] {
        let pixels = self.rgba.chunks_exact(4);
        let count = pixels.len() as f64;
        let sum = |i: usize| pixels.clone().map(|pixel| f64::from(pixel[i])).sum::<f64>();
        [0, 1, 2].map(|i| sum(i) / count)
    }

    /// Standard deviation of brightness (0 to 255); near zero for an empty picture.
    pub fn contrast(&self) -> f64 {
        let greys = || {
            self.rgba.chunks_exact(4).map(|p| f64::from(p[0]) + f64::from(p[1]) + f64::from(p[2]))
        };
        let count = (self.rgba.len() / 4) as f64;
        let mean = greys().sum::<f64>() / count;
        (greys().map(|grey| (grey - mean).powi(2)).sum::<f64>() / count).sqrt() / 3.0
    }
}
