//! Undo and redo of whole states, grouped by gesture.
//!
//! In: the state before each change (a scene or a [`Project`]). Out: the state to restore. This
//! module is pure data: no keyboard, no panels, no clock.

use std::collections::VecDeque;

use super::project::Project;

/// Maximum number of undo steps; older steps are dropped.
pub const MAX_STEPS: usize = 200;

/// Identifier of a gesture, such as a drag from press to release.
///
/// Consecutive changes with one identifier are undone together.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct GestureId(pub u64);

/// The undo and redo stacks.
#[derive(Clone, Debug)]
pub struct History<T = Project> {
    /// Earlier states; the most recent is last.
    past: VecDeque<T>,
    /// Undone states; the next one to redo is last.
    future: Vec<T>,
    /// The gesture of the last recorded change, until an undo or redo closes the gesture.
    open: Option<GestureId>,
}

impl<T: Clone> History<T> {
    /// An empty history.
    pub fn new() -> Self {
        Self { past: VecDeque::new(), future: Vec::new(), open: None }
    }

    /// A history with these undo steps, the most recent last; older ones than [`MAX_STEPS`] are dropped.
    pub fn with_past(steps: impl IntoIterator<Item = T>) -> Self {
        let mut past: VecDeque<T> = steps.into_iter().collect();
        past.drain(..past.len().saturating_sub(MAX_STEPS));
        Self { past, future: Vec::new(), open: None }
    }

    /// The undo steps, the most recent first.
    pub fn past(&self) -> impl Iterator<Item = &T> {
        self.past.iter().rev()
    }

    /// Records `before`, the state before a change, as an undo step.
    ///
    /// Call this for real changes only, before or after the change. Within one gesture only the
    /// first call adds a step; without a gesture every call does. Clears the redo stack.
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

    /// The previous state, to replace `present`; none at the beginning.
    pub fn undo(&mut self, present: &T) -> Option<T> {
        self.open = None;
        let earlier = self.past.pop_back()?;
        self.future.push(present.clone());
        Some(earlier)
    }

    /// The next undone state, to replace `present`; none at the end.
    pub fn redo(&mut self, present: &T) -> Option<T> {
        self.open = None;
        let later = self.future.pop()?;
        self.past.push_back(present.clone());
        Some(later)
    }

    /// True if there is a step to undo.
    pub fn can_undo(&self) -> bool {
        !self.past.is_empty()
    }

    /// True if there is a step to redo.
    pub fn can_redo(&self) -> bool {
        !self.future.is_empty()
    }
}

impl<T: Clone> Default for History<T> {
    fn default() -> Self {
        Self::new()
    }
}
