//! Geodesics of rotations and of directions.

use glam::{DQuat, DVec3, DVec4};

use super::curve::Space;

/// The space of rotations.
///
/// Both signs of a quaternion are one rotation; geodesics take the shorter of both arcs.
pub struct Rotations;

impl Space for Rotations {
    type Point = DQuat;

    fn between(&self, a: &DQuat, b: &DQuat, part: f64) -> DQuat {
        self.after(a, self.velocity(a, b) * part)
    }

    fn velocity(&self, a: &DQuat, b: &DQuat) -> DVec4 {
        let rotation = a.inverse() * *b;
        let rotation = if rotation.w < 0.0 { -rotation } else { rotation };
        let sine = rotation.xyz().length();
        if sine == 0.0 {
            return DVec4::ZERO;
        }
        (rotation.xyz() / sine * (2.0 * sine.atan2(rotation.w))).extend(0.0)
    }

    fn after(&self, a: &DQuat, velocity: DVec4) -> DQuat {
        let angle = velocity.length();
        if angle == 0.0 {
            return *a;
        }
        (*a * DQuat::from_axis_angle(velocity.truncate() / angle, angle)).normalize()
    }
}

/// The space of unit vectors: the sphere.
pub struct Directions;

impl Space for Directions {
    type Point = DVec3;

    fn between(&self, a: &DVec3, b: &DVec3, part: f64) -> DVec3 {
        if a == b { *a } else { self.after(a, self.velocity(a, b) * part) }
    }

    fn velocity(&self, a: &DVec3, b: &DVec3) -> DVec4 {
        // Between opposite directions every great circle is a geodesic; one is chosen.
        let tangent = (*b - *a * a.dot(*b)).try_normalize().unwrap_or(a.any_orthonormal_vector());
        // Kahan's formula of the half angle; the arc cosine is inaccurate for small angles.
        (tangent * (2.0 * (*a - *b).length().atan2((*a + *b).length()))).extend(0.0)
    }

    fn after(&self, a: &DVec3, velocity: DVec4) -> DVec3 {
        let angle = velocity.length();
        if angle == 0.0 {
            return *a;
        }
        (*a * angle.cos() + velocity.truncate() / angle * angle.sin()).normalize()
    }
}
