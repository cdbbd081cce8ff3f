//! PNGs with a scene.

use std::io::Cursor;

use mandelight::{
    export::{
        self,
        png::{BitDepth, PngStream},
    },
    scene::document,
};

use crate::{FuzzTarget, InputFormat, Outcome, document::projects, promises};

pub const TARGET: FuzzTarget = FuzzTarget {
    name: "png",
    check,
    seeds,
    format: InputFormat::Png,
    hundreds: 120,
    most_work: 16 << 20,
};

fn check(bytes: &[u8]) -> Outcome {
    let text = export::picture_scene_text(bytes).filter(|_| export::is_png(bytes));
    match export::png_complete_size(Cursor::new(bytes)) {
        Ok(size) => {
            assert!(size.is_none() || bytes.len() >= 36, "complete in {} bytes", bytes.len())
        }
        Err(error) => {
            promises::refused(&error);
        }
    }
    let read = |bytes: &[u8]| export::scene_text(Cursor::new(bytes)).expect("a whole PNG");
    promises::picture_text(text, |text| picture(text, BitDepth::Eight), read)
}

/// A picture of one pixel.
fn picture(text: &str, depth: BitDepth) -> Vec<u8> {
    let mut stream = PngStream::with_layout(Vec::new(), [1, 1], text, depth, false).expect("a PNG");
    let pixel: &[u8] = if depth == BitDepth::Sixteen { &[0; 6] } else { &[0; 3] };
    stream.write_pixels(pixel).expect("memory");
    stream.finish().expect("a whole PNG")
}

fn seeds() -> Vec<Vec<u8>> {
    let texts = projects().into_iter().step_by(4);
    let texts = texts.map(|project| document::project_to_json_compact(&project));
    let mut seeds: Vec<_> = texts.map(|text| picture(&text, BitDepth::Eight)).collect();
    seeds.push(picture("", BitDepth::Sixteen));
    seeds
}
