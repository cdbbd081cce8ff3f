//! The words of a text for an editor: their kinds, and completions of a word that is being typed.
//!
//! In: any text, right or wrong. Out: tokens that together are the text.

use super::{
    functions::{FUNCTIONS, Function},
    scope::RESERVED,
    tree::Span,
};

/// Words of declarations and statements; each is a keyword of `grammar.pest`.
pub const KEYWORDS: &[&str] = &[
    "about",
    "bailout",
    "bound",
    "checked",
    "color",
    "degrees",
    "distance",
    "estimate",
    "false",
    "from",
    "help",
    "init",
    "iterations",
    "label",
    "let",
    "linear",
    "log",
    "logarithmic",
    "march",
    "name",
    "none",
    "param",
    "size",
    "source",
    "state",
    "step",
    "to",
    "true",
    "vec3",
    "vec4",
    "whole",
];

/// What a token is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TokenKind {
    /// A comment, to the end of its line.
    Comment,
    /// A text in double quotes.
    Text,
    /// A number.
    Number,
    /// A word of declarations.
    Keyword,
    /// A function of the language.
    Function,
    /// A name that means something in every step, such as `z`.
    BuiltIn,
    /// Another name.
    Name,
    /// Anything else.
    Other,
}

/// The tokens of `text` in order: their spans follow each other from its start to its end.
pub fn tokens(text: &str) -> Vec<(TokenKind, Span)> {
    let mut found: Vec<(TokenKind, Span)> = Vec::new();
    let mut start = 0;
    while let Some(first) = text[start..].chars().next() {
        let rest = &text[start..];
        let length_while =
            |is_part: &dyn Fn(char) -> bool| rest.find(|c| !is_part(c)).unwrap_or(rest.len());
        let (kind, length) = if rest.starts_with("//") {
            (TokenKind::Comment, length_while(&|c| c != '\n'))
        } else if first == '"' {
            let inside = &rest[1..];
            let end = inside.find(['"', '\n']).unwrap_or(inside.len());
            let closing = usize::from(inside[end..].starts_with('"'));
            (TokenKind::Text, 1 + end + closing)
        } else if first.is_ascii_digit() {
            (TokenKind::Number, length_while(&|c| c.is_ascii_alphanumeric() || c == '.'))
        } else if is_letter(first) {
            let length = length_while(&is_letter);
            let after = rest[length..].trim_start();
            (kind_of(&rest[..length], after.starts_with('(')), length)
        } else {
            (TokenKind::Other, first.len_utf8())
        };
        let span = Span { start, end: start + length };
        match found.last_mut() {
            Some((TokenKind::Other, last)) if kind == TokenKind::Other => last.end = span.end,
            _ => found.push((kind, span)),
        }
        start += length;
    }
    found
}

fn is_letter(c: char) -> bool {
    c.is_ascii_alphanumeric() || c == '_'
}

fn kind_of(word: &str, is_called: bool) -> TokenKind {
    if is_called && FUNCTIONS.iter().any(|function| function.name == word) {
        TokenKind::Function
    } else if KEYWORDS.contains(&word) {
        TokenKind::Keyword
    } else if RESERVED.contains(&word) {
        TokenKind::BuiltIn
    } else {
        TokenKind::Name
    }
}

/// A word that could stand at a place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Completion {
    /// The whole word.
    pub word: String,
    /// What the word is.
    pub help: String,
}

