//! Undo and redo over whole scenes, grouped by gesture.
//!
//! In: the scene as it was before each change. Out: the scene to go back or forward to. Pure
//! data: it knows neither keys nor panels, and keeps no clock.

use std::collections::VecDeque;

use super::Scene;

/// The most steps back that are kept; older ones are forgotten.
pub const MAX_STEPS: usize = 200;

/// One gesture, such as a drag from press to release. Changes with the same id that follow
/// one another are undone together.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct GestureId(pub u64);

/// The scenes before and after the present one.
#[derive(Clone, Debug, Default)]
pub struct History {
    /// Earlier scenes, the latest last.
    past: VecDeque<Scene>,
    /// Scenes that were undone, the next one last.
    future: Vec<Scene>,
    /// The gesture of the last recorded change, while further changes may join it.
    open: Option<GestureId>,
}

impl History {
    /// Nothing to undo or redo.
    pub fn new() -> Self {
        Self::default()
    }

    /// Notes that `before` is about to change, or just has. Call it for real changes only.
    /// Within one gesture only the first call counts; without one, every call is a step of its
    /// own. What was undone can no longer be redone.
    pub fn record(&mut self, before: &Scene, gesture: Option<GestureId>) {
        self.future.clear();
        if gesture.is_some() && gesture == self.open {
            return;
        }
        self.open = gesture;
        if self.past.len() == MAX_STEPS {
            self.past.pop_front();
        }
        self.past.push_back(before.clone());
    }

    /// The scene one step back, to replace `present`; none at the beginning.
    pub fn undo(&mut self, present: &Scene) -> Option<Scene> {
        self.open = None;
        let earlier = self.past.pop_back()?;
        self.future.push(present.clone());
        Some(earlier)
    }

    /// The scene one step forward again, to replace `present`; none at the end.
    pub fn redo(&mut self, present: &Scene) -> Option<Scene> {
        self.open = None;
        let later = self.future.pop()?;
        self.past.push_back(present.clone());
        Some(later)
    }

    /// Whether there is a step back.
    pub fn can_undo(&self) -> bool {
        !self.past.is_empty()
    }

    /// Whether there is a step forward.
    pub fn can_redo(&self) -> bool {
        !self.future.is_empty()
    }
}
