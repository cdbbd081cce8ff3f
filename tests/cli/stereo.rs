//! Pictures for two eyes: the files of every layout, and pairs of frames.

use std::{fs, io::Cursor, path::Path, process::Output, sync::Arc};

use glam::DVec3;
use mandelight::{
    export::scene_text,
    scene::{
        Project, StereoLayout, document,
        path::{Easing, Key},
    },
};
use mandelight_test_support::{
    picture::Picture,
    program::{names_in, program},
    stereo::{glowing, scene, sheet},
};

use super::PROGRAM;

fn run(folder: &Path, arguments: &[&str]) -> Output {
    program(PROGRAM, arguments).current_dir(folder).output().unwrap()
}

#[test]
fn the_command_line_writes_every_layout() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let scene = glowing(StereoLayout::TopBottom);
    fs::write(at.join("s.json"), document::to_json(&scene)).unwrap();
    let render = |name: &str, more: &[&str]| {
        let all = ["render", "s.json", "--size", "61x43", "-o", name];
        run(at, &[&all[..], more].concat())
    };
    for (name, more, size_px, layout) in [
        ("scene.png", &[][..], [61, 86], StereoLayout::TopBottom),
        ("off.png", &["--stereo", "off"], [61, 43], StereoLayout::Off),
        ("beside.png", &["--stereo", "side-by-side"], [122, 43], StereoLayout::SideBySide),
        ("anaglyph.png", &["--stereo", "anaglyph"], [61, 43], StereoLayout::Anaglyph),
    ] {
        let output = render(name, more);
        let said = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(0), "{said}");
        assert!(said.contains(&format!("{}x{}", size_px[0], size_px[1])), "{said}");
        let file = fs::read(at.join(name)).unwrap();
        assert_eq!(Picture::of(&file).size_px, size_px);
        let text = scene_text(Cursor::new(file)).unwrap().unwrap();
        let shown = document::project_from_json(&text).unwrap().scene;
        assert_eq!(shown.camera.stereo.layout, layout);
    }
    let output = render("pair.png", &["--stereo", "pair", "-q"]);
    assert_eq!(output.status.code(), Some(0));
    let read = |name: &str| Picture::of(&fs::read(at.join(name)).unwrap());
    let eyes = ["pair_left.png", "pair_right.png"].map(|name| read(name).rgb());
    assert!(read("beside.png").rgb() == sheet(&eyes, 61, StereoLayout::SideBySide));
    assert!(read("scene.png").rgb() == sheet(&eyes, 61, StereoLayout::TopBottom));
    let before = names_in(at);
    assert!(!before.contains(&"pair.png".to_owned()));

    for (name, more, said) in [
        ("a.exr", &["--stereo", "anaglyph"][..], "anaglyph"),
        ("wide.png", &["--stereo", "side-by-side", "--size", "9000x20"], "18000x20"),
        ("-", &["--stereo", "pair"], "standard output"),
        ("b.png", &["--stereo", "both"], "side-by-side"),
    ] {
        let mut all = vec!["render", "s.json", "-o", name];
        all.extend(more);
        let output = run(at, &all);
        let text = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{text}");
        assert!(text.contains(said), "{text}");
    }
    assert_eq!(names_in(at), before);
}

#[test]
fn frames_come_in_pairs() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let key = |time_secs: f64, x: f64| {
        let mut scene = scene(StereoLayout::Off);
        scene.camera.position = DVec3::new(x, -2.2, 0.9).into();
        Key { time_secs, easing: Easing::Smooth, scene: Arc::new(scene) }
    };
    let mut project = Project::from(scene(StereoLayout::Off));
    project.path.frames_per_second = 2;
    project.path.keys = vec![key(0.0, 1.4), key(1.0, 1.2)];
    fs::write(at.join("p.json"), document::project_to_json(&project)).unwrap();
    let frames = |more: &[&str]| {
        let all = ["frames", "p.json", "-o", "out", "--size", "24x16", "--frames", "0..2"];
        run(at, &[&all[..], more].concat())
    };
    let pair = ["--stereo", "pair"];
    let output = frames(&pair);
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    let names: Vec<_> =
        names_in(&at.join("out")).into_iter().filter(|name| name.starts_with("frame")).collect();
    let expected = ["frame_000000", "frame_000001"]
        .iter()
        .flat_map(|frame| ["left", "right"].map(|eye| format!("{frame}_{eye}.png")));
    assert_eq!(names, expected.collect::<Vec<_>>());
    // One that is missing is made again, the same; the others are kept.
    let file = at.join("out/frame_000001_left.png");
    let bytes = fs::read(&file).unwrap();
    fs::remove_file(&file).unwrap();
    let said = String::from_utf8(frames(&pair).stderr).unwrap();
    assert!(said.contains("1 picture, 3 kept"), "{said}");
    assert_eq!(fs::read(&file).unwrap(), bytes);
    // The folder belongs to the pair.
    assert_eq!(frames(&[]).status.code(), Some(2));
}
