//! The triplex power zⁿ (thesis eq. 2.3 and 2.4, and Algorithm 1).
//!
//! With `r = |z|`, latitude φ and longitude θ,
//! `zⁿ = rⁿ (cos nφ cos nθ, cos nφ sin nθ, sin nφ)`. A whole n needs no angles: with
//! `ρ = √(x² + y²)`, the rotor `u = (x + iy)/ρ` and `w = ρ + iz`,
//! `zⁿ = (Re wⁿ · Re uⁿ, Re wⁿ · Im uⁿ, Im wⁿ)`.

use glam::{DMat3, DVec2, DVec3};

use super::parameters::Mandelbulb;

/// The map z → zⁿ of one fractal, and its scalar derivative.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TriplexPower {
    exponent: Exponent,
    /// Factor of the latitude's sine: 1 or −1.
    sine_sign: f64,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Exponent {
    Whole(u32),
    Real(f64),
}

impl TriplexPower {
    /// The power of `fractal`, with its sign of the sine.
    pub fn new(fractal: &Mandelbulb) -> Self {
        Self {
            exponent: fractal
                .integer_power()
                .map_or(Exponent::Real(fractal.power), Exponent::Whole),
            sine_sign: fractal.sine.sign(),
        }
    }

    /// The exponent n.
    pub fn exponent(&self) -> f64 {
        match self.exponent {
            Exponent::Whole(n) => f64::from(n),
            Exponent::Real(n) => n,
        }
    }

    /// zⁿ. On the z axis, where the longitude is undefined, uses longitude zero.
    pub fn apply(&self, z: DVec3) -> DVec3 {
        let raised = match self.exponent {
            Exponent::Whole(n) => whole_power(z, n),
            Exponent::Real(n) => real_power(z, n),
        };
        DVec3::new(raised.x, raised.y, raised.z * self.sine_sign)
    }

    /// `n · r^(n−1)`: the factor of the scalar derivative in one step from radius `r`.
    pub fn growth(&self, r: f64) -> f64 {
        match self.exponent {
            Exponent::Whole(n) => f64::from(n) * r.powi(n as i32 - 1),
            Exponent::Real(n) => n * r.powf(n - 1.0),
        }
    }

    /// The stretch of lengths along the parallel through `z`: `n · |Re wⁿ| / ρ`.
    ///
    /// This is the third singular value of the power's Jacobian; the other two are [`Self::growth`].
    /// `raised` is zⁿ, whose distance from the axis is |Re wⁿ|. Infinite on the axis.
    pub fn sideways_growth(&self, z: DVec3, raised: DVec3) -> f64 {
        let rho = z.x.hypot(z.y);
        if rho > 0.0 { self.exponent() * raised.x.hypot(raised.y) / rho } else { f64::INFINITY }
    }

    /// The Jacobian of zⁿ at a point off the axis.
    ///
    /// The matrix is n·r^(n−1) times a rotation in the meridian's plane and a rotation of the parallels. The
    /// stretch along the parallels is [`Self::sideways_growth`], at most `sideways_max` · n·r^(n−1).
    pub fn jacobian(&self, z: DVec3, sideways_max: f64) -> DMat3 {
        let (rho, r) = (z.x.hypot(z.y), z.length());
        let raised = self.apply(z);
        let rotor = DVec2::new(z.x, z.y) / rho;
        // The direction of the raised meridian plane; the raised point may lie on its negative side.
        let turned = match self.exponent {
            Exponent::Whole(n) => complex_power(rotor, n),
            Exponent::Real(n) => DVec2::from_angle(n * rotor.to_angle()),
        };
        let across = raised.truncate().dot(turned);
        let growth = self.growth(r);
        let length = across.hypot(raised.z) * r;
        // w^(n-1), normalised.
        let unit = DVec2::new(across, raised.z * self.sine_sign).rotate(DVec2::new(rho, -z.z));
        let meridian = growth * unit / length;
        let most = sideways_max * growth;
        let sideways = (self.exponent() * across / rho).clamp(-most, most);
        let parallel = sideways * DVec2::new(-turned.y, turned.x);
        let of_radius = (meridian.x * turned).extend(self.sine_sign * meridian.y);
        let of_height = (-meridian.y * turned).extend(self.sine_sign * meridian.x);
        let of_angle = parallel.extend(0.0);
        DMat3::from_cols(
            rotor.x * of_radius - rotor.y * of_angle,
            rotor.y * of_radius + rotor.x * of_angle,
            of_height,
        )
    }
}

fn whole_power(z: DVec3, n: u32) -> DVec3 {
    let rho = z.x.hypot(z.y);
    let rotor = if rho > 0.0 { DVec2::new(z.x, z.y) / rho } else { DVec2::X };
    let w = complex_power(DVec2::new(rho, z.z), n);
    let u = complex_power(rotor, n);
    DVec3::new(w.x * u.x, w.x * u.y, w.y)
}

