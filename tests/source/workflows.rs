//! The workflows: actions are pinned by commit, and no job has rights that it doesn't need.

use std::{fs, path::Path};

/// The names and texts of all workflows.
fn workflows() -> Vec<(String, String)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(".github/workflows");
    let entries = fs::read_dir(folder).expect("the folder of workflows");
    entries
        .map(|entry| {
            let path = entry.expect("an entry").path();
            let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            (name, fs::read_to_string(&path).expect("a text"))
        })
        .collect()
}

/// The actions of a workflow's text, with their lines' comments.
fn actions(text: &str) -> impl Iterator<Item = &str> {
    text.lines().filter_map(|line| line.trim_start().trim_start_matches("- ").strip_prefix("uses:"))
}

/// True for `owner/action@<40 hexadecimal digits> # v1.2.3`: whoever moves a tag changes nothing then.
fn is_pinned(action: &str) -> bool {
    let Some((name, rest)) = action.trim().split_once('@') else { return false };
    let Some((commit, version)) = rest.split_once(" # v") else { return false };
    let parts: Vec<_> = version.split('.').collect();
    name.contains('/')
        && commit.len() == 40
        && commit.bytes().all(|digit| matches!(digit, b'0'..=b'9' | b'a'..=b'f'))
        && parts.len() == 3
        && parts.iter().all(|part| part.parse::<u32>().is_ok())
}

#[test]
fn actions_are_pinned_by_commit_with_their_version() {
    let workflows = workflows();
    let mut count = 0;
    for (file, text) in &workflows {
        for action in actions(text) {
            assert!(is_pinned(action), "{file}: {action}");
            count += 1;
        }
        assert_eq!(actions(text).count(), text.matches("uses:").count(), "{file}");
    }
    assert!(count >= 10, "{count} actions in {} workflows", workflows.len());
}

#[test]
fn one_action_has_one_version() {
    let workflows = workflows();
    let mut all: Vec<_> = workflows.iter().flat_map(|(_, text)| actions(text)).collect();
    all.sort_unstable();
    all.dedup();
    let mut names: Vec<_> = all.iter().filter_map(|action| action.split('@').next()).collect();
    names.dedup();
    assert_eq!(names.len(), all.len(), "{all:?}");
}

#[test]
fn only_what_publishes_may_write() {
    for (file, text) in workflows() {
        assert!(text.contains("\npermissions: {}\n"), "{file} grants rights to all jobs");
        let writing: Vec<_> =
            text.lines().map(str::trim).filter(|line| line.ends_with(": write")).collect();
        let expected: &[&str] =
            if file == "page.yml" { &["pages: write", "id-token: write"] } else { &[] };
        assert_eq!(writing, expected, "{file}");
        let checkouts = text.matches("actions/checkout@").count();
        assert_eq!(text.matches("persist-credentials: false").count(), checkouts, "{file}");
    }
}

#[test]
fn tags_and_short_commits_are_no_pins() {
    assert!(is_pinned(" a/b@0123456789012345678901234567890123456789 # v1.2.3"));
    for other in ["v4", "0123456", "0123456789012345678901234567890123456789"] {
        assert!(!is_pinned(&format!("a/b@{other}")), "{other}");
        assert!(!is_pinned(&format!("a/b@{other} # v4")), "{other}");
    }
}
