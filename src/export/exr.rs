//! Streaming OpenEXR writer (radiance, depth, normal, position), and reader of the scene document.
//!
//! The writer gets pixels from the top and the scene document, and writes a file's bytes. All
//! channels are uncompressed 32-bit floats. So every row's file offset is known in advance, and
//! the writer needs neither seeking nor the whole file in memory.
//!
//! | channel | content |
//! |---|---|
//! | `A` | with a transparent background: opacity, 0 to 1; `R`, `G` and `B` are premultiplied by it |
//! | `R`, `G`, `B` | mean radiance, linear Rec. 709, before exposure and tone |
//! | `Z` | distance from the eye along the view's axis, scene units; infinite for the background |
//! | `N.X`, `N.Y`, `N.Z` | unit normal of the surface in scene axes; 0 for the background |
//! | `P.X`, `P.Y`, `P.Z` | surface point minus anchor, scene units; 0 for the background |
//! | `albedo.R`, `.G`, `.B` | with path tracing: mean albedo of the first surfaces, 8 bits; 1 for the background |
//! | `normal.X`, `.Y`, `.Z` | with path tracing: mean normal of the first surfaces, 8 bits; 0 for the background |
//!
//! `albedo` and `normal` are guides for denoisers: means over the first few hundred samples.
//! Depth, normal and position belong to the ray through the pixel's centre. The anchor is the
//! camera's pivot, stored exactly as decimal numbers in the attributes `mandelight.anchor.x`,
//! `.y` and `.z`.

use std::io::{Read, Seek, Write};

use ::exr::{
    meta::{
        BlockDescription, Requirements, attribute,
        header::{Header, LayerAttributes},
        magic_number,
    },
    prelude as exr,
};
use glam::DVec3;

use super::{ExportError, MAX_TEXT_BYTES, metadata::SCENE_KEYWORD};
use crate::{
    reading::{
        openexr::Headers,
        source::{Source, Unreadable},
    },
    render::{Eyes, Region, samples::PixelSample},
    scene::{Camera, Scene, document},
};

/// All channels in alphabetical order, which the format requires; the last ones are guides for denoisers.
const CHANNELS: [&str; 17] = [
    "A", "B", "G", "N.X", "N.Y", "N.Z", "P.X", "P.Y", "P.Z", "R", "Z", "albedo.B", "albedo.G",
    "albedo.R", "normal.X", "normal.Y", "normal.Z",
];

/// Number of guides.
const GUIDES: usize = 6;

/// The channels of a picture.
fn channels(has_alpha: bool, has_guides: bool) -> &'static [&'static str] {
    let end = if has_guides { CHANNELS.len() } else { CHANNELS.len() - GUIDES };
    &CHANNELS[usize::from(!has_alpha)..end]
}

/// Bytes per pixel, all channels together.
pub(super) fn bytes_of_pixel(has_alpha: bool, has_guides: bool) -> usize {
    channels(has_alpha, has_guides).len() * size_of::<f32>()
}

/// The first bytes of every OpenEXR file.
const SIGNATURE: [u8; 4] = [0x76, 0x2f, 0x31, 0x01];

/// The byte after a header's last attribute.
const END_OF_ATTRIBUTES: u8 = 0;

/// Bytes of a row's header in the file: row number and length.
const ROW_HEADER_BYTES: usize = 8;

/// An OpenEXR file being written. Dropping it before [`Self::finish`] leaves an incomplete file.
pub struct ExrStream<W: Write> {
    sink: W,
    /// Number of channels.
    channels: usize,
    width: usize,
    rows: u32,
    rows_written: u32,
    row: Vec<u8>,
}

impl<W: Write> ExrStream<W> {
    /// Starts a picture of `size_px` and writes its header with `scene`.
    ///
    /// # Errors
    /// [`ExportError::Write`] from `sink`, [`ExportError::Encode`] if a side is zero.
    pub fn new(sink: W, size_px: [u32; 2], scene: &Scene) -> Result<Self, ExportError> {
        Self::with_alpha(sink, size_px, scene, false)
    }

