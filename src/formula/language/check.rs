//! From a syntax tree to checked operations: names, types, limits.

use std::collections::HashMap;

use super::{
    evaluate::Program,
    graph::{Graph, Input, Node, NodeId},
    scope::{Scope, Value},
    tree::{
        EstimateDeclaration, Expression, ParamDeclaration, ParamKind, RangeDeclaration, RangeUnit,
        Span, SyntaxTree, TextError,
    },
};

/// Most operations of one step, after simplification; and of what an orbit's start and end compute.
pub const MAX_OPERATIONS: usize = 512;
/// Most numbers that a formula's parameters have in all.
pub const MAX_PARAM_NUMBERS: usize = 48;
/// Largest bailout by default.
const MAX_BAILOUT: f64 = 256.0;
/// Most iterations by default.
const MAX_ITERATIONS: f64 = 100.0;

/// A parameter with checked values.
#[derive(Clone, Debug, PartialEq)]
pub struct CheckedParam {
    /// The name in documents.
    pub name: String,
    /// The label in the panel.
    pub label: String,
    /// What the parameter does.
    pub help: String,
    /// The values; a switch has one number, 0 or 1.
    pub default: Vec<f64>,
    /// Least value of each component.
    pub min: f64,
    /// Greatest value of each component.
    pub max: f64,
    /// The unit.
    pub unit: RangeUnit,
    /// Whether the parameter is a switch.
    pub is_switch: bool,
}

/// How the orbits of points far from the set grow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Growth {
    /// As a power of their size.
    Power,
    /// By a factor.
    Linear,
    /// Not at all: the step transforms space.
    None,
}

/// The colour channel of a formula.
#[derive(Clone, Debug)]
pub struct Channel {
    /// What a step adds.
    pub value: NodeId,
    /// The channel's name in the panel.
    pub label: String,
}

/// A formula whose names and types are right.
#[derive(Clone, Debug)]
pub struct Checked {
    /// The formula's name in panels.
    pub title: String,
    /// What the formula draws.
    pub about: String,
    /// Where the equations are from.
    pub sources: Vec<String>,
    /// The parameters.
    pub params: Vec<CheckedParam>,
    /// Number of components of the state: 3 or 4.
    pub size: usize,
    /// All operations.
    pub graph: Graph,
    /// The state at the start.
    pub init: Vec<NodeId>,
    /// The state after a step.
    pub step: Vec<NodeId>,
    /// The running derivative after a step; none if the text gives none.
    pub derivative: Option<NodeId>,
    /// What a step adds to the colour channel; none if the text gives nothing.
    pub channel: Option<Channel>,
    /// The size that the bailout limits.
    pub extent: NodeId,
    /// Whether that is the state's length.
    pub has_usual_size: bool,
    /// The estimated distance at an orbit's end, not clamped.
    pub distance: NodeId,
    /// How orbits grow.
    pub growth: Growth,
    /// Whether the text gives the distance itself.
    pub has_own_distance: bool,
    /// What grows with the distance from the set, for normals where the text gives no derivative.
    pub height: NodeId,
    /// Whether the step adds c, so that the formula has a Julia form.
    pub has_addend: bool,
    /// Radius of a sphere that holds the set, from the parameters; none if the text gives none.
    pub bound: Option<NodeId>,
    /// Step of a ray over the estimate.
    pub march: f64,
    /// Whether the estimate has false minima thinner than a pixel, so that hits are checked.
    pub checks_hits: bool,
    /// The scene's iterations by default; none for the usual number.
    pub iterations: Option<u32>,
    /// The scene's bailout by default; none for the usual one.
    pub bailout: Option<f64>,
}

