//! `cargo xtask test`, `cargo xtask test32`, `cargo xtask nightly` and `cargo xtask bless`.

use std::{
    env,
    process::Command,
    thread,
    time::{SystemTime, UNIX_EPOCH},
};

use anyhow::{Result, bail};

use crate::{check, deny, need, page, shell};

/// The environment variable with the seed of random numbers of tests.
const SEED_VARIABLE: &str = "MANDELIGHT_SEED";

/// The arguments of cargo for the package's tests.
const TESTS: [&str; 5] = ["test", "--lib", "--bins", "--tests", "--no-fail-fast"];

/// Runs all checks and tests to the end, and fails if any failed.
///
/// The package's tests run last, so that a successful run ends with the test runner's summary.
/// Environment variables name the built page (`MANDELIGHT_DIST`) and the browser
/// (`MANDELIGHT_CHROMIUM`) for the tests.
pub fn test() -> Result<()> {
    let tools = need::test_tools()?;
    let mut failures = Vec::new();
    let mut note = |result: Result<()>| {
        if let Err(error) = result {
            eprintln!("xtask: {error:#}");
            failures.push(format!("{error:#}"));
        }
    };

    // Linking the page takes minutes on one core: the checks and the compilation of the tests go on beside it.
    let dist = thread::scope(|scope| {
        let dist = scope.spawn(page::dist);
        note(check::check());
        note(deny::advisories_if_reachable());
        note(shell::cargo().and_then(|mut cargo| shell::run(cargo.args(TESTS).arg("--no-run"))));
        dist.join().unwrap_or_else(|_| bail!("the build of the page panicked"))
    });
    // If the build fails, the browser test must not run with an old page.
    let folder = dist.as_ref().ok().cloned();
    note(dist.map(drop));

    let runs: [&[&str]; 3] = [
        &["test", "--package", "xtask", "--no-fail-fast"],
        &["test", "--doc", "--no-fail-fast"],
        &TESTS,
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

/// Runs the tests of the readers with sizes of 32 bits, as the page has.
pub fn test32() -> Result<()> {
    shell::run(&mut readers_of_32_bits()?)
}

fn readers_of_32_bits() -> Result<Command> {
    need::target_of_32_bits()?;
    let mut cargo = shell::cargo()?;
    cargo.args(["test", "--package", "mandelight-fuzzing", "--target", need::TARGET_32_BITS]);
    cargo.arg("--no-fail-fast");
    Ok(cargo)
}

/// [`test32`] with other inputs each time, unless the environment has their seed.
fn test32_with_new_inputs() -> Result<()> {
    let mut cargo = readers_of_32_bits()?;
    if env::var_os(SEED_VARIABLE).is_none() {
        let seed = SystemTime::now().duration_since(UNIX_EPOCH)?.as_secs();
        eprintln!("xtask: fuzz inputs of {SEED_VARIABLE}={seed}");
        cargo.env(SEED_VARIABLE, seed.to_string());
    }
    shell::run(&mut cargo)
}

/// Runs the tests that take too long for each change. They print the seeds of their random numbers.
pub fn nightly() -> Result<()> {
    need::vulkan_driver()?;
    let mut failures = Vec::new();
    let runs: [&[&str]; 4] = [
        &["--release", "--test", "gpu", "random_views", "--", "--ignored", "--nocapture"],
        &["--release", "--test", "gpu", "hostile_scenes", "--", "--ignored", "--nocapture"],
        &["--release", "--test", "walk", "one_walk", "--", "--ignored", "--nocapture"],
        // Its limit is lower without debug assertions.
        &["--release", "--test", "walk", "memory", "--", "--nocapture"],
    ];
    for run in runs {
        let mut cargo = shell::cargo()?;
        cargo.arg("test").args(run);
        if let Err(error) = shell::run(&mut cargo) {
            failures.push(error.to_string());
        }
    }
    if !need::RUNS_32_BITS {
        eprintln!("xtask: no tests with sizes of 32 bits: this machine does not run them");
    } else if let Err(error) = test32_with_new_inputs() {
        failures.push(error.to_string());
    }
    if !failures.is_empty() {
        bail!("{}", failures.join("; "));
    }
    Ok(())
}

/// Replaces the golden pictures by current renders. A person must review the new pictures.
pub fn bless() -> Result<()> {
    need::vulkan_driver()?;
    let mut cargo = shell::cargo()?;
    cargo
        .args(["test", "--test", "gpu", "--no-fail-fast", "golden::"])
        .env("MANDELIGHT_BLESS", "1");
    shell::run(&mut cargo)
}
