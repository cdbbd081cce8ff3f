//! The Jacobian of a deep orbit by its point, whose norm sets a ray's step.

use glam::{DMat3, DVec2, DVec3};

use crate::fractal::{estimator::DEEP_SIDEWAYS_MAX, power::TriplexPower};

/// Stands in for a distance of zero from the axis.
const LEAST_RADIUS: f64 = 1e-100;

/// Jacobian of an orbit's current value by its starting point.
#[derive(Clone, Copy, Debug)]
pub struct OrbitJacobian {
    jacobian: DMat3,
    /// How a constant moves with the point: 1 for the Mandelbulb, 0 for the Julia form.
    constant_derivative: f64,
}

impl OrbitJacobian {
    /// Of an orbit's start.
    pub fn new(constant_derivative: f64) -> Self {
        Self { jacobian: DMat3::IDENTITY, constant_derivative }
    }

    /// Goes on from the place `z`.
    pub fn step(&mut self, power: &TriplexPower, z: DVec3) {
        let raising = power.jacobian(off_axis(z), DEEP_SIDEWAYS_MAX);
        self.jacobian =
            raising * self.jacobian + DMat3::from_diagonal(DVec3::splat(self.constant_derivative));
    }

    /// No less than any length that a unit vector is given.
    pub fn norm(&self) -> f64 {
        norm(&self.jacobian)
    }
}

/// The same in a frame that turns with the point's longitude. Longitudes count for nothing in it but
/// for how the constant turns: of that alone orbits hard by the axis know about them.
#[derive(Clone, Copy, Debug)]
pub struct RotatingJacobian {
    /// Of places, were it not for their longitudes.
    jacobian: DMat3,
    /// The gradient of the angle by which the constant turns back.
    frame: DVec3,
    constant_derivative: f64,
    /// The constant.
    constant: DVec3,
    /// The longest gradient of that angle: finer ripples are lower than anyone sees.
    most: f64,
}

impl RotatingJacobian {
    /// Of an orbit's start, seen from a frame in which fixed directions are turned by `back`; what
    /// ripples at a length below `grain`, in scene units, need not be known.
    pub fn new(constant: DVec3, constant_derivative: f64, back: DVec2, grain: f64) -> Self {
        let (jacobian, frame) = (about_axis(back), DVec3::ZERO);
        Self { jacobian, frame, constant_derivative, constant, most: 2.0 / grain }
    }

    /// Goes on from the place `z`, to a frame in which fixed directions are turned by `back`.
    pub fn step(&mut self, power: &TriplexPower, z: DVec3, back: DVec2) {
        let z = off_axis(z);
        let aside = z.truncate();
        let rho = aside.length().max(LEAST_RADIUS);
        // How the longitude moves with the point.
        let longitude = self.jacobian.transpose() * (aside.perp() / (rho * rho)).extend(0.0);
        let frame = (self.frame + longitude) * power.exponent();
        self.frame = frame.clamp_length_max(self.most);
        let around = self.constant.truncate().perp().extend(0.0);
        let added = DMat3::from_diagonal(DVec3::splat(self.constant_derivative))
            - DMat3::from_cols(around * self.frame.x, around * self.frame.y, around * self.frame.z);
        self.jacobian = power.jacobian(z, 0.0) * self.jacobian + about_axis(back) * added;
    }

    /// Goes on to a frame that is turned by another `rotor`.
    pub fn settle(&mut self, rotor: DVec2) {
        self.jacobian = about_axis(rotor).transpose() * self.jacobian;
    }

    /// As of [`OrbitJacobian`].
    pub fn norm(&self) -> f64 {
        norm(&self.jacobian)
    }
}

/// On the axis there is no longitude; close beside it, that of +x.
fn off_axis(z: DVec3) -> DVec3 {
    if z.x == 0.0 && z.y == 0.0 { z.with_x(LEAST_RADIUS) } else { z }
}

/// A turn about the polar axis.
fn about_axis(rotor: DVec2) -> DMat3 {
    DMat3::from_cols(rotor.extend(0.0), rotor.perp().extend(0.0), DVec3::Z)
}

/// A matrix's Frobenius norm.
pub fn norm(matrix: &DMat3) -> f64 {
    matrix.to_cols_array().into_iter().map(|part| part * part).sum::<f64>().sqrt()
}
