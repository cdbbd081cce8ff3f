//! Numbers of 256 bits: what the orbits of the deepest views are followed with.
//!
//! Orbits lose about as many digits as the view is deep; 256 bits are 77 digits, so that at a
//! zoom of 1e-27 some 45 are left. Sums and products are rounded to the nearest number, ties to even
//! (IEEE 754, 4.3.1), as `astro-float` rounds them, without its allocations.

use std::{
    cmp::Ordering,
    ops::{Add, Mul, Neg, Sub},
};

use astro_float_num::{BigFloat, Consts, Radix, RoundingMode, Sign};

/// Bits of every number's mantissa.
const BITS: usize = 256;
/// The same in words.
const WORDS: usize = 4;
const ROUNDING: RoundingMode = RoundingMode::ToEven;
/// From 53 right bits: each step of Newton's method doubles them.
const NEWTON_STEPS: u32 = 3;

/// A real number: ± 0.mantissa · 2^exponent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Real {
    is_negative: bool,
    exponent: i32,
    /// The lowest word first; the highest bit is set, but for zero, which has no bit set.
    mantissa: [u64; WORDS],
}

const ZERO: Real = Real { is_negative: false, exponent: 0, mantissa: [0; WORDS] };

impl Real {
    pub fn from_f64(value: f64) -> Self {
        assert!(value.is_finite(), "{value} is no number");
        if value == 0.0 {
            return ZERO;
        }
        let is_subnormal = value.abs() < f64::MIN_POSITIVE;
        let (normal, raised) =
            if is_subnormal { (value * 2.0_f64.powi(64), 64) } else { (value, 0) };
        let bits = normal.to_bits();
        let highest = (bits << 11) | 1 << 63;
        let exponent = (bits >> 52 & 0x7FF) as i32 - 1022 - raised;
        Self { is_negative: value < 0.0, exponent, mantissa: [0, 0, 0, highest] }
    }

    /// The number that a decimal text says.
    pub fn parse(text: &str) -> Self {
        let mut constants = Consts::new().expect("memory for constants");
        let parsed = BigFloat::parse(text, Radix::Dec, BITS, ROUNDING, &mut constants);
        assert!(!parsed.is_nan(), "{text:?} is no decimal number");
        Self::from_big(&parsed)
    }

    /// The number of 256 bits that `astro-float` has.
    pub fn from_big(big: &BigFloat) -> Self {
        let (words, _, sign, exponent, _) = big.as_raw_parts().expect("a finite number");
        if big.is_zero() {
            return ZERO;
        }
        let mantissa = words.try_into().expect("words of 256 bits");
        Self { is_negative: sign == Sign::Neg, exponent, mantissa }
    }

    /// The same as a number of `astro-float`.
    pub fn to_big(self) -> BigFloat {
        if self.is_zero() {
            return BigFloat::from_f64(0.0, BITS);
        }
        let sign = if self.is_negative { Sign::Neg } else { Sign::Pos };
        BigFloat::from_raw_parts(&self.mantissa, BITS, sign, self.exponent, false)
    }

    /// The nearest f64, but for a last bit: the upper 64 bits rounded once more.
    pub fn to_f64(&self) -> f64 {
        let upper = self.mantissa[WORDS - 1] as f64 * 2.0_f64.powi(-64);
        // In two factors: 2^exponent alone may be out of range where the product is not.
        let half = self.exponent / 2;
        let size = upper * 2.0_f64.powi(half) * 2.0_f64.powi(self.exponent - half);
        if self.is_negative { -size } else { size }
    }

    /// As a decimal number of about 50 digits.
    pub fn to_decimal(&self) -> String {
        let mut constants = Consts::new().expect("memory for constants");
        let text = self.to_big().format(Radix::Dec, ROUNDING, &mut constants).expect("a number");
        let (digits, exponent) = text.split_once('e').unwrap_or((&text, "0"));
        let digits = &digits[..digits.len().min(50)];
        format!("{digits}e{}", exponent.trim_start_matches('+'))
    }

    pub fn is_zero(&self) -> bool {
        self.mantissa[WORDS - 1] == 0
    }

    pub fn doubled(&self) -> Self {
        if self.is_zero() { ZERO } else { Self { exponent: self.exponent + 1, ..*self } }
    }

    /// 1 / √self of a positive number, by Newton's method.
    pub fn inverse_sqrt(&self) -> Self {
        let rough = self.to_f64();
        if !(1e-200..1e200).contains(&rough) {
            let root = self.to_big().sqrt(BITS, ROUNDING);
            return Self::from_big(&BigFloat::from_f64(1.0, BITS).div(&root, BITS, ROUNDING));
        }
        let mut inverse = Self::from_f64(1.0 / rough.sqrt());
        let (half, one) = (Self::from_f64(0.5), Self::from_f64(1.0));
        for _ in 0..NEWTON_STEPS {
            let short = &one - &(self * &(&inverse * &inverse));
            inverse = &inverse + &(&inverse * &(&short * &half));
        }
        inverse
    }

    /// Orders by size alone.
    fn compare_size(&self, other: &Self) -> Ordering {
        let by_zero = other.is_zero().cmp(&self.is_zero());
        let by_words = || self.mantissa.iter().rev().cmp(other.mantissa.iter().rev());
        by_zero.then(self.exponent.cmp(&other.exponent)).then_with(by_words)
    }

    /// The nearest number to 0.mantissa · 2^exponent, whose highest bit is set. `below` are the 64 bits
    /// after the mantissa's, and `is_more` says whether any bit after those is set.
    fn rounded(mut self, below: u64, is_more: bool) -> Self {
        const HALF: u64 = 1 << 63;
        let is_up = below > HALF || below == HALF && (is_more || self.mantissa[0] & 1 == 1);
        if is_up {
            let mut carry = true;
            for word in &mut self.mantissa {
                (*word, carry) = word.overflowing_add(carry.into());
            }
            if carry {
                self.mantissa[WORDS - 1] = HALF;
                self.exponent += 1;
            }
        }
        self
    }

