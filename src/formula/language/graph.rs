//! The scalar operations of a formula, simplified while they are added.
//!
//! All functions of one formula share a [`Graph`]. Equal operations are one node, operations on constants
//! are constants, and neutral operands vanish. Operands come before the operations that use them.

use std::collections::HashMap;

/// A node of a graph.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct NodeId(u32);

impl NodeId {
    /// The node's place in [`Graph::nodes`].
    pub const fn index(self) -> usize {
        self.0 as usize
    }
}

/// A value that a function takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Input {
    /// A component of the point that is drawn.
    Point(u8),
    /// A component of the orbit's state before the step.
    State(u8),
    /// A component of the addend c.
    Addend(u8),
    /// The running derivative before the step.
    Derivative,
    /// Derivative of c by the point: 1, or 0 in the Julia form.
    AddendDerivative,
    /// A parameter's component, in the order of the table.
    Param(u16),
    /// The derivative of a state's component in the direction in question.
    StateTangent(u8),
    /// The derivative of the point's component in the same direction.
    PointTangent(u8),
    /// The derivative of c's component.
    AddendTangent(u8),
    /// The derivative of the running derivative.
    DerivativeTangent,
}

impl Input {
    /// Whether the input is a derivative in a direction.
    pub const fn is_tangent(self) -> bool {
        matches!(
            self,
            Self::StateTangent(_)
                | Self::PointTangent(_)
                | Self::AddendTangent(_)
                | Self::DerivativeTangent
        )
    }
}

/// An operation with one operand.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Unary {
    /// The opposite number.
    Negate,
    /// The magnitude.
    Abs,
    /// −1, 0 or 1.
    Sign,
    /// The next whole number below.
    Floor,
    /// The square root; of a negative number 0.
    Sqrt,
    /// e to the operand.
    Exp,
    /// The natural logarithm; of numbers below [`TINY`] that of [`TINY`].
    Log,
    /// The sine of radians.
    Sin,
    /// The cosine of radians.
    Cos,
    /// 1 for 0, else 0.
    Not,
}

/// An operation with two operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Binary {
    /// The sum.
    Add,
    /// The difference.
    Subtract,
    /// The product.
    Multiply,
    /// The quotient.
    Divide,
    /// The smaller operand.
    Min,
    /// The larger operand.
    Max,
    /// The first operand, at least [`TINY`], to the power of the second.
    Power,
    /// The angle of (second, first) from the first axis, in radians; 0 at the origin.
    Atan2,
    /// 1 if the first operand is less, else 0.
    Less,
    /// 1 if both operands are 1, else 0.
    And,
    /// 1 if an operand is 1, else 0.
    Or,
}

/// A node: a value or an operation. Conditions are 1 or 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Node {
    /// The bits of an f64.
    Constant(u64),
    /// A value that the function takes.
    Input(Input),
    /// An operation with one operand.
    Unary(Unary, NodeId),
    /// An operation with two operands.
    Binary(Binary, NodeId, NodeId),
    /// The second operand if the first is 1, else the third.
    Select(NodeId, NodeId, NodeId),
}

/// Least magnitude that logarithms and powers take: single precision's least normal number.
pub const TINY: f64 = f32::MIN_POSITIVE as f64;

impl Unary {
    /// The value in f64.
    pub fn apply(self, a: f64) -> f64 {
        match self {
            Self::Negate => -a,
            Self::Abs => a.abs(),
            Self::Sign => f64::from(u8::from(a > 0.0)) - f64::from(u8::from(a < 0.0)),
            Self::Floor => a.floor(),
            Self::Sqrt => a.max(0.0).sqrt(),
            Self::Exp => a.exp(),
            Self::Log => a.max(TINY).ln(),
            Self::Sin => a.sin(),
            Self::Cos => a.cos(),
            Self::Not => f64::from(u8::from(a == 0.0)),
        }
    }
}

impl Binary {
    /// The value in f64.
    pub fn apply(self, a: f64, b: f64) -> f64 {
        match self {
            Self::Add => a + b,
            Self::Subtract => a - b,
            Self::Multiply | Self::And => a * b,
            Self::Divide => a / b,
            Self::Min => a.min(b),
            Self::Max | Self::Or => a.max(b),
            Self::Power => a.max(TINY).powf(b),
            Self::Atan2 => a.atan2(b),
            Self::Less => f64::from(u8::from(a < b)),
        }
    }

