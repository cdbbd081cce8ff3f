//! Environment maps to drop on the page.

use std::io::Cursor;

use exr::prelude::{
    Compression, Encoding, Image, Layer, LayerAttributes, SpecificChannels, Vec2,
    WritableImage as _, f16,
};
use image::{Rgb, codecs::hdr::HdrEncoder};

/// Width and height of the maps, in pixels.
const SIZE_PX: [usize; 2] = [64, 32];

/// Files of each format by their names, all of different pixels.
pub fn environment_maps() -> [(&'static str, Vec<u8>); 2] {
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
