//! Documents of every version: their defaults, and files that earlier programs wrote.

use mandelight::{
    formula::{self, Fractal},
    scene::{
        EnvironmentLight, PointLight, Scene,
        document::{self, from_json},
    },
};
use serde_json::{Value, json};

/// Documents and links leave out what has its default, so a changed default changes what they
/// show. Before a release the file may be rewritten (MANDELIGHT_BLESS=1); after one, a change
/// here needs a new `document::VERSION`.
#[test]
fn version_2_keeps_its_defaults() {
    let frozen = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/frozen/v2/defaults.json");
    let fractals: Vec<_> = formula::all().map(Fractal::new).collect();
    let defaults = format!(
        "{}\n",
        serde_json::to_string_pretty(&json!({
            "version": document::VERSION,
            "scene": Scene::default(),
            "fractals": fractals,
            "environment_light": EnvironmentLight::default(),
            "point_light": PointLight::default(),
        }))
        .unwrap()
    );
    if std::env::var_os("MANDELIGHT_BLESS").is_some() {
        std::fs::write(frozen, &defaults).unwrap();
    }
    let expected = std::fs::read_to_string(frozen).expect("tests/frozen/v2/defaults.json");
    assert_eq!(defaults, expected);
}

/// A file of `tests/frozen/v1/`, written by a program that knew version 1 only.
fn version_1(name: &str) -> Vec<u8> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/frozen/v1");
    std::fs::read(format!("{folder}/{name}")).unwrap_or_else(|error| panic!("{name}: {error}"))
}

fn version_1_text(name: &str) -> String {
    String::from_utf8(version_1(name)).expect("a text")
}

#[test]
fn version_1_keeps_its_defaults() {
    let defaults: Value = serde_json::from_str(&version_1_text("defaults.json")).unwrap();
    let read = |scene: &Value| {
        from_json(&json!({ "mandelight": "scene", "version": 1, "scene": scene }).to_string())
    };
    assert_eq!(read(&defaults["scene"]), Ok(Scene::default()));
    let light = &defaults["environment_light"];
    let lit = read(&json!({ "lights": { "environment": [light] } })).unwrap();
    assert_eq!(lit.lights.environment, [EnvironmentLight::default()]);
    let lit = read(&json!({ "lights": { "point": [defaults["point_light"]] } })).unwrap();
    assert_eq!(lit.lights.point, [PointLight::default()]);
}

/// Fails where `read` lacks a value of `written`: later versions only add fields.
fn assert_keeps(written: &Value, read: &Value, path: &str) {
    match (written, read) {
        (Value::Object(written), Value::Object(read)) => {
            for (name, value) in written {
                let kept = read.get(name).unwrap_or_else(|| panic!("{path}.{name} is lost"));
                assert_keeps(value, kept, &format!("{path}.{name}"));
            }
        }
        (Value::Array(written), Value::Array(read)) => {
            assert_eq!(written.len(), read.len(), "{path}");
            for (i, (written, read)) in written.iter().zip(read).enumerate() {
                assert_keeps(written, read, &format!("{path}[{i}]"));
            }
        }
        (Value::Number(written), Value::Number(read)) => {
            // Colours are f32.
            let [written, read] = [written, read].map(|it| it.as_f64().unwrap_or(f64::NAN) as f32);
            assert_eq!(written, read, "{path}");
        }
        // The trap at the origin is one at any point now.
        (Value::String(written), Value::String(read)) if written == "origin_trap" => {
            assert_eq!(read, "point_trap", "{path}");
        }
        _ => assert_eq!(written, read, "{path}"),
    }
}

#[test]
fn version_1_scenes_dives_paths_and_pictures_open_as_before() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/frozen/v1");
    let mut opened = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let name = entry.unwrap().file_name().into_string().unwrap();
        if !name.ends_with(".json") || ["defaults.json", "flight.json"].contains(&name.as_str()) {
            continue;
        }
        let text = version_1_text(&name);
        let scene = from_json(&text).unwrap_or_else(|error| panic!("{name}: {error}"));
        let written: Value = serde_json::from_str(&text).unwrap();
        let read = serde_json::to_value(&scene).unwrap();
        assert_keeps(&written["scene"], &read, &name);
        // What version 1 did not know is off.
        assert!(!scene.lights.follow_view && !scene.surface.coloring.follows_view, "{name}");
        opened += 1;
    }
    assert_eq!(opened, 16);
    let project = document::project_from_json(&version_1_text("flight.json")).unwrap();
    assert!(project.path.keys.len() > 2);
    let picture = std::io::Cursor::new(version_1("julia.png"));
    let text = mandelight::export::scene_text(picture).unwrap().expect("a scene");
    let carried = from_json(&text).unwrap();
    let scene = from_json(&version_1_text("julia.json")).unwrap();
    assert_eq!((carried.fractal, carried.camera), (scene.fractal, scene.camera));
}

#[test]
fn fields_of_another_formula_are_named() {
    let read = |fractal: Value| {
        let scene = json!({ "fractal": fractal });
        from_json(&json!({ "mandelight": "scene", "version": 2, "scene": scene }).to_string())
    };
    let error = |fractal: Value| read(fractal).expect_err("refused").to_string();
    let after = error(json!({ "formula": "quaternion_julia", "power": 3 }));
    assert!(after.starts_with("fractal.power: unknown field `power`"), "{after}");
    // The formula may come last: serde_json keeps the order of a text, not of a map.
    let text = "{\"mandelight\":\"scene\",\"version\":2,\"scene\":{\"fractal\":{\"slice\":0.5,\"formula\":\"mandelbulb\"}}}";
    let before = from_json(text).expect_err("refused").to_string();
    assert!(before.contains("unknown field `slice`"), "{before}");
    let unknown = error(json!({ "formula": "no_such" }));
    assert!(unknown.starts_with("fractal.formula: found the text \"no_such\""), "{unknown}");
    let short = error(json!({ "formula": "quaternion_julia", "constant": [1, 2] }));
    assert!(short.starts_with("fractal.constant: found a list of 2"), "{short}");
    let text = "{\"mandelight\":\"scene\",\"version\":2,\"scene\":{\"fractal\":{\"formula\":\"aexion\",\"julia_constant\":[0.1,0.2,0.3]}}}";
    let first = from_json(text).expect_err("refused").to_string();
    assert!(first.starts_with("fractal.julia_constant: found a list of 3"), "{first}");
    let text = "{\"mandelight\":\"scene\",\"version\":2,\"scene\":{\"fractal\":{\"julia_constant\":[0.1,0.2,0.3],\"formula\":\"aexion\"}}}";
    let short = from_json(text).expect_err("refused").to_string();
    assert!(short.contains("found a list of 3, expected a list of 4"), "{short}");
    let quaternion = read(json!({ "formula": "quaternion_julia", "slice": 0.25 })).unwrap();
    assert_eq!(quaternion.fractal.number("slice"), Some(0.25));
}

/// Documents may name fields before their formula. Only the lengths of vectors may differ.
#[test]
fn formulas_that_share_a_name_share_its_kind() {
    let fields: Vec<_> = formula::all().flat_map(|formula| formula.fields()).collect();
    for a in &fields {
        for b in fields.iter().filter(|b| b.name == a.name) {
            let kinds = [a.default(), b.default()].map(|value| std::mem::discriminant(&value));
            assert_eq!(kinds[0], kinds[1], "{}", a.name);
        }
    }
}
