//! From a formula's text to its syntax tree.
//!
//! [`parse`] reads the text by `grammar.pest`. Chains of operators of one precedence are lists, so the tree's
//! depth is bounded by the nesting of brackets.

use pest::{
    Parser, Span as PestSpan,
    error::{Error as PestError, ErrorVariant, InputLocation},
    iterators::{Pair, Pairs},
};

use super::{
    tokens::{TokenKind, tokens},
    tree::{
        EstimateDeclaration, Expression, ExpressionKind, Name, Operator, ParamDeclaration,
        ParamKind, RangeDeclaration, RangeUnit, Span, Statement, SyntaxTree, TextError,
    },
};

/// Largest text, in bytes.
pub const MAX_TEXT_BYTES: usize = 8192;
/// Deepest nesting of brackets.
const MAX_NESTING: usize = 32;

use grammar::{Grammar, Rule};

mod grammar {
    /// Reads texts by the grammar.
    #[derive(pest_derive::Parser)]
    #[grammar = "formula/language/grammar.pest"]
    pub struct Grammar;
}

impl From<PestSpan<'_>> for Span {
    fn from(span: PestSpan<'_>) -> Self {
        Self { start: span.start(), end: span.end() }
    }
}

/// Reads a text.
///
/// # Errors
///
/// The first error, with its place: the text is too long, nested too deeply, not of the grammar, or
/// declares something twice.
pub fn parse(text: &str) -> Result<SyntaxTree, TextError> {
    if text.len() > MAX_TEXT_BYTES {
        let span = Span { start: last_boundary(text, MAX_TEXT_BYTES), end: text.len() };
        let message = format!(
            "the text has {} bytes, and a formula may have {MAX_TEXT_BYTES}: shorten it",
            text.len()
        );
        return Err(TextError::new(text, span, message));
    }
    check_nesting(text)?;
    let mut pairs =
        Grammar::parse(Rule::file, text).map_err(|error| grammar_error(text, &error))?;
    let mut reader = Reader { text, tree: SyntaxTree::default(), met: Vec::new() };
    // The rule `file` yields one pair.
    for pair in pairs.next().into_iter().flat_map(Pair::into_inner) {
        reader.declaration(pair)?;
    }
    Ok(reader.tree)
}

fn last_boundary(text: &str, at: usize) -> usize {
    (0..=at).rev().find(|&i| text.is_char_boundary(i)).unwrap_or(0)
}

/// Refuses brackets that are nested too deeply: the parser recurses into them, but not into comments and quotes.
fn check_nesting(text: &str) -> Result<(), TextError> {
    let is_skipped = |kind| matches!(kind, TokenKind::Comment | TokenKind::Text);
    let read = tokens(text).into_iter().filter(|(kind, _)| !is_skipped(*kind));
    let mut depth = 0_usize;
    for (start, c) in
        read.flat_map(|(_, span)| (span.start..).zip(text[span.start..span.end].bytes()))
    {
        match c {
            b'(' | b'{' => depth += 1,
            b')' | b'}' => depth = depth.saturating_sub(1),
            _ => {}
        }
        if depth > MAX_NESTING {
            let message = format!("brackets are nested more than {MAX_NESTING} deep: use `let`");
            return Err(TextError::new(text, Span { start, end: start + 1 }, message));
        }
    }
    Ok(())
}

/// The error of the parser library in this program's words.
fn grammar_error(text: &str, error: &PestError<Rule>) -> TextError {
    let start = match error.location {
        InputLocation::Pos(start) | InputLocation::Span((start, _)) => start,
    };
    let rest = text.get(start..).unwrap_or_default();
    let word: String = rest.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
    let found = match (word.is_empty(), rest.chars().next()) {
        (false, _) => format!("`{word}`"),
        (true, Some(c)) => format!("`{}`", c.escape_default()),
        (true, None) => "the end of the text".to_owned(),
    };
    let mut expected: Vec<String> = match &error.variant {
        ErrorVariant::ParsingError { positives, .. } => positives.iter().map(words_of).collect(),
        ErrorVariant::CustomError { .. } => Vec::new(),
    };
    expected.sort_unstable();
    expected.dedup();
    // The library names rules only: a missing punctuation mark has none.
    let message = match expected.as_slice() {
        [] => format!(
            "found {found}, which does not fit here; is a `;`, a bracket or a quote missing before it?"
        ),
        [one] => format!("found {found}, expected {one}"),
        [first @ .., last] => format!("found {found}, expected {} or {last}", first.join(", ")),
    };
    let end = start + found.trim_matches('`').len().min(rest.len());
    TextError::new(text, Span { start, end: end.max(start) }, message)
}

