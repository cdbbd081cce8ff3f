//! Tests of the writer against the crate's decoder, and of the reader with damaged files.

use std::io::Cursor;

use image_webp::WebPDecoder;
use proptest::prelude::*;

use super::*;
use crate::export::{MAX_TEXT_BYTES, MAX_WEBP_PIXELS, MAX_WEBP_PX};

const DOCUMENT: &str = r#"{"name":"Zürich → 雪 <&amp;> \"'"}"#;

fn written(size_px: [u32; 2], rgb: &[u8], bytes_at_once: usize, document: &str) -> Vec<u8> {
    let mut stream = WebPStream::new(Vec::new(), size_px, document, false).unwrap();
    for bytes in rgb.chunks(bytes_at_once) {
        stream.write_pixels(bytes).unwrap();
    }
    stream.finish().unwrap()
}

fn decoder(file: &[u8]) -> WebPDecoder<Cursor<&[u8]>> {
    WebPDecoder::new(Cursor::new(file)).unwrap()
}

fn decoded(file: &[u8]) -> Vec<u8> {
    let mut decoder = decoder(file);
    let mut rgb = vec![0; decoder.output_buffer_size().unwrap()];
    decoder.read_image(&mut rgb).unwrap();
    rgb
}

#[test]
fn the_scene_round_trips_in_xmp() {
    // Documents of an even and of an odd length: chunks are padded.
    for document in [DOCUMENT.to_owned(), format!("{DOCUMENT} "), " ".repeat(MAX_TEXT_BYTES)] {
        let file = written([3, 2], &[9; 18], 5, &document);
        assert!(is_webp(&file));
        assert_eq!(webp_scene_text(&file), Ok(Some(document.clone())));
        let packet = decoder(&file).xmp_metadata().unwrap().unwrap();
        assert_eq!(packet, xmp(&document).into_bytes());
        assert_eq!(u32::from_le_bytes(file[4..8].try_into().unwrap()) as usize, file.len() - 8);
        // The document precedes the pixels, so the start of a file is enough.
        let start = &file[..file.len() - 10];
        assert_eq!(webp_scene_text(start), Ok(Some(document)));
    }
}

#[test]
fn sizes_beyond_the_format_are_refused_before_the_first_row() {
    for size_px in [[0, 5], [MAX_WEBP_PX + 1, 1], [1, MAX_WEBP_PX + 1], [8193, 8192]] {
        let refused =
            WebPStream::new(Vec::new(), size_px, DOCUMENT, false).err().expect("an error");
        assert!(matches!(refused, ExportError::WebPSize(_)), "{size_px:?}: {refused}");
        assert!(refused.to_string().contains("16383"), "{refused}");
    }
    for size_px in [[MAX_WEBP_PX, 1], [1, MAX_WEBP_PX], [8192, 8192]] {
        assert!(checked_webp_size(size_px).is_ok(), "{size_px:?}");
    }
    assert_eq!(MAX_WEBP_PIXELS, 8192 * 8192);
    let file = written([MAX_WEBP_PX, 1], &vec![7; 3 * MAX_WEBP_PX as usize], 1000, DOCUMENT);
    assert_eq!(decoder(&file).dimensions(), (MAX_WEBP_PX, 1));
}

#[test]
fn missing_rows_further_rows_and_a_full_disk_are_errors() {
    let start = || WebPStream::new(Vec::new(), [4, 4], DOCUMENT, false).unwrap();
    let mut stream = start();
    stream.write_pixels(&[0; 4 * 3 * 3]).unwrap();
    assert!(matches!(stream.finish(), Err(ExportError::Encode(_))));
    assert!(matches!(start().write_pixels(&[0; 49]), Err(ExportError::Encode(_))));

    let mut short = vec![0; written([4, 4], &[7; 48], 48, DOCUMENT).len() - 1];
    let mut stream = WebPStream::new(short.as_mut_slice(), [4, 4], DOCUMENT, false).unwrap();
    stream.write_pixels(&[7; 48]).unwrap();
    assert!(matches!(stream.finish(), Err(ExportError::Write(_))));
}

