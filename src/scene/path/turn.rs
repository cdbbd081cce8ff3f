//! Orientations and directions: shortest arcs on spheres.

use glam::{DQuat, DVec3, DVec4};

use super::curve::Space;

/// Rotations. Both signs of a quaternion are one rotation, so every arc is the shorter one.
pub struct Turns;

impl Space for Turns {
    type Point = DQuat;

    fn between(&self, a: &DQuat, b: &DQuat, part: f64) -> DQuat {
        self.after(a, self.velocity(a, b) * part)
    }

    fn velocity(&self, a: &DQuat, b: &DQuat) -> DVec4 {
        let turn = a.inverse() * *b;
        let turn = if turn.w < 0.0 { -turn } else { turn };
        let sine = turn.xyz().length();
        if sine == 0.0 {
            return DVec4::ZERO;
        }
        (turn.xyz() / sine * (2.0 * sine.atan2(turn.w))).extend(0.0)
    }

    fn after(&self, a: &DQuat, velocity: DVec4) -> DQuat {
        let angle = velocity.length();
        if angle == 0.0 {
            return *a;
        }
        (*a * DQuat::from_axis_angle(velocity.truncate() / angle, angle)).normalize()
    }
}

/// Unit vectors.
pub struct Directions;

impl Space for Directions {
    type Point = DVec3;

    fn between(&self, a: &DVec3, b: &DVec3, part: f64) -> DVec3 {
        if a == b { *a } else { self.after(a, self.velocity(a, b) * part) }
    }

    fn velocity(&self, a: &DVec3, b: &DVec3) -> DVec4 {
        // Between opposite directions any great circle is shortest: one is chosen.
        let aside = (*b - *a * a.dot(*b)).try_normalize().unwrap_or(a.any_orthonormal_vector());
        // The angle by halves (Kahan): the arc cosine is coarse for small ones.
        (aside * (2.0 * (*a - *b).length().atan2((*a + *b).length()))).extend(0.0)
    }

    fn after(&self, a: &DVec3, velocity: DVec4) -> DVec3 {
        let angle = velocity.length();
        if angle == 0.0 {
            return *a;
        }
        (*a * angle.cos() + velocity.truncate() / angle * angle.sin()).normalize()
    }
}
