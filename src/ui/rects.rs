//! Where the key widgets stand: for tests that drive the page from outside, where no
//! accessibility tree exists.

use std::collections::BTreeMap;

use egui::{Rect, Response};

/// Named widgets of the last frame and their rectangles, in points from the window's upper left.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Rects(BTreeMap<&'static str, Rect>);

impl Rects {
    /// Forgets the last frame.
    pub(super) fn clear(&mut self) {
        self.0.clear();
    }

    /// Notes where a widget is; it may lie outside the window where it is scrolled away.
    pub(super) fn note(&mut self, name: &'static str, response: &Response) {
        self.0.insert(name, response.rect);
    }

    /// The widget's rectangle; none where it isn't shown.
    pub fn get(&self, name: &str) -> Option<Rect> {
        self.0.get(name).copied()
    }

    /// All of them, by name.
    pub fn iter(&self) -> impl Iterator<Item = (&'static str, Rect)> + '_ {
        self.0.iter().map(|(&name, &rect)| (name, rect))
    }
}
