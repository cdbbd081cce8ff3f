//! The documents: their links lead to files that are there.

use std::{
    fs,
    path::{Path, PathBuf},
};

/// Every Markdown file of the top folder and of `docs/`.
fn documents() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let is_document = |file: &PathBuf| file.extension().is_some_and(|ending| ending == "md");
    let folders = [root.to_owned(), root.join("docs"), root.join("docs/notes")];
    let files = folders.iter().flat_map(|folder| fs::read_dir(folder).expect("a folder"));
    files.map(|entry| entry.expect("an entry").path()).filter(is_document).collect()
}

/// The addresses of a document's links and pictures.
fn links(text: &str) -> impl Iterator<Item = &str> {
    text.split("](").skip(1).filter_map(|rest| rest.split([')', ' ']).next())
}

/// The name that a heading's link has: small letters, hyphens, no other signs.
fn anchor(heading: &str) -> String {
    let kept = |letter: &char| letter.is_alphanumeric() || matches!(letter, ' ' | '-' | '_');
    heading.to_lowercase().chars().filter(kept).collect::<String>().replace(' ', "-")
}

#[test]
fn links_lead_to_files_and_headings() {
    let documents = documents();
    assert!(documents.len() > 15, "{documents:?}");
    let (mut count, mut lost) = (0, Vec::new());
    for document in &documents {
        let text = fs::read_to_string(document).expect("a text");
        let folder = document.parent().expect("a folder");
        // Links of scenes are as long as the scene, and are held elsewhere.
        for link in links(&text).filter(|link| !link.contains(':') && !link.contains('=')) {
            let (file, heading) = link.split_once('#').unwrap_or((link, ""));
            let target = if file.is_empty() { document.clone() } else { folder.join(file) };
            let has_heading = || {
                let text = fs::read_to_string(&target).unwrap_or_default();
                let headings = text.lines().filter(|line| line.starts_with('#'));
                headings
                    .map(|line| anchor(line.trim_start_matches('#').trim()))
                    .any(|name| name == heading)
            };
            count += 1;
            if !target.exists() || (!heading.is_empty() && !has_heading()) {
                lost.push(format!("{}: {link}", document.display()));
            }
        }
    }
    assert!(count > 100, "{count} links");
    assert!(lost.is_empty(), "{lost:#?}");
}
