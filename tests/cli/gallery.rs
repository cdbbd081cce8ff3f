//! `gallery`: which pictures the list has, what stays out, and what is never replaced.

use std::fs;

use mandelight::{
    export::png::PngStream,
    scene::{document, gallery::Gallery, presets},
};
use mandelight_test_support::program::{code, program, said};

use super::PROGRAM;

#[test]
fn the_pictures_of_a_folder_that_contain_their_scene_are_listed() {
    let folder = tempfile::tempdir().unwrap();
    let text = document::to_json(&presets::opening());
    for name in ["the reef.png", "a.PNG"] {
        let mut png = PngStream::new(Vec::new(), [2, 1], &text).unwrap();
        png.write_pixels(&[0; 6]).unwrap();
        fs::write(folder.path().join(name), png.finish().unwrap()).unwrap();
    }
    fs::write(folder.path().join("other.png"), "no picture").unwrap();
    fs::write(folder.path().join("notes.txt"), "notes").unwrap();
    let run = |name: &str| {
        program(PROGRAM, ["gallery", folder.path().to_str().unwrap(), "--name", name]).output()
    };
    for name in ["Reefs", "Other reefs"] {
        let output = run(name).unwrap();
        assert_eq!(code(&output), 0, "{}", said(&output));
        assert!(said(&output).contains("left out") && said(&output).contains("other.png"));
        let list = fs::read_to_string(folder.path().join("gallery.json")).unwrap();
        let gallery = Gallery::from_json(&list).unwrap();
        assert_eq!(gallery.name, name);
        let files: Vec<_> = gallery.pictures.iter().map(|it| (&*it.file, &*it.name)).collect();
        assert_eq!(files, [("a.PNG", "a"), ("the reef.png", "the reef")]);
    }
}

/// Opening a pipe would wait for a writer.
#[cfg(unix)]
#[test]
fn what_is_no_file_is_left_out() {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("folder.png")).unwrap();
    let pipe = folder.path().join("pipe.png");
    assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    let output = program(PROGRAM, ["gallery", folder.path().to_str().unwrap()]).output().unwrap();
    for name in ["folder.png", "pipe.png"] {
        assert!(
            said(&output).contains(&format!("left out: {name}: not a file")),
            "{}",
            said(&output)
        );
    }
    assert!(said(&output).contains("0 pictures"), "{}", said(&output));
}

#[test]
fn a_file_that_is_no_list_stays_and_an_empty_folder_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let run = || program(PROGRAM, ["gallery", folder.path().to_str().unwrap()]).output().unwrap();
    let output = run();
    assert_eq!(code(&output), 2);
    assert!(said(&output).contains("0 pictures"), "{}", said(&output));
    let list = folder.path().join("gallery.json");
    assert!(!list.exists());
    fs::write(&list, "{\"mine\": true}").unwrap();
    let output = run();
    assert_eq!(code(&output), 1);
    assert!(said(&output).contains("not a gallery's list"), "{}", said(&output));
    assert_eq!(fs::read_to_string(&list).unwrap(), "{\"mine\": true}");
}
