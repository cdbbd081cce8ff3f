//! A fractal in the scene document: `formula`, the shared fields and the formula's own fields.
//!
//! Fields may have any order, but for those of a formula that the document brings as a text: they follow it. A
//! missing field takes the formula's default; a document without `formula`, such as one of version 1, means the
//! Mandelbulb. A hybrid has the formula `hybrid`, `loop_start`, and in `steps` an object per step: `formula`,
//! `repeats` and the formula's own fields, which follow `formula`.

use std::fmt;

use serde::{
    Deserialize, Deserializer, Serialize, Serializer,
    de::{DeserializeSeed, Error, MapAccess, Unexpected, Visitor},
    ser::SerializeMap,
};

use super::{
    FormulaRef, Fractal, HybridStep, HybridSteps, all, hybrid,
    language::{TextError, check::MAX_PARAM_NUMBERS, sequence::MAX_STEPS},
    own,
    section::MAX_SECTION_PLANES,
    table::{Choice, Field, Kind, Value},
};
use crate::reading::list::AtMost;

/// Fields of every formula.
const SHARED: [&str; 4] = ["formula", "iterations", "bailout", "section_planes"];
/// The names of what only hybrids have.
const HYBRID_ONLY: [&str; 2] = ["loop_start", "steps"];
/// The names of what the Julia form has; those hybrids have it that add a constant.
const JULIA: [&str; 2] = ["julia", "julia_constant"];
/// What a document calls the formula of a hybrid.
const HYBRID: &str = "hybrid";

impl Serialize for Fractal {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        match self.hybrid() {
            None => map.serialize_entry("formula", &self.formula())?,
            Some(_) => map.serialize_entry("formula", HYBRID)?,
        }
        map.serialize_entry("iterations", &self.iterations)?;
        map.serialize_entry("bailout", &self.bailout)?;
        map.serialize_entry("section_planes", &self.section_planes)?;
        write_values(&mut map, self.fields())?;
        if let Some(hybrid) = self.hybrid() {
            map.serialize_entry("loop_start", &hybrid.loop_start)?;
            map.serialize_entry("steps", &hybrid.steps)?;
        }
        map.end()
    }
}

impl Serialize for HybridStep {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("formula", &self.formula())?;
        map.serialize_entry("repeats", &self.repeats)?;
        write_values(&mut map, self.fields())?;
        map.end()
    }
}

fn write_values<'a, M: SerializeMap>(
    map: &mut M,
    values: impl Iterator<Item = (&'static Field, &'a Value)>,
) -> Result<(), M::Error> {
    for (field, value) in values {
        match value {
            Value::Number(number) => map.serialize_entry(field.name, number)?,
            Value::Vector(numbers) => map.serialize_entry(field.name, numbers)?,
            Value::Switch(is_on) => map.serialize_entry(field.name, is_on)?,
            Value::Choice(word) => map.serialize_entry(field.name, word)?,
        }
    }
    Ok(())
}

impl<'de> Deserialize<'de> for Fractal {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(FractalVisitor)
    }
}

struct FractalVisitor;

