//! The file formats of pictures: what FFmpeg and other decoders read, and the scenes inside.

use std::{
    fs,
    path::Path,
    process::{Command, Output},
};

use mandelight::scene::{Scene, document};
use mandelight_test_support::{
    picture::Picture,
    program::{code, names_in, program, said},
};

use super::PROGRAM;

const SIZE: [&str; 2] = ["--size", "60x41"];

/// A folder with a scene.
struct Workplace(tempfile::TempDir);

impl Workplace {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("scene.json"), document::to_json(&Scene::default())).unwrap();
        Self(folder)
    }

    fn path(&self) -> &Path {
        self.0.path()
    }

    fn render(&self, scene: &str, out: &str, arguments: &[&str]) -> Output {
        let all = [&["render", scene, "-o", out, "--samples", "2"], arguments].concat();
        program(PROGRAM, &all).current_dir(self.path()).output().unwrap()
    }

    /// The bytes of a rendered file.
    fn rendered(&self, scene: &str, out: &str, arguments: &[&str]) -> Vec<u8> {
        let output = self.render(scene, out, &[&SIZE, arguments].concat());
        assert_eq!(code(&output), 0, "{out}: {}", said(&output));
        fs::read(self.path().join(out)).unwrap()
    }

    /// The pixels of a file, decoded by FFmpeg.
    fn decoded(&self, file: &str, pixel_format: &str) -> Vec<u8> {
        let output = Command::new("ffmpeg")
            .args(["-v", "error", "-i", file, "-f", "rawvideo", "-pix_fmt", pixel_format, "-"])
            .current_dir(self.path())
            .output()
            .expect("ffmpeg");
        assert!(output.status.success(), "{file}: {}", said(&output));
        output.stdout
    }
}

#[test]
fn each_format_holds_the_same_picture_and_its_scene() {
    let place = Workplace::new();
    let png = place.rendered("scene.json", "a.png", &[]);
    let pixels = Picture::of(&png).bytes;
    for (name, start) in
        [("a.jpg", &b"\xff\xd8\xff"[..]), ("b.JPEG", b"\xff\xd8\xff"), ("a.webp", b"RIFF")]
    {
        let file = place.rendered("scene.json", name, &[]);
        assert!(file.starts_with(start), "{name}");
        let decoded = place.decoded(name, "rgb24");
        assert_eq!(decoded.len(), pixels.len(), "{name}");
        let error: f64 =
            pixels.iter().zip(&decoded).map(|(a, b)| f64::from(a.abs_diff(*b))).sum::<f64>()
                / pixels.len() as f64;
        let limit = if name == "a.webp" { 0.0 } else { 4.0 };
        assert!(error <= limit, "{name} differs by {error}");
        // The file is a scene, which renders to the same picture.
        assert_eq!(place.rendered(name, "again.png", &[]), png, "{name}");
    }
}

#[test]
fn the_quality_of_a_jpeg_is_chosen() {
    let place = Workplace::new();
    let bytes = |arguments: &[&str]| place.rendered("scene.json", "a.jpg", arguments).len();
    let usual = bytes(&[]);
    assert_eq!(usual, bytes(&["--quality", "92"]));
    assert!(bytes(&["--quality", "40"]) < usual && usual < bytes(&["--quality", "100"]));
    for (out, quality, message) in [
        ("a.png", "50", "only JPEGs have a quality"),
        ("a.webp", "50", "only JPEGs have a quality"),
        ("a.jpg", "0", "1..=100"),
        ("a.jpg", "101", "1..=100"),
    ] {
        let output = place.render("scene.json", out, &["--quality", quality]);
        assert_eq!(code(&output), 2, "{out} {quality}");
        assert!(said(&output).contains(message), "{out}: {}", said(&output));
    }
}

/// FFmpeg reads 16 bits per channel, which round to the picture of 8 bits.
#[test]
fn a_png_may_have_sixteen_bits_per_channel() {
    let place = Workplace::new();
    let eight = Picture::of(&place.rendered("scene.json", "a.png", &["--bits", "8"])).bytes;
    let deep = place.rendered("scene.json", "deep.png", &["--bits", "16"]);
    let decoded = place.decoded("deep.png", "rgb48be");
    assert_eq!(Picture::of(&deep).bytes, decoded);
    let channels = decoded.as_chunks::<2>().0.iter().map(|&bytes| u16::from_be_bytes(bytes));
    for (deep, eight) in channels.zip(&eight) {
        assert!((f64::from(deep) / 257.0 - f64::from(*eight)).abs() < 1.01, "{deep} {eight}");
    }
    assert_eq!(place.rendered("deep.png", "again.png", &["--bits", "16"]), deep);
    for (out, bits, message) in [
        ("a.jpg", "16", "only a PNG can have 16 bits"),
        ("a.webp", "16", "only a PNG can have 16 bits"),
        ("a.exr", "16", "only a PNG can have 16 bits"),
        ("a.png", "12", "8, 16"),
    ] {
        let output = place.render("scene.json", out, &["--bits", bits]);
        assert_eq!(code(&output), 2, "{out}");
        assert!(said(&output).contains(message), "{out}: {}", said(&output));
    }
}

/// FFmpeg reads the same alpha of a PNG and of a WebP: of the background, of the set, and between.
#[test]
fn the_background_may_be_transparent() {
    let place = Workplace::new();
    let png = place.rendered("scene.json", "a.png", &["--transparent"]);
    let pixels = Picture::of(&png).bytes;
    let alpha = |value: fn(u8) -> bool| pixels.iter().skip(3).step_by(4).any(|&a| value(a));
    assert!(alpha(|a| a == 0) && alpha(|a| a == 255) && alpha(|a| a == 127 || a == 128));
    place.rendered("scene.json", "a.webp", &["--transparent"]);
    for name in ["a.png", "a.webp"] {
        assert!(place.decoded(name, "rgba") == pixels, "{name}");
        assert_eq!(place.rendered(name, "again.png", &["--transparent"]), png, "{name}");
    }
    for (out, more, message) in
        [("a.jpg", &[][..], "a JPEG cannot have"), ("a.png", &["--stereo", "anaglyph"], "anaglyph")]
    {
        let output = place.render("scene.json", out, &[&["--transparent"], more].concat());
        assert_eq!(code(&output), 2, "{out}");
        assert!(said(&output).contains(message), "{out}: {}", said(&output));
    }
}

#[test]
fn a_picture_too_large_for_webp_is_refused_at_once() {
    let place = Workplace::new();
    for size in ["16384x1", "1x16384", "8193x8192"] {
        let output = place.render("scene.json", "a.webp", &["--size", size]);
        assert_eq!(code(&output), 2, "{size}");
        assert!(said(&output).contains("16383"), "{size}: {}", said(&output));
    }
    assert_eq!(names_in(place.path()), ["scene.json"]);
}

#[test]
fn pictures_without_a_scene_and_damaged_ones_are_refused() {
    let place = Workplace::new();
    for (bytes, message) in [
        (&b"\xff\xd8\xff\xd9"[..], "carries no Mandelight scene"),
        (b"RIFF\0\0\0\0WEBP", "carries no Mandelight scene"),
        (b"\xff\xd8\xff\xe0\0", "not a readable JPEG"),
        (b"RIFF\0\0\0\0WEBPXMP \xff\xff\xff\xff", "not a readable WebP"),
    ] {
        fs::write(place.path().join("bad"), bytes).unwrap();
        let output = place.render("bad", "out.png", &[]);
        assert_eq!(code(&output), 2);
        assert!(said(&output).contains(message), "{message}: {}", said(&output));
    }
}
