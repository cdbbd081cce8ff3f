//! Tests of the readers against the crates `image` and `exr`, and of files made to do harm.

use std::io::{Cursor, Write as _};

use exr::prelude::{
    AnyChannel, AnyChannels, Blocks, Compression, Encoding, FlatSamples, Image, Layer,
    LayerAttributes, LineOrder, ReadChannels as _, ReadLayers as _, Vec2, WritableImage as _, f16,
};
use glam::Vec3;
use image::{ImageDecoder as _, codecs::hdr::HdrDecoder};
use mandelight_fuzzing::OPENEXR_COMPRESSIONS as COMPRESSIONS;
use proptest::prelude::*;

use super::*;
use crate::reading::openexr::MAX_ATTRIBUTES;

fn pixels(bytes: &[u8]) -> Result<Vec<Vec3>, DecodeError> {
    decode("a", bytes).map(|environment_map| environment_map.pixels().to_vec())
}

fn error(bytes: &[u8]) -> String {
    decode("a", bytes).expect_err("refused").to_string()
}

/// What `image` reads of a Radiance file, clamped as a map's pixels.
fn read_by_image(bytes: &[u8]) -> Option<Vec<Vec3>> {
    let decoder = HdrDecoder::new_nonstrict(Cursor::new(bytes)).ok()?;
    let (width, height) = decoder.dimensions();
    let mut values = vec![0.0_f32; 3 * width as usize * height as usize];
    decoder.read_image(bytemuck::cast_slice_mut(&mut values)).ok()?;
    let clamp = |value: f32| value.clamp(0.0, super::super::MAX_RADIANCE);
    Some(values.chunks_exact(3).map(|pixel| Vec3::from_slice(pixel).map(clamp)).collect())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(500))]

    /// Rows of every packing, as they come: what both readers read is the same.
    #[test]
    fn radiance_rows_are_read_as_image_reads_them(
        width in 1_u32..200,
        rows in proptest::collection::vec(
            (any::<bool>(), proptest::collection::vec((any::<u8>(), 1_u8..=128), 900)), 1..4),
    ) {
        let mut bytes = Vec::new();
        write!(bytes, "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {} +X {width}\n", rows.len()).unwrap();
        for (by_channel, runs) in &rows {
            let mut runs = runs.iter();
            if *by_channel {
                bytes.extend([2, 2, (width >> 8) as u8, width as u8]);
                for _ in 0..4 {
                    let mut left = width as usize;
                    while left > 0 {
                        let (value, count) = runs.next().copied().unwrap_or((7, 128));
                        if value % 2 == 0 {
                            let count = usize::from(count).min(left).min(127);
                            bytes.extend([128 + count as u8, value]);
                            left -= count;
                        } else {
                            let count = usize::from(count).min(left);
                            bytes.push(count as u8);
                            bytes.extend((0..count).map(|i| value.wrapping_mul(i as u8)));
                            left -= count;
                        }
                    }
                }
            } else {
                let mut left = width as usize;
                while left > 0 {
                    let (value, count) = runs.next().copied().unwrap_or((7, 1));
                    bytes.extend([value | 4, value, count, value]);
                    left -= 1;
                    let repeated = usize::from(count).min(left);
                    if value % 2 == 0 && repeated > 0 {
                        bytes.extend([1, 1, 1, repeated as u8]);
                        left -= repeated;
                    }
                }
            }
        }
        let expected = read_by_image(&bytes);
        prop_assert!(expected.is_some());
        prop_assert_eq!(pixels(&bytes).ok(), expected);
    }
}

#[test]
fn long_runs_of_the_old_packing_are_numbers_of_many_digits() {
    let mut bytes = b"#?RADIANCE\n\n-Y 1 +X 600\n".to_vec();
    bytes.extend([9, 8, 7, 130, 1, 1, 1, 87, 1, 1, 1, 2]);
    assert_eq!(pixels(&bytes).ok(), read_by_image(&bytes));
    assert_eq!(pixels(&bytes).map(|pixels| pixels.len()), Ok(600));
    for digits in [&[1, 1, 1, 255].repeat(9)[..], &[1, 1, 1, 0].repeat(99)] {
        let mut bytes = b"#?RADIANCE\n\n-Y 1 +X 600\n\x09\x09\x09\x80".to_vec();
        bytes.extend(digits);
        assert!(error(&bytes).contains("does not fit its row"), "{}", error(&bytes));
    }
}

