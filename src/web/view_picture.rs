//! The picture on the screen as a file: for the clipboard, the share sheet and downloads.
//!
//! In: the view's texture. Out: its pixels, or a file that carries the scene. Nothing is rendered again.

use js_sys::{Array, Promise, Uint8Array};
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::{JsFuture, future_to_promise, spawn_local};
use web_sys::{Blob, BlobPropertyBag};

use super::{
    exporter::picture_format,
    files,
    mailbox::{Mailbox, Message},
    page::{self, describe},
};
use crate::{
    export::{ExportError, PictureFormat, encode_rgb},
    gpu::{Gpu, readback::Readback},
    scene::Scene,
    ui::{DEFAULT_QUALITY, StillFile, thumbnail},
};

// The functions of `www/share.js`, which `boot.js` puts there.
#[wasm_bindgen(js_namespace = mandelightShare)]
extern "C" {
    #[wasm_bindgen(js_name = copyPicture, catch)]
    async fn copy_picture(picture: Promise) -> Result<JsValue, JsValue>;
    #[wasm_bindgen(js_name = hasShareSheet)]
    fn js_has_share_sheet() -> bool;
    #[wasm_bindgen(js_name = smallCopy, catch)]
    async fn small_copy(picture: Promise, width: u32, height: u32) -> Result<JsValue, JsValue>;
    #[wasm_bindgen(js_name = sharePicture, catch)]
    async fn share_picture(picture: Promise, name: &str) -> Result<JsValue, JsValue>;
}

/// Milliseconds between two polls of a readback.
const POLL_MS: i32 = 4;

/// True if the system has a share sheet that takes pictures.
pub fn has_share_sheet() -> bool {
    js_has_share_sheet()
}

/// The picture on the screen, with its scene.
pub struct ViewPicture {
    gpu: Gpu,
    texture: wgpu::Texture,
    scene: Scene,
}

impl ViewPicture {
    /// The picture in `texture`, of `scene`.
    pub fn new(gpu: &Gpu, texture: &wgpu::Texture, scene: Scene) -> Self {
        Self { gpu: gpu.clone(), texture: texture.clone(), scene }
    }

    /// Copies the picture to the clipboard. Browsers allow that only within a click or a key.
    pub fn copy(self, mailbox: &Mailbox) {
        let mailbox = mailbox.clone();
        let picture = self.blob();
        spawn_local(async move {
            mailbox.post(match copy_picture(picture).await {
                Ok(_) => Message::Notice("Picture copied. Paste it anywhere.".to_owned()),
                Err(error) => Message::Error(format!(
                    "The picture could not be copied. Save it instead. ({})",
                    describe(&error)
                )),
            });
        });
    }

    /// Hands the picture to the system's share sheet, which asks where it goes.
    pub fn share(self, mailbox: &Mailbox) {
        let mailbox = mailbox.clone();
        let (name, picture) = (self.file_name(PictureFormat::Png), self.blob());
        spawn_local(async move {
            if let Err(error) = share_picture(picture, &name).await {
                let reason = describe(&error);
                mailbox.post(Message::Error(format!(
                    "The picture could not be shared. Save it instead. ({reason})"
                )));
            }
        });
    }

    /// Posts a small copy of the picture with `document`, to keep it.
    pub fn keep(self, document: String, mailbox: &Mailbox) {
        let mailbox = mailbox.clone();
        let picture = self.blob();
        spawn_local(async move {
            let [width, height] = thumbnail::SIZE_PX;
            mailbox.post(match small_copy(picture, width, height).await {
                Ok(file) => Message::Favourite { document, jpeg: Uint8Array::new(&file).to_vec() },
                Err(error) => Message::Error(format!(
                    "The view could not be kept. Try again, or save the scene as a file. ({})",
                    describe(&error)
                )),
            });
        });
    }

    /// Downloads the picture as a PNG, a JPEG or a WebP.
    pub fn save(self, file: StillFile, mailbox: &Mailbox) {
        let mailbox = mailbox.clone();
        let format = picture_format(file);
        let name = self.file_name(format);
        spawn_local(async move {
            let saved = match self.encoded(format, file.quality).await {
                Ok(bytes) => files::download(&name, format.media_type(), &bytes),
                Err(error) => Err(describe(&error)),
            };
            mailbox.post(match saved {
                Ok(()) => Message::Notice(format!("Saved {name}.")),
                Err(reason) => Message::Error(ExportError::unwritten(reason).explain()),
            });
        });
    }

    fn file_name(&self, format: PictureFormat) -> String {
        let extension = format.extension();
        format!("mandelight-{}x{}.{extension}", self.texture.width(), self.texture.height())
    }

    /// The picture as a PNG.
    fn blob(self) -> Promise {
        future_to_promise(async move {
            let format = PictureFormat::Png;
            let bytes = Uint8Array::from(self.encoded(format, DEFAULT_QUALITY).await?.as_slice());
            let options = BlobPropertyBag::new();
            options.set_type(format.media_type());
            let parts = Array::of1(&bytes);
            Ok(Blob::new_with_u8_array_sequence_and_options(&parts, &options)?.into())
        })
    }

    async fn encoded(&self, format: PictureFormat, quality: u8) -> Result<Vec<u8>, JsValue> {
        let rgba = read_pixels(&self.gpu, &self.texture).await?;
        let rgb: Vec<u8> =
            rgba.chunks_exact(4).flat_map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect();
        let size_px = [self.texture.width(), self.texture.height()];
        encode_rgb(format, quality, size_px, &self.scene, &rgb)
            .map_err(|error| JsValue::from_str(&error.to_string()))
    }
}

/// The texture's pixels: RGBA, the top row first.
///
/// # Errors
/// A lost device.
pub async fn read_pixels(gpu: &Gpu, texture: &wgpu::Texture) -> Result<Vec<u8>, JsValue> {
    let mut readback = Readback::texture(gpu, texture, [texture.width(), texture.height()]);
    loop {
        let pixels = readback.take(gpu).map_err(|error| JsValue::from_str(&error.to_string()))?;
        if let Some(bytes) = pixels {
            return Ok(bytes);
        }
        sleep(POLL_MS).await?;
    }
}

/// Waits without blocking the page.
async fn sleep(delay_ms: i32) -> Result<(), JsValue> {
    let promise = Promise::new(&mut |resolve, _| {
        page::after_ms(delay_ms, move || {
            // A promise's own resolve function does not throw.
            let _ = resolve.call0(&JsValue::UNDEFINED);
        });
    });
    JsFuture::from(promise).await.map(|_| ())
}
