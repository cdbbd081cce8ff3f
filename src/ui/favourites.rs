//! Views that a person keeps: their scenes with small pictures, stored between visits.
//!
//! In: a scene's document and a small picture; the list that another tab stored. Out: the list to show and to
//! store, and the document of the opened view. What cannot be read of a stored list is stored again as it is.

use std::{
    collections::HashSet,
    hash::{DefaultHasher, Hash as _, Hasher as _},
    sync::Arc,
};

use base64::{Engine as _, prelude::BASE64_STANDARD};
use egui::{Context, Image};
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use super::merge::merged;

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
    /// Differs for different views, whatever their names.
    id: u64,
    /// What a newer version stored besides.
    other: Map<String, Value>,
}

/// A kept view as it is stored.
#[derive(Serialize, Deserialize)]
struct Stored {
    name: String,
    document: String,
    /// The picture's JPEG file in Base64.
    picture: String,
    #[serde(flatten)]
    other: Map<String, Value>,
}

impl Favourite {
    /// A view to keep, with its picture as a JPEG file.
    pub fn new(name: String, document: String, jpeg: impl Into<Arc<[u8]>>) -> Self {
        let jpeg = jpeg.into();
        let mut hasher = DefaultHasher::new();
        jpeg.hash(&mut hasher);
        let uri = format!("bytes://favourite-{:016x}.jpg", hasher.finish());
        document.hash(&mut hasher);
        Self { name, document, jpeg, uri, id: hasher.finish(), other: Map::new() }
    }

    /// The picture for display.
    pub(super) fn image(&self) -> Image<'static> {
        Image::from_bytes(self.uri.clone(), self.jpeg.clone())
    }
}

impl From<Stored> for Favourite {
    fn from(Stored { name, document, picture, other }: Stored) -> Self {
        // Without its picture, the view itself is still there.
        let jpeg = BASE64_STANDARD.decode(picture).unwrap_or_default();
        Self { other, ..Self::new(name, document, jpeg) }
    }
}

impl From<Favourite> for Stored {
    fn from(Favourite { name, document, jpeg, other, .. }: Favourite) -> Self {
        Self { name, document, picture: BASE64_STANDARD.encode(jpeg), other }
    }
}

/// The kept views, the newest first.
#[derive(Clone, Debug, Default)]
pub struct Favourites {
    list: Vec<Favourite>,
    /// The opened one, whose name can be edited.
    pub opened: Option<usize>,
    is_changed: bool,
    /// The list as it was last read or stored, without this tab's edits.
    known: Vec<Favourite>,
    /// Entries of the stored list that cannot be read, or for which there is no room.
    unread: Vec<Value>,
    /// Addresses of pictures that are shown no more.
    dropped: Vec<String>,
}

impl Favourites {
    /// The views of an earlier visit; those that cannot be read are kept for the program that can.
    ///
    /// Views beyond the hundredth are kept likewise until there is room.
    ///
    /// # Errors
    /// A text that is no list at all.
    pub fn from_json(text: &str) -> Result<Self, serde_json::Error> {
        let stored: Vec<Value> = serde_json::from_str(text)?;
        let (mut list, mut unread, mut ids) = (Vec::new(), Vec::new(), HashSet::new());
        for entry in stored {
            match serde_json::from_value::<Favourite>(entry.clone()) {
                Ok(favourite) if !ids.insert(favourite.id) => {}
                Ok(favourite) if list.len() < MAX_FAVOURITES => list.push(favourite),
                Ok(_) | Err(_) => unread.push(entry),
            }
        }
        Ok(Self { known: list.clone(), list, unread, ..Self::default() })
    }

    /// The views as a text to store.
    pub fn to_json(&self) -> String {
        let readable = self.list.iter().filter_map(|kept| serde_json::to_value(kept).ok());
        let all: Vec<Value> = readable.chain(self.unread.iter().cloned()).collect();
        serde_json::to_string(&all).unwrap_or_default()
    }

