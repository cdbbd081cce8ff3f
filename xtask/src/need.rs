//! The tools that the commands need, and their installation.
//!
//! Each function ensures that one tool exists. It returns at once if the tool is installed,
//! installs the tool if no user interaction is necessary (rustup, apt as root, npm inside the
//! checkout), and otherwise fails with one line that says what to install.

use std::{
    fs,
    path::{Path, PathBuf},
    process::Command,
};

use anyhow::{Context as _, Result, bail};

use crate::shell;

/// The compilation target of the page.
pub const WASM_TARGET: &str = "wasm32-unknown-unknown";

/// A compilation target with the page's sizes, whose programs run here.
pub const TARGET_32_BITS: &str = "i686-unknown-linux-gnu";

/// True if programs for [`TARGET_32_BITS`] can run on this machine.
pub const RUNS_32_BITS: bool = cfg!(all(target_os = "linux", target_arch = "x86_64"));

/// The oldest major version of Node.js that is tested with the browser driver, wasm-opt and the bundler.
const OLDEST_NODE: u32 = 20;

/// The environment variable with the path of the browser for tests.
pub const BROWSER_VARIABLE: &str = "MANDELIGHT_CHROMIUM";

/// Program names of browsers that can be automated.
///
/// Ubuntu's `chromium` may be a stub that only recommends a snap, so [`runs`] checks each one.
const BROWSERS: [&str; 6] = [
    "chromium",
    "google-chrome-stable",
    "google-chrome",
    "chromium-browser",
    "chrome",
    "/Applications/Google Chrome.app/Contents/MacOS/Google Chrome",
];

/// The programs that the tests need.
pub struct Tools {
    /// The browser's program.
    pub chromium: PathBuf,
}

/// A tool that Debian and Ubuntu have packages for.
struct Tool {
    name: &'static str,
    packages: &'static [&'static str],
    is_installed: fn() -> bool,
}

const VULKAN: Tool = Tool {
    name: "a Vulkan software driver (Mesa's lavapipe)",
    packages: &["libvulkan1", "mesa-vulkan-drivers"],
    is_installed: has_software_vulkan,
};
const BROWSER: Tool = Tool {
    name: "Chromium or Chrome (or set MANDELIGHT_CHROMIUM to its path)",
    packages: &["chromium", "fonts-liberation"],
    is_installed: || find_browser().is_some(),
};
const NODE: Tool = Tool {
    name: "Node.js 20 or newer, with npm",
    packages: &["nodejs", "npm"],
    is_installed: has_node,
};
const OPENEXR: Tool = Tool {
    name: "OpenEXR's tools",
    packages: &["openexr"],
    // Old versions of exrheader have no successful call without a file.
    is_installed: || Command::new("exrheader").output().is_ok(),
};
const FFMPEG: Tool = Tool {
    name: "FFmpeg",
    packages: &["ffmpeg"],
    is_installed: || Command::new("ffprobe").arg("-version").output().is_ok(),
};
const LIBRARIES_32_BITS: Tool = Tool {
    name: "GCC's libraries of 32 bits",
    packages: &["gcc-multilib"],
    is_installed: has_libraries_of_32_bits,
};
const PIP: Tool = Tool {
    name: "Python's pip",
    packages: &["python3-pip"],
    is_installed: || shell::output(python().args(["-m", "pip", "--version"])).is_some(),
};

/// Ensures the standard library for [`WASM_TARGET`].
pub fn wasm_target() -> Result<()> {
    rust_target(WASM_TARGET)
}

/// Ensures what builds and runs programs for [`TARGET_32_BITS`].
pub fn target_of_32_bits() -> Result<()> {
    if !RUNS_32_BITS {
        bail!("the tests with sizes of 32 bits run on Linux with an x86-64 processor only");
    }
    rust_target(TARGET_32_BITS)?;
    ensure_installed(&[LIBRARIES_32_BITS])
}

/// Ensures the standard library for a target.
fn rust_target(target: &str) -> Result<()> {
    let has_it = || {
        let ask = ["--print", "target-libdir", "--target", target];
        shell::output(Command::new("rustc").args(ask)).is_some_and(|dir| Path::new(&dir).is_dir())
    };
    if has_it() {
        return Ok(());
    }
    if shell::output(Command::new("rustup").arg("--version")).is_some() {
        shell::run(Command::new("rustup").args(["target", "add", target]))?;
    }
    if !has_it() {
        bail!("install Rust's {target} target: `rustup target add {target}`");
    }
    Ok(())
}

/// Ensures all tools that `cargo xtask test` needs.
pub fn test_tools() -> Result<Tools> {
    wasm_target()?;
    if is_set(BROWSER_VARIABLE) && find_browser().is_none() {
        bail!("{BROWSER_VARIABLE} names a program that does not run; set it to Chromium's path");
    }
    ensure_installed(&[VULKAN, BROWSER, NODE, OPENEXR, FFMPEG])?;
    node_packages()?;
    Ok(Tools { chromium: find_browser().context("the browser cannot be found any more")? })
}

