//! `cargo xtask pictures`: renders every picture of the README and the docs.
//!
//! In: the table in `table.rs`. Out: `docs/pictures/*.png`, rendered by the command line program.
//! A picture of one panel is the renderer's file and contains its scene. A picture of several
//! panels is a montage without a scene.

pub mod compose;
mod dusk;
pub mod framing;
mod table;

use std::{
    fs,
    path::{Path, PathBuf},
    process::Command,
};

use anyhow::{Context as _, Result, bail};
use compose::Image;
use table::{Layer, Panel, Picture};

use crate::{need, shell};

/// The pictures' folder, relative to the repository's top folder.
const FOLDER: &str = "docs/pictures";

/// Width of the transparent gaps between the panels of a picture, pixels.
const GAP_PX: u32 = 4;

/// Renders the pictures of these names; without names, all pictures.
pub fn pictures(names: &[String]) -> Result<()> {
    let selected = selected(names)?;
    need::vulkan_driver()?;
    let painter = Painter::new()?;
    for picture in &selected {
        eprintln!("{FOLDER}/{}.png: {}", picture.name, picture.caption);
        painter.paint(picture).with_context(|| format!("the picture {:?}", picture.name))?;
    }
    Ok(())
}

fn selected(names: &[String]) -> Result<Vec<Picture>> {
    let mut pictures = table::pictures();
    if let Some(unknown) = names.iter().find(|name| pictures.iter().all(|p| p.name != **name)) {
        bail!("no picture is named {unknown:?}; the table is xtask/src/pictures/table.rs");
    }
    if !names.is_empty() {
        pictures.retain(|picture| names.iter().any(|name| name == picture.name));
    }
    Ok(pictures)
}

/// Renders pictures with the command line program.
struct Painter {
    renderer: PathBuf,
    docs: PathBuf,
    /// Folder for temporary files.
    parts: PathBuf,
    /// An environment map, generated so that the repository needs no large file.
    environment_map: PathBuf,
}

impl Painter {
    fn new() -> Result<Self> {
        let renderer = shell::renderer()?;
        let parts = shell::target()?.join("pictures");
        fs::create_dir_all(&parts)?;
        let environment_map = parts.join("dusk.hdr");
        fs::write(&environment_map, dusk::radiance_file())?;
        Ok(Self { renderer, docs: shell::root()?.join("docs"), parts, environment_map })
    }

    fn paint(&self, picture: &Picture) -> Result<()> {
        let file = shell::root()?.join(FOLDER).join(format!("{}.png", picture.name));
        let size_px = picture.panel_px(GAP_PX);
        if let [panel] = picture.panels.as_slice()
            && panel.is_still()
        {
            return self.render(panel, size_px, &file);
        }
        let panels = picture.panels.iter().map(|panel| self.panel(panel, size_px));
        let panels: Vec<Image> = panels.collect::<Result<_>>()?;
        compose::montage(&panels, picture.columns, GAP_PX).write(&file)
    }

    /// Renders a panel and reads its pixels.
    fn panel(&self, panel: &Panel, size_px: [u32; 2]) -> Result<Image> {
        if let Some(frame) = panel.frame {
            // The renderer keeps existing frames and rejects a folder of another scene.
            let folder = self.parts.join("frames");
            if folder.exists() {
                fs::remove_dir_all(&folder)?;
            }
            let mut renderer = self.command("frames", panel, size_px, &folder)?;
            self.run(renderer.args(["--frames", &frame.to_string()]), panel)?;
            return Image::read_png(&folder.join(format!("frame_{frame:06}.png")));
        }
        if panel.layer == Layer::Color {
            let file = self.parts.join("panel.png");
            self.render(panel, size_px, &file)?;
            return Image::read_png(&file);
        }
        let file = self.parts.join("panel.exr");
        self.render(panel, size_px, &file)?;
        Image::read_exr(&file, panel.layer)
    }

    fn render(&self, panel: &Panel, size_px: [u32; 2], file: &Path) -> Result<()> {
        self.run(&mut self.command("render", panel, size_px, file)?, panel)
    }

    /// The renderer's command line without the scene.
    fn command(
        &self,
        verb: &str,
        panel: &Panel,
        [width, height]: [u32; 2],
        output: &Path,
    ) -> Result<Command> {
        let mut renderer = Command::new(&self.renderer);
        let samples = panel.samples.to_string();
        renderer.args([verb, "--quiet", "--samples", &samples]).arg("--output").arg(output);
        renderer.args(["--size", &format!("{width}x{height}")]);
        if panel.has_environment_map {
            renderer.arg("--environment").arg(&self.environment_map);
        }
        for change in &panel.changes {
            renderer.args(["--set", change]);
        }
        Ok(renderer)
    }

