//! A formula's own parameters.
//!
//! One table gives their names in the document, their ranges, their controls and their documentation.

use super::param::Param;

/// One parameter of a formula.
#[derive(Clone, Copy, Debug)]
pub struct Field {
    /// The field's name in the document, below `fractal`.
    pub name: &'static str,
    /// The kind of values that the field takes.
    pub kind: Kind,
    /// The switch that shows the field in the panel while on; none if the field is always shown.
    pub only_with: Option<&'static str>,
}

/// The kind of values that a field takes, and its control in the panel.
#[derive(Clone, Copy, Debug)]
pub enum Kind {
    /// A number: a slider.
    Number {
        /// Its range, unit, default and help.
        param: &'static Param,
        /// Values that have a button.
        quick: &'static [f64],
    },
    /// Several numbers of one range: a slider each.
    Vector {
        /// Their range, unit and help.
        param: &'static Param,
        /// The sliders' labels.
        labels: &'static [&'static str],
        /// The values of a new scene, one per label.
        default: &'static [f64],
    },
    /// Off or on.
    Switch {
        /// Whether the switch is on in a new scene.
        default: bool,
        /// The switch's label in the panel.
        label: &'static str,
        /// The option of off, then that of on.
        options: [Choice; 2],
    },
    /// One of several words; a new scene has the first.
    Choice {
        /// The choice's label in the panel.
        label: &'static str,
        /// The options.
        options: &'static [Choice],
    },
}

/// One option of a choice.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Choice {
    /// The word in the document; for a switch `false` or `true`, which the document stores as a boolean.
    pub word: &'static str,
    /// The option's label in the panel.
    pub label: &'static str,
    /// What the option does to the picture.
    pub help: &'static str,
}

impl Field {
    /// The range of a number or vector; none for switches and choices.
    pub fn param(&self) -> Option<&'static Param> {
        match self.kind {
            Kind::Number { param, .. } | Kind::Vector { param, .. } => Some(param),
            Kind::Switch { .. } | Kind::Choice { .. } => None,
        }
    }

    /// The field's value in a new scene.
    pub fn default(&self) -> Value {
        match self.kind {
            Kind::Number { param, .. } => Value::Number(param.default),
            Kind::Vector { default, .. } => Value::Vector(default.into()),
            Kind::Switch { default, .. } => Value::Switch(default),
            Kind::Choice { options, .. } => Value::Choice(options[0].word),
        }
    }
}

/// The value of a field.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A value of [`Kind::Number`].
    Number(f64),
    /// A value of [`Kind::Vector`].
    Vector(Box<[f64]>),
    /// A value of [`Kind::Switch`].
    Switch(bool),
    /// A value of [`Kind::Choice`]: the option's word.
    Choice(&'static str),
}

impl From<f64> for Value {
    fn from(number: f64) -> Self {
        Self::Number(number)
    }
}

impl From<bool> for Value {
    fn from(is_on: bool) -> Self {
        Self::Switch(is_on)
    }
}

impl From<&'static str> for Value {
    fn from(word: &'static str) -> Self {
        Self::Choice(word)
    }
}

impl<const N: usize> From<[f64; N]> for Value {
    fn from(numbers: [f64; N]) -> Self {
        Self::Vector(numbers.into())
    }
}

impl Value {
    /// Whether the value has the kind and length of `field`; the range is not checked.
    pub fn fits(&self, field: &Field) -> bool {
        match (self, field.kind) {
            (Self::Number(_), Kind::Number { .. }) | (Self::Switch(_), Kind::Switch { .. }) => true,
            (Self::Vector(numbers), Kind::Vector { default, .. }) => numbers.len() == default.len(),
            (Self::Choice(word), Kind::Choice { options, .. }) => {
                options.iter().any(|option| option.word == *word)
            }
            _ => false,
        }
    }
}
