//! Hybrids as data: in documents, links and paths, and what is refused.

use std::sync::Arc;

use glam::DVec3;
use mandelight::{
    formula::{
        self, Fractal, HybridStep, HybridSteps,
        hybrid::{self, HybridError},
    },
    scene::{
        Project, Scene, document, link,
        path::{Easing, Key},
    },
};
use serde_json::{Value, json};

fn step(id: &str) -> HybridStep {
    hybrid::step(hybrid::find_step(id).expect("a step's formula")).expect("a step")
}

fn of(ids: &[&str]) -> HybridSteps {
    HybridSteps { steps: ids.iter().map(|id| step(id)).collect(), loop_start: 0 }
}

/// A hybrid in which nothing has its default value.
fn unusual() -> Scene {
    let mut steps = of(&["rotate", "mandelbox", "mandelbulb"]);
    steps.loop_start = 1;
    steps.steps[0].repeats = 3;
    assert!(steps.steps[0].set("rotation", [10.0, 20.0, -30.0]));
    assert!(steps.steps[1].set("scale", -1.5));
    let mut fractal = hybrid::fractal(steps).expect("a hybrid");
    assert!(fractal.set("julia", true) && fractal.set("julia_constant", [0.1, 0.2, 0.3]));
    fractal.iterations = 23;
    Scene { fractal, ..Scene::default() }
}

#[test]
fn hybrids_travel_in_documents_links_and_paths() {
    let scene = unusual();
    assert_eq!(scene.validate(), Ok(()));
    let json = document::to_json(&scene);
    assert_eq!(document::from_json(&json), Ok(scene.clone()));
    let fragment = link::to_fragment(&scene).expect("a link");
    assert!(fragment.starts_with("s2="));
    assert_eq!(link::from_fragment(&fragment), Ok(scene.clone()));
    // With default values, of which none is in the link.
    let plain = hybrid::fractal(of(&["quaternion_julia", "box_fold"])).expect("a hybrid");
    let plain = Scene { fractal: plain, ..Scene::default() };
    let fragment = link::to_fragment(&plain).expect("a link");
    assert_eq!(link::from_fragment(&fragment), Ok(plain));
    let mut project = Project::from(scene.clone());
    let key =
        |time_secs, scene| Key { time_secs, easing: Easing::default(), scene: Arc::new(scene) };
    let mut later = scene.clone();
    assert!(later.fractal.steps_mut()[1].set("scale", -2.5));
    project.path.keys = vec![key(0.0, scene), key(2.0, later)];
    let json = document::project_to_json(&project);
    assert_eq!(document::project_from_json(&json), Ok(project.clone()));
    let fragment = link::project_to_fragment(&project).expect("a link");
    assert_eq!(link::project_from_fragment(&fragment), Ok(project.clone()));
    // Between two keys, the step's number lies between theirs.
    let middle = project.path.at(1.0).expect("a scene");
    let hybrid = middle.fractal.hybrid().expect("a hybrid");
    let scale = hybrid.steps[1].fields().find(|(field, _)| field.name == "scale").expect("a scale");
    assert_eq!(*scale.1, formula::table::Value::Number(-2.0));
}

#[test]
fn the_text_of_the_bulb_keeps_the_sign_of_its_sine() {
    let mut bulb = Fractal::default();
    assert!(
        bulb.set("variant", formula::table::Value::Choice("negative_sine"))
            && bulb.set("power", 5.0)
    );
    let step = hybrid::step_of(&bulb).expect("a step");
    let (_, text) = formula::step_texts().find(|(id, _)| *id == "mandelbulb").expect("a text");
    let edited = formula::own::of_text(&format!("{text}// Edited.\n")).expect("a formula");
    let edited = formula::own::with_values_of(edited, &bulb);
    assert!(edited.is_on("negative_sine") && edited.number("power") == Some(5.0));
    assert_eq!(step.values(), &edited.values()[..step.values().len()]);
}

