//! The equirectangular projection: directions and their positions in a map.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

/// Position in the map: 0 to 1 from the left and from the upper edge.
pub type Uv = [f64; 2];

/// The unit vector toward the map's position `[u, v]`.
pub fn direction_from_uv([u, v]: Uv) -> DVec3 {
    let (sin_azimuth, cos_azimuth) = ((u - 0.5) * TAU).sin_cos();
    let (sin_polar, cos_polar) = (v * PI).sin_cos();
    DVec3::new(sin_polar * sin_azimuth, sin_polar * cos_azimuth, cos_polar)
}

/// The map's position that `direction`, of any length but 0, points at.
pub fn uv_from_direction(direction: DVec3) -> Uv {
    let azimuth = direction.x.atan2(direction.y);
    let polar = direction.truncate().length().atan2(direction.z);
    [azimuth / TAU + 0.5, polar / PI]
}
