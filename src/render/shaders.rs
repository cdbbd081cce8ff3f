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
    let root = File { path: label, text };
    let mut module = Module::new(label, root, &|used| match (used, &files) {
        ("formula", _) => Some(files.as_ref()?.files.clone()),
        ("formula_types", Some(files)) => Some(vec![files.types]),
        ("formula_types", None) => Some(vec![file("types/no_formula")?]),
        _ => Some(vec![file(used)?]),
    });
    module.generated = frame_declarations(&module);
    module
}

/// WGSL text that declares `frame` and `read_frame` for a module.
///
/// `frame` has those members of `FrameUniforms` that the module's files name. Empty without `types/frame_uniforms`.
fn frame_declarations(module: &Module) -> String {
    let Some(uniforms) = module.files.iter().find(|file| file.path == "types/frame_uniforms")
    else {
        return String::new();
    };
    let used: Vec<_> = module.files.iter().flat_map(|file| members_of_frame(file.text)).collect();
    let declarations = uniforms.text.lines().skip_while(|line| *line != "struct FrameUniforms {");
    let members: Vec<_> = declarations
        .take_while(|line| *line != "}")
        .filter_map(|line| line.trim().strip_suffix(',')?.split_once(": "))
        .filter(|(name, _)| used.contains(name))
        .collect();
    let text = |line: fn(&str, &str) -> String| {
        members.iter().map(|(name, ty)| line(name, ty)).collect::<String>()
    };
    format!(
        "struct Frame {{\n{}}}\nvar<private> frame: Frame;\nfn read_frame() {{\n{}}}\n",
        text(|name, ty| format!("    {name}: {ty},\n")),
        text(|name, _| format!("    frame.{name} = frame_uniforms.{name};\n")),
    )
}

/// The members of `frame` that `text` names outside of comments, with repetitions.
fn members_of_frame(text: &str) -> impl Iterator<Item = &str> {
    let is_part_of_name = |c: char| c == '_' || c.is_alphanumeric();
    let code = text.lines().filter_map(|line| line.split("//").next());
    code.flat_map(move |line| {
        line.match_indices("frame.").filter_map(move |(at, found)| {
            let (before, after) = (&line[..at], &line[at + found.len()..]);
            let is_whole = !before.ends_with(is_part_of_name);
            let end = after.find(|c| !is_part_of_name(c)).unwrap_or(after.len());
            is_whole.then_some(&after[..end])
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_module_copies_the_members_of_the_frame_that_its_files_name() {
        let text = "// uses: types/frame_uniforms
            fn f() -> f32 { return frame.tone.exposure + subframe.fog + frame.normals; } // frame.march";
        let generated = joined("probe", None, text).generated;
        let copies =
            ["frame.tone = frame_uniforms.tone;", "frame.normals = frame_uniforms.normals;"];
        let copied: Vec<_> =
            generated.lines().map(str::trim).filter(|line| line.starts_with("frame.")).collect();
        assert_eq!(copied, copies);
        assert!(joined("probe", None, "fn f() {}").generated.is_empty());
    }
}
