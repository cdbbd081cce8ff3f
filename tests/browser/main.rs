//! The built page in a real browser: what the scripts in `tests/browser/` saw there, judged.
//!
//! `cargo xtask test` builds the page, makes sure of the browser and says where both are. What each
//! visit leaves (observations, downloads, screenshots to look at) is in `target/browser/`.

mod ended;
mod files;
mod formats;
mod gallery;
mod headers;
mod loss;
mod missing;
mod opening;
mod picture;
mod sequence;
mod size;
mod states;
mod storage;
mod video;
mod visit;
mod walk;

use std::{
    fs::{self, File},
    io::BufReader,
    path::{Path as FilePath, PathBuf},
    process::Command,
};

use base64::Engine as _;
use mandelight::{
    export,
    formula::{self, Fractal},
    render::{Region, shaders, uniforms::Inputs},
    scene::{Scene, document, link, presets},
};
use mandelight_test_support::expressions::Expressions;
use picture::Picture;
use qrcodegen::{QrCode, QrCodeEcc};
use serde_json::Value;
use visit::{Visit, folder_of};

/// White modules around a QR code.
const QUIET_MODULES: i32 = 4;

#[test]
fn a_page_that_cannot_draw_says_what_would_help() {
    let visit = Visit::run("unavailable");
    assert!(visit.text("/without_webgpu/text").contains("no WebGPU"));
    assert!(visit.text("/without_webgpu/detail").contains("Chrome"));
    assert!(visit.text("/without_gpu/detail").contains("acceleration"));
    assert_eq!(visit.seen["again"], visit.seen["without_webgpu"]);

    let asked: Vec<&str> =
        visit.seen["asked"].as_array().unwrap().iter().filter_map(Value::as_str).collect();
    assert!(asked.iter().any(|name| name.starts_with("boot-")), "{asked:?}");
    assert!(!asked.iter().any(|name| name.ends_with(".wasm")), "the module was loaded: {asked:?}");
}

