//! Composition of pictures: reads the renderer's files, and writes montages.
//!
//! In: PNG and OpenEXR files. Out: PNG files, RGBA, 8 bits per channel.

use std::{fs::File, io::BufReader, path::Path};

use anyhow::{Context as _, Result, bail};

use super::table::Layer;

/// A picture, sRGB with alpha, rows from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    size_px: [u32; 2],
    pixels: Vec<[u8; 4]>,
}

impl Image {
    /// A transparent picture.
    fn transparent(size_px: [u32; 2]) -> Self {
        Self { size_px, pixels: vec![[0; 4]; (size_px[0] * size_px[1]) as usize] }
    }

    /// Reads a PNG of the renderer: RGB or RGBA, 8 bits per channel.
    pub fn read_png(file: &Path) -> Result<Self> {
        let mut reader = png::Decoder::new(BufReader::new(File::open(file)?)).read_info()?;
        let mut bytes = vec![0; reader.output_buffer_size().context("it is too large")?];
        let info = reader.next_frame(&mut bytes)?;
        let pixels = match (info.color_type, info.bit_depth) {
            (png::ColorType::Rgb, png::BitDepth::Eight) => {
                bytes.as_chunks::<3>().0.iter().map(|&[r, g, b]| [r, g, b, 255]).collect()
            }
            (png::ColorType::Rgba, png::BitDepth::Eight) => bytes.as_chunks::<4>().0.to_vec(),
            _ => bail!("{} is not 8-bit RGB or RGBA", file.display()),
        };
        Ok(Self { size_px: [info.width, info.height], pixels })
    }

    /// Width and height in pixels, and RGBA bytes.
    pub fn as_rgba(&self) -> ([u32; 2], &[u8]) {
        (self.size_px, self.pixels.as_flattened())
    }

    /// Replaces each pixel by a function of its place and value.
    pub fn map(&mut self, change: impl Fn([u32; 2], [u8; 4]) -> [u8; 4]) {
        let width = self.size_px[0];
        for (index, pixel) in (0..).zip(&mut self.pixels) {
            *pixel = change([index % width, index / width], *pixel);
        }
    }

    /// Reads the depth or the normals of an OpenEXR file of the renderer.
    ///
    /// Near points are bright, far points dark. A normal's axes from −1 to 1 become channels from
    /// 0 to 255. The background is transparent.
    pub fn read_exr(file: &Path, layer: Layer) -> Result<Self> {
        let image = exr::prelude::read_first_flat_layer_from_file(file)?;
        let size = image.layer_data.size;
        let channels = &image.layer_data.channel_data.list;
        let channel = |name: &str| -> Result<Vec<f32>> {
            let found = channels.iter().find(|channel| channel.name == *name);
            let found = found.with_context(|| format!("it has no channel {name}"))?;
            Ok(found.sample_data.values_as_f32().collect())
        };
        let depth = channel("Z")?;
        let normal = [channel("N.X")?, channel("N.Y")?, channel("N.Z")?];
        let hits = || depth.iter().copied().filter(|depth| depth.is_finite());
        let (near, far) = (hits().fold(f32::MAX, f32::min), hits().fold(f32::MIN, f32::max));
        let byte = |value: f32| (value.clamp(0.0, 1.0) * 255.0).round() as u8;
        let show = |i: usize| match layer {
            _ if !depth[i].is_finite() => [0; 4],
            Layer::Normal => {
                let [x, y, z] = [0, 1, 2].map(|axis: usize| byte(normal[axis][i] * 0.5 + 0.5));
                [x, y, z, 255]
            }
            Layer::Color | Layer::Depth => {
                let grey =
                    byte(1.0 - 0.9 * (depth[i] - near) / (far - near).max(f32::MIN_POSITIVE));
                [grey, grey, grey, 255]
            }
        };
        let pixels = (0..depth.len()).map(show).collect();
        Ok(Self { size_px: [size.0 as u32, size.1 as u32], pixels })
    }

    /// Writes a PNG.
    pub fn write(&self, file: &Path) -> Result<()> {
        let [width, height] = self.size_px;
        let mut encoder = png::Encoder::new(File::create(file)?, width, height);
        encoder.set_color(png::ColorType::Rgba);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_compression(png::Compression::High);
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
        let mut writer = encoder.write_header()?;
        writer.write_image_data(self.pixels.as_flattened())?;
        Ok(writer.finish()?)
    }

    fn paste(&mut self, part: &Image, [left, top]: [u32; 2]) {
        let [width, height] = part.size_px;
        for y in 0..height {
            let from = (y * width) as usize;
            let to = ((top + y) * self.size_px[0] + left) as usize;
            let row = &part.pixels[from..from + width as usize];
            self.pixels[to..to + width as usize].copy_from_slice(row);
        }
    }
}

/// Panels of one size in rows of `columns`, with gaps of `gap_px`.
pub fn montage(panels: &[Image], columns: u32, gap_px: u32) -> Image {
    let [width, height] = panels.first().map_or([0, 0], |panel| panel.size_px);
    let rows = (panels.len() as u32).div_ceil(columns);
    let total = |side: u32, count: u32| side * count + gap_px * (count - 1);
    let mut picture = Image::transparent([total(width, columns), total(height, rows)]);
    for (i, panel) in panels.iter().enumerate() {
        let (column, row) = (i as u32 % columns, i as u32 / columns);
        picture.paste(panel, [column * (width + gap_px), row * (height + gap_px)]);
    }
    picture
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn panels_are_in_rows_with_transparent_gaps() {
        let plain = |level| Image { size_px: [2, 1], pixels: vec![[level, 0, 0, 255]; 2] };
        let picture = montage(&[plain(1), plain(2), plain(3), plain(4)], 2, 1);
        assert_eq!(picture.size_px, [5, 3]);
        let levels: Vec<u8> = picture.pixels.iter().map(|pixel| pixel[0]).collect();
        assert_eq!(levels, [1, 1, 0, 2, 2, 0, 0, 0, 0, 0, 3, 3, 0, 4, 4]);
        let transparent = picture.pixels.iter().filter(|pixel| pixel[3] == 0).count();
        assert_eq!(transparent, 15 - 8);
    }
}
