//! Changes of JSON, value by value.

use fastrand::Rng;
use serde_json::{Map, Value, json};

use super::{bytes, few, index, reordered, words::WORDS};

/// `input` with one to four values changed.
pub fn mutated(rng: &mut Rng, input: &[u8], other: &[u8]) -> Vec<u8> {
    let read = |bytes: &[u8]| serde_json::from_slice::<Value>(bytes);
    let (Ok(mut value), Ok(donor)) = (read(input), read(other)) else {
        return bytes::mutated(rng, input, other);
    };
    for _ in 0..few(rng) {
        let part = nth(&donor, rng.usize(..count(&donor))).clone();
        let at = rng.usize(..count(&value));
        change(rng, nth_mut(&mut value, at), part);
    }
    let text = value.to_string();
    match rng.u8(..8) {
        0 => raw(rng, &text).into_bytes(),
        1 => bytes::mutated(rng, text.as_bytes(), other),
        _ => text.into_bytes(),
    }
}

/// Number of values, this one included.
fn count(value: &Value) -> usize {
    1 + match value {
        Value::Array(list) => list.iter().map(count).sum(),
        Value::Object(fields) => fields.values().map(count).sum(),
        _ => 0,
    }
}

/// The value of this number, in the order of the text.
fn nth(value: &Value, mut n: usize) -> &Value {
    let children: Box<dyn Iterator<Item = &Value>> = match value {
        Value::Array(list) => Box::new(list.iter()),
        Value::Object(fields) => Box::new(fields.values()),
        _ => Box::new(std::iter::empty()),
    };
    if n == 0 {
        return value;
    }
    n -= 1;
    for child in children {
        let inside = count(child);
        if n < inside {
            return nth(child, n);
        }
        n -= inside;
    }
    value
}

fn nth_mut(value: &mut Value, mut n: usize) -> &mut Value {
    if n == 0 {
        return value;
    }
    n -= 1;
    // Found by its place first: the borrow of a child cannot end within the loop.
    let sizes: Vec<usize> = match &*value {
        Value::Array(list) => list.iter().map(count).collect(),
        Value::Object(fields) => fields.values().map(count).collect(),
        _ => Vec::new(),
    };
    let mut place = 0;
    while place + 1 < sizes.len() && n >= sizes[place] {
        n -= sizes[place];
        place += 1;
    }
    match value {
        Value::Array(list) => nth_mut(&mut list[place], n),
        Value::Object(fields) => {
            let child = fields.values_mut().nth(place);
            nth_mut(child.expect("as many values as sizes"), n)
        }
        leaf => leaf,
    }
}

fn change(rng: &mut Rng, value: &mut Value, part: Value) {
    match rng.u8(..10) {
        0 => *value = part,
        1 => *value = strange(rng),
        // Within lists and objects that nest.
        2 if rng.bool() => {
            for _ in 0..rng.usize(1..50) {
                let inner = value.take();
                *value = if rng.bool() { json!([inner]) } else { json!({ "a": inner }) };
            }
        }
        _ => match value {
            Value::Number(number) => {
                let old = number.as_f64().unwrap_or_default();
                let new = match rng.u8(..5) {
                    0 => -old,
                    1 => old * 10_f64.powi(rng.i32(-20..20)),
                    2 => old + rng.f64() * 1e-6,
                    3 => old.round() + f64::from(rng.i8(..)),
                    _ => rng.f64(),
                };
                *value = if rng.bool() { json!(new) } else { json!(new as i64) };
            }
            Value::String(text) => {
                let word = WORDS[index(rng, WORDS.len())];
                let changed = bytes::mutated(rng, text.as_bytes(), word.as_bytes());
                *text = String::from_utf8_lossy(&changed).into_owned();
            }
            Value::Array(list) => {
                if reordered(rng, list, std::slice::from_ref(&part)) {
                    list.push(part);
                }
            }
            Value::Object(fields) => change_fields(rng, fields, part),
            other => *other = if rng.bool() { json!(other != &json!(true)) } else { part },
        },
    }
}

fn change_fields(rng: &mut Rng, fields: &mut Map<String, Value>, part: Value) {
    let names: Vec<String> = fields.keys().cloned().collect();
    let Some(name) = names.get(index(rng, names.len())).cloned() else {
        fields.insert(WORDS[index(rng, WORDS.len())].to_owned(), part);
        return;
    };
    match rng.u8(..4) {
        0 => {
            fields.shift_remove(&name);
        }
        1 => {
            fields.insert(name, part);
        }
        2 => {
            // A name that is wrong by a letter or by much.
            let value = fields.shift_remove(&name).unwrap_or_default();
            let new = if rng.bool() {
                format!("{name}s")
            } else {
                WORDS[index(rng, WORDS.len())].to_owned()
            };
            fields.insert(new, value);
        }
        _ => match part {
            Value::Object(more) => fields.extend(more),
            part => {
                fields.insert(name, part);
            }
        },
    }
}

/// A value that many readers do not expect.
fn strange(rng: &mut Rng) -> Value {
    match rng.u8(..8) {
        0 => Value::Null,
        1 => json!([]),
        2 => json!({}),
        3 => json!(rng.bool()),
        4 => json!(f64::MAX.powf(rng.f64() * 2.0 - 1.0)),
        5 => json!(rng.i64(..)),
        6 => json!(u64::MAX),
        _ => json!(WORDS[index(rng, WORDS.len())]),
    }
}

/// A text with a number or a name as no writer writes one.
fn raw(rng: &mut Rng, text: &str) -> String {
    let is_digit = |(_, byte): &(usize, u8)| byte.is_ascii_digit();
    let places: Vec<usize> = text.bytes().enumerate().filter(is_digit).map(|(at, _)| at).collect();
    let new = [
        "1e999",
        "-",
        "00",
        "1e-999",
        "1E+5",
        ".5",
        "9007199254740993",
        "123456789012345678901234567890",
    ];
    match places.get(index(rng, places.len())) {
        Some(&at) if rng.bool() => {
            format!("{}{}{}", &text[..at], new[index(rng, new.len())], &text[at + 1..])
        }
        // Every field twice.
        _ => match (text.find('{'), text.rfind('}')) {
            (Some(start), Some(end)) if start < end => {
                let inside = &text[start + 1..end];
                format!("{}{inside},{inside}{}", &text[..=start], &text[end..])
            }
            _ => text.to_owned(),
        },
    }
}
