//! Rows of linear radiance with depth, normal and position to an OpenEXR file, written while it is
//! made; and the scene back out of one.
//!
//! In: pixels from the top, and the scene document that they show. Out: bytes for a file or a
//! blob. All channels are 32-bit floats and not compressed: so every row's place in the file is
//! known ahead, and neither the file nor its index need be held or gone back to.
//!
//! | channel | what it holds |
//! |---|---|
//! | `R`, `G`, `B` | mean radiance, linear Rec. 709, before exposure and tone |
//! | `Z` | distance from the eye along the view's axis, scene units; infinite where nothing was met |
//! | `N.X`, `N.Y`, `N.Z` | the surface's unit normal in the scene's axes; 0 where nothing was met |
//! | `P.X`, `P.Y`, `P.Z` | the point on the surface less the anchor, scene units; 0 where nothing was met |
//!
//! Depth, normal and position are those of the ray through the pixel's centre. The anchor is the
//! camera's pivot, exact, as decimal numbers in the attributes `mandelight.anchor.x`, `.y`, `.z`.

use std::io::{BufRead, Write};

use ::exr::{
    meta::{
        BlockDescription, Requirements,
        header::{Header, LayerAttributes},
        magic_number,
    },
    prelude as exr,
};
use glam::DVec3;

use super::{ExportError, MAX_TEXT_BYTES, png::SCENE_KEYWORD};
use crate::{
    render::{Eyes, Region, samples::PixelSample},
    scene::{Camera, Scene, document},
};

/// The channels, in the order that the format wants: that of their names.
const CHANNELS: [&str; 10] = ["B", "G", "N.X", "N.Y", "N.Z", "P.X", "P.Y", "P.Z", "R", "Z"];

/// Bytes of one pixel, all channels together.
pub(super) const PIXEL_BYTES: usize = CHANNELS.len() * size_of::<f32>();

/// The first bytes of every OpenEXR file.
const SIGNATURE: [u8; 4] = [0x76, 0x2f, 0x31, 0x01];

/// A row's head in the file: its number and its length.
const ROW_HEAD_BYTES: usize = 8;

/// A file in the making. Dropped before its end, it leaves `sink` with half a file.
pub struct ExrStream<W: Write> {
    sink: W,
    width: usize,
    rows: u32,
    rows_written: u32,
    row: Vec<u8>,
}

impl<W: Write> ExrStream<W> {
    /// Starts a picture of `size_px` and writes its header, with `scene` in it.
    ///
    /// # Errors
    /// [`ExportError::Write`] from `sink`, [`ExportError::Encode`] where a side is zero.
    pub fn new(mut sink: W, size_px: [u32; 2], scene: &Scene) -> Result<Self, ExportError> {
        let mut start = header(size_px, scene)?;
        let width = size_px[0] as usize;
        let row_bytes = (ROW_HEAD_BYTES + width * PIXEL_BYTES) as u64;
        let rows_at = (start.len() + 8 * size_px[1] as usize) as u64;
        for y in 0..u64::from(size_px[1]) {
            start.extend((rows_at + y * row_bytes).to_le_bytes());
        }
        sink.write_all(&start)?;
        Ok(Self { sink, width, rows: size_px[1], rows_written: 0, row: Vec::new() })
    }

    /// Adds whole rows that follow the last ones: [`PIXEL_BYTES`] a pixel as [`pixel_bytes`]
    /// makes them.
    ///
    /// # Errors
    /// [`ExportError::Write`] from the sink; [`ExportError::Encode`] past the last row.
    pub fn write_rows(&mut self, pixels: &[u8]) -> Result<(), ExportError> {
        for pixels in pixels.chunks_exact(self.width * PIXEL_BYTES) {
            if self.rows_written == self.rows {
                return Err(ExportError::Encode("more rows than the picture has".to_owned()));
            }
            self.row.clear();
            self.row.extend(self.rows_written.to_le_bytes());
            self.row.extend((pixels.len() as u32).to_le_bytes());
            for channel in 0..CHANNELS.len() {
                let values = pixels.as_chunks::<4>().0.iter();
                self.row.extend(values.skip(channel).step_by(CHANNELS.len()).flatten());
            }
            self.sink.write_all(&self.row)?;
            self.rows_written += 1;
        }
        Ok(())
    }

    /// Gives the flushed sink back.
    ///
    /// # Errors
    /// [`ExportError::Encode`] where rows are missing, [`ExportError::Write`] from the sink.
    pub fn finish(mut self) -> Result<W, ExportError> {
        if self.rows_written < self.rows {
            return Err(ExportError::Encode("rows are missing".to_owned()));
        }
        self.sink.flush()?;
        Ok(self.sink)
    }
}

