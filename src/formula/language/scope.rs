//! Names, types and values of a text's expressions and statements.

use std::collections::HashMap;

use super::{
    functions::{self, Argument, Function},
    graph::{Binary, Graph, NodeId, Unary},
    tree::{Expression, ExpressionKind, Name, Operator, Span, Statement, TextError},
};

/// Names that mean something in a step, or that documents give to other fields of a fractal or of a hybrid's step.
pub(super) const RESERVED: [&str; 16] = [
    "z",
    "c",
    "p",
    "dr",
    "dc",
    "color",
    "pi",
    "formula",
    "iterations",
    "bailout",
    "section_planes",
    "julia",
    "julia_constant",
    "steps",
    "loop_start",
    "repeats",
];

/// What a step assigns besides the state.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Assigned {
    /// The running derivative.
    pub derivative: bool,
    /// The colour channel.
    pub color: bool,
}

/// The value of an expression.
#[derive(Clone, Debug)]
pub(super) enum Value {
    Number(Vec<NodeId>),
    Condition(NodeId),
}

impl Value {
    fn describe(&self) -> String {
        match self {
            Self::Number(parts) if parts.len() == 1 => "a float".to_owned(),
            Self::Number(parts) => format!("a vec{}", parts.len()),
            Self::Condition(_) => "a condition".to_owned(),
        }
    }
}

/// The names that expressions may use, and the operations so far.
pub(super) struct Scope<'a> {
    pub(super) text: &'a str,
    pub(super) graph: Graph,
    pub(super) names: HashMap<String, Value>,
    /// Names of the language that the declaration which is read may not use.
    pub(super) hidden: &'static [&'static str],
}

