//! What the commands need from the machine, and how it is got.
//!
//! Each function makes sure of one thing: it returns at once where the thing is there, gets it where
//! that can be done without asking (rustup, apt as root, npm inside the checkout), and otherwise fails
//! with one line that says what to install.

use std::{
    fs,
    path::{Path, PathBuf},
    process::Command,
};

use anyhow::{Context as _, Result, bail};

use crate::shell;

/// What the page is compiled for.
pub const WASM_TARGET: &str = "wasm32-unknown-unknown";

/// The oldest Node.js that the browser driver and wasm-opt are tried with.
const OLDEST_NODE: u32 = 20;

/// The environment variable that names the browser to test with.
pub const BROWSER_VARIABLE: &str = "MANDELIGHT_CHROMIUM";

/// Names under which a browser that can be driven goes. Ubuntu's `chromium` is a stub that only
/// advertises a snap, hence each is asked for its version first.
const BROWSERS: [&str; 6] = [
    "chromium",
    "google-chrome-stable",
    "google-chrome",
    "chromium-browser",
    "chrome",
    "/Applications/Google Chrome.app/Contents/MacOS/Google Chrome",
];

/// What the tests are given.
pub struct Tools {
    /// The browser's program.
    pub chromium: PathBuf,
}

/// A thing that Debian and Ubuntu have packages for.
struct Thing {
    name: &'static str,
    packages: &'static [&'static str],
    is_there: fn() -> bool,
}

const VULKAN: Thing = Thing {
    name: "a Vulkan software driver (Mesa's lavapipe)",
    packages: &["libvulkan1", "mesa-vulkan-drivers"],
    is_there: has_software_vulkan,
};
const BROWSER: Thing = Thing {
    name: "Chromium or Chrome (or set MANDELIGHT_CHROMIUM to its path)",
    packages: &["chromium", "fonts-liberation"],
    is_there: || find_browser().is_some(),
};
const NODE: Thing = Thing {
    name: "Node.js 20 or newer, with npm",
    packages: &["nodejs", "npm"],
    is_there: has_node,
};
const OPENEXR: Thing = Thing {
    name: "OpenEXR's tools",
    packages: &["openexr"],
    // Older ones have no way to run well without a file.
    is_there: || Command::new("exrheader").output().is_ok(),
};

/// The standard library for [`WASM_TARGET`].
pub fn wasm_target() -> Result<()> {
    let has_it = || {
        let ask = ["--print", "target-libdir", "--target", WASM_TARGET];
        shell::output(Command::new("rustc").args(ask)).is_some_and(|dir| Path::new(&dir).is_dir())
    };
    if has_it() {
        return Ok(());
    }
    if shell::output(Command::new("rustup").arg("--version")).is_some() {
        shell::run(Command::new("rustup").args(["target", "add", WASM_TARGET]))?;
    }
    if !has_it() {
        bail!("install Rust's {WASM_TARGET} target: `rustup target add {WASM_TARGET}`");
    }
    Ok(())
}

/// Everything that `cargo xtask test` needs.
pub fn test_tools() -> Result<Tools> {
    wasm_target()?;
    if is_set(BROWSER_VARIABLE) && find_browser().is_none() {
        bail!("{BROWSER_VARIABLE} names a browser that does not run");
    }
    machine_has(&[VULKAN, BROWSER, NODE, OPENEXR])?;
    node_packages()?;
    Ok(Tools { chromium: find_browser().context("the browser went away")? })
}

/// A Vulkan driver that needs no graphics card.
pub fn vulkan_driver() -> Result<()> {
    machine_has(&[VULKAN])
}

/// The packages of package-lock.json, in node_modules/.
pub fn node_packages() -> Result<()> {
    machine_has(&[NODE])?;
    let root = shell::root()?;
    let lock = fs::read(root.join("package-lock.json")).context("package-lock.json")?;
    // npm's own record of what it installed has another form, so a copy of the lock tells.
    let installed = root.join("node_modules/.installed-lock.json");
    if fs::read(&installed).is_ok_and(|old| old == lock) {
        return Ok(());
    }
    let npm = if cfg!(windows) { "npm.cmd" } else { "npm" };
    shell::run(Command::new(npm).args(["ci", "--no-fund", "--no-audit"]).current_dir(&root))?;
    fs::write(&installed, lock).with_context(|| installed.display().to_string())
}

