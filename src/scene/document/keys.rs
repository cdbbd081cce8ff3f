//! A path's form in a document: keys that say only what differs from the document's scene.
//!
//! A key names whole parts of the scene (`camera`, `lights`, …). A part that it leaves out is as
//! in the document's own scene; within a part, a field left out takes its default, as everywhere.

use std::sync::Arc;

use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use super::{check::normalized, error::DocumentError, parts::SceneParts};
use crate::{
    reading::at_most,
    scene::{
        description::Scene,
        path::{Easing, Key, MAX_KEYS, Path},
        project::Project,
    },
};

/// A path to write.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PathText {
    frames_per_second: u32,
    shutter: f64,
    keys: Vec<KeyText>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct KeyText {
    time_secs: f64,
    easing: Easing,
    scene: Map<String, Value>,
}

impl Default for PathText {
    fn default() -> Self {
        let Path { frames_per_second, shutter, .. } = Path::default();
        Self { frames_per_second, shutter, keys: Vec::new() }
    }
}

/// The path of `project` to write.
pub fn text_of(project: &Project) -> PathText {
    let base = value_of(&project.scene);
    let keys = project.path.keys.iter().map(|key| KeyText {
        time_secs: key.time_secs,
        easing: key.easing,
        scene: parts_apart(&base, value_of(&*key.scene)),
    });
    let Path { frames_per_second, shutter, .. } = project.path;
    PathText { frames_per_second, shutter, keys: keys.collect() }
}

/// The parts of `scene` that differ from those of `base`.
fn parts_apart(base: &Value, scene: Value) -> Map<String, Value> {
    match scene {
        Value::Object(mut parts) => {
            parts.retain(|name, part| base.get(name) != Some(part));
            parts
        }
        _ => Map::new(),
    }
}

/// The path as JSON, each key's parts without the defaults that `differences` drops.
pub(in crate::scene) fn path_value(
    project: &Project,
    differences: impl Fn(Value) -> Value,
) -> Value {
    let mut text = text_of(project);
    for key in &mut text.keys {
        let mut brief = differences(Value::Object(key.scene.clone()));
        for (name, part) in &mut key.scene {
            // A part that is all defaults must still be named, for it isn't the scene's.
            *part = brief.get_mut(name).map_or(Value::Object(Map::new()), Value::take);
        }
    }
    value_of(&text)
}

/// The JSON of `part`, by way of text: straight to a [`Value`], an f32 of 0.1 would become
/// 0.10000000149011612.
pub(in crate::scene) fn value_of(part: &impl Serialize) -> Value {
    // Every key is a string, and what serde_json writes it also reads.
    let text = serde_json::to_string(part).expect("a part of a scene is JSON");
    serde_json::from_str(&text).expect("serde_json reads what it writes")
}

/// A path as it was read: a key still has only the parts that it names.
#[derive(Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct PathDraft {
    frames_per_second: u32,
    shutter: f64,
    #[serde(deserialize_with = "at_most::<MAX_KEYS, _, _>")]
    keys: Vec<KeyDraft>,
}

impl Default for PathDraft {
    fn default() -> Self {
        let Path { frames_per_second, shutter, .. } = Path::default();
        Self { frames_per_second, shutter, keys: Vec::new() }
    }
}

#[derive(Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
struct KeyDraft {
    time_secs: f64,
    #[serde(default)]
    easing: Easing,
    #[serde(default)]
    scene: SceneParts,
}

impl PathDraft {
    /// The path, valid, where `base` is the document's scene. Keys that name no part share one scene.
    pub fn finish(self, base: &Scene) -> Result<Path, DocumentError> {
        let Self { frames_per_second, shutter, keys } = self;
        let mut shared = None;
        let keys = keys.into_iter().map(|KeyDraft { time_secs, easing, scene }| {
            let scene = if scene.is_empty() {
                shared.get_or_insert_with(|| Arc::new(base.clone())).clone()
            } else {
                Arc::new(normalized(scene.over(base)))
            };
            Key { time_secs, easing, scene }
        });
        let path = Path { frames_per_second, shutter, keys: keys.collect() };
        path.validate()?;
        Ok(path)
    }
}
