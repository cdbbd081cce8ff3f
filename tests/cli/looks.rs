//! `--look`: by name, in parts, in order, and what is said of unknown ones.

use mandelight::scene::looks;
use mandelight_test_support::program::{code, said};

use super::{asked, scene_with};

#[test]
fn looks_change_a_scene_in_order_and_edits_come_last() {
    let plain = scene_with(&["--preset", "julia"]);
    let mut expected = plain.clone();
    for id in ["gold", "tone/film", "background/deep-sea"] {
        looks::apply(looks::find(id).unwrap(), &mut expected);
    }
    let given = ["Gold", "tone/Film", "background/deep sea"].map(|name| ["--look", name]);
    let arguments: Vec<&str> =
        ["--preset", "julia"].into_iter().chain(given.into_iter().flatten()).collect();
    assert_eq!(scene_with(&arguments), expected);
    assert_eq!((expected.camera, expected.fractal), (plain.camera, plain.fractal));
    let edited = scene_with(&["--look", "gold", "--set", "tone.exposure=-2"]);
    assert_eq!(edited.tone.exposure, -2.0);
    assert_eq!(scene_with(&["--look", "gold", "--gradient", "zebra"]).surface.gradient.len(), 4);
}

#[test]
fn all_looks_are_listed_and_unknown_ones_refused() {
    let output = asked(&["--list-looks"]);
    let list = String::from_utf8(output.stdout).unwrap();
    let count: usize = looks::lists().iter().map(|list| list.looks.len()).sum();
    assert_eq!(list.lines().count(), count);
    for id in ["ember ", "colours/ember ", "light/rim ", "background/night ", "tone/film "] {
        assert!(list.lines().any(|line| line.starts_with(id)), "{id}");
    }
    for name in ["nothing", "tone/ember", "tone/film/ember", ""] {
        let output = asked(&["--look", name]);
        assert_eq!(code(&output), 2, "{name}");
        let message = said(&output);
        assert!(message.contains("porcelain") && message.contains("--list-looks"), "{message}");
    }
    assert_eq!(code(&asked(&["--list-looks", "--look", "ember"])), 2);
}
