//! Numbers with first and second derivatives by three variables (forward automatic differentiation).

use std::ops::{Add, Mul, Sub};

use glam::DVec3;

/// A value with its gradient and its Hessian.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jet {
    /// The value.
    pub value: f64,
    /// First derivatives by x, y, z.
    pub gradient: DVec3,
    /// Second derivatives: xx, yy, zz.
    pub pure: DVec3,
    /// Second derivatives: xy, yz, zx.
    pub mixed: DVec3,
}

/// The products u.x·v.y + u.y·v.x and so on, in the order of [`Jet::mixed`].
fn mixed_products(u: DVec3, v: DVec3) -> DVec3 {
    let (u_next, v_next) = (DVec3::new(u.y, u.z, u.x), DVec3::new(v.y, v.z, v.x));
    u * v_next + u_next * v
}

impl Jet {
    /// A constant: all derivatives are zero.
    pub fn constant(value: f64) -> Self {
        Self { value, gradient: DVec3::ZERO, pure: DVec3::ZERO, mixed: DVec3::ZERO }
    }

    /// A linear function with this value and gradient.
    pub fn linear(value: f64, gradient: DVec3) -> Self {
        Self { gradient, ..Self::constant(value) }
    }

    /// The chain rule: a function of the jet, from its value and first two derivatives there.
    fn chain(self, value: f64, first: f64, second: f64) -> Self {
        let g = self.gradient;
        Self {
            value,
            gradient: first * g,
            pure: first * self.pure + second * g * g,
            mixed: first * self.mixed + 0.5 * second * mixed_products(g, g),
        }
    }

    /// The square root.
    pub fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        self.chain(root, 0.5 / root, -0.25 / (root * self.value))
    }

    /// The reciprocal.
    pub fn recip(self) -> Self {
        let inverse = self.value.recip();
        self.chain(inverse, -inverse * inverse, 2.0 * inverse.powi(3))
    }

    /// The `n`-th power.
    pub fn powi(self, n: i32) -> Self {
        let v = self.value;
        let (first, second) = (f64::from(n), f64::from(n) * f64::from(n - 1));
        self.chain(v.powi(n), first * v.powi(n - 1), second * v.powi(n - 2))
    }

    /// The second-order expansion at `offset`.
    pub fn at(&self, offset: DVec3) -> f64 {
        self.value + self.change(offset)
    }

    /// [`Self::at`] minus the value.
    pub fn change(&self, v: DVec3) -> f64 {
        let crossed = DVec3::new(v.x * v.y, v.y * v.z, v.z * v.x);
        self.gradient.dot(v) + 0.5 * self.pure.dot(v * v) + self.mixed.dot(crossed)
    }
}

impl Add for Jet {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            value: self.value + other.value,
            gradient: self.gradient + other.gradient,
            pure: self.pure + other.pure,
            mixed: self.mixed + other.mixed,
        }
    }
}

impl Sub for Jet {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + other * -1.0
    }
}

impl Mul<f64> for Jet {
    type Output = Self;

    fn mul(self, factor: f64) -> Self {
        Self {
            value: self.value * factor,
            gradient: self.gradient * factor,
            pure: self.pure * factor,
            mixed: self.mixed * factor,
        }
    }
}

impl Mul for Jet {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let (u, v) = (self.gradient, other.gradient);
        Self {
            value: self.value * other.value,
            gradient: u * other.value + v * self.value,
            pure: self.pure * other.value + other.pure * self.value + 2.0 * u * v,
            mixed: self.mixed * other.value + other.mixed * self.value + mixed_products(u, v),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A function of three variables that uses every operation.
    fn function([x, y, z]: [Jet; 3]) -> Jet {
        (x * x + y * z * 0.5 + Jet::constant(2.0)).sqrt() * z.powi(5) - (y * x + z).recip() * 3.0
    }

    fn variables(at: DVec3) -> [Jet; 3] {
        let [x, y, z] = at.to_array();
        [Jet::linear(x, DVec3::X), Jet::linear(y, DVec3::Y), Jet::linear(z, DVec3::Z)]
    }

    #[test]
    fn the_expansion_is_right_to_third_order() {
        let at = DVec3::new(0.7, -0.4, 1.3);
        let jet = function(variables(at));
        for way in [DVec3::new(1.0, 2.0, -1.5), DVec3::new(-0.3, 0.2, 0.9), DVec3::X, DVec3::Y] {
            let error = |h: f64| {
                let exact = function(variables(at + way * h)).value;
                (jet.at(way * h) - exact).abs()
            };
            let ratio = error(2e-3) / error(1e-3);
            assert!((7.0..9.0).contains(&ratio), "{way}: {ratio}");
        }
    }
}
