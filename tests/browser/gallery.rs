//! A gallery of the page's address.

use std::{fs, path::PathBuf};

use mandelight::{
    export::png::PngStream,
    scene::{Scene, document, gallery::Gallery, presets},
};

use crate::{
    picture::Picture,
    visit::{Visit, folder_of},
};

/// A folder of pictures with their list for a visit, and the scenes of its two whole pictures, a red and a blue one.
pub fn pictures(script: &str) -> (PathBuf, [Scene; 2]) {
    let folder = folder_of(&format!("{script}-pictures"));
    fs::create_dir_all(&folder).unwrap();
    let [first, second] = [2, 4].map(|index| (presets::opening_scenes()[index].scene)());
    for (name, scene, rgb) in
        [("first one.png", &first, [200, 40, 30]), ("b.png", &second, [30, 60, 200])]
    {
        let mut png = PngStream::new(Vec::new(), [48, 30], &document::to_json(scene)).unwrap();
        png.write_pixels(&rgb.repeat(48 * 30)).unwrap();
        fs::write(folder.join(name), png.finish().unwrap()).unwrap();
    }
    // A file of few bytes with the header of a picture that would fill gigabytes.
    let mut huge = fs::read(folder.join("b.png")).unwrap();
    huge.splice(16..24, [23_000_u32.to_be_bytes(); 2].concat());
    fs::write(folder.join("huge.png"), huge).unwrap();
    let files = ["first one.png", "b.png", "missing.png", "huge.png"].map(str::to_owned);
    let list = Gallery::new("Two of a host", files).unwrap().to_json();
    fs::write(folder.join("gallery.json"), list).unwrap();
    fs::write(folder.join("broken.json"), "[1, 2").unwrap();
    (folder, [first, second])
}

#[test]
fn a_gallery_of_the_address_is_shown_and_opened() {
    let (folder, [first, second]) = pictures("gallery");
    let visit = Visit::run_with("gallery", [("MANDELIGHT_PICTURES", &folder)]);
    let shown = Picture::read_png(&visit.folder.join("gallery-720x420.png"));
    let card = |index: usize| {
        let side = |name: &str| visit.number(&format!("/cards/{index}/{name}"));
        let middle = [side("x") + side("width") / 2.0, side("y") + side("height") / 3.0];
        shown.crop(middle.map(|at| at as u32 - 4), [8, 8]).mean_color()
    };
    let [red, blue] = [card(0), card(1)];
    assert!(red[0] > 2.0 * red[2] && blue[2] > 2.0 * blue[0], "{red:?}, {blue:?}");
    let opened = visit.scene("opened");
    assert_eq!(Scene { quality: first.quality.clone(), ..opened }, first);
    for name in ["missing", "broken", "nowhere", "refused"] {
        assert_eq!(visit.seen[name], true, "{name}");
    }
    let warned = visit.text("/huge");
    assert!(
        warned.contains("huge.png could not be decoded: it has 23000 x 23000 pixels"),
        "{warned}"
    );

    let opened = visit.scene("opened_elsewhere");
    assert_eq!(Scene { quality: second.quality.clone(), ..opened }, second);
    let asked = visit.seen["other_host"].as_array().unwrap();
    assert!(asked.iter().any(|it| it["pathname"] == "/gallery.json"), "{asked:#?}");
    for request in asked {
        assert!(request["cookie"].is_null() && request["referer"].is_null(), "{request}");
    }
}
