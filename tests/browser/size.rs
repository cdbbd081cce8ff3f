//! The page's size: what a first visit downloads before it can draw.

use std::{ffi::OsStr, fs, path::PathBuf};

use miniz_oxide::deflate::compress_to_vec;

/// Most bytes of the page's WebAssembly, compressed as by a host; the README names them in MB.
const MOST_BYTES: usize = 2_900_000;

/// The level of compression that hosts have unless they are told otherwise.
const LEVEL: u8 = 6;

#[test]
fn the_page_is_within_its_size() {
    let dist = PathBuf::from(std::env::var_os("MANDELIGHT_DIST").expect("the built page"));
    let files = fs::read_dir(dist).unwrap().map(|entry| entry.unwrap().path());
    let is_module = |file: &PathBuf| file.extension() == Some(OsStr::new("wasm"));
    let sizes: Vec<_> = files
        .filter(is_module)
        .map(|file| compress_to_vec(&fs::read(file).unwrap(), LEVEL).len())
        .collect();
    let bytes: usize = sizes.iter().sum();
    println!("{bytes} bytes of {} modules", sizes.len());
    assert!(bytes > 1_000_000, "no module is there: {sizes:?}");
    assert!(bytes <= MOST_BYTES, "{bytes} bytes, more than {MOST_BYTES}");
    let limit = format!("at most {:.1} MB", MOST_BYTES as f64 / 1e6);
    assert!(include_str!("../../README.md").contains(&limit), "README.md does not say {limit}");
}
