//! The cost of reading grows with the length of the input, not with its square.
//!
//! Each kind of list is read at three lengths, 1 : 2 : 4, the last of which is the most that is read, or near it.

use std::{
    cell::Cell,
    io::{self, Cursor, Read, Seek, SeekFrom},
    rc::Rc,
    sync::MutexGuard,
};

use mandelight::{
    formula::own,
    scene::{
        MAX_LIGHTS,
        document::{limits::MAX_DEPTH, project_from_json},
        environment_map::decode::{MAX_CHANNELS, decode_file},
        gallery::{Gallery, MAX_PICTURES},
        gradient,
    },
};
use mandelight_fuzzing::OPENEXR_COMPRESSIONS;

use super::{
    alone,
    documents::{document, long_light},
    measured,
    pictures::{exr_file, exr_rows, largest_radiance},
};

/// Bytes by which the growth may differ: buffers that double, and messages.
const SLACK_BYTES: isize = 1 << 10;

/// Reads inputs of a quarter, a half and all of `most` entries, and compares how the bytes allocated grow.
///
/// Linear growth doubles from one step to the next, quadratic growth quadruples; two and a half times is the limit.
/// With a `refusal`, every input is refused with a message that contains it; without, every input is read.
fn grows_linearly<I, T, E: ToString>(
    alone: &MutexGuard<'static, ()>,
    (what, most): (&str, usize),
    input: impl Fn(usize) -> I,
    read: impl Fn(&I) -> Result<T, E>,
    refusal: Option<&str>,
) {
    let measured_once = |count: usize| {
        let input = input(count);
        let (result, total) = measured(alone, || read(&input));
        let message = result.err().map(|error| error.to_string());
        match (&message, refusal) {
            (None, None) => {}
            (Some(message), Some(part)) if message.contains(part) => {}
            _ => panic!("{what}: {count}: {message:?} instead of {refusal:?}"),
        }
        total as isize
    };
    // The least of three: the harness allocates where another test ends.
    let least = |count| (0..3).map(|_| measured_once(count)).min().unwrap_or_default();
    let totals @ [quarter, half, all] = [most / 4, most / 2, most].map(least);
    assert!(
        2 * (all - half) <= 5 * (half - quarter) + SLACK_BYTES,
        "{what}: {totals:?} bytes allocated for a quarter, a half and all of {most}"
    );
}

/// Makes the entry of a list that has this index.
type Entry = fn(usize) -> String;

#[test]
fn lists_of_documents() {
    let alone = alone();
    let stop = |i: usize| format!("{{\"position\":0.{i:03},\"color\":[0.125,0.25,0.5]}}");
    let direction = |_| "{\"direction\":[0.6,0.8,0.0],\"intensity\":1.25}".to_owned();
    let lists: [(_, Entry, _, _); 5] = [
        ("lights.point", |_| long_light(), "{\"lights\":{\"environment\":[],\"point\":[", "]}}"),
        ("lights.environment", direction, "{\"lights\":{\"environment\":[", "]}}"),
        (
            "lights.rig.picture.lights",
            |_| "{\"direction\":[0.6,0.8,0.0],\"strength\":[1.25,0.5,0.125]}".to_owned(),
            "{\"lights\":{\"rig\":{\"picture\":{\"name\":\"a\",\"lights\":[",
            "]}}}}",
        ),
        ("surface.gradient", stop, "{\"surface\":{\"gradient\":[", "]}}"),
        (
            "surface.second_layer.gradient",
            stop,
            "{\"surface\":{\"second_layer\":{\"gradient\":[",
            "]}}}",
        ),
    ];
    for (what, entry, first, last) in &lists {
        let text = |count: usize| {
            let entries: Vec<String> = (0..count).map(entry).collect();
            document(&format!("{first}{}{last}", entries.join(",")), "{}")
        };
        grows_linearly(&alone, (what, MAX_LIGHTS), text, |text| project_from_json(text), None);
    }
}

#[test]
fn depths_of_documents() {
    let alone = alone();
    let nested = |depth: usize| {
        let lists = depth - 2;
        document(&format!("{{\"x\":{}1{}}}", "[".repeat(lists), "]".repeat(lists)), "{}")
    };
    let read = |text: &String| project_from_json(text);
    grows_linearly(&alone, ("depth", MAX_DEPTH), nested, read, Some("unknown field `x`"));
    grows_linearly(
        &alone,
        ("more depth", 120),
        |n| nested(n + 5),
        read,
        Some("nested more than 32 deep"),
    );
    grows_linearly(&alone, ("great depth", 400_000), nested, read, Some("nested more than 32"));
}

/// Texts differ, so that each is compiled.
#[test]
fn formulas() {
    let alone = alone();
    let number = Cell::new(0);
    let text = |step: &str| {
        number.set(number.get() + 1);
        format!(
            "name \"G{}\"; about \"x\"; bailout 10; step {{ {step} z = z + c; }} estimate linear;",
            number.get()
        )
    };
    let read = |text: &String| own::of_text(text);
    let repeated = |statement: &'static str| move |count: usize| statement.repeat(count);
    let statements = repeated("z = sin(z) * 1.01 + c; ");
    grows_linearly(&alone, ("statements", 48), |n| text(&statements(n)), read, None);
    let comments = repeated("// a\n");
    grows_linearly(&alone, ("comments", 1600), |n| text(&comments(n)), read, None);
}

