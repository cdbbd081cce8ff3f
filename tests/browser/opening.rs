//! The picture of the document, and what takes its place.

use mandelight::scene::{link, presets};

use crate::{picture::Picture, visit::Visit};

/// Pixels across and down that are compared as one: a view of few pixels has coarser details.
const COARSE: u32 = 6;

/// Largest mean difference of the interface's copy of the picture, and of the view's own, in 8-bit steps.
const MAX_STEPS: [(&str, f64); 2] = [("handed-over", 3.0), ("drawn", 14.0)];

/// Pixels by which pictures are moved against each other.
const MOVES: [i32; 5] = [-6, -3, 0, 3, 6];

#[test]
fn the_opening_picture_is_there_at_once_and_the_view_takes_its_place() {
    let linked = (presets::opening_scenes()[3].scene)();
    let fragment = link::to_fragment(&linked).unwrap();
    let visit = Visit::run_with("opening", [("MANDELIGHT_LINK", fragment)]);
    for name in ["normal", "reduced", "phone"] {
        let seen = &visit.seen[name];
        assert_eq!(seen["isModuleThere"], false, "{name}: the picture came with the module");
        let side = |name: &str| seen["view"][name].as_f64().unwrap();
        for length in ["width", "height"] {
            let in_document = seen[length].as_f64().unwrap();
            assert!((in_document - side(length)).abs() < 1.5, "{name}: {length} {in_document}");
        }
        // The middle, between the hint and the progress of loading.
        let corner = [0.2 * side("width"), 0.1 * side("height")].map(|at| at as i32);
        let part_px = ["width", "height"].map(|length| (0.6 * side(length)) as u32);
        let shot = |when: &str| Picture::read_png(&visit.folder.join(format!("{name}-{when}.png")));
        let part = |picture: &Picture, x: i32, y: i32| {
            let from = [corner[0] + x, corner[1] + y].map(|at| at as u32);
            picture.crop(from, part_px).shrunk(COARSE)
        };
        let inlined = shot("inlined");
        assert!(part(&inlined, 0, 0).contrast() > 20.0, "{name}: there is no picture");
        for (when, max_steps) in MAX_STEPS {
            let shown = part(&shot(when), 0, 0);
            let steps = |x: i32, y: i32| part(&inlined, x, y).difference(&shown).mean;
            let still = steps(0, 0);
            println!("{name}, {when}: {still:.2} steps");
            assert!(still < max_steps, "{name}, {when}: {still} steps");
            for (x, y) in MOVES.iter().flat_map(|&x| MOVES.map(|y| (x, y))) {
                let moved = steps(x, y);
                assert!(moved >= still, "{name}: {when} is off by {x}, {y}: {moved} < {still}");
            }
        }
    }
    let moving = ["arrive", "0.4s"];
    for (name, motion) in [("normal", moving), ("reduced", ["none", "0s"]), ("phone", moving)] {
        let seen = ["animation", "fade"].map(|what| visit.text(&format!("/{name}/{what}")));
        assert_eq!(seen, motion, "{name}");
    }
    assert_eq!(visit.number("/cameras"), 2.0, "the view flew despite reduced motion");

    let mut stored = linked.clone();
    stored.quality.samples = 2;
    for (name, scene) in [("linked", linked), ("stored", stored)] {
        assert_eq!(visit.text(&format!("/{name}/detail")), "Opening the scene…", "{name}");
        let is_covered = &visit.seen[name]["isCovered"];
        assert_eq!(*is_covered, false, "a {name} scene opened on the picture of another one");
        assert_eq!(visit.scene(name), scene, "{name}");
    }
}
