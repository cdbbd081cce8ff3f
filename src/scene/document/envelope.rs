//! The envelope of a scene in its document: kind, version and path, and the largest size.

use serde::{Deserialize, Serialize};

/// The kind of a scene's document.
pub const KIND: &str = "scene";
/// The version written.
pub const VERSION: u32 = 2;
/// The versions read. Version 1 knew one formula: its documents lack `fractal.formula`.
pub const READ: std::ops::RangeInclusive<u64> = 1..=VERSION as u64;
/// The largest document read, in bytes: more than a full path takes whose keys each have as many
/// lights as there can be.
pub const MAX_BYTES: usize = 16 << 20;

/// What the document is, before its contents are looked at.
#[derive(Deserialize)]
pub struct Header {
    /// The kind; [`KIND`] in a scene's document.
    pub mandelight: Option<serde_json::Value>,
    /// The version; in [`READ`] if this program can read it.
    pub version: Option<serde_json::Value>,
}

/// The document; `S` is `Scene` to read and `&Scene` to write, `P` its path.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Document<S, P: Default + PartialEq> {
    /// The kind, [`KIND`].
    pub mandelight: String,
    /// The version; [`VERSION`] in a document to write.
    pub version: u32,
    /// The scene in view.
    pub scene: S,
    /// The camera path.
    #[serde(default, skip_serializing_if = "is_default")]
    pub path: P,
}

fn is_default<P: Default + PartialEq>(path: &P) -> bool {
    *path == P::default()
}
