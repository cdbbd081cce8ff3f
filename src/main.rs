//! Mandelight's command line: the page's kernels without a page.
//!
//! The commands stand in a folder of their own, `command/`, which belongs to this binary
//! alone: the library knows no arguments, terminals or files.

#[cfg(not(target_arch = "wasm32"))]
mod command;

#[cfg(not(target_arch = "wasm32"))]
fn main() -> std::process::ExitCode {
    command::run()
}

#[cfg(target_arch = "wasm32")]
fn main() {}