#[test]
fn alpha_round_trips_and_is_announced() {
    let rgba: Vec<u8> = (0..4 * 35).map(|i| (i * 13 % 256) as u8).collect();
    let mut stream = WebPStream::new(Vec::new(), [7, 5], DOCUMENT, true).unwrap();
    stream.write_pixels(&rgba).unwrap();
    let file = stream.finish().unwrap();
    assert!(decoder(&file).has_alpha());
    assert_eq!(decoded(&file), rgba);
    assert!(!decoder(&written([1, 1], &[1, 2, 3], 3, DOCUMENT)).has_alpha());
}

/// A file with this XMP packet and no pixels.
fn file_with(packet: &str) -> Vec<u8> {
    let mut file = b"RIFF\0\0\0\0WEBP".to_vec();
    push_chunk(&mut file, b"odd?", b"abc");
    push_chunk(&mut file, b"XMP ", packet.as_bytes());
    file
}

#[test]
fn packets_that_other_programs_have_rewritten_are_read() {
    let read = |packet: &str| webp_scene_text(&file_with(packet));
    let is_empty_object = Ok(Some("{}".to_owned()));
    assert_eq!(read("<a mandelight:scene=\"{}\" b=\"\"/>"), is_empty_object);
    assert_eq!(read("<a mandelight:scene='{}'/>"), is_empty_object);
    assert_eq!(read("<mandelight:scene>&#123;&#x7d;</mandelight:scene>"), is_empty_object);
    assert_eq!(read("mandelight:scenery <mandelight:scene>{}"), is_empty_object);
    assert_eq!(
        read("<mandelight:scene>&quot;&apos;&amp;lt;&x;&#xd800;&"),
        Ok(Some("\"'&lt;&x;&#xd800;&".to_owned()))
    );
    for other in
        ["", "<x:xmpmeta/>", "mandelight:scene", "mandelight:scene=", "mandelight:scene=雪"]
    {
        assert_eq!(read(other), Ok(None), "{other:?}");
    }
    let long = format!("<mandelight:scene>{}", " ".repeat(MAX_TEXT_BYTES + 1));
    assert_eq!(read(&long), Err(SceneTextError::TooLarge));
    let cut = file_with(&long);
    assert!(webp_scene_text(&cut[..cut.len() / 2]).is_err());
}

proptest! {
    #[test]
    fn pixels_round_trip(
        width in 1u32..40,
        height in 1u32..40,
        seed: u8,
        at_once in 1usize..500,
        document in "\\PC{0,300}",
    ) {
        let bytes = 3 * (width * height) as usize;
        let rgb: Vec<u8> =
            (0..bytes).map(|i| ((i * i / 7) as u8).wrapping_mul(seed)).collect();
        let file = written([width, height], &rgb, at_once, &document);
        prop_assert_eq!(decoder(&file).dimensions(), (width, height));
        prop_assert_eq!(decoded(&file), rgb);
        prop_assert_eq!(webp_complete_size(Cursor::new(&file)), Ok(Some([width, height])));
        prop_assert_eq!(webp_complete_size(Cursor::new(&file[..file.len() - 1])), Ok(None));
        prop_assert_eq!(webp_scene_text(&file), Ok(Some(document)));
    }

    #[test]
    fn damaged_files_never_panic(position in 0usize..800, byte: u8, cut in 0usize..1000) {
        let mut file = written([5, 4], &[99; 60], 60, DOCUMENT);
        let length = file.len();
        file[position % length] = byte;
        file.truncate(cut);
        let _ = (webp_scene_text(&file), webp_complete_size(Cursor::new(&file)));
    }

    #[test]
    fn random_packets_never_panic(packet in "(mandelight:scene|[=<>&;#x'\"a1雪]){0,12}") {
        let _ = webp_scene_text(&file_with(&packet));
    }
}
