//! Tests of the writer against another encoder and decoder, and of the reader with damaged files.

use std::io::Cursor;

use image::{DynamicImage, ImageFormat, ImageReader};
use proptest::prelude::*;

use super::*;

const DOCUMENT: &str = r#"{"name":"Zürich → 雪"}"#;

/// Colours that change along both axes, with an edge.
fn picture([width, height]: [u32; 2]) -> Vec<u8> {
    let pixel = |x: u32, y: u32| {
        let edge = if (x / 5 + y / 9).is_multiple_of(2) { 40 } else { 0 };
        [(x * 255 / width) as u8, (y * 255 / height) as u8, (x + y) as u8 / 2 + edge]
    };
    (0..height).flat_map(|y| (0..width).flat_map(move |x| pixel(x, y))).collect()
}

fn written(size_px: [u32; 2], rgb: &[u8], bytes_at_once: usize, document: &str) -> Vec<u8> {
    let mut stream =
        JpegStream::new(Vec::new(), size_px, document, DEFAULT_QUALITY).expect("a size in range");
    for bytes in rgb.chunks(bytes_at_once) {
        stream.write_rgb(bytes).unwrap();
    }
    stream.finish().unwrap()
}

fn decoded(file: &[u8]) -> DynamicImage {
    ImageReader::with_format(Cursor::new(file), ImageFormat::Jpeg).decode().unwrap()
}

fn comments(file: &[u8]) -> usize {
    Segments::of(file).filter(|segment| segment.as_ref().unwrap().kind == marker::COM).count()
}

/// Joined strips decode to exactly what one piece does, whatever the sizes of the pieces written.
#[test]
fn strips_join_to_the_picture_in_one_piece() {
    // More than eight strips use each number of a restart marker.
    for (size_px, bytes_at_once) in
        [([101, 167], 7), ([8, 8], 192), ([1, 1], 3), ([16, 9], 1 << 20), ([300, 80], 300 * 3 * 5)]
    {
        let rgb = picture(size_px);
        let file = decoded(&written(size_px, &rgb, bytes_at_once, DOCUMENT));
        assert_eq!([file.width(), file.height()], size_px);
        let whole = decoded(&encoded(&rgb, size_px, DEFAULT_QUALITY).unwrap());
        assert_eq!(file.as_bytes(), whole.as_bytes(), "{size_px:?}");
        let error = rgb.iter().zip(file.as_bytes()).map(|(a, b)| a.abs_diff(*b)).max();
        assert!(error < Some(64), "{size_px:?}: {error:?}");
    }
}

#[test]
fn chroma_has_full_resolution_and_quality_costs_bytes() {
    let size_px = [64, 64];
    let rgb = picture(size_px);
    let file = written(size_px, &rgb, 999, DOCUMENT);
    let frame = Segments::of(&file).flatten().find(|segment| segment.kind == marker::SOF0);
    let components = frame.unwrap().content[6..].as_chunks::<3>().0;
    assert!(components.iter().all(|[_, sampling, _]| *sampling == 0x11), "{components:?}");
    assert_eq!(components.len(), 3);
    let bytes = |quality| {
        let mut stream = JpegStream::new(Vec::new(), size_px, DOCUMENT, quality).unwrap();
        stream.write_rgb(&rgb).unwrap();
        stream.finish().unwrap().len()
    };
    assert!(bytes(10) < bytes(60) && bytes(60) < bytes(100));
    assert_eq!((bytes(0), bytes(255)), (bytes(1), bytes(100)));
}

