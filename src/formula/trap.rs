//! Orbit traps: shapes whose least distance from an orbit selects a colour.

use glam::DVec3;

/// The distance of an orbit from a trap that counts as farthest.
pub const MAX_TRAP: f64 = 2.0;

/// The shape of an orbit trap.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TrapShape {
    /// The centre.
    Point,
    /// The line through the centre along the axis.
    Axis,
    /// The plane through the centre across the axis.
    Plane,
    /// The surface of a sphere; the size is its radius.
    Sphere,
    /// The surface of a cube along the axes; the size is half its width.
    Cube,
}

/// An orbit trap, in scene units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trap {
    /// The shape.
    pub shape: TrapShape,
    /// The centre.
    pub center: DVec3,
    /// The direction of lines, and of planes' normals; a unit vector.
    pub axis: DVec3,
    /// The size of spheres and cubes.
    pub size: f64,
}

impl Trap {
    /// The distance of a point of an orbit from the trap. The WGSL twin is `shaders/lib/trap.wgsl`.
    pub fn distance(&self, z: DVec3) -> f64 {
        let away = z - self.center;
        match self.shape {
            TrapShape::Point => away.length(),
            TrapShape::Axis => away.cross(self.axis).length(),
            TrapShape::Plane => away.dot(self.axis).abs(),
            TrapShape::Sphere => (away.length() - self.size).abs(),
            TrapShape::Cube => {
                let beyond = away.abs() - self.size;
                (beyond.max(DVec3::ZERO).length() + beyond.max_element().min(0.0)).abs()
            }
        }
    }
}
