//! Emits a formula's operations as WGSL.
//!
//! A function's inputs are named as in `by_derivative.wgsl` and its neighbours, which call the functions. Derivatives
//! are vec3f: in three directions at once.
//! Operations on parameters only are not emitted: the host computes them once, as slots of the formula's table.

use std::{collections::HashMap, fmt::Write};

use super::graph::{Binary, Graph, Input, Node, NodeId, Unary};

/// Emits functions of one graph.
pub struct Emitter<'a> {
    /// The operations.
    pub graph: &'a Graph,
    /// Nodes that the host computes, with their places in the table.
    pub slots: &'a HashMap<NodeId, usize>,
    /// For each node whether it is certainly not negative.
    pub non_negative: &'a [bool],
    /// What stands before a slot's index in the table: the place where a step's slots begin, with a plus.
    ///
    /// Empty for a formula that draws alone, whose kernels have a copy of its slots.
    pub base: &'static str,
}

impl Emitter<'_> {
    /// The lines that compute `outputs`, and the outputs' expressions.
    pub fn body(&self, outputs: &[NodeId]) -> (String, Vec<String>) {
        let needed = self.graph.needed(outputs, |id| self.slots.contains_key(&id));
        let mut text = String::new();
        let mut values: HashMap<NodeId, Emitted> = HashMap::new();
        for (place, id) in needed.into_iter().enumerate() {
            let emitted = self.node(id, &values);
            let is_simple = self.slots.contains_key(&id)
                || matches!(self.graph.node(id), Node::Constant(_) | Node::Input(_));
            let emitted = if is_simple {
                emitted
            } else {
                // Writing to a String does not fail.
                let _ = writeln!(text, "    let v{place} = {};", emitted.text);
                Emitted { text: format!("v{place}"), ..emitted }
            };
            values.insert(id, emitted);
        }
        let outputs = outputs.iter().map(|id| values[id].text.clone()).collect();
        (text, outputs)
    }

    /// Whether a node is a derivative: needs a derivative input.
    pub fn is_tangent(&self, id: NodeId) -> bool {
        let needed = self.graph.needed(&[id], |id| self.slots.contains_key(&id));
        needed
            .iter()
            .any(|&id| matches!(self.graph.node(id), Node::Input(input) if input.is_tangent()))
    }

    fn node(&self, id: NodeId, values: &HashMap<NodeId, Emitted>) -> Emitted {
        if let Some(slot) = self.slots.get(&id) {
            let (place, axis) = (slot / 4, AXES[slot % 4]);
            let text = match self.base {
                "" => format!("slots[{place}].{axis}"),
                base => format!("table.slots[{base}{place}u].{axis}"),
            };
            return Emitted { text, kind: Kind::Number };
        }
        let of = |id: NodeId| &values[&id];
        match self.graph.node(id) {
            Node::Constant(bits) => {
                Emitted { text: literal(f64::from_bits(bits)), kind: Kind::Number }
            }
            Node::Input(input) => Emitted {
                text: name_of(input),
                kind: if input.is_tangent() { Kind::Tangent } else { Kind::Number },
            },
            Node::Unary(operation, a) => {
                let is_positive = self.non_negative[a.index()];
                let a = of(a);
                if operation == Unary::Not {
                    return Emitted { text: format!("!{}", a.condition()), kind: Kind::Condition };
                }
                let text = match operation {
                    Unary::Negate => format!("-{}", a.text),
                    Unary::Abs => format!("abs({})", a.text),
                    Unary::Sign => format!("sign({})", a.text),
                    Unary::Floor => format!("floor({})", a.text),
                    Unary::Sqrt if is_positive => format!("sqrt({})", a.text),
                    Unary::Sqrt => format!("sqrt(max({}, 0.0))", a.text),
                    Unary::Exp => format!("exponential({})", a.text),
                    Unary::Log => format!("natural_log({})", a.text),
                    Unary::Sin => format!("sine({})", a.text),
                    Unary::Cos | Unary::Not => format!("cosine({})", a.text),
                };
                Emitted { text, kind: a.kind }
            }
            Node::Binary(operation, a, b) => binary(operation, of(a), of(b)),
            Node::Select(condition, yes, no) => {
                let (condition, yes, no) = (of(condition).condition(), of(yes), of(no));
                let kind = yes.kind.joined(no.kind);
                let [yes, no] = [yes, no].map(|one| self.spread(one, kind));
                Emitted { text: format!("select({no}, {yes}, {condition})"), kind }
            }
        }
    }

    /// The value as one of `kind`: a number beside derivatives stands for each direction.
    fn spread(&self, value: &Emitted, kind: Kind) -> String {
        match (value.kind, kind) {
            (Kind::Number, Kind::Tangent) => format!("vec3f({})", value.text),
            (_, Kind::Condition) => value.condition(),
            _ => value.text.clone(),
        }
    }

    /// An output that is a derivative, as a vec3f: one number for each direction.
    pub fn as_derivative(&self, id: NodeId, text: &str) -> String {
        if self.is_tangent(id) { text.to_owned() } else { format!("vec3f({text})") }
    }
}

