//! Looks of any scene: what they change, and what they leave.

use mandelight::scene::{Scene, looks};
use mandelight_test_support::scenes::scene;
use proptest::prelude::*;
use serde_json::Value;

/// Paths of a document that the looks of each list may change.
const OWNED: [(&str, &[&str]); 5] = [
    ("Look", &["surface.", "medium.kind", "lights.", "background.", "fog.", "tone.", "bloom."]),
    ("Colours", &["surface.gradient"]),
    ("Light", &["lights."]),
    ("Background", &["background."]),
    ("Tone", &["tone.", "bloom."]),
];

/// Paths within these that stay.
const KEPT: &[&str] = &["surface.coloring.", "surface.sections.", "lights.rig.picture."];

/// Adds the paths at which two documents differ. Lists are compared as a whole.
fn differences(a: &Value, b: &Value, path: &str, found: &mut Vec<String>) {
    match (a, b) {
        (Value::Object(a), Value::Object(b)) if a.keys().eq(b.keys()) => {
            for (key, value) in a {
                differences(value, &b[key], &format!("{path}{key}."), found);
            }
        }
        _ if a != b => found.push(path.to_owned()),
        _ => {}
    }
}

fn json(scene: &Scene) -> Value {
    serde_json::to_value(scene).unwrap()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn looks_change_the_appearance_alone_and_once(scene in scene()) {
        for list in looks::lists() {
            let (_, owned) = OWNED.iter().find(|(kind, _)| *kind == list.kind).unwrap();
            for look in &list.looks {
                let looked = looks::applied(look, &scene);
                let name = format!("{} {}", list.kind, look.name);
                prop_assert_eq!(looked.validate(), Ok(()), "{}", name);
                prop_assert_eq!(&looks::applied(look, &looked), &looked, "{} twice", name);
                let mut changed = Vec::new();
                differences(&json(&scene), &json(&looked), "", &mut changed);
                for path in changed {
                    let starts = |prefixes: &[&str]| prefixes.iter().any(|prefix| path.starts_with(prefix));
                    prop_assert!(starts(owned) && !starts(KEPT), "{} changes {}", name, path);
                }
            }
        }
    }

    #[test]
    fn a_complete_look_hides_what_the_scene_looked_like(first in scene(), second in scene()) {
        let list = &looks::lists()[0];
        for look in &list.looks {
            let [a, b] = [&first, &second].map(|scene| looks::applied(look, scene));
            prop_assert_eq!(a.background, b.background);
            prop_assert_eq!((a.fog, a.tone, a.bloom), (b.fog, b.tone, b.bloom));
            prop_assert_eq!(a.lights.environment, b.lights.environment);
            prop_assert_eq!(a.surface.gradient, b.surface.gradient);
            prop_assert_eq!(a.surface.second_layer, b.surface.second_layer);
        }
    }
}
