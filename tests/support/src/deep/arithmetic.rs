//! Real numbers: f64, and numbers of 192 bits, which the orbits of deep views are followed with.
//!
//! Orbits lose about as many digits as the view is deep; 192 bits are 57 digits, so that at a
//! zoom of 1e-27 some 30 are left. Sums and products are rounded to the nearest number, ties to even
//! (IEEE 754, 4.3.1), as `astro-float` rounds them, without its allocations.

use std::{
    cmp::Ordering,
    fmt::Debug,
    ops::{Add, Mul, Neg, Sub},
};

use astro_float_num::{BigFloat, Consts, Radix, RoundingMode, Sign};

/// A type of real numbers, to follow orbits with.
pub trait Number:
    Copy
    + Debug
    + Send
    + Sync
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Neg<Output = Self>
{
    fn from_f64(value: f64) -> Self;

    /// The nearest f64, but for a last bit.
    fn to_f64(self) -> f64;

    /// The number that a decimal text says.
    fn parse(text: &str) -> Self;

    fn is_zero(self) -> bool;

    fn doubled(self) -> Self;

    /// 1 / √self of a positive number.
    fn inverse_sqrt(self) -> Self;
}

impl Number for f64 {
    fn from_f64(value: f64) -> Self {
        value
    }

    fn to_f64(self) -> f64 {
        self
    }

    fn parse(text: &str) -> Self {
        text.parse().unwrap_or_else(|_| panic!("{text:?} is no decimal number"))
    }

    fn is_zero(self) -> bool {
        self == 0.0
    }

    fn doubled(self) -> Self {
        2.0 * self
    }

    fn inverse_sqrt(self) -> Self {
        self.sqrt().recip()
    }
}

/// Bits of the mantissa of a [`Real`].
pub const BITS: usize = 64 * WORDS;
const WORDS: usize = 3;
const ROUNDING: RoundingMode = RoundingMode::ToEven;
/// From 53 right bits: each step of Newton's method doubles them.
const NEWTON_STEPS: u32 = 2;

/// A number of [`BITS`] bits: ± 0.mantissa · 2^exponent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Real {
    is_negative: bool,
    exponent: i32,
    /// The lowest word first; the highest bit is set, but for zero, which has no bit set.
    mantissa: [u64; WORDS],
}

const ZERO: Real = Real { is_negative: false, exponent: 0, mantissa: [0; WORDS] };

impl Number for Real {
    fn from_f64(value: f64) -> Self {
        assert!(value.is_finite(), "{value} is no number");
        if value == 0.0 {
            return ZERO;
        }
        let is_subnormal = value.abs() < f64::MIN_POSITIVE;
        let (normal, raised) =
            if is_subnormal { (value * 2.0_f64.powi(64), 64) } else { (value, 0) };
        let bits = normal.to_bits();
        let mut mantissa = [0; WORDS];
        mantissa[WORDS - 1] = (bits << 11) | 1 << 63;
        let exponent = (bits >> 52 & 0x7FF) as i32 - 1022 - raised;
        Self { is_negative: value < 0.0, exponent, mantissa }
    }

    /// The upper 64 bits rounded once more.
    fn to_f64(self) -> f64 {
        let upper = self.mantissa[WORDS - 1] as f64 * 2.0_f64.powi(-64);
        // In two factors: 2^exponent alone may be out of range where the product is not.
        let half = self.exponent / 2;
        let size = upper * 2.0_f64.powi(half) * 2.0_f64.powi(self.exponent - half);
        if self.is_negative { -size } else { size }
    }

    fn parse(text: &str) -> Self {
        let mut constants = Consts::new().expect("memory for constants");
        let parsed = BigFloat::parse(text, Radix::Dec, BITS, ROUNDING, &mut constants);
        assert!(!parsed.is_nan(), "{text:?} is no decimal number");
        Self::from_big(&parsed)
    }

    fn is_zero(self) -> bool {
        self.mantissa[WORDS - 1] == 0
    }

    fn doubled(self) -> Self {
        self.scaled(1)
    }

    /// By Newton's method.
    fn inverse_sqrt(self) -> Self {
        let rough = self.to_f64();
        if !(1e-200..1e200).contains(&rough) {
            let root = self.to_big().sqrt(BITS, ROUNDING);
            return Self::from_big(&BigFloat::from_f64(1.0, BITS).div(&root, BITS, ROUNDING));
        }
        let one = Self::from_f64(1.0);
        (0..NEWTON_STEPS).fold(Self::from_f64(rough.sqrt().recip()), |inverse, _| {
            let short = one - self * (inverse * inverse);
            inverse + (inverse * short).scaled(-1)
        })
    }
}

