//! Environment maps.

use std::io::Cursor;

use exr::prelude::{
    Blocks, Compression, Encoding, Image, Layer, LayerAttributes, LineOrder, SpecificChannels,
    Vec2, WritableImage as _, f16,
};
use mandelight::scene::environment_map::decode;

use super::{alone, measured};

/// Bytes of the largest map, and a little more.
const MAP_BYTES: usize = (2048 * 1024 * 12) + (1 << 20);

#[test]
fn endless_headers_are_refused_without_keeping_them() {
    let alone = alone();
    let lines = format!("#?RADIANCE\n{}", "a=b\n".repeat(4_200_000));
    let one_line = format!("#?RADIANCE\n{}", "a".repeat(16 << 20));
    let comments = format!("#?RADIANCE\n{}", "#\n".repeat(8 << 20));
    let attribute = b"a\0b\0\0\0\0\0";
    let attributes = [b"\x76\x2f\x31\x01\x02\0\0\0", &attribute.repeat(300_000)[..]].concat();
    let part = b"a\0b\0\0\0\0\0\0";
    let parts = [b"\x76\x2f\x31\x01\x02\x10\0\0", &part.repeat(300_000)[..]].concat();
    let names = [b"\x76\x2f\x31\x01\x02\0\0\0", &b"a".repeat(16 << 20)[..]].concat();
    let channels = b"c\0\x01\0\0\0\0\0\0\0\x01\0\0\0\x01\0\0\0".repeat(500_000);
    let size = (channels.len() as i32).to_le_bytes();
    let channels = [b"\x76\x2f\x31\x01\x02\0\0\0channels\0chlist\0", &size[..], &channels].concat();
    for bytes in [
        lines.as_bytes(),
        one_line.as_bytes(),
        comments.as_bytes(),
        &attributes,
        &parts,
        &names,
        &channels,
    ] {
        let (result, total) = measured(&alone, || decode("a", bytes));
        let error = result.expect_err("refused").to_string();
        assert!(error.contains("more than"), "{error}");
        assert!(total < 1 << 20, "{error}: {total} bytes");
    }
}

/// Files of a few bytes that declare the largest picture, and no file says enough for it.
#[test]
fn declared_sizes_allocate_at_most_a_map() {
    let alone = alone();
    for bytes in [
        &b"#?RADIANCE\n\n-Y 4096 +X 8192\n\x01\x02\x03\x80"[..],
        b"#?RADIANCE\n\n-Y 4294967296 +X 8192\n",
        b"#?RADIANCE\n\n-Y 99999999999999999999999 +X 8192\n",
    ] {
        let (result, total) = measured(&alone, || decode("a", bytes));
        result.expect_err("refused");
        assert!(total < MAP_BYTES, "{total} bytes");
    }
}

/// The largest Radiance picture, each row a pixel and its repetitions.
#[test]
fn the_largest_radiance_picture_is_read_row_by_row() {
    let alone = alone();
    let mut bytes = b"#?RADIANCE\n\n-Y 4096 +X 8192\n".to_vec();
    // 1 + 255 + 31 · 256 pixels.
    bytes.extend([9, 8, 7, 130, 1, 1, 1, 255, 1, 1, 1, 31].repeat(4096));
    let (result, total) = measured(&alone, || decode("a", &bytes));
    assert_eq!(result.expect("a picture").size_px(), [2048, 1024]);
    // Each row allocates a short list of its own.
    assert!(total < 2 * MAP_BYTES, "{total} bytes");
}

fn exr_file(size: [usize; 2], compression: Compression) -> Vec<u8> {
    let noise = |at: Vec2<usize>, k: usize| {
        let index = (at.0 * 7919 + at.1 * 104_729 + k * 1_299_709) as u64;
        let bits = index.wrapping_mul(0x9e37_79b9_7f4a_7c15);
        f16::from_f32((bits >> 40) as f32 / 65536.0)
    };
    let channels = SpecificChannels::rgb(move |at| (noise(at, 0), noise(at, 1), noise(at, 2)));
    let encoding =
        Encoding { compression, blocks: Blocks::ScanLines, line_order: LineOrder::Increasing };
    let layer = Layer::new((size[0], size[1]), LayerAttributes::named("a"), encoding, channels);
    let mut bytes = Cursor::new(Vec::new());
    Image::from_layer(layer).write().non_parallel().to_buffered(&mut bytes).expect("a picture");
    bytes.into_inner()
}

/// The largest blocks of each compression: [`measured`] limits the memory.
#[test]
fn openexr_pictures_are_read_block_by_block() {
    let alone = alone();
    for (size, compression) in [
        ([8192, 64], Compression::Uncompressed),
        ([8192, 64], Compression::ZIP16),
        ([8192, 64], Compression::PIZ),
        ([8192, 64], Compression::PXR24),
        ([8192, 64], Compression::B44),
        ([8192, 64], Compression::DWAA(None)),
        ([4096, 512], Compression::DWAB(None)),
    ] {
        let bytes = exr_file(size, compression);
        let (result, _) = measured(&alone, || decode("a", &bytes));
        assert_eq!(result.expect("a picture").size_px(), [2048, size[1] as u32]);
    }
}

/// A block of the compression DWA whose own numbers ask for more than the block can have.
#[test]
fn sizes_within_a_block_allocate_nothing_before_they_are_checked() {
    let alone = alone();
    let whole = exr_file([64, 64], Compression::DWAA(None));
    let version = 2_u64.to_le_bytes();
    let start = whole.windows(8).position(|bytes| bytes == version).expect("a DWA block");
    for number in 1..10 {
        for value in [1_u64 << 62, 1 << 40, 1 << 31, 1 << 26] {
            let mut bytes = whole.clone();
            bytes[start + 8 * number..][..8].copy_from_slice(&value.to_le_bytes());
            let (result, total) = measured(&alone, || decode("a", &bytes));
            let error = result.expect_err("refused").to_string();
            assert!(error.contains("a block of pixels is damaged"), "{error}");
            assert!(total < 1 << 20, "{number}: {total} bytes");
        }
    }
}
