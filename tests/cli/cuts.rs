//! `--cut`: planes, and what is said of bad ones.

use mandelight::scene::document;
use mandelight_test_support::program::{code, program, said};

use super::PROGRAM;

#[test]
fn planes_cut_the_scene_open() {
    let output = program(PROGRAM, ["scene", "--cut", "z=0.25,-y=0"]).output().unwrap();
    assert_eq!(code(&output), 0, "{}", said(&output));
    let scene = document::from_json(&String::from_utf8(output.stdout).unwrap()).unwrap();
    let planes = &scene.fractal.section_planes;
    let found: Vec<_> =
        planes.iter().map(|plane| (plane.point.to_dvec3().to_array(), plane.direction)).collect();
    assert_eq!(found, [([0.0, 0.0, 0.25], [0.0, 0.0, 1.0]), ([0.0, 0.0, 0.0], [0.0, -1.0, 0.0])]);
}

#[test]
fn bad_planes_are_named() {
    for (planes, message) in [
        ("w=0", "`w=0` is no plane"),
        ("z=up", "`z=up` is no plane"),
        ("z", "such as z=0 or -y=0.2"),
        ("z=nan", "`z=nan` is no plane"),
        ("x=0,y=0,z=0,-x=1", "4 are too many"),
    ] {
        let output = program(PROGRAM, ["scene", "--cut", planes]).output().unwrap();
        assert_ne!(code(&output), 0, "{planes}");
        assert!(said(&output).contains(message), "{planes}: {}", said(&output));
    }
}
