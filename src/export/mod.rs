//! Export of pictures: stills of any size, rendered tile by tile to PNG, JPEG, WebP or OpenEXR.
//!
//! In: [`crate::render::Pipelines`], a scene, a size in pixels and a sink. Out: the file's bytes,
//! written in order during the rendering. No job holds a whole picture (except of a WebP), opens a
//! file, or waits for the GPU (except [`still::StillJob::run`]), so the same job runs in a page and in a terminal.
//!
//! | file | contents |
//! |---|---|
//! | [`still`] | the job of one picture: render a tile, read it back, encode its rows |
//! | [`sequence`] | the frames of a camera path, one still each |
//! | [`archive`] | a streaming zip writer |
//! | `options` | the options of a still |
//! | `sheet` | the layout of one or both eyes' pictures in a file |
//! | `motion` | motion blur: a picture as the mean of sub-frames |
//! | `overview` | a small whole picture: exposure, bloom and indirect light for all tiles |
//! | `tiles` | the division of a sheet into tiles |
//! | `error` | why an export failed, and the largest pictures |
//! | `format` | the file formats, and the readback and encoder of each |
//! | [`mod@exr`] | OpenEXR writer: radiance, depth, normal and position; scene reader |
//! | [`png`] | PNG writer with the scene document; scene reader |
//! | [`jpeg`] | JPEG writer with the scene document; scene reader |
//! | [`webp`] | WebP writer with the scene document; scene reader |
//! | `picture_scene` | scene reader of all formats |
//! | `picture_size` | the size of a picture that a browser is to decode |
//! | `metadata` | what the scene readers share |

pub mod archive;
mod error;
pub mod exr;
mod format;
pub mod jpeg;
mod metadata;
mod motion;
mod options;
mod overview;
mod picture_scene;
mod picture_size;
pub mod png;
mod run;
pub mod sequence;
mod sheet;
pub mod still;
mod tiles;
pub mod webp;

pub use archive::Archive;
pub use error::{
    ExportError, MAX_PICTURE_PX, MAX_WEBP_PIXELS, MAX_WEBP_PX, checked_size, checked_webp_size,
};
pub use exr::{exr_complete_size, exr_scene_text, is_exr};
pub use format::{PictureFormat, encode_rgb};
pub use jpeg::jpeg_complete_size;
pub use metadata::{MAX_HEADER_BYTES, MAX_TEXT_BYTES, SCENE_KEYWORD, SceneTextError};
pub use options::{Eye, StillOptions};
pub use picture_scene::picture_scene_text;
pub use picture_size::{MAX_DECODED_PIXELS, decodable_size};
pub use png::{is_png, png_complete_size, png_has_all_pixels, scene_text};
pub use run::RunDevice;
pub use sequence::{FrameSink, SequenceJob, frame_name};
pub use still::{StillJob, StillStatus};
pub use webp::webp_complete_size;
