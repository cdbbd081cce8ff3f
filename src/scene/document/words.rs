//! Errors of fields in words for people who don't know serde's.

/// The message of a field's error, without names of types; other messages stay as they are.
pub fn plain(message: &str) -> String {
    let found =
        ["invalid type: ", "invalid value: "].iter().find_map(|it| message.strip_prefix(it));
    if let Some(rest) = found
        && let Some((found, expected)) = rest.rsplit_once(", expected ")
    {
        return format!("found {}, expected {}", value(found), kind(expected));
    }
    if let Some(rest) = message.strip_prefix("invalid length ")
        && let Some((length, expected)) = rest.split_once(", expected ")
    {
        return format!("found a list of {length}, expected {}", kind(expected));
    }
    if let Some(rest) = message.strip_prefix("unknown variant ") {
        return format!("unknown word {rest}");
    }
    message.to_owned()
}

/// A value as serde names it, such as "floating point `2.5`".
fn value(found: &str) -> String {
    match found {
        "sequence" => "a list".to_owned(),
        "map" => "an object".to_owned(),
        "null" => "null".to_owned(),
        _ => {
            let named = [
                ("floating point ", "the number "),
                ("integer ", "the number "),
                ("string ", "the text "),
                ("boolean ", ""),
            ];
            named
                .iter()
                .find_map(|(kind, plain)| Some(format!("{plain}{}", found.strip_prefix(kind)?)))
                .unwrap_or_else(|| found.to_owned())
        }
    }
}

/// What serde expects, such as "u32" or "struct Tone".
fn kind(expected: &str) -> String {
    let plain = match expected {
        "f32" | "f64" => "a number",
        "i8" | "i16" | "i32" | "i64" | "u8" | "u16" | "u32" | "u64" | "usize" => "a whole number",
        "a string" | "a borrowed string" => "a text",
        "a boolean" => "true or false",
        "a sequence" => "a list",
        "a map" => "an object",
        _ if expected.starts_with("struct ") => "an object",
        _ => {
            let length = expected.strip_prefix("an array of length ");
            return length
                .map_or_else(|| expected.to_owned(), |length| format!("a list of {length}"));
        }
    };
    plain.to_owned()
}

#[cfg(test)]
mod tests {
    use super::plain;

    #[test]
    fn messages_have_no_names_of_types() {
        for (message, expected) in [
            (
                "invalid type: floating point `2.5`, expected u32",
                "found the number `2.5`, expected a whole number",
            ),
            (
                "invalid type: string \"x, expected y\", expected f64",
                "found the text \"x, expected y\", expected a number",
            ),
            ("invalid type: sequence, expected struct Tone", "found a list, expected an object"),
            ("invalid type: boolean `true`, expected a string", "found `true`, expected a text"),
            ("invalid type: null, expected a boolean", "found null, expected true or false"),
            (
                "invalid length 2, expected an array of length 3",
                "found a list of 2, expected a list of 3",
            ),
            (
                "unknown variant `bounce`, expected `smooth` or `linear`",
                "unknown word `bounce`, expected `smooth` or `linear`",
            ),
            (
                "invalid value: string \"no_such\", expected one of `aexion`",
                "found the text \"no_such\", expected one of `aexion`",
            ),
            (
                "unknown field `powr`, expected one of `power`",
                "unknown field `powr`, expected one of `power`",
            ),
        ] {
            assert_eq!(plain(message), expected);
        }
    }
}
