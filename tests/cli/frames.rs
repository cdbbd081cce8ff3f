//! `mandelight frames` as a script sees it: which files it leaves, and what it leaves alone.

use std::{
    fs,
    io::Cursor,
    path::Path,
    process::{Command, Output},
    sync::Arc,
    time::{Duration, Instant},
};

use mandelight::{
    export,
    scene::{
        Camera, Project, Scene, document,
        path::{Easing, Key},
    },
};
use mandelight_test_support::{
    patience::HANG,
    picture::Picture,
    program::{code, names_in, program, said},
};
use tempfile::TempDir;

use super::PROGRAM;

/// A path of three keys and nine frames, quickly drawn.
fn project() -> Project {
    let scene = |x: f64, power: f64| {
        let mut scene = Scene::default();
        scene.fractal.set("power", power);
        scene.fractal.iterations = 6;
        scene.quality.samples = 2;
        // What follows the view is a function of the frame alone, too.
        scene.surface.coloring.follows_view = true;
        scene.lights.follow_view = true;
        scene.camera =
            Camera::looking_at(glam::DVec3::new(x, -2.6, 0.8), glam::DVec3::ZERO, glam::DVec3::Z);
        Arc::new(scene)
    };
    let key =
        |time_secs, x, power| Key { time_secs, easing: Easing::Smooth, scene: scene(x, power) };
    let mut project = Project::from(Scene::default());
    project.path.frames_per_second = 4;
    project.path.keys = vec![key(0.0, 1.0, 5.5), key(1.0, 1.3, 5.5), key(2.0, 1.5, 6.5)];
    project
}

struct Workplace {
    folder: TempDir,
}

impl Workplace {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("path.json"), document::project_to_json(&project())).unwrap();
        Self { folder }
    }

    fn command(&self, arguments: &[&str]) -> Command {
        let all = [&["frames", "path.json", "--size", "40x30"], arguments].concat();
        let mut command = program(PROGRAM, all);
        command.current_dir(self.folder.path());
        command
    }

    fn run(&self, arguments: &[&str]) -> Output {
        self.command(arguments).output().unwrap()
    }

    fn names(&self, folder: &str) -> Vec<String> {
        names_in(&self.folder.path().join(folder))
    }

    fn frame(&self, folder: &str, frame: u32) -> Vec<u8> {
        fs::read(self.folder.path().join(folder).join(export::frame_name(frame))).unwrap()
    }
}

fn frames(range: std::ops::Range<u32>) -> Vec<String> {
    range.map(export::frame_name).collect()
}

#[test]
fn a_frame_is_the_same_alone_and_among_others() {
    let place = Workplace::new();
    let whole = place.run(&["-o", "whole"]);
    assert_eq!(code(&whole), 0, "{}", said(&whole));
    assert!(said(&whole).contains("9 frames"), "{}", said(&whole));
    let names = place.names("whole");
    assert_eq!(names[..9], frames(0..9));
    assert!(names.len() == 10 && names[9].starts_with("sequence-"), "{names:?}");

    assert_eq!(code(&place.run(&["-o", "part", "--frames", "3..5"])), 0);
    assert_eq!(place.names("part")[..2], frames(3..5));
    for frame in 3..5 {
        assert_eq!(place.frame("part", frame), place.frame("whole", frame), "frame {frame}");
    }
    assert_ne!(place.frame("whole", 3), place.frame("whole", 4), "nothing moves");

    // Each carries the scene of its moment.
    let path = project().path;
    for frame in [0, 3, 8] {
        let text = export::scene_text(Cursor::new(place.frame("whole", frame))).unwrap().unwrap();
        assert_eq!(document::from_json(&text).unwrap(), path.frame(frame).unwrap());
    }
}

#[test]
fn what_is_there_is_kept_and_the_rest_is_made() {
    let place = Workplace::new();
    assert_eq!(code(&place.run(&["-o", "out", "--frames", "2..4"])), 0);
    let written = |frame| {
        let path = place.folder.path().join("out").join(export::frame_name(frame));
        fs::metadata(path).unwrap().modified().unwrap()
    };
    let before = [2, 3].map(written);
    let again = place.run(&["-o", "out", "--frames", "..5"]);
    assert_eq!(code(&again), 0);
    assert!(said(&again).contains("3 frames, 2 kept"), "{}", said(&again));
    assert_eq!([2, 3].map(written), before);
    assert_eq!(place.names("out")[..5], frames(0..5));
    let third = place.run(&["-o", "out", "--frames", "0..5"]);
    assert!(said(&third).contains("all 5 frames exist already"), "{}", said(&third));
}

