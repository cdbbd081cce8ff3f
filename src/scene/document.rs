//! The scene as versioned JSON, and what is said of a document that cannot be read.
//!
//! In: text that may come from anyone. Out: a valid [`Scene`], or an error that names the
//! field at fault (or line and column) and says what is wrong. `docs/scene.md` describes the
//! format. A field left out takes its default, so the defaults belong to the version: a test
//! keeps those of versions 1 and 2, which are the same. A camera path stands beside the scene.
//!
//! | file | contents |
//! |---|---|
//! | `envelope` | kind, version and path around a scene |
//! | `error` | why a document cannot be read |
//! | `parse` | values from JSON text |
//! | `check` | the check of a scene that was read |
//! | `keys` | the form of a path |
//! | [`limits`] | every limit of what is read |
//! | `parts` | the parts of a scene that a key or a link names |

use std::io;

use serde::Serialize;

use super::{description::Scene, project::Project};
use crate::formula::own;

mod check;
mod envelope;
mod error;
mod keys;
pub mod limits;
mod parse;
mod parts;
mod words;

use check::checked;
use envelope::{Document, Header, KIND, READ, Scalar};
use parse::clipped;
use parts::LinkDocument;

pub use envelope::{MAX_BYTES, VERSION};
pub use error::DocumentError;
pub(super) use keys::{path_value, value_of};
pub(super) use parse::{check_syntax, parse};

fn document(scene: &Scene, path: keys::PathText) -> Document<&Scene, keys::PathText> {
    Document { mandelight: KIND.into(), version: VERSION, scene, path }
}

fn indented(document: &impl Serialize) -> String {
    let mut bytes = Vec::new();
    let mut serializer = serde_json::Serializer::with_formatter(&mut bytes, Indented::default());
    // Writing to memory does not fail, and every key of a scene is a string.
    document.serialize(&mut serializer).expect("a scene is JSON");
    bytes.push(b'\n');
    // The serializer writes only UTF-8.
    String::from_utf8(bytes).expect("JSON is UTF-8")
}

/// The document of a scene alone, indented for people; fields in the order of the types.
pub fn to_json(scene: &Scene) -> String {
    indented(&document(scene, keys::PathText::default()))
}

/// The document of a scene alone on one line, for text chunks and storage.
pub fn to_json_compact(scene: &Scene) -> String {
    // Every key of a scene is a string, which is all that could fail.
    serde_json::to_string(&document(scene, keys::PathText::default())).expect("a scene is JSON")
}

/// The document of a scene and its path, indented for people.
pub fn project_to_json(project: &Project) -> String {
    indented(&document(&project.scene, keys::text_of(project)))
}

/// The document of a scene and its path on one line.
pub fn project_to_json_compact(project: &Project) -> String {
    // As for a scene: every key is a string.
    serde_json::to_string(&document(&project.scene, keys::text_of(project)))
        .expect("a project is JSON")
}

/// Reads a document's scene. Fields left out take their defaults; directions and orientations
/// whose length is within 1e-3 of 1 are brought to 1.
///
/// # Errors
///
/// See [`DocumentError`]: a bad path too. Nothing else happens: the caller's scene is as it was.
pub fn from_json(text: &str) -> Result<Scene, DocumentError> {
    Ok(project_from_json(text)?.scene)
}

/// Reads a document: its scene as [`from_json`], and its path.
///
/// # Errors
///
/// See [`DocumentError`].
pub fn project_from_json(text: &str) -> Result<Project, DocumentError> {
    if text.len() > MAX_BYTES {
        return Err(DocumentError::TooLarge { bytes: text.len() });
    }
    // Some editors put a byte order mark first.
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    // The JSON reader would take a list for an object, field by field.
    if text.trim_start().chars().next().is_some_and(|first| first != '{') {
        return Err(DocumentError::NotAScene);
    }
    // The version first: another version's fields would only be called unknown.
    check_syntax(text)?;
    let header: Header = parse(text)?;
    if !matches!(&header.mandelight, Some(Scalar::Text(kind)) if kind == KIND) {
        return Err(DocumentError::NotAScene);
    }
    if !matches!(&header.version, Some(Scalar::Whole(version)) if READ.contains(version)) {
        let found = header.version.map_or("none".into(), |version| clipped(&version.to_string()));
        return Err(DocumentError::Version { found });
    }
    own::in_document(|| {
        let Document { scene, path, .. } = parse::<Document<Scene, keys::PathDraft>>(text)?;
        let scene = checked(scene)?;
        let path = path.finish(&scene)?;
        Ok(Project { scene, path })
    })
}

/// Whether `text` is a scene's document of a version after [`VERSION`], which a newer program can read.
pub fn is_newer(text: &str) -> bool {
    // A list would be read as the header's fields.
    let is_object = text.trim_start().starts_with('{');
    let is_text = is_object && text.len() <= MAX_BYTES && check_syntax(text).is_ok();
    let header = is_text.then(|| parse::<Header>(text).ok()).flatten();
    header.is_some_and(|Header { mandelight, version }| {
        matches!(mandelight, Some(Scalar::Text(kind)) if kind == KIND)
            && matches!(version, Some(Scalar::Whole(version)) if version > u64::from(VERSION))
    })
}

/// Reads a scene and its path without an envelope, as a link holds them, in the words of this [`VERSION`].
pub(super) fn project_from_link(text: &str) -> Result<Project, DocumentError> {
    check_syntax(text)?;
    own::in_document(|| {
        let (parts, path) = parse::<LinkDocument<keys::PathDraft>>(text)?.split();
        let scene = checked(parts.over(&Scene::default()))?;
        let path = path.finish(&scene)?;
        Ok(Project { scene, path })
    })
}

/// Indented JSON that keeps a row of numbers on its line.
#[derive(Default)]
struct Indented {
    depth: usize,
}

impl Indented {
    fn new_line<W: ?Sized + io::Write>(&self, writer: &mut W) -> io::Result<()> {
        write!(writer, "\n{:width$}", "", width = 2 * self.depth)
    }
}

impl serde_json::ser::Formatter for Indented {
    fn begin_object<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.depth += 1;
        writer.write_all(b"{")
    }

    fn end_object<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.depth -= 1;
        self.new_line(writer)?;
        writer.write_all(b"}")
    }

    fn begin_object_key<W: ?Sized + io::Write>(
        &mut self,
        writer: &mut W,
        first: bool,
    ) -> io::Result<()> {
        writer.write_all(if first { b"" } else { b"," })?;
        self.new_line(writer)
    }

    fn begin_object_value<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        writer.write_all(b": ")
    }

    fn begin_array_value<W: ?Sized + io::Write>(
        &mut self,
        writer: &mut W,
        first: bool,
    ) -> io::Result<()> {
        writer.write_all(if first { b"" } else { b", " })
    }
}
