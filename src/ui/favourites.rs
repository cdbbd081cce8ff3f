//! Views that a person keeps: their scenes with small pictures, stored between visits.
//!
//! In: a scene's document and a small picture. Out: the list to show, and the document of the opened one.

use std::{
    hash::{DefaultHasher, Hash as _, Hasher as _},
    sync::Arc,
};

use base64::{Engine as _, prelude::BASE64_STANDARD};
use egui::Image;
use serde::{Deserialize, Serialize};

/// Maximum number of kept views: with their pictures they fill a part of a browser's storage.
pub const MAX_FAVOURITES: usize = 100;
/// Maximum length of a name, in characters.
pub const MAX_NAME_CHARS: usize = 60;

/// A kept view.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(from = "Stored", into = "Stored")]
pub struct Favourite {
    /// The name under the picture.
    pub name: String,
    /// The scene with its path, as a document.
    pub document: String,
    jpeg: Arc<[u8]>,
    /// egui's address of the picture, which differs for different pictures.
    uri: String,
}

/// A kept view as it is stored.
#[derive(Serialize, Deserialize)]
struct Stored {
    name: String,
    document: String,
    /// The picture's JPEG file in Base64.
    picture: String,
}

impl Favourite {
    /// A view to keep, with its picture as a JPEG file.
    pub fn new(name: String, document: String, jpeg: impl Into<Arc<[u8]>>) -> Self {
        let jpeg = jpeg.into();
        let mut hasher = DefaultHasher::new();
        jpeg.hash(&mut hasher);
        let uri = format!("bytes://favourite-{:016x}.jpg", hasher.finish());
        Self { name, document, jpeg, uri }
    }

    /// The picture for display.
    pub(super) fn image(&self) -> Image<'static> {
        Image::from_bytes(self.uri.clone(), self.jpeg.clone())
    }
}

impl From<Stored> for Favourite {
    fn from(Stored { name, document, picture }: Stored) -> Self {
        // Without its picture, the view itself is still there.
        Self::new(name, document, BASE64_STANDARD.decode(picture).unwrap_or_default())
    }
}

impl From<Favourite> for Stored {
    fn from(Favourite { name, document, jpeg, .. }: Favourite) -> Self {
        Self { name, document, picture: BASE64_STANDARD.encode(jpeg) }
    }
}

/// The kept views, the newest first.
#[derive(Clone, Debug, Default)]
pub struct Favourites {
    list: Vec<Favourite>,
    /// The opened one, whose name can be edited.
    pub opened: Option<usize>,
    is_changed: bool,
}

impl Favourites {
    /// The views of an earlier visit.
    ///
    /// # Errors
    /// A text that [`Self::to_json`] did not write.
    pub fn from_json(text: &str) -> Result<Self, serde_json::Error> {
        let mut list: Vec<Favourite> = serde_json::from_str(text)?;
        list.truncate(MAX_FAVOURITES);
        Ok(Self { list, ..Self::default() })
    }

    /// The views as a text to store.
    pub fn to_json(&self) -> String {
        serde_json::to_string(&self.list).unwrap_or_default()
    }

    /// True once after each change.
    pub fn take_changed(&mut self) -> bool {
        std::mem::take(&mut self.is_changed)
    }

    /// The views, the newest first.
    pub fn list(&self) -> &[Favourite] {
        &self.list
    }

    /// True if there is room for another view.
    pub fn has_room(&self) -> bool {
        self.list.len() < MAX_FAVOURITES
    }

    /// A name that no view has.
    pub fn free_name(&self) -> String {
        let is_taken = |name: &String| self.list.iter().any(|kept| kept.name == *name);
        let mut names = (self.list.len() + 1..).map(|number| format!("View {number}"));
        names.find(|name| !is_taken(name)).unwrap_or_default()
    }

    /// Adds a view at the front, if there is room, and opens it.
    pub fn keep(&mut self, favourite: Favourite) {
        if self.has_room() {
            self.list.insert(0, favourite);
            self.opened = Some(0);
            self.is_changed = true;
        }
    }

    /// Names a view; names are cut to 60 characters.
    pub fn rename(&mut self, index: usize, name: &str) {
        if let Some(kept) = self.list.get_mut(index) {
            kept.name = name.chars().take(MAX_NAME_CHARS).collect();
            self.is_changed = true;
        }
    }

    /// Removes a view.
    pub fn remove(&mut self, index: usize) {
        if index < self.list.len() {
            self.list.remove(index);
            self.opened = None;
            self.is_changed = true;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn favourite(name: &str) -> Favourite {
        Favourite::new(name.to_owned(), format!("{{\"{name}\": 1}}"), name.as_bytes())
    }

    #[test]
    fn kept_views_are_stored_and_come_back_in_order() {
        let mut favourites = Favourites::default();
        assert!(!favourites.take_changed());
        for name in ["a", "b"] {
            favourites.keep(favourite(name));
        }
        assert!(favourites.take_changed() && !favourites.take_changed());
        favourites.rename(0, &"long ".repeat(40));
        let again = Favourites::from_json(&favourites.to_json()).expect("its own text");
        assert_eq!(again.list(), favourites.list());
        assert_eq!(again.list()[0].name.chars().count(), MAX_NAME_CHARS);
        favourites.remove(0);
        assert_eq!(favourites.list(), [favourite("a")]);
        favourites.remove(7);
        assert!(Favourites::from_json("[{]").is_err());
    }

    #[test]
    fn there_is_an_end_to_keeping_and_names_are_free() {
        let mut favourites = Favourites::default();
        for _ in 0..MAX_FAVOURITES + 5 {
            favourites.keep(favourite(&favourites.free_name()));
        }
        assert_eq!(favourites.list().len(), MAX_FAVOURITES);
        let mut names: Vec<_> = favourites.list().iter().map(|kept| &kept.name).collect();
        names.sort();
        names.dedup();
        assert_eq!(names.len(), MAX_FAVOURITES);
    }
}