    const fn commutes(self) -> bool {
        matches!(self, Self::Add | Self::Multiply | Self::Min | Self::Max | Self::And | Self::Or)
    }
}

impl Node {
    /// The node's operands.
    pub fn operands(self) -> impl Iterator<Item = NodeId> {
        let all = match self {
            Self::Constant(_) | Self::Input(_) => [None; 3],
            Self::Unary(_, a) => [Some(a), None, None],
            Self::Binary(_, a, b) => [Some(a), Some(b), None],
            Self::Select(a, b, c) => [Some(a), Some(b), Some(c)],
        };
        all.into_iter().flatten()
    }
}

/// Operations of one formula. Methods return an existing node where one has the same value.
#[derive(Clone, Debug, Default)]
pub struct Graph {
    nodes: Vec<Node>,
    known: HashMap<Node, NodeId>,
}

impl Graph {
    /// All nodes; operands come before the operations that use them.
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// The node itself.
    pub fn node(&self, id: NodeId) -> Node {
        self.nodes[id.index()]
    }

    fn add(&mut self, node: Node) -> NodeId {
        *self.known.entry(node).or_insert_with(|| {
            self.nodes.push(node);
            NodeId(self.nodes.len() as u32 - 1)
        })
    }

    /// A constant.
    pub fn constant(&mut self, value: f64) -> NodeId {
        // One zero: their difference shows nowhere but in quotients by zero.
        let value = if value == 0.0 { 0.0 } else { value };
        self.add(Node::Constant(value.to_bits()))
    }

    /// An input.
    pub fn input(&mut self, input: Input) -> NodeId {
        self.add(Node::Input(input))
    }

    /// The value of a constant node; none for other nodes.
    pub fn value(&self, id: NodeId) -> Option<f64> {
        match self.node(id) {
            Node::Constant(bits) => Some(f64::from_bits(bits)),
            _ => None,
        }
    }

    fn is(&self, id: NodeId, value: f64) -> bool {
        self.value(id) == Some(value)
    }

    /// An operation with one operand.
    pub fn unary(&mut self, operation: Unary, a: NodeId) -> NodeId {
        if let Some(value) = self.value(a) {
            return self.constant(operation.apply(value));
        }
        match (operation, self.node(a)) {
            (Unary::Negate, Node::Unary(Unary::Negate, inner))
            | (Unary::Not, Node::Unary(Unary::Not, inner)) => inner,
            (Unary::Negate, Node::Binary(Binary::Subtract, b, c)) => {
                self.binary(Binary::Subtract, c, b)
            }
            (Unary::Abs, Node::Unary(Unary::Negate, inner)) => self.unary(Unary::Abs, inner),
            (Unary::Abs, Node::Unary(Unary::Abs | Unary::Sqrt | Unary::Exp, _)) => a,
            (Unary::Cos, Node::Unary(Unary::Negate, inner)) => self.unary(Unary::Cos, inner),
            _ => self.add(Node::Unary(operation, a)),
        }
    }

    /// An operation with two operands.
    pub fn binary(&mut self, operation: Binary, a: NodeId, b: NodeId) -> NodeId {
        if let (Some(x), Some(y)) = (self.value(a), self.value(b)) {
            return self.constant(operation.apply(x, y));
        }
        let (a, b) = if operation.commutes() && b < a { (b, a) } else { (a, b) };
        match operation {
            Binary::Add => self.sum(a, b),
            Binary::Subtract => self.difference(a, b),
            Binary::Multiply => self.product(a, b),
            Binary::Divide if self.is(b, 1.0) || self.is(a, 0.0) => a,
            Binary::Divide => match self.value(b) {
                // A product costs less than a quotient; the reciprocal of a power of two is exact.
                Some(divisor) if divisor != 0.0 && (1.0 / divisor).is_normal() => {
                    let reciprocal = self.constant(1.0 / divisor);
                    self.product(a.min(reciprocal), a.max(reciprocal))
                }
                _ => self.add(Node::Binary(operation, a, b)),
            },
            Binary::Power => self.power(a, b),
            Binary::Min | Binary::Max if a == b => a,
            Binary::And if self.is(a, 1.0) || self.is(b, 0.0) || a == b => b,
            Binary::And if self.is(b, 1.0) || self.is(a, 0.0) => a,
            Binary::Or if self.is(a, 0.0) || self.is(b, 1.0) || a == b => b,
            Binary::Or if self.is(b, 0.0) || self.is(a, 1.0) => a,
            Binary::Less if a == b => self.constant(0.0),
            _ => self.add(Node::Binary(operation, a, b)),
        }
    }

