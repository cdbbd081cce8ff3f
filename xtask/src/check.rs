//! `cargo xtask check`: formatting and lints, warnings denied.

use anyhow::{Result, bail};

use crate::{need, shell};

/// Checks the formatting of every crate, and runs clippy natively and for wasm32.
///
/// All checks run even after a failure, so that one call shows every problem.
pub fn check() -> Result<()> {
    need::wasm_target()?;
    let passes: [&[&str]; 3] = [
        &["fmt", "--all", "--check"],
        &["clippy", "--workspace", "--all-targets", "--", "-D", "warnings"],
        &["clippy", "--lib", "--target", need::WASM_TARGET, "--", "-D", "warnings"],
    ];
    let mut failures = Vec::new();
    for pass in passes {
        if let Err(error) = shell::run(shell::cargo()?.args(pass)) {
            failures.push(error.to_string());
        }
    }
    if !failures.is_empty() {
        bail!("{}", failures.join("; "));
    }
    Ok(())
}
