//! The licences that are taken of a package, and their texts.
//!
//! The texts are those of the package. Where it has none, as its repository has them elsewhere, the standard
//! text stands in with the package's authors.

use std::{fs, path::Path};

use anyhow::{Context as _, Result, ensure};
use cargo_metadata::Package;
use spdx::{
    Expression, LicenseId, Licensee, ParseMode,
    detection::{Store, TextData},
};

use super::item::Item;

/// How alike a file and a standard text must be to have the same licence; copyright lines differ.
const ALIKE: f32 = 0.8;

/// How deep folders are searched.
const DEPTH: usize = 3;

/// Endings of files that are no texts of licences, whatever their names.
const OTHER_ENDINGS: [&str; 8] = ["rs", "toml", "json", "html", "yml", "py", "sh", "tpl"];

/// The licences that `deny.toml` allows, the preferred ones first.
pub fn accepted(deny: &str) -> Result<Vec<Licensee>> {
    let deny: toml::Table = deny.parse()?;
    let list = deny.get("licenses").and_then(|licenses| licenses.get("allow"));
    let list = list.and_then(|allow| allow.as_array()).context("deny.toml allows no licences")?;
    list.iter()
        .map(|name| Ok(Licensee::parse(name.as_str().context("a licence is no name")?)?))
        .collect()
}

/// What is said of a package.
pub fn item(package: &Package, accepted: &[Licensee]) -> Result<Item> {
    let license = package.license.clone().context("no licence in the manifest")?;
    let expression = Expression::parse_mode(&license, ParseMode::LAX)?;
    let taken = expression.minimized_requirements(accepted)?;
    let ids: Vec<LicenseId> = taken.iter().filter_map(|one| one.license.id()).collect();
    ensure!(ids.len() == taken.len(), "a licence without a name of SPDX");
    let store = store(&expression);
    let folder = package.manifest_path.parent().context("a manifest without a folder")?;
    let mut files = Vec::new();
    find(folder.as_std_path(), DEPTH, &mut files)?;
    files.sort();

    let (mut texts, mut missing) = (Vec::new(), ids.clone());
    for file in files {
        match licence_of(&store, &file) {
            Some(other) if !ids.contains(&other) => continue,
            Some(found) => missing.retain(|id| *id != found),
            // A notice, or several licences in one file.
            None => missing.retain(|id| !mentions(&file, *id)),
        }
        texts.push(file);
    }
    for id in missing {
        texts.push(standard(package, id));
    }
    for addition in taken.iter().filter_map(|one| one.addition.as_ref()?.id()) {
        texts.push(addition.text().to_owned());
    }
    Ok(Item {
        name: format!("{} {}", package.name, package.version),
        license,
        taken: taken.iter().map(ToString::to_string).collect(),
        note: None,
        texts,
    })
}

/// The standard text of a licence, with a package's authors in place of its example of a copyright line.
fn standard(package: &Package, id: LicenseId) -> String {
    let authors = match package.authors.as_slice() {
        [] => format!("the authors of {}", package.name),
        authors => authors.join(", "),
    };
    with_authors(id.text(), &authors)
}

/// A standard text with its example of a copyright line replaced.
pub fn with_authors(text: &str, authors: &str) -> String {
    let is_example = |line: &&str| line.starts_with("Copyright (c) <");
    match text.lines().find(is_example) {
        Some(line) => text.replace(line, &format!("Copyright (c) {authors}")),
        None => format!("Copyright (c) {authors}\n\n{text}"),
    }
}

/// The standard texts of all licences in an expression.
fn store(expression: &Expression) -> Store {
    let mut store = Store::new();
    for id in expression.requirements().filter_map(|one| one.req.license.id()) {
        store.add_license(id.name.to_owned(), TextData::new(id.text()));
    }
    store
}

/// The licence whose text a file is; none if the file is another text, or more than one.
fn licence_of(store: &Store, text: &str) -> Option<LicenseId> {
    let found = store.analyze(&TextData::new(text));
    (found.score >= ALIKE).then(|| spdx::license_id(found.name)).flatten()
}

/// True if a text that is no licence's alone contains one: its first sentences, in any layout.
fn mentions(text: &str, id: LicenseId) -> bool {
    let words =
        |text: &str| text.split_whitespace().map(str::to_lowercase).collect::<Vec<_>>().join(" ");
    let standard = words(id.text());
    let middle: String = standard.chars().skip(standard.chars().count() / 2).take(120).collect();
    words(text).contains(&middle)
}

/// Adds the texts of files in `folder` whose names are those of licences and notices.
fn find(folder: &Path, depth: usize, texts: &mut Vec<String>) -> Result<()> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() {
            if depth > 1 {
                find(&path, depth - 1, texts)?;
            }
        } else if is_notice(&path) {
            // Some old names of authors are not UTF-8.
            texts.push(String::from_utf8_lossy(&fs::read(&path)?).replace('\r', ""));
        }
    }
    Ok(())
}

/// True for names such as `LICENSE-MIT`, `COPYING`, `NOTICE.md`, and for the texts beside fonts.
fn is_notice(path: &Path) -> bool {
    let name = path.file_name().unwrap_or_default().to_string_lossy().to_lowercase();
    let ending = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    let is_beside_fonts = path.parent().is_some_and(|folder| folder.ends_with("fonts"));
    let words = ["license", "licence", "copying", "copyright", "notice"];
    (words.iter().any(|word| name.contains(word)) && !OTHER_ENDINGS.contains(&ending.as_str()))
        || (is_beside_fonts && ending == "txt")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn licences_are_allowed_in_their_order() {
        let list = accepted("[licenses]\nallow = [\"MIT\", \"Apache-2.0\"]").unwrap();
        let expression = Expression::parse("Apache-2.0 OR MIT").unwrap();
        let taken = expression.minimized_requirements(&list).unwrap();
        assert_eq!(taken.iter().map(ToString::to_string).collect::<Vec<_>>(), ["MIT"]);
        assert!(accepted("[licenses]").is_err());
    }

    #[test]
    fn names_of_notices_are_known() {
        for name in [
            "LICENSE-MIT",
            "a/COPYING",
            "UNLICENSE",
            "license.md",
            "b/fonts/OFL.txt",
            "LICENSE.APACHE",
        ] {
            assert!(is_notice(Path::new(name)), "{name}");
        }
        for name in ["src/license.rs", "OFL.txt", "README.md", "fonts/a.ttf"] {
            assert!(!is_notice(Path::new(name)), "{name}");
        }
    }

    #[test]
    fn texts_are_recognised_despite_their_copyright_lines() {
        let store = store(&Expression::parse("MIT OR Apache-2.0").unwrap());
        let mit = spdx::license_id("MIT").unwrap();
        let text = with_authors(mit.text(), "A. Person, B. Person and all who helped them");
        assert!(text.contains("Copyright (c) A. Person") && !text.contains('<'), "{text}");
        assert_eq!(licence_of(&store, &text), Some(mit));
        let both = format!("{text}\n{}", spdx::license_id("Apache-2.0").unwrap().text());
        assert!(mentions(&both, mit) && !mentions("Notices of a package", mit));
    }
}