    /// The same with a channel of opacity if `has_alpha`.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn with_alpha(
        mut sink: W,
        size_px: [u32; 2],
        scene: &Scene,
        has_alpha: bool,
    ) -> Result<Self, ExportError> {
        let channels = channels(has_alpha, scene.traces_paths());
        let mut start = header(size_px, scene, channels)?;
        let width = size_px[0] as usize;
        let channels = channels.len();
        let row_bytes = (ROW_HEADER_BYTES + width * channels * size_of::<f32>()) as u64;
        let rows_offset = (start.len() + 8 * size_px[1] as usize) as u64;
        for y in 0..u64::from(size_px[1]) {
            start.extend((rows_offset + y * row_bytes).to_le_bytes());
        }
        sink.write_all(&start)?;
        Ok(Self { sink, channels, width, rows: size_px[1], rows_written: 0, row: Vec::new() })
    }

    /// Appends whole rows, in the pixel format of this module's `pixel_bytes`.
    ///
    /// # Errors
    /// [`ExportError::Write`] from the sink; [`ExportError::Encode`] past the last row.
    pub fn write_rows(&mut self, pixels: &[u8]) -> Result<(), ExportError> {
        for pixels in pixels.chunks_exact(self.width * self.channels * size_of::<f32>()) {
            if self.rows_written == self.rows {
                return Err(ExportError::Encode("more rows than the picture has".to_owned()));
            }
            self.row.clear();
            self.row.extend(self.rows_written.to_le_bytes());
            self.row.extend((pixels.len() as u32).to_le_bytes());
            for channel in 0..self.channels {
                let values = pixels.as_chunks::<4>().0.iter();
                self.row.extend(values.skip(channel).step_by(self.channels).flatten());
            }
            self.sink.write_all(&self.row)?;
            self.rows_written += 1;
        }
        Ok(())
    }

    /// Ends the file and returns the flushed sink.
    ///
    /// # Errors
    /// [`ExportError::Encode`] if rows are missing, [`ExportError::Write`] from the sink.
    pub fn finish(mut self) -> Result<W, ExportError> {
        if self.rows_written < self.rows {
            return Err(ExportError::Encode("rows are missing".to_owned()));
        }
        self.sink.flush()?;
        Ok(self.sink)
    }
}

/// The pixels of a tile of one eye's picture, as [`bytes_of_pixel`] each, in [`CHANNELS`] order.
pub(super) fn pixel_bytes(camera: &Camera, tile: Region, pixels: &[PixelSample]) -> Vec<u8> {
    let rays = Rays::new(camera, tile);
    let eye_from_anchor = (&camera.position - &camera.pivot) + rays.eye_from_camera;
    let forward = camera.forward();
    let has_guides = pixels.first().is_some_and(|pixel| pixel.guides.is_some());
    let has_alpha = pixels.first().is_some_and(|pixel| pixel.opacity.is_some());
    let mut bytes = Vec::with_capacity(pixels.len() * bytes_of_pixel(has_alpha, has_guides));
    for (i, pixel) in (0..).zip(pixels) {
        let at = [i % tile.size_px[0], i / tile.size_px[0]];
        let ray = rays.through(std::array::from_fn(|k| tile.origin_px[k] + at[k]));
        let [r, g, b] = pixel.radiance;
        let is_hit = pixel.depth > 0.0;
        let depth = f64::from(pixel.depth);
        let point = if is_hit { eye_from_anchor + ray * depth } else { DVec3::ZERO };
        let z = if is_hit { depth * ray.dot(forward) } else { f64::INFINITY };
        let [nx, ny, nz] = if is_hit { pixel.normal.to_array() } else { [0.0; 3] };
        let [px, py, pz] = point.as_vec3().to_array();
        let plain = [b, g, nx, ny, nz, px, py, pz, r, z as f32];
        let guides = pixel.guides.map(|guides| {
            let ([r, g, b], normal) = (guides.albedo, guides.normal);
            [b, g, r, normal.x, normal.y, normal.z]
        });
        let values = pixel.opacity.into_iter().chain(plain).chain(guides.into_iter().flatten());
        bytes.extend(values.flat_map(f32::to_le_bytes));
    }
    bytes
}

/// The rays through the pixels' centres: `shaders/lib/camera.wgsl` in f64.
struct Rays {
    /// Vector from the camera to the eye, scene units.
    eye_from_camera: DVec3,
    forward: DVec3,
    right: DVec3,
    up: DVec3,
    picture_px: [f64; 2],
}

