//! The architecture's arrows: which part of `src/` may name which, where the target's cfgs may
//! stand, that every module says what it is for, and that no file outgrows a sitting.

use std::{
    fmt::Write,
    fs,
    path::{Path, PathBuf},
};

/// Longest file, in lines.
const MAX_LINES: usize = 500;

/// What each part may name: of this crate, a path's beginning; of others, the crate.
struct Layer {
    name: &'static str,
    own_crate: &'static [&'static str],
    /// Platform and interface crates, of [`GUARDED_CRATES`], that it may name.
    crates: &'static [&'static str],
}

/// Crates that tie a part to a GPU, an interface or a browser.
const GUARDED_CRATES: &[&str] = &[
    "wgpu",
    "egui",
    "eframe",
    "egui_wgpu",
    "web_sys",
    "js_sys",
    "wasm_bindgen",
    "wasm_bindgen_futures",
];

/// The drawing in `src/lib.rs` as a table. What a part may name it may name through others too:
/// `render` stands above `fractal` and `gpu`, `fractal` above `scene`, `scene` above `formula`.
const LAYERS: &[Layer] = &[
    Layer { name: "precise", own_crate: &[], crates: &[] },
    Layer { name: "reading", own_crate: &[], crates: &[] },
    Layer { name: "gpu", own_crate: &[], crates: &["wgpu"] },
    // A formula has its shader files, and the layout of what they read, from `gpu`: no device.
    Layer {
        name: "formula",
        own_crate: &["precise", "reading", "gpu::shader", "gpu::host_shared"],
        crates: &[],
    },
    Layer { name: "scene", own_crate: &["precise", "reading", "formula"], crates: &[] },
    Layer { name: "fractal", own_crate: &["formula", "scene"], crates: &[] },
    Layer { name: "render", own_crate: &["formula", "scene", "fractal", "gpu"], crates: &["wgpu"] },
    Layer {
        name: "export",
        own_crate: &["reading", "formula", "scene", "fractal", "gpu", "render"],
        crates: &["wgpu"],
    },
    Layer {
        name: "ui",
        own_crate: &["formula", "scene", "fractal", "render::report"],
        crates: &["egui"],
    },
];

/// The parts that may name everything: the page, the binary with its commands, the crate's root.
const TOP: &[&str] = &["web", "main", "command", "lib"];

/// Everything at the library's root.
const PARTS: &[&str] =
    &["precise", "reading", "formula", "scene", "fractal", "gpu", "render", "export", "ui", "web"];

/// Where code may ask what it is compiled for.
const CFG_PLACES: &[&str] = &["web/", "web.rs", "main.rs", "lib.rs", "gpu/device.rs"];

/// Words by which code asks what it is compiled for.
const CFG_WORDS: &[&str] = &[
    "target_arch",
    "target_os",
    "target_family",
    "target_env",
    "target_vendor",
    "target_abi",
    "target_pointer_width",
    "target_endian",
    "target_feature",
    "unix",
    "windows",
];

/// A word or a sign of Rust source.
#[derive(Clone, Debug, PartialEq)]
pub enum Token {
    Word(String),
    Sign(char),
}

/// The words and signs of `source` without comments, literals and white space.
pub fn tokens(source: &str) -> Vec<Token> {
    let chars: Vec<char> = source.chars().collect();
    let at = |i: usize| chars.get(i).copied().unwrap_or('\0');
    let (mut found, mut i) = (Vec::new(), 0);
    while i < chars.len() {
        match chars[i] {
            '/' if at(i + 1) == '/' => {
                while i < chars.len() && chars[i] != '\n' {
                    i += 1;
                }
            }
            '/' if at(i + 1) == '*' => i = after_block_comment(&chars, i),
            '"' => i = after_string(&chars, i),
            // A character, unless it is a lifetime.
            '\'' if at(i + 1) == '\\' => {
                i += 3;
                while i < chars.len() && chars[i] != '\'' {
                    i += 1;
                }
                i += 1;
            }
            '\'' if at(i + 2) == '\'' => i += 3,
            c if c == '_' || c.is_alphanumeric() => {
                let start = i;
                while at(i) == '_' || at(i).is_alphanumeric() {
                    i += 1;
                }
                let word: String = chars[start..i].iter().collect();
                if matches!(word.as_str(), "r" | "br" | "cr")
                    && matches!(at(i), '"' | '#')
                    && raw_hashes(&chars, i).is_some()
                {
                    i = after_raw_string(&chars, i);
                } else {
                    found.push(Token::Word(word));
                }
            }
            c => {
                if !c.is_whitespace() {
                    found.push(Token::Sign(c));
                }
                i += 1;
            }
        }
    }
    found
}

