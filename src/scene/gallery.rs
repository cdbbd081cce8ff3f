//! A gallery: the list of a folder's pictures on a web host, each of which contains its scene.
//!
//! In and out: the JSON text of [`LIST_FILE`]. A list names files of its own folder only.

use serde::{Deserialize, Serialize};

use super::document::{check_syntax, parse};
use crate::reading::{at_most, is_hidden};

/// The name of the list's file in its folder.
pub const LIST_FILE: &str = "gallery.json";
/// Maximum length of a list, in bytes.
pub const MAX_LIST_BYTES: usize = 1 << 20;
/// Maximum number of pictures in a gallery.
pub const MAX_PICTURES: usize = 500;
/// Maximum length of a name or a file's name, in characters.
const MAX_NAME_CHARS: usize = 200;

const KIND: &str = "gallery";
const VERSION: u64 = 1;

/// A list of pictures.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Gallery {
    /// The gallery's name; may be empty.
    pub name: String,
    /// The pictures, in the order of the list.
    pub pictures: Vec<Picture>,
}

/// A picture that contains its scene.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    /// The file, in the list's folder or below it, with `/` between folders.
    pub file: String,
    /// The name under the picture; never empty.
    pub name: String,
}

/// Why a list cannot be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum GalleryError {
    /// Longer than [`MAX_LIST_BYTES`].
    #[error("the list has over {MAX_LIST_BYTES} bytes, the most that is read")]
    TooLong,
    /// Not the JSON of a list, or with over [`MAX_PICTURES`] pictures.
    #[error("the list cannot be read: {0}")]
    Syntax(String),
    /// Another kind of document, or another version.
    #[error(
        "this is not a gallery's list, which has \"mandelight\": \"{KIND}\" and \"version\": {VERSION}"
    )]
    NotAList,
    /// No picture; or over [`MAX_PICTURES`], for a list that is made.
    #[error("the list has {0} pictures; a gallery has 1 to {MAX_PICTURES}")]
    Count(usize),
    /// A file that is not in the list's folder, or a text that is too long.
    #[error(
        "pictures[{index}].file: \"{file}\" cannot be used: a name has at most {MAX_NAME_CHARS} characters, none of \\ : ? # %, and leads nowhere but into the list's folder"
    )]
    File {
        /// The picture's place in the list.
        index: usize,
        /// The name, without hidden characters, cut where it is long.
        file: String,
    },
}

/// The list as it is stored.
#[derive(Serialize, Deserialize)]
struct Stored {
    mandelight: String,
    version: u64,
    #[serde(default, skip_serializing_if = "String::is_empty")]
    name: String,
    #[serde(deserialize_with = "at_most::<MAX_PICTURES, _, _>")]
    pictures: Vec<StoredPicture>,
}

#[derive(Serialize, Deserialize)]
struct StoredPicture {
    file: String,
    #[serde(default, skip_serializing_if = "String::is_empty")]
    name: String,
}

impl Gallery {
    /// A gallery of these files; a picture has its file's name without the ending.
    ///
    /// # Errors
    /// As of [`Self::from_json`].
    pub fn new(name: &str, files: impl IntoIterator<Item = String>) -> Result<Self, GalleryError> {
        let pictures =
            files.into_iter().map(|file| StoredPicture { file, name: String::new() }).collect();
        checked(Stored { mandelight: KIND.into(), version: VERSION, name: name.into(), pictures })
    }

    /// Reads a list.
    ///
    /// # Errors
    /// What is wrong with the list, and where.
    pub fn from_json(text: &str) -> Result<Self, GalleryError> {
        if text.len() > MAX_LIST_BYTES {
            return Err(GalleryError::TooLong);
        }
        let list = check_syntax(text).and_then(|()| parse(text));
        checked(list.map_err(|error| GalleryError::Syntax(error.to_string()))?)
    }

    /// The list's text, which [`Self::from_json`] reads.
    pub fn to_json(&self) -> String {
        let named = |picture: &Picture| picture.name != name_of(&picture.file);
        let pictures = self.pictures.iter().map(|picture| StoredPicture {
            file: picture.file.clone(),
            name: if named(picture) { picture.name.clone() } else { String::new() },
        });
        let stored = Stored {
            mandelight: KIND.into(),
            version: VERSION,
            name: self.name.clone(),
            pictures: pictures.collect(),
        };
        serde_json::to_string_pretty(&stored).unwrap_or_default() + "\n"
    }
}