#[test]
fn a_visitor_turns_changes_lights_saves_and_comes_back() {
    let linked = presets::opening_scenes()[3].scene;
    let fragment = link::to_fragment(&linked()).unwrap();
    let visit = Visit::run_with("explore", [("MANDELIGHT_LINK", fragment)]);

    // The page opens on the first scene, and takes a scene to its last sample.
    let opened = visit.scene("opened");
    let first = presets::opening();
    assert_eq!(Scene { camera: first.camera.clone(), ..opened.clone() }, first);
    let quick = visit.scene("quick");
    assert_eq!(visit.number("/quick/samplesDone"), f64::from(quick.quality.samples));

    // Whoever does nothing costs nothing.
    for count in ["dispatches", "frames", "pictures"] {
        let [early, late] = [0, 1].map(|i| visit.number(&format!("/idle/{i}/{count}")));
        assert_eq!(early, late, "an idle page went on: {count}");
    }

    // Hiding the panel leaves the picture on the screen, and the finished one is no other.
    let shot = |name: &str| Picture::read_png(&visit.folder.join(format!("{name}-720x420.png")));
    let part = |picture: &Picture, view: usize| {
        let side = |name: &str| visit.number(&format!("/views/{view}/{name}"));
        let center = [side("x") + side("width") / 2.0, side("y") + side("height") / 2.0];
        picture.crop(center.map(|at| at as u32 - 90), [180, 180])
    };
    let shown = part(&shot("panel"), 0);
    assert!(shown.contrast() > 20.0, "{}", shown.contrast());
    for name in ["no-panel", "no-panel-finished"] {
        let difference = shown.difference(&part(&shot(name), 1));
        assert!(difference.mean < 1.25, "{name}: {difference:?}");
    }

    only_changes(&visit, "quick", "turned", &["camera"]);
    let turned = visit.scene("turned");
    assert_ne!(turned.camera.orientation, opened.camera.orientation);

    only_changes(&visit, "turned", "approached", &["camera"]);
    let approached = visit.scene("approached");
    assert_eq!(approached.camera.orientation, turned.camera.orientation);
    assert_ne!(approached.camera.position, turned.camera.position);

    only_changes(&visit, "approached", "powered", &["fractal", "camera"]);
    assert!(visit.scene("powered").fractal.number("power") < approached.fractal.number("power"));

    only_changes(&visit, "powered", "lit", &["lights"]);
    only_changes(&visit, "lit", "relit", &["lights"]);
    let (lit, relit) = (visit.scene("lit").lights, visit.scene("relit").lights);
    assert_eq!(lit.point.len(), opened.lights.point.len() + 1);
    assert_eq!(lit.environment, relit.environment);
    assert_ne!(lit.point.last().unwrap().position, relit.point.last().unwrap().position);

    // The picture that was saved is a picture, and carries its scene.
    let file = visit.folder.join("download.png");
    let saved = Picture::read_png(&file);
    let size_px = ["width", "height"].map(|side| visit.number(&format!("/finished/{side}")) as u32);
    assert_eq!(saved.size_px, size_px);
    assert!(saved.contrast() > 5.0, "the saved picture is empty");
    let text = export::scene_text(BufReader::new(File::open(&file).unwrap())).unwrap();
    let carried = document::from_json(&text.expect("the picture carries a scene")).unwrap();
    assert_eq!(carried, visit.scene("before_reload"));

    // The share sheet gets the same file, and the clipboard the same picture.
    assert_eq!(visit.text("/shared/type"), "image/png");
    assert_eq!(visit.text("/shared/name"), visit.text("/download"));
    assert_eq!(fs::read(visit.folder.join("shared.png")).unwrap(), fs::read(&file).unwrap());
    let copied = Picture::read_png(&visit.folder.join("copied.png"));
    assert_eq!(copied.size_px, saved.size_px);
    assert!(copied.difference(&saved).mean < 0.01, "the clipboard has another picture");

    // The finished picture was saved, sent and copied as it was.
    assert_eq!(visit.number("/saved_dispatches"), 0.0);
    assert_eq!(visit.number("/used_dispatches"), 0.0);

    let kept = base64::prelude::BASE64_STANDARD.decode(visit.text("/kept/picture")).unwrap();
    assert!(kept.starts_with(&[0xff, 0xd8]) && kept.len() > 1000, "a small JPEG file");

    // The address holds the scene, a reload keeps it, so does the browser's storage, and a link
    // shows its own.
    let before = visit.scene("before_reload");
    assert_eq!(link::from_fragment(visit.text("/fragment")).unwrap(), before);
    assert_eq!(visit.scene("reloaded"), before);
    assert_eq!(visit.scene("undone"), visit.scene("lit"), "the steps outlive a reload");
    assert_eq!(visit.scene("revisited"), before);
    assert_eq!(visit.scene("linked"), linked());

    // The copied link opens the view, and the code on the screen is that link.
    let address = visit.text("/link");
    let (_, fragment) = address.split_once('#').expect("a fragment");
    assert_eq!(link::from_fragment(fragment).unwrap(), before);
    assert_eq!(visit.scene("copied"), before);
    let code = QrCode::encode_text(address, QrCodeEcc::Low).unwrap();
    let window = shot("shared");
    let modules = code.size() + 2 * QUIET_MODULES;
    let module_px = visit.number("/code/width") / f64::from(modules);
    let middle_px = |side: &str, index: i32| {
        let within = (f64::from(index + QUIET_MODULES) + 0.5) * module_px;
        (visit.number(&format!("/code/{side}")) + within) as u32
    };
    for (row, column) in (0..code.size()).flat_map(|y| (0..code.size()).map(move |x| (y, x))) {
        let color = window.crop([middle_px("x", column), middle_px("y", row)], [1, 1]).mean_color();
        let is_dark = color[0] < 128.0;
        assert_eq!(is_dark, code.get_module(column, row), "module {column}, {row}");
    }
}

#[test]
fn a_page_that_was_open_once_works_without_a_connection() {
    let visit = Visit::run("offline");
    assert!(visit.number("/offline/pictures") > 0.0);
    assert_eq!(visit.seen["module_by_worker"], false);
    assert_eq!(visit.seen["uninstallable"], serde_json::json!([]));
    visit.assert_legible("/texts");
    let files = fs::read_dir(std::env::var_os("MANDELIGHT_DIST").unwrap()).unwrap().count();
    // The worker and the list of headers are no files of the page, and a folder of scripts counts as one.
    assert!(visit.number("/kept/files") as usize >= files - 2, "{}", visit.seen["kept"]);
    assert!(visit.text("/licenses").starts_with("Third-party licences of Mandelight"));
    assert_eq!(visit.text("/other"), "Mandelight");
    assert_eq!(
        visit.seen["by_keys"],
        serde_json::json!(["update-now", "mandelight", "update-later", "mandelight"])
    );
    for what in ["offered", "put_off", "reloaded", "renewed", "second"] {
        assert_eq!(visit.seen[what], true, "{what}");
    }
    // The version before stays for tabs that show it; one that was put off does not.
    let [kept, purged] =
        ["kept", "purged"].map(|when| visit.seen[when]["names"].as_array().unwrap());
    assert_eq!((kept.len(), purged.len()), (1, 2), "{purged:?}");
    assert_eq!(purged[0], kept[0]);
    assert!(purged[1].as_str().unwrap().ends_with("-third"), "{purged:?}");
}

