//! Where Home leads: to the scene's opening view, and out of one that is deep itself.
//!
//! In: the camera and the opening one. Out: the way, and what its button shows. Moves nothing.

use super::{icon::Icon, status::zoom};
use crate::scene::Camera;

/// An opening view at least this much larger than a new scene's is itself a place to come out of.
const DEEP_ZOOM: f64 = 10.0;

/// Where Home leads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum HomeTarget {
    /// To the scene's opening view.
    Opening,
    /// From a deep opening view, such as a dive's, out to all of the fractal.
    Whole,
}

impl HomeTarget {
    /// Where Home leads from `camera`; none from an opening view that shows the whole already.
    pub fn of(camera: &Camera, home: &Camera) -> Option<Self> {
        // Stereo is of the screen that one sits before, not of the place.
        let is_there = *camera == Camera { stereo: camera.stereo.clone(), ..home.clone() };
        match is_there {
            false => Some(Self::Opening),
            true if zoom(home) >= DEEP_ZOOM => Some(Self::Whole),
            true => None,
        }
    }

    /// The icon, the name and the explanation of its button.
    pub fn button(self) -> (Icon, (&'static str, &'static str)) {
        match self {
            Self::Opening => (Icon::Home, ("Home", "Back to the scene's opening view (H)")),
            Self::Whole => (Icon::Whole, ("Out", "Out to all of the fractal (H)")),
        }
    }
}
