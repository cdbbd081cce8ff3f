//! Build of the page: from the library to the folder that a browser loads.
//!
//! In: the crate and `www/`. Out: a folder of `index.html` and files whose names contain a hash of
//! their content, so that browsers may cache these files forever; and a service worker that keeps all
//! of them for visits without a connection; and the headers with which a host should send them. All URLs are
//! relative.

use std::{
    fs,
    io::Write as _,
    path::{Path, PathBuf},
    process::Command,
};

use anyhow::{Context as _, Result, bail, ensure};
use base64::{Engine as _, prelude::BASE64_STANDARD};
use flate2::{Compression, write::GzEncoder};
use sha2::{Digest as _, Sha256};
use wasm_bindgen_cli_support::Bindgen;

use crate::{headers, icons, need, notices, shell};

/// The optimisation of the module after its compilation.
#[derive(Clone, Copy, PartialEq)]
pub enum Optimization {
    /// None: for development.
    None,
    /// By Binaryen, without debug names: for publishing.
    Binaryen,
}

/// Options of Binaryen's wasm-opt.
///
/// The features are those of Rust's wasm32 target, because the bound module does not list its
/// features. Fast maths stays off: the page's results on the CPU must equal the native program's.
///
/// Functions are sorted by their names while those are there: functions of one kind then lie within the window of
/// gzip, and the module is 4 % smaller as it is sent.
const WASM_OPT_FLAGS: [&str; 10] = [
    "-O3",
    "--reorder-functions-by-name",
    "--strip-debug",
    "--strip-producers",
    "--enable-bulk-memory",
    "--enable-nontrapping-float-to-int",
    "--enable-sign-ext",
    "--enable-mutable-globals",
    "--enable-reference-types",
    "--enable-multivalue",
];

/// The placeholder of the module's size in boot.js.
///
/// boot.js shows the download's progress, and a host that compresses does not send the size.
const SIZE_PLACEHOLDER: &str = "const WASM_BYTES = 0;";

/// The service worker, whose name stays: browsers look for new versions of the page by it.
const WORKER: &str = "service-worker.js";

/// The placeholders of the version and of its files in the service worker.
const VERSION_PLACEHOLDER: &str = "const VERSION = \"\";";
const FILES_PLACEHOLDER: &str = "const FILES = [];";

/// The muxer of videos.
const MEDIABUNNY: &str = "mediabunny.js";

/// The picture that `index.html` contains and shows first.
const OPENING: &str = "opening.jpg";

/// The licences of what the page contains, whose name has no hash: the module links to it.
pub const LICENSES: &str = "licenses.txt";

/// Hexadecimal digits of the hash in a file name: 48 bits.
const HASH_DIGITS: usize = 12;

/// Builds the folder for publishing and returns its path.
pub fn dist() -> Result<PathBuf> {
    let folder = shell::root()?.join("dist");
    build(&folder, Optimization::Binaryen)?;
    Ok(folder)
}

/// Builds the page into `folder` and deletes the old content. Needs Node.js for the bundle of Mediabunny.
pub fn build(folder: &Path, optimization: Optimization) -> Result<()> {
    need::wasm_target()?;
    need::node_packages()?;
    let bound = bind(&compile()?)?;
    bundle_mediabunny(&bound)?;
    let module = bound.join("mandelight_bg.wasm");
    if optimization == Optimization::Binaryen {
        optimise(&module)?;
    }
    let www = shell::root()?.join("www");
    let mut page = link(parts(&bound, &www)?)?;
    let worker = fs::read(www.join(WORKER)).with_context(|| format!("www/{WORKER}"))?;
    page.push(keeping(&worker, &page)?);
    let headers = headers::text(page.iter().map(|part| part.name.as_str()));
    page.push(Part { name: headers::FILE.to_owned(), bytes: headers.into_bytes() });
    write(folder, &page)?;
    print_sizes(folder, &page)
}

/// Compiles the library as a wasm module and returns its path.
fn compile() -> Result<PathBuf> {
    let target = shell::target()?;
    let mut cargo = shell::cargo()?;
    cargo.args(["rustc", "--lib", "--crate-type", "cdylib", "--profile", "web"]);
    cargo.args(["--target", need::WASM_TARGET, "--target-dir"]).arg(&target);
    shell::run(&mut cargo)?;
    Ok(target.join(need::WASM_TARGET).join("web/mandelight.wasm"))
}