impl<'de> Visitor<'de> for FractalVisitor {
    type Value = Fractal;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a fractal")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Fractal, A::Error> {
        let (mut named, mut iterations, mut bailout) = (None, None, None);
        let (mut loop_start, mut steps, mut section_planes) = (None, None, None);
        let mut values: Vec<(&'static Field, Value)> = Vec::new();
        loop {
            let Some(name) = map.next_key_seed(NameSeed { named })? else { break };
            match name {
                Name::Formula => once("formula", &mut named, map.next_value::<Named>()?)?,
                Name::Iterations => once("iterations", &mut iterations, map.next_value()?)?,
                Name::Bailout => once("bailout", &mut bailout, map.next_value()?)?,
                Name::SectionPlanes => {
                    let planes = map.next_value_seed(AtMost::new(MAX_SECTION_PLANES))?;
                    once("section_planes", &mut section_planes, planes)?;
                }
                Name::LoopStart => once("loop_start", &mut loop_start, map.next_value()?)?,
                Name::Steps => {
                    let list = map.next_value_seed(AtMost::<HybridStep>::new(MAX_STEPS))?;
                    once("steps", &mut steps, list)?;
                }
                Name::Own(field) => {
                    if values.iter().any(|(known, _)| known.name == field.name) {
                        return Err(A::Error::duplicate_field(field.name));
                    }
                    let is_certain = matches!(named, Some(Named::Formula(_)));
                    values.push((field, map.next_value_seed(ValueSeed { field, is_certain })?));
                }
            }
        }
        let mut fractal = match named {
            Some(Named::Hybrid) => {
                let steps = steps.ok_or_else(|| A::Error::missing_field("steps"))?;
                let hybrid = HybridSteps { steps, loop_start: loop_start.unwrap_or_default() };
                hybrid::fractal(hybrid).map_err(A::Error::custom)?
            }
            _ if steps.is_some() || loop_start.is_some() => {
                let message = "`steps` and `loop_start` need the formula `hybrid`";
                return Err(A::Error::custom(message));
            }
            Some(Named::Formula(formula)) => Fractal::new(formula),
            None => Fractal::default(),
        };
        fractal.iterations = iterations.unwrap_or(fractal.iterations);
        fractal.bailout = bailout.unwrap_or(fractal.bailout);
        fractal.section_planes = section_planes.unwrap_or_default();
        for (field, value) in values {
            let length = match &value {
                Value::Vector(numbers) => numbers.len(),
                _ => 1,
            };
            if !fractal.set(field.name, value) {
                // A formula that was named later may have a vector of another length.
                return Err(match fractal.get(field.name) {
                    Some(Value::Vector(own)) => A::Error::custom(format_args!(
                        "field `{}`: found a list of {length}, expected a list of {}",
                        field.name,
                        own.len()
                    )),
                    _ => unknown(field.name, names(fractal.formula()), fractal.hybrid().is_some()),
                });
            }
        }
        Ok(fractal)
    }
}

fn once<T, E: Error>(name: &'static str, place: &mut Option<T>, value: T) -> Result<(), E> {
    match place.replace(value) {
        None => Ok(()),
        Some(_) => Err(E::duplicate_field(name)),
    }
}

impl<'de> Deserialize<'de> for HybridStep {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(StepVisitor)
    }
}

struct StepVisitor;

impl<'de> Visitor<'de> for StepVisitor {
    type Value = HybridStep;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a step of a hybrid")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<HybridStep, A::Error> {
        let (mut step, mut repeats) = (None::<HybridStep>, None);
        let mut met: Vec<&'static str> = Vec::new();
        while let Some(name) = map.next_key_seed(StepNameSeed { step: step.as_ref() })? {
            match name {
                StepName::Formula => once("formula", &mut step, map.next_value_seed(StepSeed)?)?,
                StepName::Repeats => once("repeats", &mut repeats, map.next_value()?)?,
                StepName::Own(field) => {
                    if met.contains(&field.name) {
                        return Err(A::Error::duplicate_field(field.name));
                    }
                    met.push(field.name);
                    let value = map.next_value_seed(ValueSeed { field, is_certain: true })?;
                    if let Some(step) = &mut step {
                        step.set(field.name, value);
                    }
                }
            }
        }
        let mut step = step.ok_or_else(|| A::Error::missing_field("formula"))?;
        step.repeats = repeats.unwrap_or(step.repeats);
        Ok(step)
    }
}

/// A field's name in a step.
enum StepName {
    Formula,
    Repeats,
    Own(&'static Field),
}

/// Reads a name of a step whose formula may be known.
struct StepNameSeed<'a> {
    step: Option<&'a HybridStep>,
}

