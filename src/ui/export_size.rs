//! The size and the format of saved pictures.

use serde::{Deserialize, Serialize};

use crate::scene::StereoLayout;

/// Maximum width or height of a saved picture, in pixels.
pub const MAX_EXPORT_SIDE_PX: u32 = 16384;

/// Default quality of a JPEG, 1 to 100.
pub const DEFAULT_QUALITY: u8 = 92;

/// The file format of a saved picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum StillFormat {
    /// PNG.
    #[default]
    Png,
    /// JPEG.
    Jpeg,
    /// Lossless WebP.
    #[serde(rename = "webp")]
    WebP,
    /// OpenEXR.
    Exr,
}

impl StillFormat {
    /// All formats, each with its name and what it is for.
    pub const ALL: [(Self, &str, &str); 4] = [
        (Self::Png, "PNG", "The picture as you see it, without loss"),
        (Self::Jpeg, "JPEG", "The picture as you see it, in a small file"),
        (Self::WebP, "WebP", "The picture as you see it, without loss, for the web"),
        (
            Self::Exr,
            "EXR",
            "For other programs: light before exposure and tone, depth, normals and positions, 32 bits per channel",
        ),
    ];

    /// Whether the background can be transparent.
    pub fn has_alpha(self) -> bool {
        matches!(self, Self::Png | Self::WebP | Self::Exr)
    }

    /// The format's name with its article.
    pub fn article_and_name(self) -> &'static str {
        match self {
            Self::Png => "a PNG",
            Self::Jpeg => "a JPEG",
            Self::WebP => "a WebP",
            Self::Exr => "an OpenEXR file",
        }
    }
}

/// How a saved picture is stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct StillFile {
    /// The file format.
    pub format: StillFormat,
    /// Quality of a JPEG, 1 to 100.
    pub quality: u8,
    /// True for 16 bits per channel of a PNG.
    pub deep_png: bool,
    /// True for a transparent background, if the format can have one.
    pub no_background: bool,
}

impl StillFile {
    /// True for 16 bits per channel.
    pub fn is_deep(&self) -> bool {
        self.deep_png && self.format == StillFormat::Png
    }

    /// True for a transparent background.
    pub fn is_transparent(&self) -> bool {
        self.no_background && self.format.has_alpha()
    }
}

impl Default for StillFile {
    fn default() -> Self {
        Self {
            format: StillFormat::Png,
            quality: DEFAULT_QUALITY,
            deep_png: false,
            no_background: false,
        }
    }
}

/// The kind of file that holds the frames of a path.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SequenceFormat {
    /// A video in an MP4 file, which nearly everything plays.
    #[default]
    Mp4,
    /// A video in a WebM file.
    #[serde(rename = "webm")]
    WebM,
    /// A PNG for each frame, in a zip.
    Pngs,
}

impl SequenceFormat {
    /// All formats, each with its name and what it is for.
    pub const ALL: [(Self, &str, &str); 3] = [
        (Self::Mp4, "MP4", "A video that nearly everything plays"),
        (Self::WebM, "WebM", "A video for the web"),
        (Self::Pngs, "PNGs", "A picture for each frame in a zip file, for other programs"),
    ];

    /// This format, or the nearest that needs no missing encoder: another kind of video before PNGs.
    pub fn or_encodable(self, missing: MissingEncoders) -> Self {
        let all = Self::ALL.map(|(format, ..)| format);
        let encodable = [self].into_iter().chain(all).find(|&format| !missing.contains(format));
        encodable.unwrap_or(Self::Pngs)
    }

    /// True for a video.
    pub fn is_video(self) -> bool {
        self != Self::Pngs
    }

    /// The file's extension, without the dot.
    pub fn extension(self) -> &'static str {
        match self {
            Self::Mp4 => "mp4",
            Self::WebM => "webm",
            Self::Pngs => "zip",
        }
    }

    /// The file's media type.
    pub fn media_type(self) -> &'static str {
        match self {
            Self::Mp4 => "video/mp4",
            Self::WebM => "video/webm",
            Self::Pngs => "application/zip",
        }
    }
}

