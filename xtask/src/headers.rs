//! The HTTP headers of the page's files, for `serve` and for hosts that read a `_headers` file.
//!
//! A file whose name contains a hash of its content stays in a browser's cache forever; the document, the
//! service worker and the licences are asked for again at each visit, so that a new version is found.

use std::fmt::Write as _;

use crate::page;

/// The file that static hosts such as Netlify and Cloudflare Pages read.
pub const FILE: &str = "_headers";

/// Headers of every file. The document itself has the rest of its content security policy; a policy about
/// frames counts in a header only.
pub const ALL: [(&str, &str); 3] = [
    ("Content-Security-Policy", "frame-ancestors 'self'"),
    ("X-Content-Type-Options", "nosniff"),
    ("Referrer-Policy", "no-referrer"),
];

const FOREVER: &str = "public, max-age=31536000, immutable";
const ASK: &str = "no-cache";

/// The value of `Cache-Control` for a file of the page, by its path.
pub fn cache_control(path: &str) -> &'static str {
    let is_named = ["index.html", "service-worker.js", page::LICENSES];
    let name = path.rsplit('/').next().unwrap_or(path);
    if is_named.contains(&name) { ASK } else { FOREVER }
}

/// The text of [`FILE`] for a page of these files.
pub fn text<'a>(names: impl Iterator<Item = &'a str>) -> String {
    let mut text = String::from("/*\n");
    for (name, value) in ALL {
        let _ = writeln!(text, "  {name}: {value}");
    }
    let _ = writeln!(text, "/\n  Cache-Control: {ASK}");
    for name in names {
        let _ = writeln!(text, "/{name}\n  Cache-Control: {}", cache_control(name));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn named_files_are_asked_for_and_hashed_files_stay() {
        let text = text(
            ["index.html", "boot-0123456789ab.js", "service-worker.js", "licenses.txt"].into_iter(),
        );
        let of = |path: &str| {
            let mut lines = text.lines().skip_while(|line| *line != path);
            lines.nth(1).unwrap_or_default().trim().to_owned()
        };
        for path in ["/", "/index.html", "/service-worker.js", "/licenses.txt"] {
            assert_eq!(of(path), format!("Cache-Control: {ASK}"), "{path}");
        }
        assert_eq!(of("/boot-0123456789ab.js"), format!("Cache-Control: {FOREVER}"));
        assert!(text.contains("  X-Content-Type-Options: nosniff\n"));
        assert!(text.contains("frame-ancestors 'self'"));
    }
}
