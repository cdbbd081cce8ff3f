//! What to draw: pure data, its units and ranges, and the document it is kept in.
//!
//! In: edits from panels, files and links. Out: a [`Scene`] that is always within its
//! ranges. This layer knows no GPU and no user interface.
//!
//! | file | what lives there |
//! |---|---|
//! | [`param`] | every number's unit, range, default and help text, in one table |
//! | `camera`, `light`, `rig`, `surface`, `indirect`, `background`, `tone`, `bloom`, `quality` | the parts of a scene |
//! | [`document`] | the versioned JSON form, and what is said of a bad one |
//! | [`link`] | the same document as an address's fragment |
//! | [`environment_map`] | an environment map, decoded, and cut into lights |
//! | [`history`] | undo and redo, grouped by gesture |
//! | [`path`] | key frames of whole scenes, and the scene at any time between them |
//! | `project` | a scene and its path, as a document holds them |
//! | [`presets`] | the opening scenes |
//! | `validate` | the check that every loaded scene has passed |
//! | [`color`] | sRGB, and the gradient as a table |

mod background;
mod bloom;
mod camera;
mod light;
mod project;
mod quality;
mod rig;
mod surface;
mod tone;

pub mod color;
pub mod document;
pub mod environment_map;
pub mod history;
mod indirect;
pub mod link;
pub mod param;
pub mod path;
pub mod presets;
mod stereo;
mod validate;

pub use background::{Background, BackgroundKind};
pub use bloom::{Bloom, BloomOrder};
pub use camera::{Camera, MIN_VIEW_UNIT, Quaternion};
pub use environment_map::EnvironmentMap;
pub use indirect::{Indirect, IndirectKind};
pub use light::{EnvironmentLight, LightFrame, Lights, MAX_LIGHTS, PointLight};
pub use path::Path;
pub use project::Project;
pub use quality::{Normals, Quality};
pub use rig::{
    MAX_NAME_CHARS, MAX_RIG_RADIANCE, PictureRig, RIG_DIRECTION_TOLERANCE, Rig, RigKind, RigLight,
    Sky,
};
pub use stereo::{Stereo, StereoLayout};
pub use surface::{ColorSource, Coloring, GradientStop, MAX_GRADIENT_STOPS, Surface};
pub use tone::{Tone, ToneChannels, ToneCurve, ToneMean};
pub use validate::Invalid;

use serde::{Deserialize, Serialize};

pub use crate::{
    formula::Fractal,
    precise::{Precise, PrecisePoint},
};

/// Everything a picture depends on, except its size in pixels.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Scene {
    /// The set that is drawn: a formula and its values.
    pub fractal: Fractal,
    /// Where it is seen from.
    pub camera: Camera,
    /// What lights it: at most [`MAX_LIGHTS`] in all.
    pub lights: Lights,
    /// How its surface answers light, and its colours.
    pub surface: Surface,
    /// Light that reaches the surface by way of others.
    pub indirect: Indirect,
    /// What is seen where a ray meets nothing.
    pub background: Background,
    /// How scene radiance becomes display values.
    pub tone: Tone,
    /// Light that spreads around what is bright.
    pub bloom: Bloom,
    /// How much work a picture is given.
    pub quality: Quality,
}
