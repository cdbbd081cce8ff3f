//! A preset: a scene with a name and a sentence about it.

use crate::scene::description::Scene;

/// A scene to start from.
#[derive(Clone, Copy, Debug)]
pub struct Preset {
    /// A short name, one of its own.
    pub name: &'static str,
    /// What it shows, in a sentence.
    pub blurb: &'static str,
    /// The scene.
    pub scene: fn() -> Scene,
}

impl Preset {
    /// The name on the command line and of files: `coral-reef` for "Coral reef".
    pub fn id(&self) -> String {
        Self::id_of(self.name)
    }

    /// The id of a preset called `name`.
    pub fn id_of(name: &str) -> String {
        let kept = |c: char| (c.is_alphanumeric() || c == '-').then_some(c);
        name.to_lowercase().replace(' ', "-").chars().filter_map(kept).collect()
    }
}
