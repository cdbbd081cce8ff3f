//! Kernel variants: selects the WGSL files and overrides that draw a view.

use super::parameters::{HIT_CHECK_BELOW, Mandelbulb};
use crate::{formula::KernelFiles, gpu::shader::File};

/// Most steps that all orbits near the anchor take together.
pub const MAX_NEAR_STEPS: usize = 8;

/// Files of every variant.
const SHARED: [File; 3] = [
    File { path: "mandelbulb/power", text: include_str!("power.wgsl") },
    File { path: "mandelbulb/orbit", text: include_str!("orbit.wgsl") },
    File { path: "mandelbulb/types", text: include_str!("types.wgsl") },
];
const DERIVATIVES: File =
    File { path: "mandelbulb/derivatives", text: include_str!("derivatives.wgsl") };
const DIFFERENCE: File =
    File { path: "mandelbulb/difference", text: include_str!("difference.wgsl") };
const PLAIN: File = File { path: "mandelbulb/plain", text: include_str!("plain.wgsl") };
const PERTURBED: File = File { path: "mandelbulb/perturbed", text: include_str!("perturbed.wgsl") };
const SERIES: File = File { path: "mandelbulb/series", text: include_str!("series.wgsl") };
const ROTATING_FRAME: File =
    File { path: "mandelbulb/rotating_frame", text: include_str!("rotating_frame.wgsl") };

/// What the pipelines of rays and normals are specialised for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Variant {
    /// The power if whole; 0 for other powers and for kernels of any power.
    pub power: u32,
    /// How the kernels follow orbits.
    pub steps: Steps,
}

/// How kernels follow orbits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Steps {
    /// In plain f32 about the scene's origin.
    Plain,
    /// By the difference to the reference orbit, as long as f32 needs the difference.
    Perturbed(NearSteps),
    /// In frames that rotate with a point's longitude: even powers, an anchor close to the polar axis.
    RotatingFrame,
}

/// Perturbed steps that all orbits near the anchor take together before plain f32 steps.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct NearSteps {
    /// Number of near steps, up to [`MAX_NEAR_STEPS`].
    ///
    /// 0 if each orbit decides by itself how many steps it follows the difference.
    pub count: u32,
    /// Whether a series approximation replaces the steps before them; else the near steps come first.
    pub has_series: bool,
}

/// The near steps that a dive passes through, from the top down.
const DIVE: [NearSteps; 4] = [
    NearSteps { count: 1, has_series: false },
    NearSteps { count: 2, has_series: false },
    NearSteps { count: 2, has_series: true },
    NearSteps { count: 4, has_series: true },
];

/// Number of different [`Steps`]: plain, rotating frame, then perturbed by count and series.
const STEPS: u32 = 2 * (MAX_NEAR_STEPS as u32 + 1) + 2;

impl Variant {
    /// A unique number for each variant.
    pub fn number(self) -> u32 {
        let steps = match self.steps {
            Steps::Plain => 0,
            Steps::RotatingFrame => 1,
            Steps::Perturbed(NearSteps { count, has_series }) => {
                2 + 2 * count + u32::from(has_series)
            }
        };
        self.power * STEPS + steps
    }

    /// The variant with this [number](Self::number).
    pub fn from_number(number: u32) -> Self {
        let steps = match number % STEPS {
            0 => Steps::Plain,
            1 => Steps::RotatingFrame,
            n => Steps::Perturbed(NearSteps { count: (n - 2) / 2, has_series: n % 2 == 1 }),
        };
        Self { power: number / STEPS, steps }
    }

    /// The variants that a dive passes through, from the top down; none for powers without depth.
    pub fn of_dive(mandelbulb: &Mandelbulb) -> impl Iterator<Item = Self> {
        let power = mandelbulb.integer_power();
        DIVE.into_iter()
            .filter_map(move |near| Some(Self { power: power?, steps: Steps::Perturbed(near) }))
    }

    /// The general variant, which draws the same for any power; none for deep variants.
    pub fn general(self) -> Option<Self> {
        (!self.is_deep()).then_some(Self { power: 0, ..self })
    }

    /// Whether the variant draws deep views, about an anchor.
    pub fn is_deep(self) -> bool {
        self.steps != Steps::Plain
    }

    /// Whether a ray's step comes from its orbit's Jacobian at one point.
    ///
    /// The other variants bound the step by a product of norms, which holds in every direction, except at seams.
    pub fn has_jacobian_steps(self) -> bool {
        match self.steps {
            Steps::Plain => false,
            // The product of bounds grows too large over the many steps of these orbits.
            Steps::Perturbed(NearSteps { count, has_series }) => has_series || count == 0,
            Steps::RotatingFrame => true,
        }
    }

    /// The overrides that specialize the variant's kernels.
    pub fn overrides(self) -> Vec<(&'static str, f64)> {
        let mut overrides = Vec::new();
        if self.power > 0 {
            let power = f64::from(self.power);
            overrides.push(("POWER", power));
            overrides.push(("CHECKS_HITS", f64::from(power < HIT_CHECK_BELOW)));
        }
        if let Steps::Perturbed(NearSteps { count, has_series }) = self.steps {
            overrides.push(("NEAR_STEPS", f64::from(count)));
            overrides.push(("HAS_SERIES", f64::from(has_series)));
            overrides.push(("FOLLOWS_DIRECTION", f64::from(self.has_jacobian_steps())));
        }
        overrides
    }

    /// What the variant draws, as a phrase that follows "Preparing".
    pub fn describe(self) -> String {
        match (self.is_deep(), self.power) {
            (true, _) => "the deep zoom".to_owned(),
            (false, 0) => "powers".to_owned(),
            (false, power) => format!("power {power}"),
        }
    }

    /// The WGSL files of the variant's kernels.
    pub fn files(self) -> KernelFiles {
        let [power, orbit, types] = SHARED;
        let steps: &[File] = match self.steps {
            Steps::Plain => &[DERIVATIVES, PLAIN],
            Steps::Perturbed(_) => &[DERIVATIVES, DIFFERENCE, SERIES, PERTURBED],
            Steps::RotatingFrame => &[DIFFERENCE, ROTATING_FRAME],
        };
        KernelFiles { types, files: [&[power, orbit], steps].concat() }
    }
}

impl std::fmt::Display for Variant {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "power {}, ", self.power)?;
        match self.steps {
            Steps::Plain => write!(f, "plain"),
            Steps::Perturbed(NearSteps { count, has_series: false }) => write!(f, "{count} near"),
            Steps::Perturbed(NearSteps { count, has_series: true }) => {
                write!(f, "series, {count} near")
            }
            Steps::RotatingFrame => write!(f, "rotating frame"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_variant_has_a_number_of_its_own() {
        for number in 0..17 * STEPS {
            assert_eq!(Variant::from_number(number).number(), number);
        }
    }
}