impl Scope<'_> {
    pub(super) fn error<T>(&self, span: Span, message: impl Into<String>) -> Result<T, TextError> {
        Err(TextError::new(self.text, span, message))
    }

    /// The numbers of a name that is known to have them.
    pub(super) fn numbers(&self, name: &str) -> Vec<NodeId> {
        match self.names.get(name) {
            Some(Value::Number(parts)) => parts.clone(),
            _ => Vec::new(),
        }
    }

    /// Numbers that depend on no parameter, each within a range.
    pub(super) fn constants(
        &mut self,
        expression: &Expression,
        [min, max]: [f64; 2],
    ) -> Result<Vec<f64>, TextError> {
        let parts = match self.value(expression)? {
            Value::Number(parts) => parts,
            other => {
                let message = format!("found {}, expected numbers", other.describe());
                return self.error(expression.span, message);
            }
        };
        let values: Option<Vec<f64>> = parts.iter().map(|&part| self.graph.value(part)).collect();
        let Some(values) = values else {
            return self
                .error(expression.span, "expected a constant: no parameter can be used here");
        };
        match values.iter().find(|value| !(min..=max).contains(*value)) {
            None => Ok(values),
            Some(value) => {
                self.error(expression.span, format!("{value} is outside {min} to {max}"))
            }
        }
    }

    pub(super) fn constant(
        &mut self,
        expression: &Expression,
        range: [f64; 2],
    ) -> Result<f64, TextError> {
        match self.constants(expression, range)?[..] {
            [one] => Ok(one),
            _ => self.error(expression.span, "expected one number"),
        }
    }

    pub(super) fn define(&mut self, name: &Name, value: Value) -> Result<(), TextError> {
        if RESERVED.contains(&name.text.as_str()) {
            let message = format!("`{}` has a meaning already: choose another name", name.text);
            return self.error(name.span, message);
        }
        if name.text.len() > MAX_NAME_BYTES {
            return self.error(name.span, format!("a name has at most {MAX_NAME_BYTES} letters"));
        }
        if self.names.insert(name.text.clone(), value).is_some() {
            let message = format!("`{}` is declared twice: rename one", name.text);
            return self.error(name.span, message);
        }
        Ok(())
    }

    /// Runs the statements; returns what they assign besides the state.
    pub(super) fn step(&mut self, statements: &[Statement]) -> Result<Assigned, TextError> {
        let mut assigned = Assigned::default();
        for statement in statements {
            match statement {
                Statement::Let(name, value) => {
                    let value = self.value(value)?;
                    self.define(name, value)?;
                }
                Statement::Assign(name, components, value) => {
                    match name.text.as_str() {
                        "z" => {}
                        "dr" => assigned.derivative = true,
                        "color" => assigned.color = true,
                        other => {
                            let advice = if RESERVED.contains(&other) {
                                String::new()
                            } else {
                                format!(": write `let {other} = …;`")
                            };
                            let message =
                                format!("only `z`, `dr` and `color` can be assigned{advice}");
                            return self.error(name.span, message);
                        }
                    }
                    self.assign(name, components.as_ref(), value)?;
                }
            }
        }
        Ok(assigned)
    }

    fn assign(
        &mut self,
        name: &Name,
        components: Option<&Name>,
        value: &Expression,
    ) -> Result<(), TextError> {
        let mut parts = self.numbers(&name.text);
        let places = match components {
            Some(components) => self.places(components, parts.len())?,
            None => (0..parts.len()).collect(),
        };
        if (1..places.len()).any(|i| places[..i].contains(&places[i])) {
            let span = components.map_or(name.span, |components| components.span);
            return self.error(span, "a component is assigned twice");
        }
        let values = self.sized(value, places.len(), &format!("`{}`", name.text))?;
        for (place, value) in places.into_iter().zip(values) {
            parts[place] = value;
        }
        self.names.insert(name.text.clone(), Value::Number(parts));
        Ok(())
    }

    /// The value of an expression with `size` components; one number stands for each.
    pub(super) fn sized(
        &mut self,
        expression: &Expression,
        size: usize,
        target: &str,
    ) -> Result<Vec<NodeId>, TextError> {
        match self.value(expression)? {
            Value::Number(parts) if parts.len() == size => Ok(parts),
            other => {
                let wanted = if size == 1 { "a float".to_owned() } else { format!("a vec{size}") };
                let message = format!("found {}, but {target} takes {wanted}", other.describe());
                self.error(expression.span, message)
            }
        }
    }

    pub(super) fn float(&mut self, expression: &Expression) -> Result<NodeId, TextError> {
        Ok(self.sized(expression, 1, "this")?[0])
    }

    pub(super) fn value(&mut self, expression: &Expression) -> Result<Value, TextError> {
        let value = self.value_of(expression)?;
        if let Value::Number(parts) = &value
            && parts.iter().any(|&part| self.graph.value(part).is_some_and(|x| !is_single(x)))
        {
            let message = "the value is not a number of single precision: is a divisor zero?";
            return self.error(expression.span, message);
        }
        Ok(value)
    }

    fn value_of(&mut self, expression: &Expression) -> Result<Value, TextError> {
        let span = expression.span;
        Ok(match &expression.kind {
            ExpressionKind::Number(number) => Value::Number(vec![self.graph.constant(*number)]),
            ExpressionKind::Switch(is_on) => {
                Value::Condition(self.graph.constant(f64::from(u8::from(*is_on))))
            }
            ExpressionKind::Name(name) => match self.names.get(name) {
                Some(value) => value.clone(),
                None => return self.error(span, self.unknown(name)),
            },
            ExpressionKind::Negated(operand) => match self.value(operand)? {
                Value::Number(parts) => Value::Number(
                    parts.iter().map(|&part| self.graph.unary(Unary::Negate, part)).collect(),
                ),
                Value::Condition(_) => {
                    return self.error(
                        span,
                        "a condition has no opposite number: compare with `== false`",
                    );
                }
            },
            ExpressionKind::Swizzle(operand, components) => match self.value(operand)? {
                Value::Number(parts) if parts.len() > 1 => {
                    let places = self.places(components, parts.len())?;
                    Value::Number(places.into_iter().map(|place| parts[place]).collect())
                }
                other => {
                    let message = format!("{} has no components", other.describe());
                    return self.error(components.span, message);
                }
            },
            ExpressionKind::Chain(first, others) => {
                let mut joined = self.value(first)?;
                for (operator, operand) in others {
                    let other = self.value(operand)?;
                    let span = Span { start: span.start, end: operand.span.end };
                    joined = self.operation(*operator, joined, other, span)?;
                }
                joined
            }
            ExpressionKind::Call(name, arguments) => {
                let Some(function) = functions::find(&name.text) else {
                    return self.error(name.span, self.unknown(&name.text));
                };
                let values: Vec<_> =
                    arguments.iter().map(|one| self.value(one)).collect::<Result<_, _>>()?;
                self.call(function, arguments, values, span)?
            }
        })
    }

    /// What is wrong with an unknown name, with the nearest known one.
    fn unknown(&self, name: &str) -> String {
        if self.hidden.contains(&name) {
            return format!("`{name}` has no value here");
        }
        let functions = functions::FUNCTIONS.iter().map(|function| function.name);
        let near = functions
            .chain(self.names.keys().map(String::as_str))
            .map(|known| (edits(name, known), known))
            .min();
        match near {
            Some((edits, known)) if edits <= 2 => {
                format!("`{name}` is unknown; did you mean `{known}`?")
            }
            _ => format!("`{name}` is unknown"),
        }
    }

    /// The places of components such as `xy` in a vector of `size`.
    fn places(&self, components: &Name, size: usize) -> Result<Vec<usize>, TextError> {
        let places: Option<Vec<_>> =
            components.text.chars().map(|c| "xyzw".find(c).filter(|&place| place < size)).collect();
        match places {
            Some(places) if places.len() <= 4 => Ok(places),
            _ => {
                let message = format!(
                    "`.{}` does not name components: use up to four of {}",
                    components.text,
                    &"xyzw"[..size]
                );
                self.error(components.span, message)
            }
        }
    }

    fn operation(
        &mut self,
        operator: Operator,
        a: Value,
        b: Value,
        span: Span,
    ) -> Result<Value, TextError> {
        let graph = &mut self.graph;
        match (operator, &a, &b) {
            (Operator::And, Value::Condition(a), Value::Condition(b)) => {
                Ok(Value::Condition(graph.binary(Binary::And, *a, *b)))
            }
            (Operator::Or, Value::Condition(a), Value::Condition(b)) => {
                Ok(Value::Condition(graph.binary(Binary::Or, *a, *b)))
            }
            (Operator::Equal | Operator::Unequal, Value::Condition(a), Value::Condition(b)) => {
                let not = graph.unary(Unary::Not, *b);
                let is_equal = operator == Operator::Equal;
                let (yes, no) = if is_equal { (*b, not) } else { (not, *b) };
                let (both, one) = (graph.binary(Binary::And, *a, yes), graph.unary(Unary::Not, *a));
                let neither = graph.binary(Binary::And, one, no);
                Ok(Value::Condition(graph.binary(Binary::Or, both, neither)))
            }
            (
                Operator::Add | Operator::Subtract | Operator::Multiply | Operator::Divide,
                Value::Number(x),
                Value::Number(y),
            ) if x.len() == y.len() || x.len() == 1 || y.len() == 1 => {
                let operation = match operator {
                    Operator::Add => Binary::Add,
                    Operator::Subtract => Binary::Subtract,
                    Operator::Multiply => Binary::Multiply,
                    _ => Binary::Divide,
                };
                let at = |v: &[NodeId], i: usize| v[i.min(v.len() - 1)];
                let parts = (0..x.len().max(y.len()))
                    .map(|i| graph.binary(operation, at(x, i), at(y, i)))
                    .collect();
                Ok(Value::Number(parts))
            }
            (_, Value::Number(x), Value::Number(y))
                if x.len() == 1
                    && y.len() == 1
                    && !matches!(operator, Operator::And | Operator::Or) =>
            {
                Ok(Value::Condition(comparison(graph, operator, x[0], y[0])))
            }
            _ => {
                let message = format!(
                    "`{}` cannot join {} and {}",
                    operator.sign(),
                    a.describe(),
                    b.describe()
                );
                self.error(span, message)
            }
        }
    }

    fn call(
        &mut self,
        function: &Function,
        arguments: &[Expression],
        values: Vec<Value>,
        span: Span,
    ) -> Result<Value, TextError> {
        let describe = || {
            let list: Vec<_> = function
                .arguments
                .iter()
                .map(|(name, kind)| format!("{name}: {}", kind.describe()))
                .collect();
            format!("{}({})", function.name, list.join(", "))
        };
        if let [(_, Argument::Parts(size))] = function.arguments {
            return self.constructor(function, *size, &values, span);
        }
        if values.len() != function.arguments.len() {
            let message = format!("found {} arguments; the call is `{}`", values.len(), describe());
            return self.error(span, message);
        }
        let mut parts = Vec::new();
        let mut any_size = 1;
        for ((value, (_, kind)), argument) in values.iter().zip(function.arguments).zip(arguments) {
            let fits = match (value, kind) {
                (Value::Condition(node), Argument::Condition) => {
                    parts.push(vec![*node]);
                    continue;
                }
                (Value::Condition(_), _) | (_, Argument::Condition) => false,
                (Value::Number(v), Argument::Any) => {
                    let fits = v.len() == 1 || any_size == 1 || v.len() == any_size;
                    any_size = any_size.max(v.len());
                    fits
                }
                (Value::Number(v), Argument::Vector) => {
                    let fits = v.len() > 1 && (any_size == 1 || v.len() == any_size);
                    any_size = v.len();
                    fits
                }
                (Value::Number(v), kind) => kind.size() == Some(v.len()),
            };
            if let (true, Value::Number(v)) = (fits, value) {
                parts.push(v.clone());
            } else {
                let message = format!("found {}; the call is `{}`", value.describe(), describe());
                return self.error(argument.span, message);
            }
        }
        Ok(Value::Number((function.lower)(&mut self.graph, &parts)))
    }

    fn constructor(
        &mut self,
        function: &Function,
        size: usize,
        values: &[Value],
        span: Span,
    ) -> Result<Value, TextError> {
        let mut parts = Vec::new();
        for value in values {
            match value {
                Value::Number(v) => parts.push(v.clone()),
                Value::Condition(_) => {
                    return self.error(
                        span,
                        "a vector cannot hold a condition: write `select(condition, 1, 0)`",
                    );
                }
            }
        }
        let count: usize = parts.iter().map(Vec::len).sum();
        if count != size && !(count == 1 && parts.len() == 1) {
            let message = format!(
                "found {count} components; `{}` takes {size}, or one for all",
                function.name
            );
            return self.error(span, message);
        }
        Ok(Value::Number((function.lower)(&mut self.graph, &parts)))
    }
}

