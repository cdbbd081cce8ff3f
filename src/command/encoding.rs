//! Options of the files that hold pictures.
//!
//! In: arguments. Out: a format and its settings in [`StillOptions`], or a failure where they do not fit.

use clap::ValueEnum;
use mandelight::export::{PictureFormat, StillOptions};

use super::Failure;

/// The arguments that say how pictures are stored.
#[derive(clap::Args)]
pub struct EncodingArguments {
    /// Quality of JPEGs, 1 to 100: higher values lose less; 92 unless given
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u8).range(1..=100))]
    quality: Option<u8>,
    /// Bits per channel of PNGs: 8, or 16 for later edits
    #[arg(long, value_name = "N", default_value = "8", value_parser = ["8", "16"])]
    bits: String,
    /// Make the background transparent, with smooth edges: PNG, WebP and OpenEXR
    #[arg(long)]
    transparent: bool,
}

impl EncodingArguments {
    /// Sets the format and what these arguments say of it.
    ///
    /// # Errors
    /// An argument that the format does not have.
    pub fn apply(&self, format: PictureFormat, options: &mut StillOptions) -> Result<(), Failure> {
        options.format = format;
        if let Some(quality) = self.quality {
            if format != PictureFormat::Jpeg {
                return Err(Failure::usage(
                    "--quality: only JPEGs have a quality (out.jpg, or --format jpeg for frames)",
                ));
            }
            options.quality = quality;
        }
        options.is_deep = self.bits == "16";
        options.is_transparent = self.transparent;
        Ok(())
    }
}

/// The file formats of frames.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum FrameFormat {
    /// PNG
    Png,
    /// JPEG
    #[value(alias = "jpg")]
    Jpeg,
    /// Lossless WebP
    Webp,
    /// OpenEXR
    Exr,
}

impl FrameFormat {
    /// The format of the frames' files.
    pub fn picture_format(self) -> PictureFormat {
        match self {
            Self::Png => PictureFormat::Png,
            Self::Jpeg => PictureFormat::Jpeg,
            Self::Webp => PictureFormat::WebP,
            Self::Exr => PictureFormat::Exr,
        }
    }
}
