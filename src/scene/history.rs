//! Undo and redo over whole states, grouped by gesture.
//!
//! In: the state as it was before each change, a scene or a [`Project`]. Out: the state to go
//! back or forward to. Pure data: it knows neither keys nor panels, and keeps no clock.

use std::collections::VecDeque;

use super::Project;

/// The most steps back that are kept; older ones are forgotten.
pub const MAX_STEPS: usize = 200;

/// One gesture, such as a drag from press to release. Changes with the same id that follow
/// one another are undone together.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct GestureId(pub u64);

/// The states before and after the present one.
#[derive(Clone, Debug)]
pub struct History<T = Project> {
    /// Earlier states, the latest last.
    past: VecDeque<T>,
    /// States that were undone, the next one last.
    future: Vec<T>,
    /// The gesture of the last recorded change, while further changes may join it.
    open: Option<GestureId>,
}

impl<T: Clone> History<T> {
    /// Nothing to undo or redo.
    pub fn new() -> Self {
        Self { past: VecDeque::new(), future: Vec::new(), open: None }
    }

    /// Notes that `before` is about to change, or just has. Call it for real changes only.
    /// Within one gesture only the first call counts; without one, every call is a step of its
    /// own. What was undone can no longer be redone.
    pub fn record(&mut self, before: &T, gesture: Option<GestureId>) {
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

    /// The state one step back, to replace `present`; none at the beginning.
    pub fn undo(&mut self, present: &T) -> Option<T> {
        self.open = None;
        let earlier = self.past.pop_back()?;
        self.future.push(present.clone());
        Some(earlier)
    }

    /// The state one step forward again, to replace `present`; none at the end.
    pub fn redo(&mut self, present: &T) -> Option<T> {
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

impl<T: Clone> Default for History<T> {
    fn default() -> Self {
        Self::new()
    }
}