/// Whether single precision holds a number of this size.
fn is_single(value: f64) -> bool {
    value.abs() <= f64::from(f32::MAX)
}

/// Longest name, in bytes.
const MAX_NAME_BYTES: usize = 32;

fn comparison(graph: &mut Graph, operator: Operator, a: NodeId, b: NodeId) -> NodeId {
    let less = graph.binary(Binary::Less, a, b);
    let greater = graph.binary(Binary::Less, b, a);
    match operator {
        Operator::Less => less,
        Operator::Greater => greater,
        Operator::LessOrEqual => graph.unary(Unary::Not, greater),
        Operator::GreaterOrEqual => graph.unary(Unary::Not, less),
        _ => {
            let differs = graph.binary(Binary::Or, less, greater);
            let is_unequal = operator == Operator::Unequal;
            if is_unequal { differs } else { graph.unary(Unary::Not, differs) }
        }
    }
}

/// Insertions, deletions and replacements of letters between two words (Levenshtein 1966).
fn edits(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.chars().enumerate() {
        let mut diagonal = std::mem::replace(&mut row[0], i + 1);
        for (j, y) in b.iter().enumerate() {
            let replaced = diagonal + usize::from(x != *y);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(diagonal + 1).min(row[j] + 1);
        }
    }
    row[b.len()]
}
