//! Pictures that hold a scene, as long as they are read, and with the longest text.

use std::{io::Cursor, sync::MutexGuard};

use mandelight::{
    export::{
        MAX_HEADER_BYTES, MAX_TEXT_BYTES, SceneTextError, jpeg::JpegStream, jpeg_complete_size,
        picture_scene_text, png::PngStream, png_complete_size, webp::WebPStream,
        webp_complete_size,
    },
    scene::document::MAX_BYTES,
};

use super::{alone, measured};

/// Most bytes that are allocated in all: each target of the fuzzer for pictures has the same limit.
const MOST_WORK: usize = 16 << 20;
/// Bytes of each piece that makes a picture longer.
const PIECE_BYTES: usize = 60_000;

/// A text of the largest length, which compression does not shorten much; `&` is an escape in XML.
fn longest_text() -> String {
    let mut rng = fastrand::Rng::with_seed(1);
    let letter = || char::from(rng.u8(b'#'..=b'&'));
    std::iter::repeat_with(letter).take(MAX_TEXT_BYTES).collect()
}

/// `picture` with pieces at the byte `at` until `length` is reached, nearly.
fn with_pieces(picture: &[u8], at: usize, piece: &[u8], length: usize) -> Vec<u8> {
    let count = (length - picture.len()) / piece.len();
    [&picture[..at], &piece.repeat(count), &picture[at..]].concat()
}

/// A chunk of a PNG.
fn png_chunk(kind: &[u8; 4], content: &[u8]) -> Vec<u8> {
    let body = [kind, content].concat();
    let crc = body.iter().fold(u32::MAX, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |crc, _| {
            if crc & 1 == 1 { crc >> 1 ^ 0xedb8_8320 } else { crc >> 1 }
        })
    });
    let length = (content.len() as u32).to_be_bytes();
    [&length[..], &body, &(!crc).to_be_bytes()].concat()
}

/// The reader of a picture's size.
type ReadSize<'a> = fn(Cursor<&'a [u8]>) -> Result<Option<[u32; 2]>, SceneTextError>;

/// Reads a picture's text, and its size if `size` is given: [`measured`] limits the memory.
fn read<'a>(
    alone: &MutexGuard<'static, ()>,
    bytes: &'a [u8],
    size: Option<ReadSize<'a>>,
) -> Result<String, String> {
    let (text, total) = measured(alone, || picture_scene_text(bytes));
    assert!(total < MOST_WORK, "{total} bytes for the text");
    if let Some(size) = size {
        let (size, total) = measured(alone, || size(Cursor::new(bytes)));
        assert!(total < MOST_WORK, "{total} bytes for the size");
        assert_eq!(size, Ok(Some([1, 1])));
    }
    Ok(text.expect("a picture")?.expect("a text"))
}

#[test]
fn the_largest_png_is_read_within_its_limits() {
    let alone = alone();
    let text = longest_text();
    let mut stream = PngStream::new(Vec::new(), [1, 1], &text).expect("a PNG");
    stream.write_pixels(&[0; 3]).expect("memory");
    let picture = stream.finish().expect("a whole PNG");
    // After the signature and the header.
    let longer = |piece: &[u8], length| with_pieces(&picture, 33, piece, length);
    let skipped = png_chunk(b"abCd", &[7; PIECE_BYTES]);
    assert!(read(&alone, &longer(&skipped, MAX_BYTES), Some(png_complete_size)) == Ok(text));
    // Other texts are kept, and refused where there are too many.
    let kept = png_chunk(b"tEXt", &[b"a\0", &[b'b'; PIECE_BYTES][..]].concat());
    let refused = read(&alone, &longer(&kept, MAX_BYTES), None).expect_err("too many texts");
    assert!(refused.contains("larger than"), "{refused}");
}

#[test]
fn the_largest_jpeg_is_read_within_its_limits() {
    let alone = alone();
    let text = longest_text();
    let mut stream = JpegStream::new(Vec::new(), [1, 1], &text, 90).expect("a JPEG");
    stream.write_rgb(&[0; 3]).expect("memory");
    let picture = stream.finish().expect("a whole JPEG");
    let length = (PIECE_BYTES as u16 + 2).to_be_bytes();
    let segment = [&[0xff, 0xe5][..], &length, &[7; PIECE_BYTES]].concat();
    // After the first marker.
    let longer = |length| with_pieces(&picture, 2, &segment, length);
    assert!(read(&alone, &longer(MAX_BYTES), None) == Ok(text.clone()));
    // The size stands in the header, of which less is read.
    assert!(read(&alone, &longer(MAX_HEADER_BYTES), Some(jpeg_complete_size)) == Ok(text));
}

#[test]
fn the_largest_webp_is_read_within_its_limits() {
    let alone = alone();
    let text = longest_text();
    let mut stream = WebPStream::new(Vec::new(), [1, 1], &text, false).expect("a WebP");
    stream.write_pixels(&[0; 3]).expect("memory");
    let picture = stream.finish().expect("a whole WebP");
    let chunk = [b"abcd", &(PIECE_BYTES as u32).to_le_bytes()[..], &[7; PIECE_BYTES]].concat();
    // After the first chunk, which has the size.
    let mut bytes = with_pieces(&picture, 30, &chunk, MAX_BYTES);
    let length = (bytes.len() as u32 - 8).to_le_bytes();
    bytes[4..8].copy_from_slice(&length);
    assert!(read(&alone, &bytes, Some(webp_complete_size)) == Ok(text));
}
