//! Pictures in the interface, decoded by the browser: no decoder adds to the module's size.
//!
//! In: bytes of a file such as a JPEG by egui's URI of them, or the address of a picture of the gallery.
//! Out: the pixels, some frames later.

use std::{
    collections::BTreeMap,
    sync::{Arc, Mutex, PoisonError},
};

use egui::{
    ColorImage, Context, SizeHint,
    load::{BytesPoll, ImageLoadResult, ImageLoader, ImagePoll, LoadError},
};
use js_sys::{Array, Uint8Array};
use wasm_bindgen::{JsCast as _, JsValue};
use wasm_bindgen_futures::{JsFuture, spawn_local};
use web_sys::{Blob, ImageBitmap, OffscreenCanvas, OffscreenCanvasRenderingContext2d};

use super::{
    gallery,
    page::{self, describe},
};

/// A picture's pixels, or why the browser could not decode it; `None` while it decodes.
type Decoded = Option<Result<Arc<ColorImage>, String>>;

/// Most pictures of a host that are read at a time.
const MAX_WAITING: usize = 4;

/// Pictures by URI.
type Pictures = BTreeMap<String, Decoded>;

/// A loader of egui that lets the browser decode, each picture once.
#[derive(Default)]
pub struct ImageDecoder {
    pictures: Arc<Mutex<Pictures>>,
}

impl ImageDecoder {
    /// Keeps the picture of `uri` as soon as `decoding` has it.
    fn begin(
        &self,
        ctx: &Context,
        uri: &str,
        decoding: impl Future<Output = Result<ColorImage, String>> + 'static,
    ) {
        lock(&self.pictures).insert(uri.to_owned(), None);
        let (pictures, uri, ctx) = (self.pictures.clone(), uri.to_owned(), ctx.clone());
        spawn_local(async move {
            let decoded = decoding.await;
            if let Err(reason) = &decoded {
                log::warn!("{uri} could not be decoded: {reason}");
            }
            lock(&pictures).insert(uri, Some(decoded.map(Arc::new)));
            ctx.request_repaint();
        });
    }
}

impl ImageLoader for ImageDecoder {
    fn id(&self) -> &str {
        concat!(module_path!(), "::ImageDecoder")
    }

    fn load(&self, ctx: &Context, uri: &str, _: SizeHint) -> ImageLoadResult {
        match lock(&self.pictures).get(uri) {
            Some(None) => return Ok(ImagePoll::Pending { size: None }),
            Some(Some(Ok(image))) => return Ok(ImagePoll::Ready { image: image.clone() }),
            Some(Some(Err(reason))) => return Err(LoadError::Loading(reason.clone())),
            None => {}
        }
        if uri.starts_with("http") {
            let waiting = lock(&self.pictures).values().filter(|picture| picture.is_none()).count();
            if waiting < MAX_WAITING {
                let address = uri.to_owned();
                self.begin(ctx, uri, async move { gallery::thumbnail(&address).await });
            }
        } else if let BytesPoll::Ready { bytes, .. } = ctx.try_load_bytes(uri)? {
            self.begin(
                ctx,
                uri,
                async move { decode(&bytes).await.map_err(|error| describe(&error)) },
            );
        }
        Ok(ImagePoll::Pending { size: None })
    }

    fn forget(&self, uri: &str) {
        lock(&self.pictures).remove(uri);
    }

    fn forget_all(&self) {
        lock(&self.pictures).clear();
    }

    fn byte_size(&self) -> usize {
        let pictures = lock(&self.pictures);
        let images = pictures.values().filter_map(|decoded| decoded.as_ref()?.as_ref().ok());
        images.map(|image| size_of_val(image.pixels.as_slice())).sum()
    }

    fn has_pending(&self) -> bool {
        lock(&self.pictures).values().any(Option::is_none)
    }
}

fn lock(pictures: &Mutex<Pictures>) -> std::sync::MutexGuard<'_, Pictures> {
    pictures.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The pixels of a file that the browser can decode.
///
/// # Errors
/// The browser's error for a file that it cannot decode.
pub async fn decode(file: &[u8]) -> Result<ColorImage, JsValue> {
    let blob = Blob::new_with_u8_array_sequence(&Array::of1(&Uint8Array::from(file)))?;
    let window = page::window().ok_or("no window")?;
    let bitmap = JsFuture::from(window.create_image_bitmap_with_blob(&blob)?).await?;
    let bitmap: ImageBitmap = bitmap.dyn_into()?;
    let (width, height) = (bitmap.width(), bitmap.height());
    let canvas = OffscreenCanvas::new(width, height)?;
    let context = canvas.get_context("2d")?.ok_or("no 2D canvas")?;
    let context: OffscreenCanvasRenderingContext2d = context.dyn_into()?;
    context.draw_image_with_image_bitmap(&bitmap, 0.0, 0.0)?;
    let data = context.get_image_data(0.0, 0.0, f64::from(width), f64::from(height))?;
    Ok(ColorImage::from_rgba_unmultiplied([width as usize, height as usize], &data.data()))
}
