//! What several targets promise.

use mandelight::{
    export::MAX_TEXT_BYTES,
    reading::visible,
    scene::{Project, document},
};

use crate::Outcome;

/// Longest message, in characters.
const MAX_MESSAGE_CHARS: usize = 1000;

/// A message for the user is short, and no terminal obeys a part of it.
pub fn refused(message: &impl ToString) -> Outcome {
    let message = message.to_string();
    assert!(!message.is_empty(), "an error without a message");
    assert!(message.chars().count() <= MAX_MESSAGE_CHARS, "a message is long: {message:.300}");
    let shown = visible(&message);
    assert_eq!(shown, message, "a message has control characters");
    Outcome::Refused
}

/// A project that was read is valid, and comes back from both of its documents.
pub fn project_holds(project: &Project) {
    project.scene.validate().expect("the scene is valid");
    project.path.validate().expect("the path is valid");
    for key in &project.path.keys {
        key.scene.validate().expect("a key's scene is valid");
    }
    for text in [document::project_to_json(project), document::project_to_json_compact(project)] {
        let again = document::project_from_json(&text).expect("what is written is read");
        assert_eq!(again, *project, "written and read again, the project is another");
    }
    // Three frames are scenes between the keys.
    let count = project.path.frame_count();
    for frame in [0, count / 2, count.saturating_sub(1)] {
        if let Some(scene) = project.path.frame(frame) {
            scene.validate().expect("a frame of the path is valid");
        }
    }
}

/// The result of a picture's reader: a text is within the limit, and a document in it holds.
///
/// `write` makes a picture of one pixel with a text, and `read` reads the text of one.
pub fn picture_text(
    text: Option<Result<Option<String>, String>>,
    write: impl FnOnce(&str) -> Vec<u8>,
    read: impl FnOnce(&[u8]) -> Option<String>,
) -> Outcome {
    match text {
        None => Outcome::Refused,
        Some(Err(message)) => refused(&message),
        Some(Ok(None)) => Outcome::Read,
        Some(Ok(Some(text))) => {
            assert!(text.len() <= MAX_TEXT_BYTES, "a text of {} bytes", text.len());
            match document::project_from_json(&text) {
                Ok(project) => {
                    project_holds(&project);
                    let written = document::project_to_json_compact(&project);
                    assert_eq!(read(&write(&written)), Some(written), "the picture's text");
                }
                Err(error) => {
                    refused(&error);
                }
            }
            Outcome::Read
        }
    }
}
