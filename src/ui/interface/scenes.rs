//! Other scenes in view: presets, kept views, surprises, each reached by a flight; and looks of the finder.

use super::Interface;
use crate::{
    scene::{Project, Scene, document, looks, presets},
    ui::{action::Action, selection::Selection},
};

impl Interface {
    /// Flies to a preset's view.
    pub(super) fn choose_preset(&mut self, index: usize) {
        if let Some(preset) = presets::all().nth(index) {
            self.fly_into_scene((preset.scene)());
        }
    }

    /// Applies the look of a list, both by their numbers.
    pub(super) fn apply_look(&mut self, [list, index]: [usize; 2]) {
        let Some(look) = looks::lists().get(list).and_then(|list| list.looks.get(index)) else {
            return;
        };
        if look.lights.is_some() {
            self.selection.light = None;
        }
        looks::apply(look, self.editor.scene_mut());
    }

    /// Flies to a scene's view, but keeps the quality settings and the path.
    ///
    /// Quality depends on the user's machine, and the scene may become a key of the path.
    pub(super) fn fly_into_scene(&mut self, mut scene: Scene) {
        scene.quality = self.scene().quality.clone();
        let path = self.project().path.clone();
        self.fly_into(Project { scene, path });
    }

    /// Flies to a kept view.
    pub(super) fn open_favourite(&mut self, index: usize, actions: &mut Vec<Action>) {
        let Some(kept) = self.favourites.list().get(index) else { return };
        let read = document::project_from_json(&kept.document);
        // One that cannot be read is marked too, so that it can be removed.
        self.favourites.opened = Some(index);
        match read {
            Ok(project) => self.fly_into(project),
            Err(_) => actions.push(Action::ReportUnreadableFavourite),
        }
    }

    /// Shows the chosen one of two compared states, without a flight, as one undo step.
    pub(super) fn show_state(&mut self, state: Option<Project>) {
        if let Some(project) = state {
            self.pilot.cancel();
            self.timeline.stop();
            self.editor.replace(project);
        }
    }

    /// Shows a project by a flight to its view, as one undo step.
    pub fn fly_into(&mut self, project: Project) {
        let Project { mut scene, path } = project;
        self.selection = Selection::default();
        self.home = scene.camera.clone();
        self.pilot.cancel();
        self.places.put_away();
        self.timeline.stop();
        let current = self.scene();
        if *current == scene && self.project().path == path {
            return;
        }
        let is_same_set = current.fractal == scene.fractal;
        let from = is_same_set.then(|| current.camera.clone());
        if let Some(frame) = self.frame {
            self.pilot.arrive(&mut scene, frame, from.as_ref());
        }
        self.editor.replace_and_move(Project { scene, path });
    }
}
