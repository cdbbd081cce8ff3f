//! What to draw: pure data, its units and ranges, and the document it is kept in.
//!
//! In: edits from panels, files and links. Out: a [`Scene`] that is always within its
//! ranges. This layer knows no GPU and no user interface.
//!
//! | file | contents |
//! |---|---|
//! | [`param`] | every number's unit, range, default and help text, in one table |
//! | `description` | [`Scene`], the whole of its parts |
//! | `camera`, `lens`, `stereo`, `surface`, `indirect`, `integrator`, `background`, `fog`, `medium`, `tone`, `bloom`, `quality` | the parts of a scene |
//! | `lighting` | the part that holds all lights |
//! | `light`, `rig` | single lights; lights generated together |
//! | [`light_setups`] | starting points of light |
//! | [`looks`] | appearances for any scene |
//! | [`follow`] | the lights of close views, which follow the view |
//! | [`document`] | the versioned JSON form, and what is said of a bad one |
//! | [`link`] | the same document as an address's fragment |
//! | [`last_visit`] | which scene a visit opens with: the address's, the tab's, or the last one |
//! | [`environment_map`] | an environment map, decoded, and cut into lights |
//! | [`history`] | undo and redo, grouped by gesture |
//! | [`path`] | key frames of whole scenes, and the scene at any time between them |
//! | `project` | a scene and its path, as a document holds them |
//! | [`presets`] | the opening scenes |
//! | `validate` | the check that every loaded scene has passed |
//! | [`color`] | sRGB, and the gradient as a table |
//! | [`gradient`] | gradients with names, and those of files |
//! | [`gallery`] | the list of a folder's pictures on a web host |
//! | [`variation`], [`dice`] | scenes near to a scene; random numbers for them |

mod background;
mod bloom;
mod camera;
mod description;
mod fog;
mod integrator;
mod lens;
mod light;
mod lighting;
mod medium;
mod project;
mod quality;
mod rig;
mod surface;
mod tone;
mod tone_curve;

pub mod color;
pub mod dice;
pub mod document;
pub mod environment_map;
pub mod follow;
pub mod gallery;
pub mod gradient;
pub mod history;
mod indirect;
pub mod last_visit;
pub mod light_setups;
pub mod link;
pub mod looks;
pub mod param;
pub mod path;
pub mod presets;
mod stereo;
mod validate;
pub mod variation;

pub use background::{Background, BackgroundKind};
pub use bloom::{Bloom, BloomOrder};
pub use camera::{Camera, MIN_VIEW_UNIT, Quaternion};
pub use description::Scene;
pub use environment_map::{EnvironmentMap, MAX_NAME_CHARS};
pub use fog::Fog;
pub use indirect::{Indirect, IndirectKind};
pub use integrator::{IntegratorKind, IntegratorSettings};
pub use lens::Lens;
pub use light::{EnvironmentLight, LightFrame, MAX_LIGHTS, PointLight};
pub use lighting::Lights;
pub use medium::{Medium, MediumKind};
pub use path::Path;
pub use project::Project;
pub use quality::{Normals, Quality};
pub use rig::{
    EnvironmentMapRig, MAX_RIG_RADIANCE, RIG_DIRECTION_TOLERANCE, Rig, RigKind, RigLight, Sky,
};
pub use stereo::{Stereo, StereoLayout};
pub use surface::{
    Axis, ColorSource, Coloring, DrivenByLayer, GradientStop, MAX_GRADIENT_STOPS, SecondLayer,
    SectionColors, Surface, SurfaceModel,
};
pub use tone::{Tone, ToneChannels, ToneCurve, ToneMean};
pub use validate::Invalid;

pub use crate::{
    formula::Fractal,
    precise::{Precise, PrecisePoint},
};
