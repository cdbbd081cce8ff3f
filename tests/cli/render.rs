//! Single pictures and what else the commands print: exit codes, messages, files.

use std::{
    ffi::OsStr,
    fs,
    io::Write,
    path::Path,
    process::{Child, Command, Output, Stdio},
};

use mandelight::scene::{document, presets};
use mandelight_test_support::{
    picture::Picture,
    program::{self, code, names_in, program, said},
};
use serde_json::{Value, json};

use super::PROGRAM;

fn run<S: AsRef<OsStr>>(arguments: &[S]) -> Output {
    program(PROGRAM, arguments).output().unwrap()
}

fn run_with_input<S: AsRef<OsStr>>(arguments: &[S], input: &[u8]) -> Output {
    program::run_with_input(program(PROGRAM, arguments), input)
}

fn default_document() -> Value {
    let output = run(&["scene"]);
    assert_eq!(code(&output), 0);
    serde_json::from_slice(&output.stdout).unwrap()
}

/// A picture's size and pixels, and the scene that it carries.
struct Decoded {
    size_px: [u32; 2],
    scene: Value,
    rgb: Vec<u8>,
}

fn decoded(file: &[u8]) -> Decoded {
    let picture = Picture::of(file);
    let (_, text) = picture.texts.iter().find(|(keyword, _)| keyword == "mandelight").unwrap();
    let scene = serde_json::from_str(text).unwrap();
    Decoded { size_px: picture.size_px, scene, rgb: picture.bytes }
}

/// `document` with one of its fields changed.
fn with(mut document: Value, pointer: &str, value: Value) -> String {
    *document.pointer_mut(pointer).unwrap() = value;
    document.to_string()
}

#[test]
fn a_bad_scene_is_refused_by_file_and_field() {
    let good = default_document();
    let mut unknown_field = good.clone();
    unknown_field["scene"]["fractal"]["colour"] = json!(1);
    let huge_number = good.to_string().replace("\"power\":8.0", "\"power\":1e999");
    let not_a_number = good.to_string().replace("\"power\":8.0", "\"power\":NaN");
    assert!(huge_number.contains("1e999") && not_a_number.contains("NaN"));

    let cases: Vec<(&str, Vec<u8>, &str)> = vec![
        (
            "out of range",
            with(good.clone(), "/scene/fractal/power", json!(40)).into(),
            "fractal.power: 40 is outside 2 to 16",
        ),
        (
            "wrong kind",
            with(good.clone(), "/scene/fractal/power", json!("8")).into(),
            "fractal.power: ",
        ),
        ("unknown field", unknown_field.to_string().into(), "unknown field `colour`"),
        ("infinite", huge_number.into(), "fractal.power: "),
        ("not a number", not_a_number.into(), "line 1"),
        ("later version", with(good.clone(), "/version", json!(3)).into(), "version: 3"),
        (
            "a light",
            with(good.clone(), "/scene/lights/environment/1/intensity", json!(-1)).into(),
            "lights.environment[1].intensity",
        ),
        ("other JSON", b"{}".to_vec(), "not a Mandelight scene"),
        ("a list", b"[1]".to_vec(), "not a Mandelight scene"),
        ("text", b"hello".to_vec(), "not a Mandelight scene"),
        ("half a document", b"{\"mandelight\":".to_vec(), "line 1"),
        ("nothing", Vec::new(), "line 1"),
        ("depth", format!("{{\"a\":{}", "[".repeat(200_000)).into(), "line 1"),
        ("length", vec![b' '; document::MAX_BYTES + 1], "at most"),
        ("bytes", vec![0xff; 100], "neither a scene document nor a PNG"),
        ("half a picture", b"\x89PNG\r\n\x1a\n\0\0".to_vec(), "not a readable PNG"),
    ];
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bad.json");
    let out = folder.path().join("out.png");
    for (what, document, message) in cases {
        fs::write(&path, &document).unwrap();
        let output = run(&["render".as_ref(), path.as_os_str(), "-o".as_ref(), out.as_os_str()]);
        let said = said(&output);
        assert_eq!(code(&output), 2, "{what}: {said}");
        let start = format!("mandelight: {}: ", path.display());
        assert!(said.starts_with(&start) && said.contains(message), "{what}: {said}");
        assert!(output.stdout.is_empty(), "{what}");

        let piped = run_with_input(
            &["render".as_ref(), "-".as_ref(), "-o".as_ref(), out.as_os_str()],
            &document,
        );
        assert_eq!(code(&piped), 2, "{what} through a pipe");
        assert!(
            String::from_utf8_lossy(&piped.stderr).starts_with("mandelight: standard input: "),
            "{what}"
        );
    }
    assert_eq!(names_in(folder.path()), ["bad.json"]);
}