impl<'de> DeserializeSeed<'de> for StepNameSeed<'_> {
    type Value = StepName;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<StepName, D::Error> {
        let name = String::deserialize(deserializer)?;
        match (name.as_str(), self.step) {
            ("formula", _) => Ok(StepName::Formula),
            ("repeats", _) => Ok(StepName::Repeats),
            (_, None) => {
                let message =
                    format!("`{name}` stands before the step's `formula`: put that first");
                Err(D::Error::custom(message))
            }
            (_, Some(step)) => {
                if let Some((field, _)) = step.fields().find(|(field, _)| field.name == name) {
                    return Ok(StepName::Own(field));
                }
                let own = step.fields().map(|(field, _)| field.name);
                Err(unknown_of(&name, ["formula", "repeats"].into_iter().chain(own)))
            }
        }
    }
}

/// Reads a step's formula: an id or a text.
struct StepSeed;

impl<'de> DeserializeSeed<'de> for StepSeed {
    type Value = HybridStep;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<HybridStep, D::Error> {
        let formula = deserializer.deserialize_any(FormulaVisitor {
            all: || hybrid::step_formulas().collect(),
            other: None,
            read: own::of_text,
        })?;
        hybrid::step(formula).map_err(D::Error::custom)
    }
}

/// What a fractal's `formula` names.
#[derive(Clone, Copy)]
enum Named {
    Formula(FormulaRef),
    Hybrid,
}

impl<'de> Deserialize<'de> for Named {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(NamedVisitor)
    }
}

struct NamedVisitor;

impl<'de> Visitor<'de> for NamedVisitor {
    type Value = Named;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        FORMULA.expecting(f)
    }

    fn visit_str<E: Error>(self, id: &str) -> Result<Named, E> {
        if id == HYBRID { Ok(Named::Hybrid) } else { FORMULA.visit_str(id).map(Named::Formula) }
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Named, A::Error> {
        FORMULA.visit_map(map).map(Named::Formula)
    }
}

/// A field's name in the document.
enum Name {
    Formula,
    Iterations,
    Bailout,
    SectionPlanes,
    LoopStart,
    Steps,
    Own(&'static Field),
}

/// Reads a name, so that an unknown one is an error at its own path.
struct NameSeed {
    /// None before the document named the formula.
    named: Option<Named>,
}

impl<'de> DeserializeSeed<'de> for NameSeed {
    type Value = Name;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Name, D::Error> {
        Ok(match String::deserialize(deserializer)?.as_str() {
            "formula" => Name::Formula,
            "iterations" => Name::Iterations,
            "bailout" => Name::Bailout,
            "section_planes" => Name::SectionPlanes,
            "loop_start" => Name::LoopStart,
            "steps" => Name::Steps,
            name => Name::Own(field_called(name, self.named)?),
        })
    }
}

/// The field called `name` of the formula, or of the first formula with such a field.
///
/// A document may name a field before its formula. Formulas that share a field name also share the kind of
/// its values, but for the length of a vector; a test checks that.
fn field_called<E: Error>(name: &str, named: Option<Named>) -> Result<&'static Field, E> {
    let fields = |formula: FormulaRef| formula.fields().iter().find(|field| field.name == name);
    let found = match named {
        Some(Named::Formula(formula)) => fields(formula),
        _ => all().find_map(fields),
    };
    found.ok_or_else(|| match named {
        Some(Named::Hybrid) => unknown(name, JULIA.into_iter(), true),
        Some(Named::Formula(formula)) => unknown(name, names(formula), false),
        None => unknown(name, names(FormulaRef::default()), false),
    })
}

fn names(formula: FormulaRef) -> impl Iterator<Item = &'static str> {
    formula.fields().iter().map(|field| field.name)
}

fn unknown<E: Error>(name: &str, own: impl Iterator<Item = &'static str>, is_hybrid: bool) -> E {
    let of_hybrid = HYBRID_ONLY.into_iter().filter(|_| is_hybrid);
    unknown_of(name, SHARED.into_iter().chain(of_hybrid).chain(own))
}

fn unknown_of<E: Error>(name: &str, known: impl Iterator<Item = &'static str>) -> E {
    let names: Vec<_> = known.map(|name| format!("`{name}`")).collect();
    E::custom(format_args!("unknown field `{name}`, expected one of {}", names.join(", ")))
}

