//! The path's part of the document format: what keys leave out, and what is said of bad ones.

use std::sync::Arc;

use mandelight::scene::{
    EnvironmentLight, MAX_LIGHTS, Path, Project, Scene,
    document::{self, from_json, to_json},
    link,
    param::Param,
    path::{Easing, FRAME_RATE, KEY_TIME, Key, MAX_KEYS, SHUTTER},
};
use serde_json::{Value, json};

/// A document with these keys in its path.
fn with_keys(keys: Value) -> String {
    json!({ "mandelight": "scene", "version": 1, "scene": { "fractal": { "power": 5 } },
        "path": { "keys": keys } })
    .to_string()
}

#[test]
fn a_key_says_only_what_differs_from_the_scene() {
    let keys = json!([
        { "time_secs": 0 },
        { "time_secs": 2.5, "easing": "linear", "scene": { "tone": { "exposure": 1 } } },
        { "time_secs": 4, "easing": "hold", "scene": { "fractal": {} } },
    ]);
    let project = document::project_from_json(&with_keys(keys)).unwrap();
    assert_eq!((project.path.frames_per_second, project.path.shutter), (30, 0.0));
    let scenes: Vec<&Scene> = project.path.keys.iter().map(|key| &*key.scene).collect();
    assert_eq!(*scenes[0], project.scene);
    assert_eq!((scenes[1].fractal.number("power"), scenes[1].tone.exposure), (Some(5.0), 1.0));
    assert_eq!(*scenes[2], Scene::default());
    let text = document::project_to_json(&project);
    assert_eq!(text.matches("\"power\"").count(), 2, "{text}");
    assert!(!to_json(&project.scene).contains("\"path\""), "a scene alone is as it was");
}

/// The most keys, each with the most lights in many digits, none of them the scene's.
#[test]
fn what_is_written_of_the_fullest_path_is_read() {
    let light = EnvironmentLight {
        direction: glam::DVec3::new(-0.3, -0.4, -0.5).normalize().to_array(),
        color: [0.123_456_78; 3],
        intensity: 12.345_678_901_234_567,
        ..Default::default()
    };
    let mut scene = Scene::default();
    scene.lights.environment = vec![light; MAX_LIGHTS];
    let scene = Arc::new(scene);
    let key = |i| Key { time_secs: i as f64 + 0.1, easing: Easing::Linear, scene: scene.clone() };
    let path = Path { frames_per_second: 60, shutter: 0.3, keys: (0..MAX_KEYS).map(key).collect() };
    let project = Project { scene: Scene::default(), path };
    let text = document::project_to_json(&project);
    assert_eq!(document::project_from_json(&text), Ok(project), "{} bytes", text.len());
}

/// Keys that are alike deflate to next to nothing: a link that is short enough is read all the same.
#[test]
fn every_link_that_is_made_is_read() {
    let mut scene = Scene::default();
    scene.lights.environment = vec![EnvironmentLight::default(); MAX_LIGHTS];
    scene.lights.environment[7].intensity = 0.5;
    let scene = Arc::new(scene);
    let key = |i| Key { time_secs: i as f64, easing: Easing::Smooth, scene: scene.clone() };
    for count in [1, 40, MAX_KEYS] {
        let path =
            Path { frames_per_second: 24, shutter: 0.5, keys: (0..count).map(key).collect() };
        let project = Project { scene: Scene::default(), path };
        match link::project_to_fragment(&project) {
            Ok(fragment) => assert_eq!(link::project_from_fragment(&fragment), Ok(project)),
            Err(error) => assert!(count == MAX_KEYS, "{count} keys: {error}"),
        }
    }
}

#[test]
fn errors_in_a_path_name_the_key() {
    for (keys, beginning) in [
        (json!([{ "time_secs": -1 }]), "path.keys[0].time_secs: -1 is outside 0 to 3600 seconds"),
        (
            json!([{ "time_secs": 1 }, { "time_secs": 1 }]),
            "path.keys[1].time_secs: 1 is not later than the key before",
        ),
        (json!([{}]), "path.keys[0]: missing field `time_secs`"),
        (
            json!([{ "time_secs": 0, "easing": "bounce" }]),
            "path.keys[0].easing: unknown word `bounce`",
        ),
        (
            json!([{ "time_secs": 0, "scene": { "fractal": { "power": 40 } } }]),
            "path.keys[0].scene.fractal.power: 40 is outside 2 to 16",
        ),
        (
            json!([{ "time_secs": 0, "scene": { "quality": { "samples": 0.5 } } }]),
            "path.keys[0].scene.quality.samples: found the number `0.5`, expected a whole number; it takes 1 to 65536",
        ),
        (
            json!([{ "time_secs": 0, "scene": { "haze": {} } }]),
            "path.keys[0].scene.haze: unknown field `haze`",
        ),
        (
            (0..300).map(|i| json!({ "time_secs": i })).collect(),
            "path.keys: has more than 256 entries, and at most 256 are read: remove the others",
        ),
    ] {
        let error = document::project_from_json(&with_keys(keys)).expect_err("refused").to_string();
        assert!(error.starts_with(beginning), "{error}\nshould begin with\n{beginning}");
    }
    let rate = with_keys(json!([])).replace("\"keys\"", "\"frames_per_second\":0,\"keys\"");
    let error = from_json(&rate).unwrap_err().to_string();
    assert!(error.starts_with("path.frames_per_second: 0 is outside 1 to 240"), "{error}");
    let shutter = with_keys(json!([])).replace("\"keys\"", "\"shutter\":1.5,\"keys\"");
    let error = from_json(&shutter).unwrap_err().to_string();
    assert!(error.starts_with("path.shutter: 1.5 is outside 0 to 1"), "{error}");
}

#[test]
fn the_example_is_what_the_documentation_says() {
    let text = include_str!("../../../docs/examples/flight.json");
    let project = document::project_from_json(text).unwrap();
    assert_eq!((project.path.keys.len(), project.path.frame_count()), (3, 241));
    let docs = include_str!("../../../docs/paths.md");
    assert!(docs.contains("`frame_000240.png`") && docs.contains("#SBATCH --array=0-12"));
    assert!(13 * 20 >= project.path.frame_count(), "the ranges cover every frame");
}

#[test]
fn the_documentation_has_the_path_s_parameters() {
    let docs = include_str!("../../../docs/paths.md");
    for param in [&FRAME_RATE, &SHUTTER, &KEY_TIME] {
        let Param { path, unit, default, help, .. } = param;
        let range = param.range_text();
        let row = format!("| `{path}` | {} | {range} | {default} | {help} |", unit.name());
        assert!(docs.contains(&row), "docs/paths.md lacks\n{row}");
    }
}