/// A video that the timeline can save.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct VideoSpec {
    /// Width and height of a frame, in pixels; of both eyes' pictures together.
    pub size_px: [u32; 2],
    /// Frames per second.
    pub frames_per_second: u32,
}

/// The kinds of video that the browser cannot encode.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum MissingEncoders {
    /// It encodes both kinds, or has not answered yet.
    #[default]
    None,
    /// It encodes no videos at all.
    All,
    /// It cannot encode these in the [`VideoSpec`]'s size and rate.
    OfThisSize {
        /// True if MP4 is missing.
        mp4: bool,
        /// True if WebM is missing.
        webm: bool,
    },
}

impl MissingEncoders {
    /// True if `format` needs an encoder that is missing.
    pub fn contains(self, format: SequenceFormat) -> bool {
        match (self, format) {
            (_, SequenceFormat::Pngs) | (Self::None, _) => false,
            (Self::All, _) => true,
            (Self::OfThisSize { mp4, .. }, SequenceFormat::Mp4) => mp4,
            (Self::OfThisSize { webm, .. }, SequenceFormat::WebM) => webm,
        }
    }

    /// What is missing, as a sentence; none if nothing is.
    pub fn text(self) -> Option<&'static str> {
        match self {
            Self::None | Self::OfThisSize { mp4: false, webm: false } => None,
            Self::All => Some("This browser cannot encode videos."),
            Self::OfThisSize { mp4: true, webm: true } => {
                Some("This browser cannot encode videos of this size.")
            }
            Self::OfThisSize { mp4: true, .. } => {
                Some("This browser cannot encode MP4 videos of this size.")
            }
            Self::OfThisSize { webm: true, .. } => {
                Some("This browser cannot encode WebM videos of this size.")
            }
        }
    }
}

/// Size and format of saved pictures.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct ExportSize {
    /// Factor on the view's size: 1, 2 or 4; 0 for the typed size.
    pub times: u32,
    /// The typed width and height in pixels, each 1 to [`MAX_EXPORT_SIDE_PX`].
    pub typed_px: [u32; 2],
    /// How a picture is stored.
    pub file: StillFile,
    /// True to save a stereo picture as one file per eye.
    pub pair: bool,
    /// The kind of file of a sequence.
    pub sequence: SequenceFormat,
}

impl Default for ExportSize {
    fn default() -> Self {
        Self {
            times: 1,
            typed_px: [3840, 2160],
            file: StillFile::default(),
            pair: false,
            sequence: SequenceFormat::Mp4,
        }
    }
}

impl ExportSize {
    /// Width and height of the saved picture, or of one eye's picture, in pixels.
    ///
    /// If the size exceeds the limit, both sides shrink and keep the view's aspect.
    pub fn resolve(&self, view_px: [u32; 2], layout: StereoLayout) -> [u32; 2] {
        let grid_in_file = self.grid_in_file(layout);
        let limit = grid_in_file.map(|pictures| f64::from(MAX_EXPORT_SIDE_PX / pictures));
        let side = |axis: usize, length: f64| length.round().clamp(1.0, limit[axis]) as u32;
        if self.times == 0 {
            return std::array::from_fn(|axis| side(axis, f64::from(self.typed_px[axis])));
        }
        let grid = layout.grid();
        let picture_px: [f64; 2] =
            std::array::from_fn(|axis| f64::from((view_px[axis] / grid[axis]).max(1)));
        let max_times = (limit[0] / picture_px[0]).min(limit[1] / picture_px[1]);
        let times = f64::from(self.times.min(16)).min(max_times);
        std::array::from_fn(|axis| side(axis, picture_px[axis] * times))
    }

    /// True if each eye's picture is a separate file.
    pub fn is_pair(&self, layout: StereoLayout) -> bool {
        self.pair && layout != StereoLayout::Off
    }

    /// Number of columns and rows of pictures in one file.
    fn grid_in_file(&self, layout: StereoLayout) -> [u32; 2] {
        if self.pair { [1, 1] } else { layout.grid() }
    }

