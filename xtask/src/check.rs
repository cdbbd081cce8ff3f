//! `cargo xtask check`: formatting and lints, warnings denied.

use anyhow::{Result, bail};

use crate::{need, shell};

/// Formatting of every crate; clippy natively on every target, and on the library for wasm32.
/// All are run, so that one visit shows all there is to mend.
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
