//! `cargo xtask thumbnails`: renders the pictures on the buttons of the opening scenes and dives.
//!
//! In: the presets, by the command line program. Out: a JPEG file per preset in
//! `src/ui/thumbnails/`, which the interface embeds; the picture that the page shows first; and its icons.

use std::{
    collections::BTreeSet,
    fs::{self, File},
    path::Path,
    process::Command,
    time::SystemTime,
};

use anyhow::{Context as _, Result, bail};
use jpeg_encoder::{ColorType, Encoder, SamplingFactor};

use crate::{
    icons, need,
    pictures::{compose::Image, framing::fov_deg},
    shell,
};

/// The pictures' folder, relative to the repository's top folder.
const FOLDER: &str = "src/ui/thumbnails";

/// The file that embeds the folder.
const EMBEDDED_BY: &str = "src/ui/thumbnail.rs";

/// Width and height in pixels, equal to `SIZE_PX` of `src/ui/thumbnail.rs`.
const SIZE_PX: [u32; 2] = [192, 120];

/// The picture that the page shows first, relative to the repository's top folder.
const OPENING: &str = "www/opening.jpg";

/// Name of the opening picture on the command line, beside the presets' names.
const OPENING_NAME: &str = "opening";

/// Name of the page's icons on the command line.
const ICONS_NAME: &str = "icons";

/// Width and height of the opening picture in pixels, equal to `SIDE_PX` of `src/ui/opening.rs`.
const OPENING_SIDE_PX: u32 = 1024;

/// Part of its side that the opening scene's angle spans, equal to `SPAN` of `src/ui/opening.rs`.
const OPENING_SPAN: f64 = 9.0 / 16.0;

/// Quality of the opening picture, 1 to 100.
const OPENING_QUALITY: u8 = 62;

/// Samples per pixel: noise costs bytes.
const SAMPLES: u32 = 32;

/// In the document of a scene in path-traced light.
const TRACED: &str = "\"kind\": \"path\"";

/// Quality of the JPEG files, 1 to 100; `tests/gpu/thumbnails.rs` limits the bytes of all.
const QUALITY: u8 = 52;

/// Renders the pictures of these presets, or those named "opening" and "icons"; without names, all.
pub fn thumbnails(names: &[String]) -> Result<()> {
    need::vulkan_driver()?;
    let renderer = shell::renderer()?;
    if names.is_empty() || names.iter().any(|name| name == OPENING_NAME) {
        opening(&renderer)?;
    }
    if names.is_empty() || names.iter().any(|name| name == ICONS_NAME) {
        icons::icons(&renderer)?;
    }
    let is_preset = |name: &&String| ![OPENING_NAME, ICONS_NAME].contains(&name.as_str());
    let others: Vec<String> = names.iter().filter(is_preset).cloned().collect();
    if others.is_empty() && !names.is_empty() {
        return Ok(());
    }
    presets(&renderer, &others)
}

/// Renders the picture that the page shows first.
fn opening(renderer: &Path) -> Result<()> {
    let scene =
        shell::output(Command::new(renderer).arg("scene")).context("`mandelight scene` failed")?;
    let wide = fov_deg(&scene, OPENING_SPAN)?;
    let parts = shell::target()?.join("thumbnails");
    fs::create_dir_all(&parts)?;
    let (document, picture) = (parts.join("opening.json"), parts.join("opening.png"));
    fs::write(&document, &scene)?;
    let mut render = Command::new(renderer);
    render.args(["render", "--quiet", "--samples", &SAMPLES.to_string()]);
    render.args(["--size", &format!("{OPENING_SIDE_PX}x{OPENING_SIDE_PX}")]);
    render.args(["--set", &format!("camera.vertical_fov_deg={wide}")]);
    shell::run(render.arg("--output").arg(&picture).arg(&document))?;
    let bytes = write(&Image::read_png(&picture)?, &shell::root()?.join(OPENING), OPENING_QUALITY)?;
    eprintln!("{OPENING}: {:.1} kB", bytes as f64 / 1e3);
    Ok(())
}

