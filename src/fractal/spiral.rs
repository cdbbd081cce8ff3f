//! Spirals by the golden angle: directions, and points of a disc, spread evenly.

use glam::{DVec2, DVec3};

/// Angle from each point of a spiral to the next.
pub const GOLDEN_ANGLE_RAD: f64 = 2.399_963_229_728_653;

/// `count` unit vectors, spread evenly over the sphere.
pub fn directions(count: u32) -> impl Iterator<Item = DVec3> {
    (0..count).map(move |index| {
        let z = 1.0 - (2.0 * f64::from(index) + 1.0) / f64::from(count);
        let (sin, cos) = (GOLDEN_ANGLE_RAD * f64::from(index)).sin_cos();
        let radius = (1.0 - z * z).sqrt();
        DVec3::new(radius * cos, radius * sin, z)
    })
}

/// The `index`-th point of the unit disc, from its centre outward; the `last`-th is on the edge.
pub fn in_disc(index: u32, last: u32) -> DVec2 {
    let radius = (f64::from(index) / f64::from(last.max(1))).sqrt();
    radius * DVec2::from_angle(f64::from(index) * GOLDEN_ANGLE_RAD)
}