/// Writes the module for browsers and its JavaScript glue, and returns their folder.
fn bind(wasm: &Path) -> Result<PathBuf> {
    let folder = shell::target()?.join("page-parts");
    clear(&folder)?;
    let mut bindgen = Bindgen::new();
    bindgen.input_path(wasm).typescript(false).omit_default_module_path(true);
    bindgen.web(true)?.generate(&folder).context("wasm-bindgen")?;
    Ok(folder)
}

/// Optimises the module with Binaryen's wasm-opt.
fn optimise(module: &Path) -> Result<()> {
    let mut node = Command::new("node");
    node.current_dir(shell::root()?).arg("node_modules/binaryen/bin/wasm-opt");
    node.args(WASM_OPT_FLAGS).arg(module).arg("-o").arg(module);
    shell::run(&mut node)
}

/// Bundles what `www/video.js` uses of Mediabunny into `folder`.
fn bundle_mediabunny(folder: &Path) -> Result<()> {
    let mut node = Command::new("node");
    node.current_dir(shell::root()?).arg("xtask/mediabunny.mjs").arg(folder.join(MEDIABUNNY));
    shell::run(&mut node)
}

/// One file of the page.
struct Part {
    /// Path with `/` between folders; other parts refer to this part as `./name`.
    name: String,
    bytes: Vec<u8>,
}

/// Reads the page's files; each file follows the files that it refers to.
fn parts(bound: &Path, www: &Path) -> Result<Vec<Part>> {
    let read = |folder: &Path, name: &str| -> Result<Part> {
        let file = folder.join(name);
        let bytes = fs::read(&file).with_context(|| file.display().to_string())?;
        Ok(Part { name: name.to_owned(), bytes })
    };
    let mut parts = Vec::new();
    for name in snippets(bound)? {
        parts.push(read(bound, &name)?);
    }
    let module = read(bound, "mandelight_bg.wasm")?;
    let size = format!("const WASM_BYTES = {};", module.bytes.len());
    parts.push(module);
    parts.push(read(bound, "mandelight.js")?);
    parts.push(read(bound, MEDIABUNNY)?);
    let scripts = [
        "accessibility.js",
        "decoder-worker.js",
        "decoder.js",
        "share.js",
        "gallery.js",
        "codecs.js",
        "video.js",
    ];
    for name in scripts {
        parts.push(read(www, name)?);
    }
    let mut boot = read(www, "boot.js")?;
    boot.bytes = replaced(&boot.bytes, SIZE_PLACEHOLDER, &size)
        .with_context(|| format!("boot.js does not contain `{SIZE_PLACEHOLDER}`"))?;
    parts.push(boot);
    for name in
        icons::FILES.iter().copied().chain(["favicon.svg", "manifest.webmanifest", "style.css"])
    {
        parts.push(read(www, name)?);
    }
    let licenses = read(&shell::root()?, notices::FILE)?;
    parts.push(Part { name: LICENSES.to_owned(), ..licenses });
    let mut index = read(www, "index.html")?;
    let picture = BASE64_STANDARD.encode(read(www, OPENING)?.bytes);
    let address = format!("data:image/jpeg;base64,{picture}");
    // Within the document, the picture is there before anything else is fetched.
    index.bytes = replaced(&index.bytes, &format!("./{OPENING}"), &address)
        .with_context(|| format!("index.html does not show ./{OPENING}"))?;
    parts.push(index);
    Ok(parts)
}

/// The scripts that wasm-bindgen extracts from the crates (`#[wasm_bindgen(inline_js)]`).
fn snippets(bound: &Path) -> Result<Vec<String>> {
    let mut names = Vec::new();
    let mut folders = vec!["snippets".to_owned()];
    while let Some(folder) = folders.pop() {
        let Ok(entries) = fs::read_dir(bound.join(&folder)) else { continue };
        for entry in entries {
            let entry = entry?;
            let name = format!("{folder}/{}", entry.file_name().to_string_lossy());
            if entry.path().is_dir() { folders.push(name) } else { names.push(name) }
        }
    }
    names.sort();
    Ok(names)
}

