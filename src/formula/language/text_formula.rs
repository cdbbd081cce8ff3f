//! A formula made from a text: its parameters, field and kernels.

use std::{any::Any, sync::Arc};

use super::{
    check::{self, Checked, CheckedParam, Growth},
    field::TextField,
    kernel::Compiled,
    sequence::Sequence,
    steps::Steps,
    syntax,
    tree::{RangeUnit, Span, TextError},
    uniforms::MAX_SLOTS,
};
use crate::formula::{
    DistanceField, Formula, FormulaRef, Fractal, KernelFiles, MarchPolicy, Packed, PackedFor,
    param::{Param, Scale, Unit},
    table::{Choice, Field, Kind, Value},
};

/// A formula made from a text.
#[derive(Debug)]
pub struct TextFormula {
    id: &'static str,
    /// The text, for formulas that documents bring.
    text: Option<&'static str>,
    title: &'static str,
    about: &'static str,
    channel: Option<&'static str>,
    fields: &'static [Field],
    checked: Checked,
    steps: Steps,
}

/// The formula as one made from a text; none for those with kernels of their own.
pub fn as_text(formula: FormulaRef) -> Option<&'static TextFormula> {
    (formula.0 as &dyn Any).downcast_ref()
}

/// Whether a formula only transforms space, so that it draws nothing alone.
pub fn is_transform(formula: FormulaRef) -> bool {
    as_text(formula).is_some_and(|text| text.checked.growth == Growth::None)
}

impl TextFormula {
    /// Reads, checks and compiles a text. The formula is called `id` in documents.
    ///
    /// Names and kernels stay in memory as long as the program.
    ///
    /// # Errors
    ///
    /// The first error with its place in the text.
    pub fn new(id: &'static str, text: &str) -> Result<Self, TextError> {
        Ok(Self::of(id, None, compile(text)?))
    }

    /// Like [`Self::new`], for a text that documents carry whole. Nothing of a wrong text is kept.
    ///
    /// # Errors
    ///
    /// The first error with its place in the text.
    pub fn own(id: &str, text: &str) -> Result<Self, TextError> {
        let compiled = compile(text)?;
        Ok(Self::of(kept(id.to_owned()), Some(kept(text.to_owned())), compiled))
    }

    fn of(id: &'static str, text: Option<&'static str>, compiled: Compiled) -> Self {
        Self {
            id,
            text,
            title: kept(compiled.checked.title.clone()),
            about: kept(compiled.checked.about.clone()),
            channel: compiled.checked.channel.as_ref().map(|channel| kept(channel.label.clone())),
            fields: fields(&compiled.checked).leak(),
            steps: Steps::alone(id, &compiled),
            checked: compiled.checked,
        }
    }

    /// Number of nodes of the formula and its derivatives: how much memory it takes.
    pub fn size(&self) -> usize {
        self.checked.graph.nodes().len()
    }

    /// Where the equations are from.
    pub fn sources(&self) -> &[String] {
        &self.checked.sources
    }

    /// The checked operations.
    pub fn checked(&self) -> &Checked {
        &self.checked
    }

    /// The parameters, without those of the Julia form.
    pub fn own_fields(&self) -> &'static [Field] {
        &self.fields[..self.checked.params.len()]
    }

    /// The field of `fractal`, which is of this formula.
    pub fn field(&self, fractal: &Fractal) -> TextField {
        self.steps.field(self.sequence(fractal), fractal, julia_constant(fractal))
    }

    fn sequence(&self, fractal: &Fractal) -> Sequence {
        Sequence::alone(self.param_values(fractal.values()))
    }

    /// The numbers of the parameters in order; a switch is 0 or 1.
    pub fn param_values(&self, values: &[Value]) -> Vec<f64> {
        let own = values.iter().take(self.checked.params.len());
        own.flat_map(|value| match value {
            Value::Number(number) => vec![*number],
            Value::Vector(numbers) => numbers.to_vec(),
            Value::Switch(is_on) => vec![f64::from(u8::from(*is_on))],
            Value::Choice(_) => Vec::new(),
        })
        .collect()
    }
}

fn compile(text: &str) -> Result<Compiled, TextError> {
    let tree = syntax::parse(text)?;
    let compiled = Compiled::new(check::check(text, &tree)?);
    if compiled.slots.len() > MAX_SLOTS {
        let message = format!(
            "the parameters give {} computed values, and may give {MAX_SLOTS}: simplify the text",
            compiled.slots.len()
        );
        return Err(TextError::new(text, Span::default(), message));
    }
    Ok(compiled)
}

/// The addend of the Julia form, if `fractal` has that form.
pub fn julia_constant(fractal: &Fractal) -> Option<[f64; 4]> {
    if !fractal.is_on(JULIA) {
        return None;
    }
    let Some(Value::Vector(numbers)) = fractal.get(JULIA_CONSTANT) else { return None };
    Some(std::array::from_fn(|i| numbers.get(i).copied().unwrap_or_default()))
}

/// The switch of the Julia form in documents.
const JULIA: &str = "julia";
/// The Julia form's addend in documents.
const JULIA_CONSTANT: &str = "julia_constant";