/// Checks a tree, which is that of `text`.
///
/// # Errors
///
/// The first error with its place: an unknown or doubled name, a wrong type, a declaration that is missing,
/// too many parameters or operations.
pub fn check(text: &str, tree: &SyntaxTree) -> Result<Checked, TextError> {
    let mut scope = Scope {
        text,
        graph: Graph::default(),
        names: HashMap::new(),
        hidden: &["p", "z", "c", "dr", "dc", "color"],
    };
    let whole = Span { start: 0, end: 0 };
    let missing = |what: &str| TextError::new(text, whole, format!("the text has no {what}"));
    let title = tree.title.clone().ok_or_else(|| missing("name: begin with `name \"…\";`"))?;
    let params = scope.params(&tree.params)?;
    let pi = scope.graph.constant(std::f64::consts::PI);
    scope.names.insert("pi".to_owned(), Value::Number(vec![pi]));
    for (name, value) in &tree.definitions {
        let value = scope.value(value)?;
        scope.define(name, value)?;
    }
    let size = if tree.is_vec4 { 4 } else { 3 };
    let [point, state, addend] =
        [(Input::Point as fn(u8) -> Input, 3), (Input::State, size), (Input::Addend, size)].map(
            |(input, size): (fn(u8) -> Input, u8)| {
                (0..size).map(|i| scope.graph.input(input(i))).collect::<Vec<_>>()
            },
        );
    let size = usize::from(size);
    let constant = |scope: &mut Scope<'_>, value: &Option<Expression>, [min, max]: [f64; 2]| {
        value.as_ref().map(|value| scope.constant(value, [min, max])).transpose()
    };
    let march = constant(&mut scope, &tree.march, [0.05, 1.0])?.unwrap_or(1.0);
    let iterations = constant(&mut scope, &tree.iterations, [2.0, MAX_ITERATIONS])?;
    let bailout = constant(&mut scope, &tree.bailout, [2.0, MAX_BAILOUT])?;
    let bound = match &tree.bound {
        Some(bound) => Some(scope.float(bound)?),
        None => None,
    };
    scope.names.insert("p".to_owned(), Value::Number(point.clone()));
    scope.hidden = &["z", "c", "dr", "dc", "color"];
    let init = match &tree.init {
        Some(init) => scope.sized(init, size, "the state")?,
        None => {
            let zero = scope.graph.constant(0.0);
            point.iter().copied().chain([zero]).take(size).collect()
        }
    };
    let outer = scope.names.clone();
    scope.hidden = &[];
    scope.names.insert("z".to_owned(), Value::Number(state.clone()));
    scope.names.insert("c".to_owned(), Value::Number(addend));
    let derivative = scope.graph.input(Input::Derivative);
    let by_point = scope.graph.input(Input::AddendDerivative);
    scope.names.insert("dr".to_owned(), Value::Number(vec![derivative]));
    scope.names.insert("dc".to_owned(), Value::Number(vec![by_point]));
    let (place, statements) =
        tree.step.as_ref().ok_or_else(|| missing("step: add `step { z = …; }`"))?;
    let zero = scope.graph.constant(0.0);
    scope.names.insert("color".to_owned(), Value::Number(vec![zero]));
    let assigned = scope.step(statements)?;
    let gives_derivative = assigned.derivative;
    let step = scope.numbers("z");
    let derivative = gives_derivative.then(|| scope.numbers("dr")[0]);
    let channel = assigned.color.then(|| scope.numbers("color")[0]);
    let reads = |outputs: &[NodeId]| {
        scope.graph.needed(outputs, |_| false).iter().any(|&id| {
            matches!(scope.graph.node(id), Node::Input(Input::Derivative | Input::AddendDerivative))
        })
    };
    if reads(channel.as_slice()) {
        return Err(TextError::new(text, *place, "`color` must not depend on `dr` or `dc`"));
    }
    let reads_derivative = reads(&step);
    if reads_derivative && !gives_derivative {
        return Err(TextError::new(
            text,
            *place,
            "the step reads `dr` or `dc`, but does not assign `dr`",
        ));
    }
    scope.names = outer;
    // The size is compared at every step: it knows the state alone.
    let point = scope.names.remove("p");
    scope.names.insert("z".to_owned(), Value::Number(state.clone()));
    scope.hidden = &["p", "c", "dr", "dc", "color"];
    let extent = match &tree.extent {
        Some(extent) => scope.float(extent)?,
        None => scope.graph.length(&state),
    };
    scope.names.extend(point.map(|point| ("p".to_owned(), point)));
    scope.names.insert("dr".to_owned(), Value::Number(vec![scope.graph.input(Input::Derivative)]));
    scope.hidden = &["c", "dc", "color"];
    let distance = scope.distance(tree.estimate.as_ref(), extent, &state)?;
    let height = match tree.estimate {
        Some(EstimateDeclaration::Distance(_)) => distance,
        _ => extent,
    };
    let graph = scope.graph;
    let used: Vec<_> = step.iter().copied().chain(derivative).chain(channel).collect();
    let operations = operation_count(&graph, &used);
    if operations > MAX_OPERATIONS {
        let message = format!(
            "the step has {operations} operations, and may have {MAX_OPERATIONS}: simplify it"
        );
        return Err(TextError::new(text, *place, message));
    }
    let ends: Vec<_> = init.iter().copied().chain([extent, distance]).chain(bound).collect();
    let operations = operation_count(&graph, &ends);
    if operations > MAX_OPERATIONS {
        let message = format!(
            "`init`, `size`, `estimate` and `bound` have {operations} operations, and may have {MAX_OPERATIONS}: \
             simplify them"
        );
        return Err(TextError::new(text, whole, message));
    }
    let has_addend = graph
        .needed(&step, |_| false)
        .iter()
        .any(|&id| matches!(graph.node(id), Node::Input(Input::Addend(_))));
    Ok(Checked {
        title,
        about: tree.about.clone().unwrap_or_default(),
        sources: tree.sources.clone(),
        params,
        size,
        init,
        step,
        derivative,
        channel: channel.map(|value| Channel {
            value,
            label: tree.channel.clone().unwrap_or_else(|| "Formula".to_owned()),
        }),
        has_usual_size: tree.extent.is_none(),
        extent,
        distance,
        height,
        growth: match tree.estimate {
            None | Some(EstimateDeclaration::Log) => Growth::Power,
            Some(EstimateDeclaration::Transform) => Growth::None,
            Some(_) => Growth::Linear,
        },
        has_own_distance: matches!(tree.estimate, Some(EstimateDeclaration::Distance(_))),
        has_addend,
        bound,
        march,
        checks_hits: tree.checks_hits,
        iterations: iterations.map(|iterations| iterations as u32),
        bailout,
        graph,
    })
}

