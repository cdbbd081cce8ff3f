//! A fractal in the scene document: `formula`, the shared fields and the formula's own fields.
//!
//! Fields may have any order, but for those of a formula that the document brings as a text: they follow it. A missing field takes the formula's default; a document without `formula`,
//! such as one of version 1, means the Mandelbulb.

use std::fmt;

use serde::{
    Deserialize, Deserializer, Serialize, Serializer,
    de::{DeserializeSeed, Error, MapAccess, Unexpected, Visitor},
    ser::SerializeMap,
};

use super::{
    FormulaRef, Fractal, all, find, own,
    table::{Choice, Field, Kind, Value},
};

/// Fields of every formula.
const SHARED: [&str; 3] = ["formula", "iterations", "bailout"];

impl Serialize for Fractal {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("formula", &self.formula())?;
        map.serialize_entry("iterations", &self.iterations)?;
        map.serialize_entry("bailout", &self.bailout)?;
        for (field, value) in self.fields() {
            match value {
                Value::Number(number) => map.serialize_entry(field.name, number)?,
                Value::Vector(numbers) => map.serialize_entry(field.name, numbers)?,
                Value::Switch(is_on) => map.serialize_entry(field.name, is_on)?,
                Value::Choice(word) => map.serialize_entry(field.name, word)?,
            }
        }
        map.end()
    }
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
        let (mut formula, mut iterations, mut bailout) = (None, None, None);
        let mut values: Vec<(&'static Field, Value)> = Vec::new();
        while let Some(name) = map.next_key_seed(NameSeed { formula })? {
            match name {
                Name::Formula => once("formula", &mut formula, map.next_value::<FormulaRef>()?)?,
                Name::Iterations => once("iterations", &mut iterations, map.next_value()?)?,
                Name::Bailout => once("bailout", &mut bailout, map.next_value()?)?,
                Name::Own(field) => {
                    if values.iter().any(|(known, _)| known.name == field.name) {
                        return Err(A::Error::duplicate_field(field.name));
                    }
                    let is_certain = formula.is_some();
                    values.push((field, map.next_value_seed(ValueSeed { field, is_certain })?));
                }
            }
        }
        let mut fractal = formula.map_or_else(Fractal::default, Fractal::new);
        fractal.iterations = iterations.unwrap_or(fractal.iterations);
        fractal.bailout = bailout.unwrap_or(fractal.bailout);
        for (field, value) in values {
            let length = match &value {
                Value::Vector(numbers) => numbers.len(),
                _ => 1,
            };
            if !fractal.set(field.name, value) {
                // A formula that was named later may have a vector of another length.
                return Err(match fractal.get(field.name) {
                    Some(Value::Vector(own)) => A::Error::custom(format_args!(
                        "field `{}`: invalid length {length}, expected an array of length {}",
                        field.name,
                        own.len()
                    )),
                    _ => unknown(field.name, fractal.formula()),
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

/// A field's name in the document.
enum Name {
    Formula,
    Iterations,
    Bailout,
    Own(&'static Field),
}

/// Reads a name, so that an unknown one is an error at its own path.
struct NameSeed {
    /// None before the document named the formula.
    formula: Option<FormulaRef>,
}

impl<'de> DeserializeSeed<'de> for NameSeed {
    type Value = Name;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Name, D::Error> {
        Ok(match String::deserialize(deserializer)?.as_str() {
            "formula" => Name::Formula,
            "iterations" => Name::Iterations,
            "bailout" => Name::Bailout,
            name => Name::Own(field_called(name, self.formula)?),
        })
    }
}

/// The field called `name` of `formula`, or of the first formula with such a field.
///
/// A document may name a field before its formula. Formulas that share a field name also share the kind of
/// its values, but for the length of a vector; a test checks that.
fn field_called<E: Error>(name: &str, formula: Option<FormulaRef>) -> Result<&'static Field, E> {
    let fields = |formula: FormulaRef| formula.fields().iter().find(|field| field.name == name);
    let found = match formula {
        Some(formula) => fields(formula),
        None => all().find_map(fields),
    };
    found.ok_or_else(|| unknown(name, formula.unwrap_or_default()))
}

fn unknown<E: Error>(name: &str, formula: FormulaRef) -> E {
    let own = formula.fields().iter().map(|field| field.name);
    let names: Vec<_> = SHARED.into_iter().chain(own).map(|name| format!("`{name}`")).collect();
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
                let numbers = Vec::<f64>::deserialize(deserializer)?;
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
        deserializer.deserialize_any(FormulaVisitor)
    }
}

/// Reads a formula's id, or `{"text": "…"}`.
struct FormulaVisitor;

impl<'de> Visitor<'de> for FormulaVisitor {
    type Value = FormulaRef;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a formula's id or text")
    }

    fn visit_str<E: Error>(self, id: &str) -> Result<FormulaRef, E> {
        find(id).ok_or_else(|| {
            let ids: Vec<_> = all().map(|formula| formula.id()).collect();
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
        own::of_text(&text).map_err(A::Error::custom)
    }
}