/// Text that lives as long as the program.
pub fn kept(text: String) -> &'static str {
    Box::leak(text.into_boxed_str())
}

fn fields(checked: &Checked) -> Vec<Field> {
    let own = checked.params.iter().map(|param| Field {
        name: kept(param.name.clone()),
        kind: kind(param),
        only_with: None,
    });
    let mut all: Vec<_> = own.collect();
    if checked.has_addend {
        all.extend(julia_fields(checked.size));
    }
    all
}

fn kind(param: &CheckedParam) -> Kind {
    let (label, help) = (kept(param.label.clone()), kept(param.help.clone()));
    if param.is_switch {
        let option = |word, label| Choice { word, label, help };
        let default = param.default[0] != 0.0;
        return Kind::Switch {
            default,
            label,
            options: [option("false", "Off"), option("true", "On")],
        };
    }
    let is_vector = param.default.len() > 1;
    let brackets = if is_vector { "[]" } else { "" };
    let (unit, scale) = match param.unit {
        RangeUnit::Number => (Unit::None, Scale::Linear),
        RangeUnit::Degrees => (Unit::Degrees, Scale::Linear),
        RangeUnit::Whole => (Unit::Count, Scale::Integer),
        RangeUnit::Logarithmic => (Unit::None, Scale::Logarithmic),
    };
    let own: &'static Param = Box::leak(Box::new(Param {
        path: kept(format!("fractal.{}{brackets}", param.name)),
        label,
        unit,
        min: param.min,
        max: param.max,
        default: param.default[0],
        scale,
        step: slider_step(param),
        help,
    }));
    if !is_vector {
        return Kind::Number { param: own, quick: &[] };
    }
    let labels: Vec<_> =
        ["x", "y", "z", "w"].iter().map(|axis| kept(format!("{label} {axis}"))).collect();
    Kind::Vector {
        param: own,
        labels: &labels.leak()[..param.default.len()],
        default: param.default.clone().leak(),
    }
}

/// The change of one key press: about a hundredth of the range, as a power of ten.
fn slider_step(param: &CheckedParam) -> f64 {
    match param.unit {
        RangeUnit::Whole | RangeUnit::Degrees => 1.0,
        _ => 10.0_f64.powf((0.01 * (param.max - param.min)).log10().floor()),
    }
}

/// The Julia form's switch and constant of `size` components, which all formulas name alike.
pub fn julia_fields(size: usize) -> [Field; 2] {
    static CONSTANT: Param = Param {
        path: "fractal.julia_constant[]",
        label: "Julia constant",
        unit: Unit::SceneUnits,
        min: -2.0,
        max: 2.0,
        default: 0.0,
        scale: Scale::Linear,
        step: 0.01,
        help: "One coordinate of the Julia constant c. Changes the shape of the fractal.",
    };
    let option = |word, label, help| Choice { word, label, help };
    [
        Field {
            name: JULIA,
            kind: Kind::Switch {
                default: false,
                label: "Form",
                options: [
                    option("false", "Mandelbrot", "Each point adds itself at every step"),
                    option("true", "Julia", "All points add the same constant at every step"),
                ],
            },
            only_with: None,
        },
        Field {
            name: JULIA_CONSTANT,
            kind: Kind::Vector {
                param: &CONSTANT,
                labels: &["Constant x", "Constant y", "Constant z", "Constant w"][..size],
                default: &[0.35, -0.4, 0.55, 0.0][..size],
            },
            only_with: Some(JULIA),
        },
    ]
}

impl Formula for TextFormula {
    fn id(&self) -> &'static str {
        self.id
    }

    fn name(&self) -> &'static str {
        self.title
    }

    fn about(&self) -> &'static str {
        self.about
    }

    fn text(&self) -> Option<&'static str> {
        self.text
    }

    fn channel(&self) -> Option<&'static str> {
        self.channel
    }

    fn fields(&self) -> &'static [Field] {
        self.fields
    }

    fn default_iterations(&self) -> Option<u32> {
        self.checked.iterations
    }

    fn default_bailout(&self) -> Option<f64> {
        self.checked.bailout
    }

    fn max_bailout(&self, fractal: &Fractal) -> f64 {
        self.steps.max_bailout(&self.sequence(fractal))
    }

    fn march_policy(&self, _fractal: &Fractal) -> MarchPolicy {
        self.steps.march_policy()
    }

    fn iterations_for(&self, fractal: &Fractal, footprint: f64) -> u32 {
        Steps::iterations_for(fractal, footprint)
    }

    fn distance_field(&self, fractal: &Fractal) -> Arc<dyn DistanceField> {
        Arc::new(self.field(fractal))
    }

    fn pack(&self, fractal: &Fractal, view: &PackedFor<'_>) -> Packed {
        self.steps.pack(&self.sequence(fractal), fractal, julia_constant(fractal), view)
    }

    fn files(&self, _variant: u32) -> KernelFiles {
        self.steps.files().clone()
    }

    fn overrides(&self, _variant: u32) -> Vec<(&'static str, f64)> {
        self.steps.overrides()
    }
}
