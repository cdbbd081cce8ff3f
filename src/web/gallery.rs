//! The gallery of the page's address: `?gallery=` with the address of a folder, or of its list.
//!
//! In: files of the gallery's host. Out: its list and its scenes as messages, its pictures as textures of
//! egui. Files are read as data, without cookies, where their host lets other pages read them.

use js_sys::{Array, Uint8Array, Uint8ClampedArray};
use wasm_bindgen::{JsCast as _, prelude::*};
use wasm_bindgen_futures::spawn_local;
use web_sys::{Blob, Url, UrlSearchParams};

use super::{
    mailbox::{Mailbox, Message},
    page::{self, describe},
};
use crate::{
    export::{self, MAX_HEADER_BYTES},
    scene::{
        document::MAX_BYTES,
        gallery::{Gallery, LIST_FILE, MAX_LIST_BYTES, Picture},
    },
    ui::{GalleryState, thumbnail},
};

// The functions of `www/gallery.js`, which `boot.js` puts there.
#[wasm_bindgen(js_namespace = mandelightGallery)]
extern "C" {
    #[wasm_bindgen(catch)]
    async fn read(address: &str, max_bytes: f64, is_whole: bool) -> Result<JsValue, JsValue>;
    #[wasm_bindgen(js_name = smallPixels, catch)]
    async fn small_pixels(file: Uint8Array, width: u32, height: u32) -> Result<JsValue, JsValue>;
}

/// Most bytes of a picture that is shown small.
const MAX_PICTURE_BYTES: f64 = (64 << 20) as f64;

/// Reads the list of the gallery that the page's address names. Returns its state; none without a gallery.
pub fn open(mailbox: &Mailbox) -> Option<GalleryState> {
    let location = page::window()?.location();
    let query = UrlSearchParams::new_with_str(&location.search().ok()?).ok()?;
    let named = query.get("gallery")?;
    let address = Url::new_with_base(&named, &location.href().ok()?).ok();
    let origin = location.origin().ok()?;
    if address.as_ref().is_some_and(|url| url.protocol() == "http:" && url.origin() != origin) {
        return Some(GalleryState::Failed(format!(
            "The gallery \"{named}\" is on a host without encryption. Name it with https."
        )));
    }
    let Some(list) = address.and_then(list_address) else {
        return Some(GalleryState::Failed(format!(
            "The gallery \"{named}\" is not the address of a folder or a list on a web host."
        )));
    };
    let mailbox = mailbox.clone();
    spawn_local(async move {
        let state = match read_list(&list).await {
            Ok(gallery) => GalleryState::Ready { address: folder_of(&list).to_owned(), gallery },
            Err(reason) => {
                GalleryState::Failed(format!("The gallery {list} can't be shown: {reason}."))
            }
        };
        mailbox.post(Message::Gallery(state));
    });
    Some(GalleryState::Loading)
}

/// The address of the list, where `url` is it or its folder.
fn list_address(url: Url) -> Option<String> {
    if !matches!(url.protocol().as_str(), "http:" | "https:") {
        return None;
    }
    let path = url.pathname();
    if path.ends_with('/') {
        url.set_pathname(&format!("{path}{LIST_FILE}"));
    }
    url.set_hash("");
    Some(url.href())
}

/// The address of the folder that a list is in, with `/` at its end.
fn folder_of(list: &str) -> &str {
    let path = list.split('?').next().unwrap_or(list);
    path.rfind('/').map_or(path, |slash| &path[..=slash])
}

async fn read_list(address: &str) -> Result<Gallery, String> {
    // One byte more than a list may have, so that a longer one is refused as such.
    let bytes = bytes_of(read(address, (MAX_LIST_BYTES + 1) as f64, false).await)?;
    let text = String::from_utf8(bytes).map_err(|_| "its list is not UTF-8 text".to_owned())?;
    Gallery::from_json(&text).map_err(|error| error.to_string())
}

/// Fetches the scene of a picture in the folder at `address`, and posts it with its ticket.
pub fn open_picture(address: &str, picture: &Picture, ticket: u32, mailbox: &Mailbox) {
    let (mailbox, name) = (mailbox.clone(), picture.name.clone());
    let address = format!("{address}{}", picture.file);
    spawn_local(async move {
        // A picture's scene precedes its pixels.
        let content = match read(&address, (MAX_BYTES + 1) as f64, false).await {
            Ok(bytes) => Blob::new_with_u8_array_sequence(&Array::of1(&bytes)),
            Err(error) => Err(error),
        };
        let content = content.map_err(|error| describe(&error));
        mailbox.post(Message::GalleryPicture { ticket, name, content });
    });
}

/// Reads the picture at `address` and makes it as small as a thumbnail.
pub async fn thumbnail(address: &str) -> Result<egui::ColorImage, String> {
    let file = read(address, MAX_PICTURE_BYTES, true).await.map_err(|error| describe(&error))?;
    let file: Uint8Array = file.unchecked_into();
    let header = file.subarray(0, file.length().min(MAX_HEADER_BYTES as u32)).to_vec();
    export::decodable_size(&header)?;
    let [width, height] = thumbnail::SIZE_PX.map(|side| 2 * side);
    let pixels = small_pixels(file, width, height).await;
    let pixels = pixels.map_err(|error| describe(&error))?;
    let pixels = pixels.unchecked_into::<Uint8ClampedArray>().to_vec();
    Ok(egui::ColorImage::from_rgba_unmultiplied([width as usize, height as usize], &pixels))
}

fn bytes_of(read: Result<JsValue, JsValue>) -> Result<Vec<u8>, String> {
    let bytes = read.map_err(|error| describe(&error))?;
    Ok(bytes.unchecked_into::<Uint8Array>().to_vec())
}