/// The bytes of the pixels of a tile of one eye's picture, each [`PIXEL_BYTES`] long with its channels in order.
pub(super) fn pixel_bytes(camera: &Camera, tile: Region, pixels: &[PixelSample]) -> Vec<u8> {
    let rays = Rays::new(camera, tile);
    let eye_from_anchor = (&camera.position - &camera.pivot) + rays.eye_from_camera;
    let forward = camera.forward();
    let mut bytes = Vec::with_capacity(pixels.len() * PIXEL_BYTES);
    for (i, pixel) in (0..).zip(pixels) {
        let at = [i % tile.size_px[0], i / tile.size_px[0]];
        let ray = rays.through(std::array::from_fn(|k| tile.origin_px[k] + at[k]));
        let [r, g, b] = pixel.radiance;
        let met = pixel.depth > 0.0;
        let depth = f64::from(pixel.depth);
        let point = if met { eye_from_anchor + ray * depth } else { DVec3::ZERO };
        let z = if met { depth * ray.dot(forward) } else { f64::INFINITY };
        let [nx, ny, nz] = if met { pixel.normal.to_array() } else { [0.0; 3] };
        let [px, py, pz] = point.as_vec3().to_array();
        bytes.extend(
            [b, g, nx, ny, nz, px, py, pz, r, z as f32].iter().flat_map(|v| v.to_le_bytes()),
        );
    }
    bytes
}

/// The rays through the pixels' centres: the f64 twin of `shaders/lib/camera.wgsl`.
struct Rays {
    /// From the camera to the eye, scene units.
    eye_from_camera: DVec3,
    ahead: DVec3,
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
        let aside = camera.rotation() * DVec3::X * (side * camera.stereo.half_separation());
        Self {
            eye_from_camera: aside * camera.view_unit(),
            // Both eyes' pictures meet at the screen.
            ahead: camera.forward() - aside,
            right: camera.rotation() * DVec3::X * (half_height * aspect),
            up: camera.rotation() * DVec3::Y * half_height,
            picture_px,
        }
    }

    /// The unit ray through a pixel of the picture.
    fn through(&self, pixel: [u32; 2]) -> DVec3 {
        let [x, y] =
            std::array::from_fn(|i| 2.0 * (f64::from(pixel[i]) + 0.5) / self.picture_px[i] - 1.0);
        (self.ahead + self.right * x - self.up * y).normalize()
    }
}

/// The bytes ahead of the index.
fn header(size_px: [u32; 2], scene: &Scene) -> Result<Vec<u8>, ExportError> {
    let channel =
        |name: &&str| exr::ChannelDescription::new(text(name), exr::SampleType::F32, false);
    let channels: exr::SmallVec<_> = CHANNELS.iter().map(channel).collect();
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
        Header::write_all(&headers, &mut bytes, false)
    });
    written.map_err(|error| ExportError::Encode(error.to_string()))?;
    Ok(bytes)
}

/// Text as the format has it, which knows no letters past Latin-1: others are escaped as in JSON.
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

/// Whether `bytes` start like an OpenEXR file.
pub fn is_exr(bytes: &[u8]) -> bool {
    bytes.starts_with(&SIGNATURE)
}

/// The scene document that an OpenEXR file carries; none where it carries none. The pixels are
/// neither decoded nor read.
///
/// # Errors
/// A text for people: `reader` may hold anything.
pub fn exr_scene_text(reader: impl BufRead) -> Result<Option<String>, String> {
    let unreadable = |error: exr::Error| format!("not a readable OpenEXR file: {error}");
    let meta = exr::MetaData::read_from_buffered(reader, false).map_err(unreadable)?;
    let scene = meta.headers.iter().find_map(|header| {
        let attributes = header.own_attributes.other.iter();
        let (_, value) = attributes
            .chain(&header.shared_attributes.other)
            .find(|(name, _)| name.as_slice() == SCENE_KEYWORD.as_bytes())?;
        value.to_text().ok().map(ToString::to_string)
    });
    match scene {
        Some(text) if text.len() > MAX_TEXT_BYTES => {
            Err(format!("its text is larger than {MAX_TEXT_BYTES} bytes"))
        }
        scene => Ok(scene),
    }
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;
    use crate::render::uniforms::FrameUniforms;

    /// The rays of the shaders' own numbers, by the shaders' own formula.
    #[test]
    fn rays_are_those_of_the_shaders_for_either_eye() {
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
            let aside = axis(camera.right) * (side * shader_eyes.half_separation);
            assert!((aside.as_dvec3() - rays.eye_from_camera).length() < 1e-6, "{eyes:?}");
            for pixel in [[0, 0], [29, 3], [7, 19]] {
                let [x, y] = std::array::from_fn(|i| (pixel[i] as f32 + 0.5) / [30.0, 20.0][i]);
                let right = (2.0 * x - 1.0) * camera.half_height * camera.aspect
                    - side * shader_eyes.half_shift;
                let up = (1.0 - 2.0 * y) * camera.half_height;
                let ray = axis(camera.forward) + axis(camera.right) * right + axis(camera.up) * up;
                let off = ray.normalize().as_dvec3() - rays.through(pixel);
                assert!(off.length() < 1e-6, "{eyes:?} {pixel:?}: {off}");
            }
        }
    }
}