#[test]
fn wrong_usage_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("scene.json");
    fs::write(&scene, default_document().to_string()).unwrap();
    let out = folder.path().join("out.png");
    let (scene, out) = (scene.to_str().unwrap(), out.to_str().unwrap());
    for (arguments, message) in [
        (vec![], "Usage"),
        (vec!["paint"], "paint"),
        (vec!["render", scene], "--output"),
        (vec!["render", "-o", out], "SCENE"),
        (vec!["render", scene, "-o", out, "--size", "0x0"], "1 to 16384"),
        (vec!["render", scene, "-o", out, "--size", "20000x1"], "1 to 16384"),
        (vec!["render", scene, "-o", out, "--size", "640"], "1280x720"),
        (vec!["render", scene, "-o", out, "--samples", "0"], "1 to 65536"),
        (vec!["render", scene, "-o", out, "--samples", "1e3"], "1 to 65536"),
        (vec!["render", scene, "-o", out, "--integrator", "photon"], "direct, path"),
        (vec!["render", scene, "-o", out, "--bounces", "65"], "0 to 64"),
        (vec!["render", scene, "-o", out, "--noise", "2"], "0 to 0.5"),
        (vec!["render", scene, "-o", out, "--set", "fractal.power"], "path=value"),
        (
            vec!["render", scene, "-o", out, "--set", "fractal.power=40"],
            "fractal.power: 40 is outside 2 to 16",
        ),
        (
            vec!["render", scene, "-o", out, "--set", "fractal.pwoer=3"],
            "fractal.pwoer: there is no such field",
        ),
        (vec!["render", "missing.json", "-o", out], "mandelight: missing.json: "),
        (vec!["scene", "--preset", "nothing"], "mandelbulb"),
    ] {
        let output = run(&arguments);
        let said = said(&output);
        assert_eq!(code(&output), 2, "{arguments:?}: {said}");
        assert!(said.contains(message), "{arguments:?}: {said}");
    }
    assert_eq!(names_in(folder.path()), ["scene.json"]);
}

#[test]
fn what_cannot_be_written_fails_before_any_rendering() {
    let folder = tempfile::tempdir().unwrap();
    let document = default_document().to_string();
    for out in [folder.path().join("none/out.png"), folder.path().to_owned()] {
        // A size that would take minutes.
        let arguments = ["render", "-", "--size", "16384x16384", "-o", out.to_str().unwrap()];
        let output = run_with_input(&arguments, document.as_bytes());
        assert_eq!(code(&output), 1);
        assert!(said(&output).starts_with(&format!("mandelight: {}: ", out.display())));
    }
    assert!(names_in(folder.path()).is_empty());
}

#[test]
fn an_adapter_that_is_not_there_is_a_failure() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out.png");
    let arguments = ["render", "-", "--adapter", "no such GPU", "-o", out.to_str().unwrap()];
    for output in [
        run_with_input(&arguments, default_document().to_string().as_bytes()),
        run(&["info", "--adapter", "no such GPU"]),
        program(PROGRAM, ["info"]).env("WGPU_ADAPTER_NAME", "no such GPU").output().unwrap(),
    ] {
        assert_eq!(code(&output), 1);
        assert!(said(&output).contains("no such GPU"), "{}", said(&output));
    }
    assert!(names_in(folder.path()).is_empty());
}

#[test]
fn the_scene_command_prints_documents() {
    let list = String::from_utf8(run(&["scene", "--list-presets"]).stdout).unwrap();
    let names: Vec<&str> =
        list.lines().map(|line| line.split_whitespace().next().unwrap()).collect();
    assert_eq!(names.len(), presets::all().count(), "{list}");
    let documents: Vec<Vec<u8>> = names
        .iter()
        .map(|name| {
            let output = run(&["scene", "--preset", name]);
            assert_eq!(code(&output), 0, "{name}");
            output.stdout
        })
        .collect();
    assert_eq!(documents[0], run(&["scene"]).stdout);
    assert!((1..names.len()).all(|i| documents[i] != documents[i - 1]));

    let changed =
        run(&["scene", "--set", "fractal.power=3", "--set", "camera.position[0]=-1.5"]).stdout;
    let changed: Value = serde_json::from_slice(&changed).unwrap();
    assert_eq!(changed["scene"]["fractal"]["power"], json!(3.0));
    assert_eq!(changed["scene"]["camera"]["position"][0], json!("-1.5"));
}

