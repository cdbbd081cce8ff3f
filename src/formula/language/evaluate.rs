//! Evaluates a formula's operations in f64.

use std::collections::HashMap;

use super::graph::{Binary, Graph, Input, Node, NodeId, Unary};

/// One operation on places of the scratch memory.
#[derive(Clone, Copy, Debug)]
enum Operation {
    Constant(f64),
    Input(Input),
    /// A value that was computed beforehand.
    Slot(usize),
    Unary(Unary, usize),
    Binary(Binary, usize, usize),
    Select(usize, usize, usize),
}

/// Operations in the order of evaluation.
#[derive(Clone, Debug, Default)]
pub struct Program {
    operations: Vec<Operation>,
    outputs: Vec<usize>,
}

impl Program {
    /// The operations that compute `outputs`; nodes of `slots` are read instead of computed.
    pub fn new(graph: &Graph, outputs: &[NodeId], slots: &HashMap<NodeId, usize>) -> Self {
        let needed = graph.needed(outputs, |id| slots.contains_key(&id));
        let places: HashMap<_, _> = needed.iter().enumerate().map(|(i, &id)| (id, i)).collect();
        let operation = |&id: &NodeId| match (slots.get(&id), graph.node(id)) {
            (Some(&slot), _) => Operation::Slot(slot),
            (_, Node::Constant(bits)) => Operation::Constant(f64::from_bits(bits)),
            (_, Node::Input(input)) => Operation::Input(input),
            (_, Node::Unary(unary, a)) => Operation::Unary(unary, places[&a]),
            (_, Node::Binary(binary, a, b)) => Operation::Binary(binary, places[&a], places[&b]),
            (_, Node::Select(a, b, c)) => Operation::Select(places[&a], places[&b], places[&c]),
        };
        Self {
            operations: needed.iter().map(operation).collect(),
            outputs: outputs.iter().map(|id| places[id]).collect(),
        }
    }

    /// Number of operations.
    pub fn operations(&self) -> usize {
        self.operations.len()
    }

    /// Computes the outputs; `values` is scratch memory, which calls may share.
    pub fn run<'a>(
        &'a self,
        input: impl Fn(Input) -> f64,
        slots: &[f64],
        values: &'a mut Vec<f64>,
    ) -> impl Iterator<Item = f64> + 'a {
        values.clear();
        for operation in &self.operations {
            let value = match *operation {
                Operation::Constant(value) => value,
                Operation::Input(one) => input(one),
                Operation::Slot(slot) => slots[slot],
                Operation::Unary(unary, a) => unary.apply(values[a]),
                Operation::Binary(binary, a, b) => binary.apply(values[a], values[b]),
                Operation::Select(a, b, c) => {
                    if values[a] == 0.0 {
                        values[c]
                    } else {
                        values[b]
                    }
                }
            };
            values.push(value);
        }
        self.outputs.iter().map(|&place| values[place])
    }
}
