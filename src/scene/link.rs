//! The scene as a URL fragment: `#s1=` or `#s2=` and base64url of deflated JSON.
//!
//! Converts a scene with its path to a fragment, and an untrusted fragment back to a scene.
//! Fields equal to their default are left out, which keeps links short and makes the defaults
//! part of the version (see [`super::document`]). The digit is the least document version that can
//! say what the link says: 2 where the scene is of a later formula than version 1 had.

use base64::{Engine, engine::general_purpose::URL_SAFE_NO_PAD};
use miniz_oxide::{
    deflate::compress_to_vec,
    inflate::{TINFLStatus, decompress_to_vec_with_limit},
};
use serde::Serialize;
use serde_json::{Map, Value};

use super::{
    description::Scene,
    document::{self, DocumentError, value_of},
    light::{EnvironmentLight, PointLight},
    path::Path,
    project::Project,
};
use crate::formula::{FormulaRef, Fractal, HybridStep, hybrid};

/// Maximum length of a fragment, in bytes.
pub const MAX_FRAGMENT_BYTES: usize = 8 << 10;
/// Maximum size of a fragment's inflated JSON, in bytes.
///
/// Large compared with [`MAX_FRAGMENT_BYTES`], because similar keys of a path deflate well.
pub const MAX_INFLATED_BYTES: usize = 1 << 20;

/// Prefix of a fragment whose fractals are all of the formula that version 1 had.
const PREFIX_1: &str = "s1=";
/// Prefix of a fragment with other formulas.
const PREFIX_2: &str = "s2=";
/// miniz's strongest compression level; a scene is small, so speed does not matter.
const DEFLATE_LEVEL: u8 = 10;

/// Why a conversion between scene and link failed.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum LinkError {
    /// Longer than [`MAX_FRAGMENT_BYTES`].
    #[error(
        "the link would be {bytes} characters long, more than the {MAX_FRAGMENT_BYTES} that links may have; save the scene as a file instead"
    )]
    TooLong {
        /// Length of the fragment.
        bytes: usize,
    },
    /// The prefix is not that of a scene's link.
    #[error("the address holds no scene")]
    NotAScene,
    /// The link has another version of the format.
    #[error(
        "the link holds a scene of version {found}; this program reads versions 1 to {}",
        document::VERSION
    )]
    Version {
        /// The digits in the link.
        found: String,
    },
    /// Not base64url, not deflated, or not UTF-8: the link was truncated or altered.
    #[error("the link is damaged or incomplete; copy it again in full")]
    Damaged,
    /// Inflates to more than [`MAX_INFLATED_BYTES`].
    #[error(
        "the link unpacks to more than {MAX_INFLATED_BYTES} bytes, more than links may hold; save the scene as a file instead"
    )]
    TooLarge,
    /// The scene in the link is invalid.
    #[error("the link's scene: {0}")]
    Document(#[from] DocumentError),
}

/// The fragment of `scene`, without `#`: letters, digits, `=`, `-` and `_` only.
///
/// # Errors
///
/// [`LinkError::TooLong`] for scenes with many different lights.
pub fn to_fragment(scene: &Scene) -> Result<String, LinkError> {
    fragment_of(&differences(value_of(scene)), prefix_of([scene]))
}

/// The fragment of a scene and its path, without `#`.
///
/// # Errors
///
/// [`LinkError::TooLong`] or [`LinkError::TooLarge`], for paths with many keys.
pub fn project_to_fragment(project: &Project) -> Result<String, LinkError> {
    let mut payload = differences(value_of(&project.scene));
    if project.path != Path::default() {
        payload["path"] = document::path_value(project, differences);
    }
    let keys = project.path.keys.iter().map(|key| &*key.scene);
    fragment_of(&payload, prefix_of(keys.chain([&project.scene])))
}

fn prefix_of<'a>(scenes: impl IntoIterator<Item = &'a Scene>) -> &'static str {
    let is_of_version_1 = |scene: &Scene| scene.fractal.formula() == FormulaRef::default();
    if scenes.into_iter().all(is_of_version_1) { PREFIX_1 } else { PREFIX_2 }
}

fn fragment_of(payload: &Value, prefix: &str) -> Result<String, LinkError> {
    let text = payload.to_string();
    if text.len() > MAX_INFLATED_BYTES {
        return Err(LinkError::TooLarge);
    }
    let deflated = compress_to_vec(text.as_bytes(), DEFLATE_LEVEL);
    let fragment = format!("{prefix}{}", URL_SAFE_NO_PAD.encode(deflated));
    if fragment.len() > MAX_FRAGMENT_BYTES {
        return Err(LinkError::TooLong { bytes: fragment.len() });
    }
    Ok(fragment)
}