fn checked(stored: Stored) -> Result<Gallery, GalleryError> {
    let Stored { mandelight, version, name, pictures } = stored;
    if mandelight != KIND || version != VERSION {
        return Err(GalleryError::NotAList);
    }
    if pictures.is_empty() || pictures.len() > MAX_PICTURES {
        return Err(GalleryError::Count(pictures.len()));
    }
    let picture = |(index, StoredPicture { file, name }): (usize, StoredPicture)| {
        if !is_in_folder(&file) {
            return Err(GalleryError::File { index, file: printable(&file) });
        }
        let name = printable(&name);
        let name = if name.is_empty() { name_of(&file) } else { name };
        Ok(Picture { file, name })
    };
    let pictures = pictures.into_iter().enumerate().map(picture).collect::<Result<_, _>>()?;
    Ok(Gallery { name: printable(&name), pictures })
}

/// True for a path that leads nowhere but into the folder, on every host and in every browser.
pub fn is_in_folder(file: &str) -> bool {
    let is_foreign = |c: char| is_hidden(c) || matches!(c, '\\' | ':' | '?' | '#' | '%');
    file.chars().count() <= MAX_NAME_CHARS
        && !file.contains(is_foreign)
        && file.split('/').all(|part| !matches!(part.trim(), "" | "." | ".."))
}

/// The picture's name where the list has none: the file's without folder and ending.
fn name_of(file: &str) -> String {
    let name = file.rsplit('/').next().unwrap_or(file);
    match name.rsplit_once('.') {
        Some((stem, _)) if !stem.is_empty() => stem.to_owned(),
        _ => name.to_owned(),
    }
}

/// A text of the list without hidden characters, cut where it is long.
fn printable(text: &str) -> String {
    text.chars().filter(|&c| !is_hidden(c)).take(MAX_NAME_CHARS).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn list(pictures: &str) -> Result<Gallery, GalleryError> {
        Gallery::from_json(&format!(
            r#"{{"mandelight": "gallery", "version": 1, "name": "R\u202ee\u001befs", "pictures": [{pictures}]}}"#
        ))
    }

    #[test]
    fn a_list_is_read_and_written() {
        let gallery = list(r#"{"file": "deep/cove.2.png"}, {"file": "a.png", "name": "First"}"#);
        let gallery = gallery.expect("a list");
        assert_eq!(gallery.name, "Reefs", "without hidden characters");
        let names: Vec<_> = gallery.pictures.iter().map(|picture| &*picture.name).collect();
        assert_eq!(names, ["cove.2", "First"]);
        assert_eq!(Gallery::from_json(&gallery.to_json()), Ok(gallery));
    }

    #[test]
    fn no_list_names_a_file_outside_its_folder() {
        let bad = [
            "",
            "/etc/a.png",
            "../a.png",
            "a/../../b.png",
            "./a.png",
            "a//b.png",
            "a\\\\b.png",
            "https://other.example/a.png",
            "javascript:a",
            "a.png?b",
            "a.png#b",
            "%2e%2e/a.png",
            "a/ ../b.png",
            "a\\nb.png",
            "a\u{202e}gnp.exe",
        ];
        for file in bad {
            let read = list(&format!(r#"{{"file": "{file}"}}"#));
            assert!(matches!(read, Err(GalleryError::File { index: 0, .. })), "{file}: {read:?}");
            let message = read.expect_err("a message").to_string();
            assert!(!message.contains(is_hidden), "{message:?}");
        }
        let long = "a".repeat(MAX_NAME_CHARS + 1);
        assert!(list(&format!(r#"{{"file": "{long}"}}"#)).is_err());
    }

    #[test]
    fn what_is_no_list_is_told() {
        assert_eq!(list(""), Err(GalleryError::Count(0)));
        let many = vec![r#"{"file": "a.png"}"#; MAX_PICTURES + 1].join(",");
        let error = list(&many).expect_err("too many").to_string();
        assert!(error.contains("pictures: has more than 500 entries"), "{error}");
        let files = vec!["a.png".to_owned(); MAX_PICTURES + 1];
        assert_eq!(Gallery::new("", files), Err(GalleryError::Count(MAX_PICTURES + 1)));
        let scene = r#"{"mandelight": "scene", "version": 1, "pictures": []}"#;
        assert_eq!(Gallery::from_json(scene), Err(GalleryError::NotAList));
        assert!(matches!(Gallery::from_json("[1]"), Err(GalleryError::Syntax(_))));
        let Err(GalleryError::Syntax(text)) = Gallery::from_json("{\"mandelight\": ") else {
            panic!("half a list");
        };
        assert_eq!(
            text,
            "line 1, column 15: the text ends too early: a part of the file is missing"
        );
        for fields in [
            r#"["gallery",1,"R",[["a.png","A"]]]"#,
            r#"{"mandelight":"gallery","version":1,"pictures":[["a.png","A"]]}"#,
        ] {
            let error = Gallery::from_json(fields).expect_err("lists for objects").to_string();
            assert!(error.contains("expected an object with named fields"), "{error}");
        }
        let long = " ".repeat(MAX_LIST_BYTES + 1);
        assert_eq!(Gallery::from_json(&long), Err(GalleryError::TooLong));
    }
}
