//! WebP pictures with a scene.

use std::io::Cursor;

use mandelight::{
    export::{
        self,
        webp::{WebPStream, is_webp, webp_complete_size, webp_scene_text},
    },
    scene::document,
};

use crate::{FuzzTarget, InputFormat, Outcome, document::projects, promises};

pub const TARGET: FuzzTarget = FuzzTarget {
    name: "webp",
    check,
    seeds,
    format: InputFormat::WebP,
    hundreds: 60,
    most_work: 16 << 20,
};

fn check(bytes: &[u8]) -> Outcome {
    if let Err(error) = webp_complete_size(Cursor::new(bytes)) {
        promises::refused(&error);
    }
    let text = export::picture_scene_text(bytes).filter(|_| is_webp(bytes));
    let read = |bytes: &[u8]| webp_scene_text(bytes).expect("a whole WebP");
    promises::picture_text(text, picture, read)
}

/// A picture of one pixel.
fn picture(text: &str) -> Vec<u8> {
    let mut stream = WebPStream::new(Vec::new(), [1, 1], text, false).expect("a WebP");
    stream.write_pixels(&[0; 3]).expect("memory");
    stream.finish().expect("a whole WebP")
}

fn seeds() -> Vec<Vec<u8>> {
    let texts = projects().into_iter().step_by(4);
    texts.map(|project| picture(&document::project_to_json_compact(&project))).collect()
}
