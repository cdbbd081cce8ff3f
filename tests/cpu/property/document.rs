//! Documents: what is written is read back, and nothing that is read is out of range.

use mandelight::scene::document::{from_json, to_json, to_json_compact};
use mandelight_test_support::scenes::scene;
use proptest::{collection::vec, prelude::*, sample::Index};
use serde_json::{Value, json};

/// Values that a field may be given by mistake or malice.
fn junk() -> impl Strategy<Value = Value> {
    prop_oneof![
        Just(Value::Null),
        any::<bool>().prop_map(Value::from),
        any::<i64>().prop_map(Value::from),
        any::<f64>().prop_map(|v| json!(v)),
        prop_oneof![Just(1e308), Just(-1.0), Just(0.0), Just(5e-324)].prop_map(|v: f64| json!(v)),
        "[-0-9eE.]{0,12}".prop_map(Value::from),
        ".{0,8}".prop_map(Value::from),
        vec(any::<f32>().prop_map(|v| json!(v)), 0..5).prop_map(Value::from),
        Just(json!([])),
        Just(json!({})),
        Just(json!({ "power": 8 })),
    ]
}

/// The JSON pointers of every value below `value`.
fn pointers(value: &Value, here: &str, found: &mut Vec<String>) {
    found.push(here.to_owned());
    match value {
        Value::Object(fields) => {
            fields.iter().for_each(|(key, v)| pointers(v, &format!("{here}/{key}"), found))
        }
        Value::Array(list) => {
            list.iter().enumerate().for_each(|(i, v)| pointers(v, &format!("{here}/{i}"), found))
        }
        _ => {}
    }
}

/// Reads `text`. Whatever comes of it must be usable: a valid scene that survives another
/// round, or an error with something to say.
fn read(text: &str) {
    match from_json(text) {
        Ok(scene) => {
            scene.validate().unwrap();
            assert_eq!(from_json(&to_json(&scene)), Ok(scene));
        }
        Err(error) => assert!(error.to_string().len() > 10, "{error}"),
    }
}

proptest! {
    #[test]
    fn what_is_written_is_read_back(scene in scene()) {
        scene.validate().unwrap();
        prop_assert_eq!(from_json(&to_json(&scene)), Ok(scene.clone()));
        prop_assert_eq!(from_json(&to_json_compact(&scene)), Ok(scene));
    }

    #[test]
    fn any_text_is_read_or_refused(bytes in vec(any::<u8>(), 0..200)) {
        read(&String::from_utf8_lossy(&bytes));
    }

    #[test]
    fn any_json_is_read_or_refused(text in "[\\[\\]{}\",:0-9a-z .-]{0,80}") {
        read(&format!("{{\"mandelight\":\"scene\",\"version\":1,\"scene\":{text}}}"));
    }

    #[test]
    fn a_document_with_other_bytes_is_read_or_refused(
        scene in scene(),
        changes in vec((any::<Index>(), any::<u8>()), 1..4),
    ) {
        let mut bytes = to_json(&scene).into_bytes();
        for (at, byte) in changes {
            let at = at.index(bytes.len());
            match byte % 3 {
                0 => bytes[at] = byte,
                1 => { bytes.remove(at); }
                _ => bytes.insert(at, byte),
            }
        }
        read(&String::from_utf8_lossy(&bytes));
    }

    #[test]
    fn a_document_with_another_value_is_read_or_refused_by_name(
        scene in scene(), at in any::<Index>(), junk in junk(),
    ) {
        let mut document: Value = serde_json::from_str(&to_json(&scene)).unwrap();
        let mut paths = Vec::new();
        pointers(&document["scene"], "/scene", &mut paths);
        let pointer = at.get(&paths);
        *document.pointer_mut(pointer).unwrap() = junk;
        let text = document.to_string();
        read(&text);
        if let Err(error) = from_json(&text) {
            // The message begins with a field on the way to the value or below it.
            let part = pointer.split('/').nth(2).unwrap_or("");
            prop_assert!(error.to_string().starts_with(part), "{} for {}", error, pointer);
        }
    }
}
