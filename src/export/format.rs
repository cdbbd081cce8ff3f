//! The file formats of pictures, and the readback and encoder of each.

use std::{ffi::OsStr, io::Write, path::Path};

use super::{
    ExportError,
    exr::{self, ExrStream},
    jpeg::JpegStream,
    png::{BitDepth, PngStream},
    webp::WebPStream,
};
use crate::{
    gpu::{
        Gpu,
        readback::{Readback, ReadbackError},
    },
    render::{Region, View, display_values::DisplayValues, samples::SamplesReadback},
    scene::{Camera, Scene, document},
};

/// The file format of a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PictureFormat {
    /// PNG: display values, sRGB, 8 or 16 bits per channel.
    #[default]
    Png,
    /// JPEG: display values, sRGB, 8 bits per channel, with some loss.
    Jpeg,
    /// Lossless WebP: display values, sRGB, 8 bits per channel.
    WebP,
    /// OpenEXR: linear radiance, depth, normal and position, 32 bits per channel.
    Exr,
    /// Rows of display values without a header: red, green and blue, sRGB, 8 bits each, for encoders of
    /// videos.
    Rgb,
}

impl PictureFormat {
    /// The format of a file name, by its extension: `.jpg`, `.jpeg`, `.webp` or `.exr`; else PNG.
    pub fn of(path: &Path) -> Self {
        let extension = path.extension().and_then(OsStr::to_str).unwrap_or_default();
        match extension.to_ascii_lowercase().as_str() {
            "jpg" | "jpeg" => Self::Jpeg,
            "webp" => Self::WebP,
            "exr" => Self::Exr,
            _ => Self::Png,
        }
    }

    /// Whether the format can have an alpha channel.
    pub fn has_alpha(self) -> bool {
        matches!(self, Self::Png | Self::WebP | Self::Exr)
    }

    /// The format's file extension, without the dot.
    pub fn extension(self) -> &'static str {
        match self {
            Self::Png => "png",
            Self::Jpeg => "jpg",
            Self::WebP => "webp",
            Self::Exr => "exr",
            Self::Rgb => "rgb",
        }
    }

    /// The format's media type.
    pub fn media_type(self) -> &'static str {
        match self {
            Self::Png => "image/png",
            Self::Jpeg => "image/jpeg",
            Self::WebP => "image/webp",
            Self::Exr => "image/x-exr",
            Self::Rgb => "application/octet-stream",
        }
    }
}

/// How a file stores pixels.
#[derive(Clone, Copy, Debug)]
pub(super) struct FileEncoding {
    /// The file format.
    pub format: PictureFormat,
    /// Quality of a JPEG, 1 to 100.
    pub quality: u8,
    /// What a display holds, for formats of display values.
    pub values: DisplayValues,
}

impl FileEncoding {
    /// Bytes per pixel of the encoder's input.
    pub fn pixel_bytes(self, has_guides: bool) -> usize {
        match self.format {
            PictureFormat::Exr => exr::bytes_of_pixel(self.values.is_transparent, has_guides),
            _ => self.channels() * self.channel_bytes(),
        }
    }

    /// Channels of a pixel of display values: red, green, blue, and alpha if the background is transparent.
    fn channels(self) -> usize {
        if self.values.is_transparent { 4 } else { 3 }
    }

    fn channel_bytes(self) -> usize {
        if self.values.is_deep { 2 } else { 1 }
    }

    /// Starts the readback of a complete tile; none if the view has no picture yet.
    ///
    /// The view may be overwritten at once.
    pub fn read(self, gpu: &Gpu, view: &View) -> Option<TileReadback> {
        Some(match self.format {
            PictureFormat::Exr => TileReadback::Samples(Box::new(view.read_samples())),
            _ => {
                let [width, height] = view.region().size_px;
                let size_px = [width * self.values.texels_per_pixel(), height];
                TileReadback::Display(Readback::texture(gpu, view.texture()?, size_px))
            }
        })
    }

    /// The pixels of a display in the encoder's format.
    fn pixels(self, texels: &[u8]) -> Vec<u8> {
        let channels = self.channels();
        if !self.values.is_deep {
            let texels = texels.as_chunks::<4>().0.iter();
            return texels.flat_map(|texel| &texel[..channels]).copied().collect();
        }
        let pixels = texels.as_chunks::<8>().0.iter();
        // High bytes, then low bytes; a PNG has them by turns.
        pixels.flat_map(|texels| (0..channels).flat_map(|i| [texels[i], texels[4 + i]])).collect()
    }
}

