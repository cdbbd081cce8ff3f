//! The limits of documents: each is what the documentation says, holds, and lies above what is written.

use mandelight::scene::document::{from_json, limits::LIMITS, project_from_json};
use serde_json::{Value, json};

fn document_of(scene: Value) -> String {
    json!({ "mandelight": "scene", "version": 2, "scene": scene }).to_string()
}

#[test]
fn the_documentation_has_every_limit() {
    let docs = include_str!("../../../docs/scene.md");
    let table = docs.split("<!-- limits:").nth(1).and_then(|rest| rest.split("<!-- end").next());
    let rows = table.expect("the table of limits").lines().filter(|line| line.starts_with("| "));
    let rows: Vec<&str> = rows.skip(1).collect();
    let expected: Vec<String> =
        LIMITS.iter().map(|limit| format!("| {} | {} |", limit.what, limit.most)).collect();
    assert_eq!(rows, expected);
}

/// One entry more than each list may have, the entries themselves in order.
#[test]
fn a_list_is_refused_by_name_beyond_its_limit() {
    let light = json!({ "direction": [0, 0, 1], "strength": [1, 1, 1] });
    let stop = json!({ "position": 0.5, "color": [0, 0, 0] });
    let step = json!({ "formula": "mandelbox" });
    let lists = [
        ("lights.environment", json!({})),
        ("lights.point", json!({})),
        ("lights.rig.picture.lights", light),
        ("surface.gradient", stop.clone()),
        ("surface.second_layer.gradient", stop),
        ("fractal.section_planes", json!({})),
        ("fractal.steps", step),
    ];
    for (path, entry) in lists {
        let limit = LIMITS.iter().find(|limit| limit.what.contains(&format!("`{path}`")));
        let most = limit.unwrap_or_else(|| panic!("{path} is in no row")).most;
        let said = |count: usize| {
            let mut scene = Value::Array(vec![entry.clone(); count]);
            for field in path.rsplit('.') {
                scene = json!({ field: scene });
            }
            if path == "lights.point" {
                scene["lights"]["environment"] = json!([]);
            }
            if path == "fractal.steps" {
                scene = json!({ "fractal": { "formula": "hybrid", "steps": scene["fractal"]["steps"] } });
            }
            from_json(&document_of(scene)).map(|_| ()).map_err(|error| error.to_string())
        };
        assert_eq!(said(most), Ok(()), "{path}");
        let error = said(most + 1).expect_err(path);
        let expected = format!("{path}: has more than {most} entries, and at most {most} are read");
        assert!(error.starts_with(&expected), "{error}");
    }
}

#[test]
fn a_list_in_place_of_an_object_is_refused_at_every_depth() {
    for (scene, path) in [
        (json!([{ "power": 3 }]), "scene"),
        (json!({ "fractal": [3, 20] }), "fractal"),
        (json!({ "camera": [["0", "0", "3"]] }), "camera"),
        (json!({ "camera": { "lens": [2.8] } }), "camera.lens"),
        (json!({ "lights": { "point": [[["0", "0", "3"]]] } }), "lights.point[0]"),
        (json!({ "lights": { "rig": { "sky": [[0, 0, 0]] } } }), "lights.rig.sky"),
        (
            json!({ "lights": { "rig": { "picture": { "lights": [[[0, 0, 1], [1, 1, 1]]] } } } }),
            "lights.rig.picture.lights[0]",
        ),
        (json!({ "surface": { "gradient": [[0.5, [0, 0, 0]]] } }), "surface.gradient[0]"),
        (
            json!({ "fractal": { "section_planes": [[["0", "0", "0"]]] } }),
            "fractal.section_planes[0]",
        ),
        (
            json!({ "fractal": { "formula": "hybrid", "steps": [["mandelbox"]] } }),
            "fractal.steps[0]",
        ),
        (json!({ "quality": [] }), "quality"),
    ] {
        let error = from_json(&document_of(scene.clone())).expect_err(path).to_string();
        assert!(error.starts_with(&format!("{path}: ")), "{error}");
        assert!(error.contains(": found a list, expected "), "{error}");
        // The same in a key of a path.
        let key = json!({ "time_secs": 0, "scene": scene });
        let text =
            json!({ "mandelight": "scene", "version": 2, "scene": {}, "path": { "keys": [key] } });
        let error = project_from_json(&text.to_string()).expect_err(path).to_string();
        let in_key = format!("path.keys[0].scene.{path}: ").replace("scene.scene", "scene");
        assert!(error.starts_with(&in_key), "{error} {in_key}");
    }
    for path in [json!([30]), json!({ "keys": [[0]] })] {
        let text = json!({ "mandelight": "scene", "version": 2, "scene": {}, "path": path });
        let error = project_from_json(&text.to_string()).expect_err("a list").to_string();
        assert!(error.contains("an object with named fields"), "{error}");
    }
}

#[test]
fn a_part_of_a_key_cannot_be_null() {
    let key = json!({ "time_secs": 0, "scene": { "tone": null } });
    let text =
        json!({ "mandelight": "scene", "version": 2, "scene": {}, "path": { "keys": [key] } });
    let error = project_from_json(&text.to_string()).expect_err("null").to_string();
    assert!(error.starts_with("path.keys[0].scene.tone: found null"), "{error}");
}

#[test]
fn depth_and_odd_versions_are_refused_by_name() {
    let most = LIMITS.iter().find(|limit| limit.what.starts_with("depth")).unwrap().most;
    let nested = |depth: usize| format!("{}{}", "[".repeat(depth), "]".repeat(depth));
    // The document itself is the first level.
    let with_version = |version: &str| {
        let text = format!("{{\"mandelight\":\"scene\",\"version\":{version},\"scene\":{{}}}}");
        from_json(&text).expect_err(version).to_string()
    };
    assert!(with_version(&nested(most - 1)).starts_with("version: a list cannot be read"));
    let error = with_version(&nested(most));
    assert!(error.contains("nested more than"), "{error}");
    assert!(with_version("-1").starts_with("version: -1 cannot"));
    assert!(with_version("\"two\"").starts_with("version: \"two\" cannot"));
    assert!(with_version("{}").starts_with("version: an object cannot"));
    assert!(with_version("null").starts_with("version: none cannot"));
    let escape = with_version("\"\\u001b[2J\"");
    assert!(!escape.contains('\u{1b}') && escape.contains("\\u{1b}[2J"), "{escape}");
}

#[test]
fn names_from_a_document_are_shown_without_control_characters() {
    for scene in [
        "{\"\\u001b[2J\\u001b]0;x\\u0007\":1}",
        "{\"fractal\":{\"formula\":\"\\u001b[2J\"}}",
        "{\"fractal\":{\"\\u009b31m\":1}}",
        "{\"camera\":{\"position\":[\"\\u001b\",\"0\",\"0\"]}}",
        "{\"fractal\":{\"formula\":{\"text\":\"\\u001b[2J\"}}}",
    ] {
        let text = format!("{{\"mandelight\":\"scene\",\"version\":1,\"scene\":{scene}}}");
        let error = from_json(&text).expect_err(scene).to_string();
        let mut hidden = error.chars().filter(|c| c.is_control() && *c != '\n');
        assert_eq!(hidden.next(), None, "{error:?}");
    }
}
