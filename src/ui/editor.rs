//! The edited scene and path, and their undo history.
//!
//! Panels change the project in place. Once per frame, the editor compares the project with its
//! state at the frame's start and records a change. All changes of one gesture (a drag, a flight, a
//! sequence of wheel notches) become one step.

use crate::scene::{
    Project, Scene,
    history::{GestureId, History},
};

/// A project with its history.
#[derive(Clone, Debug)]
pub struct Editor {
    project: Project,
    history: History,
    gesture: GestureId,
    last_change_secs: f64,
}

impl Editor {
    /// An editor of `project` with an empty history.
    pub fn new(project: Project) -> Self {
        Self {
            project,
            history: History::new(),
            gesture: GestureId(0),
            last_change_secs: f64::NEG_INFINITY,
        }
    }

    /// Replaces the history by undo steps of an earlier visit, the most recent last.
    pub fn restore_steps(&mut self, steps: impl IntoIterator<Item = Project>) {
        self.history = History::with_past(steps);
    }

    /// The undo steps, the most recent first.
    pub fn steps(&self) -> impl Iterator<Item = &Project> {
        self.history.past()
    }

    /// The current scene and path.
    pub fn project(&self) -> &Project {
        &self.project
    }

    /// The current scene.
    pub fn scene(&self) -> &Scene {
        &self.project.scene
    }

    /// The scene, for panels; [`Self::record_changes`] must follow in the same frame.
    pub(super) fn scene_mut(&mut self) -> &mut Scene {
        &mut self.project.scene
    }

    /// The scene and the path; [`Self::record_changes`] must follow in the same frame.
    pub(super) fn project_mut(&mut self) -> &mut Project {
        &mut self.project
    }

    /// Replaces the scene in view by a scene of the path.
    ///
    /// If the old scene `was_on_path`, the path can restore it, so no undo step is necessary.
    /// Otherwise the old scene becomes an undo step, or a part of the current gesture.
    pub(super) fn show(&mut self, scene: Scene, was_on_path: bool) {
        if scene == self.project.scene {
            return;
        }
        if !was_on_path {
            self.history.record(&self.project, Some(self.gesture));
        }
        self.project.scene = scene;
    }

    /// Replaces the project as one undo step.
    pub fn replace(&mut self, project: Project) {
        if project != self.project {
            self.next_gesture();
            let before = std::mem::replace(&mut self.project, project);
            self.history.record(&before, None);
        }
    }

    /// Replaces the project by the start of a movement, which joins the undo step.
    pub(super) fn replace_and_move(&mut self, project: Project) {
        self.next_gesture();
        let before = std::mem::replace(&mut self.project, project);
        self.history.record(&before, Some(self.gesture));
    }

    /// Records the changes since `before`. Changes `during_gesture` join one undo step.
    pub(super) fn record_changes(&mut self, before: &Project, during_gesture: bool, now_secs: f64) {
        if self.project != *before {
            self.history.record(before, Some(self.gesture));
            self.last_change_secs = now_secs;
        }
        if !during_gesture {
            self.next_gesture();
        }
    }

    /// Ends the current undo step; later changes start a new step.
    pub(super) fn next_gesture(&mut self) {
        self.gesture.0 += 1;
    }

    /// Seconds since the user's last change.
    pub(super) fn secs_since_change(&self, now_secs: f64) -> f64 {
        now_secs - self.last_change_secs
    }

    /// Undoes one step, if any.
    pub fn undo(&mut self) {
        self.next_gesture();
        if let Some(project) = self.history.undo(&self.project) {
            self.project = project;
        }
    }

    /// Redoes one step, if any.
    pub fn redo(&mut self) {
        self.next_gesture();
        if let Some(project) = self.history.redo(&self.project) {
            self.project = project;
        }
    }

    /// True if there is a step to undo.
    pub fn can_undo(&self) -> bool {
        self.history.can_undo()
    }

    /// True if there is a step to redo.
    pub fn can_redo(&self) -> bool {
        self.history.can_redo()
    }
}
