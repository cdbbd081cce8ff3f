//! The selected light and gradient stop.

use crate::scene::Lights;

/// The selected light and gradient stop, which are not part of a scene.
#[derive(Clone, Copy, Debug, Default)]
pub struct Selection {
    /// The selected light; none if the scene has no light or none is chosen yet.
    pub light: Option<LightRef>,
    /// Index of the selected stop of the surface's gradient.
    pub stop: usize,
}

/// A reference to a light of the scene, by its index.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LightRef {
    /// A directional light.
    Environment(usize),
    /// A point light.
    Point(usize),
}

impl LightRef {
    /// True if the scene has this light.
    pub fn exists(self, lights: &Lights) -> bool {
        match self {
            Self::Environment(index) => index < lights.environment.len(),
            Self::Point(index) => index < lights.point.len(),
        }
    }

    /// The light's name in the list of lights.
    pub fn name(self) -> String {
        match self {
            Self::Environment(index) => format!("Light {}", index + 1),
            Self::Point(index) => format!("Point {}", index + 1),
        }
    }
}
