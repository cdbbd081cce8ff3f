//! What has to hold of deep views whatever is seen in them. That it is the right thing, the module
//! `deep` tests, which has another arithmetic to compare with.
//!
//! | file | contents |
//! |---|---|
//! | `places` | where the views are, and their passes in coordinates of one's choice |
//! | `anchors` | another anchor makes no other picture, and none at all the same |
//! | `light` | normals of every kind and shadows of every light, against the field in f64 |
//! | `files` | stills in tiles, OpenEXR, sequences, links and documents, two eyes |
//! | `moving` | a dive from the whole scene to 1e-20 in a view that moves |

mod anchors;
mod files;
mod light;
mod moving;
mod places;
