//! Scenes that the next visit offers instead of opening: those without a sharp picture yet, and those in whose visit
//! the program ended.
//!
//! In: scenes that begin to be drawn and those that were drawn, which the shell stores. Out: whether a visit opens a
//! scene by itself or offers it.

use serde::{Deserialize, Serialize};

/// Maximum number of scenes that are kept, so that tabs that open at once have one each.
const MAX_SCENES: usize = 8;

/// Scenes without a sharp picture yet, and scenes in whose visit the program ended: the oldest first.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct EndedScenes(Vec<String>);

impl EndedScenes {
    /// The scenes that a stored text lists, the newest ones if too many; none of an unreadable text.
    pub fn from_json(text: &str) -> Self {
        let mut scenes: Self = serde_json::from_str(text).unwrap_or_default();
        scenes.drop_oldest();
        scenes
    }

    /// As text, for the storage.
    pub fn to_json(&self) -> String {
        // Texts always have a JSON form.
        serde_json::to_string(self).unwrap_or_default()
    }

    /// Whether the next visit offers `scene`.
    pub fn contains(&self, scene: &str) -> bool {
        self.0.iter().any(|listed| listed == scene)
    }

    /// Adds `scene` as the newest.
    pub fn add(&mut self, scene: &str) {
        self.remove(scene);
        self.0.push(scene.to_owned());
        self.drop_oldest();
    }

    /// Removes `scene`: it has been drawn, or its visit ends as visits should.
    pub fn remove(&mut self, scene: &str) {
        self.0.retain(|listed| listed != scene);
    }

    fn drop_oldest(&mut self) {
        let excess = self.0.len().saturating_sub(MAX_SCENES);
        self.0.drain(..excess);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn list(scenes: &[&str]) -> EndedScenes {
        EndedScenes(scenes.iter().map(|&scene| scene.to_owned()).collect())
    }

    #[test]
    fn a_scene_is_listed_until_it_is_drawn() {
        let mut scenes = EndedScenes::default();
        scenes.add("a");
        scenes.add("b");
        scenes.add("a");
        assert_eq!(scenes, list(&["b", "a"]));
        scenes.remove("a");
        assert!(scenes.contains("b") && !scenes.contains("a"));
    }

    #[test]
    fn only_the_newest_are_kept() {
        let mut scenes = list(&["a", "b", "c", "d", "e", "f", "g", "h"]);
        scenes.add("i");
        assert_eq!(scenes, list(&["b", "c", "d", "e", "f", "g", "h", "i"]));
        assert_eq!(EndedScenes::from_json(r#"["a","b","c","d","e","f","g","h","i"]"#), scenes);
    }

    #[test]
    fn the_list_is_stored_as_it_is_and_damage_counts_as_none() {
        let scenes = list(&["a", "\"\n"]);
        assert_eq!(EndedScenes::from_json(&scenes.to_json()), scenes);
        for text in ["", "{", "{}", "[1]", "[null]", "null", "\"a\""] {
            assert_eq!(EndedScenes::from_json(text), EndedScenes::default(), "{text}");
        }
    }
}
