//! The Mandelbulb's parameters: their table, and their values as a type.

use crate::formula::{
    FormulaRef, Fractal, MarchPolicy, StepLimits,
    param::{self, params},
    table::{Choice, Field, Kind, Value},
};

params! {
    /// The Mandelbulb's own numbers.
    PARAMS;
    POWER = "fractal.power", "Power", None, 2.0, 16.0, default 8.0, Linear by 0.1,
        "The exponent n of z → zⁿ + c. Whole numbers are fastest; higher gives more and smaller lobes.";
    JULIA_CONSTANT = "fractal.julia_constant[]", "Julia constant", SceneUnits, -2.0, 2.0, default 0.0, Linear by 0.01,
        "One coordinate of the Julia constant c. Changes the shape of the fractal.";
}

/// The estimate of lower powers has false minima: see [`super::estimator`].
pub const HIT_CHECK_BELOW: f64 = 4.0;

/// Limits of steps that come from an orbit's Jacobian at one point.
///
/// The Jacobian changes within a step, so that a cone of the whole step passes surfaces.
pub const STEP_LIMITS: StepLimits = StepLimits { ball_part: 0.55, ball_growth: 2.0 };

/// In document order, which [`Mandelbulb::of`] and the conversion back follow.
pub const FIELDS: &[Field] = &[
    Field {
        name: "power",
        kind: Kind::Number {
            param: &POWER,
            // Whole powers avoid trigonometry.
            quick: &[2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0],
        },
        only_with: None,
    },
    Field {
        name: "variant",
        kind: Kind::Choice {
            label: "Sine of the latitude",
            options: &[
                Choice {
                    word: "positive_sine",
                    label: "Positive",
                    help: "The bulb that everyone knows: + sin in the height",
                },
                Choice {
                    word: "negative_sine",
                    label: "Negative",
                    help: "The sign as one printed formula has it: − sin, another set",
                },
            ],
        },
        only_with: None,
    },
    Field {
        name: "julia",
        kind: Kind::Switch {
            default: false,
            label: "Form",
            options: [
                Choice {
                    word: "false",
                    label: "Mandelbulb",
                    help: "Each point adds itself at every step",
                },
                Choice {
                    word: "true",
                    label: "Julia",
                    help: "All points add the same constant at every step",
                },
            ],
        },
        only_with: None,
    },
    Field {
        name: "julia_constant",
        kind: Kind::Vector {
            param: &JULIA_CONSTANT,
            labels: &["Constant x", "Constant y", "Constant z"],
            default: &[0.35, -0.4, 0.55],
        },
        only_with: Some("julia"),
    },
];

/// Sign of the sine of the latitude in the triplex power.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Sine {
    /// `+ sin nφ`, as in the thesis's Algorithm 1.
    #[default]
    Positive,
    /// `− sin nφ`, as the thesis prints equation 2.3: another set.
    Negative,
}

impl Sine {
    /// The factor of the sine: 1 or −1.
    pub fn sign(self) -> f64 {
        match self {
            Self::Positive => 1.0,
            Self::Negative => -1.0,
        }
    }

    fn word(self) -> &'static str {
        match self {
            Self::Positive => "positive_sine",
            Self::Negative => "negative_sine",
        }
    }
}

/// A Mandelbulb or its Julia form, with typed parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct Mandelbulb {
    /// Exponent n, any real in [`POWER`].
    pub power: f64,
    /// Most orbit steps.
    pub iterations: u32,
    /// Escape radius in scene units, at most [`Mandelbulb::max_bailout`].
    pub bailout: f64,
    /// Sign of the sine term.
    pub sine: Sine,
    /// True for the Julia form: orbits start at the point and add [`Self::julia_constant`].
    pub julia: bool,
    /// The Julia form's constant, each coordinate in [`JULIA_CONSTANT`]; kept while the form is Mandelbulb.
    pub julia_constant: [f64; 3],
}

impl Default for Mandelbulb {
    fn default() -> Self {
        Self::of(&Fractal::new(FormulaRef(&MANDELBULB)))
    }
}

impl From<Mandelbulb> for Fractal {
    fn from(mandelbulb: Mandelbulb) -> Self {
        let Mandelbulb { power, iterations, bailout, sine, julia, julia_constant } = mandelbulb;
        let mut fractal = Self::new(FormulaRef(&MANDELBULB));
        (fractal.iterations, fractal.bailout) = (iterations, bailout);
        let values: [Value; 4] =
            [power.into(), sine.word().into(), julia.into(), julia_constant.into()];
        for ((_, place), value) in fractal.fields_mut().zip(values) {
            *place = value;
        }
        fractal
    }
}

