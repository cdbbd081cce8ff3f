//! How many iterations views need.

use crate::formula::mandelbulb::parameters::Mandelbulb;

/// Finest pixel radius at the nearest surface, in scene units: smaller ones exceed f32's exponents.
pub use crate::formula::march::DEEP_FOOTPRINT as FINEST_FOOTPRINT;

/// Least footprint that needs no more than the scene's own iterations, in scene units.
pub const WHOLE_FOOTPRINT: f64 = 1e-3;

/// Iterations of a view whose pixels have radius `footprint` at the nearest surface.
///
/// `footprint` is in scene units. The result is the scene's own iterations plus those that orbits of
/// points a footprint apart need to separate.
pub fn iterations_for(fractal: &Mandelbulb, footprint: f64) -> u32 {
    let finer = (WHOLE_FOOTPRINT / footprint.max(0.1 * FINEST_FOOTPRINT)).max(1.0).ln();
    let more = (steps_per_power(fractal.power) * finer / fractal.power.ln()).ceil();
    fractal.iterations + more as u32
}

/// Steps in which the distance between two orbits grows by the factor `power`.
///
/// Where r < 1 it grows by less in one step. Measured on lines toward the surface, down to 10⁻³²: 99 of
/// 100 points take no more steps.
fn steps_per_power(power: f64) -> f64 {
    1.2 + 3.0 / power
}