    fn negated(&self, id: NodeId) -> Option<NodeId> {
        match self.node(id) {
            Node::Unary(Unary::Negate, inner) => Some(inner),
            _ => None,
        }
    }

    fn sum(&mut self, a: NodeId, b: NodeId) -> NodeId {
        if self.is(a, 0.0) {
            return b;
        }
        if self.is(b, 0.0) {
            return a;
        }
        match (self.negated(a), self.negated(b)) {
            (_, Some(b)) => self.binary(Binary::Subtract, a, b),
            (Some(a), None) => self.binary(Binary::Subtract, b, a),
            _ => self.add(Node::Binary(Binary::Add, a, b)),
        }
    }

    fn difference(&mut self, a: NodeId, b: NodeId) -> NodeId {
        if a == b {
            return self.constant(0.0);
        }
        if self.is(b, 0.0) {
            return a;
        }
        if self.is(a, 0.0) {
            return self.unary(Unary::Negate, b);
        }
        match self.negated(b) {
            Some(b) => self.binary(Binary::Add, a, b),
            None => self.add(Node::Binary(Binary::Subtract, a, b)),
        }
    }

    fn product(&mut self, a: NodeId, b: NodeId) -> NodeId {
        for (one, other) in [(a, b), (b, a)] {
            match self.value(one) {
                Some(0.0) => return one,
                Some(1.0) => return other,
                Some(-1.0) => return self.unary(Unary::Negate, other),
                _ => {}
            }
        }
        match (self.negated(a), self.negated(b)) {
            (Some(a), Some(b)) => self.binary(Binary::Multiply, a, b),
            (Some(inner), None) => {
                let product = self.binary(Binary::Multiply, inner, b);
                self.unary(Unary::Negate, product)
            }
            (None, Some(inner)) => {
                let product = self.binary(Binary::Multiply, a, inner);
                self.unary(Unary::Negate, product)
            }
            (None, None) => self.add(Node::Binary(Binary::Multiply, a, b)),
        }
    }

    /// A power; whole exponents up to 16 become products.
    fn power(&mut self, base: NodeId, exponent: NodeId) -> NodeId {
        match self.value(exponent) {
            Some(0.0) => self.constant(1.0),
            Some(1.0) => base,
            Some(0.5) => self.unary(Unary::Sqrt, base),
            Some(whole) if whole.fract() == 0.0 && (1.0..=16.0).contains(&whole) => {
                self.whole_power(base, whole as u32)
            }
            _ => self.add(Node::Binary(Binary::Power, base, exponent)),
        }
    }

    /// `base` to the power of `exponent`, at least 1, by repeated squaring.
    pub fn whole_power(&mut self, base: NodeId, exponent: u32) -> NodeId {
        if exponent == 1 {
            return base;
        }
        let half = self.whole_power(base, exponent / 2);
        let square = self.binary(Binary::Multiply, half, half);
        if exponent.is_multiple_of(2) {
            square
        } else {
            self.binary(Binary::Multiply, square, base)
        }
    }

    /// A choice: `yes` if the condition is 1, else `no`.
    pub fn select(&mut self, condition: NodeId, yes: NodeId, no: NodeId) -> NodeId {
        match self.value(condition) {
            Some(0.0) => no,
            Some(_) => yes,
            None if yes == no => yes,
            None => match self.node(condition) {
                Node::Unary(Unary::Not, inner) => self.select(inner, no, yes),
                _ => self.add(Node::Select(condition, yes, no)),
            },
        }
    }

