//! The page's icons: the opening scene, on the ground of the interface.
//!
//! In: the opening scene, by the command line program. Out: PNG files in `www/`, which `manifest.webmanifest`
//! and `index.html` name.

use std::{fs, path::Path, process::Command};

use anyhow::{Context as _, Result};

use crate::{
    pictures::{compose::Image, framing::fov_deg},
    shell,
};

/// The files, in `www/`.
pub const FILES: [&str; 4] =
    ["icon-192.png", "icon-512.png", "icon-maskable-512.png", "apple-touch-icon.png"];

/// How each file shows the scene.
const ICONS: [Icon; 4] = [
    Icon { side_px: 192, span: 1.0, is_rounded: true },
    Icon { side_px: 512, span: 1.0, is_rounded: true },
    // Systems cut maskable icons to any shape that contains the middle circle of 80 %.
    Icon { side_px: 512, span: 0.8, is_rounded: false },
    // The size of Apple's largest phones; their system rounds the corners.
    Icon { side_px: 180, span: 0.9, is_rounded: false },
];

/// The ground, `background_color` of `manifest.webmanifest`.
const GROUND: [u8; 3] = [0x0b, 0x0d, 0x12];

/// Radius of rounded corners as a part of the side, as in `favicon.svg`.
const CORNER: f64 = 7.0 / 32.0;

/// Step between the levels of a channel: half the bytes, and no difference that is seen on detail this fine.
const STEP: u16 = 8;

/// Samples per pixel: edges must be smooth at these sizes.
const SAMPLES: u32 = 64;

struct Icon {
    side_px: u32,
    /// Part of the height that the scene's own view spans.
    span: f64,
    is_rounded: bool,
}

/// Renders all icons.
pub fn icons(renderer: &Path) -> Result<()> {
    let scene =
        shell::output(Command::new(renderer).arg("scene")).context("`mandelight scene` failed")?;
    let parts = shell::target()?.join("thumbnails");
    fs::create_dir_all(&parts)?;
    let (document, picture) = (parts.join("icon.json"), parts.join("icon.png"));
    fs::write(&document, &scene)?;
    for (name, icon) in FILES.iter().zip(&ICONS) {
        let mut render = Command::new(renderer);
        render.args(["render", "--quiet", "--transparent", "--samples", &SAMPLES.to_string()]);
        render.args(["--size", &format!("{0}x{0}", icon.side_px)]);
        let fov = fov_deg(&scene, icon.span)?;
        render.args(["--set", &format!("camera.vertical_fov_deg={fov}")]);
        shell::run(render.arg("--output").arg(&picture).arg(&document))?;
        let mut image = Image::read_png(&picture)?;
        image.map(|place, pixel| icon.finish(place, pixel));
        let file = shell::root()?.join("www").join(name);
        image.write(&file).with_context(|| file.display().to_string())?;
        eprintln!("www/{name}: {:.1} kB", fs::metadata(&file)?.len() as f64 / 1e3);
    }
    Ok(())
}

impl Icon {
    /// A pixel of the scene on the ground, within the icon's shape.
    fn finish(&self, place: [u32; 2], [r, g, b, alpha]: [u8; 4]) -> [u8; 4] {
        let cover = f64::from(alpha) / 255.0;
        let over = |value: u8, ground: u8| {
            (f64::from(value) * cover + f64::from(ground) * (1.0 - cover)).round() as u8
        };
        let coarse = |value: u8| (u16::from(value) / STEP * STEP + STEP / 2).min(255) as u8;
        let [r, g, b] = match alpha {
            0 => GROUND,
            _ => [over(r, GROUND[0]), over(g, GROUND[1]), over(b, GROUND[2])].map(coarse),
        };
        let shape = if self.is_rounded { self.rounded(place) } else { 1.0 };
        [r, g, b, (shape * 255.0).round() as u8]
    }

    /// Part of a pixel within a square with rounded corners.
    fn rounded(&self, place: [u32; 2]) -> f64 {
        let half = f64::from(self.side_px) / 2.0;
        let radius = CORNER * f64::from(self.side_px);
        let beyond =
            place.map(|at| ((f64::from(at) + 0.5 - half).abs() - (half - radius)).max(0.0));
        (radius - beyond[0].hypot(beyond[1]) + 0.5).clamp(0.0, 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn image(index: usize) -> Image {
        Image::read_png(&shell::root().unwrap().join("www").join(FILES[index])).unwrap()
    }

    #[test]
    fn the_files_have_the_sizes_that_are_named() {
        let manifest = include_str!("../../www/manifest.webmanifest");
        let index = include_str!("../../www/index.html");
        for (i, (name, icon)) in FILES.iter().zip(&ICONS).enumerate() {
            let image = image(i);
            let (size_px, _) = image.as_rgba();
            assert_eq!(size_px, [icon.side_px; 2], "{name}");
            let purpose = if name.contains("maskable") { "maskable" } else { "any" };
            let entry = format!(
                "\"src\": \"./{name}\", \"sizes\": \"{0}x{0}\", \"type\": \"image/png\", \"purpose\": \"{purpose}\"",
                icon.side_px
            );
            let link = format!("<link rel=\"apple-touch-icon\" href=\"./{name}\">");
            assert!(manifest.contains(&entry) || index.contains(&link), "{name}: {entry}");
        }
        let hex: String = GROUND.iter().map(|value| format!("{value:02x}")).collect();
        assert!(manifest.contains(&format!("\"background_color\": \"#{hex}\"")));
    }

    #[test]
    fn icons_show_the_scene_within_their_shape() {
        for (i, (name, icon)) in FILES.iter().zip(&ICONS).enumerate() {
            let image = image(i);
            let (_, bytes) = image.as_rgba();
            let pixels = bytes.as_chunks::<4>().0;
            let half = f64::from(icon.side_px) / 2.0;
            let (mut shown, mut beyond) = (0, 0);
            for (index, [r, g, b, alpha]) in (0..).zip(pixels) {
                let place = [index % icon.side_px, index / icon.side_px];
                let expected = if icon.is_rounded { icon.rounded(place) } else { 1.0 };
                assert_eq!(f64::from(*alpha), (expected * 255.0).round(), "{name}: {place:?}");
                if [*r, *g, *b] != GROUND {
                    shown += 1;
                    let [x, y] = place.map(|at| f64::from(at) + 0.5 - half);
                    beyond += u32::from(x.hypot(y) > 0.4 * f64::from(icon.side_px));
                }
            }
            let part = f64::from(shown) / f64::from(icon.side_px * icon.side_px);
            assert!(part > 0.25, "{name} shows little: {part}");
            assert!(!name.contains("maskable") || beyond == 0, "{name}: {beyond} pixels are cut");
        }
    }

    #[test]
    fn icons_stay_small() {
        let www = shell::root().unwrap().join("www");
        let bytes: u64 = FILES.iter().map(|name| www.join(name).metadata().unwrap().len()).sum();
        assert!(bytes < 500_000, "{bytes}");
    }
}
