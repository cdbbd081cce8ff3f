//! Two hints on the picture at a first visit, each of which goes once it was followed.
//!
//! In: whether the visitor turned the view or came closer. Out: a line of text, until both were done.

use egui::{Response, Ui};
use serde::{Deserialize, Serialize};

use super::floating::{self, CaptionArea};
use crate::scene::Camera;

/// The hints that a visitor has followed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct Hints {
    /// True once the visitor has turned the view.
    pub has_turned: bool,
    /// True once the visitor has come closer or gone back.
    pub has_zoomed: bool,
}

impl Hints {
    /// Notes how the visitor moved the camera: by scrolling or pinching, or by a drag.
    pub fn note(&mut self, before: &Camera, after: &Camera, is_zoom: bool) {
        if is_zoom {
            self.has_zoomed |= before.position != after.position;
        } else {
            self.has_turned |= before.orientation != after.orientation;
        }
    }

    /// The line of the hints that are left; none after both.
    fn text(self, has_touch: bool) -> Option<String> {
        let turn = "Drag to turn";
        let zoom = if has_touch { "Pinch to come closer" } else { "Scroll to come closer" };
        match (self.has_turned, self.has_zoomed) {
            (false, false) => Some(format!("{turn}  ·  {zoom}")),
            (false, true) => Some(turn.to_owned()),
            (true, false) => Some(zoom.to_owned()),
            (true, true) => None,
        }
    }

    /// Shows the hints that are left over the picture, worded for fingers or a mouse.
    pub fn show(self, ui: &Ui, area: CaptionArea, has_touch: bool) -> Option<Response> {
        Some(floating::clear_caption(ui, area, &self.text(has_touch)?))
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    #[test]
    fn each_hint_goes_once_it_was_followed() {
        let start = Camera::default();
        let mut hints = Hints::default();
        for is_zoom in [false, true] {
            hints.note(&start, &start, is_zoom);
        }
        assert_eq!(hints, Hints::default());
        let closer =
            Camera { position: start.position.moved_by(DVec3::Y * 0.3, 0.0), ..start.clone() };
        hints.note(&start, &closer, true);
        assert_eq!(hints.text(false).as_deref(), Some("Drag to turn"));
        let turned = Camera::looking_at(DVec3::new(3.0, 1.0, 1.0), DVec3::ZERO, DVec3::Z);
        hints.note(&closer, &turned, false);
        assert_eq!(hints.text(true), None);
    }
}
