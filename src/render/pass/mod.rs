//! One file per pass, named like its shader in `shaders/pass/`.
//!
//! Each file declares what the pass binds, when a frame has the pass, and how it is dispatched. To add a
//! pass, add its two files, and here its module and its entry in [`DIRECT`], [`PATH`], [`PATH_IN_MEDIUM`] or [`DISPLAY`].

pub mod assess_noise;
pub mod bloom;
pub mod blur;
pub mod camera_cone;
pub mod camera_rays;
pub mod color_histogram;
pub mod compact_hits;
pub mod denoise;
pub mod denoise_input;
pub mod expose;
pub mod fill;
pub mod film_paths;
pub mod histogram;
pub mod indirect;
pub mod march;
pub mod mean;
pub mod normal;
pub mod reduce;
pub mod scatter;
pub mod shade;
pub mod shadow;
pub mod shadow_cone;
pub mod shutter;
pub mod tone;
pub mod tonemap_sparse;
pub mod track;
pub mod upsample;

use std::sync::LazyLock;

pub use super::recorder::{ONE_MODE, Pass, Record};

/// The passes of the direct integrator, in the order of a frame: rays to the surface, normals, shadows,
/// light. `Within` passes run inside the pass that records them.
pub const DIRECT: &[&Pass] = &[
    &camera_rays::PASS,
    &camera_cone::PASS,
    &march::PASS,
    &compact_hits::PASS,
    &normal::PASS,
    &shadow_cone::PASS,
    &shadow::PASS,
    &shade::PASS,
    &indirect::PASS,
];

/// The passes of a path, in the order of a frame: the camera's ray to the surface, then from vertex to vertex.
pub const PATH: &[&Pass] = &[
    &camera_rays::PASS,
    &camera_cone::PASS,
    &march::PASS,
    &compact_hits::PASS,
    &normal::PASS,
    &scatter::PASS,
    &film_paths::PASS,
    // Between the samples of a picture with a noise target.
    &assess_noise::PASS,
];

/// The passes of a path that scatters inside the set.
pub const PATH_IN_MEDIUM: &[&Pass] = &[
    &camera_rays::PASS,
    &camera_cone::PASS,
    &track::PASS,
    &scatter::PASS,
    &film_paths::PASS,
    &assess_noise::PASS,
];

/// The passes from samples to a display picture, in the order of a frame.
pub const DISPLAY: &[&Pass] = &[
    // Of centre samples, beside the frames.
    &color_histogram::PASS,
    // Of a sparse lattice's samples alone.
    &tonemap_sparse::PASS,
    &upsample::PASS,
    // Of a sub-frame, before the passes of the film.
    &shutter::PASS,
    // Of the film.
    &fill::PASS,
    &mean::PASS,
    &reduce::PASS,
    &histogram::PASS,
    &expose::PASS,
    &bloom::PASS,
    &blur::PASS,
    &denoise_input::PASS,
    &denoise::PASS,
    &tone::PASS,
];

/// The lists of passes of all integrators.
const INTEGRATORS: &[&[&Pass]] = &[DIRECT, PATH, PATH_IN_MEDIUM];

/// Every pass once, also if several integrators share it.
pub fn all() -> impl Iterator<Item = &'static Pass> {
    static ALL: LazyLock<Vec<&Pass>> = LazyLock::new(|| {
        let mut found: Vec<&Pass> = Vec::new();
        for pass in INTEGRATORS.iter().copied().chain([DISPLAY]).flatten() {
            if !found.iter().any(|known| known.name == pass.name) {
                found.push(pass);
            }
        }
        found
    });
    ALL.iter().copied()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A pass in the wrong table would be skipped silently.
    #[test]
    fn every_pass_is_of_its_table() {
        for pass in INTEGRATORS.iter().copied().flatten() {
            assert!(matches!(pass.record, Record::Trace { .. } | Record::Within), "{}", pass.name);
        }
        for pass in DISPLAY {
            assert!(!matches!(pass.record, Record::Trace { .. }), "{}", pass.name);
        }
    }

    /// Parts of a display that are submitted one after another run its passes in the order of the table.
    #[test]
    fn parts_of_a_display_follow_the_table() {
        let parts = DISPLAY.iter().filter_map(|pass| match pass.record {
            Record::Film { parts, .. } => Some(parts),
            _ => None,
        });
        assert!(parts.is_sorted_by(|a, b| a == b || a.last < b.first));
    }

    #[test]
    fn no_list_has_a_pass_twice() {
        for list in INTEGRATORS.iter().copied().chain([DISPLAY]) {
            for (i, pass) in list.iter().enumerate() {
                assert!(list[..i].iter().all(|other| other.name != pass.name), "{}", pass.name);
            }
        }
    }
}