fn binary(operation: Binary, a: &Emitted, b: &Emitted) -> Emitted {
    let (x, y) = (&a.text, &b.text);
    let number = |text: String| Emitted { text, kind: a.kind.joined(b.kind) };
    let condition = |text: String| Emitted { text, kind: Kind::Condition };
    match operation {
        Binary::Add => number(format!("{x} + {y}")),
        Binary::Subtract => number(format!("{x} - {y}")),
        Binary::Multiply => number(format!("{x} * {y}")),
        Binary::Divide => number(format!("{x} / {y}")),
        Binary::Min => number(format!("min({x}, {y})")),
        Binary::Max => number(format!("max({x}, {y})")),
        Binary::Power => number(format!("power({x}, {y})")),
        Binary::Atan2 => number(format!("angle({x}, {y})")),
        Binary::Less => condition(format!("{x} < {y}")),
        Binary::And => condition(format!("{} && {}", a.condition(), b.condition())),
        Binary::Or => condition(format!("{} || {}", a.condition(), b.condition())),
    }
}

/// An expression and what it is.
#[derive(Clone, Debug)]
struct Emitted {
    text: String,
    kind: Kind,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Number,
    Tangent,
    Condition,
}

impl Kind {
    const fn joined(self, other: Self) -> Self {
        match (self, other) {
            (Self::Condition, _) | (_, Self::Condition) => Self::Condition,
            (Self::Number, Self::Number) => Self::Number,
            _ => Self::Tangent,
        }
    }
}

impl Emitted {
    /// The expression as a condition: the table stores conditions as numbers.
    fn condition(&self) -> String {
        match self.kind {
            Kind::Condition => self.text.clone(),
            _ => format!("({} != 0.0)", self.text),
        }
    }
}

const AXES: [&str; 4] = ["x", "y", "z", "w"];

/// The input's name in WGSL.
fn name_of(input: Input) -> String {
    let of = |vector: &str, i: u8| format!("{vector}.{}", AXES[usize::from(i)]);
    match input {
        Input::Point(i) => of("p", i),
        Input::State(i) => of("z", i),
        Input::Addend(i) => of("c", i),
        Input::Derivative => "dr".to_owned(),
        Input::AddendDerivative => "dc".to_owned(),
        // Parameters are always slots.
        Input::Param(i) => format!("param_{i}"),
        Input::StateTangent(i) => of("tz", i),
        Input::PointTangent(i) => of("tp", i),
        Input::AddendTangent(i) => of("tc", i),
        Input::DerivativeTangent => "tdr".to_owned(),
    }
}

/// The number as a WGSL literal; single precision's range bounds its magnitude.
fn literal(value: f64) -> String {
    let single = value.clamp(f64::from(f32::MIN), f64::from(f32::MAX)) as f32;
    // Subnormal literals are an error in some compilers.
    let single = if single.is_normal() { single } else { 0.0 };
    if single < 0.0 { format!("({single:?}f)") } else { format!("{single:?}f") }
}
