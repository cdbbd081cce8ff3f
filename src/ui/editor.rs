//! The scene and the path under edit, and their undo history.
//!
//! Panels change them in place. Once a frame the session compares them with the frame's
//! start and records what changed; all changes of one gesture (a drag, a flight, a run of
//! wheel notches) become one step.

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
    /// A session that starts at `project`, with nothing to undo.
    pub fn new(project: Project) -> Self {
        Self {
            project,
            history: History::new(),
            gesture: GestureId(0),
            last_change_secs: f64::NEG_INFINITY,
        }
    }

    /// The scene and the path as they are now.
    pub fn project(&self) -> &Project {
        &self.project
    }

    /// The scene as it is now.
    pub fn scene(&self) -> &Scene {
        &self.project.scene
    }

    /// The scene, for the panels; [`Self::note_changes`] must follow in the same frame.
    pub(super) fn scene_mut(&mut self) -> &mut Scene {
        &mut self.project.scene
    }

    /// Scene and path, for the timeline; as [`Self::scene_mut`].
    pub(super) fn project_mut(&mut self) -> &mut Project {
        &mut self.project
    }

    /// Puts a moment of the path in view. Where the view before `can_be_made_again` from the
    /// path, nothing is lost and there is nothing to undo; otherwise it is a step of the history,
    /// or a part of the gesture under way.
    pub(super) fn show(&mut self, scene: Scene, can_be_made_again: bool) {
        if scene == self.project.scene {
            return;
        }
        if !can_be_made_again {
            self.history.record(&self.project, Some(self.gesture));
        }
        self.project.scene = scene;
    }

    /// Puts another project in its place, as one step that can be undone.
    pub fn replace(&mut self, project: Project) {
        if project != self.project {
            self.next_gesture();
            let before = std::mem::replace(&mut self.project, project);
            self.history.record(&before, None);
        }
    }

    /// Records what has changed since `before`. Changes made `during_gesture` join one step.
    pub(super) fn note_changes(&mut self, before: &Project, during_gesture: bool, now_secs: f64) {
        if self.project != *before {
            self.history.record(before, Some(self.gesture));
            self.last_change_secs = now_secs;
        }
        if !during_gesture {
            self.next_gesture();
        }
    }

    /// Ends the step that later changes would have joined.
    pub(super) fn next_gesture(&mut self) {
        self.gesture.0 += 1;
    }

    /// Seconds since the last change made by hand.
    pub(super) fn secs_since_change(&self, now_secs: f64) -> f64 {
        now_secs - self.last_change_secs
    }

    /// Goes one step back, where there is one.
    pub fn undo(&mut self) {
        self.next_gesture();
        if let Some(project) = self.history.undo(&self.project) {
            self.project = project;
        }
    }

    /// Goes one step forward again, where there is one.
    pub fn redo(&mut self) {
        self.next_gesture();
        if let Some(project) = self.history.redo(&self.project) {
            self.project = project;
        }
    }

    /// Whether there is a step back.
    pub fn can_undo(&self) -> bool {
        self.history.can_undo()
    }

    /// Whether there is a step forward.
    pub fn can_redo(&self) -> bool {
        self.history.can_redo()
    }
}
