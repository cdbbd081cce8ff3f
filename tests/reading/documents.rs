//! Documents and links.

use base64::{Engine as _, engine::general_purpose::URL_SAFE_NO_PAD};
use mandelight::{
    formula::own::MAX_IN_DOCUMENT,
    scene::{
        document::{MAX_BYTES as MAX_DOCUMENT_BYTES, project_from_json},
        link::{MAX_FRAGMENT_BYTES, MAX_INFLATED_BYTES, project_from_fragment},
    },
};

use super::{alone, measured};

/// A document with this text in place of its scene and path.
pub fn document(scene: &str, path: &str) -> String {
    format!("{{\"mandelight\":\"scene\",\"version\":2,\"scene\":{scene},\"path\":{path}}}")
}

/// As many repetitions of `entry`, after `first`, as a document of the largest size has room for.
fn filled(first: &str, entry: &str) -> String {
    let count = (MAX_DOCUMENT_BYTES - 500 - first.len()) / entry.len();
    format!("{first}{}", entry.repeat(count))
}

/// The longest light: 90 digits in each coordinate.
pub fn long_light() -> String {
    let digits = format!("\"0.{}\"", "1".repeat(89));
    format!("{{\"position\":[{digits},{digits},{digits}]}}")
}

/// Lists of every kind, as long as a document has room for, are refused within the memory limit.
#[test]
fn endless_lists_are_refused_before_they_are_in_memory() {
    let stop = ",{\"position\":0.5,\"color\":[0,0,0]}";
    let light = format!(",{}", long_light());
    let alone = alone();
    let scene =
        |first: &str, list: &str, last: &str| document(&format!("{first}[{list}]{last}"), "{}");
    let keys = |list: &str| document("{}", &format!("{{\"keys\":[{list}]}}"));
    let texts: [&dyn Fn() -> String; 12] = [
        &|| scene("{\"lights\":{\"point\":", &filled("{}", ",{}"), "}}"),
        &|| scene("{\"lights\":{\"environment\":", &filled("{}", ",{}"), "}}"),
        &|| scene("{\"lights\":{\"point\":", &filled("{}", &light), "}}"),
        &|| scene("{\"surface\":{\"gradient\":", &filled(&stop[1..], stop), "}}"),
        &|| scene("{\"fractal\":{\"section_planes\":", &filled("{}", ",{}"), "}}"),
        &|| scene("{\"fractal\":{\"julia_constant\":", &filled("0", ",0"), "}}"),
        &|| scene("{\"x\":", &filled("{}", ",{}"), "}"),
        &|| document(&format!("{{\"fractal\":{{\"power\":{}}}}}", filled("1", "1")), "{}"),
        &|| keys(&filled("[0]", ",[0]")),
        &|| keys(&filled("{\"time_secs\":0}", ",{\"time_secs\":0}")),
        &|| document("{}", "{}").replace(":2", &format!(":[{}]", filled("0", ",0"))),
        &|| document("{}", "{}").replace("\"scene\",", &format!("[{}],", filled("{}", ",{}"))),
    ];
    for text in texts {
        let text = text();
        assert!(text.len() <= MAX_DOCUMENT_BYTES && text.len() > MAX_DOCUMENT_BYTES / 2);
        let (result, total) = measured(&alone, || project_from_json(&text));
        let shown: String = text.chars().take(90).collect();
        let error = result.expect_err(&shown).to_string();
        assert!(!error.is_empty() && error.len() < 1000, "{shown}: {error}");
        // A long number is copied while the reader's buffer grows; no list is kept.
        assert!(total < 48 << 20, "{shown}: {total} bytes in all");
    }
}