    /// The sum.
    pub fn plus(&mut self, a: NodeId, b: NodeId) -> NodeId {
        self.binary(Binary::Add, a, b)
    }

    /// The difference.
    pub fn minus(&mut self, a: NodeId, b: NodeId) -> NodeId {
        self.binary(Binary::Subtract, a, b)
    }

    /// The product.
    pub fn times(&mut self, a: NodeId, b: NodeId) -> NodeId {
        self.binary(Binary::Multiply, a, b)
    }

    /// The quotient.
    pub fn over(&mut self, a: NodeId, b: NodeId) -> NodeId {
        self.binary(Binary::Divide, a, b)
    }

    /// The sum of products of components.
    pub fn dot(&mut self, a: &[NodeId], b: &[NodeId]) -> NodeId {
        let zero = self.constant(0.0);
        a.iter().zip(b).fold(zero, |sum, (&x, &y)| {
            let product = self.times(x, y);
            self.plus(sum, product)
        })
    }

    /// The length of a vector.
    pub fn length(&mut self, a: &[NodeId]) -> NodeId {
        let squared = self.dot(a, a);
        self.unary(Unary::Sqrt, squared)
    }

    /// For each node whether its value is certainly not negative.
    pub fn non_negative(&self) -> Vec<bool> {
        let mut all: Vec<bool> = Vec::with_capacity(self.nodes.len());
        for node in &self.nodes {
            let of = |id: NodeId| all[id.index()];
            let is_non_negative = match *node {
                Node::Constant(bits) => f64::from_bits(bits) >= 0.0,
                Node::Unary(Unary::Abs | Unary::Sqrt | Unary::Exp | Unary::Not, _)
                | Node::Binary(Binary::Power | Binary::Less | Binary::And | Binary::Or, ..) => true,
                Node::Input(_)
                | Node::Unary(..)
                | Node::Binary(Binary::Subtract | Binary::Atan2, ..) => false,
                Node::Binary(Binary::Multiply, a, b) => a == b || of(a) && of(b),
                Node::Binary(Binary::Max, a, b) => of(a) || of(b),
                Node::Binary(_, a, b) | Node::Select(_, a, b) => of(a) && of(b),
            };
            all.push(is_non_negative);
        }
        all
    }

    /// The nodes that `outputs` need, operands first; `stops` ends the search at nodes known otherwise.
    pub fn needed(&self, outputs: &[NodeId], stops: impl Fn(NodeId) -> bool) -> Vec<NodeId> {
        let mut is_needed = vec![false; self.nodes.len()];
        let mut open = outputs.to_vec();
        while let Some(id) = open.pop() {
            if !std::mem::replace(&mut is_needed[id.index()], true) && !stops(id) {
                open.extend(self.node(id).operands());
            }
        }
        (0..self.nodes.len() as u32).map(NodeId).filter(|id| is_needed[id.index()]).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn operations_on_constants_and_neutral_operands_vanish() {
        let mut graph = Graph::default();
        let x = graph.input(Input::Point(0));
        let [zero, one, two] = [0.0, 1.0, 2.0].map(|value| graph.constant(value));
        let four = graph.times(two, two);
        assert_eq!(graph.value(four), Some(4.0));
        assert_eq!(graph.plus(x, zero), x);
        assert_eq!(graph.times(one, x), x);
        assert_eq!(graph.times(x, zero), zero);
        let opposite = graph.unary(Unary::Negate, x);
        assert_eq!(graph.unary(Unary::Negate, opposite), x);
        assert_eq!(graph.plus(opposite, x), graph.minus(x, x));
        let exponent = graph.constant(3.0);
        let cube = graph.binary(Binary::Power, x, exponent);
        let square = graph.times(x, x);
        assert_eq!(cube, graph.times(x, square));
    }

    #[test]
    fn equal_operations_are_one_node() {
        let mut graph = Graph::default();
        let [x, y] = [0, 1].map(|axis| graph.input(Input::Point(axis)));
        assert_eq!(graph.times(x, y), graph.times(y, x));
        let length = graph.length(&[x, y]);
        let before = graph.nodes().len();
        assert_eq!(graph.length(&[x, y]), length);
        assert_eq!(graph.nodes().len(), before);
    }
}
