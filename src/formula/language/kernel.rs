//! The WGSL files of a checked formula's kernels.

use std::{collections::HashMap, fmt::Write};

use super::{
    check::Checked,
    derive::tangents,
    graph::{Graph, Input, Node, NodeId, Unary},
    wgsl::{Emitter, Lane},
};

/// A formula's operations with those that its kernels need besides.
#[derive(Clone, Debug)]
pub struct Compiled {
    /// The checked formula; its graph has the derivatives too.
    pub checked: Checked,
    /// What the host computes from the parameters, with the places in the table.
    pub slots: HashMap<NodeId, usize>,
    /// The state's derivatives after a step.
    pub step_tangents: Vec<NodeId>,
    /// The initial state's derivatives.
    pub init_tangents: Vec<NodeId>,
    /// The derivative of the running derivative.
    derivative_tangent: NodeId,
    /// The derivative of the estimate, or of the height where the text gives no running derivative.
    distance_tangent: NodeId,
    /// The size that is compared with the bailout, or with its square.
    extent_test: NodeId,
    /// Whether the test compares with the bailout's square.
    pub tests_square: bool,
    /// Whether orbits grow as a power.
    pub is_power: bool,
}

impl Compiled {
    /// Derives what the kernels need.
    pub fn new(mut checked: Checked, is_power: bool) -> Self {
        let graph = &mut checked.graph;
        let init_tangents = tangents(graph, &checked.init);
        let given = checked.derivative.unwrap_or_else(|| graph.constant(1.0));
        let mut all = checked.step.clone();
        all.push(given);
        let mut step_tangents = tangents(graph, &all);
        let derivative_tangent = step_tangents.remove(checked.step.len());
        let level = if checked.derivative.is_some() { checked.distance } else { checked.height };
        let distance_tangent = tangents(graph, &[level])[0];
        // A comparison of squares saves the root.
        let (extent_test, tests_square) = match graph.node(checked.extent) {
            Node::Unary(Unary::Sqrt, square) => (square, true),
            _ => (checked.extent, false),
        };
        let mut compiled = Self {
            slots: HashMap::new(),
            step_tangents,
            init_tangents,
            derivative_tangent,
            distance_tangent,
            extent_test,
            tests_square,
            is_power,
            checked,
        };
        compiled.slots = compiled.find_slots();
        compiled
    }

    /// The nodes that depend on parameters only and that other operations use.
    fn find_slots(&self) -> HashMap<NodeId, usize> {
        let graph = &self.checked.graph;
        let is_of_params = self.checked.is_of_params();
        let is_slot = |id: NodeId| is_of_params[id.index()] && graph.value(id).is_none();
        let roots = [
            &self.checked.init[..],
            &self.checked.step,
            &self.step_tangents,
            &self.init_tangents,
            &[self.derivative_tangent, self.distance_tangent, self.extent_test],
            &[self.checked.distance, self.checked.extent],
            self.checked.derivative.as_slice(),
        ]
        .concat();
        let found = graph.needed(&roots, is_slot).into_iter().filter(|&id| is_slot(id));
        found.enumerate().map(|(place, id)| (id, place)).collect()
    }

    /// The running derivative at the start: 1 if the state starts at the point, else 0.
    pub fn initial_derivative(&self) -> f64 {
        let graph = &self.checked.graph;
        let needed = graph.needed(&self.checked.init, |_| false);
        let is_point = |&id: &NodeId| matches!(graph.node(id), Node::Input(Input::Point(_)));
        if needed.iter().any(is_point) { 1.0 } else { 0.0 }
    }

    /// The WGSL of the text's own functions.
    pub fn functions(&self) -> String {
        let graph = &self.checked.graph;
        Writer { compiled: self, graph, non_negative: graph.non_negative() }.all()
    }
}

/// Writes functions, whose names and parameters `orbit.wgsl` and its neighbours list.
struct Writer<'a> {
    compiled: &'a Compiled,
    graph: &'a Graph,
    non_negative: Vec<bool>,
}