/// Brackets as deep as they may be. Buffers double at these sizes, so the total is bounded instead of its growth.
#[test]
fn nested_formulas() {
    let alone = alone();
    for (open, close) in [("(", ")"), ("-(", ")"), ("sin(", ")"), ("abs(1.5 + ", ")")] {
        let nested = format!("{}z{}", open.repeat(30), close.repeat(30));
        let text = format!(
            "name \"N\"; about \"x\"; bailout 10; step {{ z = {nested} + c; }} estimate linear;"
        );
        let (result, total) = measured(&alone, || own::of_text(&text));
        result.unwrap_or_else(|error| panic!("{nested}: {error}"));
        assert!(total < 2 << 20, "{open}: {total} bytes");
    }
}

#[test]
fn lists_of_galleries() {
    let alone = alone();
    let text = |count: usize| {
        let picture = |i| format!("{{\"file\":\"{i:03}{}.png\"}}", "a".repeat(190));
        let pictures: Vec<String> = (0..count).map(picture).collect();
        format!(
            "{{\"mandelight\":\"gallery\",\"version\":1,\"pictures\":[{}]}}",
            pictures.join(",")
        )
    };
    grows_linearly(&alone, ("pictures", MAX_PICTURES), text, |text| Gallery::from_json(text), None);
}

#[test]
fn gradient_files() {
    let alone = alone();
    let lines = |first: &'static str, line: fn(usize, usize) -> String| {
        move |count: usize| {
            format!("{first}{}", (0..count).map(|i| line(i, count)).collect::<String>())
        }
    };
    let color = |i: usize, _| format!("{} {} {}\n", i % 256, i * 7 % 256, i * 31 % 256);
    let segment = |i: usize, count: usize| {
        let [from, to] = [i, i + 1].map(|i| i as f64 / count as f64);
        format!("{from} {} {to} {} 0 0 1 0 {} 1 1 0 0\n", 0.5 * (from + to), i % 2, (i + 1) % 2)
    };
    let gradient =
        |i: usize, _| format!("g{i} {{\ngradient:\n index=0 color=255\n index=200 color={i}\n}}\n");
    let read = |text: &String| gradient::read(text.as_bytes(), "a");
    grows_linearly(&alone, ("palette", 4096), lines("GIMP Palette\n", color), read, None);
    grows_linearly(&alone, ("map", 256), lines("", color), read, None);
    grows_linearly(&alone, ("segments", 1000), lines("GIMP Gradient\n1000\n", segment), read, None);
    grows_linearly(&alone, ("gradients", 1000), lines("", gradient), read, None);
    grows_linearly(
        &alone,
        ("comments", 1 << 20),
        lines("GIMP Palette\n1 2 3\n", |_, _| "#\n".to_owned()),
        read,
        None,
    );
}

#[test]
fn channels_of_openexr() {
    let alone = alone();
    let file = |count: usize| exr_rows([4, 4], count, false);
    let read = |bytes: &Vec<u8>| decode_file("a", Cursor::new(bytes));
    grows_linearly(&alone, ("channels", MAX_CHANNELS), file, read, None);
}

/// Counts the bytes that are read.
struct Counting<'a> {
    file: Cursor<&'a [u8]>,
    count: Rc<Cell<u64>>,
}

impl Read for Counting<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let read = self.file.read(buffer)?;
        self.count.set(self.count.get() + read as u64);
        Ok(read)
    }
}

impl Seek for Counting<'_> {
    fn seek(&mut self, position: SeekFrom) -> io::Result<u64> {
        self.file.seek(position)
    }
}

/// Decodes a file; returns whether it is read, and how many of its bytes were, some perhaps twice.
fn counted(bytes: &[u8]) -> (Result<(), String>, u64) {
    let count = Rc::default();
    let file = Counting { file: Cursor::new(bytes), count: Rc::clone(&count) };
    let result = decode_file("a", file);
    (result.map(drop).map_err(|error| error.to_string()), count.get())
}

#[test]
fn files_of_environment_maps_are_read_once() {
    let _alone = alone();
    let compressions = OPENEXR_COMPRESSIONS.map(|way| exr_file([64, 64], way));
    let others = [largest_radiance(), exr_rows([64, 64], 3, false)];
    for bytes in compressions.into_iter().chain(others) {
        let (result, count) = counted(&bytes);
        result.expect("a picture");
        // The signature is read twice.
        assert!(count <= bytes.len() as u64 + 8, "{count} of {} bytes", bytes.len());
    }
    // Blocks that share their bytes: 164 KB that would be read as 400 MB.
    let bytes = exr_rows([8192, 4096], 3, true);
    let (result, count) = counted(&bytes);
    assert!(result.expect_err("refused").contains("blocks of pixels overlap"));
    assert!(count < 2 * bytes.len() as u64, "{count} of {} bytes", bytes.len());
}
