//! The picture formats of the menu, read by the crates of those formats.

use std::{fs, io::Cursor, path::Path};

use mandelight::{export, scene::document};

use crate::{picture::Picture, visit::Visit};

#[test]
fn each_format_of_the_menu_is_a_picture_of_its_kind() {
    let visit = Visit::run("formats");
    let read = |name: &str| fs::read(visit.folder.join(name)).unwrap();
    for name in
        ["small.png", "deep.png", "small.webp", "small.jpg", "small.exr", "view.webp", "view.jpg"]
    {
        let text = export::picture_scene_text(&read(name)).expect(name).unwrap();
        let scene = document::from_json(&text.expect("a scene")).unwrap();
        assert_eq!(scene, visit.scene("saved"), "{name}");
        let suggested = visit.seen["names"][name].as_str().unwrap();
        assert_eq!(Path::new(suggested).extension(), Path::new(name).extension());
    }
    for (name, depth) in [("small.png", png::BitDepth::Eight), ("deep.png", png::BitDepth::Sixteen)]
    {
        let reader = png::Decoder::new(Cursor::new(read(name))).read_info().unwrap();
        let info = reader.info();
        assert_eq!((info.width, info.height, info.bit_depth), (64, 40, depth), "{name}");
    }

    let [eight, deep] =
        ["small.png", "deep.png"].map(|name| Picture::read_png(&visit.folder.join(name)));
    assert!(eight.contrast() > 5.0, "the picture is empty");
    assert!(eight.difference(&deep).mean < 1.0, "more bits are another picture");

    // Corners of the opening view show background alone.
    let cut_out = Picture::read_png(&visit.folder.join("cut_out.png"));
    let alpha = |[x, y]: [usize; 2]| cut_out.rgba[4 * (64 * y + x) + 3];
    let corners = [[0, 0], [63, 0], [0, 39], [63, 39]].map(alpha);
    assert_eq!((corners, alpha([32, 20])), ([0; 4], 255));

    let mut webp = image_webp::WebPDecoder::new(Cursor::new(read("small.webp"))).unwrap();
    assert_eq!(webp.dimensions(), (64, 40));
    let mut pixels = vec![0; webp.output_buffer_size().unwrap()];
    webp.read_image(&mut pixels).unwrap();
    let rgb: Vec<u8> = eight.rgba.chunks_exact(4).flat_map(|pixel| &pixel[..3]).copied().collect();
    assert!(pixels == rgb, "the WebP is another picture");

    let jpeg = image::load_from_memory_with_format(&read("small.jpg"), image::ImageFormat::Jpeg);
    let jpeg = jpeg.unwrap().into_rgba8();
    let jpeg = Picture::new([jpeg.width(), jpeg.height()], jpeg.into_raw());
    assert!(eight.difference(&jpeg).mean < 4.0, "the JPEG is another picture");

    let light = exr::prelude::read_first_rgba_layer_from_file(
        visit.folder.join("small.exr"),
        |size, _| vec![0.0_f32; size.area()],
        |light, at, (r, g, b, _): (f32, f32, f32, f32)| light[at.y() * 64 + at.x()] = r + g + b,
    );
    let light = light.unwrap().layer_data;
    assert_eq!([light.size.width(), light.size.height()], [64, 40]);
    let lit = light.channel_data.pixels.iter().filter(|&&sum| sum > 0.05).count();
    assert!(lit > 64 * 40 / 10, "only {lit} pixels have light");

    // The finished view is saved from the screen.
    assert_eq!(visit.number("/view_dispatches"), 0.0);
    let jpeg =
        image::load_from_memory_with_format(&read("view.jpg"), image::ImageFormat::Jpeg).unwrap();
    let webp = image_webp::WebPDecoder::new(Cursor::new(read("view.webp"))).unwrap();
    assert_eq!((jpeg.width(), jpeg.height()), webp.dimensions());
}
