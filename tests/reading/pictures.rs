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
pub fn largest_radiance() -> Vec<u8> {
    let mut bytes = b"#?RADIANCE\n\n-Y 4096 +X 8192\n".to_vec();
    // 1 + 255 + 31 · 256 pixels.
    bytes.extend([9, 8, 7, 130, 1, 1, 1, 255, 1, 1, 1, 31].repeat(4096));
    bytes
}

#[test]
fn the_largest_radiance_picture_is_read_row_by_row() {
    let alone = alone();
    let bytes = largest_radiance();
    let (result, total) = measured(&alone, || decode("a", &bytes));
    assert_eq!(result.expect("a picture").size_px(), [2048, 1024]);
    // Each row allocates a short list of its own.
    assert!(total < 2 * MAP_BYTES, "{total} bytes");
}

/// The header of an OpenEXR file of rows, uncompressed, with channels of 32 bits.
pub fn exr_header([width, height]: [u32; 2], channels: usize) -> Vec<u8> {
    let mut list = Vec::new();
    for index in 0..channels {
        let name =
            ["B", "G", "R"].get(index).map_or(format!("a{index}"), |name| (*name).to_owned());
        list.extend([name.as_bytes(), b"\0\x02\0\0\0\0\0\0\0\x01\0\0\0\x01\0\0\0"].concat());
    }
    list.push(0);
    let window = [0, 0, width - 1, height - 1].map(u32::to_le_bytes).concat();
    let mut header = b"\x76\x2f\x31\x01\x02\0\0\0".to_vec();
    for (name, kind, value) in [
        ("channels", "chlist", &list),
        ("compression", "compression", &vec![0]),
        ("dataWindow", "box2i", &window),
    ] {
        let size = (value.len() as u32).to_le_bytes();
        header.extend([name.as_bytes(), b"\0", kind.as_bytes(), b"\0", &size, value].concat());
    }
    header.push(0);
    header
}

/// An OpenEXR file as of [`exr_header`]. Where blocks overlap, all of their headers precede the pixels of the last.
pub fn exr_rows(size_px: [u32; 2], channels: usize, blocks_overlap: bool) -> Vec<u8> {
    let [width, height] = size_px;
    let row_bytes = 4 * width * channels as u32;
    let mut bytes = exr_header(size_px, channels);
    let first = bytes.len() as u64 + 8 * u64::from(height);
    let step = if blocks_overlap { 8 } else { 8 + u64::from(row_bytes) };
    bytes.extend((0..u64::from(height)).flat_map(|row| (first + row * step).to_le_bytes()));
    for row in 0..height {
        bytes.extend([row, row_bytes].map(u32::to_le_bytes).concat());
        if !blocks_overlap || row + 1 == height {
            bytes.resize(bytes.len() + row_bytes as usize, 0);
        }
    }
    bytes
}

/// With 64 channels, blocks within their limit would be 8 GiB in all.
#[test]
fn too_many_bytes_of_pixels_are_refused_by_the_header() {
    let alone = alone();
    for (channels, part) in [(5, "the pixels have 671088640 bytes unpacked"), (4, "the file ends")]
    {
        let bytes = exr_header([8192, 4096], channels);
        let (result, total) = measured(&alone, || decode("a", &bytes));
        let error = result.expect_err("refused").to_string();
        assert!(error.contains(part), "{error}");
        assert!(total < 1 << 20, "{error}: {total} bytes");
    }
}

pub fn exr_file(size: [usize; 2], compression: Compression) -> Vec<u8> {
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