    /// Width and height of the saved file, in pixels.
    pub fn file_px(&self, view_px: [u32; 2], layout: StereoLayout) -> [u32; 2] {
        let (picture_px, grid) = (self.resolve(view_px, layout), self.grid_in_file(layout));
        [0, 1].map(|axis| picture_px[axis] * grid[axis])
    }

    /// The size of the saved file as text.
    pub fn text(&self, view_px: [u32; 2], layout: StereoLayout) -> String {
        let [width, height] = self.file_px(view_px, layout);
        let pair = if self.is_pair(layout) { ", one for each eye" } else { "" };
        format!("{width} × {height} pixels{pair}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_multiples_of_the_view() {
        let view = [1280, 720];
        let size =
            |times| ExportSize { times, ..Default::default() }.resolve(view, StereoLayout::Off);
        assert_eq!((size(1), size(2), size(4)), ([1280, 720], [2560, 1440], [5120, 2880]));
    }

    #[test]
    fn a_size_at_the_limit_keeps_the_aspect() {
        let export = ExportSize { times: 4, ..Default::default() };
        assert_eq!(export.resolve([8192, 4096], StereoLayout::Off), [16384, 8192]);
    }

    #[test]
    fn invalid_stored_settings_are_clamped() {
        let export = ExportSize { times: 0, typed_px: [0, u32::MAX], ..Default::default() };
        assert_eq!(export.resolve([800, 600], StereoLayout::Off), [1, MAX_EXPORT_SIDE_PX]);
        let export = ExportSize { times: u32::MAX, typed_px: [1, 1], ..Default::default() };
        assert_eq!(export.resolve([1600, 400], StereoLayout::Off), [16384, 4096]);
    }

    #[test]
    fn formats_without_an_encoder_have_a_substitute() {
        use SequenceFormat::{Mp4, Pngs, WebM};
        let of_size = |mp4, webm| MissingEncoders::OfThisSize { mp4, webm };
        for (missing, substitutes) in [
            (MissingEncoders::None, [Mp4, WebM, Pngs]),
            (MissingEncoders::All, [Pngs; 3]),
            (of_size(false, false), [Mp4, WebM, Pngs]),
            (of_size(true, false), [WebM, WebM, Pngs]),
            (of_size(false, true), [Mp4, Mp4, Pngs]),
            (of_size(true, true), [Pngs; 3]),
        ] {
            assert_eq!([Mp4, WebM, Pngs].map(|format| format.or_encodable(missing)), substitutes);
            let is_complete = substitutes == [Mp4, WebM, Pngs];
            assert_eq!(missing.text().is_none(), is_complete, "{missing:?}");
        }
    }

    #[test]
    fn both_eyes_share_the_view_and_the_file() {
        use StereoLayout::{Anaglyph, SideBySide, TopBottom};
        let export = ExportSize::default();
        let sized = |export: &ExportSize, layout| export.resolve([1280, 720], layout);
        assert_eq!(sized(&export, SideBySide), [640, 720]);
        assert_eq!(sized(&export, TopBottom), [1280, 360]);
        assert_eq!(sized(&export, Anaglyph), [1280, 720]);
        assert_eq!(export.text([1280, 720], SideBySide), "1280 × 720 pixels");
        let pair = ExportSize { pair: true, ..export };
        assert_eq!(sized(&pair, SideBySide), [640, 720]);
        assert_eq!(pair.text([1280, 720], SideBySide), "640 × 720 pixels, one for each eye");
        assert_eq!(pair.text([1280, 720], StereoLayout::Off), "1280 × 720 pixels");
        // No side of a file goes above the limit.
        let typed = ExportSize { times: 0, typed_px: [16_384, 9000], ..export };
        assert_eq!(sized(&typed, SideBySide), [8192, 9000]);
        assert_eq!(sized(&typed, TopBottom), [16_384, 8192]);
        let large = ExportSize { times: 4, ..export };
        assert_eq!(large.resolve([8192, 4096], SideBySide), [8192, 8192]);
    }
}