/// Cargo of the nightly toolchain, by rustup.
pub fn nightly_cargo() -> Command {
    let mut cargo = Command::new("cargo");
    cargo.arg("+nightly");
    cargo
}

/// Ensures what the coverage-guided fuzzer needs.
pub fn fuzzer() -> Result<()> {
    if shell::output(nightly_cargo().args(["fuzz", "--version"])).is_none() {
        bail!(
            "install a nightly compiler and cargo-fuzz: `rustup toolchain install nightly`, \
             `cargo install cargo-fuzz`; the fuzzer also needs a C++ compiler (on Debian: apt-get install g++)"
        );
    }
    Ok(())
}

/// Ensures a Vulkan driver that needs no graphics card.
pub fn vulkan_driver() -> Result<()> {
    ensure_installed(&[VULKAN])
}

/// Ensures Python with pip.
pub fn pip() -> Result<()> {
    ensure_installed(&[PIP])
}

/// A command of Python 3.
pub fn python() -> Command {
    Command::new(if cfg!(windows) { "python" } else { "python3" })
}

/// Ensures the packages of package-lock.json, in node_modules/.
pub fn node_packages() -> Result<()> {
    ensure_installed(&[NODE])?;
    let root = shell::root()?;
    let lock = fs::read(root.join("package-lock.json")).context("package-lock.json")?;
    // npm's record of installed packages has another format, so a copy of the lock is compared.
    let installed = root.join("node_modules/.installed-lock.json");
    if fs::read(&installed).is_ok_and(|old| old == lock) {
        return Ok(());
    }
    let npm = if cfg!(windows) { "npm.cmd" } else { "npm" };
    shell::run(
        Command::new(npm)
            .args(["ci", "--no-fund", "--no-audit", "--ignore-scripts"])
            .current_dir(&root),
    )?;
    fs::write(&installed, lock).with_context(|| installed.display().to_string())
}

/// Installs the missing ones of `tools` by apt, if permitted; fails if a tool is still missing.
fn ensure_installed(tools: &[Tool]) -> Result<()> {
    let missing = || tools.iter().filter(|tool| !(tool.is_installed)()).collect::<Vec<_>>();
    let missing_before = missing();
    if missing_before.is_empty() {
        return Ok(());
    }
    let packages: Vec<_> = missing_before.iter().flat_map(|tool| tool.packages).collect();
    if let Some(apt_get) = apt_get() {
        shell::run(apt_get().arg("update"))?;
        let install = ["install", "--yes", "--no-install-recommends"];
        shell::run(apt_get().args(install).args(packages))?;
    }
    let missing = missing();
    if !missing.is_empty() {
        bail!("{}", install_message(&missing));
    }
    Ok(())
}

/// One line that says what to install.
fn install_message(missing: &[&Tool]) -> String {
    let names: Vec<_> = missing.iter().map(|tool| tool.name).collect();
    let packages: Vec<_> = missing.iter().flat_map(|tool| tool.packages).copied().collect();
    format!("install {} (on Debian: apt-get install {})", names.join(", and "), packages.join(" "))
}

/// A constructor of `apt-get` commands, if this user may run `apt-get` without a password.
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

/// True if the Vulkan loader and a software driver's manifest exist.
///
/// Also true if an environment variable selects a driver, and on macOS and Windows, whose tests
/// do not need a Vulkan driver.
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

/// True if the C compiler finds what a program of 32 bits is linked with.
fn has_libraries_of_32_bits() -> bool {
    // The compiler prints the full path of a file that it has, and the name alone otherwise.
    ["crt1.o", "libgcc.a"].iter().all(|file| {
        let ask = format!("-print-file-name={file}");
        shell::output(Command::new("cc").args(["-m32", &ask]))
            .is_some_and(|path| Path::new(&path).is_absolute())
    })
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

/// True if a browser prints its version. On Windows `--version` opens a window, so it is not run.
fn runs(browser: &Path) -> bool {
    cfg!(windows) || shell::output(Command::new(browser).arg("--version")).is_some()
}

/// The full path of a program in a folder of PATH; a full path stays as it is.
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
    fn versions_are_parsed() {
        assert_eq!(major("v20.20.2"), Some(20));
        assert_eq!(major("9"), Some(9));
        assert_eq!(major("none"), None);
    }

    #[test]
    fn missing_tools_are_named_in_one_line() {
        let line = install_message(&[&VULKAN, &NODE]);
        assert!(line.contains("lavapipe") && line.contains("Node.js 20"), "{line}");
        assert!(
            line.ends_with("apt-get install libvulkan1 mesa-vulkan-drivers nodejs npm)"),
            "{line}"
        );
        assert!(!line.contains('\n'));
    }
}
