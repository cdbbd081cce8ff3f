//! Exact positions at any zoom: decimal numbers of up to 90 digits (299 bits).
//!
//! An f64 resolves 1e-16 of a scene unit, too coarse for a zoom of 1e-27. A position is stored
//! as the decimal number that the document contains, so saving does not move the eye. Differences
//! of positions are small and are rounded to f64.

use std::{fmt, ops::Sub, str::FromStr};

use dashu_float::{DBig, FBig, round::mode};
use glam::DVec3;
use serde::{Deserialize, Deserializer, Serialize, Serializer, de};

/// Maximum number of significant digits.
pub const MAX_DIGITS: usize = 90;
/// Largest magnitude of a coordinate, in scene units.
pub const MAX_COORDINATE: f64 = 100.0;
/// Maximum length of a coordinate's text, in bytes.
const MAX_TEXT_BYTES: usize = 120;
/// The last stored decimal place: 10^−80.
const LAST_PLACE: isize = -80;

/// One exact coordinate, in scene units.
#[derive(Clone, Debug, PartialEq)]
pub struct Precise(DBig);

/// Why a text is not a valid coordinate.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ParsePreciseError {
    /// Not a decimal number.
    #[error("is not a decimal number such as \"-0.125\"")]
    NotANumber,
    /// Too many characters or digits.
    #[error("has more than {MAX_DIGITS} digits")]
    TooLong,
    /// Magnitude above [`MAX_COORDINATE`].
    #[error("is farther than {MAX_COORDINATE} scene units from the origin")]
    TooFar,
}

impl Precise {
    /// The nearest f64.
    pub fn to_f64(&self) -> f64 {
        nearest_f64(&self.0)
    }

    /// The value rounded toward zero to a binary number of `bits` bits.
    pub fn to_binary(&self, bits: usize) -> FBig<mode::Zero, 2> {
        let number = self.0.clone().with_rounding::<mode::Zero>();
        number.with_base_and_precision::<2>(bits).value()
    }

    /// `self + delta`, rounded to a decimal place no coarser than `grain`.
    ///
    /// `delta` and `grain` are in scene units. Rounding drops digits too small to be visible. The
    /// result is clamped to [`MAX_COORDINATE`].
    pub fn moved_by(&self, delta: f64, grain: f64) -> Self {
        let sum = Self(&self.0 + decimal(delta).0);
        if sum.to_f64().abs() >= MAX_COORDINATE {
            return decimal(MAX_COORDINATE.copysign(sum.to_f64()));
        }
        let place = if grain > 0.0 { grain.log10().floor() as isize } else { LAST_PLACE };
        Self(rounded_to_place(sum.0, place.max(LAST_PLACE)))
    }
}

/// The nearest f64, converted through decimal text.
///
/// About 100 times faster than the crate's own conversion, which divides long numbers.
fn nearest_f64(value: &DBig) -> f64 {
    let repr = value.repr();
    // An integer with an exponent always parses.
    format!("{}e{}", repr.significand(), repr.exponent()).parse().unwrap_or(0.0)
}

/// The shortest decimal that parses to `value`; zero for NaN and infinities.
fn decimal(value: f64) -> Precise {
    let value = if value.is_finite() { value } else { 0.0 };
    // Every finite f64 prints as a decimal number, so the parse cannot fail.
    Precise(rounded_to_place(
        DBig::from_str(&format!("{value:e}")).unwrap_or(DBig::ZERO),
        LAST_PLACE,
    ))
}

/// `value` rounded to a multiple of `10^place`, with at most [`MAX_DIGITS`] digits.
fn rounded_to_place(value: DBig, place: isize) -> DBig {
    let repr = value.repr();
    if repr.significand().is_zero() {
        return DBig::ZERO.with_precision(MAX_DIGITS).value();
    }
    let excess = place - repr.exponent();
    let digits = repr.digits() as isize;
    let keep = if excess > 0 { digits - excess } else { digits };
    if keep <= 0 {
        return DBig::ZERO.with_precision(MAX_DIGITS).value();
    }
    // `with_precision` also limits later sums, so the full precision is set after rounding.
    value.with_precision((keep as usize).min(MAX_DIGITS)).value().with_precision(MAX_DIGITS).value()
}

impl FromStr for Precise {
    type Err = ParsePreciseError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        if text.len() > MAX_TEXT_BYTES {
            return Err(ParsePreciseError::TooLong);
        }
        // Only plain decimal notation with an optional small exponent: the next sum would need
        // as many digits as a huge exponent says.
        let plain = text.bytes().all(|b| b.is_ascii_digit() || b"+-.eE".contains(&b));
        if !plain || !text.bytes().any(|b| b.is_ascii_digit()) {
            return Err(ParsePreciseError::NotANumber);
        }
        if let Some((_, exponent)) = text.split_once(['e', 'E']) {
            let exponent: i32 = exponent.parse().map_err(|_| ParsePreciseError::NotANumber)?;
            if exponent.unsigned_abs() > LAST_PLACE.unsigned_abs() as u32 {
                return Err(if exponent > 0 {
                    ParsePreciseError::TooFar
                } else {
                    ParsePreciseError::TooLong
                });
            }
        }
        let value = DBig::from_str(text).map_err(|_| ParsePreciseError::NotANumber)?;
        if value.repr().digits() > MAX_DIGITS {
            return Err(ParsePreciseError::TooLong);
        }
        if nearest_f64(&value).abs() > MAX_COORDINATE {
            return Err(ParsePreciseError::TooFar);
        }
        Ok(Self(rounded_to_place(value, LAST_PLACE)))
    }
}

