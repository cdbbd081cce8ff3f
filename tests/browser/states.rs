//! The states of the interface in windows of three sizes.

use std::ffi::OsString;

use mandelight::scene::{document, presets};

use crate::{gallery, picture::Picture, visit::Visit};

#[test]
fn each_state_of_the_interface_fits_the_window() {
    let quaternions = presets::formulas().iter().find(|it| it.id() == "quaternion-julia");
    let mut formula = (quaternions.expect("a scene of a formula with a text").scene)();
    formula.quality.samples = 1;
    let (pictures, _) = gallery::pictures("states");
    let formula = document::to_json(&formula);
    let visit = Visit::run_with(
        "states",
        [("MANDELIGHT_FORMULA", OsString::from(formula)), ("MANDELIGHT_PICTURES", pictures.into())],
    );
    let states = visit.seen["states"].as_array().unwrap();
    assert_eq!(states.len(), 3 * 20);
    for state in states {
        let name = state["name"].as_str().unwrap();
        let size_px = [0, 1].map(|i| state["size"][i].as_u64().unwrap() as u32);
        let picture = Picture::read_png(&visit.folder.join(format!("{name}.png")));
        assert_eq!(picture.size_px, size_px, "{name}");
        assert!(picture.contrast() > 8.0, "{name} is blank: {}", picture.contrast());
        // What floats over the view is whole, and the view is large.
        let side = |part: &str, side: &str| state["rects"][part][side].as_f64();
        for part in [
            "share window",
            "find window",
            "help window",
            "compare",
            "fly keys",
            "formula window",
            "look preview",
            "notice",
            "saving",
            "panel",
            "timeline",
            "variations",
            "view",
        ] {
            let bounds = ["x", "y", "width", "height"].map(|name| side(part, name));
            let [Some(x), Some(y), Some(width), Some(height)] = bounds else { continue };
            let [right, bottom] = [x + width, y + height];
            let is_inside = x >= -0.5
                && y >= -0.5
                && right <= f64::from(size_px[0]) + 0.5
                && bottom <= f64::from(size_px[1]) + 0.5;
            assert!(is_inside, "{name}: {part} is at {bounds:?}");
        }
        let view = side("view", "width").unwrap() * side("view", "height").unwrap();
        let part = view / f64::from(size_px[0] * size_px[1]);
        // The timeline's rows for fingers take most of a low window.
        let least = if name == "timeline-844x390" { 0.15 } else { 0.3 };
        assert!(part > least, "{name}: the view is {part} of the window");
    }
}
