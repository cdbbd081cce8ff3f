//! Values from JSON text, or an error that names the field, or line and column.

use serde::de::{DeserializeOwned, IgnoredAny};

use super::error::DocumentError;
use crate::scene::param;

/// The value that `text` holds.
pub fn parse<T: DeserializeOwned>(text: &str) -> Result<T, DocumentError> {
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

/// The error of the field at `path`, in the words of a document.
pub fn field_error(path: &str, error: &serde_json::Error) -> DocumentError {
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
pub fn clipped(text: &str) -> String {
    const MAX_CHARS: usize = 400;
    match text.char_indices().nth(MAX_CHARS) {
        None => text.into(),
        Some((end, _)) => format!("{}…", &text[..end]),
    }
}
