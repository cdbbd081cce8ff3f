//! Which packages are compiled into the program.
//!
//! `cargo tree` knows the features and targets; `cargo metadata` knows where the packages' files are. Macros
//! and build scripts run while the program is built and are no part of it.

use std::collections::BTreeSet;

use anyhow::{Context as _, Result};
use cargo_metadata::{MetadataCommand, Package};

use crate::shell;

/// The targets of the program, equal to those of `deny.toml`.
const TARGETS: [&str; 4] = [
    "x86_64-unknown-linux-gnu",
    "x86_64-pc-windows-msvc",
    "aarch64-apple-darwin",
    "wasm32-unknown-unknown",
];

/// The program's own package.
const OWN: &str = "mandelight";

/// The packages of any target's program, sorted by name and version, without the program's own.
pub fn compiled() -> Result<Vec<Package>> {
    let mut names = BTreeSet::new();
    for target in TARGETS {
        let mut tree = shell::cargo()?;
        tree.args(["tree", "--locked", "--package", OWN, "--target", target, "--prefix", "none"]);
        tree.args(["--edges", "normal,no-proc-macro", "--format", "{p}"]);
        let tree = shell::output(&mut tree).context("`cargo tree` failed")?;
        names.extend(
            tree.lines().filter_map(name_and_version).map(|(name, v)| format!("{name} {v}")),
        );
    }
    let mut metadata = MetadataCommand::new();
    metadata.current_dir(shell::root()?).other_options(["--locked".to_owned()]);
    let all = metadata.exec().context("`cargo metadata` failed")?.packages;
    let mut packages: Vec<Package> = all
        .into_iter()
        .filter(|package| names.contains(&format!("{} {}", package.name, package.version)))
        .filter(|package| package.name != OWN)
        .collect();
    packages.sort_by(|a, b| (&*a.name, &a.version).cmp(&(&*b.name, &b.version)));
    Ok(packages)
}

/// The name and version in a line of `cargo tree`, such as `exr v1.74.2 (*)`.
fn name_and_version(line: &str) -> Option<(&str, &str)> {
    let (name, rest) = line.split_once(" v")?;
    Some((name, rest.split(' ').next()?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_of_the_tree_are_parsed() {
        assert_eq!(name_and_version("exr v1.74.2 (*)"), Some(("exr", "1.74.2")));
        assert_eq!(name_and_version("ash v0.38.0+1.3.281"), Some(("ash", "0.38.0+1.3.281")));
        assert_eq!(name_and_version(""), None);
    }

    #[test]
    fn the_targets_are_those_of_the_checks() {
        let deny = include_str!("../../../deny.toml");
        let list = deny.split_once("targets = [").unwrap().1.split_once(']').unwrap().0;
        let listed: Vec<_> =
            list.split(',').map(|target| target.trim().trim_matches('"')).collect();
        assert_eq!(listed, [&TARGETS[..], &[""]].concat());
    }

    #[test]
    fn all_targets_and_no_macros_are_in_the_list() {
        let names: BTreeSet<String> =
            compiled().unwrap().iter().map(|package| package.name.to_string()).collect();
        for needed in ["ash", "windows", "objc2-metal", "web-sys", "epaint_default_fonts", "clap"] {
            assert!(names.contains(needed), "{needed}");
        }
        for other in ["syn", "serde_derive", "proptest", "tiny_http", OWN] {
            assert!(!names.contains(other), "{other}");
        }
    }
}
