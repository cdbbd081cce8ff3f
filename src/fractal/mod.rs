//! A scene's fractal, prepared for interface, navigation and renderer.
//!
//! In: a [`Scene`](crate::scene::Scene). Out: its prepared fractal, rays through its pixels, anchors for
//! deep views. This layer uses neither GPU nor user interface; formulas are in [`crate::formula`].
//!
//! | file | contents |
//! |---|---|
//! | [`model`] | a fractal's distance fields, made once per edit |
//! | [`camera_ray`](mod@camera_ray) | camera rays through a picture's pixels |
//! | [`places`] | finds points of the surface that stay beautiful at every depth |
//! | [`shine`] | where light has to come from to reach a place |
//! | [`spiral`] | directions, and points of a disc, spread evenly |
//! | [`search`] | finds the anchor of a view |
//! | [`surprise`] | random scenes that are worth seeing |

pub mod camera_ray;
pub mod model;
pub mod places;
pub mod search;
pub mod shine;
pub mod spiral;
pub mod surprise;

pub use camera_ray::{camera_ray, ndc_of, pixel_cone};
pub use model::{FractalModel, SharedModel};
pub use search::Search;
pub use surprise::Surprise;
