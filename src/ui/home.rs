//! The target of the Home button: the scene's opening view, or the whole fractal.
//!
//! In: the current camera and the opening camera. Out: the target, and the button's content.

use super::{icon::Icon, status::zoom};
use crate::scene::Camera;

/// Zoom from which on an opening view counts as deep: Home then also leads out of it.
const DEEP_ZOOM: f64 = 10.0;

/// The target of Home.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum HomeTarget {
    /// The scene's opening view.
    Opening,
    /// The whole fractal, from a deep opening view such as a dive's.
    Whole,
}

impl HomeTarget {
    /// The target from `camera`; none at an opening view that is not deep.
    pub fn of(camera: &Camera, home: &Camera) -> Option<Self> {
        // Lens and stereo settings do not describe the view, so they are ignored.
        let Camera { lens, stereo, .. } = camera.clone();
        let is_home = *camera == Camera { lens, stereo, ..home.clone() };
        match is_home {
            false => Some(Self::Opening),
            true if zoom(home) >= DEEP_ZOOM => Some(Self::Whole),
            true => None,
        }
    }

    /// The icon, the name and the hover text of the button.
    pub fn button(self) -> (Icon, (&'static str, &'static str)) {
        match self {
            Self::Opening => (Icon::Home, ("Home", "Fly back to the scene's first view (H)")),
            Self::Whole => (Icon::Whole, ("Out", "Fly out until the whole fractal is visible (H)")),
        }
    }
}
