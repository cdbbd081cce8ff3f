//! Find places: pins on the surface from which dives stay beautiful.
//!
//! In: the scene, its prepared fractal, the picture's frame, and small pictures that the shell has drawn. Out:
//! pins over the picture, the small pictures that they want, and the pin that was chosen. The search
//! runs in slices of a frame, while the camera stands still.
//!
//! | file | contents |
//! |---|---|
//! | `show` | how pins and words are drawn |
//! | `state` | whether there is a search, and its pins |
//! | `pin_search` | the search for places of one view, in slices |
//! | `pin` | one place with its view and picture |
//! | `arrange` | where the pictures stand |

mod arrange;
mod pin;
mod pin_search;
mod show;
mod state;

pub use show::{PinInputs, show};
pub use state::Places;