impl Rays {
    fn new(camera: &Camera, tile: Region) -> Self {
        let picture_px = tile.picture_px.map(f64::from);
        let aspect = tile.aspect();
        let half_height = camera.half_height(aspect);
        let left = if camera.stereo.swap_eyes { 1.0 } else { -1.0 };
        let side = match tile.eyes {
            Eyes::Camera => 0.0,
            Eyes::Right => -left,
            Eyes::Left | Eyes::Beside | Eyes::Below | Eyes::Anaglyph | Eyes::WideAnaglyph => left,
        };
        let eye_offset = camera.rotation() * DVec3::X * (side * camera.stereo.half_separation());
        Self {
            eye_from_camera: eye_offset * camera.view_unit(),
            // The frustum is sheared, so that both eyes' pictures coincide at the screen.
            forward: camera.forward() - eye_offset,
            right: camera.rotation() * DVec3::X * (half_height * aspect),
            up: camera.rotation() * DVec3::Y * half_height,
            picture_px,
        }
    }

    /// The unit ray through a pixel of the picture.
    fn through(&self, pixel: [u32; 2]) -> DVec3 {
        let [x, y] =
            std::array::from_fn(|i| 2.0 * (f64::from(pixel[i]) + 0.5) / self.picture_px[i] - 1.0);
        (self.forward + self.right * x - self.up * y).normalize()
    }
}

/// The file's bytes before the offset table.
fn header(size_px: [u32; 2], scene: &Scene, channels: &[&str]) -> Result<Vec<u8>, ExportError> {
    let channel =
        |name: &&str| exr::ChannelDescription::new(text(name), exr::SampleType::F32, false);
    let channels: exr::SmallVec<_> = channels.iter().map(channel).collect();
    let size = (size_px[0] as usize, size_px[1] as usize);
    let mut header = Header::new(text(""), size, channels).with_encoding(
        exr::Compression::Uncompressed,
        BlockDescription::ScanLines,
        exr::LineOrder::Increasing,
    );
    let mut attributes = LayerAttributes {
        layer_name: None,
        software_name: Some(text(concat!("Mandelight ", env!("CARGO_PKG_VERSION")))),
        ..header.own_attributes.clone()
    };
    let mut note = |name: &str, value: &str| {
        attributes.other.insert(text(name), exr::AttributeValue::Text(text(value)));
    };
    note(SCENE_KEYWORD, &document::to_json_compact(scene));
    note("mandelight.Z", "distance from the eye along the view's axis, scene units");
    note("mandelight.N", "unit normal, scene axes");
    note("mandelight.P", "point less the anchor, scene units, scene axes");
    let anchor = scene.camera.pivot.0.each_ref().map(ToString::to_string);
    for (axis, coordinate) in ["x", "y", "z"].into_iter().zip(&anchor) {
        note(&format!("mandelight.anchor.{axis}"), coordinate);
    }
    header.own_attributes = attributes;

    let mut bytes = Vec::new();
    let headers = [header];
    let written = exr::MetaData::validate(&headers, true).and_then(|needs: Requirements| {
        magic_number::write(&mut bytes)?;
        needs.write(&mut bytes)?;
        // The crate keeps some attributes in a hash map, whose order differs from run to run.
        let mut attributes: Vec<_> = headers[0].all_named_attributes().collect();
        attributes.sort_by_key(|(name, _)| *name);
        for (name, value) in attributes {
            attribute::write(name, &value, &mut bytes)?;
        }
        bytes.push(END_OF_ATTRIBUTES);
        Ok(())
    });
    written.map_err(|error| ExportError::Encode(error.to_string()))?;
    Ok(bytes)
}

/// Text in the format's encoding: non-ASCII characters are escaped as in JSON.
///
/// OpenEXR's text attributes cannot store characters beyond Latin-1.
fn text(plain: &str) -> exr::Text {
    let mut ascii = String::with_capacity(plain.len());
    for letter in plain.chars() {
        if letter.is_ascii() {
            ascii.push(letter);
        } else {
            let mut units = [0; 2];
            for unit in letter.encode_utf16(&mut units) {
                ascii.push_str(&format!("\\u{unit:04x}"));
            }
        }
    }
    exr::Text::new_or_none(ascii).unwrap_or_default()
}

/// True if `bytes` begin with the OpenEXR signature.
pub fn is_exr(bytes: &[u8]) -> bool {
    bytes.starts_with(&SIGNATURE)
}