/// What a crash of the machine or a full disk leaves in place of a frame is no frame.
#[test]
fn damaged_frames_are_made_again_and_other_pictures_are_left_alone() {
    for format in ["png", "exr", "jpeg", "webp"] {
        let place = Workplace::new();
        let arguments = ["-o", "out", "--frames", "1..3", "--format", format];
        let name = format!("frame_000001.{}", if format == "jpeg" { "jpg" } else { format });
        assert_eq!(code(&place.run(&arguments)), 0);
        let path = place.folder.path().join("out").join(&name);
        let whole = fs::read(&path).unwrap();
        let of_other_size = {
            let mut file = whole.clone();
            // The width in the header of a PNG, a WebP or a JPEG; the data window of an OpenEXR file.
            let after = |mark: &[u8]| {
                file.windows(mark.len()).position(|part| part == mark).unwrap() + mark.len()
            };
            let at = match format {
                "png" => 19,
                "webp" => 24,
                "jpeg" => after(&[0xff, 0xc0, 0, 17, 8]) + 3,
                _ => after(b"dataWindow\0box2i\0") + 12,
            };
            file[at] = 20;
            file
        };
        let mut with_hole = whole.clone();
        let middle = whole.len() - 200;
        with_hole[middle..middle + 100].fill(0);
        let mut damages = vec![&b""[..], b"kept", &whole[..whole.len() - 1]];
        let zeros = vec![0; whole.len()];
        damages.push(&zeros);
        // Only the chunks of a PNG have checksums.
        if format == "png" {
            damages.push(&with_hole);
        }
        for damaged in damages {
            fs::write(&path, damaged).unwrap();
            let output = place.run(&arguments);
            assert_eq!(code(&output), 0, "{}", said(&output));
            let text = said(&output);
            assert!(text.contains("1 frame not complete, rendered again"), "{text}");
            assert!(text.contains("1 frame, 1 kept"), "{text}");
            let again = fs::read(&path).unwrap();
            // The attributes of an OpenEXR file may come in another order.
            assert!(again.len() == whole.len() && (format == "exr" || again == whole), "{format}");
        }
        let other = path.with_file_name(name.replace('1', "2"));
        for foreign in [of_other_size, fs::read(other).unwrap()] {
            fs::write(&path, &foreign).unwrap();
            let output = place.run(&arguments);
            assert_eq!(code(&output), 2, "{}", said(&output));
            assert!(said(&output).contains("move it away"), "{}", said(&output));
            assert!(fs::read(&path).unwrap() == foreign);
        }
    }
}

#[test]
fn another_sequence_is_refused_and_nothing_written_over() {
    let place = Workplace::new();
    assert_eq!(code(&place.run(&["-o", "out", "--frames", "0"])), 0);
    let (names, frame) = (place.names("out"), place.frame("out", 0));
    for other in [
        ["--samples", "3"],
        ["--set", "fractal.power=7"],
        ["--set", "path.frames_per_second=5"],
        ["--size", "44x30"],
    ] {
        // The last size given counts, where there are two.
        let mut command = place.command(&["-o", "out"]);
        let output = if other[0] == "--size" {
            let mut command = program(PROGRAM, ["frames", "path.json", "-o", "out"]);
            command.args(other);
            command.current_dir(place.folder.path()).output().unwrap()
        } else {
            command.args(other).output().unwrap()
        };
        assert_eq!(code(&output), 2, "{other:?}");
        let text = said(&output);
        assert!(text.contains("another scene") && text.contains("choose another folder"), "{text}");
    }
    assert_eq!((place.names("out"), place.frame("out", 0)), (names, frame));

    fs::create_dir(place.folder.path().join("unknown")).unwrap();
    fs::write(place.folder.path().join("unknown").join(export::frame_name(0)), "").unwrap();
    let output = place.run(&["-o", "unknown"]);
    assert_eq!(code(&output), 2);
    assert!(said(&output).contains("choose an empty folder"), "{}", said(&output));
}

