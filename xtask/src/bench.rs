//! `cargo xtask bench`.

use anyhow::Result;

use crate::{need, shell};

/// Builds the benchmark and runs it with `options`, such as `--help`.
///
/// It uses the tests' profile and shares their build, because the measured work runs on the GPU.
/// `--release` selects the release profile: the build takes minutes, and start-up times are then
/// those of the released program.
pub fn bench(options: &[String]) -> Result<()> {
    need::vulkan_driver()?;
    let (release, options): (Vec<_>, Vec<_>) =
        options.iter().partition(|option| *option == "--release");
    let mut cargo = shell::cargo()?;
    cargo.args(["bench", "--quiet", "--bench", "speed"]);
    if release.is_empty() {
        cargo.args(["--profile", "dev"]);
    }
    shell::run(cargo.arg("--").args(options))
}
