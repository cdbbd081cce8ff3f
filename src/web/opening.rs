//! The opening picture, which the document contains, until the view's first picture is as good.
//!
//! In: the picture of the document, where `boot.js` shows it. Out: its texture for the interface. The
//! document's own picture lies over the canvas until the interface draws the same in its place.

use std::{cell::RefCell, rc::Rc};

use base64::{Engine as _, prelude::BASE64_STANDARD};
use egui::{ColorImage, Context, TextureHandle, TextureOptions};
use wasm_bindgen_futures::spawn_local;

use super::{
    image_decoder::decode,
    page::{self, describe},
};
use crate::{
    render::Report,
    scene::Scene,
    ui::{KeptPicture, ViewTexture, opening},
};

/// The element with the picture, and what its address begins with.
const ELEMENT: &str = "opening-picture";
const ADDRESS: &str = "data:image/jpeg;base64,";

/// Samples of a pixel from which on the view's picture is better than the opening picture.
const BETTER_SAMPLES: u32 = 2;

/// The opening picture, while it is on the screen.
pub struct Opening {
    scene: Scene,
    texture: Rc<RefCell<Option<TextureHandle>>>,
    /// True while the document's own picture lies over the canvas.
    is_in_document: bool,
}

impl Opening {
    /// The opening picture of `scene`, where the document shows it.
    pub fn of_document(context: &Context, scene: &Scene) -> Option<Self> {
        let element = page::document()?.get_element_by_id(ELEMENT)?;
        if element.parent_element()?.has_attribute("hidden") {
            return None;
        }
        let address = element.get_attribute("src")?;
        let file = BASE64_STANDARD.decode(address.strip_prefix(ADDRESS)?).ok()?;
        let texture = Rc::new(RefCell::new(None));
        let (slot, context) = (texture.clone(), context.clone());
        spawn_local(async move {
            match decode(&file).await {
                Ok(image) => *slot.borrow_mut() = Some(load(&context, image)),
                Err(error) => log::warn!("the opening picture: {}", describe(&error)),
            }
            context.request_repaint();
        });
        Some(Self { scene: scene.clone(), texture, is_in_document: true })
    }

    /// The picture for the interface, once it is decoded.
    pub fn shown(&self) -> Option<KeptPicture> {
        let texture = self.texture.borrow();
        let texture = texture.as_ref()?;
        let size_px = [opening::SIDE_PX; 2];
        let picture = ViewTexture { texture: texture.id(), size_px };
        Some(KeptPicture { picture, span: opening::SPAN as f32 })
    }

    /// Removes the document's own picture once the interface has drawn the same.
    pub fn hand_over(&mut self) {
        if self.is_in_document && self.texture.borrow().is_some() {
            self.is_in_document = false;
            remove_from_document(false);
        }
    }

    /// Whether the picture still shows the scene in view, better than the view does.
    pub fn is_of_use(&self, scene: &Scene, report: &Report) -> bool {
        *scene == self.scene && report.samples_done < BETTER_SAMPLES && !report.is_finished()
    }
}

fn load(context: &Context, image: ColorImage) -> TextureHandle {
    context.load_texture("opening picture", image, TextureOptions::LINEAR)
}

/// Removes the document's own picture: `at_once`, or by a fade.
pub fn remove_from_document(at_once: bool) {
    let element = page::document().and_then(|document| document.get_element_by_id(ELEMENT));
    let Some(frame) = element.and_then(|element| element.parent_element()) else { return };
    let (name, value) = if at_once { ("hidden", "") } else { ("class", "leaving") };
    if let Err(error) = frame.set_attribute(name, value) {
        log::warn!("the opening picture stays: {}", describe(&error));
    }
}
