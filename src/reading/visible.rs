//! Texts without control characters, for messages.

use std::{borrow::Cow, fmt::Write as _};

/// `text` on one line, each control character as an escape such as `\u{1b}`.
///
/// A terminal obeys control characters, and characters that set the direction of text reorder a line, so
/// neither may reach a message from a file, a name or a link. Everything else stays as it is.
pub fn visible(text: &str) -> Cow<'_, str> {
    if !text.contains(is_hidden) {
        return Cow::Borrowed(text);
    }
    let mut shown = String::with_capacity(text.len() + 8);
    for letter in text.chars() {
        if is_hidden(letter) {
            // Writing to a string cannot fail.
            let _ = write!(shown, "\\u{{{:x}}}", u32::from(letter));
        } else {
            shown.push(letter);
        }
    }
    Cow::Owned(shown)
}

/// As [`visible`], but for a text of several lines, which stay lines.
pub fn visible_lines(text: &str) -> Cow<'_, str> {
    if !text.contains(|letter| letter != '\n' && is_hidden(letter)) {
        return Cow::Borrowed(text);
    }
    let lines: Vec<_> = text.split('\n').map(visible).collect();
    Cow::Owned(lines.join("\n"))
}

/// Whether a character is obeyed instead of drawn: controls, line separators, directions of text.
pub fn is_hidden(letter: char) -> bool {
    letter.is_control()
        || matches!(letter, '\u{2028}' | '\u{2029}' | '\u{200e}' | '\u{200f}' | '\u{61c}')
        || matches!(letter, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn control_characters_are_escaped_and_the_rest_stays() {
        for plain in ["", "fractal.power", "Ä 木 🙂 \\u{1b}", "e\u{301}"] {
            assert!(matches!(visible(plain), Cow::Borrowed(same) if same == plain));
        }
        assert_eq!(visible("a\u{1b}[2J\u{7}"), "a\\u{1b}[2J\\u{7}");
        assert_eq!(visible("a\nb\r\tc"), "a\\u{a}b\\u{d}\\u{9}c");
        assert_eq!(visible("\u{9b}31m\u{202e}txt"), "\\u{9b}31m\\u{202e}txt");
        assert_eq!(visible_lines("a\n\u{1b}b"), "a\n\\u{1b}b");
        for code in (0..0x20).chain(0x7f..0xa0) {
            let letter = char::from_u32(code).unwrap().to_string();
            assert!(!visible(&letter).contains(char::is_control), "{code:x}");
        }
    }
}
