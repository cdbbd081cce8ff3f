//! The oracle's gradients, where the gradient is known.

use glam::DVec3;
use mandelight::formula::mandelbulb::Mandelbulb;
use mandelight_test_support::oracle::normals::{angle_deg, gradient};

#[test]
fn differences_find_a_gradient_that_is_known() {
    // Of power 2 without steps: r ln r / 2 grows outward alone. (Iterations of 0 are out of the
    // document's range. The point is beyond the bailout.)
    let fractal = Mandelbulb { power: 2.0, iterations: 0, ..Mandelbulb::default() };
    let p = DVec3::new(4.1, -2.7, 1.4);
    let found = gradient(&fractal, p, 0.1).expect("a slope");
    assert!(found.uncertain_deg < 1e-8 && angle_deg(found.unit, p) < 1e-8);
    assert!(gradient(&Mandelbulb::default(), DVec3::splat(0.1), 1e-3).is_none());
}
