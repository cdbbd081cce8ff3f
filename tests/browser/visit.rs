//! Runs a script of this folder and reads its observations.
//!
//! In: a script's name. Out: its observations and files, which contain no error of the page.

use std::{
    ffi::OsStr,
    fs,
    path::{Path, PathBuf},
    process::Command,
    sync::{Mutex, PoisonError},
};

use mandelight::scene::{Scene, document};
use serde_json::Value;

use crate::picture::Picture;

/// One browser at a time: each browser draws on all cores.
static BROWSER: Mutex<()> = Mutex::new(());

/// The observations and files of a visit.
pub struct Visit {
    /// The folder of downloads, pictures and pixels.
    pub folder: PathBuf,
    /// The observations, as JSON.
    pub seen: Value,
}

impl Visit {
    /// Runs `tests/browser/<script>.mjs`; any error of the page fails the test.
    pub fn run(script: &str) -> Self {
        Self::run_with(script, [("MANDELIGHT_NOTHING", "")])
    }

    /// Runs a script with additional environment variables.
    pub fn run_with<V: AsRef<OsStr>>(
        script: &str,
        variables: impl IntoIterator<Item = (&'static str, V)>,
    ) -> Self {
        for name in ["MANDELIGHT_DIST", "MANDELIGHT_CHROMIUM"] {
            let is_set = std::env::var_os(name).is_some_and(|value| !value.is_empty());
            assert!(is_set, "{name} is not set: run the browser tests through `cargo xtask test`");
        }
        let _guard = BROWSER.lock().unwrap_or_else(PoisonError::into_inner);
        let top = Path::new(env!("CARGO_MANIFEST_DIR"));
        let folder = folder_of(script);
        if folder.exists() {
            fs::remove_dir_all(&folder).unwrap();
        }
        let status = Command::new("node")
            .arg(top.join(format!("tests/browser/{script}.mjs")))
            .env("MANDELIGHT_OUT", &folder)
            .envs(variables)
            .current_dir(top)
            .status()
            .expect("Node.js starts; `cargo xtask test` has checked that");
        assert!(status.success(), "the script {script}.mjs failed: {status}");

        let seen = fs::read(folder.join("observations.json")).unwrap();
        let visit = Self { folder, seen: serde_json::from_slice(&seen).unwrap() };
        let failure = visit.seen["failure"].as_str();
        let errors = visit.seen["errors"].as_array().unwrap();
        let shown = visit.folder.display();
        assert_eq!(failure, None, "see {shown}; errors of the page: {errors:#?}");
        assert!(errors.is_empty(), "errors of the page (see {shown}): {errors:#?}");
        println!("{script}: {:#}", visit.seen["secs"]);
        visit
    }

    /// The observed text at a JSON pointer: `text("/notice/detail")`.
    pub fn text(&self, pointer: &str) -> &str {
        let found = self.seen.pointer(pointer).and_then(Value::as_str);
        found.unwrap_or_else(|| panic!("the visit observed no {pointer}"))
    }

    /// The observed number at a JSON pointer.
    pub fn number(&self, pointer: &str) -> f64 {
        let found = self.seen.pointer(pointer).and_then(Value::as_f64);
        found.unwrap_or_else(|| panic!("the visit observed no {pointer}"))
    }

    /// Checks the observed texts of the page's own document at a JSON pointer: large enough, in contrast to what is
    /// behind them, and buttons of a finger's size.
    pub fn assert_legible(&self, pointer: &str) {
        let texts = self.seen.pointer(pointer).and_then(Value::as_array);
        let texts = texts.unwrap_or_else(|| panic!("the visit observed no {pointer}"));
        assert!(texts.len() > 1, "{texts:?}");
        assert!(texts.iter().any(|text| text["isButton"] == true), "{texts:?}");
        for text in texts {
            let number = |name: &str| text[name].as_f64().unwrap_or_default();
            assert!(number("fontPx") >= 12.0, "{text}");
            assert!(number("contrast") >= 4.5, "{text}");
            if text["isButton"] == true {
                assert!(number("width") >= 44.0 && number("height") >= 44.0, "{text}");
            }
        }
    }

    /// The observed scene of this name.
    pub fn scene(&self, name: &str) -> Scene {
        let json = self.text(&format!("/scenes/{name}"));
        document::from_json(json).unwrap_or_else(|error| panic!("the scene {name}: {error}"))
    }

    /// The pixels that the script kept under this name.
    pub fn pixels(&self, name: &str) -> Picture {
        let side = |side: &str| self.number(&format!("/pixels/{name}/{side}")) as u32;
        let rgba = fs::read(self.folder.join(format!("{name}.rgba"))).unwrap();
        Picture::new([side("width"), side("height")], rgba)
    }
}

/// The folder of a script's observations and files.
pub fn folder_of(script: &str) -> PathBuf {
    let target = Path::new(env!("CARGO_TARGET_TMPDIR")).parent().unwrap();
    target.join("browser").join(script)
}