#[test]
fn a_phone_shows_the_picture_and_fingers_move_it() {
    let visit = Visit::run("phone");
    only_changes(&visit, "opened", "turned", &["camera"]);
    only_changes(&visit, "turned", "pinched", &["camera"]);
    let eye_to_pivot = |name: &str| visit.scene(name).camera.view_unit();
    assert!(eye_to_pivot("pinched") < eye_to_pivot("turned"), "spreading two fingers goes nearer");
    only_changes(&visit, "opened", "tapped", &["camera"]);
    let [opened, tapped, clicked] = ["opened", "tapped", "clicked"].map(|name| visit.scene(name));
    let distance = |a: &Scene, b: &Scene| (&a.camera.position - &b.camera.position).length();
    let flown = distance(&tapped, &opened);
    assert!(flown > 0.1 * opened.camera.view_unit(), "a double tap flies to the point: {flown}");
    let apart = distance(&tapped, &clicked);
    assert!(apart < 0.02 * flown, "a double tap ends {apart} from where a double click does");
    assert_eq!(visit.seen["scrolled"], serde_json::json!([0, 0, 1]), "the page itself moved");
}

/// What a screen reader reads, reaches and presses, in the browser's own accessibility tree.
#[test]
fn a_screen_reader_opens_a_scene_changes_the_power_and_saves() {
    let visit = Visit::run("screen_reader");
    let tree = visit.seen["tree"].as_array().unwrap();
    let is_used = |role: &str| ["button", "slider", "checkbox", "textbox"].contains(&role);
    let controls: Vec<&Value> =
        tree.iter().filter(|node| is_used(node["role"].as_str().unwrap_or_default())).collect();
    assert!(controls.len() > 20, "{controls:#?}");
    let nameless: Vec<_> = controls
        .iter()
        .filter(|node| node["name"].as_str().unwrap_or_default().is_empty())
        .collect();
    assert!(nameless.is_empty(), "{nameless:#?}");

    only_changes(&visit, "opened", "powered", &["fractal", "camera"]);
    assert_eq!(visit.scene("powered").fractal.number("power"), Some(5.0));
    assert_eq!(visit.text("/after_tab"), "Power 2");
    let stepped = visit.scene("stepped").fractal.number("power");
    assert!(stepped.is_some_and(|power| power > 5.0 && power < 6.0), "{stepped:?}");
    let chosen = visit.scene("chosen");
    let reef = (presets::opening_scenes()[1].scene)();
    assert_eq!(chosen.fractal, reef.fractal);
    assert!(visit.text("/saved").ends_with(".png"));
}

/// Two GPUs round differently, and the page fills its lattice by and by, so that rays go in other
/// cones: those that graze the surface end elsewhere. A few pixels may differ much, all others by no
/// more than a step. Between SwiftShader and lavapipe the worst of the opening scenes has a mean of
/// 0.49 steps and 1.1 % notable pixels.
const MAX_MEAN_STEPS: f64 = 0.75;
const MAX_NOTABLE: f64 = 0.02;

#[test]
fn the_page_and_the_native_program_draw_the_same_pictures() {
    let scenes = folder_of("pixels-scenes");
    fs::create_dir_all(&scenes).unwrap();
    let files: Vec<PathBuf> = presets::opening_scenes()
        .iter()
        .map(|preset| {
            let mut scene = (preset.scene)();
            scene.quality.samples = 2;
            let name = preset.id();
            let file = scenes.join(format!("{name}.json"));
            fs::write(&file, document::to_json(&scene)).unwrap();
            file
        })
        .collect();
    let list = files.iter().map(|file| file.display().to_string()).collect::<Vec<_>>().join("\n");
    let visit = Visit::run_with("pixels", [("MANDELIGHT_SCENES", list)]);

    for file in files {
        let name = file.file_stem().unwrap().to_str().unwrap();
        let page = visit.pixels(name);
        let native = rendered_natively(&file, page.size_px, &visit.folder);
        assert!(native.contrast() > 5.0, "{name} is empty");
        let difference = page.difference(&native);
        println!("{name}: {difference:?}");
        assert!(difference.mean < MAX_MEAN_STEPS, "{name}: {difference:?}");
        assert!(difference.notable < MAX_NOTABLE, "{name}: {difference:?}");
    }
}

/// Number of generated formulas that the browser compiles.
const GENERATED: u64 = 60;

/// A pass that calls all that a formula's kernel has.
const CALLS_ALL: &str = "// uses: formula, types/frame_uniforms

