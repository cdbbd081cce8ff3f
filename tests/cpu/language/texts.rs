//! Texts that are right, texts that are wrong, and the docs of both.

use std::{fmt::Write, sync::Arc};

use mandelight::{
    formula::{
        self, Formula, Fractal, TextFormula,
        language::{
            check,
            functions::FUNCTIONS,
            syntax,
            tree::{Span, TextError},
        },
        table::Kind,
    },
    scene::{
        Project, Scene, document, link,
        path::{Easing, Key},
    },
};
use proptest::prelude::*;

fn step(statements: &str) -> String {
    format!("name \"Test\";\nstep {{\n{statements}\n}}")
}

fn checked(text: &str) -> Result<check::Checked, TextError> {
    check::check(text, &syntax::parse(text)?)
}

#[test]
fn every_text_is_a_formula_with_a_source_and_a_sentence() {
    let mut count = 0;
    for (id, text) in formula::texts() {
        let made = TextFormula::new(id, text).unwrap_or_else(|error| panic!("{id}: {error}"));
        assert!(!made.sources().is_empty(), "{id} cites no source");
        let formula = formula::find(id).expect("a listed formula");
        assert!(!formula.about().is_empty() && !formula.about().ends_with('.'), "{id}");
        for param in formula.fields().iter().filter_map(|field| field.param()) {
            assert!(param.help.ends_with('.'), "{id}: {}", param.path);
        }
        count += 1;
    }
    assert!(count >= 24, "{count} texts");
}

#[test]
fn every_example_of_a_function_compiles() {
    for function in FUNCTIONS {
        assert!(function.example.contains(&format!("{}(", function.name)));
        let text = step(&format!("let x = {}; z = z + c;", function.example));
        checked(&text).unwrap_or_else(|error| panic!("{}: {error}", function.example));
    }
}

#[test]
fn errors_name_their_place_and_what_to_do() {
    let cases = [
        ("", 1, 1, "the text has no name"),
        ("name \"A\";", 1, 1, "the text has no step"),
        ("name \"A\";\nname \"B\";", 2, 1, "`name` is declared twice"),
        ("name \"A\";\nstep { z = z * }", 2, 16, "found `}`, expected an expression"),
        ("name \"A\"\nstep { }", 2, 1, "`;`"),
        ("name \"A\";\nstep { z = y; }", 2, 12, "`y` is unknown"),
        ("name \"A\";\nstep { z = lenght(z) * z; }", 2, 12, "did you mean `length`?"),
        ("name \"A\";\nstep { z = 1; }", 2, 12, "found a float, but `z` takes a vec3"),
        ("name \"A\";\nstep { z = z + vec2(1, 2); }", 2, 12, "cannot join"),
        ("name \"A\";\nstep { z = z.xyw; }", 2, 14, "does not name components"),
        ("name \"A\";\nstep { z = cross(z, 1); }", 2, 21, "`cross(x: a vec3, y: a vec3)`"),
        ("name \"A\";\nstep { z = min(z); }", 2, 12, "found 1 arguments"),
        ("name \"A\";\nstep { c = z; }", 2, 8, "only `z`, `dr` and `color` can be assigned"),
        ("name \"A\";\nstep { z.xx = z.xy; }", 2, 10, "assigned twice"),
        ("name \"A\";\nstep { let z = 1; }", 2, 12, "has a meaning already"),
        ("name \"A\";\nstep { z = select(z.x, z, c); }", 2, 19, "select(condition: a condition"),
        ("name \"A\";\nstep { z = dr * z; }", 2, 1, "does not assign `dr`"),
        (
            "name \"A\";\nparam a = 3 from 0 to 2 label \"A\";\nstep { z = z; }",
            2,
            11,
            "3 is outside 0 to 2",
        ),
        (
            "name \"A\";\nparam a = 3 from 4 to 2 label \"A\";\nstep { z = z; }",
            2,
            18,
            "range is empty",
        ),
        (
            "name \"A\";\nparam a = 1 from 0 to 2 label \"A\";\nparam a = 1 from 0 to 2 label \"A\";",
            3,
            7,
            "declared twice",
        ),
        (
            "name \"A\";\nparam a = 1.5 from 0 to 2 whole label \"A\";\nstep { z = z; }",
            2,
            7,
            "whole numbers",
        ),
        ("name \"A\";\nstep { z = 1e99 * z; }", 2, 12, "too large"),
        ("name \"A\";\nstep { z = z + 1 / 0; }", 2, 16, "is a divisor zero"),
        ("name \"A\";\nstep { let a = 1; let a = 2; }", 2, 23, "declared twice"),
        // Each declaration knows the names that have a value there.
        ("name \"A\";\nsize length(p);\nstep { z = z; }", 2, 13, "`p` has no value here"),
        ("name \"A\";\nsize dr;\nstep { z = z; }", 2, 6, "`dr` has no value here"),
        ("name \"A\";\nbound z.x;\nstep { z = z; }", 2, 7, "`z` has no value here"),
        ("name \"A\";\ninit z;\nstep { z = z; }", 2, 6, "`z` has no value here"),
        ("name \"A\";\nestimate distance c.x;\nstep { z = z; }", 2, 19, "`c` has no value here"),
        (
            "name \"A\";\nparam a = 0 from -1 to 1 logarithmic label \"A\";\nstep { z = z; }",
            2,
            18,
            "begins at 0 or above",
        ),
        (
            "name \"A\";\nparam a = 0 from 0 to 1e-9 label \"A\";\nstep { z = z; }",
            2,
            18,
            "smaller than 0.000001",
        ),
    ];
    for (text, line, column, message) in cases {
        let error = checked(text).expect_err(text);
        assert!(error.message.contains(message), "{text}: {error}");
        assert_eq!((error.line, error.column), (line, column), "{text}: {error}");
        assert!(error.span.start <= error.span.end && error.span.end <= text.len(), "{text}");
    }
}

