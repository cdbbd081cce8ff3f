//! The document format: every parameter's range, what is said of bad documents, the defaults
//! that version 1 is bound to, and links.

use std::fmt::Write;

use mandelight::{
    formula::{self, FormulaRef, Fractal, mandelbulb::Mandelbulb, section::SectionPlane},
    scene::{
        EnvironmentLight, EnvironmentMapRig, GradientStop, Lights, PointLight, Rig, RigLight,
        Scene,
        document::{self, DocumentError, from_json, to_json, to_json_compact},
        link::{self, LinkError, from_fragment, to_fragment},
        param::{self, Param, Scale},
    },
};
use serde_json::{Value, json};

/// A link made without this program.
const HAND_MADE: &str = "s1=HYwxCoAwDAC_UjKLg-LiV0Sk1GgLNZU2WKTk7wa3uxuuQQyn5wKzaYD0hJzoQmL1pUHxdk91y2id1zJ0BgIxUgn8qo-yiqYjW8c2_os7VcxKUz-JfA";

/// A document in which every parameter's path exists, at index 0 where it is indexed.
fn full_document(formula: FormulaRef) -> Value {
    let mut scene = Scene { fractal: Fractal::new(formula), ..Default::default() };
    // The power that allows every bailout of the table; other formulas have no such field.
    scene.fractal.set("power", 2.0);
    scene.fractal.section_planes = vec![SectionPlane::default()];
    let light = RigLight { direction: [0.0, 0.0, 1.0], strength: [1.0; 3] };
    let environment_map = EnvironmentMapRig { lights: vec![light], ..Default::default() };
    scene.lights = Lights {
        rig: Rig { environment_map, ..Default::default() },
        environment: vec![EnvironmentLight { shadow_reach: Some(1.0), ..Default::default() }],
        point: vec![PointLight::default()],
        follow_view: true,
    };
    scene.surface.gradient = vec![GradientStop { position: 0.5, color: [1.0; 3] }];
    serde_json::from_str(&to_json(&scene)).unwrap()
}

/// The field at a path such as `lights.point[0].intensity` in a document.
fn field<'a>(document: &'a mut Value, path: &str) -> &'a mut Value {
    let pointer = format!("/scene/{}", path.replace(['.', '['], "/").replace(']', ""));
    document.pointer_mut(&pointer).unwrap_or_else(|| panic!("no field {path}"))
}

fn number(param: &Param, value: f64) -> Value {
    if param.scale == Scale::Integer { json!(value as i64) } else { json!(value) }
}

/// Every formula with every parameter that its scenes have.
fn every_param() -> impl Iterator<Item = (FormulaRef, &'static Param)> {
    formula::all().flat_map(|formula| param::of(formula).map(move |param| (formula, param)))
}

fn read_with(path: &str, value: Value) -> Result<Scene, DocumentError> {
    read_formula_with(FormulaRef::default(), path, value)
}

fn read_formula_with(
    formula: FormulaRef,
    path: &str,
    value: Value,
) -> Result<Scene, DocumentError> {
    let mut document = full_document(formula);
    *field(&mut document, path) = value;
    from_json(&document.to_string())
}

#[test]
fn every_parameter_is_held_to_its_range() {
    for (formula, param) in every_param() {
        let path = param.path_at(0);
        for inside in [param.min, param.max, param.default] {
            if let Err(error) = read_formula_with(formula, &path, number(param, inside)) {
                panic!("{path} = {inside} was refused: {error}");
            }
        }
        let (below, above) = match param.scale {
            Scale::Integer => (param.min - 1.0, param.max + 1.0),
            _ => (param.min.next_down(), param.max.next_up()),
        };
        for outside in [below, above] {
            match read_formula_with(formula, &path, number(param, outside)) {
                Err(DocumentError::Invalid(invalid)) => {
                    assert_eq!(invalid.path, path);
                    assert!(invalid.message.ends_with(&param.range_text()), "{invalid}");
                }
                // A whole number below 0 is of no kind that the field can hold.
                Err(DocumentError::Field { path: found, message, .. }) if outside < 0.0 => {
                    assert_eq!(found, path);
                    assert!(message.ends_with(&param.range_text()), "{message}");
                }
                other => panic!("{path} = {outside} gave {other:?}"),
            }
        }
    }
}