impl fmt::Display for Precise {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(&self.0, f)
    }
}

impl Serialize for Precise {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl<'de> Deserialize<'de> for Precise {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = String::deserialize(deserializer)?;
        text.parse().map_err(|error| {
            de::Error::custom(format!("\"{}\" {error}", text.chars().take(40).collect::<String>()))
        })
    }
}

/// An exact point, in scene units; three decimal strings in the document.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PrecisePoint(pub [Precise; 3]);

impl PrecisePoint {
    /// The scene's origin.
    pub const ORIGIN: Self = Self([Precise(DBig::ZERO), Precise(DBig::ZERO), Precise(DBig::ZERO)]);

    /// The nearest f64 point.
    pub fn to_dvec3(&self) -> DVec3 {
        DVec3::from_array(self.0.each_ref().map(Precise::to_f64))
    }

    /// `self + delta`, each coordinate rounded to a decimal place no coarser than `grain`.
    pub fn moved_by(&self, delta: DVec3, grain: f64) -> Self {
        let [x, y, z] = &self.0;
        Self([x.moved_by(delta.x, grain), y.moved_by(delta.y, grain), z.moved_by(delta.z, grain)])
    }
}

impl From<DVec3> for PrecisePoint {
    fn from(point: DVec3) -> Self {
        Self(point.to_array().map(|v| decimal(v.clamp(-MAX_COORDINATE, MAX_COORDINATE))))
    }
}

impl Sub for &PrecisePoint {
    type Output = DVec3;

    /// The exact difference, rounded once to f64.
    fn sub(self, other: &PrecisePoint) -> DVec3 {
        DVec3::from_array(std::array::from_fn(|i| nearest_f64(&(&self.0[i].0 - &other.0[i].0))))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn precise(text: &str) -> Precise {
        text.parse().expect("a decimal number")
    }

    #[test]
    fn keeps_every_digit_of_a_deep_position() {
        let text = "1.00000000000000000000000000000000000000000000000000000012345678";
        assert_eq!(precise(text).to_string(), text);
    }

    #[test]
    fn a_point_moves_by_less_than_an_f64_can_resolve() {
        let start = precise("1.25");
        let moved = start.moved_by(3e-40, 1e-42);
        let a = PrecisePoint([moved.clone(), start.clone(), start.clone()]);
        let b = PrecisePoint([start.clone(), start.clone(), start]);
        assert_eq!((&a - &b).x, 3e-40);
        assert_eq!(moved.moved_by(-3e-40, 1e-42), precise("1.25"));
    }

    #[test]
    fn rounds_to_the_grain() {
        assert_eq!(precise("0").moved_by(0.123456, 1e-3).to_string(), "0.123");
        assert_eq!(precise("0").moved_by(1e-9, 1e-3).to_string(), "0");
        assert_eq!(precise("1e-60").moved_by(0.5, 1e-3).to_string(), "0.5");
    }

    #[test]
    fn the_origin_is_exact_and_takes_every_digit() {
        let deep = precise("0.1234567890123456789012345678901234567890123456789");
        let point = PrecisePoint([deep.clone(), precise("0"), precise("-1e-70")]);
        assert_eq!(&point - &PrecisePoint::ORIGIN, point.to_dvec3());
        let back = PrecisePoint::ORIGIN.moved_by(DVec3::new(0.1, 1e-60, 0.0), 0.0);
        assert_eq!(back.0.map(|c| c.to_string()).join(" "), format!("0.1 0.{}1 0", "0".repeat(59)));
    }

    #[test]
    fn rejects_texts_that_are_not_coordinates() {
        for text in [
            "",
            "-",
            "1e",
            "abc",
            "nan",
            "inf",
            "1e999999999",
            "1e-999999999",
            "1e2147483647",
            "1e-2147483648",
            "1e-2147483649",
            "101",
            "0x10",
            "1_0",
        ] {
            assert!(text.parse::<Precise>().is_err(), "{text:?} was accepted");
        }
        assert_eq!("9".repeat(121).parse::<Precise>(), Err(ParsePreciseError::TooLong));
    }

    #[test]
    fn sums_have_full_precision_after_a_rounding_to_few_digits() {
        let moved = precise("1").moved_by(1.0, 0.1).moved_by(1e-30, 1e-33);
        assert_eq!(moved.to_string(), "2.000000000000000000000000000001");
    }
}