/// Makes sure of `things`, by apt where it may.
fn machine_has(things: &[Thing]) -> Result<()> {
    let missing = || things.iter().filter(|thing| !(thing.is_there)()).collect::<Vec<_>>();
    let wanted = missing();
    if wanted.is_empty() {
        return Ok(());
    }
    let packages: Vec<_> = wanted.iter().flat_map(|thing| thing.packages).collect();
    if let Some(apt_get) = apt_get() {
        shell::run(apt_get().arg("update"))?;
        let install = ["install", "--yes", "--no-install-recommends"];
        shell::run(apt_get().args(install).args(packages))?;
    }
    let missing = missing();
    if !missing.is_empty() {
        bail!("{}", complaint(&missing));
    }
    Ok(())
}

/// One line that says what to install.
fn complaint(missing: &[&Thing]) -> String {
    let names: Vec<_> = missing.iter().map(|thing| thing.name).collect();
    let packages: Vec<_> = missing.iter().flat_map(|thing| thing.packages).copied().collect();
    format!("install {} (on Debian: apt-get install {})", names.join(", and "), packages.join(" "))
}

/// A maker of `apt-get` commands, where this user may run them without being asked for a password.
fn apt_get() -> Option<fn() -> Command> {
    shell::output(Command::new("apt-get").arg("--version"))?;
    if shell::output(Command::new("id").arg("-u"))? == "0" {
        return Some(|| {
            let mut apt_get = Command::new("apt-get");
            apt_get.env("DEBIAN_FRONTEND", "noninteractive");
            apt_get
        });
    }
    shell::output(Command::new("sudo").args(["-n", "true"]))?;
    Some(|| {
        let mut sudo = Command::new("sudo");
        sudo.args(["-n", "DEBIAN_FRONTEND=noninteractive", "apt-get"]);
        sudo
    })
}

/// True where the Vulkan loader and a software driver's manifest are there, or someone has chosen a
/// driver by hand. Only Linux tests on Vulkan: macOS has Metal, and Windows brings its own.
fn has_software_vulkan() -> bool {
    if !cfg!(target_os = "linux") {
        return true;
    }
    let chosen = ["VK_DRIVER_FILES", "VK_ICD_FILENAMES"].iter().any(|name| is_set(name));
    let loader = ["ldconfig", "/sbin/ldconfig"].iter().any(|ldconfig| {
        shell::output(Command::new(ldconfig).arg("-p"))
            .is_some_and(|libraries| libraries.contains("libvulkan.so.1"))
    });
    let folders = ["/usr/share", "/usr/local/share", "/etc", "/run/opengl-driver/share"];
    let driver = folders.iter().any(|folder| {
        let Ok(files) = fs::read_dir(Path::new(folder).join("vulkan/icd.d")) else { return false };
        files.flatten().any(|file| file.file_name().to_string_lossy().starts_with("lvp_icd"))
    });
    chosen || (loader && driver)
}

fn has_node() -> bool {
    let npm = if cfg!(windows) { "npm.cmd" } else { "npm" };
    let version = shell::output(Command::new("node").arg("--version"));
    let is_new = version.and_then(|v| major(&v)).is_some_and(|major| major >= OLDEST_NODE);
    is_new && shell::output(Command::new(npm).arg("--version")).is_some()
}

/// The first number of a version such as `v20.20.2`.
fn major(version: &str) -> Option<u32> {
    version.trim_start_matches('v').split('.').next()?.parse().ok()
}

/// `MANDELIGHT_CHROMIUM`, or else the first of [`BROWSERS`] that runs.
fn find_browser() -> Option<PathBuf> {
    if is_set(BROWSER_VARIABLE) {
        return std::env::var_os(BROWSER_VARIABLE).map(PathBuf::from).filter(|file| runs(file));
    }
    BROWSERS.iter().find_map(|name| in_path(name).filter(|file| runs(file)))
}

/// Whether a browser answers with its version. On Windows asking opens a window instead.
fn runs(browser: &Path) -> bool {
    cfg!(windows) || shell::output(Command::new(browser).arg("--version")).is_some()
}

/// The full path of a program that PATH holds, or of one that is named by a full path.
fn in_path(name: &str) -> Option<PathBuf> {
    let path = std::env::var_os("PATH")?;
    std::env::split_paths(&path).map(|folder| folder.join(name)).find(|file| file.is_file())
}

fn is_set(variable: &str) -> bool {
    std::env::var_os(variable).is_some_and(|value| !value.is_empty())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn versions_are_read() {
        assert_eq!(major("v20.20.2"), Some(20));
        assert_eq!(major("9"), Some(9));
        assert_eq!(major("none"), None);
    }

    #[test]
    fn what_cannot_be_got_is_named_in_one_line() {
        let line = complaint(&[&VULKAN, &NODE]);
        assert!(line.contains("lavapipe") && line.contains("Node.js 20"), "{line}");
        assert!(
            line.ends_with("apt-get install libvulkan1 mesa-vulkan-drivers nodejs npm)"),
            "{line}"
        );
        assert!(!line.contains('\n'));
    }
}