#[test]
fn the_places_command_prints_scenes_at_a_depth() {
    let document = default_document().to_string();
    let output =
        run_with_input(&["places", "-", "--depth", "1e-9", "--count", "3"], document.as_bytes());
    assert_eq!((code(&output), said(&output)), (0, String::new()));
    let text = String::from_utf8(output.stdout).unwrap();
    let scenes: Vec<_> =
        text.lines().map(|line| mandelight::scene::document::from_json(line).unwrap()).collect();
    assert_eq!(scenes.len(), 3);
    let opening = mandelight::scene::document::from_json(&document).unwrap();
    for scene in &scenes {
        assert!((scene.camera.view_unit() / 1e-9 - 1.0).abs() < 1e-6);
        let same = mandelight::scene::Scene { camera: opening.camera.clone(), ..scene.clone() };
        assert_eq!(same, opening, "only the camera is another");
    }
    assert_ne!(scenes[0].camera, scenes[1].camera);

    let turned = with(default_document(), "/scene/camera/orientation", json!([1.0, 0.0, 0.0, 0.0]));
    let output = run_with_input(&["places", "-"], turned.as_bytes());
    assert_eq!(code(&output), 1);
    assert!(said(&output).contains("no place in view"), "{}", said(&output));
    let output = run_with_input(&["places", "-", "--depth", "1e-30"], document.as_bytes());
    assert_eq!(code(&output), 2);
}

#[test]
fn a_reader_that_leaves_is_no_failure() {
    let mut child = program(PROGRAM, ["scene"]).spawn().unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert_eq!(code(&output), 0);
    assert_eq!(said(&output), "");
}

/// The memory of a view with everything on ends the text, and is what the thesis allows.
#[test]
fn info_counts_the_memory_of_a_view() {
    let output = run(&["info", "--size", "1920x1080"]);
    assert_eq!(code(&output), 0);
    let text = String::from_utf8(output.stdout).unwrap();
    let bytes_after = |name: &str| -> u64 {
        let found = text.lines().find_map(|line| line.strip_prefix(name));
        found.unwrap_or_else(|| panic!("no {name} in {text}")).parse().unwrap()
    };
    let total = bytes_after("total_bytes ");
    assert!((1920 * 1080 * 40..122_159_104).contains(&total), "{total}");
    let traced = bytes_after("total_bytes_with_path_tracing ");
    assert!((total..160 << 20).contains(&traced), "{traced}");
    let facts = run(&["info", "--json", "--size", "1920x1080"]);
    let facts: serde_json::Value = serde_json::from_slice(&facts.stdout).unwrap();
    let parts = facts["memory_bytes"].as_object().unwrap().values();
    assert_eq!(parts.map(|bytes| bytes.as_u64().unwrap()).sum::<u64>(), total);
    assert_eq!(facts["total_bytes"].as_u64(), Some(total));
    assert_eq!(code(&run(&["info", "--size", "16384x16384"])), 2);
    assert_eq!(code(&run(&["info", "--size", "0x10"])), 2);
}

#[test]
fn info_tells_of_the_gpu() {
    let facts = run(&["info", "--json"]);
    assert_eq!(code(&facts), 0, "{}", said(&facts));
    let facts: Value = serde_json::from_slice(&facts.stdout).unwrap();
    let adapter = facts["adapter"].as_str().unwrap();
    assert!(facts["adapters"].as_array().unwrap().contains(&json!(adapter)));
    assert_eq!(facts["limits"]["maxTextureDimension2D"], json!(8192), "WebGPU's default");
    assert_eq!(
        facts["limits"]["maxStorageBufferBindingSize"],
        json!(128 << 20),
        "WebGPU's default"
    );

    let text = String::from_utf8(run(&["info"]).stdout).unwrap();
    assert!(text.contains(adapter));
    // Any part of the name chooses it, in any case.
    let part: String = adapter.chars().take(5).collect::<String>().to_uppercase();
    assert_eq!(code(&run(&["info", "--adapter", &part])), 0);
}

