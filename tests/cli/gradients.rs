//! `--gradient`: by name, by file, and what is said of bad ones.

use std::fs;

use mandelight_test_support::program::{code, said};

use super::{asked, scene_with};

#[test]
fn gradients_are_chosen_by_name() {
    let scene = scene_with(&["--gradient", "deep-sea", "--second-gradient", "Zebra"]);
    let plain = scene_with(&[]);
    assert_eq!(scene.surface.gradient.len(), 6);
    assert_eq!(scene.surface.second_layer.gradient.len(), 4);
    assert_ne!(scene.surface.gradient, plain.surface.gradient);
    let output = asked(&["--gradient", "nothing"]);
    assert_eq!(code(&output), 2);
    let message = said(&output);
    assert!(message.contains("no gradient is called `nothing`") && message.contains("ember"));
}

#[test]
fn gradients_of_files_are_chosen_by_their_names() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("two.ugr");
    fs::write(
        &file,
        "red {\ngradient:\n index=0 color=255\n}\nblue {\ngradient:\n index=0 color=16711680\n}\n",
    )
    .unwrap();
    let path = file.to_str().unwrap();
    assert_eq!(scene_with(&["--gradient", path]).surface.gradient[0].color, [1.0, 0.0, 0.0]);
    let blue = scene_with(&["--gradient", &format!("{path}#blue")]);
    assert_eq!(blue.surface.gradient[0].color, [0.0, 0.0, 1.0]);
    for (wanted, message) in [
        (format!("{path}#green"), "there are red, blue"),
        (folder.path().join("none.map").display().to_string(), "none.map"),
    ] {
        let output = asked(&["--gradient", &wanted]);
        assert_eq!(code(&output), 2, "{wanted}");
        assert!(said(&output).contains(message), "{}", said(&output));
    }
}