fn after_block_comment(chars: &[char], start: usize) -> usize {
    let (mut depth, mut i) = (0, start);
    while i + 1 < chars.len() {
        match (chars[i], chars[i + 1]) {
            ('/', '*') => depth += 1,
            ('*', '/') => depth -= 1,
            _ => {
                i += 1;
                continue;
            }
        }
        i += 2;
        if depth == 0 {
            return i;
        }
    }
    chars.len()
}

fn after_string(chars: &[char], start: usize) -> usize {
    let mut i = start + 1;
    while i < chars.len() && chars[i] != '"' {
        i += if chars[i] == '\\' { 2 } else { 1 };
    }
    i + 1
}

/// How many `#` stand at `start` before a quote; none where there is no quote.
fn raw_hashes(chars: &[char], start: usize) -> Option<usize> {
    let hashes = chars[start..].iter().take_while(|&&c| c == '#').count();
    (chars.get(start + hashes) == Some(&'"')).then_some(hashes)
}

fn after_raw_string(chars: &[char], start: usize) -> usize {
    let hashes = raw_hashes(chars, start).unwrap_or(0);
    let mut i = start + hashes + 1;
    while i < chars.len() {
        let closing = chars[i + 1..].iter().take(hashes).filter(|&&c| c == '#').count();
        i += 1;
        if chars[i - 1] == '"' && closing == hashes {
            return i + hashes;
        }
    }
    i
}

/// The paths from the crate's root in `tokens`, `use` trees unfolded: `render::report::Report`.
/// `depth` is how many modules deep the file lies, so that a row of `super` is known to reach
/// the root.
fn paths_from_root(tokens: &[Token], depth: usize) -> Vec<String> {
    let word = |i: usize| match tokens.get(i) {
        Some(Token::Word(word)) => word.as_str(),
        _ => "",
    };
    let mut found = Vec::new();
    let mut i = 0;
    while i < tokens.len() {
        let start = i;
        match word(i) {
            "crate" | "mandelight" if is_colons(tokens, i + 1) => {
                read_tree(tokens, i + 3, "", &mut found)
            }
            "super" if start == 0 || !is_colons(tokens, start.saturating_sub(2)) => {
                let mut supers = 0;
                while word(i) == "super" && is_colons(tokens, i + 1) {
                    supers += 1;
                    i += 3;
                }
                let mut above = Vec::new();
                read_tree(tokens, i, "", &mut above);
                // Inside an inline module one more `super` is needed; a name that is no part
                // of the crate is then a sibling's.
                above.retain(|path| PARTS.contains(&first_two(path).0));
                if supers >= depth {
                    found.extend(above);
                }
            }
            _ => {}
        }
        i = i.max(start + 1);
    }
    found
}

fn is_colons(tokens: &[Token], i: usize) -> bool {
    tokens.get(i..i + 2) == Some(&[Token::Sign(':'), Token::Sign(':')])
}

/// Reads the path or `use` tree at `i`; returns nothing, adds each path behind `prefix`.
fn read_tree(tokens: &[Token], i: usize, prefix: &str, found: &mut Vec<String>) {
    match tokens.get(i) {
        Some(Token::Word(word)) => {
            let path = if prefix.is_empty() { word.clone() } else { format!("{prefix}::{word}") };
            if is_colons(tokens, i + 1) {
                read_tree(tokens, i + 3, &path, found)
            } else {
                found.push(path)
            }
        }
        Some(Token::Sign('*')) => found.push(format!("{prefix}::*")),
        Some(Token::Sign('{')) => {
            let (mut depth, mut starts) = (0, true);
            for (k, token) in tokens.iter().enumerate().skip(i) {
                match token {
                    Token::Sign('{') => depth += 1,
                    Token::Sign('}') => depth -= 1,
                    _ => {}
                }
                if depth == 0 {
                    break;
                }
                if starts && depth == 1 && *token != Token::Sign('{') {
                    read_tree(tokens, k, prefix, found);
                    starts = false;
                }
                starts |= depth == 1 && matches!(token, Token::Sign(',' | '{'));
            }
        }
        _ => {}
    }
}