/// Renders the pictures of these presets; without names, all, and deletes pictures of no preset.
fn presets(renderer: &Path, names: &[String]) -> Result<()> {
    let list = shell::output(Command::new(renderer).args(["scene", "--list-presets"]))
        .context("`mandelight scene --list-presets` failed")?;
    let presets = selected(&list, names)?;
    let folder = shell::root()?.join(FOLDER);
    fs::create_dir_all(&folder)?;
    if names.is_empty() {
        delete_others(&folder, &presets)?;
    }
    let parts = shell::target()?.join("thumbnails");
    fs::create_dir_all(&parts)?;
    let mut bytes = 0;
    for preset in &presets {
        let text_of_scene =
            shell::output(Command::new(renderer).args(["scene", "--preset", preset]))
                .with_context(|| format!("no scene of the preset {preset}"))?;
        let (scene, picture) = (parts.join("scene.json"), parts.join("picture.png"));
        fs::write(&scene, &text_of_scene)?;
        let mut render = Command::new(renderer);
        render.args(["render", "--quiet", "--size", &format!("{}x{}", SIZE_PX[0], SIZE_PX[1])]);
        // Few light paths are noisy: their scenes have more samples of their own.
        if !text_of_scene.contains(TRACED) {
            render.args(["--samples", &SAMPLES.to_string()]);
        }
        render.arg("--output").arg(&picture).arg(&scene);
        shell::run(&mut render)?;
        let file = folder.join(format!("{preset}.jpg"));
        bytes += write(&Image::read_png(&picture)?, &file, QUALITY)?;
    }
    eprintln!("{FOLDER}: {} pictures, {:.1} kB", presets.len(), bytes as f64 / 1e3);
    // Cargo sees changed files of the folder, but no new ones.
    let source = File::options().append(true).open(shell::root()?.join(EMBEDDED_BY))?;
    source.set_modified(SystemTime::now())?;
    Ok(())
}

/// The presets of a `list` of lines that begin with a preset's name; only `names`, if any.
fn selected(list: &str, names: &[String]) -> Result<BTreeSet<String>> {
    let presets: BTreeSet<String> =
        list.lines().filter_map(|line| line.split_whitespace().next()).map(str::to_owned).collect();
    if let Some(unknown) = names.iter().find(|name| !presets.contains(*name)) {
        bail!("no preset is named {unknown:?}; `mandelight scene --list-presets` lists them");
    }
    Ok(presets.into_iter().filter(|name| names.is_empty() || names.contains(name)).collect())
}

/// Deletes the pictures of `folder` that belong to no preset.
fn delete_others(folder: &Path, presets: &BTreeSet<String>) -> Result<()> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        if !presets.contains(&stem) {
            fs::remove_file(&path)?;
        }
    }
    Ok(())
}

/// Writes a JPEG file and returns its size in bytes.
fn write(picture: &Image, file: &Path, quality: u8) -> Result<usize> {
    let ([width, height], pixels) = picture.as_rgba();
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(&mut bytes, quality);
    encoder.set_sampling_factor(SamplingFactor::F_2_2);
    encoder.set_progressive(true);
    encoder.set_optimized_huffman_tables(true);
    encoder.encode(pixels, width.try_into()?, height.try_into()?, ColorType::Rgba)?;
    fs::write(file, &bytes).with_context(|| file.display().to_string())?;
    Ok(bytes.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    const LIST: &str = "coral-reef  Close to the bulb.\nvine        Bunches.\n";

    #[test]
    fn presets_are_selected_by_name() {
        let all = selected(LIST, &[]).unwrap();
        assert_eq!(all.into_iter().collect::<Vec<_>>(), ["coral-reef", "vine"]);
        let one = selected(LIST, &["vine".into()]).unwrap();
        assert_eq!(one.into_iter().collect::<Vec<_>>(), ["vine"]);
        let error = selected(LIST, &["teapot".into()]).unwrap_err();
        assert!(error.to_string().contains("teapot"), "{error}");
    }

    #[test]
    fn only_pictures_of_no_preset_are_deleted() {
        let folder = std::env::temp_dir().join(format!("thumbnails-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        for name in ["vine.jpg", "teapot.jpg"] {
            fs::write(folder.join(name), "").unwrap();
        }
        delete_others(&folder, &selected(LIST, &[]).unwrap()).unwrap();
        let left: Vec<_> =
            fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().file_name()).collect();
        fs::remove_dir_all(&folder).unwrap();
        assert_eq!(left, ["vine.jpg"]);
    }
}