impl Writer<'_> {
    fn all(&self) -> String {
        let Self { compiled, .. } = self;
        let checked = &compiled.checked;
        let size = checked.size;
        let state = format!("vec{size}f");
        let derivative = compiled.initial_derivative();
        let constant = if size == 3 { "v.xyz" } else { "v" };
        let mut text = format!(
            "// The operations of a formula's text, from `kernel.rs`.\n\nalias State = {state};\n\
             const IS_POWER = {};\nconst INITIAL_DERIVATIVE = {derivative:?};\n\n\
             struct NextTangent {{\n    z: State,\n    tangent: State,\n}}\n\n\
             struct NextDerivative {{\n    z: State,\n    dr: f32,\n}}\n\n\
             struct NextRows {{\n    z: State,\n    dr: f32,\n    rows: Rows,\n    slope: vec3f,\n}}\n\n\
             fn as_state(v: vec4f) -> State {{\n    return {constant};\n}}\n\n",
            compiled.is_power
        );
        let vector = |v: &[String]| format!("State({})", v.join(", "));
        let rows = |v: &[String]| {
            let mut v = v.to_vec();
            v.resize(4, "vec3f(0.0)".to_owned());
            format!("Rows({})", v.join(", "))
        };
        let first = |v: &[String]| v[0].clone();
        let (one, three) = (Lane::One, Lane::Three);
        let step = "z: State, c: State, p: vec3f";
        let end = "z: State, p: vec3f, dr: f32";
        let distance = [checked.distance];
        let init_tangents = (0, &compiled.init_tangents[..]);
        text += &self.function("initial(p: vec3f) -> State", one, (size, &checked.init), &vector);
        text += &self.function(
            "initial_tangent(p: vec3f, tp: vec3f) -> State",
            one,
            init_tangents,
            &vector,
        );
        text +=
            &self.function("initial_rows(p: vec3f, tp: Rows) -> Rows", three, init_tangents, &rows);
        text += &self.function(
            "extent_test(z: State) -> f32",
            one,
            (1, &[compiled.extent_test]),
            &first,
        );
        text += &self.function("extent(z: State) -> f32", one, (1, &[checked.extent]), &first);
        text += &self.function(&format!("distance_at({end}) -> f32"), one, (1, &distance), &first);
        text += &self.function(
            &format!("distance_slope({end}, tz: Rows, tp: Rows, tdr: vec3f) -> vec3f"),
            three,
            (0, &[compiled.distance_tangent]),
            &first,
        );
        let given = checked.derivative.as_slice();
        if given.is_empty() {
            let outputs = [&checked.step[..], &compiled.step_tangents].concat();
            text += &self.function(
                &format!("next_with_tangent({step}, dc: f32, tz: State, tc: State, tp: vec3f) -> NextTangent"),
                one,
                (size, &outputs),
                &|v| format!("NextTangent({}, {})", vector(&v[..size]), vector(&v[size..])),
            );
        }
        let outputs = [&checked.step[..], given].concat();
        text += &self.function(
            &format!("next_with_derivative({step}, dr: f32, dc: f32) -> NextDerivative"),
            one,
            (outputs.len(), &outputs),
            &|v| {
                let dr = v.get(size).map_or("dr", String::as_str);
                format!("NextDerivative({}, {dr})", vector(&v[..size]))
            },
        );
        let numbers = size + given.len();
        let outputs =
            [&checked.step[..], given, &compiled.step_tangents, &[compiled.derivative_tangent]]
                .concat();
        text += &self.function(
            &format!(
                "next_with_rows({step}, dr: f32, dc: f32, tz: Rows, tc: Rows, tp: Rows, tdr: vec3f) -> NextRows"
            ),
            three,
            (numbers, &outputs),
            &|v| {
                let dr = if given.is_empty() { "1.0" } else { &v[size] };
                let (z, tangents) = (vector(&v[..size]), &v[numbers..]);
                format!("NextRows({z}, {dr}, {}, {})", rows(&tangents[..size]), tangents[size])
            },
        );
        text
    }

    fn function(
        &self,
        signature: &str,
        lane: Lane,
        (numbers, outputs): (usize, &[NodeId]),
        join: &dyn Fn(&[String]) -> String,
    ) -> String {
        let emitter = Emitter {
            graph: self.graph,
            slots: &self.compiled.slots,
            non_negative: &self.non_negative,
            lane,
        };
        let (body, values) = emitter.body(outputs);
        let values: Vec<_> = outputs
            .iter()
            .zip(values)
            .enumerate()
            .map(|(i, (&id, value))| if i >= numbers { emitter.as_lane(id, &value) } else { value })
            .collect();
        let mut text = String::new();
        // Writing to a String does not fail.
        let _ = write!(text, "fn {signature} {{\n{body}    return {};\n}}\n\n", join(&values));
        text
    }
}
