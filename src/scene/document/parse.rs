//! Values from JSON text, or an error that names the field, or line and column.

use serde::de::{DeserializeOwned, IgnoredAny};

use super::{error::DocumentError, limits::MAX_DEPTH, words};
use crate::{
    reading::{Objects, visible},
    scene::param,
};

/// Checks that `text` is JSON of a bounded depth: after this check every fault lies in some field.
///
/// Nothing is kept of the text, whatever its length.
pub fn check_syntax(text: &str) -> Result<(), DocumentError> {
    serde_json::from_str::<IgnoredAny>(text).map_err(|error| DocumentError::Syntax {
        line: error.line(),
        column: error.column(),
        message: syntax_message(&error),
    })?;
    check_depth(text)
}

/// Checks the depth of `text`, which is JSON.
fn check_depth(text: &str) -> Result<(), DocumentError> {
    let (mut depth, mut line, mut line_start) = (0_usize, 1, 0);
    let mut bytes = text.bytes().enumerate();
    while let Some((at, byte)) = bytes.next() {
        match byte {
            b'[' | b'{' => depth += 1,
            b']' | b'}' => depth -= 1,
            b'\n' => (line, line_start) = (line + 1, at + 1),
            b'"' => {
                // A text ends at the next quote that no backslash precedes.
                while let Some((_, byte)) = bytes.next().filter(|(_, byte)| *byte != b'"') {
                    if byte == b'\\' {
                        bytes.next();
                    }
                }
            }
            _ => {}
        }
        if depth > MAX_DEPTH {
            let message = format!(
                "lists and objects are nested more than {MAX_DEPTH} deep, the most that is read: flatten this part"
            );
            return Err(DocumentError::Syntax { line, column: at - line_start + 1, message });
        }
    }
    Ok(())
}

/// The value that `text` holds, which is JSON.
pub fn parse<T: DeserializeOwned>(text: &str) -> Result<T, DocumentError> {
    let mut reader = serde_json::Deserializer::from_str(text);
    serde_path_to_error::deserialize(Objects(&mut reader))
        .map_err(|error| field_error(&error.path().to_string(), error.inner()))
}

/// The error of the field at `path`, in the words of a document.
fn field_error(path: &str, error: &serde_json::Error) -> DocumentError {
    let path = match path {
        "." => "document",
        path => path.strip_prefix("scene.").unwrap_or(path),
    };
    let mut message = words::plain(&message_of(error));
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

/// What is wrong with text that is not JSON, in words for people who don't know JSON's.
fn syntax_message(error: &serde_json::Error) -> String {
    if error.is_eof() {
        return "the text ends too early: a part of the file is missing".to_owned();
    }
    let message = message_of(error);
    let plain = match message.as_str() {
        "expected value" => "this is not JSON: a value is missing",
        "key must be a string" => "the name of a field must stand in double quotes",
        "trailing comma" => "there is a comma too many",
        "expected `,` or `}`" => "a comma or } is missing",
        "expected `,` or `]`" => "a comma or ] is missing",
        "expected `:`" => "a colon is missing after the name of a field",
        "trailing characters" => "there is more text after the document's end",
        _ => return format!("this is not JSON: {message}"),
    };
    plain.to_owned()
}

/// The error's text without the position, which is told apart.
fn message_of(error: &serde_json::Error) -> String {
    let text = error.to_string();
    let position = format!(" at line {} column {}", error.line(), error.column());
    clipped(text.strip_suffix(&position).unwrap_or(&text))
}

/// `text`, cut where it is too long to show, without control characters.
pub fn clipped(text: &str) -> String {
    const MAX_CHARS: usize = 400;
    match text.char_indices().nth(MAX_CHARS) {
        None => visible(text).into_owned(),
        Some((end, _)) => format!("{}…", visible(&text[..end])),
    }
}