#[test]
fn whole_numbers_stay_whole_between_keys() {
    let scene = |count: f64| {
        let mut fractal = hybrid::fractal(of(&["polar_repeat", "mandelbox"])).expect("a hybrid");
        assert!(fractal.steps_mut()[0].set("count", count));
        Scene { fractal, ..Scene::default() }
    };
    let key = |time_secs, count| Key {
        time_secs,
        easing: Easing::default(),
        scene: Arc::new(scene(count)),
    };
    let mut project = Project::from(scene(4.0));
    project.path.keys = vec![key(0.0, 4.0), key(2.0, 7.0)];
    let seen: Vec<_> = (0..=8)
        .map(|i| project.path.at(0.25 * f64::from(i)).expect("a scene").fractal)
        .map(|fractal| fractal.hybrid().expect("a hybrid").steps[0].values()[0].clone())
        .collect();
    assert!(seen.contains(&5.0.into()) && seen.contains(&6.0.into()), "{seen:?}");
}

#[test]
fn what_is_no_hybrid_is_refused_by_name() {
    let read = |fractal: Value| {
        let document =
            json!({ "mandelight": "scene", "version": 2, "scene": { "fractal": fractal } });
        document::from_json(&document.to_string()).expect_err("refused").to_string()
    };
    let steps = |steps: Value| read(json!({ "formula": "hybrid", "steps": steps }));
    for (found, expected) in [
        (read(json!({ "formula": "hybrid", "step": [] })), "`loop_start`, `steps`, `julia`"),
        (read(json!({ "formula": "hybird" })), "expected hybrid or mandelbulb"),
        (read(json!({ "formula": "hybrid" })), "missing field `steps`"),
        (read(json!({ "formula": "mandelbox", "steps": [] })), "need the formula `hybrid`"),
        (steps(json!([])), "a hybrid has 1 to 9 steps, and this one has 0"),
        (steps(json!(vec![json!({ "formula": "rotate" }); 10])), "has more than 9 entries"),
        (steps(json!([{ "formula": "hybrid" }])), "fractal.steps[0].formula: found the text"),
        (steps(json!([{ "scale": 2, "formula": "mandelbox" }])), "put that first"),
        (steps(json!([{ "formula": "mandelbox", "scael": 2 }])), "unknown field `scael`"),
        (
            steps(json!([{ "formula": "mandelbox", "scale": 9 }])),
            "fractal.steps[0].scale: 9 is outside",
        ),
        (
            steps(json!([{ "formula": "mandelbox", "repeats": 0 }])),
            "fractal.steps[0].repeats: 0 is outside",
        ),
        (
            read(
                json!({ "formula": "hybrid", "loop_start": 1, "steps": [{ "formula": "scale" }] }),
            ),
            "the loop would be empty",
        ),
    ] {
        assert!(found.contains(expected), "{found} has no {expected}");
    }
}

#[test]
fn formulas_that_are_too_long_together_are_refused() {
    let long: String = (0..10).map(|i| format!("z = triplex_power(z + {i}, 2.5) + c; ")).collect();
    let text = |name: &str| format!("name \"{name}\"; step {{ {long} }}");
    let made = |name: &str| formula::own::of_text(&text(name));
    let steps: Vec<_> = ["a", "b", "c", "d", "e", "f"]
        .into_iter()
        .filter_map(|name| Some(hybrid::step(made(name).ok()?).expect("a step")))
        .collect();
    assert_eq!(steps.len(), 6, "each alone is short enough: {:?}", made("a").err());
    let refused = hybrid::fractal(HybridSteps { steps, loop_start: 0 }).expect_err("too long");
    assert!(matches!(refused, HybridError::Operations(_)), "{refused}");
}

/// A formula that takes turns with itself is the formula.
#[test]
fn a_formula_in_turn_with_itself_is_the_formula() {
    for formula in formula::all().filter(|formula| formula.id() != "mandelbulb") {
        let alone = Fractal::new(formula);
        for ids in [vec![formula.id()], vec![formula.id(); 3]] {
            let mut hybrid = hybrid::fractal(of(&ids)).expect("a hybrid");
            (hybrid.iterations, hybrid.bailout) = (alone.iterations, alone.bailout);
            let fields = [&alone, &hybrid].map(formula_field);
            for i in 0..60 {
                let turn = 2.4 * f64::from(i);
                let direction = DVec3::new(turn.cos(), turn.sin(), (1.7 * turn).sin());
                let point = 0.05 * f64::from(i) * direction;
                let [a, b] = [0, 1].map(|which: usize| fields[which].distance(point));
                assert!(a == b || (a - b).abs() <= 1e-12 * a.abs(), "{ids:?} at {point}: {a}, {b}");
            }
        }
    }
}

fn formula_field(fractal: &Fractal) -> Arc<dyn formula::DistanceField> {
    fractal.formula().distance_field(fractal)
}
