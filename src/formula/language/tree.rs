//! The syntax tree of a formula's text, and errors with their places.

use std::fmt;

/// A part of a text: byte offsets of its start and end.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Span {
    /// Offset of the first byte.
    pub start: usize,
    /// Offset behind the last byte.
    pub end: usize,
}

/// An error in a formula's text.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub struct TextError {
    /// The part of the text that is wrong.
    pub span: Span,
    /// Line of the error, from 1.
    pub line: usize,
    /// Column of the error in characters, from 1.
    pub column: usize,
    /// What is wrong, and what to do.
    pub message: String,
}

impl fmt::Display for TextError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {}, column {}: {}", self.line, self.column, self.message)
    }
}

impl TextError {
    /// An error at `span` of `text`.
    pub fn new(text: &str, span: Span, message: impl Into<String>) -> Self {
        let before = text.get(..span.start).unwrap_or(text);
        let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
        Self {
            span,
            line: before.matches('\n').count() + 1,
            column: before[line_start..].chars().count() + 1,
            message: message.into(),
        }
    }
}

/// A name with its place in the text.
#[derive(Clone, Debug, PartialEq)]
pub struct Name {
    /// The name.
    pub text: String,
    /// The name's place.
    pub span: Span,
}

/// An expression.
#[derive(Clone, Debug, PartialEq)]
pub struct Expression {
    /// What the expression computes.
    pub kind: ExpressionKind,
    /// The expression's place.
    pub span: Span,
}

/// What an expression computes.
#[derive(Clone, Debug, PartialEq)]
pub enum ExpressionKind {
    /// A number as written.
    Number(f64),
    /// `true` or `false`.
    Switch(bool),
    /// The value of a name.
    Name(String),
    /// A function's value.
    Call(Name, Vec<Expression>),
    /// The operand with the opposite sign.
    Negated(Box<Expression>),
    /// Components of a vector, such as `xy`.
    Swizzle(Box<Expression>, Name),
    /// Operands joined from the left by operators of one precedence.
    Chain(Box<Expression>, Vec<(Operator, Expression)>),
}

/// An operator between two expressions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operator {
    /// `+`
    Add,
    /// `-`
    Subtract,
    /// `*`
    Multiply,
    /// `/`
    Divide,
    /// `<`
    Less,
    /// `<=`
    LessOrEqual,
    /// `>`
    Greater,
    /// `>=`
    GreaterOrEqual,
    /// `==`
    Equal,
    /// `!=`
    Unequal,
    /// `&&`
    And,
    /// `||`
    Or,
}

/// The operators with their signs.
pub const OPERATORS: [(Operator, &str); 12] = [
    (Operator::Add, "+"),
    (Operator::Subtract, "-"),
    (Operator::Multiply, "*"),
    (Operator::Divide, "/"),
    (Operator::Less, "<"),
    (Operator::LessOrEqual, "<="),
    (Operator::Greater, ">"),
    (Operator::GreaterOrEqual, ">="),
    (Operator::Equal, "=="),
    (Operator::Unequal, "!="),
    (Operator::And, "&&"),
    (Operator::Or, "||"),
];

impl Operator {
    /// The operator as texts write it.
    pub fn sign(self) -> &'static str {
        OPERATORS
            .iter()
            .find_map(|(other, sign)| (*other == self).then_some(*sign))
            .unwrap_or_default()
    }

    /// The operator that texts write as `sign`; none if there is none.
    pub fn of_sign(sign: &str) -> Option<Self> {
        OPERATORS.iter().find_map(|(other, known)| (*known == sign).then_some(*other))
    }
}

/// The unit of a parameter's range.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum RangeUnit {
    /// A plain number.
    #[default]
    Number,
    /// Degrees of arc.
    Degrees,
    /// Whole numbers.
    Whole,
    /// A number on a logarithmic slider.
    Logarithmic,
}

/// The values that a parameter takes.
#[derive(Clone, Debug, PartialEq)]
pub enum ParamKind {
    /// A switch with its default.
    Switch(bool),
    /// A number or a vector.
    Range(Box<RangeDeclaration>),
}

/// The range of a number or of a vector's components.
#[derive(Clone, Debug, PartialEq)]
pub struct RangeDeclaration {
    /// The default.
    pub default: Expression,
    /// Least value of each component.
    pub min: Expression,
    /// Greatest value of each component.
    pub max: Expression,
    /// The unit.
    pub unit: RangeUnit,
}

/// A parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct ParamDeclaration {
    /// The name in the text and in documents.
    pub name: Name,
    /// The values.
    pub kind: ParamKind,
    /// The label in the panel.
    pub label: String,
    /// What the parameter does to the picture; empty if the text has no help.
    pub help: String,
}

/// One statement of a step.
#[derive(Clone, Debug, PartialEq)]
pub enum Statement {
    /// `let name = value;`
    Let(Name, Expression),
    /// `name = value;` or `name.xy = value;`
    Assign(Name, Option<Name>, Expression),
}

/// How distances are estimated.
#[derive(Clone, Debug, PartialEq)]
pub enum EstimateDeclaration {
    /// Half of r ln r / dr, for orbits that grow as a power.
    Log,
    /// (r − offset) / dr, for orbits that grow by a factor.
    Linear(Option<Expression>),
    /// The text's own expression.
    Distance(Expression),
    /// None: the step only transforms space, for hybrids.
    Transform,
}

/// A formula's text as a tree, with each declaration at most once.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SyntaxTree {
    /// The formula's name in panels.
    pub title: Option<String>,
    /// What the formula draws, in one sentence.
    pub about: Option<String>,
    /// Where the equations are from.
    pub sources: Vec<String>,
    /// The parameters.
    pub params: Vec<ParamDeclaration>,
    /// Values computed from the parameters.
    pub definitions: Vec<(Name, Expression)>,
    /// Whether the orbit's state is a vec4.
    pub is_vec4: bool,
    /// The state's value at the start.
    pub init: Option<Expression>,
    /// The statements of one step.
    pub step: Option<(Span, Vec<Statement>)>,
    /// The size that is compared with the bailout.
    pub extent: Option<Expression>,
    /// How distances are estimated.
    pub estimate: Option<EstimateDeclaration>,
    /// Radius of a sphere that holds the set.
    pub bound: Option<Expression>,
    /// The scene's iterations by default.
    pub iterations: Option<Expression>,
    /// The scene's bailout by default.
    pub bailout: Option<Expression>,
    /// Step of a ray over the estimate.
    pub march: Option<Expression>,
    /// Whether hits are checked.
    pub checks_hits: bool,
    /// What the step assigns to `color`, as a label in the panel.
    pub channel: Option<String>,
}
