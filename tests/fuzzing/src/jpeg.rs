//! JPEGs with a scene.

use std::io::Cursor;

use mandelight::{
    export::{
        self,
        jpeg::{JpegStream, is_jpeg, jpeg_complete_size, jpeg_scene_text},
    },
    scene::document,
};

use crate::{FuzzTarget, InputFormat, Outcome, document::projects, promises};

pub const TARGET: FuzzTarget = FuzzTarget {
    name: "jpeg",
    check,
    seeds,
    format: InputFormat::Jpeg,
    hundreds: 60,
    most_work: 16 << 20,
};

fn check(bytes: &[u8]) -> Outcome {
    if let Err(error) = jpeg_complete_size(Cursor::new(bytes)) {
        promises::refused(&error);
    }
    let text = export::picture_scene_text(bytes).filter(|_| is_jpeg(bytes));
    let read = |bytes: &[u8]| jpeg_scene_text(bytes).expect("a whole JPEG");
    promises::picture_text(text, picture, read)
}

/// A picture of one pixel.
fn picture(text: &str) -> Vec<u8> {
    let mut stream = JpegStream::new(Vec::new(), [1, 1], text, 90).expect("a JPEG");
    stream.write_rgb(&[0; 3]).expect("memory");
    stream.finish().expect("a whole JPEG")
}

fn seeds() -> Vec<Vec<u8>> {
    let texts = projects().into_iter().step_by(4);
    let texts = texts.map(|project| document::project_to_json_compact(&project));
    // A text in two parts.
    let long = format!("{}{{}}", " ".repeat(66_000));
    texts.chain([long]).map(|text| picture(&text)).collect()
}
