//! OpenEXR pictures: environment maps, and scenes in them.

use std::io::Cursor;

use exr::prelude::{
    Blocks, Compression, Encoding, Image, Layer, LayerAttributes, LineOrder, SpecificChannels,
    Text, Vec2, WritableImage as _,
};
use mandelight::{
    export,
    scene::{Scene, document, environment_map::decode},
};

use crate::{
    FuzzTarget, InputFormat, Outcome,
    promises::{project_holds, refused},
    radiance::map_holds,
};

pub const TARGET: FuzzTarget = FuzzTarget {
    name: "openexr",
    check,
    seeds,
    format: InputFormat::OpenExr,
    hundreds: 120,
    most_work: 64 << 20,
};

fn check(bytes: &[u8]) -> Outcome {
    match export::exr_scene_text(Cursor::new(bytes)) {
        Ok(Some(text)) => match document::project_from_json(&text) {
            Ok(project) => project_holds(&project),
            Err(error) => {
                refused(&error);
            }
        },
        Ok(None) => {}
        Err(message) => {
            refused(&message);
        }
    }
    if let Err(message) = export::exr_complete_size(Cursor::new(bytes)) {
        refused(&message);
    }
    match decode("a", bytes) {
        Ok(map) => {
            map_holds(&map);
            Outcome::Read
        }
        Err(error) => {
            // So ends a panic of the crate, which would end a page.
            assert!(!error.to_string().contains("cannot be unpacked"), "{error}");
            refused(&error)
        }
    }
}

/// Every OpenEXR compression that the `exr` crate can write.
pub const COMPRESSIONS: [Compression; 10] = [
    Compression::Uncompressed,
    Compression::RLE,
    Compression::ZIP1,
    Compression::ZIP16,
    Compression::PIZ,
    Compression::PXR24,
    Compression::B44,
    Compression::B44A,
    Compression::DWAA(None),
    Compression::DWAB(None),
];

/// A small picture of each compression, in rows and in tiles.
fn seeds() -> Vec<Vec<u8>> {
    let kinds = COMPRESSIONS.into_iter().enumerate();
    kinds
        .flat_map(|(i, compression)| {
            let tiles = Blocks::Tiles(Vec2(32, 32));
            [Blocks::ScanLines, tiles].map(|blocks| picture(compression, blocks, i % 2 == 0))
        })
        .collect()
}

fn picture(compression: Compression, blocks: Blocks, is_half: bool) -> Vec<u8> {
    let value = |at: Vec2<usize>, k: usize| ((at.0 * 7 + at.1 * 13 + k * 3) % 50) as f32 * 0.25;
    let encoding = Encoding { compression, blocks, line_order: LineOrder::Increasing };
    let mut attributes = LayerAttributes::named("a");
    let scene = Text::new_or_none(document::to_json_compact(&Scene::default()));
    let scene = scene.expect("a default scene has no other letters");
    attributes
        .other
        .insert(export::SCENE_KEYWORD.into(), exr::prelude::AttributeValue::Text(scene));
    let mut bytes = Cursor::new(Vec::new());
    macro_rules! write {
        ($type:ty) => {{
            let channels = SpecificChannels::rgb(|at| {
                let channel = |k| <$type>::from(exr::prelude::f16::from_f32(value(at, k)));
                (channel(0), channel(1), channel(2))
            });
            let layer = Layer::new((37, 35), attributes, encoding, channels);
            Image::from_layer(layer).write().non_parallel().to_buffered(&mut bytes)
        }};
    }
    let written = if is_half { write!(exr::prelude::f16) } else { write!(f32) };
    written.expect("memory");
    bytes.into_inner()
}