/// Powers by squaring, from the exponent's highest bit down.
fn complex_power(base: DVec2, n: u32) -> DVec2 {
    let mut power = DVec2::X;
    for bit in (0..u32::BITS - n.leading_zeros()).rev() {
        power = power.rotate(power);
        if n >> bit & 1 == 1 {
            power = power.rotate(base);
        }
    }
    power
}

/// Uses atan2 for the latitude too: asin loses half its digits near the poles.
fn real_power(z: DVec3, n: f64) -> DVec3 {
    let rho = z.x.hypot(z.y);
    let latitude = n * z.z.atan2(rho);
    let longitude = if rho > 0.0 { n * z.y.atan2(z.x) } else { 0.0 };
    let (sin_lat, cos_lat) = latitude.sin_cos();
    let (sin_lon, cos_lon) = longitude.sin_cos();
    z.length().powf(n) * DVec3::new(cos_lat * cos_lon, cos_lat * sin_lon, sin_lat)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formula::mandelbulb::parameters::Sine;

    fn map(power: f64, sine: Sine) -> TriplexPower {
        TriplexPower::new(&Mandelbulb { power, sine, ..Mandelbulb::default() })
    }

    #[test]
    fn whole_and_real_paths_agree() {
        let points =
            [DVec3::new(0.3, -0.7, 0.2), DVec3::new(-1.1, 0.4, -0.9), DVec3::new(1e-9, 2e-9, 0.8)];
        for n in 2..=16 {
            for z in points {
                let (whole, real) = (whole_power(z, n), real_power(z, f64::from(n)));
                assert!(
                    (whole - real).length() <= 1e-13 * real.length(),
                    "n = {n}, z = {z}: {whole} and {real}"
                );
            }
        }
    }

    #[test]
    fn the_length_is_raised_exactly_as_a_number() {
        let z = DVec3::new(0.6, -0.5, 0.9);
        for power in [2.0, 2.5, 7.0, 8.0, 15.9] {
            for sine in [Sine::Positive, Sine::Negative] {
                let raised = map(power, sine).apply(z).length();
                assert!((raised / z.length().powf(power) - 1.0).abs() < 1e-13);
            }
        }
    }

    #[test]
    fn the_negative_sine_mirrors_the_result() {
        let z = DVec3::new(0.6, -0.5, 0.4);
        let (plus, minus) = (map(8.0, Sine::Positive).apply(z), map(8.0, Sine::Negative).apply(z));
        assert_eq!(minus, DVec3::new(plus.x, plus.y, -plus.z));
    }

    #[test]
    fn the_axis_and_the_origin_are_tame() {
        for power in [2.0, 3.5, 8.0] {
            assert_eq!(map(power, Sine::Positive).apply(DVec3::ZERO), DVec3::ZERO);
        }
        // Latitude 90° times eight is a whole number of turns, so the pole maps to +x.
        let pole = map(8.0, Sine::Positive).apply(DVec3::new(0.0, 0.0, 1.1));
        assert!((pole - DVec3::new(1.1_f64.powi(8), 0.0, 0.0)).length() < 1e-12);
    }

    #[test]
    fn sideways_growth_is_the_stretch_of_a_small_turn_about_the_axis() {
        for power in [2.0, 3.3, 8.0] {
            let map = map(power, Sine::Negative);
            for z in [DVec3::new(0.3, -0.7, 0.2), DVec3::new(0.1, 0.02, -1.1)] {
                let along = DVec3::Z.cross(z).normalize() * 1e-6;
                let stretch = (map.apply(z + along) - map.apply(z - along)).length() / 2e-6;
                let found = map.sideways_growth(z, map.apply(z));
                assert!((found / stretch - 1.0).abs() < 1e-6, "{power} at {z}: {found}, {stretch}");
            }
        }
    }

    #[test]
    fn the_jacobian_is_what_differences_say() {
        for power in [2.0, 3.0, 3.3, 8.0] {
            for sine in [Sine::Positive, Sine::Negative] {
                let map = map(power, sine);
                for z in [DVec3::new(0.3, -0.7, 0.2), DVec3::new(-0.1, 0.5, -1.1)] {
                    let slope = |axis: DVec3| {
                        (map.apply(z + axis * 1e-6) - map.apply(z - axis * 1e-6)) / 2e-6
                    };
                    let found = map.jacobian(z, f64::INFINITY);
                    let exact = DMat3::from_cols(slope(DVec3::X), slope(DVec3::Y), slope(DVec3::Z));
                    let error = (found - exact).to_cols_array().map(f64::abs);
                    let largest = error.into_iter().fold(0.0, f64::max);
                    assert!(largest < 1e-6, "{power} {sine:?} at {z}: {found} {exact}");
                }
            }
        }
    }

    #[test]
    fn growth_is_the_derivative_of_the_length() {
        for power in [2.0, 3.3, 8.0] {
            let (r, h) = (1.07_f64, 1e-6);
            let slope = ((r + h).powf(power) - (r - h).powf(power)) / (2.0 * h);
            assert!((map(power, Sine::Positive).growth(r) / slope - 1.0).abs() < 1e-8);
        }
    }
}