#[test]
fn limits_are_named_where_they_are_passed() {
    let long = format!("name \"A\";\n// {}", "é".repeat(5000));
    assert!(checked(&long).expect_err("long").message.contains("8192"));
    let deep = step(&format!("z = {}z{};", "(".repeat(40), ")".repeat(40)));
    assert!(checked(&deep).expect_err("deep").message.contains("nested more than 32"));
    // Comments and quotes neither hide brackets nor count as some.
    let hidden = format!("name \"A\"; init {}z; step {{ z = z; }}", "(//)\n".repeat(1600));
    assert!(checked(&hidden).expect_err("hidden").message.contains("nested more than 32"));
    let quoted = format!("name \"A\"; about \"{0}\"; // {0}\nstep {{ z = z; }}", "(".repeat(40));
    assert_eq!(checked(&quoted).err(), None);
    let ends: String = (0..40).map(|i| format!("rotate(z, z, z.x + {i}) + ")).collect();
    let ends = format!("name \"A\"; estimate distance length({ends}z); step {{ z = z; }}");
    let error = checked(&ends).expect_err("ends");
    assert!(error.message.contains("`init`, `size`, `estimate` and `bound` have"), "{error}");
    let many = step(&"z = sin(z) * cos(z) + c;\n".repeat(80));
    let error = checked(&many).expect_err("many");
    assert!(error.message.contains("may have 512"), "{error}");
    let params: String =
        (0..13).map(|i| format!("param a{i} = vec4(0) from -1 to 1 label \"A\";\n")).collect();
    let error = checked(&format!("name \"A\";\n{params}step {{ z = z; }}")).expect_err("wide");
    assert!(error.message.contains("48 numbers"), "{error}");
    // The longest chain that fits.
    let chain = step(&format!("z = z{};", " + z".repeat(2000)));
    assert!(checked(&chain).is_err());
}

proptest! {
    #[test]
    fn no_text_panics(text in "(name \"A\";)?(step|param|let|[a-z.=;{}()+*/,0-9 \"-])*") {
        let _ = checked(&text);
    }

    #[test]
    fn no_damaged_formula_panics(
        which in 0..24_usize, at in 0.0..1.0_f64, length in 0..40_usize, insert in "[a-z0-9(){};=.,\"* +-]{0,12}"
    ) {
        let (_, text) = formula::texts().nth(which).expect("a text");
        let start = (at * text.len() as f64) as usize;
        let end = (start + length).min(text.len());
        let damaged = format!("{}{insert}{}", &text[..start], &text[end..]);
        if let Ok(tree) = syntax::parse(&damaged)
            && let Err(error) = check::check(&damaged, &tree)
        {
            let Span { start, end } = error.span;
            prop_assert!(damaged.get(start..end).is_some());
        }
    }
}

/// The table of functions in the docs.
fn function_table() -> String {
    let mut table = "| function | what it computes | example |\n|---|---|---|\n".to_owned();
    for function in FUNCTIONS {
        let arguments: Vec<_> = function.arguments.iter().map(|(name, _)| *name).collect();
        let call = format!("{}({})", function.name, arguments.join(", "));
        writeln!(table, "| `{call}` | {} | `{}` |", function.help, function.example).unwrap();
    }
    table
}