/// The word that ends at the byte `cursor`, and what it could become: names of the text first, at most `most`.
///
/// None without a word there, inside comments and quotes, and if the word is complete.
pub fn completions(text: &str, cursor: usize, most: usize) -> Option<(Span, Vec<Completion>)> {
    let tokens = tokens(text);
    let &(kind, span) =
        tokens.iter().find(|(_, span)| span.start < cursor && cursor <= span.end)?;
    let is_word = !matches!(
        kind,
        TokenKind::Comment | TokenKind::Text | TokenKind::Number | TokenKind::Other
    );
    if !is_word {
        return None;
    }
    let begun = &text[span.start..cursor];
    let mut found: Vec<Completion> = Vec::new();
    let mut add = |word: &str, help: String| {
        let is_new = found.iter().all(|other| other.word != word);
        if is_new && word != begun && word.starts_with(begun) {
            found.push(Completion { word: word.to_owned(), help });
        }
    };
    let names = tokens.iter().filter(|(kind, other)| *kind == TokenKind::Name && *other != span);
    for (_, name) in names {
        add(&text[name.start..name.end], "A name in this formula".to_owned());
    }
    FUNCTIONS.iter().for_each(|function| add(function.name, signature(function)));
    KEYWORDS.iter().for_each(|word| add(word, "A keyword".to_owned()));
    found.truncate(most);
    let replaced = Span { start: span.start, end: cursor };
    (!found.is_empty()).then_some((replaced, found))
}

/// A function as the docs show it.
fn signature(function: &Function) -> String {
    let arguments: Vec<_> = function.arguments.iter().map(|(name, _)| *name).collect();
    format!("{}({}): {}", function.name, arguments.join(", "), function.help)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formula;

    fn kinds(text: &str) -> Vec<(TokenKind, &str)> {
        let tokens = tokens(text).into_iter();
        tokens.map(|(kind, span)| (kind, &text[span.start..span.end])).collect()
    }

    #[test]
    fn tokens_are_the_text_and_have_their_kinds() {
        let text = "name \"A\"; // note\nstep { z = abs(z) * 2.5e1 + röd; }";
        let kinds = kinds(text);
        assert_eq!(kinds.iter().map(|(_, part)| *part).collect::<String>(), text);
        for expected in [
            (TokenKind::Keyword, "name"),
            (TokenKind::Text, "\"A\""),
            (TokenKind::Comment, "// note"),
            (TokenKind::BuiltIn, "z"),
            (TokenKind::Function, "abs"),
            (TokenKind::Number, "2.5e1"),
        ] {
            assert!(kinds.contains(&expected), "{expected:?} in {kinds:?}");
        }
        for (id, text) in formula::texts().chain(formula::step_texts()) {
            let whole: String = super::tests::kinds(text).iter().map(|(_, part)| *part).collect();
            assert_eq!(whole, text, "{id}");
        }
        assert_eq!(kinds_of_odd_ends(), ["\"open", "//", "§"]);
    }

    fn kinds_of_odd_ends() -> Vec<&'static str> {
        ["\"open", "//", "§"]
            .into_iter()
            .flat_map(|text| kinds(text))
            .map(|(_, part)| part)
            .collect()
    }

    #[test]
    fn keywords_are_those_of_the_grammar() {
        let grammar = include_str!("grammar.pest");
        let quoted = |line: &str| {
            let (_, rest) = line.split_once("@{ \"")?;
            let (word, rest) = rest.split_once('"')?;
            (rest.trim() == "~ !letter }").then(|| word.to_owned())
        };
        let mut words: Vec<_> = grammar.lines().filter_map(quoted).collect();
        words.sort();
        words.dedup();
        assert_eq!(words, KEYWORDS);
    }

    #[test]
    fn completions_are_names_functions_and_keywords() {
        let text = "param scale = 1 from 0 to 2 label \"s\";\nstep { z = s; }";
        let cursor = text.rfind('s').unwrap() + 1;
        let (span, found) = completions(text, cursor, 8).unwrap();
        assert_eq!((span.start, span.end), (cursor - 1, cursor));
        let words: Vec<_> = found.iter().map(|one| one.word.as_str()).collect();
        assert_eq!(words[0], "scale");
        assert!(words.contains(&"sqrt") && !words.contains(&"s"), "{words:?}");
        // In quotes, at a space and behind a whole word there is nothing to complete.
        assert_eq!(completions(text, text.find("\"s").unwrap() + 2, 8), None);
        assert_eq!(completions(text, text.find(" =").unwrap() + 1, 8), None);
        assert_eq!(completions("step", 4, 8), None);
    }
}
