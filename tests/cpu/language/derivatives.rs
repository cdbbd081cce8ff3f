//! Derived derivatives against differences, for generated steps.

use std::collections::HashMap;

use mandelight::formula::language::{
    check, derive,
    evaluate::Program,
    graph::{Graph, Input, NodeId},
    syntax,
};
use mandelight_test_support::{expressions::Expressions, random::Random, statistics::quantile};

/// Number of generated steps.
const STEPS: u64 = 3000;

fn run(graph: &Graph, outputs: &[NodeId], input: impl Fn(Input) -> f64) -> Vec<f64> {
    let program = Program::new(graph, outputs, &HashMap::new());
    let mut scratch = Vec::new();
    program.run(input, &[], &mut scratch).collect()
}

#[test]
fn derived_derivatives_agree_with_differences() {
    let (mut compared, mut undefined, mut off) = (0, 0, Vec::new());
    for seed in 0..STEPS {
        let text = Expressions::new(seed).formula();
        let tree = syntax::parse(&text).unwrap_or_else(|error| panic!("{text}\n{error}"));
        let mut checked =
            check::check(&text, &tree).unwrap_or_else(|error| panic!("{text}\n{error}"));
        let tangents = derive::tangents(&mut checked.graph, &checked.step);
        let mut random = Random(seed + 1);
        let mut vector = || -> [f64; 3] { std::array::from_fn(|_| random.signed()) };
        let (point, direction, constant) = (vector(), vector(), vector());
        let at = |moved: f64| {
            move |input: Input| match input {
                Input::State(i) => point[usize::from(i)] + moved * direction[usize::from(i)],
                Input::Addend(i) | Input::Point(i) => constant[usize::from(i)],
                Input::StateTangent(i) => direction[usize::from(i)],
                _ => 0.0,
            }
        };
        let derived = run(&checked.graph, &tangents, at(0.0));
        let difference = |spacing: f64| -> Vec<f64> {
            let [ahead, behind] =
                [spacing, -spacing].map(|s| run(&checked.graph, &checked.step, at(s)));
            ahead.iter().zip(behind).map(|(a, b)| (a - b) / (2.0 * spacing)).collect()
        };
        let (fine, coarse) = (difference(1e-6), difference(1e-5));
        let values = run(&checked.graph, &checked.step, at(0.0));
        for (((derived, fine), coarse), value) in
            derived.into_iter().zip(fine).zip(coarse).zip(values)
        {
            // Differences of larger values are rounding.
            if value.abs() > 1e6 {
                continue;
            }
            let size = fine.abs().max(1.0);
            // Corners and poles have no derivative that differences find.
            let agrees = (fine - coarse).abs() < 1e-5 * size;
            if !agrees || size > 1e6 {
                continue;
            }
            compared += 1;
            // A step through infinity, such as the angle of a quotient by zero, has no derivative.
            if derived.is_nan() {
                undefined += 1;
                continue;
            }
            off.push((derived - fine).abs() / size);
        }
    }
    assert!(compared > 2 * STEPS, "{compared} derivatives");
    assert!(undefined < compared / 1000, "{undefined} of {compared} derivatives are undefined");
    // A difference across a corner by chance passes the filter now and then.
    let (usual, most) = (quantile(off.clone(), 0.99), quantile(off, 0.9995));
    assert!(usual < 1e-5 && most < 1e-3, "off by {usual}, {most}");
}
