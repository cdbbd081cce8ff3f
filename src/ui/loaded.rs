//! What people opened besides scenes: an environment map, and gradients.

use std::sync::Arc;

use super::{editor::Editor, selection::LayerRef};
use crate::scene::{EnvironmentMap, Scene, gradient::NamedGradient};

/// The environment map and the gradients of the last files.
#[derive(Debug, Default)]
pub struct Loaded {
    /// The loaded environment map, if any.
    environment_map: Option<Arc<EnvironmentMap>>,
    /// The gradients of the last gradient file.
    pub gradients: Vec<NamedGradient>,
}

impl Loaded {
    /// Lights the scene by an environment map, as one undo step.
    pub fn use_environment_map(&mut self, editor: &mut Editor, map: Arc<EnvironmentMap>) {
        let mut project = editor.project().clone();
        project.scene.surround_by(&map);
        editor.replace(project);
        self.environment_map = Some(map);
    }

    /// Colours `layer` with the first of `gradients`, as one undo step, and keeps all for the list.
    pub fn use_gradients(
        &mut self,
        editor: &mut Editor,
        layer: LayerRef,
        gradients: Vec<NamedGradient>,
    ) {
        if let Some(first) = gradients.first() {
            let mut project = editor.project().clone();
            let (_, stops) = layer.of(&mut project.scene.surface);
            stops.clone_from(&first.stops);
            editor.replace(project);
        }
        self.gradients = gradients;
    }

    /// The loaded environment map, if `scene` names it.
    pub fn environment_map(&self, scene: &Scene) -> Option<&Arc<EnvironmentMap>> {
        let name = &scene.lights.rig.environment_map.name;
        self.environment_map.as_ref().filter(|map| map.name() == name)
    }

    /// The loaded environment map.
    pub fn any_environment_map(&self) -> Option<&EnvironmentMap> {
        self.environment_map.as_deref()
    }
}