/// Operations that `outputs` need for each point; those of parameters only are done once.
fn operation_count(graph: &Graph, outputs: &[NodeId]) -> usize {
    let is_operation = |&id: &NodeId| !matches!(graph.node(id), Node::Constant(_) | Node::Input(_));
    graph.needed(outputs, |_| false).iter().filter(|id| is_operation(id)).count()
}

impl Scope<'_> {
    fn params(&mut self, all: &[ParamDeclaration]) -> Result<Vec<CheckedParam>, TextError> {
        let (mut checked, mut count) = (Vec::new(), 0);
        for param in all {
            if self.names.contains_key(&param.name.text) {
                let message = format!("`{}` is declared twice: rename one", param.name.text);
                return self.error(param.name.span, message);
            }
            let one = self.param(param)?;
            let first = count;
            count += one.default.len();
            if count > MAX_PARAM_NUMBERS {
                let message =
                    format!("the parameters have more than {MAX_PARAM_NUMBERS} numbers in all");
                return self.error(param.name.span, message);
            }
            let parts: Vec<_> =
                (first..count).map(|i| self.graph.input(Input::Param(i as u16))).collect();
            let value =
                if one.is_switch { Value::Condition(parts[0]) } else { Value::Number(parts) };
            self.define(&param.name, value)?;
            checked.push(one);
        }
        Ok(checked)
    }

    fn param(&mut self, param: &ParamDeclaration) -> Result<CheckedParam, TextError> {
        let (default, [min, max], unit, is_switch) = match &param.kind {
            ParamKind::Switch(is_on) => {
                (vec![f64::from(u8::from(*is_on))], [0.0, 1.0], RangeUnit::Whole, true)
            }
            ParamKind::Range(declared) => {
                let RangeDeclaration { default, min, max, unit } = &**declared;
                let range = [self.constant(min, ANY)?, self.constant(max, ANY)?];
                if range[0] >= range[1] {
                    return self.error(min.span, "the range is empty: write the smaller end first");
                }
                if range[1] - range[0] < LEAST_RANGE {
                    let message = format!("the range is smaller than {LEAST_RANGE}: widen it");
                    return self.error(min.span, message);
                }
                if *unit == RangeUnit::Logarithmic && range[0] < 0.0 {
                    return self.error(min.span, "a `logarithmic` range begins at 0 or above");
                }
                (self.constants(default, range)?, range, *unit, false)
            }
        };
        if unit == RangeUnit::Whole && default.iter().chain([&min, &max]).any(|x| x.fract() != 0.0)
        {
            return self.error(param.name.span, "a `whole` range has whole numbers only");
        }
        Ok(CheckedParam {
            name: param.name.text.clone(),
            label: param.label.clone(),
            help: param.help.clone(),
            default,
            min,
            max,
            unit,
            is_switch,
        })
    }
}

/// The range of parameters' numbers.
const ANY: [f64; 2] = [-1e6, 1e6];
/// Least width of a parameter's range: sliders round to a hundredth of it.
const LEAST_RANGE: f64 = 1e-6;

impl Checked {
    /// The same formula for orbits whose state has `size` components: steps keep those that they do not know.
    #[must_use]
    pub fn widened(mut self, size: usize) -> Self {
        for place in self.size..size {
            self.init.push(self.graph.constant(0.0));
            self.step.push(self.graph.input(Input::State(place as u8)));
        }
        self.size = self.size.max(size);
        self
    }

    /// Operations of one step for each point.
    pub fn operation_count(&self) -> usize {
        let channel = self.channel.iter().map(|channel| channel.value);
        let used: Vec<_> =
            self.step.iter().copied().chain(self.derivative).chain(channel).collect();
        operation_count(&self.graph, &used)
    }

    /// Whether a node depends on parameters only, and is worth computing beforehand.
    pub fn is_of_params(&self) -> Vec<bool> {
        let mut all: Vec<bool> = Vec::with_capacity(self.graph.nodes().len());
        for node in self.graph.nodes() {
            let is_of_params = match node {
                Node::Constant(_) | Node::Input(Input::Param(_)) => true,
                Node::Input(_) => false,
                operation => operation.operands().all(|id| all[id.index()]),
            };
            all.push(is_of_params);
        }
        all
    }

    /// The program that computes the bound from the parameters.
    pub fn bound_program(&self) -> Option<Program> {
        self.bound.map(|bound| Program::new(&self.graph, &[bound], &HashMap::new()))
    }
}
