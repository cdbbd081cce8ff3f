//! `cargo xtask bench`.

use anyhow::Result;

use crate::{need, shell};

/// Builds the benchmark and runs it with `options`; the option `--help` lists all options.
///
/// The benchmark has the tests' profile and shares their compiled crates, because it measures work
/// of the GPU. The option `--release` builds with the release profile, which takes minutes, and
/// gives the start-up times of a released program.
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
