//! The losses of the GPU in the browser's storage.
//!
//! In: losses, complete pictures. Out: what [`GpuLosses`] decides. They are stored for all visits: a scene that
//! lost the GPU must not start by itself in another tab or on another day.

use super::{page, storage};
use crate::{
    scene::{Scene, document, link},
    ui::loss_policy::{GpuLosses, SafeMode, Start},
};

fn read() -> GpuLosses {
    storage::LOSSES.read().map(|text| GpuLosses::from_json(&text)).unwrap_or_default()
}

/// A scene as text, by which stored losses know it: its link, or its document if too large for one.
fn text_of(scene: &Scene) -> String {
    link::to_fragment(scene).unwrap_or_else(|_| document::to_json_compact(scene))
}

/// How a visit begins whose address or storage names `scene`.
pub fn start(scene: &Scene) -> Start {
    read().start(&text_of(scene), page::epoch_secs())
}

/// Stores a loss with the scene in view, if that was drawn. `own_secs` is the time of this visit's last loss, which this
/// one replaces. Returns the safe mode of the restart; `None` after too many losses.
pub fn note_loss(scene: Option<&Scene>, own_secs: &mut Option<f64>) -> Option<SafeMode> {
    let mut losses = read();
    let now_secs = page::epoch_secs();
    let safe_mode = losses.note(scene.map(text_of), now_secs, own_secs.replace(now_secs));
    storage::LOSSES.write(&losses.to_json());
    safe_mode
}

/// A complete picture of a scene that did not lose the GPU.
pub fn note_other_picture() {
    let mut losses = read();
    if losses.note_other_picture() {
        storage::LOSSES.write(&losses.to_json());
    }
}

/// Clears the stored scene: a complete picture shows that it does not lose the GPU.
pub fn note_complete_picture() {
    let mut losses = read();
    if losses.note_complete_picture() {
        storage::LOSSES.write(&losses.to_json());
    }
}
