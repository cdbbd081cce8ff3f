//! egui's textures, counted in the place of a renderer.

use std::{
    collections::HashMap,
    sync::{Arc, Mutex, PoisonError},
};

use egui::{TextureId, TexturesDelta};
use egui_kittest::TestRenderer;

/// The textures that egui holds, with their bytes. Clones share the count.
#[derive(Clone, Default)]
pub struct Textures(Arc<Mutex<HashMap<TextureId, usize>>>);

impl Textures {
    /// Number and bytes of all textures.
    pub fn total(&self) -> (usize, usize) {
        let held = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        (held.len(), held.values().sum())
    }
}

impl TestRenderer for Textures {
    fn handle_delta(&mut self, delta: &mut TexturesDelta) {
        let mut held = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        for (id, images) in &delta.set {
            for whole in images.iter().filter(|image| image.is_whole()) {
                let [width, height] = whole.image.size();
                held.insert(*id, width * height * whole.image.bytes_per_pixel());
            }
        }
        for id in &delta.free {
            held.remove(id);
        }
        delta.clear();
    }
}
