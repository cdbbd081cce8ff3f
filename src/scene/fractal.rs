//! The set that is drawn: the Mandelbulb and its Julia form (thesis 2.5, Algorithm 1).

use serde::{Deserialize, Serialize};

use super::param;

/// Which sign the sine of the latitude takes in the triplex power.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Variant {
    /// `+ sin nφ`, as in the thesis's Algorithm 1.
    #[default]
    PositiveSine,
    /// `− sin nφ`, as its equation 2.3 is printed: another set.
    NegativeSine,
}

impl Variant {
    /// What the sine is multiplied by: 1 or −1.
    pub fn sine_sign(self) -> f64 {
        match self {
            Self::PositiveSine => 1.0,
            Self::NegativeSine => -1.0,
        }
    }
}

/// A Mandelbulb or the Julia form of one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Fractal {
    /// Exponent n, any real in [`param::POWER`].
    pub power: f64,
    /// Most orbit steps in a view of the whole, in [`param::ITERATIONS`]; finer views add what they need.
    pub iterations: u32,
    /// Escape radius in scene units, in [`param::BAILOUT`] and at most [`Fractal::max_bailout`].
    pub bailout: f64,
    /// Sign of the sine term.
    pub variant: Variant,
    /// True for the Julia form: orbits start at the point and add [`Self::julia_constant`].
    pub julia: bool,
    /// The Julia form's constant, each coordinate in [`param::JULIA_CONSTANT`]; kept while the form is off.
    pub julia_constant: [f64; 3],
}

impl Default for Fractal {
    fn default() -> Self {
        Self {
            power: param::POWER.default,
            iterations: param::ITERATIONS.default as u32,
            bailout: param::BAILOUT.default,
            variant: Variant::default(),
            julia: false,
            julia_constant: [0.35, -0.4, 0.55],
        }
    }
}

impl Fractal {
    /// The largest bailout whose square still fits an f32 after one more step at this power:
    /// `(1.8e19)^(1/n)`, and never above [`param::BAILOUT`]'s range.
    pub fn max_bailout(&self) -> f64 {
        1.8e19_f64.powf(1.0 / self.power).min(param::BAILOUT.max)
    }

    /// The power as a whole number where it is one.
    pub fn integer_power(&self) -> Option<u32> {
        (self.power.fract() == 0.0).then_some(self.power as u32)
    }
}
