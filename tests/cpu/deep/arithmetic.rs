//! Numbers of 192 bits: what they are good for, and that they are rounded as `astro-float` rounds.

use astro_float_num::{BigFloat, RoundingMode};
use mandelight_test_support::{
    deep::arithmetic::{BITS, Complex, Number, Real},
    random::Random,
};

/// Numbers of random digits, and some of few bits, whose sums and products fall between two numbers.
fn numbers() -> Vec<Real> {
    let mut random = Random(0x5EED_0256);
    let mut numbers: Vec<_> = (0..400)
        .map(|_| {
            let digits: String =
                (0..80).map(|_| char::from(b'0' + (random.unit() * 10.0) as u8)).collect();
            let sign = if random.unit() < 0.5 { "-" } else { "" };
            Real::parse(&format!("{sign}0.{digits}e{}", (random.unit() * 80.0) as i32 - 60))
        })
        .collect();
    let powers = [
        0, 1, 2, 63, 64, 65, 127, 128, 190, 191, 192, 193, 194, 254, 255, 256, 257, 258, 319, 320,
        321, 400,
    ];
    for power in powers {
        let small = Real::from_f64(2.0_f64.powi(-power));
        numbers.extend([small, -small, Real::from_f64(1.0) - small, Real::from_f64(1.5) + small]);
    }
    numbers.push(Real::from_f64(0.0));
    numbers
}

#[test]
fn sums_and_products_are_rounded_to_the_last_bit() {
    const ROUNDING: RoundingMode = RoundingMode::ToEven;
    type Operation = (fn(Real, Real) -> Real, fn(&BigFloat, &BigFloat) -> BigFloat);
    let operations: [Operation; 3] = [
        (|a, b| a + b, |a, b| a.add(b, BITS, ROUNDING)),
        (|a, b| a - b, |a, b| a.sub(b, BITS, ROUNDING)),
        (|a, b| a * b, |a, b| a.mul(b, BITS, ROUNDING)),
    ];
    let numbers = numbers();
    for &a in &numbers {
        // What hardly differs cancels.
        let close = a + a * Real::from_f64(2.0_f64.powi(-140));
        for &b in numbers.iter().chain([&close]) {
            for (ours, theirs) in operations {
                let expected = Real::from_big(&theirs(&a.to_big(), &b.to_big()));
                assert_eq!(ours(a, b), expected, "{a:?} and {b:?}");
            }
        }
    }
}

#[test]
fn numbers_keep_fifty_seven_digits() {
    let third = Real::parse("0.333333333333333333333333333333333333333333333333333333");
    let off = third * Real::from_f64(3.0) - Real::from_f64(1.0);
    assert!((off.to_f64() + 1e-54).abs() < 1e-57, "{}", off.to_f64());
    let two = Real::from_f64(2.0);
    let root = two.inverse_sqrt();
    let off = (root * root).doubled() - Real::from_f64(1.0);
    assert!(off.to_f64().abs() < 1e-57, "{}", off.to_f64());
    for value in [1.0, -0.1, 3.5e-300, -2.0_f64.powi(90), 0.0] {
        assert_eq!(Real::from_f64(value).to_f64(), value);
        assert_eq!(Real::from_f64(value).doubled().to_f64(), 2.0 * value);
    }
}

#[test]
fn complex_powers_are_repeated_products() {
    let i = Complex { re: Real::from_f64(0.6), im: Real::from_f64(0.8) };
    let mut product = i;
    for exponent in 1..=16 {
        let power = i.power(exponent);
        assert!((power.re - product.re).to_f64().abs() < 1e-56, "{exponent}");
        assert!((power.im - product.im).to_f64().abs() < 1e-56, "{exponent}");
        product = product.times(i);
    }
}