#[test]
fn numbers_that_are_not_finite_are_refused_by_name() {
    for (formula, param) in every_param() {
        let path = param.path_at(0);
        let mut document = full_document(formula);
        *field(&mut document, &path) = json!("HERE");
        // As far as JSON goes toward infinity; not-a-number cannot be written at all.
        let text = document.to_string().replace("\"HERE\"", "1e999");
        let error = from_json(&text).expect_err(&path).to_string();
        assert!(error.starts_with(&path), "{path}: {error}");
    }
    let mut scene = Scene::default();
    scene.tone.exposure = f64::NAN;
    assert_eq!(scene.validate().unwrap_err().path, "tone.exposure");
    scene = Scene::default();
    scene.lights.environment[1].direction[2] = f64::INFINITY;
    assert_eq!(scene.validate().unwrap_err().path, "lights.environment[1].direction");
}

#[test]
fn scalar_defaults_are_those_of_the_parameter_table() {
    let stop = json!({ "position": 0.0, "color": [1, 1, 1] });
    for (formula, param) in every_param() {
        let mut document = json!({ "mandelight": "scene", "version": 2, "scene": {
            "fractal": { "formula": formula.id(), "section_planes": [{}] },
            "lights": { "environment": [{}], "point": [{}] }, "surface": { "gradient": [stop] } } });
        let scene = from_json(&document.to_string()).unwrap();
        document = serde_json::from_str(&to_json(&scene)).unwrap();
        let path = param.path_at(0);
        // Some defaults are not one number: a point in space, "the whole scene", "no height", "no limit".
        if [&param::SHADOW_REACH, &param::FOG_HEIGHT, &param::FIREFLY_LIMIT].contains(&param)
            || param.path.starts_with("fractal.") && param.path.ends_with("[]")
        {
            continue;
        }
        let default = match path.as_str() {
            "fractal.iterations" => formula.default_iterations().map(f64::from),
            "fractal.bailout" => formula.default_bailout(),
            _ => None,
        };
        let default = default.unwrap_or(param.default);
        assert_eq!(field(&mut document, &path).as_f64(), Some(default), "{path}");
    }
}

#[test]
fn the_tone_curve_is_still_read_by_its_first_name() {
    let scene = read_with("tone.curve", json!("reinhard_luminance")).unwrap();
    assert_eq!(scene.tone, Scene::default().tone);
}

/// The error that a scene's JSON gives.
fn error_of(scene: Value) -> String {
    let document = json!({ "mandelight": "scene", "version": 1, "scene": scene });
    from_json(&document.to_string()).expect_err("refused").to_string()
}

