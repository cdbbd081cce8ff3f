//! Messages that quote files and names, and signals while the command waits.

use mandelight::scene::{BackgroundKind, Scene, document};
use mandelight_test_support::{
    patience::HANG,
    program::{code, program, said},
};

use super::PROGRAM;

/// A terminal obeys control characters, so none reaches it from a file, a name or an argument.
#[test]
fn messages_show_control_characters_as_escapes() {
    let folder = tempfile::tempdir().unwrap();
    let escape = "a\u{1b}[2J\u{9b}31m\nmandelight: all is well";
    let file = folder.path().join(format!("{escape}.json"));
    let named = |field: &str| {
        format!("{{\"mandelight\":\"scene\",\"version\":2,\"scene\":{{{field:?}:1}}}}")
    };
    std::fs::write(&file, named("x").replace("\"x\"", "\"\\u001b[2J\"")).unwrap();
    let text = folder.path().join("own.formula");
    std::fs::write(&text, format!("name \"x\";\t{escape}")).unwrap();
    let (file, text) = (file.to_str().unwrap(), text.to_str().unwrap());
    for arguments in [
        &["render", file, "-o", "out.png"][..],
        &["render", escape, "-o", "out.png"],
        &["scene", "--set", &format!("{escape}=1")],
        &["scene", "--preset", escape],
        &["scene", "--gradient", escape],
        &["scene", "--gradient", file],
        &["scene", "--formula", escape],
        &["render", "-", "-o", "out.png", "--environment", escape],
        &["formula", "check", text],
        &["scene", "--turntable", escape],
        &["scene", "--look", escape],
        &["scene", "--hybrid", escape],
        &["scene", "--hybrid", &format!("mandelbulb*{escape}")],
        &["scene", "--cut", escape],
        &[escape],
    ] {
        let output = program(PROGRAM, arguments).current_dir(folder.path()).output().unwrap();
        assert_eq!(code(&output), 2, "{arguments:?}: {}", said(&output));
        let text = said(&output);
        let hidden = text.chars().find(|letter| letter.is_control() && *letter != '\n');
        assert_eq!(hidden, None, "{arguments:?}: {text:?}");
        assert!(!is_forged(&text), "{arguments:?}: {text}");
    }
}

/// Whether a line of the messages is what a name says.
fn is_forged(text: &str) -> bool {
    text.lines().any(|line| line.starts_with("mandelight: all"))
}

/// Names of files, and in files, that hold a line as the command writes them.
#[cfg(unix)]
#[test]
fn no_name_forges_a_line_of_messages() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| {
        std::fs::create_dir_all(folder.path().join(name).parent().unwrap()).unwrap();
        std::fs::write(folder.path().join(name), text).unwrap();
    };
    let forged = "a\nmandelight: all is well";
    write(&format!("{forged}/{forged}.png"), "no picture");

    let mut lit = Scene::default();
    lit.background.kind = BackgroundKind::EnvironmentMap;
    lit.lights.rig.environment_map.name = forged.to_owned();
    write("lit.json", &document::to_json(&lit));
    let document_with_path =
        program(PROGRAM, ["scene", "--turntable", "2"]).output().unwrap().stdout;
    write("path.json", &String::from_utf8(document_with_path).unwrap());
    // As long as the name of a folder's sequence.
    write("frames/sequence-\nmandelight: all.json", "");

    for (arguments, exit, part) in [
        (&["gallery", forged][..], 2, "a\\u{a}mandelight: all is well.png: its name is too long"),
        (&["info", "--adapter", forged], 1, "named \"a\\u{a}mandelight: all is well\""),
        (&["gallery", "none\nmandelight: all is well"], 1, "none\\u{a}mandelight"),
        (
            &["render", "lit.json", "-o", "-", "--stereo", "pair"],
            2,
            "the background is a\\u{a}mandelight: all is well, which",
        ),
        (
            &["frames", "path.json", "-o", "frames", "--size", "4x4"],
            2,
            "(sequence-\\u{a}mandelight: all.json)",
        ),
    ] {
        let output = program(PROGRAM, arguments).current_dir(folder.path()).output().unwrap();
        let text = said(&output);
        assert_eq!(code(&output), exit, "{arguments:?}: {text}");
        assert!(text.contains(part), "{arguments:?}: {text}");
        assert!(!is_forged(&text), "{arguments:?}: {text}");
    }
}

/// Files without an end are read up to their limits.
#[test]
fn endless_files_are_refused() {
    let endless = "/dev/zero";
    if !std::path::Path::new(endless).exists() {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("scene.json");
    std::fs::write(&scene, document::to_json(&Scene::default())).unwrap();
    let scene = scene.to_str().unwrap();
    for (arguments, said_of_it) in [
        (&["formula", "check", endless][..], "more than 8192 bytes, the most that are read"),
        (&["scene", "--formula", endless], "more than 8192 bytes, the most that are read"),
        (&["scene", "--gradient", endless], "/dev/zero"),
        (&["render", endless, "-o", "out.png"], "at most 16777216 are read"),
        (
            &["render", scene, "-o", "out.png", "--environment", endless],
            "neither a Radiance picture (.hdr) nor an OpenEXR picture (.exr)",
        ),
    ] {
        let output = program(PROGRAM, arguments).output().unwrap();
        assert_eq!(code(&output), 2, "{arguments:?}");
        assert!(said(&output).contains(said_of_it), "{arguments:?}: {}", said(&output));
    }

    let list = folder.path().join("gallery.json");
    let linked = std::process::Command::new("ln").args(["-s", endless]).arg(&list).status();
    assert!(linked.unwrap().success());
    let is_refused = || {
        let mut command = program(PROGRAM, ["gallery", folder.path().to_str().unwrap()]);
        let output = command.output().unwrap();
        assert_eq!(code(&output), 1);
        let text = said(&output);
        assert!(text.contains("gallery.json: this file is not a gallery's list"), "{text}");
    };
    is_refused();
    // A file that is longer than memory, of which nothing is stored.
    std::fs::remove_file(&list).unwrap();
    std::fs::File::create(&list).unwrap().set_len(1 << 40).unwrap();
    is_refused();
}

/// A pipe without a reader: the command waits until somebody reads, and a signal ends it.
#[test]
fn a_pipe_that_nobody_reads_does_not_outlive_a_signal() {
    let folder = tempfile::tempdir().unwrap();
    let pipe = folder.path().join("pipe");
    let made = std::process::Command::new("mkfifo").arg(&pipe).status();
    if !made.is_ok_and(|status| status.success()) {
        return;
    }
    let mut child = program(PROGRAM, ["render", "-", "-o", "pipe", "--size", "4x4"])
        .current_dir(folder.path())
        .stdin(std::process::Stdio::piped())
        .spawn()
        .unwrap();
    let document = document::to_json(&Scene::default());
    std::io::Write::write_all(&mut child.stdin.take().unwrap(), document.as_bytes()).unwrap();
    let start = std::time::Instant::now();
    // Signals before the command waits for its reader end it too.
    let status = loop {
        let pid = child.id().to_string();
        let _ = std::process::Command::new("kill").args(["-TERM", &pid]).status();
        std::thread::sleep(std::time::Duration::from_millis(500));
        if let Some(status) = child.try_wait().unwrap() {
            break status;
        }
        assert!(start.elapsed() < HANG, "it waits for a reader");
    };
    assert!(!status.success());
}
