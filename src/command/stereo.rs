//! `--stereo`: the layout of both eyes' pictures.
//!
//! In: the arguments. Out: scenes with the layout, and the files of each picture.

use std::{
    path::{Path, PathBuf},
    sync::Arc,
};

use mandelight::{
    export::Eye,
    scene::{Project, Scene, StereoLayout},
};

/// The arguments of the stereo layout.
#[derive(Clone, Copy, clap::Args)]
pub struct StereoArguments {
    /// Layout of both eyes' pictures, instead of the scene's layout; pair writes one file per eye,
    /// with _left and _right added to the name
    #[arg(long, value_name = "LAYOUT")]
    stereo: Option<Layout>,
}

/// The values of `--stereo`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Layout {
    /// No stereo: one picture from the camera's position
    Off,
    /// The left eye's picture on the left, the right eye's on the right
    SideBySide,
    /// The left eye's picture on top, the right eye's below
    TopBottom,
    /// One picture for red-cyan glasses
    Anaglyph,
    /// One file per eye
    Pair,
}

impl StereoArguments {
    /// Sets the layout of a scene.
    pub fn apply(self, scene: &mut Scene) {
        let layout = match self.stereo {
            None => return,
            Some(Layout::Off) => StereoLayout::Off,
            // One layout for pairs makes their files independent of the scene's layout.
            Some(Layout::SideBySide | Layout::Pair) => StereoLayout::SideBySide,
            Some(Layout::TopBottom) => StereoLayout::TopBottom,
            Some(Layout::Anaglyph) => StereoLayout::Anaglyph,
        };
        scene.camera.stereo.layout = layout;
    }

    /// Sets the layout of a scene and of every key of its path.
    pub fn apply_to_all(self, project: &mut Project) {
        self.apply(&mut project.scene);
        for key in &mut project.path.keys {
            self.apply(Arc::make_mut(&mut key.scene));
        }
    }

    /// The eye of each file of a picture: one file, or one per eye.
    pub fn eyes(self) -> &'static [Option<Eye>] {
        if self.stereo == Some(Layout::Pair) {
            &[Some(Eye::Left), Some(Eye::Right)]
        } else {
            &[None]
        }
    }
}

/// The path of one file of a stereo pair: `out_left.png` for `out.png`.
pub fn file_of(path: &Path, eye: Option<Eye>) -> PathBuf {
    let Some(eye) = eye else { return path.to_owned() };
    let mut name = path.file_stem().unwrap_or_default().to_owned();
    name.push(eye.suffix());
    if let Some(extension) = path.extension() {
        name.push(".");
        name.push(extension);
    }
    path.with_file_name(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_file_of_a_pair_has_its_suffix() {
        let named = |path: &str, eye| file_of(Path::new(path), eye);
        assert_eq!(named("a/out.png", None), Path::new("a/out.png"));
        assert_eq!(named("a/out.png", Some(Eye::Left)), Path::new("a/out_left.png"));
        assert_eq!(named("a.b/out.EXR", Some(Eye::Right)), Path::new("a.b/out_right.EXR"));
        assert_eq!(named("out", Some(Eye::Left)), Path::new("out_left"));
    }
}