    /// The sum of two numbers of which `self` is no smaller in size and not zero.
    fn plus_smaller(&self, small: &Self) -> Self {
        let distance = (i64::from(self.exponent) - i64::from(small.exponent)) as u64;
        let (aside, is_more) = shifted(&small.mantissa, distance);
        let mut sum = [0, self.mantissa[0], self.mantissa[1], self.mantissa[2], self.mantissa[3]];
        let (mut exponent, mut is_more) = (self.exponent, is_more);
        if self.is_negative == small.is_negative {
            let mut carry = false;
            for (word, add) in sum.iter_mut().zip(aside) {
                (*word, carry) = carrying_add(*word, add, carry);
            }
            if carry {
                is_more |= sum[0] & 1 == 1;
                for i in 0..WORDS {
                    sum[i] = sum[i] >> 1 | sum[i + 1] << 63;
                }
                sum[WORDS] = sum[WORDS] >> 1 | 1 << 63;
                exponent += 1;
            }
        } else {
            // What lies beyond the last word borrows from it, and leaves something beyond it.
            let mut borrow = is_more;
            for (word, sub) in sum.iter_mut().zip(aside) {
                (*word, borrow) = borrowing_sub(*word, sub, borrow);
            }
            let Some(highest) = sum.iter().rposition(|word| *word != 0) else { return ZERO };
            let (words, bits) = (WORDS - highest, sum[highest].leading_zeros());
            sum.rotate_right(words);
            if bits > 0 {
                for i in (1..=WORDS).rev() {
                    sum[i] = sum[i] << bits | sum[i - 1] >> (64 - bits);
                }
                sum[0] <<= bits;
            }
            exponent -= (64 * words as u32 + bits) as i32;
        }
        let mantissa = [sum[1], sum[2], sum[3], sum[4]];
        Self { is_negative: self.is_negative, exponent, mantissa }.rounded(sum[0], is_more)
    }
}

fn carrying_add(a: u64, b: u64, carry: bool) -> (u64, bool) {
    let (sum, first) = a.overflowing_add(b);
    let (sum, second) = sum.overflowing_add(carry.into());
    (sum, first | second)
}

fn borrowing_sub(a: u64, b: u64, borrow: bool) -> (u64, bool) {
    let (rest, first) = a.overflowing_sub(b);
    let (rest, second) = rest.overflowing_sub(borrow.into());
    (rest, first | second)
}

/// A mantissa with one more word below, shifted down; and whether a bit was lost that was set.
fn shifted(mantissa: &[u64; WORDS], distance: u64) -> ([u64; WORDS + 1], bool) {
    let mut found = [0; WORDS + 1];
    let (words, bits) = ((distance / 64).min(9) as usize, distance % 64);
    let at = |i: usize| if (1..=WORDS).contains(&i) { mantissa[i - 1] } else { 0 };
    for (i, word) in found.iter_mut().enumerate() {
        *word = at(i + words) >> bits;
        if bits > 0 {
            *word |= at(i + words + 1) << (64 - bits);
        }
    }
    let is_lost = (0..words).any(|i| at(i) != 0) || bits > 0 && at(words) << (64 - bits) != 0;
    (found, is_lost)
}

impl Add for &Real {
    type Output = Real;
    fn add(self, other: Self) -> Real {
        let (large, small) =
            if self.compare_size(other).is_lt() { (other, self) } else { (self, other) };
        if small.is_zero() { *large } else { large.plus_smaller(small) }
    }
}

impl Sub for &Real {
    type Output = Real;
    fn sub(self, other: Self) -> Real {
        self + &-other
    }
}

impl Mul for &Real {
    type Output = Real;
    fn mul(self, other: Self) -> Real {
        if self.is_zero() || other.is_zero() {
            return ZERO;
        }
        let mut product = [0_u64; 2 * WORDS];
        for (i, a) in self.mantissa.iter().enumerate() {
            let mut carry = 0;
            for (j, b) in other.mantissa.iter().enumerate() {
                let sum = u128::from(*a) * u128::from(*b) + u128::from(product[i + j]) + carry;
                product[i + j] = sum as u64;
                carry = sum >> 64;
            }
            product[i + WORDS] = carry as u64;
        }
        let mut exponent = self.exponent + other.exponent;
        if product[2 * WORDS - 1] >> 63 == 0 {
            for i in (1..2 * WORDS).rev() {
                product[i] = product[i] << 1 | product[i - 1] >> 63;
            }
            product[0] <<= 1;
            exponent -= 1;
        }
        let [a, b, c, below, mantissa @ ..] = product;
        let is_negative = self.is_negative != other.is_negative;
        Real { is_negative, exponent, mantissa }.rounded(below, a | b | c != 0)
    }
}

impl Neg for &Real {
    type Output = Real;
    fn neg(self) -> Real {
        Real { is_negative: !self.is_negative && !self.is_zero(), ..*self }
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

    /// A power: exact to the last bits where it is whole, else of the principal angle, in f64.
    pub fn real_power(&self, exponent: f64) -> Self {
        if exponent.fract() == 0.0 {
            return self.power(exponent as u32);
        }
        let (re, im) = (self.re.to_f64(), self.im.to_f64());
        let (sine, cosine) = (exponent * im.atan2(re)).sin_cos();
        let radius = re.hypot(im).powf(exponent);
        Self { re: Real::from_f64(radius * cosine), im: Real::from_f64(radius * sine) }
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