impl Real {
    /// The number of [`BITS`] bits that `astro-float` has.
    pub fn from_big(big: &BigFloat) -> Self {
        let (words, _, sign, exponent, _) = big.as_raw_parts().expect("a finite number");
        if big.is_zero() {
            return ZERO;
        }
        let mantissa = words.try_into().expect("as many words");
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

    /// As a decimal number of about 50 digits.
    pub fn to_decimal(&self) -> String {
        let mut constants = Consts::new().expect("memory for constants");
        let text = self.to_big().format(Radix::Dec, ROUNDING, &mut constants).expect("a number");
        let (digits, exponent) = text.split_once('e').unwrap_or((&text, "0"));
        let digits = &digits[..digits.len().min(50)];
        format!("{digits}e{}", exponent.trim_start_matches('+'))
    }

    /// self · 2^power.
    fn scaled(self, power: i32) -> Self {
        if self.is_zero() { ZERO } else { Self { exponent: self.exponent + power, ..self } }
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
        let [low, middle, high] = self.mantissa;
        let mut sum = [0, low, middle, high];
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
        let [below, mantissa @ ..] = sum;
        Self { is_negative: self.is_negative, exponent, mantissa }.rounded(below, is_more)
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
    let (words, bits) = ((distance / 64).min(2 * WORDS as u64 + 1) as usize, distance % 64);
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

impl Add for Real {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let (large, small) =
            if self.compare_size(&other).is_lt() { (&other, &self) } else { (&self, &other) };
        if small.is_zero() { *large } else { large.plus_smaller(small) }
    }
}

impl Sub for Real {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Real {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
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
        let [a, b, below, mantissa @ ..] = product;
        let is_negative = self.is_negative != other.is_negative;
        Self { is_negative, exponent, mantissa }.rounded(below, a | b != 0)
    }
}

impl Neg for Real {
    type Output = Self;
    fn neg(self) -> Self {
        Self { is_negative: !self.is_negative && !self.is_zero(), ..self }
    }
}

/// A complex number.
#[derive(Clone, Copy, Debug)]
pub struct Complex<N> {
    pub re: N,
    pub im: N,
}

impl<N: Number> Complex<N> {
    pub fn times(self, other: Self) -> Self {
        Self {
            re: self.re * other.re - self.im * other.im,
            im: self.re * other.im + self.im * other.re,
        }
    }

    pub fn squared(self) -> Self {
        Self { re: (self.re + self.im) * (self.re - self.im), im: (self.re * self.im).doubled() }
    }

    /// A power: exact to the last bits where it is whole, else of the principal angle, in f64.
    pub fn real_power(self, exponent: f64) -> Self {
        if exponent.fract() == 0.0 {
            return self.power(exponent as u32);
        }
        let (re, im) = (self.re.to_f64(), self.im.to_f64());
        let (sine, cosine) = (exponent * im.atan2(re)).sin_cos();
        let radius = re.hypot(im).powf(exponent);
        Self { re: N::from_f64(radius * cosine), im: N::from_f64(radius * sine) }
    }

    /// A whole power of at least 1.
    pub fn power(self, exponent: u32) -> Self {
        let mut bits = (0..exponent.ilog2()).rev();
        bits.by_ref().fold(self, |product, bit| {
            let square = product.squared();
            if exponent >> bit & 1 == 1 { square.times(self) } else { square }
        })
    }
}

/// A point of space.
pub type Point<N = Real> = [N; 3];

/// The sum of two points' vectors.
pub fn sum<N: Number>(a: &Point<N>, b: &Point<N>) -> Point<N> {
    [0, 1, 2].map(|i| a[i] + b[i])
}

/// The difference of two points.
pub fn difference<N: Number>(a: &Point<N>, b: &Point<N>) -> Point<N> {
    [0, 1, 2].map(|i| a[i] - b[i])
}

/// `point` moved by a small way.
pub fn moved<N: Number>(point: &Point<N>, way: glam::DVec3) -> Point<N> {
    sum(point, &way.to_array().map(N::from_f64))
}

/// The nearest f64s.
pub fn rounded<N: Number>(point: &Point<N>) -> glam::DVec3 {
    glam::DVec3::from_array(point.map(N::to_f64))
}