#[test]
fn missing_rows_further_rows_and_a_full_disk_are_errors() {
    let start = || JpegStream::new(Vec::new(), [4, 9], DOCUMENT, 80).unwrap();
    let mut stream = start();
    stream.write_rgb(&[0; 4 * 3 * 8]).unwrap();
    assert!(matches!(stream.finish(), Err(ExportError::Encode(_))));
    assert!(matches!(start().write_rgb(&[0; 4 * 3 * 9 + 1]), Err(ExportError::Encode(_))));

    let whole = written([4, 4], &[7; 48], 48, DOCUMENT);
    let mut short = vec![0; whole.len() - 1];
    let mut stream = JpegStream::new(short.as_mut_slice(), [4, 4], DOCUMENT, 80).unwrap();
    let result = stream.write_rgb(&[7; 48]).and_then(|()| stream.finish().map(|_| ()));
    assert!(matches!(result, Err(ExportError::Write(_))));
    for size_px in [[0, 1], [1, 0], [65_536, 1]] {
        assert!(JpegStream::new(Vec::new(), size_px, DOCUMENT, 80).is_err(), "{size_px:?}");
    }
}

#[test]
fn the_scene_round_trips_in_as_many_comments_as_it_needs() {
    for (document, count) in [
        (DOCUMENT.to_owned(), 1),
        ("x".repeat(PART_BYTES), 1),
        ("雪".repeat(PART_BYTES), 4),
        ("ß".repeat(MAX_TEXT_BYTES / 2), 17),
    ] {
        let file = written([5, 3], &[9; 45], 45, &document);
        assert!(is_jpeg(&file) && comments(&file) == count, "{}", comments(&file));
        assert_eq!(jpeg_scene_text(&file), Ok(Some(document)));
        assert_eq!(decoded(&file).width(), 5);
    }
}

/// A file of these comments, up to its first scan.
fn file_with(comments: &[&str]) -> Vec<u8> {
    let mut file = vec![0xFF, marker::SOI];
    for comment in comments {
        push_segment(&mut file, marker::COM, comment.as_bytes());
    }
    push_segment(&mut file, marker::SOS, &[0; 6]);
    file
}

#[test]
fn comments_come_in_any_order_and_those_of_others_are_ignored() {
    let read = |comments: &[&str]| jpeg_scene_text(&file_with(comments));
    assert_eq!(
        read(&["hello", "mandelight 2 of 2: }\0", "mandelight 1 of 2: {"]),
        Ok(Some("{}".into()))
    );
    assert_eq!(read(&["hello", "mandelight is a program: yes", "mandelight 1: {}"]), Ok(None));
    assert_eq!(read(&[]), Ok(None));
    for cut in [&["mandelight 2 of 2: }"][..], &["mandelight 0 of 1: }"]] {
        assert!(read(cut).unwrap_err().to_string().contains("missing"), "{cut:?}");
    }
    assert_eq!(read(&["mandelight 1 of 9999999999: {}"]), Err(SceneTextError::TooLarge));
    let long = "x".repeat(PART_BYTES);
    let parts: Vec<_> = (1..=17).map(|i| format!("mandelight {i} of 17: {long}")).collect();
    let parts: Vec<_> = parts.iter().map(String::as_str).collect();
    assert_eq!(read(&parts), Err(SceneTextError::TooLarge));
}

proptest! {
    #[test]
    fn damaged_files_never_panic(position in 0usize..800, byte: u8, cut in 0usize..1000) {
        let mut file = written([5, 4], &[99; 60], 60, DOCUMENT);
        let length = file.len();
        file[position % length] = byte;
        file.truncate(cut);
        let _ = (jpeg_scene_text(&file), jpeg_complete_size(Cursor::new(&file)));
    }

    #[test]
    fn random_bytes_never_panic(bytes in prop::collection::vec(any::<u8>(), 0..300)) {
        let _ = jpeg_scene_text(&[&[0xFF, marker::SOI, 0xFF], bytes.as_slice()].concat());
    }

    #[test]
    fn every_document_round_trips(document in "\\PC{1,300}") {
        let file = written([1, 1], &[1, 2, 3], 3, &document);
        prop_assert_eq!(jpeg_complete_size(Cursor::new(&file)), Ok(Some([1, 1])));
        prop_assert_eq!(jpeg_complete_size(Cursor::new(&file[..file.len() - 1])), Ok(None));
        prop_assert_eq!(jpeg_scene_text(&file), Ok(Some(document)));
    }
}
