//! What the program contains beside packages of Cargo: Rust's own library, the muxer of videos.

use std::fs;

use anyhow::{Context as _, Result};

use super::{item::Item, texts::with_authors};
use crate::shell;

/// The package of Node.js that `www/video.js` uses.
const MEDIABUNNY: &str = "mediabunny";

/// Both of them.
pub fn items() -> Result<Vec<Item>> {
    let lock = fs::read_to_string(shell::root()?.join("package-lock.json"))?;
    Ok(vec![rust(), mediabunny(&lock)?])
}

/// Rust's library, with the licences of the parts and packages that it contains.
fn rust() -> Item {
    let authors = "The Rust Project Developers (see https://thanks.rust-lang.org)";
    let texts = [
        with_authors(text("MIT"), authors),
        text("Apache-2.0").to_owned(),
        spdx::exception_id("LLVM-exception").map_or("", |exception| exception.text()).to_owned(),
        text("Unicode-3.0").to_owned(),
    ];
    let license = "MIT AND Apache-2.0 WITH LLVM-exception AND Unicode-3.0".to_owned();
    Item {
        name: "Rust's standard library".to_owned(),
        taken: vec![license.clone()],
        license,
        note: Some(
            "MIT or Apache-2.0; the tables of Unicode and the compiler's built-in functions as named. \
             Its source: https://github.com/rust-lang/rust/tree/main/library"
                .to_owned(),
        ),
        texts: texts.into(),
    }
}

/// The muxer, in the version of `package-lock.json`.
fn mediabunny(lock: &str) -> Result<Item> {
    let head = format!("\"node_modules/{MEDIABUNNY}\": {{");
    let entry = lock.split_once(&head).context("package-lock.json lacks Mediabunny")?.1;
    let field = |name: &str| -> Result<String> {
        let value =
            entry.split_once(&format!("\"{name}\": \"")).and_then(|rest| rest.1.split_once('"'));
        Ok(value.with_context(|| format!("Mediabunny has no {name}"))?.0.to_owned())
    };
    let (version, license) = (field("version")?, field("license")?);
    let source = format!("https://github.com/Vanilagy/mediabunny/tree/v{version}");
    Ok(Item {
        name: format!("Mediabunny {version}"),
        taken: vec![license.clone()],
        texts: vec![text(&license).to_owned()],
        license,
        note: Some(format!("Parts of it, unchanged, in the page. Their source: {source}")),
    })
}

/// The standard text of a licence.
fn text(name: &str) -> &'static str {
    spdx::license_id(name).map_or("", |id| id.text())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_item_has_its_texts() {
        for item in items().unwrap() {
            assert!(item.texts.iter().all(|text| text.len() > 300), "{}", item.name);
        }
    }

    #[test]
    fn the_muxer_has_the_version_of_the_lock_file() {
        let lock = "\"node_modules/mediabunny\": {\n \"version\": \"1.2.3\",\n \"license\": \"MPL-2.0\"\n}";
        let item = mediabunny(lock).unwrap();
        assert_eq!((item.name.as_str(), item.license.as_str()), ("Mediabunny 1.2.3", "MPL-2.0"));
        assert!(item.note.unwrap().ends_with("/tree/v1.2.3"));
        assert!(mediabunny("{}").is_err());
    }
}
