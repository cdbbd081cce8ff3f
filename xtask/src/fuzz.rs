//! `cargo xtask fuzz`: the coverage-guided fuzzer of a reader.

use std::{fs, path::Path};

use anyhow::{Context as _, Result, bail};

use crate::{need, shell};

/// Minutes, where the command line says none.
pub const MINUTES: u64 = 10;

/// The name that stands for every target.
const ALL: &str = "all";

/// Fuzzes the reader `target` for so many minutes, or until an input fails; `all` in turn, each for an equal share.
///
/// What the fuzzer finds stays in `fuzz/target/corpus`, inputs that fail in `fuzz/artifacts`. After a target that
/// fails, the others follow.
pub fn fuzz(target: &str, minutes: u64) -> Result<()> {
    let folder = shell::root()?.join("fuzz");
    if target != ALL && !folder.join("corpus").join(target).is_dir() {
        bail!("there is no target `{target}`; choose one of the folders of fuzz/corpus, or {ALL}");
    }
    need::fuzzer()?;
    if target != ALL {
        return run(&folder, target, minutes.saturating_mul(60));
    }
    let targets = targets(&folder)?;
    let secs = share_secs(minutes, targets.len());
    let failed: Vec<_> = targets
        .into_iter()
        .filter_map(|target| {
            let error = run(&folder, &target, secs).err()?;
            Some(format!("{target}: {error:#}"))
        })
        .collect();
    if !failed.is_empty() {
        bail!("{}", failed.join("; "));
    }
    Ok(())
}

/// The names of all targets, sorted.
fn targets(folder: &Path) -> Result<Vec<String>> {
    let corpus = folder.join("corpus");
    let entries = fs::read_dir(&corpus).with_context(|| corpus.display().to_string())?;
    let mut names = entries
        .map(|entry| Ok(entry?.file_name().to_string_lossy().into_owned()))
        .collect::<Result<Vec<_>>>()?;
    names.sort();
    Ok(names)
}

/// A target's share of the time, in seconds. The fuzzer takes 0 for no end.
fn share_secs(minutes: u64, targets: usize) -> u64 {
    (minutes.saturating_mul(60) / targets.max(1) as u64).max(1)
}

/// Fuzzes a target for so many seconds.
fn run(folder: &Path, target: &str, secs: u64) -> Result<()> {
    let kept = folder.join("corpus").join(target);
    let found = folder.join("target/corpus").join(target);
    fs::create_dir_all(&found).with_context(|| found.display().to_string())?;
    let mut cargo = need::nightly_cargo();
    // The sanitizers watch unsafe code, and the program has none. `fuzz/Cargo.toml` has the checks of numbers.
    cargo.args(["fuzz", "run", "--release", "--sanitizer", "none", target]);
    cargo.args([&found, &kept]).current_dir(shell::root()?);
    let limits = ["-max_len=65536", "-timeout=20", "-rss_limit_mb=4096", "-malloc_limit_mb=1024"];
    cargo.arg("--").arg(format!("-max_total_time={secs}")).args(limits);
    shell::run(&mut cargo)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_targets_share_the_time() {
        assert_eq!(share_secs(11, 11), 60);
        assert_eq!(share_secs(0, 11), 1);
        let folder = shell::root().unwrap().join("fuzz");
        let names = targets(&folder).unwrap();
        assert!(names.contains(&"command_line".to_owned()) && !names.contains(&ALL.to_owned()));
    }

    /// Without an entry in Cargo.toml, a file of `fuzz_targets` is not compiled by name.
    #[test]
    fn each_target_has_its_entry_and_its_file() {
        let folder = shell::root().unwrap().join("fuzz");
        let manifest: toml::Table = include_str!("../../fuzz/Cargo.toml").parse().unwrap();
        let mut entries: Vec<_> = manifest["bin"]
            .as_array()
            .unwrap()
            .iter()
            .map(|bin| {
                let (name, path) = (bin["name"].as_str().unwrap(), bin["path"].as_str().unwrap());
                assert_eq!(path, format!("fuzz_targets/{name}.rs"));
                name.to_owned()
            })
            .collect();
        entries.sort();
        let files = fs::read_dir(folder.join("fuzz_targets")).unwrap();
        let mut files: Vec<_> = files
            .map(|file| file.unwrap().path().file_stem().unwrap().to_string_lossy().into_owned())
            .collect();
        files.sort();
        assert_eq!(entries, files);
        assert_eq!(targets(&folder).unwrap(), files);
    }
}