/// The sections of formulas in the docs.
fn sections(texts: impl Iterator<Item = (&'static str, &'static str)>) -> String {
    let mut text = String::new();
    for (id, source) in texts {
        let made = TextFormula::new(id, source).expect("a formula");
        let formula: &dyn Formula = &made;
        writeln!(text, "### {}\n\n`{id}`: {}.\n", formula.name(), formula.about()).unwrap();
        for source in made.sources() {
            writeln!(text, "- Source: {source}").unwrap();
        }
        let own = formula.fields().iter().filter(|field| !field.name.starts_with("julia"));
        for field in own {
            let (label, range, help) = match field.kind {
                Kind::Number { param, .. } => (
                    param.label,
                    format!("{}, default {}", param.range_text(), param.default),
                    param.help,
                ),
                Kind::Vector { param, default, .. } => (
                    param.label,
                    format!("{} each, default {default:?}", param.range_text()),
                    param.help,
                ),
                Kind::Switch { label, default, options } => {
                    (label, format!("a switch, default {default}"), options[1].help)
                }
                Kind::Choice { label, .. } => (label, String::new(), ""),
            };
            writeln!(text, "- `{}`, {label} ({range}): {help}", field.name).unwrap();
        }
        text.push('\n');
    }
    text
}

#[test]
fn the_docs_list_functions_and_formulas() {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/formulas.md");
    let mut text = std::fs::read_to_string(file).expect("docs/formulas.md");
    for (mark, expected) in [
        ("functions", function_table()),
        ("formulas", sections(formula::texts())),
        ("steps", sections(formula::step_texts())),
    ] {
        let begin = format!("<!-- {mark}:");
        let end = format!("<!-- end of {mark} -->");
        let (before, rest) = text.split_once(&begin).expect("the mark before");
        let (note, rest) = rest.split_once("-->\n").expect("the mark's end");
        let (found, after) = rest.split_once(&end).expect("the mark after");
        if std::env::var_os("MANDELIGHT_BLESS").is_some() {
            text = format!("{before}{begin}{note}-->\n{expected}{end}{after}");
        } else {
            assert_eq!(
                found, expected,
                "MANDELIGHT_BLESS=1 cargo test --test cpu language writes it"
            );
        }
    }
    if std::env::var_os("MANDELIGHT_BLESS").is_some() {
        std::fs::write(file, text).unwrap();
    }
}

/// The text in the docs is a formula, and its declarations are all there are.
#[test]
fn the_docs_example_compiles() {
    let text =
        std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/formulas.md")).unwrap();
    let example: String = text
        .lines()
        .skip_while(|line| !line.starts_with("    name"))
        .take_while(|line| line.is_empty() || line.starts_with("    "))
        .fold(String::new(), |all, line| all + line.trim_start() + "\n");
    checked(&example).unwrap_or_else(|error| panic!("{error}"));
}

/// A formula that no file of the program has.
const OWN: &str = "name \"Own\";\n// A comment.\nparam alpha = vec3(0.1, 0.2, 0.3) from -1 to 1 label \"Alpha\";\n\
                   param zoom = 2 from 1 to 3 label \"Zoom\";\nstep { z = zoom * box_fold(z, 1) + alpha + c; }\nestimate linear;\n";

#[test]
fn texts_travel_in_documents_and_links() {
    let formula = formula::own::of_text(OWN).expect("a formula");
    assert_eq!(formula::own::of_text(OWN), Ok(formula), "one formula of one text");
    let mut scene = Scene { fractal: Fractal::new(formula), ..Scene::default() };
    assert!(scene.fractal.set("alpha", [0.4, 0.5, 0.6]) && scene.fractal.set("julia", true));
    let json = document::to_json(&scene);
    assert!(json.contains("A comment."), "{json}");
    assert_eq!(document::from_json(&json), Ok(scene.clone()));
    let fragment = link::to_fragment(&scene).expect("a link");
    assert_eq!(link::from_fragment(&fragment), Ok(scene.clone()));
    // A key of a path has it too.
    let mut project = Project::from(scene.clone());
    project.path.keys.push(Key {
        time_secs: 0.0,
        easing: Easing::default(),
        scene: Arc::new(scene),
    });
    let json = document::project_to_json(&project);
    assert_eq!(document::project_from_json(&json), Ok(project));
}

#[test]
fn the_text_of_a_formula_of_the_program_is_that_formula() {
    for (id, text) in formula::texts() {
        assert_eq!(formula::own::of_text(text), Ok(formula::find(id).expect("a formula")));
    }
    // The bulb has kernels of its own, and a text for hybrids.
    let (_, bulb) = formula::step_texts().find(|(id, _)| *id == "mandelbulb").expect("a text");
    assert_eq!(formula::own::of_text(bulb).map(|formula| formula.text()), Ok(None));
}

