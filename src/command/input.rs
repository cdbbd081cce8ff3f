//! A scene from wherever it is: a document in a file or a pipe, or a picture that carries it.
//!
//! In: a name from the command line, and changes as `path=value`. Out: a valid scene, or a
//! failure that names the source and the field.

use std::{
    fs::File,
    io::{self, Read},
    path::Path,
    sync::Arc,
};

use mandelight::{
    export,
    reading::visible,
    scene::{
        Fractal, Project, Scene,
        document::{self, DocumentError},
    },
};
use serde_json::Value;

use super::{Failure, shown};

/// How much of a source is looked at, in bytes: one more than of a document, so that what is too
/// large is known as such. A picture's text stands at its start.
const MAX_SOURCE_BYTES: u64 = document::MAX_BYTES as u64 + 1;

/// Reads the scene at `source`; `-` is standard input.
pub fn read_scene(source: &Path) -> Result<Scene, Failure> {
    Ok(read_project(source)?.scene)
}

/// Reads the scene at `source` with its camera path; `-` is standard input.
pub fn read_project(source: &Path) -> Result<Project, Failure> {
    let name = if source == "-" { "standard input".into() } else { shown(source) };
    let failure = |error: &dyn std::fmt::Display| Failure::usage(format!("{name}: {error}"));

    let mut bytes = Vec::new();
    let read = if source == "-" {
        io::stdin().lock().take(MAX_SOURCE_BYTES).read_to_end(&mut bytes)
    } else {
        File::open(source).and_then(|file| file.take(MAX_SOURCE_BYTES).read_to_end(&mut bytes))
    };
    read.map_err(|error| failure(&error))?;

    let text = match export::picture_scene_text(&bytes) {
        Some(text) => text
            .map_err(|error| failure(&error))?
            .ok_or_else(|| failure(&"this picture carries no Mandelight scene"))?,
        None => String::from_utf8(bytes)
            .map_err(|_| failure(&"neither a scene document nor a PNG, JPEG, WebP or EXR"))?,
    };
    document::project_from_json(&text).map_err(|error| failure(&error))
}

/// One change to a document: a field and its new value.
#[derive(Clone, Debug)]
pub struct Change {
    path: String,
    text: String,
}

/// Parses `fractal.power=3`.
pub fn parse_change(text: &str) -> Result<Change, String> {
    match text.split_once('=') {
        Some((path, value)) if !path.trim().is_empty() => {
            Ok(Change { path: path.trim().to_owned(), text: value.trim().to_owned() })
        }
        _ => Err("write it as path=value, such as fractal.power=3".to_owned()),
    }
}

/// `scene` after all of `changes`, checked as a document is.
pub fn changed(scene: Scene, changes: &[Change]) -> Result<Scene, Failure> {
    if changes.is_empty() {
        return Ok(scene);
    }
    Ok(set(scene.into(), changes, "scene")?.scene)
}

/// `project` after all of `changes`: fields that begin with `path.` are the camera path's own,
/// all others change in the scene and in every key.
pub fn changed_project(project: Project, changes: &[Change]) -> Result<Project, Failure> {
    let (of_path, of_scenes): (Vec<Change>, Vec<Change>) =
        changes.iter().cloned().partition(|change| change.path.starts_with("path."));
    let mut project = set(project, &of_path, "")?;
    project.scene = changed(project.scene, &of_scenes)?;
    for key in &mut project.path.keys {
        key.scene = Arc::new(changed((*key.scene).clone(), &of_scenes)?);
    }
    Ok(project)
}

/// The document after `changes` to fields below `root`, checked.
fn set(project: Project, changes: &[Change], root: &str) -> Result<Project, Failure> {
    if changes.is_empty() {
        return Ok(project);
    }
    let mut json: Value = serde_json::from_str(&document::project_to_json_compact(&project))
        .map_err(Failure::failed)?;
    for Change { path, text } in changes {
        let parent = if root.is_empty() { &mut json } else { &mut json[root] };
        // A parameter of the formula goes by its own name too.
        let is_own =
            !path.contains('.') && parent.get("fractal").is_some_and(|f| f.get(path).is_some());
        let path = &if is_own { format!("fractal.{path}") } else { path.clone() };
        let field = field_mut(parent, path).ok_or_else(|| {
            Failure::usage(format!("--set: {}: there is no such field", visible(path)))
        })?;
        *field = value_like(field, text);
        if path == "fractal.formula" {
            // The new formula has defaults of its own.
            let formula = field.clone();
            let fractal = parent.get_mut("fractal").and_then(Value::as_object_mut);
            if let (Some(fractal), Ok(new)) = (fractal, formula_defaults(formula)) {
                fractal.retain(|name, _| KEPT.contains(&name.as_str()));
                for (name, value) in new {
                    fractal.entry(name).or_insert(value);
                }
            }
        }
    }
    document::project_from_json(&json.to_string()).map_err(|error| match error {
        // Lines and columns of a text that nobody has seen say nothing.
        DocumentError::Field { path, message, .. } => {
            Failure::usage(format!("--set: {path}: {message}"))
        }
        other => Failure::usage(format!("--set: {other}")),
    })
}

