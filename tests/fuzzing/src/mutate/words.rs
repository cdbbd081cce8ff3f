//! Changes of texts, word by word.

use fastrand::Rng;

use super::{bytes, few, index, reordered};

/// Words that readers of numbers and names may stumble over.
pub const WORDS: [&str; 30] = [
    "0",
    "-0",
    "-1",
    "1",
    "2",
    "0.5",
    "1e-320",
    "1e308",
    "-1e308",
    "1e999",
    "NaN",
    "inf",
    "-inf",
    "255",
    "256",
    "65536",
    "2147483647",
    "2147483648",
    "-2147483649",
    "4294967296",
    "18446744073709551616",
    "1e-2147483648",
    "0x10",
    "",
    "\u{1b}[2J",
    "\u{202e}",
    "é木🙂",
    "\u{0}",
    "aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa",
    "((((((((((((((((((((((((((((((((((((((((",
];

/// `input` with one to four words changed.
pub fn mutated(rng: &mut Rng, input: &[u8], other: &[u8]) -> Vec<u8> {
    let (Ok(text), Ok(other_text)) = (str::from_utf8(input), str::from_utf8(other)) else {
        return bytes::mutated(rng, input, other);
    };
    let (mut words, others) = (split(text), split(other_text));
    for _ in 0..few(rng) {
        if reordered(rng, &mut words, &others) {
            let word = WORDS[index(rng, WORDS.len())];
            let at = rng.usize(..=words.len());
            if rng.bool() && at < words.len() {
                words[at] = word;
            } else {
                words.insert(at, word);
            }
        }
    }
    words.concat().into_bytes()
}

/// The words of a text: names and numbers, runs of spaces, single other letters.
fn split(text: &str) -> Vec<&str> {
    let kind = |letter: char| match letter {
        letter if letter.is_alphanumeric() || "._".contains(letter) => 0,
        ' ' | '\t' => 1,
        _ => 2,
    };
    let mut words = Vec::new();
    let mut start = 0;
    let mut letters = text.char_indices().peekable();
    while let Some((_, letter)) = letters.next() {
        let end = letters.peek().map_or(text.len(), |&(at, _)| at);
        let goes_on = letters.peek().is_some_and(|&(_, next)| kind(next) == kind(letter));
        if kind(letter) == 2 || !goes_on {
            words.push(&text[start..end]);
            start = end;
        }
    }
    words
}
