//! `cargo xtask fuzz`: the coverage-guided fuzzer of a reader.

use std::fs;

use anyhow::{Context as _, Result, bail};

use crate::{need, shell};

/// Minutes, where the command line says none.
pub const MINUTES: u64 = 10;

/// Fuzzes the reader `target` for so many minutes, or until an input fails.
///
/// What the fuzzer finds stays in `fuzz/target/corpus`, inputs that fail in `fuzz/artifacts`.
pub fn fuzz(target: &str, minutes: u64) -> Result<()> {
    let folder = shell::root()?.join("fuzz");
    let kept = folder.join("corpus").join(target);
    if !kept.is_dir() {
        bail!("there is no target `{target}`: the folders of fuzz/corpus are named as the targets");
    }
    need::fuzzer()?;
    let found = folder.join("target/corpus").join(target);
    fs::create_dir_all(&found).with_context(|| found.display().to_string())?;
    let mut cargo = need::nightly_cargo();
    // The sanitizers watch unsafe code, and the program has none. `fuzz/Cargo.toml` has the checks of numbers.
    cargo.args(["fuzz", "run", "--release", "--sanitizer", "none", target]);
    cargo.args([&found, &kept]).current_dir(shell::root()?);
    let limits = ["-max_len=65536", "-timeout=20", "-rss_limit_mb=4096", "-malloc_limit_mb=1024"];
    cargo.arg("--").arg(format!("-max_total_time={}", 60 * minutes)).args(limits);
    shell::run(&mut cargo)
}