    /// Takes in the list that is stored now, which another tab may have changed, and keeps this tab's edits.
    ///
    /// # Errors
    /// A text that is no list at all; then nothing changes.
    pub fn merge(&mut self, stored: &str) -> Result<(), serde_json::Error> {
        let stored = Self::from_json(stored)?;
        let opened = self.opened.and_then(|index| self.list.get(index)).map(|kept| kept.id);
        let list = merged(&self.known, &self.list, &stored.list, |kept| kept.id);
        let before = std::mem::replace(&mut self.list, list);
        self.opened = opened.and_then(|id| self.list.iter().position(|kept| kept.id == id));
        (self.known, self.unread) = (stored.list, stored.unread);
        for gone in before {
            self.drop_picture(gone);
        }
        Ok(())
    }

    /// Notes that the list is stored as it is.
    pub fn note_stored(&mut self) {
        self.known.clone_from(&self.list);
    }

    /// Frees the pictures of views that are gone.
    pub(super) fn forget_pictures(&mut self, ctx: &Context) {
        for uri in self.dropped.drain(..) {
            ctx.forget_image(&uri);
        }
    }

    fn drop_picture(&mut self, gone: Favourite) {
        if !self.list.iter().any(|kept| kept.uri == gone.uri) {
            self.dropped.push(gone.uri);
        }
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

    /// Adds a view at the front, if there is room, and opens it. A view that is there already is opened.
    pub fn keep(&mut self, favourite: Favourite) {
        if let Some(index) = self.list.iter().position(|kept| kept.id == favourite.id) {
            self.opened = Some(index);
        } else if self.has_room() {
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
            let gone = self.list.remove(index);
            self.drop_picture(gone);
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
    fn two_tabs_keep_views_and_neither_loses_one() {
        let names = |favourites: &Favourites| {
            favourites.list().iter().map(|kept| kept.name.clone()).collect::<Vec<_>>()
        };
        let first = serde_json::to_string(&[favourite("a"), favourite("b")]).unwrap();
        let [mut mine, mut theirs] = [(); 2].map(|()| Favourites::from_json(&first).unwrap());
        theirs.keep(favourite("theirs"));
        theirs.remove(2);
        theirs.rename(1, "renamed");
        mine.opened = Some(0);
        mine.keep(favourite("mine"));
        mine.merge(&theirs.to_json()).unwrap();
        assert_eq!(names(&mine), ["mine", "theirs", "renamed"]);
        assert_eq!(mine.opened, Some(0), "the view that was kept stays open");
        assert_eq!(mine.dropped.len(), 1, "the removed view's picture");
        mine.note_stored();
        theirs.note_stored();
        theirs.merge(&mine.to_json()).unwrap();
        assert_eq!(names(&theirs), names(&mine));
        // Storage that was damaged meanwhile changes nothing.
        assert!(theirs.merge("{]").is_err());
        assert_eq!(names(&theirs), names(&mine));
        mine.keep(favourite("theirs"));
        assert_eq!((names(&mine).len(), mine.opened), (3, Some(1)), "kept twice");
    }

    #[test]
    fn what_cannot_be_read_of_a_list_is_stored_again() {
        let stored = r#"[{"name": "a", "document": "{}", "picture": "!", "stars": 5}, 7,
            {"name": 3}, {"title": "of another version"}]"#;
        let mut favourites = Favourites::from_json(stored).unwrap();
        assert_eq!(favourites.list().len(), 1);
        favourites.keep(favourite("b"));
        let again: Value = serde_json::from_str(&favourites.to_json()).unwrap();
        assert_eq!(again.as_array().map(Vec::len), Some(5));
        assert_eq!(again[1]["stars"], 5);
        assert_eq!(again[4]["title"], "of another version");
    }

    #[test]
    fn views_beyond_the_limit_stay_stored_until_there_is_room() {
        let views: Vec<_> = (0..MAX_FAVOURITES + 3).map(|i| favourite(&format!("{i}"))).collect();
        let twice = [&views[..], &views].concat();
        let mut favourites =
            Favourites::from_json(&serde_json::to_string(&twice).unwrap()).unwrap();
        assert_eq!(favourites.list(), &views[..MAX_FAVOURITES]);
        let stored = |favourites: &Favourites| -> Vec<Favourite> {
            serde_json::from_str(&favourites.to_json()).unwrap()
        };
        assert_eq!(stored(&favourites), views, "each is stored once");
        favourites.remove(0);
        assert_eq!(stored(&favourites), views[1..]);
        favourites.merge(&favourites.to_json()).unwrap();
        assert_eq!(favourites.list(), &views[1..=MAX_FAVOURITES]);
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
