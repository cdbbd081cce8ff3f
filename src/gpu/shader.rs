//! Shader modules: plain WGSL files joined in a stated order.
//!
//! A joined module is text that any WGSL tool reads, the list of its files is its
//! documentation, and no preprocessor travels in the wasm. A test parses and validates every
//! module that is declared here.

/// One WGSL file: its path below `shaders/` and its text.
#[derive(Clone, Copy, Debug)]
pub struct File {
    /// For example `lib/lattice.wgsl`.
    pub path: &'static str,
    /// The file's contents, taken in when the program is built.
    pub text: &'static str,
}

/// Takes in a file of `shaders/`.
#[macro_export]
macro_rules! shader_file {
    ($path:literal) => {
        $crate::gpu::shader::File {
            path: $path,
            text: include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/shaders/", $path)),
        }
    };
}

/// A shader module: files in the order in which they are joined.
#[derive(Clone, Copy, Debug)]
pub struct Module {
    /// The pass it serves.
    pub label: &'static str,
    /// Its files; declarations may be used before the file that makes them.
    pub files: &'static [File],
}

impl Module {
    /// The joined text, each file headed by its path.
    pub fn text(&self) -> String {
        self.files.iter().map(|file| format!("// {}\n{}\n", file.path, file.text)).collect()
    }

    /// Gives the module to a device.
    pub fn create(&self, device: &wgpu::Device) -> wgpu::ShaderModule {
        device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(self.label),
            source: wgpu::ShaderSource::Wgsl(self.text().into()),
        })
    }
}
