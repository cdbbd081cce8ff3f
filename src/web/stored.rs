//! What visits keep besides scenes: the interface's settings, and the views that the visitor keeps.
//!
//! In: the storage's texts, which may be damaged, another version's, or changed by another tab. Out: settings
//! and views; what this version cannot read is stored again as it is.

use std::cell::RefCell;

use crate::ui::{Favourites, Settings};

use super::storage;

/// What is said of kept views that cannot be read.
const DAMAGED: &str = "The list of kept views is damaged. It is put aside in the browser's storage, as mandelight.favourites.damaged, and a new list begins.";

/// The same where there is no room for a second list.
const DAMAGED_AND_FULL: &str = "The list of kept views is damaged, and the browser's storage has no room to put it aside. New views are not kept until mandelight.favourites is removed from the storage.";

/// The settings of the last visit.
pub fn settings() -> Option<Settings> {
    let text = storage::SETTINGS.read()?;
    let settings = Settings::from_json(&text);
    if settings.is_none() {
        log::warn!("cannot read the settings of the last visit");
    }
    settings
}

/// Stores the settings, with the formulas that other tabs have kept since they were `known`.
pub fn save_settings(settings: &mut Settings, known: &mut Vec<String>) {
    let stored = storage::SETTINGS.read().unwrap_or_default();
    if let Some(stored) = Settings::from_json(&stored) {
        settings.merge_formulas(known, &stored.formulas);
    }
    match settings.to_json_over(&stored) {
        Ok(text) if storage::SETTINGS.write(&text) => known.clone_from(&settings.formulas),
        Ok(_) => {}
        Err(error) => log::warn!("cannot store the settings: {error}"),
    }
}

/// The views that were kept at earlier visits, and what is wrong with the stored list.
pub fn favourites() -> (Favourites, Option<String>) {
    let Some(text) = storage::FAVOURITES.read().filter(|text| !text.is_empty()) else {
        return (Favourites::default(), None);
    };
    match Favourites::from_json(&text) {
        Ok(favourites) => (favourites, None),
        Err(error) => {
            log::warn!("cannot read the kept views: {error}");
            let problem = if put_aside(&text) { DAMAGED } else { DAMAGED_AND_FULL };
            (Favourites::default(), Some(problem.to_owned()))
        }
    }
}

thread_local! {
    /// The list that this tab read or wrote last: other tabs change other texts far more often.
    static LAST_LIST: RefCell<String> = const { RefCell::new(String::new()) };
}

/// Merges the views that another tab has stored into `favourites`. Returns whether the stored list may be written over.
pub fn merge_stored_favourites(favourites: &mut Favourites) -> bool {
    let Some(text) = storage::FAVOURITES.read() else { return true };
    if LAST_LIST.with_borrow(|last| *last == text) {
        return true;
    }
    if let Err(error) = favourites.merge(&text) {
        log::warn!("cannot read the kept views: {error}");
        return put_aside(&text);
    }
    LAST_LIST.set(text);
    true
}

/// Stores the views with those of other tabs. Returns whether they are stored.
pub fn save_favourites(favourites: &mut Favourites) -> bool {
    if !merge_stored_favourites(favourites) {
        return false;
    }
    let text = favourites.to_json();
    let is_stored = storage::FAVOURITES.write(&text);
    if is_stored {
        favourites.note_stored();
        LAST_LIST.set(text);
    }
    is_stored
}

/// Keeps a list that cannot be read. Returns whether nothing of it is lost then.
fn put_aside(text: &str) -> bool {
    text.is_empty() || storage::FAVOURITES_DAMAGED.write(text)
}
