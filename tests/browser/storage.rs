//! What the page makes of a storage that is damaged, another version's, full, blocked, or shared.

use mandelight::scene::{Scene, presets};
use serde_json::Value;

use crate::visit::Visit;

#[test]
fn no_storage_loses_work_or_stops_the_page() {
    let visit = Visit::run("storage");
    let exposure = |name: &str| visit.scene(name).tone.exposure;
    let is_opening = |scene: &Scene| {
        let first = presets::opening();
        *scene == Scene { camera: scene.camera.clone(), ..first }
    };
    for name in ["damaged-0", "damaged-1", "damaged-2"] {
        assert!(is_opening(&visit.scene(name)), "{name}");
    }

    // A newer version's texts are as they were, apart from what was added to them.
    let newer = &visit.seen["newer"];
    assert_eq!(newer["is_kept"], true);
    assert_eq!(newer["settings"]["palette"], "of tomorrow");
    assert_eq!(newer["settings"]["sheet"], "floating");
    assert_eq!(newer["settings"]["formulas"][0], "f");
    assert_eq!(newer["favourites"][0]["title"], "of tomorrow");
    assert_eq!(exposure("older"), -0.75);
    assert_eq!(visit.scene("version_1").fractal.number("power"), Some(5.0));
    assert_eq!(visit.seen["older_panel"], Value::Null, "an older version's closed panel is open");

    let kept = visit.seen["kept"].as_array().unwrap();
    let has = |value: &str| kept.iter().filter_map(Value::as_str).any(|text| text.contains(value));
    assert_eq!(kept.len(), 2);
    assert!(has("\"exposure\":1") && has("\"exposure\":2"));
    assert_eq!([exposure("tab-0"), exposure("tab-1")], [1.0, 2.0], "each tab has its own scene");

    assert_eq!(exposure("full"), 1.5, "the address has what the storage refused");
    assert!(is_opening(&visit.scene("blocked_first")));
    assert_eq!(exposure("blocked"), -1.5);
    assert_eq!(visit.seen["panics"]["count"], 0, "{}", visit.seen["panics"]);
}
