//! Shader modules: plain WGSL files, joined by the `uses` lines of their headers.
//!
//! A file's leading comment may hold lines such as `// uses: lib/camera, types/dispatch_params`. A module is one
//! file with all files that it uses, directly or indirectly, each file once. The joined text is plain WGSL:
//! tests parse and validate every module.

/// One WGSL file: its path without the extension, and its text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct File {
    /// For example `lib/lattice`.
    pub path: &'static str,
    /// The file's contents, embedded when the program is built.
    pub text: &'static str,
}

impl File {
    /// The names after `uses:` in the leading comment, in order.
    pub fn uses(&self) -> impl Iterator<Item = &'static str> + use<> {
        let header = self.text.lines().take_while(|line| line.starts_with("//"));
        header
            .filter_map(|line| line.strip_prefix("// uses: "))
            .flat_map(|names| names.split(',').map(str::trim))
    }
}

/// Appends `file` after all files that it uses, unless `met` holds it already.
fn join(
    file: File,
    find: &dyn Fn(&'static str) -> Option<Vec<File>>,
    met: &mut Vec<&'static str>,
    files: &mut Vec<File>,
) {
    if met.contains(&file.path) {
        return;
    }
    met.push(file.path);
    for name in file.uses() {
        let used = find(name).unwrap_or_else(|| panic!("{} uses {name}: no such file", file.path));
        for file in used {
            join(file, find, met, files);
        }
    }
    files.push(file);
}

/// A shader module: its files, in the order in which they are joined.
#[derive(Clone, Debug)]
pub struct Module {
    /// The pass that the module belongs to.
    pub label: &'static str,
    /// The module's files; a file may use declarations of later files.
    pub files: Vec<File>,
    /// Generated WGSL, appended after the files; may be empty.
    pub generated: String,
}

impl Module {
    /// Joins `root` with all files that it uses.
    ///
    /// `find` returns the files of a name in a header: one file, or several if the name stands for a choice.
    ///
    /// # Panics
    ///
    /// If `find` does not know a name in a header: a test joins every module of the program.
    pub fn new(
        label: &'static str,
        root: File,
        find: &dyn Fn(&'static str) -> Option<Vec<File>>,
    ) -> Self {
        let mut files = Vec::new();
        join(root, find, &mut Vec::new(), &mut files);
        Self { label, files, generated: String::new() }
    }

    /// The path and the text of each file, then of the generated text, called `generated`.
    pub fn parts(&self) -> impl Iterator<Item = (&str, &str)> {
        let files = self.files.iter().map(|file| (file.path, file.text));
        files.chain([("generated", &*self.generated)]).filter(|(_, text)| !text.is_empty())
    }

    /// The joined text, each part headed by its path.
    pub fn text(&self) -> String {
        self.parts().map(|(path, text)| format!("// {path}.wgsl\n{text}\n")).collect()
    }

    /// Creates the module on a device.
    pub fn create(&self, device: &wgpu::Device) -> wgpu::ShaderModule {
        device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(self.label),
            source: wgpu::ShaderSource::Wgsl(self.text().into()),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_module_holds_each_file_once_and_takes_cycles() {
        let a = File { path: "a", text: "// What a does.\n// uses: b, c\n// uses: d\nfn a() {}" };
        let b = File { path: "b", text: "// uses: c\nfn b() {}\n// uses: nothing" };
        let c = File { path: "c", text: "fn c() {}" };
        let d = File { path: "d", text: "// uses: a\nfn d() {}" };
        let find = |name: &'static str| [a, b, c, d].into_iter().find(|f| f.path == name);
        let module = Module::new("a", a, &|name| find(name).map(|file| vec![file]));
        let paths: Vec<_> = module.files.iter().map(|file| file.path).collect();
        assert_eq!(paths, ["c", "b", "d", "a"]);
        assert!(module.text().starts_with("// c.wgsl\nfn c() {}\n"));
    }
}
