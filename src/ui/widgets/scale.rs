//! Mapping of a parameter's range to a slider's rail, rounding and formatting of values.
//!
//! In: a [`Param`] and numbers. Out: numbers and text. This module does not depend on egui.

use crate::scene::param::{Param, Scale};

/// Limit below which values of a logarithmic range are formatted with an exponent.
const TINY: f64 = 1e-5;

/// True if equal lengths of the rail are equal ratios.
pub fn is_logarithmic(param: &Param) -> bool {
    match param.scale {
        Scale::Linear => false,
        Scale::Logarithmic => true,
        Scale::Integer => param.min >= 1.0 && param.max / param.min > 100.0,
    }
}

/// Position of `value` on the rail, 0 to 1.
///
/// A logarithmic range that starts at 0 is approximately linear below its step.
pub fn fraction(param: &Param, value: f64) -> f64 {
    let value = value.clamp(param.min, param.max);
    let fraction = if !is_logarithmic(param) {
        (value - param.min) / (param.max - param.min)
    } else if param.min > 0.0 {
        (value / param.min).ln() / (param.max / param.min).ln()
    } else {
        (value / param.step).ln_1p() / (param.max / param.step).ln_1p()
    };
    fraction.clamp(0.0, 1.0)
}

/// The value at a position of the rail: the inverse of [`fraction`].
pub fn at_fraction(param: &Param, fraction: f64) -> f64 {
    if !is_logarithmic(param) {
        param.min + fraction * (param.max - param.min)
    } else if param.min > 0.0 {
        param.min * (param.max / param.min).powf(fraction)
    } else {
        param.step * ((param.max / param.step).ln_1p() * fraction).exp_m1()
    }
}

/// `value` clamped to the range and rounded to the precision of a drag.
///
/// Linear ranges round to a multiple of the step, logarithmic ranges to three significant digits.
pub fn round_dragged(param: &Param, value: f64) -> f64 {
    let rounded = match param.scale {
        Scale::Integer => value.round(),
        Scale::Linear => {
            round_to_decimals((value / param.step).round() * param.step, decimals(param.step))
        }
        Scale::Logarithmic => round_to_decimals(value, significant_decimals(value)),
    };
    rounded.clamp(param.min, param.max)
}

/// A typed value, clamped to the range; only integer ranges are rounded.
pub fn clamp_typed(param: &Param, value: f64) -> f64 {
    let value = if param.scale == Scale::Integer { value.round() } else { value };
    value.clamp(param.min, param.max)
}

/// The value as text, without its unit.
pub fn format_value(param: &Param, value: f64) -> String {
    if param.scale == Scale::Logarithmic && value != 0.0 && value.abs() < TINY {
        return format!("{value:.2e}");
    }
    let places = match param.scale {
        Scale::Integer => 0,
        Scale::Linear => decimals(param.step).max(needed_decimals(value)),
        Scale::Logarithmic => significant_decimals(value),
    };
    let text = format!("{value:.places$}");
    if param.scale == Scale::Logarithmic && text.contains('.') {
        return text.trim_end_matches('0').trim_end_matches('.').to_owned();
    }
    text
}

/// Number of decimal places of a step such as 0.05.
fn decimals(step: f64) -> usize {
    (0..6)
        .find(|&places| {
            (step * 10f64.powi(places) - (step * 10f64.powi(places)).round()).abs() < 1e-9
        })
        .unwrap_or(6) as usize
}

/// Number of decimal places of `value`, at most four.
fn needed_decimals(value: f64) -> usize {
    decimals(value).min(4)
}

/// Number of decimal places for three significant digits.
fn significant_decimals(value: f64) -> usize {
    if value == 0.0 || !value.is_finite() {
        return 0;
    }
    (2.0 - value.abs().log10().floor()).clamp(0.0, 8.0) as usize
}

fn round_to_decimals(value: f64, places: usize) -> f64 {
    let scale = 10f64.powi(places as i32);
    (value * scale).round() / scale
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formula::mandelbulb;
    use crate::scene::param;

    #[test]
    fn rail_positions_and_values_are_inverse_and_increasing() {
        for param in param::all() {
            assert_eq!(fraction(param, param.min), 0.0, "{}", param.path);
            assert_eq!(fraction(param, param.max), 1.0, "{}", param.path);
            let mut last = f64::NEG_INFINITY;
            for i in 0..=100 {
                let f = f64::from(i) / 100.0;
                let value = at_fraction(param, f);
                assert!(value > last, "{}: values increase along the rail", param.path);
                assert!((fraction(param, value) - f).abs() < 1e-9, "{}", param.path);
                last = value;
            }
        }
    }

    #[test]
    fn rounded_values_are_accepted() {
        for param in param::all() {
            for i in 0..=1000 {
                let value = round_dragged(param, at_fraction(param, f64::from(i) / 1000.0));
                assert!(param.accepts(value), "{}: {value}", param.path);
            }
            assert!(
                param.accepts(round_dragged(param, 1e300))
                    && param.accepts(round_dragged(param, -1e300)),
                "{}",
                param.path
            );
        }
    }

    #[test]
    fn defaults_can_be_reached_by_dragging() {
        // A vector's slider has the default of its component, which its parameter does not tell.
        for param in param::all().filter(|param| !param.path.ends_with("[]")) {
            assert_eq!(round_dragged(param, param.default), param.default, "{}", param.path);
        }
    }

    #[test]
    fn the_intensity_one_is_near_the_middle_of_the_rail() {
        let one = fraction(&param::ENVIRONMENT_INTENSITY, 1.0);
        assert!((0.25..0.6).contains(&one), "1 is at {one} of the rail");
    }

    #[test]
    fn values_are_formatted_without_trailing_digits() {
        assert_eq!(format_value(&mandelbulb::POWER, 8.0), "8.0");
        assert_eq!(format_value(&mandelbulb::POWER, 2.25), "2.25");
        assert_eq!(format_value(&param::SAMPLES, 16.0), "16");
        assert_eq!(format_value(&param::SHADOW_REACH, 0.0123456), "0.0123");
        assert_eq!(format_value(&param::ENVIRONMENT_INTENSITY, 2.6), "2.6");
        assert_eq!(format_value(&param::POINT_INTENSITY, 2.5e-41), "2.50e-41");
        assert_eq!(format_value(&param::POINT_INTENSITY, 0.0), "0");
        assert_eq!(round_dragged(&mandelbulb::POWER, 2.299_999_9), 2.3);
    }
}