#[test]
fn frames_come_as_openexr_too_in_a_folder_of_their_own() {
    let place = Workplace::new();
    assert_eq!(code(&place.run(&["-o", "exr", "--frames", "3..5", "--exr"])), 0);
    let names = place.names("exr");
    assert_eq!(names[..2], ["frame_000003.exr", "frame_000004.exr"]);
    for name in &names[..2] {
        let file = fs::read(place.folder.path().join("exr").join(name)).unwrap();
        assert_eq!(file[..4], [0x76, 0x2f, 0x31, 0x01], "{name} does not begin as OpenEXR does");
    }
    let again = place.run(&["-o", "exr", "--frames", "3..5", "--exr"]);
    assert!(said(&again).contains("all 2 frames exist already"), "{}", said(&again));
    assert_eq!(code(&place.run(&["-o", "exr"])), 2, "PNGs do not go between them");
}

#[test]
fn frames_come_as_jpeg_and_webp_too() {
    let place = Workplace::new();
    for (format, name, start) in
        [("jpeg", "frame_000003.jpg", &b"\xff\xd8\xff"[..]), ("webp", "frame_000003.webp", b"RIFF")]
    {
        let output = place.run(&["-o", format, "--frames", "3", "--format", format]);
        assert_eq!(code(&output), 0, "{}", said(&output));
        assert_eq!(place.names(format)[0], name);
        let file = fs::read(place.folder.path().join(format).join(name)).unwrap();
        assert!(file.starts_with(start), "{name}");
        assert_eq!(code(&place.run(&["-o", format])), 2, "PNGs do not go between them");
    }
    let other = ["-o", "jpeg", "--frames", "3", "--format", "jpeg", "--quality", "50"];
    assert_eq!(code(&place.run(&other)), 2, "another quality is another sequence");
    let both = place.run(&["-o", "exr", "--format", "jpeg", "--exr"]);
    assert!(code(&both) == 2 && said(&both).contains("cannot be used with"), "{}", said(&both));
    let stray = place.folder.path().join("stray");
    fs::create_dir(&stray).unwrap();
    fs::write(stray.join("frame_000003.webp"), "").unwrap();
    assert_eq!(code(&place.run(&["-o", "stray"])), 2);
}

#[test]
fn two_processes_fill_one_folder() {
    let place = Workplace::new();
    let children: Vec<_> = ["0..5", "4..9"]
        .into_iter()
        .map(|range| place.command(&["-o", "out", "--frames", range]).spawn().unwrap())
        .collect();
    for child in children {
        let output = child.wait_with_output().unwrap();
        assert_eq!(code(&output), 0, "{}", said(&output));
    }
    let names = place.names("out");
    assert_eq!((names.len(), &names[..9]), (10, &frames(0..9)[..]));
}