fn first_two(path: &str) -> (&str, &str) {
    let mut words = path.split("::");
    (words.next().unwrap_or(""), words.next().unwrap_or(""))
}

/// Whether `word` stands within the brackets of a `cfg(…)`, `cfg!(…)` or `cfg_attr(…)`.
fn is_asked_for(tokens: &[Token], word: &str) -> bool {
    let (mut inside, mut depth) = (false, 0);
    tokens.iter().any(|token| {
        match token {
            Token::Word(name) if depth == 0 => inside = name == "cfg" || name == "cfg_attr",
            Token::Sign('(') if inside => depth += 1,
            Token::Sign(')') if inside => depth -= 1,
            Token::Sign('!') => {}
            _ if depth == 0 => inside = false,
            _ => {}
        }
        depth > 0 && matches!(token, Token::Word(name) if name == word)
    })
}

/// What is wrong with the file at `path` (below `src/`), a line each.
fn faults(path: &str, source: &str) -> Vec<String> {
    let tokens = tokens(source);
    let mut faults = Vec::new();
    let mut fault = |text: String| faults.push(format!("src/{path}: {text}"));
    if !source.starts_with("//!") {
        fault("begins without //! to say what it is for".into());
    }
    if !CFG_PLACES.iter().any(|place| path.starts_with(place)) {
        for word in CFG_WORDS.iter().filter(|word| is_asked_for(&tokens, word)) {
            fault(format!("asks for {word}; only {CFG_PLACES:?} may"));
        }
    }
    let part = path.split(['/', '.']).next().unwrap_or("");
    let Some(layer) = LAYERS.iter().find(|layer| layer.name == part) else {
        if !TOP.contains(&part) {
            fault(format!("{part} is no part of the architecture"));
        }
        return faults;
    };
    let depth = path.trim_end_matches(".rs").trim_end_matches("/mod").split('/').count();
    for used in paths_from_root(&tokens, depth) {
        let (first, second) = first_two(&used);
        let pair = format!("{first}::{second}");
        let allowed = layer.own_crate.iter().any(|&allowed| allowed == first || allowed == pair);
        if first != part && !allowed {
            fault(format!("{part} may not name crate::{used}"));
        }
    }
    for name in GUARDED_CRATES.iter().filter(|name| !layer.crates.contains(name)) {
        let word = Token::Word((*name).into());
        if (0..tokens.len()).any(|i| tokens[i] == word && is_colons(&tokens, i + 1)) {
            fault(format!("{part} may not name {name}"));
        }
    }
    faults
}

/// Every file below `root/folder`.
pub fn files(root: &Path, folder: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut folders = vec![root.join(folder)];
    while let Some(folder) = folders.pop() {
        for entry in
            fs::read_dir(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()))
        {
            let path = entry.unwrap().path();
            if path.is_dir() { folders.push(path) } else { found.push(path) }
        }
    }
    found.sort();
    found
}

pub fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

#[test]
fn every_arrow_points_down() {
    let src = root().join("src");
    let sources: Vec<_> = files(root(), "src")
        .into_iter()
        .filter(|path| path.extension().is_some_and(|e| e == "rs"))
        .collect();
    assert!(sources.len() > 20, "only {} files in src/", sources.len());
    let mut report = String::new();
    for path in &sources {
        let below_src = path.strip_prefix(&src).unwrap().to_str().unwrap().replace('\\', "/");
        for fault in faults(&below_src, &fs::read_to_string(path).unwrap()) {
            writeln!(report, "{fault}").unwrap();
        }
    }
    assert!(report.is_empty(), "\n{report}");
}

#[test]
fn no_file_is_over_500_lines() {
    let mut report = String::new();
    for folder in ["src", "shaders", "xtask/src", "tests"] {
        for path in files(root(), folder) {
            // What is no text has no lines.
            let Ok(text) = fs::read_to_string(&path) else { continue };
            let lines = text.lines().count();
            let is_code = path
                .extension()
                .is_some_and(|e| ["rs", "wgsl", "js", "mjs", "py", "sh"].iter().any(|c| e == *c));
            if is_code && lines > MAX_LINES {
                writeln!(report, "{}: {lines} lines", path.strip_prefix(root()).unwrap().display())
                    .unwrap();
            }
        }
    }
    assert!(report.is_empty(), "\n{report}");
}

