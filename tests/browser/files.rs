//! Files that are dropped on the page, good and bad ones.

use std::{fs, io::Cursor};

use exr::prelude::{
    Compression, Encoding, Image, Layer, LayerAttributes, SpecificChannels, Vec2,
    WritableImage as _, f16,
};
use image::{Rgb, codecs::hdr::HdrEncoder};
use mandelight::{
    export::png::PngStream,
    scene::{document, environment_map, presets},
};

use crate::visit::{Visit, folder_of};

/// Width and height of the maps, in pixels.
const SIZE_PX: [usize; 2] = [64, 32];

/// Files of each format by their names, all of different pixels.
fn environment_maps() -> [(&'static str, Vec<u8>); 2] {
    [("sky.hdr", radiance()), ("sky.exr", openexr())]
}

/// A value of each pixel and channel, from 0.01 to 100.
fn value(x: usize, y: usize, channel: usize) -> f32 {
    10_f32.powf(((x * 7 + y * 13 + channel * 5) % 41) as f32 / 10.0 - 2.0)
}

fn radiance() -> Vec<u8> {
    let pixel = |i: usize| Rgb([0, 1, 2].map(|k| value(i % SIZE_PX[0], i / SIZE_PX[0], k)));
    let pixels: Vec<_> = (0..SIZE_PX[0] * SIZE_PX[1]).map(pixel).collect();
    let mut bytes = Vec::new();
    HdrEncoder::new(&mut bytes).encode(&pixels, SIZE_PX[0], SIZE_PX[1]).unwrap();
    bytes
}

fn openexr() -> Vec<u8> {
    let half = |at: Vec2<usize>, k: usize| f16::from_f32(value(at.1, at.0, k));
    let channels = SpecificChannels::rgb(move |at| (half(at, 0), half(at, 1), half(at, 2)));
    let encoding = Encoding { compression: Compression::PIZ, ..Encoding::default() };
    let attributes = LayerAttributes::named("sky");
    let layer = Layer::new((SIZE_PX[0], SIZE_PX[1]), attributes, encoding, channels);
    let mut bytes = Cursor::new(Vec::new());
    Image::from_layer(layer).write().non_parallel().to_buffered(&mut bytes).unwrap();
    bytes.into_inner()
}

/// Bytes by which the page's memory may grow beside a decoder that takes 128 MiB: texts and glyphs.
const MAX_GROWTH_BYTES: f64 = (8 << 20) as f64;

#[test]
fn a_bad_file_costs_that_file_only() {
    let folder = folder_of("dropped-files");
    fs::create_dir_all(&folder).unwrap();
    for (name, bytes) in environment_maps() {
        fs::write(folder.join(name), bytes).unwrap();
    }
    let scene = (presets::opening_scenes()[2].scene)();
    let mut png = PngStream::new(Vec::new(), [8, 8], &document::to_json(&scene)).unwrap();
    png.write_pixels(&[0; 8 * 8 * 3]).unwrap();
    fs::write(folder.join("scene.png"), png.finish().unwrap()).unwrap();
    fs::write(folder.join("colors.map"), "255 0 0\n0 0 255\n").unwrap();

    let visit = Visit::run_with("files", [("MANDELIGHT_FILES", &folder)]);
    for (name, bytes) in environment_maps() {
        let native = environment_map::decode(name, &bytes).unwrap();
        let seen = &visit.seen["maps"][name];
        let size_px = ["width", "height"].map(|side| seen[side].as_u64().unwrap() as u32);
        assert_eq!(size_px, native.size_px(), "{name}");
        let pixels = seen["pixels"].as_array().unwrap();
        let pixels: Vec<f32> = pixels.iter().map(|it| it.as_f64().unwrap() as f32).collect();
        let natively: Vec<f32> = native.pixels().iter().flat_map(|it| it.to_array()).collect();
        assert!(pixels == natively, "{name} is another map in the page");
        assert!(native.energy().min_element() > 0.0, "{name} is black");
    }
    assert_eq!(visit.scene("dropped"), scene);

    let failures = visit.seen["failures"].as_array().unwrap();
    assert_eq!(failures.len(), 3 + fs::read_dir("tests/browser/damaged").unwrap().count());
    for failure in failures {
        assert_eq!(failure["isSame"], true, "{failure}");
        assert!(failure["grown"].as_f64().unwrap() < MAX_GROWTH_BYTES, "{failure}");
    }
    assert_eq!(visit.seen["reading"], false);
    assert_eq!(visit.seen["newest"], "newer.hdr");
    assert_eq!(visit.seen["workers"], 0, "a worker outlives its file");
}
