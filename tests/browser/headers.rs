//! The file of headers in the built page, which the tests' own host sends too.

use std::{
    collections::BTreeMap,
    fs,
    path::{Path, PathBuf},
};

/// The headers of each path in the text of `_headers`.
fn rules(text: &str) -> BTreeMap<&str, Vec<(&str, &str)>> {
    let mut rules = BTreeMap::new();
    let mut path = None;
    for line in text.lines() {
        if line.starts_with('/') {
            assert!(rules.insert(line, Vec::new()).is_none(), "{line} occurs twice");
            path = Some(line);
        } else {
            let header = line.trim_start().split_once(": ").expect("a header");
            let rule = path.and_then(|path| rules.get_mut(path)).expect("a path above the header");
            rule.push(header);
        }
    }
    rules
}

/// The files below `folder`, by their paths there.
fn files_below(folder: &Path) -> Vec<String> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).unwrap().map(Result::unwrap) {
        let name = entry.file_name().into_string().unwrap();
        if entry.path().is_dir() {
            let inside = files_below(&entry.path());
            files.extend(inside.iter().map(|file| format!("{name}/{file}")));
        } else {
            files.push(name);
        }
    }
    files
}

/// Whether a file of this path never changes: its name, or that of its folder, contains a hash of the content.
fn has_hash(path: &str) -> bool {
    let stem = path.rsplit_once('.').map_or(path, |(stem, _)| stem);
    let hash = stem.rsplit_once('-').map_or("", |(_, hash)| hash);
    path.starts_with("snippets/")
        || hash.len() == 12 && hash.bytes().all(|digit| digit.is_ascii_hexdigit())
}

#[test]
fn the_built_page_has_headers_for_each_of_its_files() {
    let dist = PathBuf::from(std::env::var_os("MANDELIGHT_DIST").expect("the built page"));
    let text = fs::read_to_string(dist.join("_headers")).expect("_headers");
    let mut rules = rules(&text);
    let all = rules.remove("/*").expect("headers of every file");
    assert!(all.contains(&("X-Content-Type-Options", "nosniff")), "{all:?}");
    assert!(all.contains(&("Referrer-Policy", "no-referrer")), "{all:?}");
    assert!(all.contains(&("Content-Security-Policy", "frame-ancestors 'self'")), "{all:?}");
    assert_eq!(rules.remove("/"), Some(vec![("Cache-Control", "no-cache")]));

    let files = files_below(&dist);
    assert!(files.iter().filter(|file| has_hash(file)).count() > 5, "{files:?}");
    for file in files.iter().filter(|file| *file != "_headers") {
        let value = if has_hash(file) { "public, max-age=31536000, immutable" } else { "no-cache" };
        let rule = rules.remove(&*format!("/{file}"));
        assert_eq!(rule, Some(vec![("Cache-Control", value)]), "{file}");
    }
    assert!(rules.is_empty(), "headers of files that are not there: {rules:?}");
}
