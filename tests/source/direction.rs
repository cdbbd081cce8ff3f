//! Inside a folder, files import in one direction: a reader who starts at the top file never comes back
//! to it.

use std::{
    collections::{BTreeMap, BTreeSet},
    fs,
};

use super::layers::{Token, files, root, tokens};

/// A path in a `use` or in code: its words from the crate's root.
type Path = Vec<String>;

/// One file of `src/` as a module.
struct Module {
    /// Paths that the file names, from the crate's root.
    named: Vec<Path>,
}

/// The module of a file below `src/`: `render::schedule::types`.
fn module_of(below_src: &str) -> Path {
    let stem = below_src.trim_end_matches(".rs").trim_end_matches("/mod");
    match stem {
        "lib" => Vec::new(),
        stem => stem.split('/').map(str::to_owned).collect(),
    }
}

/// The tokens before the file's own tests.
fn without_tests(source: &str) -> &str {
    source.split("#[cfg(test)]\nmod tests").next().unwrap_or(source)
}

/// Every path that begins with `crate`, `super` or `self` or stands in a `use`, from the crate's root.
fn named_paths(source: &str, module: &Path) -> Vec<Path> {
    let tokens = tokens(without_tests(source));
    let word = |i: usize| match tokens.get(i) {
        Some(Token::Word(word)) => word.as_str(),
        _ => "",
    };
    let mut found = Vec::new();
    for i in 0..tokens.len() {
        let in_use = i > 0 && word(i - 1) == "use";
        let starts =
            matches!(word(i), "crate" | "super" | "self") && word(i.wrapping_sub(1)) != "::";
        if in_use || starts && tokens.get(i + 1) == Some(&Token::Sign(':')) {
            let mut paths = Vec::new();
            read(&tokens, i, &Vec::new(), &mut paths);
            found.extend(paths.into_iter().map(|path| absolute(path, module)));
        }
    }
    found
}

/// Reads the `use` tree or path at `i`; adds each path behind `prefix`.
fn read(tokens: &[Token], i: usize, prefix: &Path, found: &mut Vec<Path>) -> usize {
    match tokens.get(i) {
        Some(Token::Word(word)) => {
            let path: Path = prefix.iter().cloned().chain([word.clone()]).collect();
            if tokens.get(i + 1..i + 3) == Some(&[Token::Sign(':'), Token::Sign(':')]) {
                return read(tokens, i + 3, &path, found);
            }
            found.push(path);
            let is_renamed = tokens.get(i + 1) == Some(&Token::Word("as".into()));
            if is_renamed { i + 3 } else { i + 1 }
        }
        Some(Token::Sign('{')) => {
            let mut at = i + 1;
            while at < tokens.len() && tokens[at] != Token::Sign('}') {
                let after = read(tokens, at, prefix, found);
                at = after.max(at + 1);
            }
            at + 1
        }
        Some(Token::Sign('*')) => {
            found.push(prefix.clone());
            i + 1
        }
        // A comma, or the end of what is a path.
        _ => i + 1,
    }
}

fn absolute(path: Path, module: &Path) -> Path {
    let mut base = match path.first().map(String::as_str) {
        Some("crate") => Vec::new(),
        _ => module.clone(),
    };
    for word in path {
        match word.as_str() {
            "crate" | "self" => {}
            "super" => _ = base.pop(),
            _ => base.push(word),
        }
    }
    base
}

/// The file that defines what `path` names: re-exports are followed.
fn defined_in(path: &Path, modules: &BTreeMap<Path, Module>, depth: u32) -> Option<Path> {
    let known = (0..=path.len()).rev().find(|&n| modules.contains_key(&path[..n]))?;
    let (module, rest) = path.split_at(known);
    if let (Some(name), true) = (rest.first(), depth < 8) {
        let re_export = modules[module].named.iter().find(|named| {
            named.last() == Some(name) && named.as_slice() != path && named.len() > module.len()
        });
        if let Some(named) = re_export {
            return defined_in(named, modules, depth + 1);
        }
    }
    Some(module.to_vec())
}

/// Whether `from` reaches `to` by the edges.
fn reaches(edges: &BTreeMap<Path, BTreeSet<Path>>, from: &Path, to: &Path) -> bool {
    let (mut seen, mut open) = (BTreeSet::new(), vec![from.clone()]);
    while let Some(at) = open.pop() {
        for next in edges.get(&at).into_iter().flatten() {
            if next == to {
                return true;
            }
            if seen.insert(next.clone()) {
                open.push(next.clone());
            }
        }
    }
    false
}

/// The files of `sources`, by path below `src/`, that lie on a cycle of imports.
fn on_cycles(sources: &[(String, String)]) -> Vec<String> {
    let modules: BTreeMap<Path, Module> = sources
        .iter()
        .map(|(path, source)| {
            let module = module_of(path);
            let named = named_paths(source, &module);
            (module, Module { named })
        })
        .collect();
    let mut edges: BTreeMap<Path, BTreeSet<Path>> = BTreeMap::new();
    for (from, module) in &modules {
        let targets = module.named.iter().filter_map(|path| defined_in(path, &modules, 0));
        edges.entry(from.clone()).or_default().extend(targets.filter(|to| to != from));
    }
    let cyclic = modules.keys().filter(|module| reaches(&edges, module, module));
    cyclic.map(|module| module.join("::")).collect()
}

#[test]
fn files_import_in_one_direction() {
    let src = root().join("src");
    let sources: Vec<_> = files(root(), "src")
        .into_iter()
        .filter(|path| path.extension().is_some_and(|e| e == "rs") && !path.ends_with("main.rs"))
        .map(|path| {
            let below = path.strip_prefix(&src).expect("below src/");
            let below = below.to_str().expect("a UTF-8 path").replace('\\', "/");
            (below, fs::read_to_string(&path).expect("a source"))
        })
        .collect();
    let cyclic = on_cycles(&sources);
    assert!(cyclic.is_empty(), "these files import each other in a circle: {cyclic:#?}");
}

#[test]
fn a_cycle_is_found_through_trees_and_re_exports() {
    let source = |path: &str, text: &str| (path.to_owned(), text.to_owned());
    let sources = [
        source("lib.rs", "pub mod a; pub mod b;"),
        source("a/mod.rs", "mod one; mod two; pub use one::One;"),
        source("a/one.rs", "use super::two::{Two, Other}; pub struct One;"),
        source("a/two.rs", "use crate::{a::One, b}; pub struct Two;"),
        source("b.rs", "// use crate::a::One;\nfn f() { \"crate::a::One\"; }"),
    ];
    assert_eq!(on_cycles(&sources), ["a::one", "a::two"]);
    let free = [sources[0].clone(), sources[2].clone(), source("a/two.rs", "use crate::b;")];
    assert!(on_cycles(&free).is_empty());
}
