//! The contents of a document: the scene in view and the camera path.

use super::{description::Scene, path::Path};

/// A scene and its camera path.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Project {
    /// The scene in view.
    pub scene: Scene,
    /// The camera path; empty by default.
    pub path: Path,
}

impl From<Scene> for Project {
    fn from(scene: Scene) -> Self {
        Self { scene, path: Path::default() }
    }
}