#[test]
fn radiance_headers_are_refused_by_name() {
    for (header, said) in [
        ("FORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n", "FORMAT=32-bit_rle_xyze cannot be read"),
        ("\n+Y 1 +X 1\n", "save the picture as -Y +X"),
        ("\n-Y 1\n", "is no line -Y HEIGHT +X WIDTH"),
        ("\n-Y one +X 1\n", "\"one\" is no number of pixels"),
        ("\u{1b}[2J=\n\u{1b}[2J\n\n\u{1b}[2J\n", "\\u{1b}[2J"),
        ("EXPOSURE=nan\n\n-Y 1 +X 1\n", "EXPOSURE=nan is no factor above 0"),
        ("\n-Y 2 +X 9\n\x02\x02\x00\x08", "a row has 8 pixels instead of 9"),
        ("\n-Y 2 +X 9\n\x02\x02\x00\x09\x00", "does not fit its row"),
        ("\n-Y 2 +X 9\n\x02\x02\x00\x09\x05", "the file ends within the pixels"),
    ] {
        let error = error(format!("#?RADIANCE\n{header}").as_bytes());
        assert!(error.contains(said) && !error.contains(char::is_control), "{error:?}");
    }
    let long = format!("#?RADIANCE\n{}\n-Y 1 +X 1\n", "a=b\n".repeat(20_000));
    assert!(error(long.as_bytes()).contains("the header has more than 65536 bytes"));
    let line = format!("#?RADIANCE\n{}\n", "a".repeat(100_000));
    assert!(error(line.as_bytes()).contains("the header has more than 65536 bytes"));
}

/// A file of one or two layers with the channels A, B, G, R and Z of three sample types.
fn exr_file(size: [usize; 2], compression: Compression, blocks: Blocks, layers: usize) -> Vec<u8> {
    let count = size[0] * size[1];
    let value = |i: usize, k: usize| ((i * 7 + k * 3) % 50) as f32 * 0.25;
    let halves = |k| FlatSamples::F16((0..count).map(|i| f16::from_f32(value(i, k))).collect());
    let floats = |k| FlatSamples::F32((0..count).map(|i| value(i, k)).collect());
    // The lossy compressions read channels of these names in halves or floats only.
    let channels = |extra: &str| {
        vec![
            AnyChannel::new("A", halves(1)),
            AnyChannel::new(format!("B{extra}").as_str(), floats(2)),
            AnyChannel::new("G", halves(3)),
            AnyChannel::new("R", halves(4)),
            AnyChannel::new("Z", FlatSamples::U32((0..count).map(|i| i as u32).collect())),
        ]
    };
    let encoding = Encoding { compression, blocks, line_order: LineOrder::Increasing };
    let layer = |name: &str, extra: &str| {
        let channels = AnyChannels::sort(channels(extra).into());
        Layer::new(Vec2(size[0], size[1]), LayerAttributes::named(name), encoding, channels)
    };
    let mut bytes = Cursor::new(Vec::new());
    if layers == 1 {
        let image = Image::from_layer(layer("one", ""));
        image.write().non_parallel().to_buffered(&mut bytes).unwrap();
    } else {
        // The first layer has no channel B.
        let layers = [layer("first", "X"), layer("second", "")];
        let attributes = exr::prelude::ImageAttributes::with_size(Vec2(size[0], size[1]));
        let image = Image::from_layers(attributes, exr::prelude::Layers::from_iter(layers));
        image.write().non_parallel().to_buffered(&mut bytes).unwrap();
    }
    bytes.into_inner()
}

/// What the crate reads of a whole file.
fn read_by_exr(bytes: &[u8]) -> Vec<Vec3> {
    let image = exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .rgb_channels(
            |size, _| (size.width(), vec![Vec3::ZERO; size.area()]),
            |(width, pixels), at, (r, g, b): (f32, f32, f32)| {
                pixels[at.y() * *width + at.x()] = Vec3::new(r, g, b);
            },
        )
        .first_valid_layer()
        .all_attributes()
        .non_parallel()
        .from_buffered(Cursor::new(bytes))
        .unwrap();
    let clamp = |value: f32| value.clamp(0.0, super::super::MAX_RADIANCE);
    image.layer_data.channel_data.pixels.1.iter().map(|pixel| pixel.map(clamp)).collect()
}

