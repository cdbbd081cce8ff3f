//! The scene that the next visit would open, in the browser's storage until a sharp picture of it is there: if the page
//! ends before, by a panic, a frame without end or a killed tab, the next visit offers the scene instead.
//!
//! In: scenes that the next visit would open, sharp pictures, the page's end. Out: the list of [`EndedScenes`]. A panic
//! lists the scene at any time. While the page is hidden, or once it is left, a scene without a picture is off the list,
//! for browsers end hidden tabs at will. A visit that hangs or is killed after the sharp picture is not noted: its scene
//! opens once more, and is offered if it ends that visit too. Of two visible windows that open the same scene at once, the
//! second one offers it. State is thread-local, since panic hooks are global.

use std::cell::RefCell;

use wasm_bindgen::prelude::*;

use super::{
    page,
    storage::{self, scene_text},
};
use crate::{
    scene::{Scene, presets},
    ui::ended_scenes::EndedScenes,
};

/// What is known of the scene that the next visit would open.
struct Watch {
    /// The scene's text.
    scene: Option<String>,
    /// Whether a sharp picture has yet to come.
    awaits_picture: bool,
    /// Whether the program has ended: the list stays as it is.
    has_ended: bool,
}

thread_local! {
    static WATCH: RefCell<Watch> =
        const { RefCell::new(Watch { scene: None, awaits_picture: false, has_ended: false }) };
}

/// Whether `scene` ended an earlier visit, or is drawn first in another window.
pub fn has_ended_with(scene: &Scene) -> bool {
    read().contains(&scene_text(scene))
}

/// The next visit would open `scene`, of which there is no sharp picture yet.
pub fn watch(scene: &Scene) {
    // The opening scene is what there is instead of an ended one.
    let text = (*scene != presets::opening()).then(|| scene_text(scene));
    update(|watch| {
        watch.unlist();
        watch.scene = text;
        watch.awaits_picture = true;
        watch.list();
    });
}

/// A sharp picture of the watched scene is there.
pub fn note_picture() {
    update(|watch| {
        watch.unlist();
        watch.awaits_picture = false;
    });
}

/// The visitor leaves or hides the page.
pub fn leave() {
    update(|watch| watch.unlist());
}

/// The page is in sight again.
pub fn come_back() {
    update(|watch| watch.list());
}

/// The program has ended: by a panic, or by a trap, of which the page's script knows.
#[wasm_bindgen]
pub fn note_end() {
    update(|watch| {
        watch.has_ended = true;
        watch.change(EndedScenes::add);
    });
}

impl Watch {
    /// Lists the scene that has no picture yet, in a page that is in sight.
    fn list(&self) {
        if self.awaits_picture && !page::is_hidden() {
            self.change(EndedScenes::add);
        }
    }

    /// Takes the scene that has no picture yet off the list.
    fn unlist(&self) {
        if self.awaits_picture {
            self.change(EndedScenes::remove);
        }
    }

    /// Applies `change` to the stored list, which other tabs change too, and to the watched scene.
    fn change(&self, change: impl FnOnce(&mut EndedScenes, &str)) {
        let Some(scene) = &self.scene else { return };
        let before = read();
        let mut scenes = before.clone();
        change(&mut scenes, scene);
        if scenes != before {
            storage::UNFINISHED.write(&scenes.to_json());
        }
    }
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
    storage::UNFINISHED.read().map(|text| EndedScenes::from_json(&text)).unwrap_or_default()
}
