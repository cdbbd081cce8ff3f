//! Pictures from two GPUs, and how far apart they are.

use std::{fs::File, io::BufReader, path::Path};

/// An RGBA picture, eight bits a channel, row by row from the top.
pub struct Picture {
    /// Width and height in pixels.
    pub size_px: [u32; 2],
    /// Four bytes a pixel.
    pub rgba: Vec<u8>,
}

/// How far apart two pictures are.
#[derive(Debug)]
pub struct Difference {
    /// Mean of the absolute differences of all colour channels, in steps of 8 bits (0 to 255).
    pub mean: f64,
    /// Part of the pixels of which some channel differs by more than [`Difference::NOTABLE`] steps.
    pub notable: f64,
}

impl Difference {
    /// Steps that are seen where a surface is smooth.
    pub const NOTABLE: u8 = 12;
}

impl Picture {
    /// A picture of `size_px` from its bytes.
    pub fn new(size_px: [u32; 2], rgba: Vec<u8>) -> Self {
        assert_eq!(rgba.len(), 4 * size_px[0] as usize * size_px[1] as usize);
        Self { size_px, rgba }
    }

    /// Reads a PNG of eight bits a channel.
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

    /// How far `other`, of the same size, is from this picture.
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

    /// Standard deviation of brightness (0 to 255): next to nothing for an empty picture.
    pub fn contrast(&self) -> f64 {
        let greys = || {
            self.rgba.chunks_exact(4).map(|p| f64::from(p[0]) + f64::from(p[1]) + f64::from(p[2]))
        };
        let count = (self.rgba.len() / 4) as f64;
        let mean = greys().sum::<f64>() / count;
        (greys().map(|grey| (grey - mean).powi(2)).sum::<f64>() / count).sqrt() / 3.0
    }
}
