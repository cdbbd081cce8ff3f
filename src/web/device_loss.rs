//! The losses of the GPU in the browser's storage.
//!
//! In: losses, complete pictures. Out: what [`GpuLosses`] decides. They are stored for all visits: a scene that
//! lost the GPU must not start by itself in another tab or on another day.

use super::{
    page,
    storage::{self, scene_text},
};
use crate::{
    scene::Scene,
    ui::loss_policy::{GpuLosses, SafeMode, Start},
};

fn read() -> GpuLosses {
    storage::LOSSES.read().map(|text| GpuLosses::from_json(&text)).unwrap_or_default()
}

/// How a visit begins whose address or storage names `scene`.
pub fn start(scene: &Scene) -> Start {
    read().start(&scene_text(scene), page::epoch_secs())
}

/// Stores a loss with the scene in view, if that was drawn. `own_secs` is the time of this visit's last loss, which this
/// one replaces. Returns the safe mode of the restart; `None` after too many losses.
pub fn note_loss(scene: Option<&Scene>, own_secs: &mut Option<f64>) -> Option<SafeMode> {
    let mut losses = read();
    let now_secs = page::epoch_secs();
    let safe_mode = losses.note(scene.map(scene_text), now_secs, own_secs.replace(now_secs));
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
