//! Positions of named widgets, for tests and for what is placed beside them.

use std::collections::BTreeMap;

use egui::{Rect, Response};

/// Rectangles of named widgets in the last frame, in points.
///
/// The origin is the window's upper left corner.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Rects(BTreeMap<&'static str, Rect>);

impl Rects {
    /// Removes the last frame's rectangles.
    pub(super) fn clear(&mut self) {
        self.0.clear();
    }

    /// Stores the rectangle of a widget, which may be scrolled out of the window.
    pub(super) fn record(&mut self, name: &'static str, response: &Response) {
        self.record_rect(name, response.rect);
    }

    /// Stores a rectangle under a name.
    pub(super) fn record_rect(&mut self, name: &'static str, rect: Rect) {
        self.0.insert(name, rect);
    }

    /// The widget's rectangle, if the widget is shown.
    pub fn get(&self, name: &str) -> Option<Rect> {
        self.0.get(name).copied()
    }

    /// All widgets and their rectangles, ordered by name.
    pub fn iter(&self) -> impl Iterator<Item = (&'static str, Rect)> + '_ {
        self.0.iter().map(|(&name, &rect)| (name, rect))
    }
}
