//! The Jacobian of a deep orbit by its point; its norm sets a ray's step.

use glam::{DMat3, DVec2, DVec3};

use crate::formula::{
    mandelbulb::{estimator::DEEP_SIDEWAYS_MAX, power::TriplexPower},
    recurrence::norm,
};

/// Replaces a distance of zero from the axis.
const MIN_RADIUS: f64 = 1e-100;

/// Jacobian of an orbit's current position by its starting point.
#[derive(Clone, Copy, Debug)]
pub struct OrbitJacobian {
    jacobian: DMat3,
    /// Derivative of the constant by the point: 1 for the Mandelbulb, 0 for the Julia form.
    constant_derivative: f64,
}

impl OrbitJacobian {
    /// The Jacobian at an orbit's start.
    pub fn new(constant_derivative: f64) -> Self {
        Self { jacobian: DMat3::IDENTITY, constant_derivative }
    }

    /// Advances by the step from orbit position `z`.
    pub fn step(&mut self, power: &TriplexPower, z: DVec3) {
        let raising = power.jacobian(off_axis(z), DEEP_SIDEWAYS_MAX);
        self.jacobian =
            raising * self.jacobian + DMat3::from_diagonal(DVec3::splat(self.constant_derivative));
    }

    /// The Frobenius norm: at least the length to which the Jacobian maps any unit vector.
    pub fn norm(&self) -> f64 {
        norm(&self.jacobian)
    }
}

/// The orbit's Jacobian in a frame that rotates with the point's longitude.
///
/// In this frame longitudes matter only where they rotate the constant: orbits close to the axis depend on
/// their longitude in no other way.
#[derive(Clone, Copy, Debug)]
pub struct RotatingJacobian {
    /// Derivative of orbit positions by the point, without their longitudes.
    jacobian: DMat3,
    /// The gradient of the angle by which the constant rotates back.
    turn: DVec3,
    constant_derivative: f64,
    /// The constant that each step adds.
    constant: DVec3,
    /// Greatest length of that gradient: finer ripples are too low to see.
    most: f64,
}

impl RotatingJacobian {
    /// The Jacobian at an orbit's start; the frame rotates fixed directions by `back`.
    ///
    /// Ripples shorter than `grain`, in scene units, are ignored.
    pub fn new(constant: DVec3, constant_derivative: f64, back: DVec2, grain: f64) -> Self {
        let (jacobian, turn) = (about_axis(back), DVec3::ZERO);
        Self { jacobian, turn, constant_derivative, constant, most: 2.0 / grain }
    }

    /// Advances by the step from `z`; the new frame rotates fixed directions by `back`.
    pub fn step(&mut self, power: &TriplexPower, z: DVec3, back: DVec2) {
        let z = off_axis(z);
        let aside = z.truncate();
        let rho = aside.length().max(MIN_RADIUS);
        // Gradient of the longitude by the point.
        let longitude = self.jacobian.transpose() * (aside.perp() / (rho * rho)).extend(0.0);
        let turn = (self.turn + longitude) * power.exponent();
        self.turn = turn.clamp_length_max(self.most);
        let around = self.constant.truncate().perp().extend(0.0);
        let added = DMat3::from_diagonal(DVec3::splat(self.constant_derivative))
            - DMat3::from_cols(around * self.turn.x, around * self.turn.y, around * self.turn.z);
        self.jacobian = power.jacobian(z, 0.0) * self.jacobian + about_axis(back) * added;
    }

    /// Changes to a frame rotated by another `rotor`.
    pub fn settle(&mut self, rotor: DVec2) {
        self.jacobian = about_axis(rotor).transpose() * self.jacobian;
    }

    /// The Frobenius norm, as in [`OrbitJacobian::norm`].
    pub fn norm(&self) -> f64 {
        norm(&self.jacobian)
    }
}

/// `z`, moved off the axis toward +x if on it: the axis has no longitude.
fn off_axis(z: DVec3) -> DVec3 {
    if z.x == 0.0 && z.y == 0.0 { z.with_x(MIN_RADIUS) } else { z }
}

/// The rotation about the polar axis by `rotor`.
fn about_axis(rotor: DVec2) -> DMat3 {
    DMat3::from_cols(rotor.extend(0.0), rotor.perp().extend(0.0), DVec3::Z)
}
