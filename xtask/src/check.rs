//! `cargo xtask check`: formatting, lints, documentation and packages, warnings denied.

use anyhow::{Result, bail};

use crate::{deny, need, shell};

/// Checks the formatting of every crate, runs clippy natively, for wasm32 and on the fuzzer, builds the
/// documentation, and checks the packages by `deny.toml`.
///
/// All checks run even after a failure, so that one call shows every problem.
pub fn check() -> Result<()> {
    need::wasm_target()?;
    let passes: [&[&str]; 5] = [
        &["fmt", "--all", "--check"],
        &["fmt", "--manifest-path", "fuzz/Cargo.toml", "--check"],
        &["clippy", "--workspace", "--all-targets", "--", "-D", "warnings"],
        &["clippy", "--lib", "--target", need::WASM_TARGET, "--", "-D", "warnings"],
        &["doc", "--workspace", "--no-deps"],
    ];
    let mut failures = Vec::new();
    for pass in passes {
        let mut cargo = shell::cargo()?;
        // Only `cargo doc` reads this variable.
        cargo.args(pass).env("RUSTDOCFLAGS", "-D warnings");
        if let Err(error) = shell::run(&mut cargo) {
            failures.push(error.to_string());
        }
    }
    if let Err(error) = fuzzer() {
        failures.push(error.to_string());
    }
    if let Err(error) = deny::packages() {
        failures.push(error.to_string());
    }
    if !failures.is_empty() {
        bail!("{}", failures.join("; "));
    }
    Ok(())
}

/// Runs clippy on the fuzzer, which is a workspace of its own.
fn fuzzer() -> Result<()> {
    let mut cargo = shell::cargo()?;
    cargo.args([
        "clippy",
        "--locked",
        "--manifest-path",
        "fuzz/Cargo.toml",
        "--target-dir",
        "target",
    ]);
    // Nothing is linked, so any path will do: without one, libFuzzer is compiled, which needs a C++ compiler.
    cargo.env("CUSTOM_LIBFUZZER_PATH", shell::root()?.join("fuzz/Cargo.toml"));
    shell::run(cargo.args(["--", "-D", "warnings"]))
}
