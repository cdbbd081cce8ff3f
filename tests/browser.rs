//! The built page in a real browser: what the scripts in `tests/browser/` saw there, judged.
//!
//! `cargo xtask test` builds the page, makes sure of the browser and says where both are. What each
//! visit leaves (observations, downloads, screenshots to look at) is in `target/browser/`.

use std::{
    fs,
    path::{Path, PathBuf},
    process::Command,
    sync::{Mutex, PoisonError},
};

use serde_json::Value;

/// One browser at a time: each of them draws on all cores.
static BROWSER: Mutex<()> = Mutex::new(());

/// What a visit left.
struct Visit {
    folder: PathBuf,
    seen: Value,
}

impl Visit {
    /// Runs `tests/browser/<script>.mjs`; any error of the page fails the test.
    fn run(script: &str) -> Self {
        for name in ["MANDELIGHT_DIST", "MANDELIGHT_CHROMIUM"] {
            let is_set = std::env::var_os(name).is_some_and(|value| !value.is_empty());
            assert!(is_set, "{name} is not set: the browser tests are run by `cargo xtask test`");
        }
        let _alone = BROWSER.lock().unwrap_or_else(PoisonError::into_inner);
        let top = Path::new(env!("CARGO_MANIFEST_DIR"));
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("../browser").join(script);
        if folder.exists() {
            fs::remove_dir_all(&folder).unwrap();
        }
        let status = Command::new("node")
            .arg(top.join(format!("tests/browser/{script}.mjs")))
            .env("MANDELIGHT_OUT", &folder)
            .current_dir(top)
            .status()
            .expect("Node.js runs: `cargo xtask test` makes sure of it");
        assert!(status.success(), "the script {script}.mjs broke down: {status}");

        let seen = fs::read(folder.join("observations.json")).unwrap();
        let visit = Self { folder, seen: serde_json::from_slice(&seen).unwrap() };
        let failure = visit.seen["failure"].as_str();
        let errors = visit.seen["errors"].as_array().unwrap();
        let shown = visit.folder.display();
        assert_eq!(failure, None, "see {shown}; errors of the page: {errors:#?}");
        assert!(errors.is_empty(), "errors of the page (see {shown}): {errors:#?}");
        visit
    }

    /// Text among the observations: `text("notice/detail")`.
    fn text(&self, path: &str) -> &str {
        let found = self.seen.pointer(&format!("/{path}")).and_then(Value::as_str);
        found.unwrap_or_else(|| panic!("the visit observed no {path}"))
    }
}

#[test]
fn a_page_that_cannot_draw_says_what_would_help() {
    let visit = Visit::run("unavailable");
    assert!(visit.text("without_webgpu/text").contains("no WebGPU"));
    assert!(visit.text("without_webgpu/detail").contains("Chrome"));
    assert!(visit.text("without_gpu/detail").contains("acceleration"));
    assert_eq!(visit.seen["again"], visit.seen["without_webgpu"]);

    let asked: Vec<&str> =
        visit.seen["asked"].as_array().unwrap().iter().filter_map(Value::as_str).collect();
    assert!(asked.iter().any(|name| name.starts_with("boot-")), "{asked:?}");
    assert!(!asked.iter().any(|name| name.ends_with(".wasm")), "the module was loaded: {asked:?}");
}