    /// Adds the scene to the command line and runs the renderer.
    ///
    /// The renderer reports changes of fields that the scene does not have.
    fn run(&self, renderer: &mut Command, panel: &Panel) -> Result<()> {
        let scene = if panel.scene.ends_with(".json") {
            self.docs.join(panel.scene)
        } else {
            let mut printer = Command::new(&self.renderer);
            printer.args(["scene", "--preset", panel.scene]);
            printer.args(panel.look.iter().flat_map(|look| ["--look", look]));
            let text = shell::output(&mut printer).with_context(|| {
                format!("no preset or look is named {:?}, {:?}", panel.scene, panel.look)
            })?;
            let file = self.parts.join("scene.json");
            fs::write(&file, text)?;
            file
        };
        shell::run(renderer.arg(scene))
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    fn root() -> PathBuf {
        Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
    }

    fn files_in(folder: &Path, extension: &str) -> Vec<PathBuf> {
        let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
        entries.filter(|path| path.extension().is_some_and(|found| found == extension)).collect()
    }

    /// The texts of the README and of every page of docs/.
    fn pages() -> Vec<String> {
        let mut files = files_in(&root().join("docs"), "md");
        files.push(root().join("README.md"));
        files.iter().map(|file| fs::read_to_string(file).unwrap()).collect()
    }

    #[test]
    fn the_folder_has_exactly_the_pictures_of_the_table() {
        let existing: BTreeSet<String> = fs::read_dir(root().join(FOLDER))
            .unwrap()
            .map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned())
            .collect();
        let named: Vec<String> =
            table::pictures().iter().map(|picture| format!("{}.png", picture.name)).collect();
        assert_eq!(existing, named.iter().cloned().collect(), "run `cargo xtask pictures`");
        assert_eq!(existing.len(), named.len(), "a name is in the table twice");
    }

    #[test]
    fn every_picture_is_shown_with_its_caption() {
        let pages = pages();
        for Picture { name, caption, .. } in table::pictures() {
            let html = format!("pictures/{name}.png\" width=\"640\" alt=\"{caption}\"");
            let forms = [
                html,
                format!("![{caption}](docs/pictures/{name}.png)"),
                format!("![{caption}](pictures/{name}.png)"),
            ];
            assert!(
                pages.iter().any(|page| forms.iter().any(|form| page.contains(form))),
                "neither the README nor a page of docs/ shows {name} as\n{}",
                forms.join("\n")
            );
        }
    }

    #[test]
    fn every_picture_that_is_shown_is_in_the_table() {
        let pictures = table::pictures();
        for page in pages() {
            for piece in page.split("pictures/").skip(1) {
                let Some((name, _)) = piece.split_once(".png") else { continue };
                if name.chars().all(|c| c.is_ascii_lowercase() || c == '-') {
                    assert!(pictures.iter().any(|p| p.name == name), "{name} is not in the table");
                }
            }
        }
    }

    #[test]
    fn the_pictures_have_the_sizes_of_the_table() {
        for picture in table::pictures() {
            let file = root().join(FOLDER).join(format!("{}.png", picture.name));
            let decoder =
                png::Decoder::new(std::io::BufReader::new(fs::File::open(&file).unwrap()));
            let size = decoder.read_info().unwrap().info().size();
            let [width, height] = picture.panel_px(GAP_PX);
            let (columns, rows) = (picture.columns, picture.panels.len() as u32 / picture.columns);
            let total = |panel, count| panel * count + GAP_PX * (count - 1);
            // A side-by-side stereo picture has twice the width.
            let sheet = picture.panels[0].changes.contains(&"camera.stereo.layout=side_by_side");
            let width = if sheet { 2 * width } else { width };
            assert_eq!(size, (total(width, columns), total(height, rows)), "{}", picture.name);
        }
    }

    #[test]
    fn the_scene_files_of_the_table_exist() {
        for panel in table::pictures().iter().flat_map(|picture| &picture.panels) {
            if panel.scene.ends_with(".json") {
                assert!(root().join("docs").join(panel.scene).is_file(), "{}", panel.scene);
            }
        }
    }

    #[test]
    fn the_error_names_an_unknown_picture() {
        let error = selected(&["mandelbulb".into(), "teapot".into()]).err().unwrap();
        assert!(error.to_string().contains("teapot"), "{error}");
        assert_eq!(selected(&["mandelbulb".into()]).unwrap().len(), 1);
    }
}
