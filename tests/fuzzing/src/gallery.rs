//! Lists of galleries.

use mandelight::{
    reading::is_hidden,
    scene::gallery::{Gallery, MAX_PICTURES, is_in_folder},
};

use crate::{FuzzTarget, InputFormat, Outcome, promises::refused};

pub const TARGET: FuzzTarget = FuzzTarget {
    name: "gallery",
    check,
    seeds,
    format: InputFormat::Json,
    hundreds: 40,
    most_work: 2 << 20,
};

fn check(bytes: &[u8]) -> Outcome {
    let Ok(text) = str::from_utf8(bytes) else { return Outcome::Refused };
    let gallery = match Gallery::from_json(text) {
        Ok(gallery) => gallery,
        Err(error) => return refused(&error),
    };
    assert!((1..=MAX_PICTURES).contains(&gallery.pictures.len()));
    assert!(!gallery.name.contains(is_hidden));
    for picture in &gallery.pictures {
        assert!(is_in_folder(&picture.file), "{}", picture.file);
        assert!(!picture.name.is_empty() && !picture.name.contains(is_hidden));
    }
    assert_eq!(Gallery::from_json(&gallery.to_json()), Ok(gallery));
    Outcome::Read
}

fn seeds() -> Vec<Vec<u8>> {
    let files = ["a.png", "deep/cove.2.webp", "Blüte 3.jpg"].map(str::to_owned);
    let gallery = Gallery::new("Reefs", files).expect("a gallery");
    let named = r#"{"mandelight": "gallery", "version": 1, "pictures": [{"file": "a.png", "name": "First"}]}"#;
    vec![gallery.to_json().into_bytes(), named.as_bytes().to_vec()]
}
