//! What a checked formula's kernels compute: its operations with their derivatives.

use std::collections::HashMap;

use super::{
    check::Checked,
    derive::tangents,
    graph::{Input, Node, NodeId, Unary},
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
    pub derivative_tangent: NodeId,
    /// The derivative of the estimate, or of the height where the text gives no running derivative.
    pub distance_tangent: NodeId,
    /// The size that is compared with the bailout, or with its square.
    pub extent_test: NodeId,
    /// Whether the test compares with the bailout's square.
    pub tests_square: bool,
}

impl Compiled {
    /// Derives what the kernels need.
    pub fn new(mut checked: Checked) -> Self {
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
            self.channel().as_slice(),
        ]
        .concat();
        let found = graph.needed(&roots, is_slot).into_iter().filter(|&id| is_slot(id));
        found.enumerate().map(|(place, id)| (id, place)).collect()
    }

    /// What a step adds to the colour channel; none if the text gives nothing.
    pub fn channel(&self) -> Option<NodeId> {
        self.checked.channel.as_ref().map(|channel| channel.value)
    }

    /// The running derivative at the start: 1 if the state starts at the point, else 0.
    pub fn initial_derivative(&self) -> f64 {
        let graph = &self.checked.graph;
        let needed = graph.needed(&self.checked.init, |_| false);
        let is_point = |&id: &NodeId| matches!(graph.node(id), Node::Input(Input::Point(_)));
        if needed.iter().any(is_point) { 1.0 } else { 0.0 }
    }
}