/// Reads the value of a field.
///
/// A value of the wrong kind is an error at the field's path.
struct ValueSeed {
    field: &'static Field,
    /// False before the document named the formula: a vector's length is then checked later.
    is_certain: bool,
}

impl<'de> DeserializeSeed<'de> for ValueSeed {
    type Value = Value;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Value, D::Error> {
        Ok(match self.field.kind {
            Kind::Number { .. } => Value::Number(f64::deserialize(deserializer)?),
            Kind::Switch { .. } => Value::Switch(bool::deserialize(deserializer)?),
            Kind::Choice { options, .. } => {
                Value::Choice(word_of(options, &String::deserialize(deserializer)?)?)
            }
            Kind::Vector { default, .. } => {
                // Before the formula is known, a vector of any formula may stand here.
                let numbers = AtMost::<f64>::new(MAX_PARAM_NUMBERS).deserialize(deserializer)?;
                if self.is_certain && numbers.len() != default.len() {
                    return Err(wrong_length(numbers.len(), default.len()));
                }
                Value::Vector(numbers.into())
            }
        })
    }
}

fn wrong_length<E: Error>(found: usize, wanted: usize) -> E {
    E::invalid_length(found, &format!("an array of length {wanted}").as_str())
}

fn word_of<E: Error>(options: &'static [Choice], word: &str) -> Result<&'static str, E> {
    let found = options.iter().find(|option| option.word == word);
    found.map(|option| option.word).ok_or_else(|| {
        let words: Vec<_> = options.iter().map(|option| format!("`{}`", option.word)).collect();
        E::custom(format_args!("unknown variant `{word}`, expected {}", words.join(" or ")))
    })
}

impl Serialize for FormulaRef {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self.text() {
            None => serializer.serialize_str(self.id()),
            Some(text) => {
                let mut map = serializer.serialize_map(Some(1))?;
                map.serialize_entry("text", text)?;
                map.end()
            }
        }
    }
}

impl<'de> Deserialize<'de> for FormulaRef {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(FORMULA)
    }
}

/// Reads a formula's id, or `{"text": "…"}`.
#[derive(Clone, Copy)]
struct FormulaVisitor {
    /// The formulas that an id may name.
    all: fn() -> Vec<FormulaRef>,
    /// A name that is allowed besides.
    other: Option<&'static str>,
    /// Reads a text.
    read: fn(&str) -> Result<FormulaRef, TextError>,
}

/// Reads a formula that draws alone.
const FORMULA: FormulaVisitor =
    FormulaVisitor { all: || all().collect(), other: Some(HYBRID), read: own::alone };

impl<'de> Visitor<'de> for FormulaVisitor {
    type Value = FormulaRef;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a formula's id or text")
    }

    fn visit_str<E: Error>(self, id: &str) -> Result<FormulaRef, E> {
        let all = (self.all)();
        all.iter().copied().find(|formula| formula.id() == id).ok_or_else(|| {
            let ids: Vec<_> =
                self.other.into_iter().chain(all.iter().map(|formula| formula.id())).collect();
            E::invalid_value(Unexpected::Str(id), &ids.join(" or ").as_str())
        })
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<FormulaRef, A::Error> {
        let mut found = None;
        while let Some(name) = map.next_key::<String>()? {
            if name != "text" {
                return Err(A::Error::unknown_field(&name, &["text"]));
            }
            once("text", &mut found, map.next_value::<String>()?)?;
        }
        let text = found.ok_or_else(|| A::Error::missing_field("text"))?;
        (self.read)(&text).map_err(A::Error::custom)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formula::language::TextFormula;

    #[test]
    fn no_parameter_takes_the_name_of_another_field() {
        for name in ["formula", "repeats"].into_iter().chain(SHARED).chain(HYBRID_ONLY).chain(JULIA)
        {
            let text = format!(
                "name \"x\"; about \"x\"; param {name} = 1 from 0 to 2 label \"X\"; step {{ z = z; }}"
            );
            let error = TextFormula::new("x", &text).expect_err(name);
            assert!(error.message.contains(name), "{error}");
        }
    }
}
