//! Derivatives of a formula's operations, in one direction (forward differentiation).
//!
//! Source: A. Griewank, A. Walther, *Evaluating Derivatives*, 2nd ed. 2008, chapter 3.1. A derivative is a node
//! of the same graph; the inputs' derivatives are inputs. Where a function has a corner, the derivative is that
//! of the side that the function's value is on.

use std::collections::HashMap;

use super::graph::{Binary, Graph, Input, Node, NodeId, Unary};

/// Least squared magnitude that a derivative divides by.
const LEAST: f64 = 1e-30;

/// The derivatives of `outputs`; inputs other than state, point, c and dr are constant.
pub fn tangents(graph: &mut Graph, outputs: &[NodeId]) -> Vec<NodeId> {
    let needed = graph.needed(outputs, |_| false);
    let non_negative = graph.non_negative();
    let mut known = HashMap::new();
    for id in needed {
        let tangent = tangent(graph, &known, &non_negative, id);
        known.insert(id, tangent);
    }
    outputs.iter().map(|id| known[id]).collect()
}

fn tangent(
    graph: &mut Graph,
    known: &HashMap<NodeId, NodeId>,
    non_negative: &[bool],
    id: NodeId,
) -> NodeId {
    let zero = graph.constant(0.0);
    match graph.node(id) {
        Node::Constant(_) => zero,
        Node::Input(input) => match input {
            Input::State(i) => graph.input(Input::StateTangent(i)),
            Input::Point(i) => graph.input(Input::PointTangent(i)),
            Input::Addend(i) => graph.input(Input::AddendTangent(i)),
            Input::Derivative => graph.input(Input::DerivativeTangent),
            _ => zero,
        },
        Node::Unary(operation, a) => {
            let da = known[&a];
            if da == zero {
                return zero;
            }
            let slope = unary(graph, operation, id, a, da);
            // Below zero roots and logarithms are constant.
            let is_clamped = matches!(operation, Unary::Sqrt | Unary::Log);
            if !is_clamped || operation == Unary::Sqrt && non_negative[a.index()] {
                return slope;
            }
            positive_only(graph, a, slope)
        }
        Node::Binary(operation, a, b) => {
            let (da, db) = (known[&a], known[&b]);
            if da == zero && db == zero {
                zero
            } else {
                binary(graph, operation, id, [a, b], [da, db])
            }
        }
        Node::Select(condition, yes, no) => graph.select(condition, known[&yes], known[&no]),
    }
}

/// The derivative of the node `id`, an operation on `a` with the derivative `da`.
fn unary(graph: &mut Graph, operation: Unary, id: NodeId, a: NodeId, da: NodeId) -> NodeId {
    let zero = graph.constant(0.0);
    match operation {
        Unary::Negate => graph.unary(Unary::Negate, da),
        Unary::Abs => {
            let is_negative = graph.binary(Binary::Less, a, zero);
            let opposite = graph.unary(Unary::Negate, da);
            graph.select(is_negative, opposite, da)
        }
        Unary::Sign | Unary::Floor | Unary::Not => zero,
        Unary::Sqrt => {
            let least = graph.constant(LEAST.sqrt());
            let root = graph.binary(Binary::Max, id, least);
            let half = graph.constant(0.5);
            let slope = graph.over(half, root);
            graph.times(slope, da)
        }
        Unary::Exp => graph.times(id, da),
        Unary::Log => {
            let least = graph.constant(LEAST);
            let a = graph.binary(Binary::Max, a, least);
            graph.over(da, a)
        }
        Unary::Sin => {
            let slope = graph.unary(Unary::Cos, a);
            graph.times(slope, da)
        }
        Unary::Cos => {
            let sine = graph.unary(Unary::Sin, a);
            let slope = graph.unary(Unary::Negate, sine);
            graph.times(slope, da)
        }
    }
}

/// The derivative of the node `id`, an operation on `a` and `b` with the derivatives `da` and `db`.
fn binary(
    graph: &mut Graph,
    operation: Binary,
    id: NodeId,
    [a, b]: [NodeId; 2],
    [da, db]: [NodeId; 2],
) -> NodeId {
    let zero = graph.constant(0.0);
    match operation {
        Binary::Add => graph.plus(da, db),
        Binary::Subtract => graph.minus(da, db),
        Binary::Multiply => {
            let (left, right) = (graph.times(b, da), graph.times(a, db));
            graph.plus(left, right)
        }
        Binary::Divide => {
            let moved = graph.times(id, db);
            let top = graph.minus(da, moved);
            graph.over(top, b)
        }
        Binary::Min => {
            let is_first = graph.binary(Binary::Less, a, b);
            graph.select(is_first, da, db)
        }
        Binary::Max => {
            let is_second = graph.binary(Binary::Less, a, b);
            graph.select(is_second, db, da)
        }
        Binary::Power => {
            let least = graph.constant(LEAST);
            let base = graph.binary(Binary::Max, a, least);
            let quotient = graph.over(da, base);
            let by_base = graph.times(b, quotient);
            // Below zero the base counts as constant.
            let by_base = positive_only(graph, a, by_base);
            let log = graph.unary(Unary::Log, a);
            let by_exponent = graph.times(log, db);
            let rate = graph.plus(by_base, by_exponent);
            graph.times(id, rate)
        }
        Binary::Atan2 => {
            let (left, right) = (graph.times(b, da), graph.times(a, db));
            let top = graph.minus(left, right);
            let squared = graph.dot(&[a, b], &[a, b]);
            let least = graph.constant(LEAST);
            let squared = graph.binary(Binary::Max, squared, least);
            graph.over(top, squared)
        }
        Binary::Less | Binary::And | Binary::Or => zero,
    }
}

/// `slope` where `a` is positive enough for a quotient, else 0.
fn positive_only(graph: &mut Graph, a: NodeId, slope: NodeId) -> NodeId {
    let (zero, least) = (graph.constant(0.0), graph.constant(LEAST));
    let is_positive = graph.binary(Binary::Less, least, a);
    graph.select(is_positive, slope, zero)
}
