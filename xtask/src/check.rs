//! `cargo xtask check`: formatting, lints, documentation and packages, warnings denied.

use anyhow::{Result, bail};

use crate::{deny, need, shell};

/// Checks the formatting of every crate, runs clippy natively and for wasm32, builds the
/// documentation, and checks the packages by `deny.toml`.
///
/// All checks run even after a failure, so that one call shows every problem.
pub fn check() -> Result<()> {
    need::wasm_target()?;
    let passes: [&[&str]; 4] = [
        &["fmt", "--all", "--check"],
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
    if let Err(error) = deny::packages() {
        failures.push(error.to_string());
    }
    if !failures.is_empty() {
        bail!("{}", failures.join("; "));
    }
    Ok(())
}