#[test]
fn errors_name_the_field_and_say_what_is_wrong() {
    let lights = |n| json!({ "lights": { "point": vec![json!({}); n] } });
    let stop = |position| json!({ "position": position, "color": [0, 0, 0] });
    let gradient = |stops: Vec<Value>| json!({ "surface": { "gradient": stops } });
    let eye = json!(["0.1", "0", "2"]);
    let rig_light = |direction: Value, strength: Value| {
        let light = json!({ "direction": direction, "strength": strength });
        json!({ "lights": { "rig": { "picture": { "lights": [light] } } } })
    };
    for (scene, beginning) in [
        (
            json!({ "lights": { "environment": [{}, {}, { "intensity": 1000 }] } }),
            "lights.environment[2].intensity: 1000 is outside 0 to 100",
        ),
        (
            json!({ "camera": { "vertical_fov_deg": 1e200 } }),
            "camera.vertical_fov_deg: 1e200 is outside 5 to 120 degrees",
        ),
        (
            json!({ "quality": { "samples": 2.5 } }),
            "quality.samples: found the number `2.5`, expected a whole number; it takes 1 to 65536, whole numbers",
        ),
        (
            json!({ "fractal": { "powr": 8 } }),
            "fractal.powr: unknown field `powr`, expected one of `formula`",
        ),
        (json!({ "fractal": { "variant": "other" } }), "fractal.variant: unknown word `other`"),
        (json!({ "haze": {} }), "haze: unknown field `haze`"),
        (
            json!({ "fractal": { "power": 16, "bailout": 16 } }),
            "fractal.bailout: 16 is above 15.98, the most that power 16 allows",
        ),
        (
            json!({ "camera": { "position": eye, "pivot": eye } }),
            "camera.pivot: is 0 from camera.position",
        ),
        (
            json!({ "camera": { "position": ["0", "x", "0"] } }),
            "camera.position[1]: \"x\" is not a decimal number",
        ),
        (
            json!({ "camera": { "pivot": ["0", "0", "1e9"] } }),
            "camera.pivot[2]: \"1e9\" is farther than 100",
        ),
        (
            json!({ "camera": { "orientation": [0, 0, 0, 1.01] } }),
            "camera.orientation: has length 1.01",
        ),
        (
            json!({ "lights": { "environment": [{ "direction": [0, 0, 0] }] } }),
            "lights.environment[0].direction: has length 0",
        ),
        (
            json!({ "lights": { "point": [{ "color": [0, 1.5, 0] }] } }),
            "lights.point[0].color[1]: 1.5 is outside 0 to 1",
        ),
        (
            rig_light(json!([0, 0, 0.5]), json!([1, 1, 1])),
            "lights.rig.picture.lights[0].direction: has length 0.5",
        ),
        (
            rig_light(json!([0, 0, 1]), json!([1, -1, 1])),
            "lights.rig.picture.lights[0].strength[1]: -1 is outside 0 to 1000000",
        ),
        (
            json!({ "lights": { "rig": { "kind": "sky", "count": 62 } } }),
            "lights: 65 lights are too many",
        ),
        (
            json!({ "lights": { "rig": { "sky": { "sun_direction": [0, 0, 2] } } } }),
            "lights.rig.sky.sun_direction: has length 2",
        ),
        (
            json!({ "lights": { "rig": { "picture": { "name": "x".repeat(201) } } } }),
            "lights.rig.picture.name: has 201 characters",
        ),
        (json!({ "background": { "top": [0, 0, -1] } }), "background.top[2]: -1 is outside 0 to 1"),
        // The three environment lights of the default, and these.
        (lights(62), "lights: 65 lights are too many; a scene has at most 64"),
        (gradient(vec![]), "surface.gradient: has 0 stops"),
        (
            gradient(vec![stop(0.5); 65]),
            "surface.gradient: has more than 64 entries, and at most 64 are read",
        ),
        (gradient(vec![stop(0.5), stop(0.2)]), "surface.gradient[1].position: 0.2 lies before"),
        (gradient(vec![json!({ "position": 0 })]), "surface.gradient[0]: missing field `color`"),
    ] {
        let error = error_of(scene);
        assert!(error.starts_with(beginning), "{error}\nshould begin with\n{beginning}");
    }
    assert!(
        from_json(&json!({ "mandelight": "scene", "version": 1, "scene": lights(61) }).to_string())
            .is_ok()
    );
}

#[test]
fn a_document_that_is_none_says_so() {
    for (text, beginning) in [
        ("", "line 1, column 0: the text ends too early"),
        ("{\"mandelight\": \"scene\"", "line 1, column 22: the text ends too early"),
        (
            "{\"mandelight\": \"scene\" \"version\": 1}",
            "line 1, column 24: a comma or } is missing",
        ),
        (
            "{\n  \"mandelight\": \"scene\",\n  oops",
            "line 3, column 3: the name of a field must stand in double quotes",
        ),
        ("[]", "not a Mandelight scene"),
        ("[\"scene\", 1, {}]", "not a Mandelight scene"),
        ("12", "not a Mandelight scene"),
        ("{}", "not a Mandelight scene"),
        ("{\"mandelight\": \"recipe\", \"version\": 1}", "not a Mandelight scene"),
        (
            "{\"mandelight\": \"scene\", \"scene\": {}}",
            "version: none cannot be read; this program reads versions 1 to 2",
        ),
        ("{\"mandelight\": \"scene\", \"version\": 3, \"stage\": {}}", "version: 3 cannot be read"),
        ("{\"mandelight\": \"scene\", \"version\": \"1\"}", "version: \"1\" cannot be read"),
        (
            "{\"mandelight\": \"scene\", \"version\": 1}",
            "document: missing field `scene` (line 1, column 37)",
        ),
        (
            "{\"mandelight\": \"scene\", \"version\": 1, \"scene\": {}, \"x\": 0}",
            "x: unknown field `x`",
        ),
        (
            "{\"mandelight\": \"scene\", \"version\": 1, \"scene\": {\"tone\": {}, \"tone\": {}}}",
            "scene: duplicate field `tone`",
        ),
        (
            "{\"mandelight\": \"scene\", \"version\": 1, \"scene\": {}} {}",
            "line 1, column 52: there is more text after",
        ),
    ] {
        let error = from_json(text).expect_err(text).to_string();
        assert!(error.starts_with(beginning), "{text}\ngave\n{error}");
    }
    let long = format!("{}{}", to_json(&Scene::default()), " ".repeat(document::MAX_BYTES));
    assert!(matches!(from_json(&long), Err(DocumentError::TooLarge { .. })));
}

