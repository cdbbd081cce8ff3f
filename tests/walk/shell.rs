//! The shell's part: files, exports, notices and galleries, and the interface's requests.

use std::sync::Arc;

use egui::TextureId;
use glam::DVec3;
use mandelight::{
    export::png::PngStream,
    scene::{
        EnvironmentMap, Path, Project, Scene,
        dice::Dice,
        document,
        gallery::Gallery,
        gradient, link,
        path::{Easing, Key},
        presets,
    },
    ui::{
        Action, ExportProgress, GalleryState, KeptPicture, MAX_EXPORT_SIDE_PX, Notice, ViewTexture,
    },
};

use crate::walker::Walker;

/// A small environment map.
pub fn small_map(name: &str) -> Arc<EnvironmentMap> {
    Arc::new(EnvironmentMap::from_fn(name, [16, 8], |to| DVec3::new(1.0 + to.x, 1.0, 1.5 + to.z)))
}

/// A scene with a path of some keys.
fn animated(scene: Scene, dice: &mut Dice) -> Project {
    let count = 1 + (dice.unit() * 6.0) as usize;
    let keys = (0..count).map(|index| {
        let mut scene = scene.clone();
        scene.tone.exposure = dice.signed();
        Key { time_secs: index as f64 * 0.7, easing: Easing::Linear, scene: scene.into() }
    });
    let keys: Vec<Key> = keys.collect();
    Project { scene, path: Path { keys, ..Path::default() } }
}

impl Walker {
    /// Drops a file on the page, which may be damaged.
    pub fn open_file(&mut self) {
        match self.below(6) {
            0..3 => self.open_document(),
            3 => {
                let name = self.pick(&["garden.hdr", "", "a\u{202e}\n", "9"]).to_owned();
                let name = if name == "9" { name.repeat(400) } else { name };
                self.log(format!("light by {} bytes of name", name.len()));
                let map = small_map(&name);
                self.harness.state_mut().interface.use_environment_map(map);
            }
            4 => {
                let text = self.pick(&[
                    "GIMP Palette\nName: two\n#\n255 0 0 red\n0 0 255 blue\n",
                    "GIMP Palette\n",
                    "GIMP Gradient\nName: g\n1\n0 0.5 1 1 0 0 1 0 0 1 1 0 0\n",
                    "255 0 0\n0 255 0\n0 0 255\n",
                    "",
                ]);
                let bytes = self.damaged(text.as_bytes().to_vec());
                let read = gradient::read(&bytes, "a palette");
                self.log(format!("colour by {read:?}"));
                if let Ok(gradients) = read {
                    self.harness.state_mut().interface.use_gradients(gradients);
                }
            }
            _ => {
                let document = document::project_to_json_compact(&self.some_project());
                let document = self.damaged(document.into_bytes());
                let document = String::from_utf8_lossy(&document).into_owned();
                let picture = self.picture();
                let picture = self.damaged(picture);
                self.log(format!("keep a view of {} bytes", document.len()));
                self.harness.state_mut().interface.keep_favourite(document, picture);
            }
        }
        self.frame();
        self.frame();
    }

    fn open_document(&mut self) {
        let text = document::project_to_json(&self.some_project());
        let bytes = self.damaged(text.into_bytes());
        let read = document::project_from_json(&String::from_utf8_lossy(&bytes));
        match read {
            Ok(project) if self.dice.chance(0.7) => {
                self.log("open a document".to_owned());
                self.harness.state_mut().interface.replace_project(project);
            }
            Ok(project) => {
                self.log("fly into a document".to_owned());
                self.harness.state_mut().interface.fly_into(project);
            }
            Err(error) => {
                self.log(format!("refuse a document: {error}"));
                let text = error.to_string();
                self.harness.state_mut().notice =
                    Some(Notice { text, is_error: true, ..Notice::default() });
            }
        }
    }

    /// A preset, with or without a path, or what is in view.
    fn some_project(&mut self) -> Project {
        if self.dice.chance(0.3) {
            return self.harness.state().interface.project().clone();
        }
        let all: Vec<_> = presets::all().collect();
        let scene = (self.pick(&all).scene)();
        if self.dice.chance(0.5) { animated(scene, &mut self.dice) } else { scene.into() }
    }

    /// A small picture of the view.
    fn picture(&mut self) -> Vec<u8> {
        let scene = self.harness.state().interface.scene();
        let shade = (self.actions() % 251) as u8;
        let mut png =
            PngStream::new(Vec::new(), [4, 3], &document::to_json(scene)).expect("a size");
        png.write_pixels(&[shade, 9, 9].repeat(12)).expect("all pixels");
        png.finish().expect("a whole picture")
    }

