//! The WGSL files of `shaders/`, and the module of each pass.

use include_dir::{Dir, include_dir};

use crate::{
    formula::Kernel,
    gpu::shader::{File, Module},
};

static SHADERS: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/shaders");

/// The file at `path`, given without its extension, such as `lib/lattice`.
fn file(path: &'static str) -> Option<File> {
    let text = SHADERS.get_file(format!("{path}.wgsl"))?.contents_utf8()?;
    Some(File { path, text })
}

/// The module of `shaders/pass/<name>.wgsl`.
///
/// # Panics
///
/// If a file is missing: tests build the module of every pass.
pub fn module(name: &'static str, kernel: Option<Kernel>) -> Module {
    let path = format!("pass/{name}.wgsl");
    let text = SHADERS.get_file(&path).and_then(|file| file.contents_utf8());
    joined(name, kernel, text.unwrap_or_else(|| panic!("shaders/{path} is missing")))
}

/// A module whose last file is `text`, with all files that its header uses.
///
/// The names `formula` and `formula_types` mean the files of `kernel`.
///
/// # Panics
///
/// If the header names a missing file, or a formula without a kernel.
pub fn joined(label: &'static str, kernel: Option<Kernel>, text: &'static str) -> Module {
    let files = kernel.map(|kernel| kernel.files());
    Module::new(label, File { path: label, text }, &|used| match (used, &files) {
        ("formula", _) => Some(files.as_ref()?.files.clone()),
        ("formula_types", Some(files)) => Some(vec![files.types]),
        ("formula_types", None) => Some(vec![file("types/no_formula")?]),
        _ => Some(vec![file(used)?]),
    })
}
