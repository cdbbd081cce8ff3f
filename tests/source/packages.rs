//! The packages of Node.js, which the build, the tests and the page take: exact versions, hashes, licences.

use std::{fs, path::Path};

use serde_json::{Map, Value};

fn json(name: &str) -> Map<String, Value> {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join(name);
    serde_json::from_str(&fs::read_to_string(file).expect(name)).expect(name)
}

fn text<'a>(object: &'a Value, field: &str) -> &'a str {
    object[field].as_str().unwrap_or_default()
}

/// True for a version such as 1.20.3, without a range.
fn is_exact(version: &str) -> bool {
    let parts: Vec<_> = version.split('.').collect();
    parts.len() == 3 && parts.iter().all(|part| part.parse::<u32>().is_ok())
}

#[test]
fn packages_of_node_have_a_version_a_hash_and_a_known_licence() {
    let wanted = &json("package.json")["devDependencies"];
    for (name, version) in wanted.as_object().expect("packages") {
        assert!(is_exact(version.as_str().unwrap_or_default()), "{name} {version}");
    }
    let lock = json("package-lock.json");
    let packages = lock["packages"].as_object().expect("packages");
    let is_installed = |path: &&String| !path.is_empty();
    assert!(packages.keys().filter(is_installed).count() > 4);
    for (path, package) in packages.iter().filter(|(path, _)| is_installed(path)) {
        let name = path.strip_prefix("node_modules/").expect("a package of the registry");
        assert!(is_exact(text(package, "version")), "{name}: {package}");
        assert!(text(package, "integrity").starts_with("sha512-"), "{name} has no hash");
        // npm asks its own registry for packages without an address.
        assert_eq!(package.get("resolved"), None, "{name}");
        let licences: &[&str] =
            if name == "mediabunny" { &["MPL-2.0"] } else { &["MIT", "Apache-2.0"] };
        assert!(licences.contains(&text(package, "license")), "{name}: {package}");
        // npm runs none: `need::node_packages` forbids it, and esbuild works without its own.
        assert!(package.get("hasInstallScript").is_none() || name == "esbuild", "{name}");
    }
}