/// A link of the longest JSON that it may unpack to.
#[test]
fn a_short_link_cannot_unpack_to_much_work() {
    let alone = alone();
    for (first, entry, last) in [
        ("{\"path\":{\"keys\":[[0]", ",[0]", "]}}"),
        ("{\"path\":{\"keys\":[{\"time_secs\":0}", ",{\"time_secs\":1}", "]}}"),
        ("{\"lights\":{\"point\":[{}", ",{}", "]}}"),
        ("{\"x\":[{}", ",{}", "]}"),
        ("{\"path\":[{}", ",{}", "]}"),
        ("[{}", ",{}", "]"),
    ] {
        let count = (MAX_INFLATED_BYTES - first.len() - last.len()) / entry.len();
        let json = format!("{first}{}{last}", entry.repeat(count));
        let deflated = miniz_oxide::deflate::compress_to_vec(json.as_bytes(), 10);
        let link = format!("s1={}", URL_SAFE_NO_PAD.encode(deflated));
        assert!(link.len() < MAX_FRAGMENT_BYTES, "{} characters", link.len());
        let (result, total) = measured(&alone, || project_from_fragment(&link));
        let error = result.expect_err(&json[..40]).to_string();
        assert!(error.starts_with("the link's scene: "), "{error}");
        // The text itself, while its buffer grows, and little more.
        assert!(total < 6 * MAX_INFLATED_BYTES, "{first}: {total} bytes in all");
    }
}

/// A full path over a full scene: its memory is that of its scenes, and grows with the number of keys.
#[test]
fn the_cost_of_a_path_is_linear_in_its_keys() {
    let alone = alone();
    let lights = vec![long_light(); 64].join(",");
    let scene = format!("{{\"lights\":{{\"environment\":[],\"point\":[{lights}]}}}}");
    let read = |count: usize, part: &str| {
        let key = |i| format!("{{\"time_secs\":{i},\"scene\":{{{part}}}}}");
        let keys: Vec<String> = (0..count).map(key).collect();
        let text = document(&scene, &format!("{{\"keys\":[{}]}}", keys.join(",")));
        let (project, total) = measured(&alone, || project_from_json(&text));
        assert_eq!(project.expect("a valid path").path.keys.len(), count);
        total
    };
    let all_lights = scene[1..scene.len() - 1].to_owned();
    for part in ["", "\"tone\":{}", &all_lights] {
        let [none, some, many, most] = [1, 64, 128, 256].map(|count| read(count, part));
        let (first, second) = (many - some, most - many);
        assert!(second < 3 * first, "{part:.20}: {some}, {many}, {most} bytes");
        if part.is_empty() {
            // Keys that name nothing share the document's scene, but each is checked.
            assert!(most - none < 16 << 20, "{none}, {most} bytes");
        }
    }
}

/// The largest formulas, as many as a document may bring: they stay in memory as long as the program.
#[test]
fn many_large_formulas_stay_within_the_limit() {
    let alone = alone();
    let formula = |i: usize| {
        let term = " z = box_fold(z, 1.5) * 1.01 + sin(z) * cos(z) * 0.1;";
        let step = format!("{}z = z + c;", term.repeat(16));
        format!("name \"F{i}\"; about \"x\"; bailout 10; step {{ {step} }} estimate linear;")
    };
    let step = |i| serde_json::json!({ "formula": { "text": formula(i) } });
    let key = |key: usize| {
        let steps = [step(2 * key), step(2 * key + 1)];
        let fractal = serde_json::json!({ "formula": "hybrid", "steps": steps });
        serde_json::json!({ "time_secs": key, "scene": { "fractal": fractal } })
    };
    let text = |keys: std::ops::Range<usize>| {
        let keys: Vec<_> = keys.map(key).collect();
        document("{}", &serde_json::json!({ "keys": keys }).to_string())
    };
    let all = text(0..MAX_IN_DOCUMENT / 2);
    let (result, _) = measured(&alone, || project_from_json(&all));
    assert_eq!(result.expect("a valid path").path.keys.len(), MAX_IN_DOCUMENT / 2);
    let more = text(MAX_IN_DOCUMENT / 2..MAX_IN_DOCUMENT + 1);
    let (result, _) = measured(&alone, || project_from_json(&more));
    let error = result.expect_err("too many").to_string();
    assert!(error.contains("a document may bring 64 formulas"), "{error}");
}
