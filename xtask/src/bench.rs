//! `cargo xtask bench`.

use anyhow::Result;

use crate::{need, shell};

/// Builds the benchmark and runs it with `options`; `--help` among them tells what there is.
///
/// It is built as the tests are, which shares all that they have built: the GPU does the work that
/// is measured. With `--release` among the options it is built as the program is released, which
/// takes minutes: start-up times are then those that people see.
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