/// The scene document of an OpenEXR file, if it has one.
///
/// The pixels are neither read nor decoded.
///
/// # Errors
/// A message for the user; the content of `reader` is untrusted.
pub fn exr_scene_text(reader: impl Read + Seek) -> Result<Option<String>, String> {
    let unreadable = |error: Unreadable| format!("not a readable OpenEXR file: {error}");
    let mut file = Source::new(reader).map_err(|error| unreadable(Unreadable::new(error)))?;
    let mut headers = Headers::new(&mut file).map_err(unreadable)?;
    let mut scene = None;
    while let Some(attribute) = headers.next(&mut file).map_err(unreadable)? {
        if attribute.name == SCENE_KEYWORD.as_bytes() {
            if attribute.size > MAX_TEXT_BYTES as u64 {
                return Err(format!("its text is larger than {MAX_TEXT_BYTES} bytes"));
            }
            scene = Some(file.bytes(attribute.size as usize, "the scene").map_err(unreadable)?);
        }
    }
    let text = scene.map(String::from_utf8).transpose();
    text.map_err(|_| unreadable(Unreadable::new("the scene is no text")))
}

/// Width and height in pixels of a complete OpenEXR file in rows; `None` where its last row is not there.
///
/// # Errors
/// As [`exr_scene_text`].
pub fn exr_complete_size(reader: impl Read + Seek) -> Result<Option<[u32; 2]>, String> {
    let size = || -> Result<Option<[u32; 2]>, Unreadable> {
        let mut file = Source::new(reader).map_err(Unreadable::new)?;
        let mut headers = Headers::new(&mut file)?;
        let mut window = [0; 4];
        while let Some(attribute) = headers.next(&mut file)? {
            if attribute.name == b"dataWindow" {
                for side in &mut window {
                    *side = i64::from(file.i32("dataWindow")?);
                }
            }
        }
        let [left, top, right, bottom] = window;
        let [width, height] = [right - left + 1, bottom - top + 1];
        let (Ok(width), Ok(height @ 1..)) = (u32::try_from(width), u32::try_from(height)) else {
            return Ok(None);
        };
        let last = file.position() + 8 * (u64::from(height) - 1);
        file.go_to(last, "the table of rows")?;
        let last = u64::from_le_bytes(file.array("the table of rows")?);
        file.go_to(last, "the last row")?;
        let row = i64::from(file.i32("the last row")?);
        let bytes = u64::try_from(file.i32("the last row")?).unwrap_or(u64::MAX);
        let is_complete =
            row == bottom && Some(file.length()) == file.position().checked_add(bytes);
        Ok(is_complete.then_some([width, height]))
    };
    size().map_err(|error| format!("not a readable OpenEXR file: {error}"))
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;
    use crate::render::uniforms::FrameUniforms;

    #[test]
    fn two_files_of_a_scene_are_the_same() {
        let file = || {
            let mut stream = ExrStream::new(Vec::new(), [3, 2], &Scene::default()).unwrap();
            stream.write_rows(&[7; 3 * 2 * 10 * 4]).unwrap();
            stream.finish().unwrap()
        };
        // Each hash map has an order of its own.
        let first = file();
        assert!((0..8).all(|_| file() == first));
        assert_eq!(exr_complete_size(std::io::Cursor::new(&first)), Ok(Some([3, 2])));
    }

    /// Compares with rays from the shaders' uniforms, by the shaders' formula.
    #[test]
    fn rays_match_the_shaders_for_both_eyes() {
        let mut scene = Scene::default();
        for (eyes, swap_eyes) in [
            (Eyes::Camera, false),
            (Eyes::Left, false),
            (Eyes::Right, false),
            (Eyes::Left, true),
            (Eyes::Right, true),
        ] {
            scene.camera.stereo.swap_eyes = swap_eyes;
            let tile = Region { eyes, ..Region::whole([30, 20]) };
            let rays = Rays::new(&scene.camera, tile);
            let FrameUniforms { camera, eyes: shader_eyes, .. } = FrameUniforms::new(&scene, tile);
            let side = shader_eyes.first_side;
            let axis = |axis: [f32; 3]| Vec3::from_array(axis);
            let eye_offset = axis(camera.right) * (side * shader_eyes.half_separation);
            assert!((eye_offset.as_dvec3() - rays.eye_from_camera).length() < 1e-6, "{eyes:?}");
            for pixel in [[0, 0], [29, 3], [7, 19]] {
                let [x, y] = std::array::from_fn(|i| (pixel[i] as f32 + 0.5) / [30.0, 20.0][i]);
                let right = (2.0 * x - 1.0) * camera.half_height * camera.aspect
                    - side * shader_eyes.half_shift;
                let up = (1.0 - 2.0 * y) * camera.half_height;
                let ray = axis(camera.forward) + axis(camera.right) * right + axis(camera.up) * up;
                let error = ray.normalize_or_zero().as_dvec3() - rays.through(pixel);
                assert!(error.length() < 1e-6, "{eyes:?} {pixel:?}: {error}");
            }
        }
    }
}