impl Mandelbulb {
    /// The typed parameters of `fractal`.
    ///
    /// # Panics
    ///
    /// If `fractal` is of another formula.
    pub fn of(fractal: &Fractal) -> Self {
        let [
            Value::Number(power),
            Value::Choice(word),
            Value::Switch(julia),
            Value::Vector(constant),
        ] = fractal.values()
        else {
            panic!("a Mandelbulb has other values than a {:?}", fractal.formula());
        };
        let sine = if *word == Sine::Negative.word() { Sine::Negative } else { Sine::Positive };
        Self {
            power: *power,
            iterations: fractal.iterations,
            bailout: fractal.bailout,
            sine,
            julia: *julia,
            julia_constant: std::array::from_fn(|i| constant[i]),
        }
    }

    /// The largest bailout whose square still fits an f32 after one more step: `(1.8e19)^(1/n)`.
    pub fn max_bailout(&self) -> f64 {
        1.8e19_f64.powf(1.0 / self.power).min(param::BAILOUT.max)
    }

    /// The power if it is a whole number.
    pub fn integer_power(&self) -> Option<u32> {
        (self.power.fract() == 0.0).then_some(self.power as u32)
    }

    /// How rays march.
    pub(super) fn march_policy(&self) -> MarchPolicy {
        let power = self.power as f32;
        // At low powers the estimate is small even far from false minima, and balls are less reliable. At
        // power 2 longer steps pass a fold on one ray in a hundred, and steps of 2 hit distances (0.5 at
        // power 3) may pass a blocker of a shadow ray.
        let low = (4.0 - power).clamp(0.0, 1.0);
        let usual = MarchPolicy::default();
        let mix = |usual: f32, at_low: f32| usual * (1.0 - low) + at_low * low;
        let relaxed = (0.5 * power - 1.0).clamp(0.0, 1.0);
        let (most_relaxation, ball_part) = match self.integer_power() {
            Some(_) => (usual.relaxation, (0.25 * power - 0.5).clamp(0.7, usual.ball_part)),
            // Their seams leave thin sheets, which over-relaxed steps pass. A cone has no direction, so that the stretch
            // along a ray does not limit its steps: they may be over twice as long as the way.
            None => (1.0, 0.4),
        };
        MarchPolicy {
            relaxation: (1.0 - relaxed) + most_relaxation * relaxed,
            ball_part,
            checks_hits: self.power < HIT_CHECK_BELOW,
            sphere_holds_set: true,
            shadow_cone: mix(usual.shadow_cone, 0.5 * usual.shadow_cone),
            shadow_margin: mix(usual.shadow_margin, 0.15),
            shadow_min_step: (5.0 - 1.5 * power).clamp(0.0, 2.0),
        }
    }
}

/// The formula.
#[derive(Debug)]
pub struct MandelbulbFormula;

/// The formula.
pub static MANDELBULB: MandelbulbFormula = MandelbulbFormula;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mandelbulb_stays_the_same_as_a_fractal() {
        let bulb = Mandelbulb {
            power: 3.5,
            iterations: 7,
            bailout: 3.0,
            sine: Sine::Negative,
            julia: true,
            julia_constant: [0.1, 0.2, 0.3],
        };
        assert_eq!(Mandelbulb::of(&bulb.clone().into()), bulb);
        assert_eq!(Fractal::from(Mandelbulb::default()), Fractal::default());
    }

    #[test]
    fn every_word_and_parameter_is_in_the_table() {
        let Kind::Choice { options, .. } = FIELDS[1].kind else { panic!("the sine is a choice") };
        let words: Vec<_> = options.iter().map(|option| option.word).collect();
        assert_eq!(words, [Sine::Positive.word(), Sine::Negative.word()]);
        let in_table: Vec<_> = FIELDS.iter().filter_map(Field::param).collect();
        assert_eq!(in_table, PARAMS);
    }

    #[test]
    fn high_powers_march_by_the_usual_policy() {
        for power in [4.0, 8.0, 16.0] {
            let policy = Mandelbulb { power, ..Default::default() }.march_policy();
            let usual = MarchPolicy { sphere_holds_set: true, ..Default::default() };
            assert_eq!(policy, MarchPolicy { ball_part: policy.ball_part, ..usual });
        }
    }

    #[test]
    fn powers_that_are_not_whole_take_plain_steps_and_small_balls() {
        let policy = |power| {
            let MarchPolicy { relaxation, ball_part, .. } =
                Mandelbulb { power, ..Default::default() }.march_policy();
            (relaxation, ball_part)
        };
        let usual = MarchPolicy::default();
        assert_eq!(policy(10.07), (1.0, 0.4));
        assert_eq!(policy(10.0), (usual.relaxation, usual.ball_part));
        assert_eq!(policy(2.0), (1.0, 0.7));
    }
}