#[test]
fn openexr_files_are_read_as_the_crate_reads_them() {
    for compression in COMPRESSIONS {
        for blocks in [Blocks::ScanLines, Blocks::Tiles(Vec2(32, 33))] {
            for layers in [1, 2] {
                let bytes = exr_file([45, 37], compression, blocks, layers);
                let read = pixels(&bytes).unwrap_or_else(|error| panic!("{compression}: {error}"));
                assert_eq!(read, read_by_exr(&bytes), "{compression}, {blocks:?}, {layers}");
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    /// A panic of the crate is an error here; on the web it would end the page.
    #[test]
    fn damaged_blocks_are_unpacked_or_refused_without_a_panic(
        compression in 0..COMPRESSIONS.len(),
        is_tiled in any::<bool>(),
        changes in proptest::collection::vec((0.0..1.0_f64, any::<u8>()), 1..8),
    ) {
        let blocks = if is_tiled { Blocks::Tiles(Vec2(32, 33)) } else { Blocks::ScanLines };
        let mut bytes = exr_file([45, 37], COMPRESSIONS[compression], blocks, 1);
        // The headers take a few hundred bytes.
        let start = bytes.len().min(400);
        for (at, value) in changes {
            let at = start + (at * (bytes.len() - start) as f64) as usize;
            bytes[at] = value;
        }
        if let Err(error) = decode("damaged", &bytes) {
            prop_assert!(!error.to_string().contains("cannot be unpacked"), "{error}");
        }
    }
}

/// Sets the bytes at `at`.
fn patched(bytes: &[u8], at: usize, new: &[u8]) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    bytes[at..at + new.len()].copy_from_slice(new);
    bytes
}

fn position(bytes: &[u8], of: &[u8]) -> usize {
    bytes.windows(of.len()).position(|window| window == of).expect("in the file")
}

#[test]
fn sizes_that_an_openexr_file_declares_are_checked() {
    let whole = exr_file([45, 37], Compression::ZIP16, Blocks::ScanLines, 1);
    let tiled = exr_file([45, 37], Compression::ZIP16, Blocks::Tiles(Vec2(32, 33)), 1);
    let after = |bytes: &[u8], text: &[u8]| position(bytes, text) + text.len() + 4;
    let window = after(&whole, b"dataWindow\0box2i\0");
    let tiles = after(&tiled, b"tiles\0tiledesc\0");
    let compression = after(&whole, b"compression\0compression\0");
    let channels = after(&whole, b"channels\0chlist\0");
    for (bytes, said) in [
        (patched(&whole, 4, &[3]), "the OpenEXR version"),
        (patched(&whole, window + 8, &i32::MAX.to_le_bytes()), "the picture has 2147483648x37"),
        (patched(&whole, window, &i32::MIN.to_le_bytes()), "the picture has 2147483693x37"),
        (patched(&whole, window + 8, &(-1_i32).to_le_bytes()), "the picture has 0x37"),
        (patched(&whole, window + 12, &8000_i32.to_le_bytes()), "within the table of offsets"),
        (patched(&whole, window + 12, &47_i32.to_le_bytes()), "the picture cannot be read"),
        (patched(&whole, window - 4, &i32::MAX.to_le_bytes()), "lies behind the end of the file"),
        (patched(&whole, window - 4, &(-1_i32).to_le_bytes()), "an attribute has no size"),
        (patched(&tiled, tiles, &[0; 4]), "the tiles have no size"),
        (patched(&tiled, tiles, &[1, 0, 0, 0, 1, 0, 0, 0]), "tiles of at least 32 x 32"),
        (patched(&tiled, tiles, &[45]), "the picture cannot be read"),
        (patched(&whole, compression, &[11]), "compression 11 cannot be read"),
        (patched(&whole, compression, &[0]), "a block of pixels"),
        (patched(&whole, channels + 2, &[9]), "the list of channels is damaged"),
        (patched(&whole, channels + 10, &[2]), "without subsampling"),
        (patched(&whole, channels + 10, &[0]), "without subsampling"),
        (whole[..whole.len() - 1].to_vec(), "the file ends within a block of pixels"),
        (whole[..60].to_vec(), "the file ends within"),
        (whole[..5].to_vec(), "the file ends within the version"),
    ] {
        let error = error(&bytes);
        assert!(error.contains(said), "{error}, and not {said}");
    }
}

/// A header alone, of these attributes: name, type and value.
fn header(attributes: &[(&str, &str, &[u8])]) -> Vec<u8> {
    let mut bytes = vec![0x76, 0x2f, 0x31, 0x01, 2, 0, 0, 0];
    for (name, kind, value) in attributes {
        write!(bytes, "{name}\0{kind}\0").unwrap();
        bytes.extend((value.len() as i32).to_le_bytes());
        bytes.extend(*value);
    }
    bytes.push(0);
    bytes
}

/// A list of channels of this sample type.
fn channel_list(names: &[String], kind: u8) -> Vec<u8> {
    let mut bytes = Vec::new();
    for name in names {
        write!(bytes, "{name}\0").unwrap();
        bytes.extend([kind, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0]);
    }
    bytes.push(0);
    bytes
}

#[test]
fn counts_beyond_their_limits_are_refused_by_name() {
    let many = vec![("a", "b", &b""[..]); MAX_ATTRIBUTES + 1];
    assert!(error(&header(&many)).contains("more than 1000 attributes, the most that are read"));
    assert!(error(&header(&many[1..])).contains("no part has the channels R, G and B"));
    let rgb = |count: usize| {
        let extra = (3..count).map(|i| format!("x{i}"));
        ["R", "G", "B"].map(str::to_owned).into_iter().chain(extra).collect::<Vec<_>>()
    };
    let of = |channels: usize, size: [i32; 2], compression: u8, tiles: Option<[u32; 2]>| {
        let list = channel_list(&rgb(channels), 2);
        let window = [0, 0, size[0] - 1, size[1] - 1].map(i32::to_le_bytes).concat();
        let mut attributes = vec![
            ("channels", "chlist", &list[..]),
            ("compression", "compression", std::slice::from_ref(&compression)),
            ("dataWindow", "box2i", &window),
        ];
        let tiles = tiles.map(|sides| sides.map(u32::to_le_bytes).concat());
        if let Some(tiles) = &tiles {
            attributes.push(("tiles", "tiledesc", tiles));
        }
        let mut bytes = header(&attributes);
        bytes[5] = if tiles.is_some() { 2 } else { 0 };
        error(&bytes)
    };
    assert!(of(MAX_CHANNELS + 1, [9, 9], 3, None).contains("more than 64 channels"));
    assert!(of(MAX_CHANNELS, [9, 9], 3, None).contains("the file ends within the table"));
    assert!(of(3, [8192, 4097], 3, None).contains("the limits are 1x1 to 8192x8192"));
    assert!(of(3, [4096, 8192], 2, None).contains("the file ends within the table"));
    let blocks = of(3, [8192, 4096], 3, Some([64, 63]));
    assert!(blocks.contains("has 8448 blocks, and at most 8192 are read"), "{blocks}");
    for sides in [[1, 1], [31, 8192], [8192, 31]] {
        assert!(of(3, [8192, 4096], 3, Some(sides)).contains("tiles of at least 32 x 32 pixels"));
    }
    assert!(of(3, [9, 9], 3, Some([9, 20])).contains("the file ends within the table"));
    let bytes = of(3, [8192, 4096], 3, Some([8192, 4096]));
    assert!(bytes.contains("has 402653184 bytes, and at most 8388608 are read"), "{bytes}");
    assert!(of(4, [8192, 4096], 9, None).contains("has 33554432 bytes"));
}

/// The numbers at the start of a DWA block, each set beyond what the block may have.
#[test]
fn sizes_within_dwa_blocks_are_checked() {
    for compression in [Compression::DWAA(None), Compression::DWAB(None)] {
        let whole = exr_file([45, 37], compression, Blocks::ScanLines, 1);
        assert!(pixels(&whole).is_ok());
        // The first block follows the table: y = 0, its size, then the version 2 of its numbers.
        let start = whole
            .windows(16)
            .rposition(|w| w[..4] == [0; 4] && w[6..8] == [0; 2] && w[8..] == 2_u64.to_le_bytes())
            .expect("a DWA block")
            + 8;
        for number in 1..10 {
            for value in [1 << 60, 1 << 40, 1 << 31, 1 << 20] {
                let bytes = patched(&whole, start + 8 * number, &u64::to_le_bytes(value));
                assert!(error(&bytes).contains("a block of pixels is damaged"), "{number} {value}");
            }
        }
    }
}

#[test]
fn the_documentation_has_the_limits() {
    let text = include_str!("../../../../docs/scene.md");
    let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
    let [width, height] = [MAX_SOURCE_PX[0], MAX_SOURCE_PIXELS as u32 / MAX_SOURCE_PX[0]];
    for limit in [
        format!("at most {width} × {height} pixels and {} MiB", MAX_FILE_BYTES >> 20),
        format!("at most {} KiB", MAX_HEADER_BYTES >> 10),
        format!("at most {MAX_CHANNELS} channels"),
        format!("{MAX_ATTRIBUTES} attributes"),
        format!("{MAX_BLOCKS} blocks of {} MiB", MAX_BLOCK_BYTES >> 20),
        format!("at most {} MiB unpacked", MAX_PIXEL_BYTES >> 20),
        format!("tiles at least {MIN_TILE_PX} × {MIN_TILE_PX} pixels"),
    ] {
        assert!(text.contains(&limit), "docs/scene.md does not say {limit}");
    }
}