#[test]
fn what_is_left_out_takes_its_default() {
    let bare = "\u{feff}{\"mandelight\": \"scene\", \"version\": 1, \"scene\": {}}";
    assert_eq!(from_json(bare), Ok(Scene::default()));
}

#[test]
fn a_direction_written_with_three_digits_is_brought_to_length_one() {
    let scene = read_with("lights.environment[0].direction", json!([0.707, 0.0, 0.707])).unwrap();
    let [x, _, z] = scene.lights.environment[0].direction;
    assert_eq!(x, z);
    assert!((x.hypot(z) - 1.0).abs() < 1e-15);
}

#[test]
fn both_forms_of_the_document_hold_the_same_scene() {
    let scene = Scene::default();
    assert_eq!(from_json(&to_json(&scene)), Ok(scene.clone()));
    assert_eq!(from_json(&to_json_compact(&scene)), Ok(scene.clone()));
    assert!(!to_json_compact(&scene).contains('\n'));
    assert!(
        to_json(&scene).contains("\n    \"fractal\": {\n      \"formula\": \"mandelbulb\",\n"),
        "{}",
        to_json(&scene)
    );
}

#[test]
fn links_from_before_still_open() {
    // Power 5.5, one environment light of intensity 3 with a reach of 2; made by another
    // deflate (zlib) from JSON written by hand.
    let scene = from_fragment(HAND_MADE).unwrap();
    assert_eq!(scene.fractal.number("power"), Some(5.5));
    assert_eq!(scene.lights.environment.len(), 1);
    assert_eq!(scene.lights.environment[0].shadow_reach, Some(2.0));
    assert_eq!(scene.lights.environment[0].color, EnvironmentLight::default().color);
    assert_eq!(scene.camera, Scene::default().camera);
}

#[test]
fn links_are_short() {
    let default = to_fragment(&Scene::default()).unwrap();
    let mut scene = Scene::default();
    scene.camera = mandelight::scene::Camera::looking_at(
        glam::DVec3::new(0.713_482_913, -0.981_723_412, 0.612_349_871),
        glam::DVec3::new(0.412_343_211, -0.512_341_234, 0.423_123_412),
        glam::DVec3::Z,
    );
    scene.fractal.set("power", 7.25);
    let moved = to_fragment(&scene).unwrap();
    // docs/scene.md states these lengths.
    assert_eq!(default.len(), 9, "{default}");
    assert!((210..=250).contains(&moved.len()), "{} characters", moved.len());
}

#[test]
fn a_scene_too_large_for_a_link_says_so() {
    let mut scene = Scene::default();
    let digits = |seed: u64| (seed as f64 * 0.618_033_988_749_895).fract();
    scene.lights.point = (0..61)
        .map(|i| PointLight {
            position: glam::DVec3::from_array([i, i + 100, i + 200].map(digits)).into(),
            color: [i + 300, i + 400, i + 500].map(|seed| digits(seed) as f32),
            intensity: digits(i + 600),
            ..Default::default()
        })
        .collect();
    scene.validate().unwrap();
    match to_fragment(&scene) {
        Ok(link) => assert_eq!(from_fragment(&link), Ok(scene)),
        Err(error) => assert!(matches!(error, LinkError::TooLong { .. }), "{error}"),
    }
}