/// Fields that a change of the formula keeps.
const KEPT: [&str; 2] = ["formula", "section_planes"];

/// All fields of the formula of this name, with their defaults.
fn formula_defaults(formula: Value) -> Result<serde_json::Map<String, Value>, serde_json::Error> {
    let fractal: Fractal = serde_json::from_value(serde_json::json!({ "formula": formula }))?;
    serde_json::from_value(serde_json::to_value(fractal)?)
}

/// `text` as JSON, or as a plain string where it is none or replaces one.
fn value_like(old: &Value, text: &str) -> Value {
    match serde_json::from_str(text) {
        Ok(value @ Value::String(_)) => value,
        Ok(value) if !old.is_string() => value,
        _ => Value::String(text.to_owned()),
    }
}

/// The field that `path` names, such as `lights.environment[0].intensity`.
fn field_mut<'a>(scene: &'a mut Value, path: &str) -> Option<&'a mut Value> {
    path.split('.').try_fold(scene, |parent, segment| {
        let mut parts = segment.split('[');
        let named = parent.as_object_mut()?.get_mut(parts.next()?)?;
        parts.try_fold(named, |list, part| {
            let index: usize = part.strip_suffix(']')?.parse().ok()?;
            list.as_array_mut()?.get_mut(index)
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with(changes: &[&str]) -> Result<Scene, String> {
        let changes: Vec<Change> = changes.iter().map(|text| parse_change(text).unwrap()).collect();
        changed(Scene::default(), &changes).map_err(|failure| match failure {
            Failure::Usage(message) | Failure::Failed(message) => message,
        })
    }

    #[test]
    fn numbers_words_lists_and_positions_are_set() {
        let scene = with(&[
            "fractal.power = 3",
            "fractal.variant=negative_sine",
            "background.top=[0,0.5,1]",
            "lights.environment[1].intensity=7.5",
            "lights.environment[0].shadow_reach=2",
            "camera.position[2]=1.25",
        ])
        .unwrap();
        assert_eq!(scene.fractal.number("power"), Some(3.0));
        assert_eq!(scene.fractal.get("variant"), Some(&"negative_sine".into()));
        assert_eq!(scene.background.top, [0.0, 0.5, 1.0]);
        assert_eq!(scene.lights.environment[1].intensity, 7.5);
        assert_eq!(scene.lights.environment[0].shadow_reach, Some(2.0));
        assert_eq!(scene.camera.position.to_dvec3().z, 1.25);
    }

    #[test]
    fn changes_hold_together_not_one_by_one() {
        // At power 8 this bailout would be too large.
        let scene = with(&["fractal.bailout=250", "fractal.power=2"]).unwrap();
        assert_eq!(scene.fractal.bailout, 250.0);
    }

    #[test]
    fn what_cannot_be_set_is_named() {
        let said = |change| with(&[change]).unwrap_err();
        for path in [
            "fractal.pwoer",
            "lights.environment[9].color",
            "fractal[0]",
            "camera.position[",
            "fractal.",
            "",
            "[0]",
        ] {
            let change = Change { path: path.to_owned(), text: "1".to_owned() };
            assert!(
                matches!(changed(Scene::default(), &[change]), Err(Failure::Usage(_))),
                "{path:?} was accepted"
            );
        }
        assert_eq!(said("fractal.pwoer=3"), "--set: fractal.pwoer: there is no such field");
        assert!(said("fractal.power=40").contains("fractal.power: 40 is outside 2 to 16"));
        assert!(said("fractal.power=NaN").contains("fractal.power"));
        assert!(said("fractal.power=1e999").contains("fractal.power"));
        assert!(said("fractal=3").contains("fractal"));
        assert!(parse_change("fractal.power").is_err());
        assert!(parse_change("=3").is_err());
    }
}