/// Adds a hash to the name of each part except `index.html` and [`LICENSES`], and updates all references.
fn link(parts: Vec<Part>) -> Result<Vec<Part>> {
    let mut linked: Vec<Part> = Vec::new();
    let mut names: Vec<(String, String, bool)> = Vec::new();
    for Part { name, mut bytes } in parts {
        for (old, new, used) in &mut names {
            if let Some(changed) = replaced(&bytes, &format!("./{old}"), &format!("./{new}")) {
                bytes = changed;
                *used = true;
            }
        }
        if name != "index.html" {
            let hashed = if name == LICENSES { name.clone() } else { hashed_name(&name, &bytes) };
            names.push((name, hashed.clone(), false));
            linked.push(Part { name: hashed, bytes });
        } else {
            linked.push(Part { name, bytes });
        }
    }
    let unused: Vec<_> = names.iter().filter(|name| !name.2).map(|name| name.0.as_str()).collect();
    ensure!(unused.is_empty(), "no file of the page refers to {}", unused.join(", "));
    Ok(linked)
}

/// The service worker of a page, which keeps the page's files.
fn keeping(worker: &[u8], page: &[Part]) -> Result<Part> {
    let others = page.iter().filter(|part| part.name != "index.html");
    let files: Vec<String> = others.map(|part| format!("\"./{}\"", part.name)).collect();
    // The document contains the names of the files, and so the hashes of what is in them.
    let document = page.iter().find(|part| part.name == "index.html");
    let version = hash(&document.context("the page has no index.html")?.bytes);
    let files = format!("const FILES = [{}];", files.join(", "));
    let bytes = replaced(worker, VERSION_PLACEHOLDER, &format!("const VERSION = \"{version}\";"))
        .and_then(|bytes| replaced(&bytes, FILES_PLACEHOLDER, &files))
        .with_context(|| format!("{WORKER} lacks a placeholder"))?;
    Ok(Part { name: WORKER.to_owned(), bytes })
}

/// The name with a hash of the content: `style-0123456789ab.css` for `style.css`.
fn hashed_name(name: &str, bytes: &[u8]) -> String {
    let hash = hash(bytes);
    match name.rsplit_once('.') {
        Some((stem, extension)) => format!("{stem}-{hash}.{extension}"),
        None => format!("{name}-{hash}"),
    }
}

/// The first digits of a content's SHA-256.
fn hash(bytes: &[u8]) -> String {
    let digest = Sha256::digest(bytes);
    let mut hash: String = digest.iter().map(|byte| format!("{byte:02x}")).collect();
    hash.truncate(HASH_DIGITS);
    hash
}

/// `text` with every `old` replaced by `new`; none if `text` is not UTF-8 or has no `old`.
fn replaced(text: &[u8], old: &str, new: &str) -> Option<Vec<u8>> {
    let text = std::str::from_utf8(text).ok()?;
    text.contains(old).then(|| text.replace(old, new).into_bytes())
}

/// Writes the page's files into the emptied `folder`.
fn write(folder: &Path, page: &[Part]) -> Result<()> {
    clear(folder)?;
    for part in page {
        let file = folder.join(&part.name);
        let parent = file.parent().unwrap_or(folder);
        fs::create_dir_all(parent).with_context(|| parent.display().to_string())?;
        fs::write(&file, &part.bytes).with_context(|| file.display().to_string())?;
    }
    Ok(())
}

/// Empties `folder`, which must be a folder of this program.
fn clear(folder: &Path) -> Result<()> {
    if folder.exists() {
        fs::remove_dir_all(folder).with_context(|| folder.display().to_string())?;
    }
    fs::create_dir_all(folder).with_context(|| folder.display().to_string())
}