    /// Mostly the same bytes; else some are changed, or the end is missing.
    fn damaged(&mut self, mut bytes: Vec<u8>) -> Vec<u8> {
        if bytes.is_empty() || self.dice.chance(0.6) {
            return bytes;
        }
        for _ in 0..1 + self.below(4) {
            let at = self.below(bytes.len());
            bytes[at] = self.pick(b"0e-{}[]\",:9\xff ");
        }
        if self.dice.chance(0.3) {
            let length = self.below(bytes.len());
            bytes.truncate(length);
        }
        bytes
    }

    /// Changes what the shell shows: an export, a notice, a gallery, pictures.
    pub fn change_shell(&mut self) {
        match self.below(5) {
            0 | 1 => {
                let done = self.dice.unit() as f32;
                let remaining_secs = self.pick(&[None, Some(0.0), Some(75.0), Some(1e9)]);
                self.log(format!("an export is at {done}"));
                self.harness.state_mut().export =
                    self.dice.chance(0.8).then_some(ExportProgress { done, remaining_secs });
            }
            2 => {
                let text = self
                    .pick(&["Saved.", "", "a very long message ".repeat(60).as_str()])
                    .to_owned();
                self.log("a notice".to_owned());
                let is_error = self.dice.chance(0.5);
                self.harness.state_mut().notice =
                    self.dice.chance(0.7).then_some(Notice { text, is_error, ..Notice::default() });
            }
            3 => {
                self.log("another gallery".to_owned());
                let state = match self.below(4) {
                    0 => None,
                    1 => Some(GalleryState::Loading),
                    2 => Some(GalleryState::Failed("No list is there.".to_owned())),
                    _ => {
                        let files = ["reef.png", "deep/cove.png"].map(str::to_owned);
                        let gallery = Gallery::new("Reefs", files).expect("a list");
                        let address = "https://example.org/reefs/".to_owned();
                        Some(GalleryState::Ready { address, gallery })
                    }
                };
                self.harness.state_mut().gallery = state;
            }
            _ => {
                self.log("other pictures".to_owned());
                let picture = |number| {
                    let size_px = [640, 360];
                    ViewTexture { texture: TextureId::User(number), size_px }
                };
                let (has_picture, has_kept) = (self.dice.chance(0.8), self.dice.chance(0.3));
                let span = self.pick(&[1.0, 0.2, 1e-6, 5.0]);
                let stage = self.harness.state_mut();
                stage.picture = has_picture.then_some(picture(1));
                stage.kept_picture = has_kept.then_some(KeptPicture { picture: picture(2), span });
                let wanted: Vec<_> =
                    stage.interface.small_pictures().map(|small| small.id).collect();
                let drawn = wanted.into_iter().zip(3..).map(|(id, number)| (id, picture(number)));
                stage.small_pictures.by_id = drawn.take(6).collect();
            }
        }
        self.frame();
    }

    /// Does what the interface asked the shell for.
    pub fn answer(&mut self) {
        for action in std::mem::take(&mut self.harness.state_mut().actions) {
            self.log(format!("  asked for {action:?}"));
            let begins_export = match action {
                Action::SavePicture { size_px, .. } => Some((size_px, [0, 1])),
                Action::SaveSequence { size_px, frames, .. } => Some((size_px, frames)),
                _ => None,
            };
            if let Some((size_px, frames)) = begins_export {
                let is_valid = |side: &u32| (1..=MAX_EXPORT_SIDE_PX).contains(side);
                assert!(size_px.iter().all(is_valid), "an export of {size_px:?}");
                assert!(frames[0] < frames[1], "an export of frames {frames:?}");
                let progress = ExportProgress { done: 0.0, remaining_secs: None };
                self.harness.state_mut().export = Some(progress);
            }
            match action {
                Action::CancelExport => self.harness.state_mut().export = None,
                Action::DismissNotice => self.harness.state_mut().notice = None,
                Action::LoadScene | Action::ChooseEnvironmentMap | Action::ChooseGradient => {
                    self.open_file();
                }
                Action::KeepFavourite => {
                    let interface = &self.harness.state().interface;
                    let document = document::project_to_json_compact(interface.project());
                    let picture = self.picture();
                    self.harness.state_mut().interface.keep_favourite(document, picture);
                }
                Action::OpenGalleryPicture(_) => {
                    let project = self.some_project();
                    self.harness.state_mut().interface.fly_into(project);
                }
                Action::CopyLink => {
                    let project = self.harness.state().interface.project();
                    if let Ok(fragment) = link::project_to_fragment(project) {
                        assert_eq!(link::project_from_fragment(&fragment).as_ref(), Ok(project));
                    }
                }
                _ => {}
            }
        }
    }
}