#[test]
fn a_piped_scene_becomes_a_picture_that_carries_it() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out.png");
    let document = run(&["scene"]).stdout;
    let arguments =
        ["render", "-", "--size", "64x48", "--samples", "2", "-o", out.to_str().unwrap()];
    let output = run_with_input(&arguments, &document);
    assert_eq!(code(&output), 0, "{}", said(&output));
    assert!(said(&output).contains("64x48"));
    assert_eq!(names_in(folder.path()), ["out.png"]);

    let picture = decoded(&fs::read(&out).unwrap());
    assert_eq!(picture.size_px, [64, 48]);
    let mut expected: Value = serde_json::from_slice(&document).unwrap();
    expected["scene"]["quality"]["samples"] = json!(2);
    assert_eq!(picture.scene, expected);
    let distinct: std::collections::HashSet<&[u8]> = picture.rgb.chunks(3).collect();
    assert!(distinct.len() > 100, "only {} colours", distinct.len());

    // From the picture again, quietly, and through a pipe.
    let again = run(&["render", out.to_str().unwrap(), "--size", "64x48", "--quiet", "-o", "-"]);
    assert_eq!(code(&again), 0);
    assert_eq!(said(&again), "");
    let again = decoded(&again.stdout);
    assert_eq!(again.scene, picture.scene);
    assert!(again.rgb == picture.rgb, "the same scene gave other pixels");

    // And a change shows.
    let other = run(&[
        "render",
        out.to_str().unwrap(),
        "--size",
        "64x48",
        "--set",
        "fractal.power=3",
        "-o",
        "-",
    ]);
    assert!(decoded(&other.stdout).rgb != picture.rgb);
}

/// A render of minutes, caught once it has begun to write.
#[cfg(unix)]
/// The command line chooses the integrator, and the picture's scene names it.
#[test]
fn a_picture_of_traced_paths_carries_how_it_was_traced() {
    let document = default_document().to_string();
    let render = |options: &[&str]| {
        let mut arguments = vec!["render", "-", "-o", "-", "--size", "48x32", "--samples", "16"];
        arguments.extend(options);
        let output = run_with_input(&arguments, document.as_bytes());
        assert_eq!(code(&output), 0, "{}", said(&output));
        decoded(&output.stdout)
    };
    let direct = render(&[]);
    let traced = render(&["--integrator", "path", "--bounces", "2", "--noise", "0.3"]);
    let integrator = &traced.scene["scene"]["integrator"];
    assert_eq!(integrator["kind"], "path");
    assert_eq!(
        (integrator["bounces"].as_u64(), integrator["noise"].as_f64()),
        (Some(2), Some(0.3))
    );
    assert!(traced.rgb != direct.rgb, "traced light looks as direct light does");
    let denoised =
        render(&["--integrator", "path", "--bounces", "2", "--noise", "0.3", "--denoise"]);
    assert_eq!(denoised.scene["scene"]["integrator"]["denoise"], true);
    assert!(denoised.rgb != traced.rgb, "nothing was denoised");
}

#[test]
fn the_firefly_limit_is_reported() {
    let document = default_document().to_string();
    let arguments =
        "render - -o - --size 48x32 --samples 16 --integrator path --firefly-limit 0.1".split(' ');
    let output = run_with_input(&arguments.collect::<Vec<_>>(), document.as_bytes());
    assert_eq!(code(&output), 0, "{}", said(&output));
    let line = said(&output);
    let percent = line.split("limit removed ").nth(1).and_then(|rest| rest.split(' ').next());
    let percent: f64 = percent.and_then(|percent| percent.parse().ok()).expect("a percentage");
    assert!((1.0..100.0).contains(&percent), "{line}");
}

fn long_render(out: &Path) -> Child {
    let arguments =
        ["render", "-", "--size", "8000x8000", "--samples", "64", "-o", out.to_str().unwrap()];
    let document = run(&["scene"]).stdout;
    let mut child = program(PROGRAM, arguments).stdin(Stdio::piped()).spawn().unwrap();
    child.stdin.take().unwrap().write_all(&document).unwrap();
    let folder = out.parent().unwrap();
    while names_in(folder).is_empty() {
        assert!(child.try_wait().unwrap().is_none(), "it ended before it was interrupted");
        std::thread::sleep(std::time::Duration::from_millis(10));
    }
    child
}

#[cfg(unix)]
#[test]
fn an_interrupted_render_leaves_nothing() {
    for signal in ["-INT", "-TERM"] {
        let folder = tempfile::tempdir().unwrap();
        let child = long_render(&folder.path().join("out.png"));
        let kill = Command::new("kill").args([signal, &child.id().to_string()]).status().unwrap();
        assert!(kill.success());
        let output = child.wait_with_output().unwrap();
        assert_eq!(code(&output), 1);
        assert!(said(&output).contains("interrupted"), "{}", said(&output));
        assert!(names_in(folder.path()).is_empty());
    }
}

