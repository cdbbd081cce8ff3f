//! `cargo xtask test` and `cargo xtask bless`.

use anyhow::{Result, bail};

use crate::{check, need, page, shell};

/// Runs everything there is, to the end, and fails where anything failed.
///
/// The package's own tests come last, so that a good run ends on the test runner's closing line.
/// Tests learn from the environment where the built page (`MANDELIGHT_DIST`) and the browser
/// (`MANDELIGHT_CHROMIUM`) are.
pub fn test() -> Result<()> {
    let tools = need::test_tools()?;
    let mut failures = Vec::new();
    let mut note = |result: Result<()>| {
        if let Err(error) = result {
            eprintln!("xtask: {error:#}");
            failures.push(format!("{error:#}"));
        }
    };

    note(check::check());
    // A page that could not be built must not leave an old one for the browser test to pass on.
    let dist = page::dist();
    let folder = dist.as_ref().ok().cloned();
    note(dist.map(drop));

    let runs: [&[&str]; 3] = [
        &["test", "--package", "xtask", "--no-fail-fast"],
        &["test", "--doc", "--no-fail-fast"],
        &["test", "--lib", "--bins", "--tests", "--no-fail-fast"],
    ];
    for run in runs {
        let mut cargo = shell::cargo()?;
        cargo.args(run).env(need::BROWSER_VARIABLE, &tools.chromium).env_remove("MANDELIGHT_BLESS");
        match &folder {
            Some(folder) => cargo.env("MANDELIGHT_DIST", folder),
            None => cargo.env_remove("MANDELIGHT_DIST"),
        };
        note(shell::run(&mut cargo));
    }

    if !failures.is_empty() {
        bail!("failed:\n  {}", failures.join("\n  "));
    }
    Ok(())
}

/// Makes the golden pictures again. What they should look like is for a person to judge.
pub fn bless() -> Result<()> {
    need::vulkan_driver()?;
    let mut cargo = shell::cargo()?;
    cargo
        .args(["test", "--test", "gpu", "--no-fail-fast", "golden::"])
        .env("MANDELIGHT_BLESS", "1");
    shell::run(&mut cargo)
}