@group(1) @binding(0) var<storage, read_write> results: array<vec4f>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) thread: vec3u) {
    read_frame();
    let fractal = frame.formula.fractal;
    let point = vec3f(thread) * 0.01;
    let colors = orbit_colors(fractal, point);
    let seen = quick_estimate(fractal, point, vec3f(0.0, 0.0, 1.0));
    let careful = careful_estimate(fractal, point, vec3f(0.0, 0.0, 1.0));
    results[thread.x] = vec4f(distance_gradient(fractal, point), distance_estimate(fractal, point))
        + vec4f(colors.traps, colors.smooth_iterations, colors.channel)
        + vec4f(seen.step, seen.distance, careful.step, careful.distance);
}
";

#[test]
fn the_browser_compiles_what_the_checker_accepts() {
    let folder = folder_of("formulas-shaders");
    fs::create_dir_all(&folder).unwrap();
    let write = |name: &str, fractal: Fractal| {
        let kernel = Inputs::new(&Scene { fractal, ..Scene::default() }, Region::whole([64, 64]))
            .formula
            .kernel;
        let module = shaders::joined("formula", Some(kernel), CALLS_ALL);
        fs::write(folder.join(format!("{name}.wgsl")), module.text()).unwrap();
    };
    for formula in formula::all() {
        write(formula.id(), Fractal::new(formula));
    }
    for preset in presets::mixes() {
        write(&preset.id(), (preset.scene)().fractal);
    }
    for seed in 0..GENERATED {
        let text = Expressions::new(seed).formula();
        let formula =
            formula::own::of_text(&text).unwrap_or_else(|error| panic!("{text}: {error}"));
        write(&format!("generated-{seed}"), Fractal::new(formula));
    }
    // One that no compiler accepts, so that the test can fail.
    fs::write(folder.join("wrong.wgsl"), "fn f() -> u32 { return 1.5; }").unwrap();

    let visit = Visit::run_with("formulas", [("MANDELIGHT_SHADERS", folder.as_os_str())]);
    let compiled = visit.seen["compiled"].as_object().unwrap();
    assert_eq!(compiled.len(), fs::read_dir(&folder).unwrap().count());
    for (file, complaint) in compiled {
        let complaint = complaint.as_str().unwrap();
        assert_eq!(complaint.is_empty(), file != "wrong.wgsl", "{file}: {complaint}");
    }
}

/// What `mandelight render` makes of a scene document.
fn rendered_natively(scene: &FilePath, [width, height]: [u32; 2], folder: &FilePath) -> Picture {
    let name = scene.file_stem().unwrap().to_str().unwrap();
    let png = folder.join(format!("{name}-native.png"));
    let output = Command::new(env!("CARGO_BIN_EXE_mandelight"))
        .arg("render")
        .arg(scene)
        .arg("-o")
        .arg(&png)
        .args(["--size", &format!("{width}x{height}")])
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    Picture::read_png(&png)
}

/// Holds that nothing but `parts` of the scene differs from one observation to the next.
fn only_changes(visit: &Visit, before: &str, after: &str, parts: &[&str]) {
    let part_of = |name: &str| -> Value {
        let json = visit.text(&format!("/scenes/{name}"));
        serde_json::from_str::<Value>(json).unwrap()["scene"].take()
    };
    let (before_parts, after_parts) = (part_of(before), part_of(after));
    for (part, value) in after_parts.as_object().unwrap() {
        let changed = before_parts[part] != *value;
        assert_eq!(changed, parts.contains(&part.as_str()), "{part}, from {before} to {after}");
    }
}

#[test]
fn a_dive_by_the_wheel_goes_on_below_single_precision_and_comes_home() {
    let dive = presets::dives().iter().find(|dive| dive.name == "Dahlia").expect("a dive").scene;
    let fragment = link::to_fragment(&dive()).unwrap();
    let visit = Visit::run_with("dive", [("MANDELIGHT_LINK", fragment)]);

    let (zoom, deep) = (visit.number("/zoom"), visit.scene("deep"));
    assert!(zoom >= 4e12, "{zoom:e} after {} notches", visit.number("/notches"));
    assert!(deep.camera.view_unit() < 1e-12, "{:e}", deep.camera.view_unit());
    let beauty = visit.pixels("deep").beauty();
    println!("the picture at the end of the dive: {beauty}");
    assert!(beauty.is_good(), "{beauty}");

    let anchor_ms = visit.seen["anchor_ms"].as_array().unwrap();
    let searches = anchor_ms.iter().filter_map(Value::as_f64).filter(|&ms| ms > 0.0);
    assert!(searches.count() > 0, "no frame looked for an anchor");

    assert_eq!(visit.scene("linked"), dive());
    assert!(visit.number("/linked_zoom") > 1e19);
    assert!(visit.pixels("linked").contrast() > 5.0, "the linked picture is empty");
    assert_eq!(visit.scene("home").camera, presets::opening().camera);
}