#[test]
fn bad_links_are_told_apart() {
    let deflated = |text: &str| {
        use base64::Engine;
        let bytes = miniz_oxide::deflate::compress_to_vec(text.as_bytes(), 9);
        format!("s1={}", base64::engine::general_purpose::URL_SAFE_NO_PAD.encode(bytes))
    };
    let good = to_fragment(&Scene {
        quality: mandelight::scene::Quality { samples: 99, ..Default::default() },
        ..Default::default()
    })
    .unwrap();
    assert_eq!(from_fragment(&format!("#{good}")).unwrap().quality.samples, 99);

    assert_eq!(from_fragment(""), Err(LinkError::NotAScene));
    assert_eq!(from_fragment("#section-2"), Err(LinkError::NotAScene));
    assert_eq!(from_fragment("#s3=abc"), Err(LinkError::Version { found: "3".into() }));
    assert_eq!(from_fragment("#s1="), Err(LinkError::Damaged));
    assert_eq!(from_fragment("#s1=!!!"), Err(LinkError::Damaged));
    assert_eq!(from_fragment(&good[..good.len() - 4]), Err(LinkError::Damaged));
    let long = format!("s1={}", "A".repeat(link::MAX_FRAGMENT_BYTES));
    assert!(matches!(from_fragment(&long), Err(LinkError::TooLong { .. })));
    let bomb = deflated(&" ".repeat(4 << 20));
    assert!(bomb.len() < link::MAX_FRAGMENT_BYTES);
    assert_eq!(from_fragment(&bomb), Err(LinkError::TooLarge));
    let hang = from_fragment(&deflated("{\"fractal\":{\"iterations\":4000000000}}")).unwrap_err();
    assert_eq!(
        hang.to_string(),
        "the link's scene: fractal.iterations: 4e9 is outside 2 to 100, whole numbers"
    );
}

/// The rows of the table in `docs/scene.md`.
fn parameter_table() -> String {
    let mut table =
        "| path | unit | range | default | what it does |\n|---|---|---|---|---|\n".to_owned();
    let vectors = FormulaRef::default().fields();
    // `docs/formulas.md` lists the parameters of the other formulas.
    for param in param::of(FormulaRef::default()) {
        // Some defaults are not the table's single number.
        let vector = vectors.iter().find_map(|field| match (field.param(), field.default()) {
            (Some(own), formula::table::Value::Vector(numbers)) if own == param => Some(numbers),
            _ => None,
        });
        let default = match param {
            _ if vector.is_some() => json!(vector).to_string(),
            p if p == &param::SHADOW_REACH => "null".into(),
            p if p == &param::STOP_POSITION => "none".into(),
            p => p.default.to_string(),
        };
        let whole = if param.scale == Scale::Integer { ", whole" } else { "" };
        let (path, unit) = (param.path, param.unit.name());
        let (min, max, help) = (param.min, param.max, param.help);
        writeln!(table, "| `{path}` | {unit} | {min} to {max}{whole} | {default} | {help} |")
            .unwrap();
    }
    table
}

#[test]
fn the_docs_list_every_parameter() {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/scene.md");
    let text = std::fs::read_to_string(file).expect("docs/scene.md");
    let (before, rest) = text.split_once("<!-- parameters:").expect("the mark before the table");
    let (mark, rest) = rest.split_once("-->\n").expect("the mark's end");
    let (table, after) =
        rest.split_once("<!-- end of parameters -->").expect("the mark after the table");
    if std::env::var_os("MANDELIGHT_BLESS").is_some() {
        let blessed = format!(
            "{before}<!-- parameters:{mark}-->\n{}<!-- end of parameters -->{after}",
            parameter_table()
        );
        std::fs::write(file, blessed).unwrap();
    } else {
        assert_eq!(
            table,
            parameter_table(),
            "MANDELIGHT_BLESS=1 cargo test --test cpu document writes it anew"
        );
    }
}

#[test]
fn the_docs_example_can_be_read() {
    let text =
        std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/scene.md")).unwrap();
    let (_, rest) = text.split_once("```json\n").unwrap();
    let scene = from_json(rest.split_once("```").unwrap().0).unwrap();
    assert_eq!(scene.tone.exposure, 0.5);
    for power in [8.0, 16.0] {
        let most = Mandelbulb { power, ..Default::default() }.max_bailout();
        assert!(text.contains(&format!("{most:.2} for power {power}")), "{most}");
    }
    // Every field of the default document is named in the docs, by its last word.
    fn names(value: &Value, found: &mut Vec<String>) {
        match value {
            Value::Object(fields) => fields.iter().for_each(|(name, value)| {
                found.push(name.clone());
                names(value, found);
            }),
            Value::Array(list) => list.iter().for_each(|value| names(value, found)),
            _ => {}
        }
    }
    let mut found = Vec::new();
    names(&full_document(FormulaRef::default())["scene"], &mut found);
    assert!(found.len() > 40);
    for name in found {
        assert!(text.contains(&name), "docs/scene.md does not name {name}");
    }
}
