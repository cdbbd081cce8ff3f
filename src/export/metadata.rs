//! What the readers of scene documents in pictures share.

/// The name under which a picture stores its scene document.
pub const SCENE_KEYWORD: &str = "mandelight";

/// Maximum size of a scene document in a picture, in bytes after unpacking.
pub const MAX_TEXT_BYTES: usize = 1 << 20;

/// Longest start of a picture that has its size and its scene, in bytes: a text may be stored less compactly.
pub const MAX_HEADER_BYTES: usize = 8 * MAX_TEXT_BYTES;

/// Why the scene document of a picture could not be read.
#[derive(Debug, PartialEq, Eq, thiserror::Error)]
pub enum SceneTextError {
    /// The file is not of the named format, or is damaged.
    #[error("not a readable {format}: {reason}")]
    Unreadable {
        /// The format's name.
        format: &'static str,
        /// What is wrong with the file.
        reason: String,
    },
    /// The document is larger than [`MAX_TEXT_BYTES`], or than the decoder's limit.
    #[error("its text is larger than {MAX_TEXT_BYTES} bytes")]
    TooLarge,
}

impl SceneTextError {
    /// The error of a file that is not of a format, or is damaged.
    pub(super) fn unreadable(format: &'static str, reason: impl ToString) -> Self {
        Self::Unreadable { format, reason: reason.to_string() }
    }
}

/// `text`, if it is within [`MAX_TEXT_BYTES`].
///
/// # Errors
/// [`SceneTextError::TooLarge`] otherwise.
pub(super) fn capped(text: String) -> Result<String, SceneTextError> {
    if text.len() > MAX_TEXT_BYTES { Err(SceneTextError::TooLarge) } else { Ok(text) }
}