/// The most memory that rendering a picture of this height took, in kB.
#[cfg(target_os = "linux")]
fn peak_kb(height_px: u32) -> u64 {
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("scene.json");
    // The overview of a picture with indirect light, or a gradient that follows the view, grows with the
    // picture, up to a limit.
    let mut plain = vec!["scene", "--set", "quality.shadows=false", "--set", "indirect.kind=off"];
    plain.extend(["--set", "surface.coloring.follows_view=false"]);
    fs::write(&scene, run(&plain).stdout).unwrap();
    let (size, out) = (format!("512x{height_px}"), folder.path().join("out.png"));
    let (scene, out) = (scene.to_str().unwrap(), out.to_str().unwrap());
    let mut child =
        program(PROGRAM, ["render", scene, "--size", &size, "--samples", "2", "-o", out])
            .spawn()
            .unwrap();
    let mut peak_kb = 0;
    while child.try_wait().unwrap().is_none() {
        let status = fs::read_to_string(format!("/proc/{}/status", child.id())).unwrap_or_default();
        let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
        let kb = line.and_then(|line| line.trim().strip_suffix(" kB")?.parse().ok());
        peak_kb = peak_kb.max(kb.unwrap_or(0));
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    assert_eq!(code(&child.wait_with_output().unwrap()), 0);
    assert!(peak_kb > 0);
    peak_kb
}

/// Eight times the rows took 1 MB more; 83 MB more while lavapipe kept a shader a dispatch.
#[cfg(target_os = "linux")]
#[test]
fn a_higher_picture_takes_no_more_memory() {
    let [low, high] = [256, 2048].map(peak_kb);
    assert!(high < low + 16_000, "{low} kB for 256 rows, {high} kB for 2048");
}

#[test]
fn the_manual_names_every_option() {
    let manual =
        fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/command-line.md")).unwrap();
    for command in ["render", "scene", "places", "info"] {
        let section = manual
            .split("\n## ")
            .find(|s| s.starts_with(&format!("`mandelight {command}")))
            .unwrap();
        let help = String::from_utf8(run(&[command, "--help"]).stdout).unwrap();
        let mut in_help = options_in(&help);
        assert!(in_help.remove("--help"), "{help}");
        assert_eq!(options_in(section), in_help, "mandelight {command}");
    }
}

/// Words such as `--size`.
fn options_in(text: &str) -> std::collections::BTreeSet<String> {
    text.split(|c: char| !(c.is_ascii_alphanumeric() || c == '-'))
        .filter(|word| word.starts_with("--") && word.len() > 3)
        .map(str::to_owned)
        .collect()
}

#[test]
fn an_environment_map_lights_the_scene() {
    let folder = tempfile::tempdir().unwrap();
    let picture = folder.path().join("garden.hdr");
    let mut bytes = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 8 +X 16\n".to_vec();
    bytes.extend((0..128).flat_map(|i| [200 - i, 100, i, 128]));
    fs::write(&picture, &bytes).unwrap();
    let out = folder.path().join("out.png");
    let call = |more: &[&str]| {
        let mut arguments = vec!["render", "-", "-q", "--size", "16x12", "--samples", "1"];
        arguments.extend(["--output", out.to_str().unwrap()]);
        arguments.extend(more);
        run_with_input(&arguments, default_document().to_string().as_bytes())
    };
    let environment = ["--environment", picture.to_str().unwrap()];
    let output = call(&[&environment[..], &["--environment-lights", "5"]].concat());
    assert_eq!((code(&output), said(&output)), (0, String::new()));
    let scene = &decoded(&fs::read(&out).unwrap()).scene["scene"];
    let rig = &scene["lights"]["rig"];
    assert_eq!((&rig["kind"], &rig["picture"]["name"]), (&json!("picture"), &json!("garden.hdr")));
    assert_eq!(rig["picture"]["lights"].as_array().unwrap().len(), 5);
    assert_eq!(scene["background"]["kind"], "picture");

    assert_eq!(code(&call(&["--environment-lights", "5"])), 2, "lights of no picture");
    assert_eq!(code(&call(&[&environment[..], &["--environment-lights", "65"]].concat())), 2);
    fs::write(&picture, &bytes[..100]).unwrap();
    let output = call(&environment);
    assert_eq!(code(&output), 2);
    assert!(said(&output).contains("garden.hdr: the picture cannot be read"), "{}", said(&output));
}
