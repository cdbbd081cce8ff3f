//! `cargo xtask notices`: the licences of everything that the program contains.
//!
//! In: `Cargo.lock`, `deny.toml` and the packages' own files. Out: `THIRD-PARTY-LICENSES.txt`, which the
//! page links and `mandelight --licenses` prints.
//!
//! | file | contents |
//! |---|---|
//! | [`item`] | one thing that the program contains |
//! | [`packages`] | which packages are compiled into the program |
//! | [`texts`] | the licences that are taken of a package, and their texts |
//! | [`others`] | what is no package of Cargo: Rust's own library, the muxer of videos |

mod item;
mod others;
mod packages;
mod texts;

use std::{collections::BTreeMap, fmt::Write as _, fs};

use anyhow::{Context as _, Result};

use self::item::Item;
use crate::shell;

/// The file, relative to the repository's top folder.
pub const FILE: &str = "THIRD-PARTY-LICENSES.txt";

const HEAD: &str = "\
Third-party licences of Mandelight
==================================

Mandelight itself is licensed under MIT or Apache-2.0, as you prefer. It contains the software and fonts
listed here: the packages compiled into the command line program (Linux, Windows, macOS) or into the page,
in one list, then what is no package. `cargo xtask notices` writes this file.

Of a package with a choice of licences, the one named after the arrow is taken. The numbers name the texts
below the list.
";

/// Writes the file anew.
pub fn write() -> Result<()> {
    let text = text()?;
    let file = shell::root()?.join(FILE);
    fs::write(&file, &text).with_context(|| file.display().to_string())?;
    eprintln!("{FILE}: {:.1} kB", text.len() as f64 / 1e3);
    Ok(())
}

/// The file's text, made of the packages as they are now.
fn text() -> Result<String> {
    let accepted = texts::accepted(&fs::read_to_string(shell::root()?.join("deny.toml"))?)?;
    let mut items = Vec::new();
    for package in packages::compiled()? {
        let about = || format!("{} {}", package.name, package.version);
        items.push(texts::item(&package, &accepted).with_context(about)?);
    }
    items.extend(others::items()?);
    Ok(listed(&items))
}

/// The list of all items, then each text once.
fn listed(items: &[Item]) -> String {
    let mut numbers: BTreeMap<String, usize> = BTreeMap::new();
    let mut texts: Vec<(&str, Vec<&str>)> = Vec::new();
    let mut list = HEAD.to_owned();
    for item in items {
        let mut shown = Vec::new();
        for text in &item.texts {
            // Copies of a licence differ in their line breaks and indents only.
            let words = text.split_whitespace().collect::<Vec<_>>().join(" ");
            let number = *numbers.entry(words).or_insert_with(|| {
                texts.push((text, Vec::new()));
                texts.len()
            });
            let names = &mut texts[number - 1].1;
            let number = format!("[{number}]");
            if !shown.contains(&number) {
                names.push(&item.name);
                shown.push(number);
            }
        }
        // Writing to a string cannot fail.
        let _ = write!(list, "\n{}: {}", item.name, item.license);
        let taken = item.taken.join(" AND ");
        if taken != item.license {
            let _ = write!(list, " -> {taken}");
        }
        let _ = write!(list, " {}", shown.join(" "));
        if let Some(note) = &item.note {
            let _ = write!(list, "\n    {note}");
        }
    }
    list.push('\n');
    for (number, (text, names)) in (1..).zip(&texts) {
        let _ = write!(list, "\n{}\n[{number}] {}\n\n", rule(), names.join(", "));
        for line in text.trim_matches('\n').lines() {
            let _ = writeln!(list, "{}", line.trim_end());
        }
    }
    list
}

/// The line between texts.
fn rule() -> String {
    "-".repeat(80)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn committed() -> String {
        fs::read_to_string(shell::root().unwrap().join(FILE)).unwrap()
    }

    #[test]
    fn the_file_is_that_of_the_packages() {
        assert!(text().unwrap() == committed(), "run `cargo xtask notices` and commit {FILE}");
    }

    #[test]
    fn every_package_is_named_with_a_text() {
        let text = committed();
        let packages = packages::compiled().unwrap();
        assert!(packages.len() > 150, "{}", packages.len());
        for package in packages {
            let head = format!("\n{} {}: ", package.name, package.version);
            let line = text.split_once(&head).unwrap_or_else(|| panic!("no {head}")).1;
            let numbers = line.lines().next().unwrap().split('[').skip(1);
            let texts = numbers.map(|number| {
                let head = format!("\n[{}] ", number.trim_end().trim_end_matches(']'));
                text.split_once(&head).unwrap().1.split(&rule()).next().unwrap()
            });
            let name = format!("{} {}", package.name, package.version);
            assert!(texts.clone().all(|text| text.contains(&name)), "{name}");
            assert!(texts.clone().any(|text| text.len() > 500), "{name}");
        }
    }

    #[test]
    fn fonts_and_the_muxer_are_named() {
        let text = committed();
        for needed in [
            "SIL OPEN FONT LICENSE",
            "UBUNTU FONT LICENCE",
            "Source Foundry Authors",
            "Bitstream Vera",
            "John Slegers",
            "Mozilla Public License Version 2.0",
            "https://github.com/Vanilagy/mediabunny/tree/v",
        ] {
            assert!(text.contains(needed), "{needed}");
        }
    }

    #[test]
    fn a_text_is_shown_once() {
        let item = |name: &str, text: &str| Item {
            name: name.into(),
            license: "MIT OR ISC".into(),
            taken: vec!["MIT".into()],
            note: None,
            texts: vec![text.into()],
        };
        let text = listed(&[item("a 1", "one\n two"), item("b 2", "one two"), item("c 3", "x")]);
        assert!(text.contains("\na 1: MIT OR ISC -> MIT [1]\nb 2: MIT OR ISC -> MIT [1]\n"));
        assert!(text.contains("\n[1] a 1, b 2\n\none\n two\n"), "{text}");
        assert!(text.ends_with("\n[2] c 3\n\nx\n"), "{text}");
    }
}