/// What a rule of the grammar stands for, in words.
fn words_of(rule: &Rule) -> String {
    let rule = format!("{rule:?}");
    let words = match rule.as_str() {
        "file" | "declaration" | "title" | "about" | "source" | "param" | "state" | "init"
        | "step" | "size" | "estimate" | "bound" | "iterations" | "bailout" | "march" | "color" => {
            "a declaration"
        }
        "definition" => "`let`",
        "assignment" => "an assignment",
        "switch" | "on" | "off" => "`true` or `false`",
        "unit" | "degrees" | "whole" | "logarithmic" => "`degrees`, `whole` or `logarithmic`",
        "vec3" | "vec4" => "`vec3` or `vec4`",
        "log" | "linear" | "distance" | "none" => "`log`, `linear`, `distance` or `none`",
        "string" | "text" => "a string in double quotes",
        "name" => "a name",
        "swizzle" | "components" => "components such as `.xy`",
        "or" | "and" | "compare" | "add" | "multiply" => "an operator",
        "label" => "`label`",
        "checked" => "`checked`",
        "help" => "`help`",
        "EOI" => "the end of the text",
        "mark_semicolon" => "`;`",
        "mark_equals" => "`=`",
        "mark_open" => "`{`",
        "mark_close" => "`}`",
        "mark_left" => "`(`",
        "mark_right" => "`)`",
        "mark_comma" => "`,`",
        keyword => match keyword.strip_prefix("word_") {
            Some(word) => return format!("`{word}`"),
            None => "an expression",
        },
    };
    words.to_owned()
}

/// Builds the tree of one text.
struct Reader<'a> {
    text: &'a str,
    tree: SyntaxTree,
    /// Declarations met so far that a text has at most once.
    met: Vec<Rule>,
}

impl Reader<'_> {
    fn error(&self, span: Span, message: impl Into<String>) -> TextError {
        TextError::new(self.text, span, message)
    }

    fn declaration(&mut self, pair: Pair<'_, Rule>) -> Result<(), TextError> {
        let (rule, span) = (pair.as_rule(), Span::from(pair.as_span()));
        let may_repeat = matches!(rule, Rule::source | Rule::param | Rule::definition | Rule::EOI);
        if !may_repeat && self.met.contains(&rule) {
            let word = pair.as_str().split_whitespace().next().unwrap_or_default();
            return Err(self.error(span, format!("`{word}` is declared twice: keep one")));
        }
        self.met.push(rule);
        let mut inner = Parts(pair.into_inner());
        match rule {
            Rule::title => self.tree.title = Some(string(inner.next())),
            Rule::about => self.tree.about = Some(string(inner.next())),
            Rule::source => self.tree.sources.push(string(inner.next())),
            Rule::param => {
                let param = self.param(inner)?;
                self.tree.params.push(param);
            }
            Rule::definition => {
                let name = name(&inner.next());
                self.tree.definitions.push((name, self.expression(inner.next())?));
            }
            Rule::state => self.tree.is_vec4 = inner.next().as_rule() == Rule::vec4,
            Rule::init => self.tree.init = Some(self.expression(inner.next())?),
            Rule::step => {
                let statements = inner.0.filter(has_value).map(|pair| self.statement(pair));
                self.tree.step = Some((span, statements.collect::<Result<_, _>>()?));
            }
            Rule::size => self.tree.extent = Some(self.expression(inner.next())?),
            Rule::estimate => self.tree.estimate = Some(self.estimate(inner.next())?),
            Rule::bound => self.tree.bound = Some(self.expression(inner.next())?),
            Rule::iterations => self.tree.iterations = Some(self.expression(inner.next())?),
            Rule::bailout => self.tree.bailout = Some(self.expression(inner.next())?),
            Rule::color => self.tree.channel = Some(string(inner.next())),
            Rule::march => {
                self.tree.march = Some(self.expression(inner.next())?);
                self.tree.checks_hits = inner.next_if_any().is_some();
            }
            _ => {}
        }
        Ok(())
    }

    fn param(&self, mut inner: Parts<'_>) -> Result<ParamDeclaration, TextError> {
        let name = name(&inner.next());
        let values = inner.next();
        let is_switch = values.as_rule() == Rule::switch;
        let mut parts = Parts(values.into_inner());
        let kind = if is_switch {
            ParamKind::Switch(parts.next().as_rule() == Rule::on)
        } else {
            ParamKind::Range(Box::new(RangeDeclaration {
                default: self.expression(parts.next())?,
                min: self.expression(parts.next())?,
                max: self.expression(parts.next())?,
                unit: match parts.next_if_any().map(|unit| unit.into_inner().as_str().to_owned()) {
                    Some(unit) if unit.starts_with("degrees") => RangeUnit::Degrees,
                    Some(unit) if unit.starts_with("whole") => RangeUnit::Whole,
                    Some(_) => RangeUnit::Logarithmic,
                    None => RangeUnit::Number,
                },
            }))
        };
        let label = string_in(inner.next());
        let help = inner.next_if_any().map(string_in).unwrap_or_default();
        Ok(ParamDeclaration { name, kind, label, help })
    }

    fn statement(&self, pair: Pair<'_, Rule>) -> Result<Statement, TextError> {
        let is_definition = pair.as_rule() == Rule::definition;
        let mut inner = Parts(pair.into_inner());
        let target = name(&inner.next());
        let mut value = inner.next();
        let mut components = None;
        if value.as_rule() == Rule::swizzle {
            components = Some(components_of(value));
            value = inner.next();
        }
        let value = self.expression(value)?;
        Ok(if is_definition {
            Statement::Let(target, value)
        } else {
            Statement::Assign(target, components, value)
        })
    }

    fn estimate(&self, pair: Pair<'_, Rule>) -> Result<EstimateDeclaration, TextError> {
        let rule = pair.as_rule();
        let value = Parts(pair.into_inner()).next_if_any();
        let value = value.map(|value| self.expression(value)).transpose()?;
        Ok(match (rule, value) {
            (Rule::linear, offset) => EstimateDeclaration::Linear(offset),
            (Rule::distance, Some(value)) => EstimateDeclaration::Distance(value),
            (Rule::none, _) => EstimateDeclaration::Transform,
            _ => EstimateDeclaration::Log,
        })
    }

    /// Reads an expression of any precedence.
    fn expression(&self, pair: Pair<'_, Rule>) -> Result<Expression, TextError> {
        let span = Span::from(pair.as_span());
        let kind = match pair.as_rule() {
            Rule::number => {
                let number: f64 = pair.as_str().parse().unwrap_or(f64::INFINITY);
                if number.abs() > f64::from(f32::MAX) {
                    let message = "the number is too large for single precision";
                    return Err(self.error(span, message));
                }
                ExpressionKind::Number(number)
            }
            Rule::on => ExpressionKind::Switch(true),
            Rule::off => ExpressionKind::Switch(false),
            Rule::name => ExpressionKind::Name(pair.as_str().to_owned()),
            Rule::call => {
                let mut inner = Parts(pair.into_inner());
                let function = name(&inner.next());
                let arguments = inner.0.filter(has_value).map(|argument| self.expression(argument));
                ExpressionKind::Call(function, arguments.collect::<Result<_, _>>()?)
            }
            Rule::group => return self.only(pair),
            Rule::postfix => {
                let mut inner = pair.into_inner();
                let (Some(operand), swizzle) = (inner.next(), inner.next()) else {
                    return Err(self.error(span, "an expression is missing"));
                };
                let operand = self.expression(operand)?;
                let Some(swizzle) = swizzle else { return Ok(operand) };
                ExpressionKind::Swizzle(Box::new(operand), components_of(swizzle))
            }
            Rule::signed => {
                let mut inner = pair.into_inner();
                match (inner.next(), inner.next()) {
                    (Some(_), Some(operand)) => {
                        ExpressionKind::Negated(Box::new(self.expression(operand)?))
                    }
                    (Some(operand), None) => return self.expression(operand),
                    _ => return Err(self.error(span, "an expression is missing")),
                }
            }
            _ => {
                let mut inner = pair.into_inner();
                let Some(first) = inner.next() else {
                    return Err(self.error(span, "an expression is missing"));
                };
                let first = self.expression(first)?;
                let mut others = Vec::new();
                while let (Some(sign), Some(operand)) = (inner.next(), inner.next()) {
                    let Some(operator) = Operator::of_sign(sign.as_str()) else {
                        return Err(self.error(sign.as_span().into(), "the operator is unknown"));
                    };
                    others.push((operator, self.expression(operand)?));
                }
                if others.is_empty() {
                    return Ok(first);
                }
                ExpressionKind::Chain(Box::new(first), others)
            }
        };
        Ok(Expression { kind, span })
    }

    fn only(&self, pair: Pair<'_, Rule>) -> Result<Expression, TextError> {
        let span = Span::from(pair.as_span());
        let inner = Parts(pair.into_inner()).next_if_any();
        inner.map_or_else(
            || Err(self.error(span, "an expression is missing")),
            |inner| self.expression(inner),
        )
    }
}

