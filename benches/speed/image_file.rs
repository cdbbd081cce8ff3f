//! PNG files of what both sides draw.

use std::{fs::File, io::BufWriter, path::Path};

use mandelight::scene::color::srgb_from_linear;

use super::literal::LiteralPixel;

/// Writes 8-bit RGBA pixels as a PNG file, rows from the top.
///
/// # Errors
/// If the file can't be written.
pub fn write(
    path: &Path,
    size_px: [u32; 2],
    rgba: &[u8],
) -> Result<(), Box<dyn std::error::Error>> {
    let mut encoder =
        png::Encoder::new(BufWriter::new(File::create(path)?), size_px[0], size_px[1]);
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.write_header()?.write_image_data(rgba)?;
    Ok(())
}

/// The literal kernel's film as RGBA by Reinhard's curve on luminance; transparent where
/// nothing was drawn.
///
/// The views' scenes use the same curve.
pub fn tone_mapped(
    pixels: &[LiteralPixel],
    size_px: [u32; 2],
    exposure: f64,
    white: f64,
) -> Vec<u8> {
    let mut rgba = vec![0; 4 * (size_px[0] * size_px[1]) as usize];
    for LiteralPixel { pixel: [x, y], radiance, .. } in pixels {
        let exposed = radiance.map(|v| f64::from(v) * exposure.exp2());
        let luminance = 0.2126 * exposed[0] + 0.7152 * exposed[1] + 0.0722 * exposed[2];
        let scale = (1.0 + luminance / (white * white)) / (1.0 + luminance);
        let at = 4 * (y * size_px[0] + x) as usize;
        for (channel, value) in exposed.into_iter().enumerate() {
            rgba[at + channel] = encoded(value * scale);
        }
        rgba[at + 3] = 255;
    }
    rgba
}

/// A linear channel as an 8-bit sRGB value.
pub fn encoded(linear: f64) -> u8 {
    (255.0 * srgb_from_linear(linear as f32)).round() as u8
}
