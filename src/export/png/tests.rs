//! Tests of the writer against the crate's decoder, and of the reader with damaged files.

use std::io::Cursor;

use proptest::prelude::*;

use super::*;

const DOCUMENT: &str = r#"{"name":"Zürich → 雪"}"#;

/// Incompressible bytes (xorshift32).
fn noise(length: usize) -> Vec<u8> {
    let mut state = 0x9E37_79B9_u32;
    std::iter::repeat_with(|| {
        state ^= state << 13;
        state ^= state >> 17;
        state ^= state << 5;
        (state >> 24) as u8
    })
    .take(length)
    .collect()
}

fn encoded(size_px: [u32; 2], rgb: &[u8], rows_at_once: usize) -> Vec<u8> {
    let mut stream = PngStream::new(Vec::new(), size_px, DOCUMENT).unwrap();
    for rows in rgb.chunks(size_px[0] as usize * 3 * rows_at_once) {
        stream.write_pixels(rows).unwrap();
    }
    stream.finish().unwrap()
}

fn crc_of(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(u32::MAX, |crc, &byte| {
        (0..8).fold(
            crc ^ u32::from(byte),
            |c, _| if c & 1 == 1 { 0xEDB8_8320 ^ (c >> 1) } else { c >> 1 },
        )
    })
}

fn chunk(kind: &[u8; 4], data: &[u8]) -> Vec<u8> {
    let body = [kind.as_slice(), data].concat();
    [(data.len() as u32).to_be_bytes().as_slice(), &body, &crc_of(&body).to_be_bytes()].concat()
}

/// A grey PNG with the chunks `extra` between its header and its pixels.
fn file_with(extra: &[u8]) -> Vec<u8> {
    let header = chunk(b"IHDR", &[0, 0, 0, 1, 0, 0, 0, 1, 8, 0, 0, 0, 0]);
    [&SIGNATURE, header.as_slice(), extra, &chunk(b"IDAT", &[0; 4]), &chunk(b"IEND", &[])].concat()
}

#[test]
fn rows_round_trip() {
    for (size_px, rows_at_once) in [([101, 67], 5), ([1, 1], 1), ([300, 200], 200)] {
        let rgb = noise((size_px[0] * size_px[1] * 3) as usize);
        let file = encoded(size_px, &rgb, rows_at_once);
        assert!(file.ends_with(b"IEND\xae\x42\x60\x82"));

        let mut reader = png::Decoder::new(Cursor::new(&file)).read_info().unwrap();
        assert_eq!([reader.info().width, reader.info().height], size_px);
        assert_eq!(reader.info().srgb, Some(png::SrgbRenderingIntent::Perceptual));
        let mut decoded = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut decoded).unwrap();
        assert_eq!(decoded, rgb);
    }
}

#[test]
fn the_stream_writes_to_the_sink_without_buffering() {
    let size_px = [512, 4096];
    let rgb = noise(512 * 3 * 64);
    let mut stream = PngStream::new(Vec::new(), size_px, DOCUMENT).unwrap();
    let mut max_waiting = 0;
    for _ in 0..4096 / 64 {
        stream.write_pixels(&rgb).unwrap();
        max_waiting = max_waiting.max(stream.outbox.0.lock().unwrap().capacity());
    }
    assert_eq!(max_waiting, 0, "all of the encoder's output is in the sink");
    assert!(stream.sink.len() > 1 << 20);
}

#[test]
fn a_missing_row_and_a_full_disk_are_errors() {
    let mut stream = PngStream::new(Vec::new(), [4, 4], DOCUMENT).unwrap();
    stream.write_pixels(&[0; 4 * 3 * 3]).unwrap();
    assert!(matches!(stream.finish(), Err(ExportError::Encode(_))));

    // The sink fails within the last chunk, whose errors the encoder's destructor would ignore.
    let whole = encoded([4, 4], &[7; 48], 4);
    let mut short = vec![0; whole.len() - 6];
    let mut stream = PngStream::new(short.as_mut_slice(), [4, 4], DOCUMENT).unwrap();
    stream.write_pixels(&[7; 48]).unwrap();
    assert!(matches!(stream.finish(), Err(ExportError::Write(_))));
}

#[test]
fn the_scene_round_trips() {
    let file = encoded([3, 2], &[9; 18], 2);
    assert!(is_png(&file));
    assert_eq!(scene_text(Cursor::new(&file)).unwrap().as_deref(), Some(DOCUMENT));
}

#[test]
fn the_scene_is_read_from_every_type_of_text_chunk() {
    let plain = file_with(&chunk(b"tEXt", b"mandelight\0{}"));
    assert_eq!(scene_text(Cursor::new(plain)).unwrap().as_deref(), Some("{}"));

    let mut compressed = b"mandelight\0\0".to_vec();
    compressed.extend(miniz_oxide::deflate::compress_to_vec_zlib(b"{}", 6));
    assert_eq!(
        scene_text(Cursor::new(file_with(&chunk(b"zTXt", &compressed)))).unwrap().as_deref(),
        Some("{}")
    );

    let other = file_with(&chunk(b"tEXt", b"Comment\0{}"));
    assert_eq!(scene_text(Cursor::new(other)).unwrap(), None);
}

#[test]
fn a_text_that_inflates_beyond_the_limit_is_rejected() {
    let bomb = miniz_oxide::deflate::compress_to_vec_zlib(&vec![b' '; MAX_TEXT_BYTES + 1], 6);
    let compressed = [b"mandelight\0\x01\0\0\0".as_slice(), &bomb].concat();
    assert!(scene_text(Cursor::new(file_with(&chunk(b"iTXt", &compressed)))).is_err());
    let plain = [b"mandelight\0".as_slice(), &vec![b' '; MAX_TEXT_BYTES + 1]].concat();
    assert!(matches!(
        scene_text(Cursor::new(file_with(&chunk(b"tEXt", &plain)))),
        Err(SceneTextError::TooLarge)
    ));
}

#[test]
fn a_claimed_length_without_data_allocates_nothing() {
    let long_chunk = [b"\x7f\xff\xff\xfftEXtmandelight\0".as_slice(), &[b'x'; 64]].concat();
    assert!(scene_text(Cursor::new(file_with(&long_chunk))).is_err());
    let huge_picture = [
        &SIGNATURE,
        chunk(b"IHDR", &[0x7f, 255, 255, 255, 0x7f, 255, 255, 255, 16, 6, 0, 0, 0]).as_slice(),
    ]
    .concat();
    assert!(scene_text(Cursor::new(huge_picture)).is_err());
}

proptest! {
    #[test]
    fn damaged_files_never_panic(position in 0usize..400, byte: u8, cut in 0usize..500) {
        let mut file = encoded([5, 4], &noise(60), 4);
        let length = file.len();
        file[position % length] = byte;
        file.truncate(cut.max(1));
        let _ = scene_text(Cursor::new(file));
    }

    #[test]
    fn random_chunks_never_panic(kind in prop::sample::select(vec![*b"tEXt", *b"zTXt", *b"iTXt", *b"eXIf", *b"iCCP"]),
                                 data in prop::collection::vec(any::<u8>(), 0..200)) {
        let _ = scene_text(Cursor::new(file_with(&chunk(&kind, &data))));
    }
}
