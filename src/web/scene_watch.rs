//! The scene on its way to a sharp picture, in the browser's storage: if the page ends on that way, by a panic, a
//! frame without end or a killed tab, the next visit offers the scene instead of opening it.
//!
//! In: scenes that the next visit would open, sharp pictures, the page's end. Out: the list of [`EndedScenes`]. A page
//! that is left or hidden in good order is taken off the list, for browsers end hidden tabs at will. A visit that
//! hangs or is killed after the sharp picture is not noted: its scene opens once more, and is offered if it ends that
//! visit too. State is thread-local, since panic hooks are global.

use std::cell::RefCell;

use wasm_bindgen::prelude::*;

use super::{
    page,
    storage::{self, scene_text},
};
use crate::{scene::Scene, ui::ended_scenes::EndedScenes};

/// What is known of the scene that the next visit would open.
struct Watch {
    /// The scene's text.
    scene: Option<String>,
    /// Whether a sharp picture has yet to come.
    is_unproven: bool,
    /// Whether the program has ended: the list stays as it is.
    has_ended: bool,
}

thread_local! {
    static WATCH: RefCell<Watch> =
        const { RefCell::new(Watch { scene: None, is_unproven: false, has_ended: false }) };
}

/// Whether `scene` ended an earlier visit.
pub fn has_ended_with(scene: &Scene) -> bool {
    read().contains(&scene_text(scene))
}

/// The next visit would open `scene`, of which there is no sharp picture yet.
pub fn watch(scene: &Scene) {
    let text = scene_text(scene);
    update(|watch| {
        if watch.is_unproven {
            change(|scenes| watch.scene.iter().for_each(|old| scenes.remove(old)));
        }
        if !page::is_hidden() {
            change(|scenes| scenes.add(text.clone()));
        }
        watch.scene = Some(text);
        watch.is_unproven = true;
    });
}

/// A sharp picture of the watched scene is there.
pub fn note_picture() {
    update(|watch| {
        if std::mem::take(&mut watch.is_unproven) {
            change(|scenes| watch.scene.iter().for_each(|scene| scenes.remove(scene)));
        }
    });
}

/// The visitor leaves or hides the page.
pub fn leave() {
    update(|watch| {
        if watch.is_unproven {
            change(|scenes| watch.scene.iter().for_each(|scene| scenes.remove(scene)));
        }
    });
}

/// The page is in sight again.
pub fn come_back() {
    update(|watch| {
        if watch.is_unproven {
            change(|scenes| watch.scene.iter().for_each(|scene| scenes.add(scene.clone())));
        }
    });
}

/// The program has ended: by a panic, or by a trap, of which the page's script knows.
#[wasm_bindgen]
pub fn note_end() {
    update(|watch| {
        watch.has_ended = true;
        change(|scenes| watch.scene.iter().for_each(|scene| scenes.add(scene.clone())));
    });
}

/// Applies `change` unless the program has ended, or a panic within a change reports itself.
fn update(change: impl FnOnce(&mut Watch)) {
    let _ = WATCH.try_with(|watch| {
        if let Ok(mut watch) = watch.try_borrow_mut()
            && !watch.has_ended
        {
            change(&mut watch);
        }
    });
}

fn read() -> EndedScenes {
    storage::OPENING.read().map(|text| EndedScenes::from_json(&text)).unwrap_or_default()
}

/// Changes the stored list, which other tabs change too.
fn change(change: impl FnOnce(&mut EndedScenes)) {
    let before = read();
    let mut scenes = before.clone();
    change(&mut scenes);
    if scenes != before {
        storage::OPENING.write(&scenes.to_json());
    }
}