/// Prints the size of each file, uncompressed and with gzip.
fn print_sizes(folder: &Path, page: &[Part]) -> Result<()> {
    let mut sum = (0, 0);
    let line = |name: &str, raw: usize, gzip: usize| {
        eprintln!("{:>9.1} kB  {:>9.1} kB gzip  {name}", raw as f64 / 1e3, gzip as f64 / 1e3);
    };
    for part in page {
        let mut gzip = GzEncoder::new(Vec::new(), Compression::default());
        gzip.write_all(&part.bytes)?;
        let gzip = gzip.finish()?.len();
        line(&part.name, part.bytes.len(), gzip);
        sum = (sum.0 + part.bytes.len(), sum.1 + gzip);
    }
    line(&folder.display().to_string(), sum.0, sum.1);
    if page.is_empty() {
        bail!("the page is empty");
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn part(name: &str, text: &str) -> Part {
        Part { name: name.to_owned(), bytes: text.as_bytes().to_vec() }
    }

    fn names_of(style: &str) -> Vec<String> {
        let boot = part("boot.js", "import('./module.js')");
        let page = part("index.html", "<script src=\"./boot.js\"> <link href=\"./style.css\">");
        let parts = vec![part("module.js", "1"), boot, part("style.css", style), page];
        link(parts).unwrap().into_iter().map(|part| part.name).collect()
    }

    #[test]
    fn a_hashed_name_depends_on_the_content() {
        let (one, two) = (names_of("a {}"), names_of("b {}"));
        assert_eq!(one, names_of("a {}"));
        assert_eq!(one[..2], two[..2], "a style sheet does not rename scripts");
        assert_ne!(one[2], two[2]);
        assert_eq!(one[3], "index.html");
        // The SHA-256 of "abc" begins with ba7816bf8f01 (FIPS 180-2, appendix B.1).
        assert_eq!(hashed_name("snippets/x/a.js", b"abc"), "snippets/x/a-ba7816bf8f01.js");
    }

    #[test]
    fn a_changed_file_renames_all_files_that_refer_to_it() {
        let names = |module: &str| {
            let boot = part("boot.js", "import('./module.js')");
            let page = part("index.html", "./boot.js");
            let linked = link(vec![part("module.js", module), boot, page]).unwrap();
            assert!(replaced(&linked[1].bytes, &format!("./{}", linked[0].name), "").is_some());
            assert!(replaced(&linked[2].bytes, &format!("./{}", linked[1].name), "").is_some());
            linked[1].name.clone()
        };
        assert_ne!(names("1"), names("2"));
    }

    #[test]
    fn the_licences_keep_their_name() {
        let page = part("index.html", &format!("./{LICENSES}"));
        let linked = link(vec![part(LICENSES, "text"), page]).unwrap();
        assert_eq!(linked[0].name, LICENSES);
        let index = include_str!("../../www/index.html");
        assert!(index.contains(&format!("<link rel=\"license\" href=\"./{LICENSES}\">")));
        let help = include_str!("../../src/ui/panel/help.rs");
        assert!(help.contains(&format!("\"./{LICENSES}\"")));
    }

    #[test]
    fn a_file_without_references_is_an_error() {
        let parts = vec![part("lost.css", ""), part("index.html", "")];
        let error = link(parts).map(|_| ()).unwrap_err();
        assert!(error.to_string().contains("lost.css"), "{error}");
    }

    #[test]
    fn the_service_worker_keeps_every_file_and_has_a_version() {
        let worker = include_bytes!("../../www/service-worker.js");
        let of = |index: &str| {
            let page = [part("boot-1.js", ""), part("a/b-2.js", ""), part("index.html", index)];
            String::from_utf8(keeping(worker, &page).unwrap().bytes).unwrap()
        };
        assert!(of("one").contains("const FILES = [\"./boot-1.js\", \"./a/b-2.js\"];"));
        assert_ne!(of("one"), of("two"), "another page, another version");
        assert!(keeping(b"const VERSION = 0;", &[part("index.html", "")]).is_err());
    }

    #[test]
    fn wasm_bindgen_has_one_version() {
        let lock = include_str!("../../Cargo.lock");
        let version = |package: &str| {
            let head = format!("name = \"{package}\"\nversion = ");
            let at = lock.find(&head).unwrap_or_else(|| panic!("no {package} in Cargo.lock"));
            lock[at + head.len()..].lines().next().unwrap()
        };
        assert_eq!(version("wasm-bindgen"), version("wasm-bindgen-cli-support"));
    }
}
