//! The orbits of 192 bits against differences, and against the oracle in f64 where that is enough.

use glam::DVec3;
use mandelight::formula::mandelbulb::{Mandelbulb, Sine};
use mandelight_test_support::{
    deep::{
        arithmetic::{Number, Real, rounded},
        orbit::{End, Set},
    },
    oracle::estimate,
    random::Random,
};

#[test]
fn derivatives_are_those_of_differences() {
    for (power, sine) in [(2.0, Sine::Positive), (7.0, Sine::Negative)] {
        let set = Set::new(&Mandelbulb { power, sine, ..Mandelbulb::default() }, 1);
        let at = |p: DVec3| rounded(&set.raised(&p.to_array().map(Real::from_f64)).point);
        let p = DVec3::new(0.4, -0.7, 0.5);
        let found = set.raised(&p.to_array().map(Real::from_f64)).raising;
        for axis in DVec3::AXES {
            let expected = (at(p + axis * 1e-6) - at(p - axis * 1e-6)) / 2e-6;
            assert!((found * axis - expected).length() < 1e-8, "{} {expected}", found * axis);
        }
    }
}

/// Where f64 is enough, these are the estimates of the printed algorithm, with its sines and
/// cosines.
#[test]
fn estimates_are_those_of_the_printed_algorithm() {
    let bulb = |power: f64| Mandelbulb { power, ..Mandelbulb::default() };
    let mut fractals: Vec<_> = [2.0, 3.0, 8.0, 16.0].map(bulb).into();
    fractals.push(Mandelbulb { sine: Sine::Negative, ..bulb(8.0) });
    fractals.push(Mandelbulb { julia: true, ..bulb(7.0) });
    for fractal in fractals {
        let set = Set::new(&fractal, fractal.iterations);
        let mut random = Random(0x1234_5678_9ABC_DEF1);
        let mut away = 0;
        for _ in 0..1000 {
            let point = random.in_ball(1.3);
            let expected = estimate::distance(&fractal, point);
            let left = estimate::orbit(&fractal, point).r > fractal.bailout;
            if left && expected > 1e-3 {
                away += 1;
                let found = set.estimate(&point.to_array().map(Real::from_f64), 1e-3);
                let off = (found.distance - expected).abs() / expected;
                assert!(off < 1e-9, "{fractal:?} at {point}: {found:?} for {expected}");
                let colors = estimate::smooth_iterations(&fractal, point);
                assert!((found.smooth_iterations - colors).abs() < 1e-9);
                let traps = estimate::orbit(&fractal, point).traps;
                for (trap, expected) in found.traps.into_iter().zip(traps) {
                    assert!((trap.min(2.0) - expected).abs() < 1e-9);
                }
            }
        }
        assert!(away > 200, "{away} points away from the surface");
    }
}

/// |z| grows alike along both ways of telling, and as differences say.
#[test]
fn both_jacobians_give_the_gradient_of_the_radius() {
    for julia in [false, true] {
        let set = Set::new(&Mandelbulb { power: 5.0, julia, ..Mandelbulb::default() }, 4);
        let follow = |p: DVec3| set.follow(&p.to_array().map(Real::from_f64), 1e-100);
        for p in [DVec3::new(0.4, -0.7, 0.5), DVec3::new(-0.1, 0.2, 0.9)] {
            let End { z, jacobian, .. } = follow(p);
            let outward = z.normalize();
            let slope = jacobian.derivative.transpose() * outward;
            let unturned = jacobian.unturned.transpose() * outward;
            assert!((slope - unturned).length() < 1e-10 * slope.length(), "{slope} {unturned}");
            let at = |way: DVec3| follow(p + way).z.length();
            let expected = DVec3::from_array(
                DVec3::AXES.map(|axis| (at(axis * 1e-6) - at(-axis * 1e-6)) / 2e-6),
            );
            assert!((slope - expected).length() < 1e-6 * slope.length(), "{slope} {expected}");
        }
    }
}
