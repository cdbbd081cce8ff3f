//! Numbers of 256 bits: what the orbits of the deepest views are followed with.
//!
//! Orbits lose about as many digits as the view is deep; 256 bits are 77 digits, so that at a
//! zoom of 1e-27 some 45 are left.

use std::ops::{Add, Mul, Neg, Sub};

use astro_float_num::{BigFloat, Consts, Radix, RoundingMode};

/// Bits of every number's mantissa.
const BITS: usize = 256;
const ROUNDING: RoundingMode = RoundingMode::ToEven;
/// From 53 right bits: each step of Newton's method doubles them.
const NEWTON_STEPS: u32 = 3;

/// A real number.
#[derive(Clone, Debug)]
pub struct Real(BigFloat);

impl Real {
    pub fn from_f64(value: f64) -> Self {
        Self(BigFloat::from_f64(value, BITS))
    }

    /// The number that a decimal text says.
    pub fn parse(text: &str) -> Self {
        let mut constants = Consts::new().expect("memory for constants");
        let parsed = BigFloat::parse(text, Radix::Dec, BITS, ROUNDING, &mut constants);
        assert!(!parsed.is_nan(), "{text:?} is no decimal number");
        Self(parsed)
    }

    /// The nearest f64, but for a last bit: the upper 64 bits rounded once more.
    pub fn to_f64(&self) -> f64 {
        if self.0.is_zero() {
            return 0.0;
        }
        let (words, _, sign, exponent, _) = self.0.as_raw_parts().expect("a finite number");
        let upper = words[words.len() - 1] as f64 * 2.0_f64.powi(-64);
        // In two factors: 2^exponent alone may be out of range where the product is not.
        let half = exponent / 2;
        let size = upper * 2.0_f64.powi(half) * 2.0_f64.powi(exponent - half);
        if sign == astro_float_num::Sign::Neg { -size } else { size }
    }

    /// As a decimal number of about 50 digits.
    pub fn to_decimal(&self) -> String {
        let mut constants = Consts::new().expect("memory for constants");
        let text = self.0.format(Radix::Dec, ROUNDING, &mut constants).expect("a number");
        let (digits, exponent) = text.split_once('e').unwrap_or((&text, "0"));
        let digits = &digits[..digits.len().min(50)];
        format!("{digits}e{}", exponent.trim_start_matches('+'))
    }

    pub fn is_zero(&self) -> bool {
        self.0.is_zero()
    }

    pub fn doubled(&self) -> Self {
        let mut twice = self.0.clone();
        if let Some(exponent) = twice.exponent().filter(|_| !twice.is_zero()) {
            twice.set_exponent(exponent + 1);
        }
        Self(twice)
    }

    /// 1 / √self of a positive number, by Newton's method: the crate's own square root takes as
    /// long as 90 products, this as long as 15.
    pub fn inverse_sqrt(&self) -> Self {
        let rough = self.to_f64();
        if !(1e-200..1e200).contains(&rough) {
            let root = self.0.sqrt(BITS, ROUNDING);
            return Self(Real::from_f64(1.0).0.div(&root, BITS, ROUNDING));
        }
        let mut inverse = Self::from_f64(1.0 / rough.sqrt());
        let (half, one) = (Self::from_f64(0.5), Self::from_f64(1.0));
        for _ in 0..NEWTON_STEPS {
            let short = &one - &(self * &(&inverse * &inverse));
            inverse = &inverse + &(&inverse * &(&short * &half));
        }
        inverse
    }
}

impl Add for &Real {
    type Output = Real;
    fn add(self, other: Self) -> Real {
        Real(self.0.add(&other.0, BITS, ROUNDING))
    }
}

impl Sub for &Real {
    type Output = Real;
    fn sub(self, other: Self) -> Real {
        Real(self.0.sub(&other.0, BITS, ROUNDING))
    }
}

impl Mul for &Real {
    type Output = Real;
    fn mul(self, other: Self) -> Real {
        Real(self.0.mul(&other.0, BITS, ROUNDING))
    }
}

impl Neg for &Real {
    type Output = Real;
    fn neg(self) -> Real {
        Real(BigFloat::neg(&self.0))
    }
}

/// A complex number.
#[derive(Clone, Debug)]
pub struct Complex {
    pub re: Real,
    pub im: Real,
}

impl Complex {
    pub fn times(&self, other: &Self) -> Self {
        Self {
            re: &(&self.re * &other.re) - &(&self.im * &other.im),
            im: &(&self.re * &other.im) + &(&self.im * &other.re),
        }
    }

    pub fn squared(&self) -> Self {
        Self {
            re: &(&self.re + &self.im) * &(&self.re - &self.im),
            im: (&self.re * &self.im).doubled(),
        }
    }

    /// A whole power of at least 1.
    pub fn power(&self, exponent: u32) -> Self {
        let mut bits = (0..exponent.ilog2()).rev();
        bits.by_ref().fold(self.clone(), |product, bit| {
            let square = product.squared();
            if exponent >> bit & 1 == 1 { square.times(self) } else { square }
        })
    }
}

/// A point of space.
pub type Point = [Real; 3];

/// `point` moved by a small way.
pub fn moved(point: &Point, way: glam::DVec3) -> Point {
    let [x, y, z] = way.to_array().map(Real::from_f64);
    [&point[0] + &x, &point[1] + &y, &point[2] + &z]
}

/// The nearest f64s.
pub fn rounded(point: &Point) -> glam::DVec3 {
    glam::DVec3::from_array(point.each_ref().map(Real::to_f64))
}

#[test]
fn numbers_keep_seventy_digits() {
    let third =
        Real::parse("0.333333333333333333333333333333333333333333333333333333333333333333333333");
    let off = &(&third * &Real::from_f64(3.0)) - &Real::from_f64(1.0);
    assert!((off.to_f64() + 1e-72).abs() < 1e-75, "{}", off.to_f64());
    let two = Real::from_f64(2.0);
    let root = two.inverse_sqrt();
    let off = &(&root * &root).doubled() - &Real::from_f64(1.0);
    assert!(off.to_f64().abs() < 1e-75, "{}", off.to_f64());
    for value in [1.0, -0.1, 3.5e-300, -2.0_f64.powi(90), 0.0] {
        assert_eq!(Real::from_f64(value).to_f64(), value);
        assert_eq!(Real::from_f64(value).doubled().to_f64(), 2.0 * value);
    }
}

#[test]
fn powers_of_complex_numbers() {
    let i = Complex { re: Real::from_f64(0.6), im: Real::from_f64(0.8) };
    let mut product = i.clone();
    for exponent in 1..=16 {
        let power = i.power(exponent);
        assert!((&power.re - &product.re).to_f64().abs() < 1e-74, "{exponent}");
        assert!((&power.im - &product.im).to_f64().abs() < 1e-74, "{exponent}");
        product = product.times(&i);
    }
}