/// A pending readback of a tile from the GPU.
pub(super) enum TileReadback {
    Display(Readback),
    Samples(Box<SamplesReadback>),
}

impl TileReadback {
    /// The tile's pixels in the encoder's format; none until the copy is complete.
    pub fn take(
        &mut self,
        gpu: &Gpu,
        camera: &Camera,
        tile: Region,
        file: FileEncoding,
    ) -> Result<Option<Vec<u8>>, ReadbackError> {
        Ok(match self {
            Self::Display(readback) => readback.take(gpu)?.map(|texels| file.pixels(&texels)),
            Self::Samples(readback) => {
                readback.take(gpu)?.map(|pixels| exr::pixel_bytes(camera, tile, &pixels))
            }
        })
    }
}

/// A file of display values that are there already, such as those of a view.
///
/// `rgb`: rows from the top; red, green and blue, sRGB, 8 bits each. `quality` is a JPEG's, 1 to 100.
///
/// # Errors
/// [`ExportError::Encode`] if `rgb` has another size, or the format stores more than these values;
/// [`ExportError::WebPSize`].
pub fn encode_rgb(
    format: PictureFormat,
    quality: u8,
    size_px: [u32; 2],
    scene: &Scene,
    rgb: &[u8],
) -> Result<Vec<u8>, ExportError> {
    let file = FileEncoding { format, quality, values: DisplayValues::default() };
    let mut encoder = Encoder::new(file, Vec::new(), size_px, scene)?;
    encoder.write_rows(rgb)?;
    encoder.finish()
}

/// The encoder of a file.
pub(super) enum Encoder<W: Write> {
    Png(Box<PngStream<W>>),
    Jpeg(JpegStream<W>),
    WebP(WebPStream<W>),
    Exr(ExrStream<W>),
    Rgb(W),
}

impl<W: Write> Encoder<W> {
    /// Starts a file and writes its header with `scene`.
    pub fn new(
        FileEncoding { format, quality, values }: FileEncoding,
        sink: W,
        size_px: [u32; 2],
        scene: &Scene,
    ) -> Result<Self, ExportError> {
        let document = || document::to_json_compact(scene);
        Ok(match format {
            PictureFormat::Png => {
                let depth = if values.is_deep { BitDepth::Sixteen } else { BitDepth::Eight };
                let has_alpha = values.is_transparent;
                let png = PngStream::with_layout(sink, size_px, &document(), depth, has_alpha)?;
                Self::Png(Box::new(png))
            }
            PictureFormat::Jpeg => {
                Self::Jpeg(JpegStream::new(sink, size_px, &document(), quality)?)
            }
            PictureFormat::WebP => {
                Self::WebP(WebPStream::new(sink, size_px, &document(), values.is_transparent)?)
            }
            PictureFormat::Exr => {
                let has_alpha = values.is_transparent;
                Self::Exr(ExrStream::with_alpha(sink, size_px, scene, has_alpha)?)
            }
            PictureFormat::Rgb => Self::Rgb(sink),
        })
    }

    /// Appends whole rows of pixels.
    pub fn write_rows(&mut self, pixels: &[u8]) -> Result<(), ExportError> {
        match self {
            Self::Png(png) => png.write_pixels(pixels),
            Self::Jpeg(jpeg) => jpeg.write_rgb(pixels),
            Self::WebP(webp) => webp.write_pixels(pixels),
            Self::Exr(exr) => exr.write_rows(pixels),
            Self::Rgb(sink) => Ok(sink.write_all(pixels)?),
        }
    }

    /// Writes the end of the file and returns the flushed sink.
    pub fn finish(self) -> Result<W, ExportError> {
        match self {
            Self::Png(png) => png.finish(),
            Self::Jpeg(jpeg) => jpeg.finish(),
            Self::WebP(webp) => webp.finish(),
            Self::Exr(exr) => exr.finish(),
            Self::Rgb(mut sink) => {
                sink.flush()?;
                Ok(sink)
            }
        }
    }
}
