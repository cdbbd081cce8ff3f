//! A look in the view while its swatch is under the pointer or has the keyboard. The document stays as it is.

use crate::scene::{
    Scene,
    looks::{self, Look},
};

/// The preview of a look, if any.
#[derive(Debug, Default)]
pub struct LookPreview {
    /// The look of the swatch that this frame's panels found under the pointer or with the keyboard.
    pointed: Option<&'static Look>,
    /// The same of the last frame.
    last: Option<&'static Look>,
    shown: Option<Shown>,
    /// A look that is shown no more until its swatch is left: the scene has changed since.
    ended: Option<&'static Look>,
}

#[derive(Debug)]
struct Shown {
    look: &'static Look,
    /// The document's scene.
    before: Scene,
    /// The same with the look.
    scene: Scene,
}

impl LookPreview {
    /// Points at a look by the keyboard, unless the pointer does.
    pub fn focus(&mut self, look: &'static Look) {
        self.pointed.get_or_insert(look);
    }

    /// Points at a look by the pointer, which `has_moved` in this frame.
    ///
    /// A swatch that scrolls under a resting pointer is not pointed at.
    pub fn hover(&mut self, look: &'static Look, has_moved: bool) {
        if has_moved || self.last.is_some_and(|last| std::ptr::eq(last, look)) {
            self.pointed = Some(look);
        }
    }

    /// The scene to show instead of the document's.
    pub fn scene(&self) -> Option<&Scene> {
        self.shown.as_ref().map(|shown| &shown.scene)
    }

    /// The name of the shown look.
    pub fn name(&self) -> Option<&'static str> {
        self.shown.as_ref().map(|shown| shown.look.name.as_str())
    }

    /// Shows the pointed look on the document's `scene`, unless the view `is_busy` with a movement or a gesture.
    ///
    /// Returns whether another scene is shown than before. A change of the scene, such as a click on the swatch or
    /// an undo step, ends the preview: the change itself is to be seen.
    pub fn update(&mut self, scene: &Scene, is_busy: bool) -> bool {
        let pointed = self.pointed.take();
        self.last = pointed;
        let is_same = |a: Option<&Look>| a.zip(pointed).is_some_and(|(a, b)| std::ptr::eq(a, b));
        if !is_same(self.ended) {
            self.ended = None;
        }
        if let Some(shown) = &self.shown
            && is_same(Some(shown.look))
            && shown.before != *scene
        {
            self.ended = pointed;
        }
        let look = pointed.filter(|_| !is_busy && self.ended.is_none());
        let is_shown = match (&self.shown, look) {
            (Some(shown), Some(look)) => std::ptr::eq(shown.look, look),
            (shown, look) => shown.is_none() && look.is_none(),
        };
        if !is_shown {
            self.shown = look.map(|look| {
                let looked = looks::applied(look, scene);
                Shown { look, before: scene.clone(), scene: looked }
            });
        }
        !is_shown
    }
}