/// The parts of a pair, whose number the grammar guarantees.
struct Parts<'a>(Pairs<'a, Rule>);

impl<'a> Parts<'a> {
    /// The next part.
    ///
    /// # Panics
    ///
    /// If the grammar's rule has no such part.
    fn next(&mut self) -> Pair<'a, Rule> {
        self.0.find(has_value).expect("the grammar's rule has this part")
    }

    /// The next part, where the rule may have one more.
    fn next_if_any(&mut self) -> Option<Pair<'a, Rule>> {
        self.0.find(has_value)
    }
}

/// Whether a part is something other than a keyword or a mark, which have no value.
fn has_value(pair: &Pair<'_, Rule>) -> bool {
    let rule = format!("{:?}", pair.as_rule());
    !rule.starts_with("word_") && !rule.starts_with("mark_")
}

fn name(pair: &Pair<'_, Rule>) -> Name {
    Name { text: pair.as_str().to_owned(), span: pair.as_span().into() }
}

/// The components of a swizzle, without the dot.
fn components_of(pair: Pair<'_, Rule>) -> Name {
    name(&Parts(pair.into_inner()).next())
}

/// The text between the quotes.
fn string(pair: Pair<'_, Rule>) -> String {
    pair.as_str().trim_matches('"').to_owned()
}

/// The text of a label or a help.
fn string_in(pair: Pair<'_, Rule>) -> String {
    string(Parts(pair.into_inner()).next())
}