/// The faults of a file that is fine apart from `body`.
fn faults_of(path: &str, body: &str) -> Vec<String> {
    faults(path, &format!("//! A module.\n{body}\n"))
}

#[test]
fn the_checker_finds_forbidden_names() {
    for (path, body) in [
        ("scene/camera.rs", "use crate::render::Report;"),
        ("scene/camera.rs", "fn f() { crate::fractal::march() }"),
        ("scene/camera.rs", "use super::super::gpu::Gpu;"),
        ("scene.rs", "use super::gpu::Gpu;"),
        ("scene/mod.rs", "use super::{gpu::Gpu};"),
        ("scene/camera.rs", "pub(in crate::ui) fn f() {}"),
        ("scene/camera.rs", "use wgpu::Device;"),
        ("fractal/march.rs", "use crate::{scene::Scene, gpu::Gpu};"),
        ("fractal/march.rs", "use {crate::{scene::{Scene, Camera}, ui}};"),
        ("gpu/device.rs", "use crate::scene::Scene;"),
        ("render/frame.rs", "use crate::export::png;"),
        ("render/frame.rs", "fn f(ui: &mut egui::Ui) {}"),
        ("export/still.rs", "use crate::ui::Action;"),
        ("ui/lights.rs", "use crate::render::View;"),
        ("ui/lights.rs", "use crate::render;"),
        ("ui/lights.rs", "use crate::render::*;"),
        ("ui/lights.rs", "use crate::render::{report::Report, View};"),
        ("ui/panel/lights.rs", "use super::super::super::render::View;"),
        ("ui/lights.rs", "let text = r#\"a \" b\"#; crate::gpu::now();"),
        ("ui/lights.rs", "let c = '\"'; crate::gpu::now(); let d = '\"';"),
        ("ui/lights.rs", "web_sys::window();"),
        ("ui/lights.rs", "#[cfg(target_arch = \"wasm32\")] fn f() {}"),
        ("render/frame.rs", "if cfg!(windows) {}"),
        ("render/frame.rs", "#[cfg(all(test, not(unix)))] fn f() {}"),
        ("helpers/text.rs", ""),
    ] {
        assert_eq!(faults_of(path, body).len(), 1, "{path}: {body}: {:?}", faults_of(path, body));
    }
    assert_eq!(faults("scene/camera.rs", "use glam::Vec3;\n").len(), 1);
}

#[test]
fn the_checker_leaves_allowed_names_alone() {
    for (path, body) in [
        ("scene/camera.rs", "use super::param; use crate::scene::Scene; use glam::DVec3;"),
        (
            "scene/camera.rs",
            "// use crate::gpu::Gpu;\n/* crate::ui::x /* nested */ crate::gpu::y */",
        ),
        ("scene/camera.rs", "let text = \"crate::gpu::Gpu \\\" wgpu::Device\";"),
        ("scene/camera.rs", "let text = r#\"crate::gpu::Gpu \" wgpu::Device\"#;"),
        (
            "scene/camera.rs",
            "mod tests { use super::super::{light::Lights, Scene}; use super::*; }",
        ),
        ("scene/light/ball.rs", "use super::super::render_angle;"),
        ("gpu/device.rs", "#[cfg(target_arch = \"wasm32\")] use wgpu::Limits;"),
        ("render/pass/march.rs", "use crate::{gpu::Gpu, scene::{Camera, Scene}, fractal};"),
        ("export/still.rs", "use crate::render::View; fn f(d: &wgpu::Device) {}"),
        (
            "ui/status.rs",
            "use crate::render::report::{Activity, Report}; use crate::{render::report, scene};",
        ),
        ("ui/status.rs", "fn f<'a>(x: &'a str) { x.split('\"'); egui::Id::new(1); }"),
        ("ui/status.rs", "#[cfg(test)] fn f() { for pair in bytes.windows(2) {} }"),
        (
            "web/mod.rs",
            "use crate::{export, gpu, ui}; #[cfg(target_arch = \"wasm32\")] use web_sys::Window;",
        ),
        ("main.rs", "use mandelight::{export::png, gpu::Gpu};"),
    ] {
        assert!(faults_of(path, body).is_empty(), "{path}: {body}: {:?}", faults_of(path, body));
    }
}
