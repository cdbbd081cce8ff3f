//! The limits of documents and links, in one table, which `docs/scene.md` shows.
//!
//! Each limit holds while a text is read: what exceeds it is refused before it is in memory.

use super::envelope::MAX_BYTES;
use crate::{
    formula::{
        language::{sequence::MAX_STEPS, syntax::MAX_TEXT_BYTES},
        own::MAX_IN_DOCUMENT,
        section::MAX_SECTION_PLANES,
    },
    precise::MAX_DIGITS,
    scene::{light::MAX_LIGHTS, path::MAX_KEYS, surface::MAX_GRADIENT_STOPS},
};

/// Deepest nesting of lists and objects: over twice that of any scene.
pub const MAX_DEPTH: usize = 32;

/// A limit: what is counted, and the most that is read.
pub struct Limit {
    /// What is counted, as the documentation has it.
    pub what: &'static str,
    /// The most that is read.
    pub most: usize,
}

const fn limit(what: &'static str, most: usize) -> Limit {
    Limit { what, most }
}

/// Every limit of a document. Links have two more: their characters and the bytes that they unpack to.
pub const LIMITS: [Limit; 12] = [
    limit("bytes of a document", MAX_BYTES),
    limit("depth of lists and objects", MAX_DEPTH),
    limit("`path.keys`", MAX_KEYS),
    limit("`lights.environment`", MAX_LIGHTS),
    limit("`lights.point`", MAX_LIGHTS),
    limit("`lights.rig.picture.lights`", MAX_LIGHTS),
    limit("`surface.gradient`, `surface.second_layer.gradient`", MAX_GRADIENT_STOPS),
    limit("`fractal.section_planes`", MAX_SECTION_PLANES),
    limit("`fractal.steps`", MAX_STEPS),
    limit("formulas that a document brings as texts", MAX_IN_DOCUMENT),
    limit("bytes of such a text", MAX_TEXT_BYTES),
    limit("digits of a coordinate", MAX_DIGITS),
];
