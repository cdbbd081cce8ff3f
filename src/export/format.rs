//! What kinds of picture there are, and what each wants to know of a tile.

use std::{io::Write, path::Path};

use super::{
    ExportError,
    exr::{self, ExrStream},
    png::PngStream,
};
use crate::{
    gpu::{
        Gpu,
        readback::{Readback, ReadbackError},
    },
    render::{Region, View, samples::SamplesReadback},
    scene::{Camera, Scene, document},
};

/// The kind of a picture's file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PictureFormat {
    /// What is seen: 8 bits a channel, sRGB.
    #[default]
    Png,
    /// What the renderer knows: linear radiance, depth, normal and position, 32 bits a channel.
    Exr,
}

impl PictureFormat {
    /// The format that a file's name asks for: PNG unless it ends in `.exr`.
    pub fn of(path: &Path) -> Self {
        let is_exr = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("exr"));
        if is_exr { Self::Exr } else { Self::Png }
    }

    /// How names of such files end, without the dot.
    pub fn extension(self) -> &'static str {
        match self {
            Self::Png => "png",
            Self::Exr => "exr",
        }
    }

    /// The files' media type.
    pub fn media_type(self) -> &'static str {
        match self {
            Self::Png => "image/png",
            Self::Exr => "image/x-exr",
        }
    }

    /// Bytes of a pixel on its way into a file.
    pub(super) fn pixel_bytes(self) -> usize {
        match self {
            Self::Png => 3,
            Self::Exr => exr::PIXEL_BYTES,
        }
    }

    /// Starts to read a finished tile back. The view may be drawn over at once; none before it
    /// has a picture.
    pub(super) fn read(self, gpu: &Gpu, view: &View) -> Option<Arriving> {
        Some(match self {
            Self::Png => {
                let size_px = view.region().size_px;
                Arriving::Display(Readback::texture(gpu, view.texture()?, size_px))
            }
            Self::Exr => Arriving::Samples(view.read_samples()),
        })
    }
}

/// A tile on its way back from the GPU.
pub(super) enum Arriving {
    Display(Readback),
    Samples(SamplesReadback),
}

impl Arriving {
    /// The tile's pixels as a file takes them, once they have arrived; none before.
    pub fn take(
        &mut self,
        gpu: &Gpu,
        camera: &Camera,
        tile: Region,
    ) -> Result<Option<Vec<u8>>, ReadbackError> {
        Ok(match self {
            Self::Display(readback) => readback.take(gpu)?.map(|rgba| {
                rgba.as_chunks::<4>().0.iter().flat_map(|&[r, g, b, _]| [r, g, b]).collect()
            }),
            Self::Samples(readback) => {
                readback.take(gpu)?.map(|pixels| exr::pixel_bytes(camera, tile, &pixels))
            }
        })
    }
}

/// A file of either kind in the making.
pub(super) enum Encoder<W: Write> {
    Png(Box<PngStream<W>>),
    Exr(ExrStream<W>),
}

impl<W: Write> Encoder<W> {
    /// Starts a file and writes its header, with `scene` in it.
    pub fn new(
        format: PictureFormat,
        sink: W,
        size_px: [u32; 2],
        scene: &Scene,
    ) -> Result<Self, ExportError> {
        Ok(match format {
            PictureFormat::Png => Self::Png(Box::new(PngStream::new(
                sink,
                size_px,
                &document::to_json_compact(scene),
            )?)),
            PictureFormat::Exr => Self::Exr(ExrStream::new(sink, size_px, scene)?),
        })
    }

    /// Adds whole rows of pixels.
    pub fn write_rows(&mut self, pixels: &[u8]) -> Result<(), ExportError> {
        match self {
            Self::Png(png) => png.write_rgb(pixels),
            Self::Exr(exr) => exr.write_rows(pixels),
        }
    }

    /// Writes the end of the file and gives the flushed sink back.
    pub fn finish(self) -> Result<W, ExportError> {
        match self {
            Self::Png(png) => png.finish(),
            Self::Exr(exr) => exr.finish(),
        }
    }
}
