//! How both eyes' pictures are put together, as a command was asked.
//!
//! In: the arguments. Out: scenes with that layout, and which files there are to be.

use std::{
    path::{Path, PathBuf},
    sync::Arc,
};

use mandelight::{
    export::Eye,
    scene::{Project, Scene, StereoLayout},
};

/// The layout that was asked for.
#[derive(Clone, Copy, clap::Args)]
pub struct StereoArguments {
    /// How both eyes' pictures are put together, in place of the scene's own layout; pair writes a
    /// file for each eye, _left and _right added to its name
    #[arg(long, value_name = "LAYOUT")]
    stereo: Option<Layout>,
}

/// What `--stereo` takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Layout {
    /// One picture, seen from the camera itself
    Off,
    /// The left eye's picture left of the right one's
    SideBySide,
    /// The left eye's picture above the right one's
    TopBottom,
    /// One picture for red-cyan glasses
    Anaglyph,
    /// A file for each eye
    Pair,
}

impl StereoArguments {
    /// Gives a scene the layout.
    pub fn lay_out(self, scene: &mut Scene) {
        let layout = match self.stereo {
            None => return,
            Some(Layout::Off) => StereoLayout::Off,
            // So that a frame of a pair is the same whatever layout the scene had.
            Some(Layout::SideBySide | Layout::Pair) => StereoLayout::SideBySide,
            Some(Layout::TopBottom) => StereoLayout::TopBottom,
            Some(Layout::Anaglyph) => StereoLayout::Anaglyph,
        };
        scene.camera.stereo.layout = layout;
    }

    /// Gives it to a scene and every key of its path.
    pub fn lay_out_all(self, project: &mut Project) {
        self.lay_out(&mut project.scene);
        for key in &mut project.path.keys {
            self.lay_out(Arc::make_mut(&mut key.scene));
        }
    }

    /// The files that a picture becomes: one, or one for each eye.
    pub fn eyes(self) -> &'static [Option<Eye>] {
        if self.stereo == Some(Layout::Pair) {
            &[Some(Eye::Left), Some(Eye::Right)]
        } else {
            &[None]
        }
    }
}

/// The file of one of a pair: `out_left.png` of `out.png`.
pub fn file_of(path: &Path, eye: Option<Eye>) -> PathBuf {
    let Some(eye) = eye else { return path.to_owned() };
    let mut name = path.file_stem().unwrap_or_default().to_owned();
    name.push(eye.suffix());
    if let Some(ending) = path.extension() {
        name.push(".");
        name.push(ending);
    }
    path.with_file_name(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_of_a_pair_has_its_name() {
        let named = |path: &str, eye| file_of(Path::new(path), eye);
        assert_eq!(named("a/out.png", None), Path::new("a/out.png"));
        assert_eq!(named("a/out.png", Some(Eye::Left)), Path::new("a/out_left.png"));
        assert_eq!(named("a.b/out.EXR", Some(Eye::Right)), Path::new("a.b/out_right.EXR"));
        assert_eq!(named("out", Some(Eye::Left)), Path::new("out_left"));
    }
}