#[test]
fn a_killed_run_leaves_only_whole_frames_and_can_go_on() {
    let place = Workplace::new();
    let mut child = place.command(&["-o", "out", "--samples", "200"]).spawn().unwrap();
    let first = place.folder.path().join("out").join(export::frame_name(0));
    let patience = Instant::now();
    while !first.exists() {
        assert!(patience.elapsed() < HANG, "no frame came");
        std::thread::sleep(Duration::from_millis(5));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    for name in place.names("out").iter().filter(|name| name.starts_with("frame_")) {
        let file = fs::read(place.folder.path().join("out").join(name)).unwrap();
        assert!(is_whole(&file), "{name} is half written");
    }
    let done = place.frame("out", 0);
    assert_eq!(code(&place.run(&["-o", "out", "--samples", "200", "--frames", "..2"])), 0);
    assert_eq!(place.frame("out", 0), done);
    assert!(is_whole(&place.frame("out", 1)));
    assert_no_parts(&place.names("out"));
    // What another killed run leaves is removed where all frames exist, too.
    fs::write(place.folder.path().join("out/.mandelight-1-2.part"), "half").unwrap();
    let again = place.run(&["-o", "out", "--samples", "200", "--frames", "..2"]);
    assert!(said(&again).contains("all 2 frames exist already"), "{}", said(&again));
    assert_no_parts(&place.names("out"));
}

#[test]
fn an_interruption_leaves_nothing_half_made_and_says_how_to_go_on() {
    let place = Workplace::new();
    let child = place.command(&["-o", "out", "--samples", "1000"]).spawn().unwrap();
    let folder = place.folder.path().join("out");
    let patience = Instant::now();
    let is_under_way =
        || folder.exists() && place.names("out").iter().any(|n| n.ends_with(".part"));
    while !is_under_way() {
        assert!(patience.elapsed() < HANG, "no frame was begun");
        std::thread::sleep(Duration::from_millis(2));
    }
    let pid = child.id().to_string();
    assert!(Command::new("kill").args(["-INT", &pid]).status().unwrap().success());
    let output = child.wait_with_output().unwrap();
    assert_eq!(code(&output), 1);
    let text = said(&output);
    assert!(text.contains("interrupted") && text.contains("the same command goes on"), "{text}");
    assert_no_parts(&place.names("out"));
}

/// No file has a temporary name.
fn assert_no_parts(names: &[String]) {
    assert!(!names.iter().any(|name| name.ends_with(".part")), "{names:?}");
}

fn is_whole(file: &[u8]) -> bool {
    Picture::decode(Cursor::new(file)).is_ok()
}

#[test]
fn what_cannot_be_rendered_says_why() {
    let place = Workplace::new();
    let said_of = |arguments: &[&str]| {
        let output = place.run(arguments);
        assert_eq!(code(&output), 2, "{arguments:?}");
        said(&output)
    };
    assert!(said_of(&["-o", "out", "--frames", "9.."]).contains("9: the last frame is 8"));
    assert!(said_of(&["-o", "out", "--frames", "5..3"]).contains("holds no frame"));
    assert!(said_of(&["-o", "out", "--set", "path.speed=3"]).contains("no such field"));
    assert!(said_of(&["-o", "out", "--set", "tone.exposure=99"]).contains("outside -10 to 10"));
    assert!(!Path::new(&place.folder.path().join("out")).exists());

    let bare = place.folder.path().join("path.json");
    fs::write(&bare, document::to_json(&Scene::default())).unwrap();
    assert!(said_of(&["-o", "out"]).contains("no camera path"));
}

/// The documented line: frames through a pipe, and the video that FFmpeg makes of them.
#[cfg(unix)]
#[test]
fn frames_flow_into_a_video() {
    let docs = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/paths.md");
    let docs = fs::read_to_string(docs).unwrap();
    let line = docs.lines().map(str::trim).find(|line| line.contains("-o - ")).expect("the line");
    let place = Workplace::new();
    let folder = place.folder.path();
    fs::rename(folder.join("path.json"), folder.join("flight.json")).unwrap();
    let programs = Path::new(PROGRAM).parent().unwrap();
    let path = format!("{}:{}", programs.display(), std::env::var("PATH").unwrap());
    let line = line.replace("1920x1080", "64x48").replace("-framerate 30", "-framerate 4");
    let made = Command::new("sh")
        .args(["-ec", &line])
        .current_dir(folder)
        .env("PATH", path)
        .output()
        .expect("a shell");
    assert!(made.status.success(), "{line}: {}", said(&made));
    let probe = Command::new("ffprobe")
        .args(["-v", "error", "-count_frames", "-of", "csv=p=0", "-show_entries"])
        .arg("stream=width,height,r_frame_rate,nb_read_frames")
        .arg(folder.join("flight.mp4"))
        .output()
        .expect("ffprobe");
    assert_eq!(String::from_utf8_lossy(&probe.stdout).trim(), "64,48,4/1,9");
}

#[test]
fn standard_output_takes_one_png_a_frame() {
    let place = Workplace::new();
    for arguments in [&["--exr"][..], &["--format", "jpeg"], &["--stereo", "pair"]] {
        let refused = place.run(&[&["-o", "-"], arguments].concat());
        assert_eq!(code(&refused), 2, "{arguments:?}");
        assert!(said(&refused).contains(arguments[0]), "{}", said(&refused));
        assert!(refused.stdout.is_empty());
    }
    let files = place.run(&["-o", "files", "--frames", "2..4"]);
    let stream = place.run(&["-o", "-", "--frames", "2..4"]);
    assert_eq!((code(&files), code(&stream)), (0, 0), "{}", said(&stream));
    assert_eq!(stream.stdout, [place.frame("files", 2), place.frame("files", 3)].concat());
}

/// A printed turntable has the frames of its time, and is drawn as any other path.
#[test]
fn a_turntable_is_printed_as_a_path() {
    let printed = program(PROGRAM, ["scene", "--preset", "sea-urchin", "--turntable", "2.5"])
        .output()
        .unwrap();
    assert_eq!(code(&printed), 0, "{}", said(&printed));
    let text = String::from_utf8(printed.stdout).unwrap();
    let path = document::project_from_json(&text).unwrap().path;
    assert_eq!(path.frame_count(), 75);
    for wrong in ["0", "0.5", "3601", "nan", "soon"] {
        let refused = program(PROGRAM, ["scene", "--turntable", wrong]).output().unwrap();
        assert_eq!(code(&refused), 2, "{wrong}");
        assert!(said(&refused).contains("--turntable"), "{}", said(&refused));
    }
}