/// Reads the scene of a fragment, with or without `#`.
///
/// # Errors
///
/// See [`LinkError`]. A fragment with an invalid path fails too.
pub fn from_fragment(fragment: &str) -> Result<Scene, LinkError> {
    Ok(project_from_fragment(fragment)?.scene)
}

/// Reads the scene and the path of a fragment; without a path, the path is empty.
///
/// # Errors
///
/// See [`LinkError`].
pub fn project_from_fragment(fragment: &str) -> Result<Project, LinkError> {
    if fragment.len() > MAX_FRAGMENT_BYTES {
        return Err(LinkError::TooLong { bytes: fragment.len() });
    }
    let payload = payload_of(fragment.strip_prefix('#').unwrap_or(fragment))?;
    let deflated = URL_SAFE_NO_PAD.decode(payload).map_err(|_| LinkError::Damaged)?;
    let inflated =
        decompress_to_vec_with_limit(&deflated, MAX_INFLATED_BYTES).map_err(|error| match error
            .status
        {
            TINFLStatus::HasMoreOutput => LinkError::TooLarge,
            _ => LinkError::Damaged,
        })?;
    let text = String::from_utf8(inflated).map_err(|_| LinkError::Damaged)?;
    Ok(document::project_from_link(&text)?)
}

/// The text after the prefix of a version that is read.
fn payload_of(fragment: &str) -> Result<&str, LinkError> {
    let known = [PREFIX_1, PREFIX_2].iter().find_map(|prefix| fragment.strip_prefix(prefix));
    if let Some(payload) = known {
        return Ok(payload);
    }
    let version = fragment.strip_prefix('s').and_then(|rest| rest.split_once('='));
    match version {
        Some((digits, _))
            if (1..=6).contains(&digits.len()) && digits.bytes().all(|b| b.is_ascii_digit()) =>
        {
            Err(LinkError::Version { found: digits.into() })
        }
        _ => Err(LinkError::NotAScene),
    }
}

/// A scene's JSON without the fields equal to their default.
fn differences(mut value: Value) -> Value {
    // A field's default is that of the formula that has the field.
    let fractal = value.get("fractal").cloned();
    let fractal: Fractal =
        fractal.and_then(|fractal| serde_json::from_value(fractal).ok()).unwrap_or_default();
    let steps = fractal.hybrid().map(|hybrid| hybrid.steps.iter().map(step_differences).collect());
    let default = match fractal.hybrid() {
        // The steps are those of the default too, so it is valid.
        Some(steps) => hybrid::fractal(steps.clone()).unwrap_or_default(),
        None => Fractal::new(fractal.formula()),
    };
    let loop_start = value.pointer("/fractal/loop_start").cloned();
    let formula = value.pointer("/fractal/formula").cloned();
    drop_defaults(&mut value, &value_of(&Scene { fractal: default, ..Scene::default() }));
    if let Some(formula) = formula.filter(|_| fractal.formula() != FormulaRef::default()) {
        // First: the fields of a text are known only after it.
        let mut whole = Map::from_iter([("formula".to_owned(), formula)]);
        if let Some(Value::Object(fields)) = value.get_mut("fractal") {
            whole.append(fields);
        }
        if let Some(steps) = steps {
            whole.extend(loop_start.map(|start| ("loop_start".to_owned(), start)));
            whole.insert("steps".to_owned(), Value::Array(steps));
        }
        value["fractal"] = whole.into();
    }
    drop_list_defaults(&mut value, "environment", &EnvironmentLight::default());
    drop_list_defaults(&mut value, "point", &PointLight::default());
    value
}

/// A hybrid's step without the fields equal to their default.
fn step_differences(step: &HybridStep) -> Value {
    let mut value = value_of(step);
    let formula = value["formula"].clone();
    // The formula is a step's already.
    if let Ok(default) = hybrid::step(step.formula()) {
        drop_defaults(&mut value, &value_of(&default));
    }
    let mut whole = Map::from_iter([("formula".to_owned(), formula)]);
    if let Value::Object(fields) = &mut value {
        whole.append(fields);
    }
    whole.into()
}

fn drop_list_defaults(scene: &mut Value, list: &str, default: &impl Serialize) {
    let Some(lights) = scene.pointer_mut(&format!("/lights/{list}")).and_then(Value::as_array_mut)
    else {
        return;
    };
    let default = value_of(default);
    lights.iter_mut().for_each(|light| drop_defaults(light, &default));
}

/// Removes every field of `value` that equals the field of `default`. Lists stay complete.
fn drop_defaults(value: &mut Value, default: &Value) {
    let (Value::Object(fields), Value::Object(defaults)) = (value, default) else {
        return;
    };
    fields.retain(|key, field| match defaults.get(key) {
        Some(same) if same == field => false,
        Some(default) => {
            drop_defaults(field, default);
            true
        }
        None => true,
    });
}
