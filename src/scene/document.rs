//! The scene as versioned JSON, and what is said of a document that cannot be read.
//!
//! In: text that may come from anyone. Out: a valid [`Scene`], or an error that names the
//! field at fault (or line and column) and says what is wrong. `docs/scene.md` describes the
//! format. A field left out takes its default, so the defaults belong to the version: a test
//! keeps those of versions 1 and 2, which are the same. A camera path stands beside the scene; `keys` has its form.

use std::io;

use glam::{DQuat, DVec3};
use serde::{
    Deserialize, Serialize,
    de::{DeserializeOwned, IgnoredAny},
};

use super::{Invalid, Project, Scene, param, validate::UNIT_TOLERANCE};

mod keys;

pub(super) use keys::{path_value, value_of};

/// The version written.
pub const VERSION: u32 = 2;
/// The versions read. Version 1 knew one formula: its documents lack `fractal.formula`.
const READ: std::ops::RangeInclusive<u64> = 1..=VERSION as u64;
/// The largest document read, in bytes: more than a full path takes whose keys each have as many
/// lights as there can be.
pub const MAX_BYTES: usize = 16 << 20;
/// How far from 1 the length of a direction may be in a document: written by hand with three
/// digits it is still meant to be a direction.
const UNIT_TOLERANCE_READ: f64 = 1e-3;

/// Why a document cannot be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum DocumentError {
    /// Longer than [`MAX_BYTES`].
    #[error("the document has {bytes} bytes; at most {MAX_BYTES} are read")]
    TooLarge {
        /// Its length.
        bytes: usize,
    },
    /// Not JSON.
    #[error("line {line}, column {column}: {message}")]
    Syntax {
        /// Line of the fault, from 1.
        line: usize,
        /// Column of the fault, from 1; 0 at a line's very start.
        column: usize,
        /// What the JSON reader says.
        message: String,
    },
    /// JSON, but not a scene's.
    #[error("not a Mandelight scene: \"mandelight\": \"scene\" is missing")]
    NotAScene,
    /// A version that this program cannot read.
    #[error("version: {found} cannot be read; this program reads versions 1 to {VERSION}")]
    Version {
        /// The version's JSON.
        found: String,
    },
    /// A field that doesn't exist, or whose value is of the wrong kind.
    #[error("{path}: {message} (line {line}, column {column})")]
    Field {
        /// The field: `lights.environment[2].intensity`.
        path: String,
        /// What is wrong with it.
        message: String,
        /// Line of the fault, from 1.
        line: usize,
        /// Column of the fault, from 1; 0 at a line's very start.
        column: usize,
    },
    /// A value out of range.
    #[error(transparent)]
    Invalid(#[from] Invalid),
}

/// What the document is, before its contents are looked at.
#[derive(Deserialize)]
struct Header {
    mandelight: Option<serde_json::Value>,
    version: Option<serde_json::Value>,
}

/// The document; `S` is `Scene` to read and `&Scene` to write, `P` its path.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Document<S, P: Default + PartialEq> {
    mandelight: String,
    version: u32,
    scene: S,
    #[serde(default, skip_serializing_if = "is_default")]
    path: P,
}

fn is_default<P: Default + PartialEq>(path: &P) -> bool {
    *path == P::default()
}

const KIND: &str = "scene";

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
    let header: Header = parse(text)?;
    if header.mandelight.as_ref().and_then(|kind| kind.as_str()) != Some(KIND) {
        return Err(DocumentError::NotAScene);
    }
    let version = header.version.as_ref().and_then(|version| version.as_u64());
    if !version.is_some_and(|version| READ.contains(&version)) {
        let found = header.version.map_or("none".into(), |version| clipped(&version.to_string()));
        return Err(DocumentError::Version { found });
    }
    let Document { scene, path, .. } = parse::<Document<Scene, keys::PathDraft>>(text)?;
    Ok(Project { scene: checked(scene)?, path: path.finish(text)? })
}

/// Reads a scene without its envelope, in the words of this [`VERSION`].
pub(super) fn scene_from_json(text: &str) -> Result<Scene, DocumentError> {
    checked(parse(text)?)
}

/// The scene, valid, its directions of length 1.
fn checked(mut scene: Scene) -> Result<Scene, DocumentError> {
    let directions = scene.lights.environment.iter_mut().map(|light| &mut light.direction);
    for direction in directions.chain([&mut scene.lights.rig.sky.sun_direction]) {
        let vector = DVec3::from_array(*direction);
        if is_nearly_unit(vector.length()) {
            *direction = vector.normalize().to_array();
        }
    }
    let orientation = DQuat::from_array(scene.camera.orientation.0);
    if is_nearly_unit(orientation.length()) {
        scene.camera.orientation = orientation.normalize().into();
    }
    scene.validate()?;
    Ok(scene)
}

/// True where normalizing is called for and harmless: what is already right keeps its bits.
fn is_nearly_unit(length: f64) -> bool {
    (UNIT_TOLERANCE..=UNIT_TOLERANCE_READ).contains(&(length - 1.0).abs())
}

fn parse<T: DeserializeOwned>(text: &str) -> Result<T, DocumentError> {
    // Syntax apart from meaning: after this pass every fault lies in some field.
    serde_json::from_str::<IgnoredAny>(text).map_err(|error| DocumentError::Syntax {
        line: error.line(),
        column: error.column(),
        message: message_of(&error),
    })?;
    let mut reader = serde_json::Deserializer::from_str(text);
    serde_path_to_error::deserialize(&mut reader)
        .map_err(|error| field_error(&error.path().to_string(), error.inner()))
}

fn field_error(path: &str, error: &serde_json::Error) -> DocumentError {
    let path = match path {
        "." => "document",
        path => path.strip_prefix("scene.").unwrap_or(path),
    };
    let mut message = message_of(error);
    // A key's scene has the same fields.
    let field = path.split_once("].scene.").map_or(path, |(_, field)| field);
    if let Some(param) = param::find(field) {
        message = format!("{message}; it takes {}", param.range_text());
    }
    DocumentError::Field {
        path: clipped(path),
        message,
        line: error.line(),
        column: error.column(),
    }
}

/// The error's text without the position, which is told apart.
fn message_of(error: &serde_json::Error) -> String {
    let text = error.to_string();
    let position = format!(" at line {} column {}", error.line(), error.column());
    clipped(text.strip_suffix(&position).unwrap_or(&text))
}

/// `text`, cut where it is too long to show.
fn clipped(text: &str) -> String {
    const MOST_CHARS: usize = 400;
    match text.char_indices().nth(MOST_CHARS) {
        None => text.into(),
        Some((end, _)) => format!("{}…", &text[..end]),
    }
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
