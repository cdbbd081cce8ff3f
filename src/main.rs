//! Mandelight's command line: renders with the page's kernels, without a browser.
//!
//! The folder `command/` belongs to this binary only; the library does not depend on arguments,
//! terminals or files.

#[cfg(not(target_arch = "wasm32"))]
mod command;

#[cfg(not(target_arch = "wasm32"))]
fn main() -> std::process::ExitCode {
    command::run()
}

#[cfg(target_arch = "wasm32")]
fn main() {}
