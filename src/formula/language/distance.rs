//! The estimated distance at an orbit's end.

use std::collections::HashMap;

use super::{
    derive,
    graph::{Binary, Graph, Input, Node, NodeId, Unary},
    scope::Scope,
    tree::{EstimateDeclaration, TextError},
};

impl Scope<'_> {
    /// The estimated distance at an orbit's end, by the size `extent` of the state.
    pub(super) fn distance(
        &mut self,
        declaration: Option<&EstimateDeclaration>,
        extent: NodeId,
        state: &[NodeId],
    ) -> Result<NodeId, TextError> {
        let offset = match declaration {
            Some(EstimateDeclaration::Distance(distance)) => return self.float(distance),
            Some(EstimateDeclaration::Linear(Some(offset))) => Some(self.float(offset)?),
            Some(EstimateDeclaration::Linear(None) | EstimateDeclaration::Transform) => {
                Some(self.graph.constant(0.0))
            }
            Some(EstimateDeclaration::Log) | None => None,
        };
        let graph = &mut self.graph;
        let height = match offset {
            Some(offset) => graph.minus(extent, offset),
            None => {
                let (half, log) = (graph.constant(0.5), graph.unary(Unary::Log, extent));
                let product = graph.times(extent, log);
                graph.times(half, product)
            }
        };
        // The size changes with the state at this rate: 1 for a length.
        let rate = if extent == graph.length(state) {
            graph.constant(1.0)
        } else {
            slope(graph, extent, state.len())
        };
        let derivative = graph.input(Input::Derivative);
        let derivative = graph.times(derivative, rate);
        let least = graph.constant(1e-18);
        let derivative = graph.binary(Binary::Max, derivative, least);
        Ok(graph.over(height, derivative))
    }
}

/// The length of the gradient of `value` by the state of `size` components.
fn slope(graph: &mut Graph, value: NodeId, size: usize) -> NodeId {
    let tangent = derive::tangents(graph, &[value])[0];
    let parts: Vec<_> = (0..size)
        .map(|axis| {
            let seed = |input| match input {
                Input::StateTangent(i) => Some(f64::from(u8::from(usize::from(i) == axis))),
                input if input.is_tangent() => Some(0.0),
                _ => None,
            };
            substituted(graph, tangent, seed)
        })
        .collect();
    graph.length(&parts)
}

/// `id` with constants for the inputs that `known` gives.
fn substituted(graph: &mut Graph, id: NodeId, known: impl Fn(Input) -> Option<f64>) -> NodeId {
    let mut made = HashMap::new();
    for node in graph.needed(&[id], |_| false) {
        let new = match graph.node(node) {
            Node::Constant(_) => node,
            Node::Input(input) => known(input).map_or(node, |value| graph.constant(value)),
            Node::Unary(operation, a) => graph.unary(operation, made[&a]),
            Node::Binary(operation, a, b) => graph.binary(operation, made[&a], made[&b]),
            Node::Select(a, b, c) => graph.select(made[&a], made[&b], made[&c]),
        };
        made.insert(node, new);
    }
    made[&id]
}