#[test]
fn a_transform_draws_nothing_alone() {
    let text = "name \"Turn\";\nstep { z = vec3(z.y, -z.x, z.z); }\nestimate none;\n";
    let error = formula::own::alone(text).expect_err("refused");
    assert_eq!((error.line, error.column), (3, 1), "{error}");
    assert!(formula::own::of_text(text).is_ok());
    let read = |fractal: serde_json::Value| {
        let document = serde_json::json!({ "mandelight": "scene", "version": 2, "scene": { "fractal": fractal } });
        document::from_json(&document.to_string())
    };
    let turn = serde_json::json!({ "text": text });
    let alone = read(serde_json::json!({ "formula": turn })).expect_err("refused").to_string();
    assert!(alone.starts_with("fractal.formula: line 3, column 1: `estimate none`"), "{alone}");
    let steps = serde_json::json!([{ "formula": turn }, { "formula": "mandelbox" }]);
    read(serde_json::json!({ "formula": "hybrid", "steps": steps })).expect("a hybrid");
}

#[test]
fn a_wrong_text_in_a_document_is_named_by_line_and_column() {
    let read = |formula: serde_json::Value| {
        let document = serde_json::json!({ "mandelight": "scene", "version": 2,
            "scene": { "fractal": { "formula": formula } } });
        document::from_json(&document.to_string()).expect_err("refused").to_string()
    };
    let wrong = read(serde_json::json!({ "text": "name \"A\";\nstep { z = zz; }" }));
    assert!(wrong.starts_with("fractal.formula: line 2, column 12: `zz` is unknown"), "{wrong}");
    assert!(read(serde_json::json!({ "source": "x" })).contains("unknown field `source`"));
    assert!(read(serde_json::json!({})).contains("missing field `text`"));
    assert!(read(serde_json::json!(3)).contains("a formula's id or text"));
}

#[test]
fn a_document_may_bring_64_formulas() {
    let own = |i: usize| format!("name \"Many {i}\"; step {{ z = z + c + {i}; }}");
    let steps = |first: usize| -> Vec<_> {
        let step = |i| serde_json::json!({ "formula": { "text": own(i) } });
        (9 * first..9 * first + 9).map(step).collect()
    };
    let key = |i: usize| serde_json::json!({ "time_secs": i, "scene": { "fractal": { "formula": "hybrid", "steps": steps(i) } } });
    let read = |keys: usize| {
        let keys: Vec<_> = (0..keys).map(key).collect();
        let document = serde_json::json!({ "mandelight": "scene", "version": 2, "scene": {}, "path": { "keys": keys } });
        document::project_from_json(&document.to_string())
    };
    let error = read(8).expect_err("72 formulas").to_string();
    assert!(error.contains("a document may bring 64 formulas"), "{error}");
    // Those that are known do not count.
    read(8).expect("known formulas");
}

#[test]
fn bounds_hold_what_is_drawn() {
    let fractal = |id: &str, values: &[(&str, formula::table::Value)]| {
        let mut fractal = Fractal::new(formula::find(id).expect("a formula"));
        for (name, value) in values {
            assert!(fractal.set(name, value.clone()), "{name}");
        }
        fractal
    };
    let julia = ("julia", true.into());
    let turned = ("rotation", [180.0, 0.0, 0.0].into());
    for (fractal, radius) in [
        // A fixed point of the Julia form at (5.3, 6.8, 4.9).
        (fractal("amazing_box_mod", &[julia]), 9.9),
        // (0, 10, 0) has an orbit of period 2.
        (fractal("amazing_box_mod", &[turned]), 10.0),
        (fractal("mandelbox", &[("scale", 1.1.into())]), 42.0),
        (fractal("box_fold_bulb", &[("fold_limit", 0.2.into()), ("height", 0.0.into())]), 2.5),
        (fractal("quaternion_mandelbrot", &[]).with_iterations(2), 1.4),
    ] {
        let found = fractal.distance_field().bounding_radius();
        assert!(found >= radius, "{:?}: {found}", fractal.formula().id());
        assert!(found < 12.0 * radius, "{:?}: {found}", fractal.formula().id());
    }
}

#[test]
fn a_power_overflows_from_no_bailout_that_is_allowed() {
    for power in [2.0, 8.0, 16.0] {
        let mut fractal = Fractal::new(formula::find("juliabulb").expect("a formula"));
        assert!(fractal.set("power", power));
        let most = fractal.max_bailout();
        let is_limit = most == formula::param::BAILOUT.max || most.powf(power) > 1e12;
        assert!(most.powf(power) < 1.8e19 && is_limit, "{power}: {most}");
    }
    let folds = Fractal::new(formula::find("mandelbox").expect("a formula"));
    assert_eq!(folds.max_bailout(), formula::param::BAILOUT.max);
}
