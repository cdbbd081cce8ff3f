//! The playhead: the time of the camera path that is in view, and commands on keys.
//!
//! In: the edited project, and commands of the panel and the keyboard. Out: an edited path, and the
//! scene at the playhead. A view on the path follows the playhead. A view of the user's own stays while the playhead is
//! dragged, until it is stored as a key; playing, or going to a key, shows the path and puts the own view aside, where it can be
//! had back. This module does not depend on widgets.

use std::sync::Arc;

use super::{editor::Editor, shortcuts::Command};
use crate::scene::{
    Path, Project, Scene,
    path::{Easing, KEY_TIME, Key},
};

/// Time from the last key to a key that is added after it, seconds.
const NEXT_KEY_SECS: f64 = 3.0;
/// Maximum playback step after a pause of the page, seconds.
const MAX_STEP_SECS: f64 = 0.25;

/// The playhead and the selected key, which are not part of a scene.
#[derive(Debug, Default)]
pub(super) struct Timeline {
    /// The playhead's time, seconds.
    secs: f64,
    /// Time of the last playback step on egui's clock, seconds; none if paused.
    played_secs: Option<f64>,
    /// True while the pointer drags the playhead or a key.
    pub held: bool,
    /// Index of the selected key.
    selected: Option<usize>,
    /// First and last frame of the sequence to save; none for all.
    pub frames: Option<[u32; 2]>,
    /// True if the view must show the path's scene at the end of this frame.
    follows: bool,
    /// The user's own view that the path's replaced.
    aside: Option<Box<Scene>>,
    /// True if [`Self::aside`] must be the view at the end of this frame.
    returns: bool,
    /// The last computed scene of the path.
    cached: Option<CachedScene>,
    /// True if the view showed the path's scene when this frame began.
    was_on_path: bool,
    /// True if the whole project was replaced.
    was_restored: bool,
}

/// The scene of a path at a time.
#[derive(Debug)]
struct CachedScene {
    path: Path,
    secs: f64,
    scene: Scene,
}

impl Timeline {
    /// The playhead's time, seconds.
    pub fn secs(&self) -> f64 {
        self.secs
    }

    /// True during playback.
    pub fn is_playing(&self) -> bool {
        self.played_secs.is_some()
    }

    /// True during playback, or while the pointer drags the playhead or a key.
    pub fn is_moving(&self) -> bool {
        self.held || self.is_playing()
    }

    /// Index of the selected key, if the path has this key.
    pub fn selected(&self, path: &Path) -> Option<usize> {
        self.selected.filter(|&index| index < path.keys.len())
    }

    /// Moves the playhead to the frame nearest to `secs`, also after the last key. A view on the path follows.
    pub fn seek(&mut self, path: &Path, secs: f64) {
        let last_secs = if path.is_empty() { 0.0 } else { KEY_TIME.max };
        let secs = path.frame_secs(path.nearest_frame(secs.clamp(0.0, last_secs)));
        // A key may lie between two frames; the playhead then takes the key's exact time.
        self.secs = path.key_at(secs).map_or(secs, |index| path.keys[index].time_secs);
        self.selected = path.key_at(self.secs).or(self.selected);
        self.follows |= self.was_on_path;
    }

    /// Shows the path at the playhead, and puts the user's own view aside.
    pub fn return_to_path(&mut self) {
        self.follows = true;
    }

    /// True if there is a view to [return to](Self::return_to_own_view).
    pub fn has_own_view_aside(&self) -> bool {
        self.aside.is_some()
    }

    /// Shows the user's own view again that the path's replaced.
    pub fn return_to_own_view(&mut self) {
        self.played_secs = None;
        self.returns = true;
    }

    /// Selects a key and moves the playhead to the key. A view on the path follows.
    pub fn select(&mut self, path: &Path, index: usize) {
        if let Some(key) = path.keys.get(index) {
            self.secs = key.time_secs;
            self.selected = Some(index);
            self.follows |= self.was_on_path;
        }
    }

    /// Selects a key and shows it.
    pub fn show_key(&mut self, path: &Path, index: usize) {
        self.select(path, index);
        self.return_to_path();
    }

    /// Moves a key to the frame nearest to `secs`, between its neighbours.
    ///
    /// A playhead at the key moves with the key.
    pub fn retime(&mut self, path: &mut Path, index: usize, secs: f64) {
        let frame_secs = path.frame_secs(1);
        let low = index.checked_sub(1).and_then(|before| path.keys.get(before));
        let low = low.map_or(KEY_TIME.min, |key| key.time_secs + frame_secs);
        let high = path.keys.get(index + 1);
        let high = high.map_or(KEY_TIME.max, |key| key.time_secs - frame_secs);
        let secs = path.frame_secs(path.nearest_frame(secs));
        let Some(key) = path.keys.get_mut(index).filter(|_| secs.is_finite() && low <= high) else {
            return;
        };
        let playhead_at_key = (self.secs - key.time_secs).abs() < 1e-9;
        key.time_secs = secs.clamp(low, high);
        if playhead_at_key {
            self.secs = key.time_secs;
        }
    }

    /// True if the view shows the path's scene at the playhead.
    fn is_on_path(&mut self, project: &Project) -> bool {
        self.path_scene(&project.path).is_some_and(|scene| *scene == project.scene)
    }

    /// The path's scene at the playhead.
    fn path_scene(&mut self, path: &Path) -> Option<&Scene> {
        let is_valid = self.cached.as_ref().is_some_and(|c| c.secs == self.secs && c.path == *path);
        if !is_valid {
            let scene = path.at(self.secs);
            self.cached =
                scene.map(|scene| CachedScene { path: path.clone(), secs: self.secs, scene });
        }
        self.cached.as_ref().map(|cached| &cached.scene)
    }

    /// Begins a frame of the interface.
    ///
    /// The path's scene is computed only if the timeline is `open`.
    pub fn begin(&mut self, project: &Project, open: bool) {
        self.held = false;
        self.was_on_path = open && self.is_on_path(project);
    }

    /// True if the view showed the path's scene when this frame began.
    pub fn was_on_path(&self) -> bool {
        self.was_on_path
    }

    /// Executes a command of a keyboard key or a button.
    pub fn command(&mut self, command: Command, project: &mut Project, now_secs: f64) {
        let path = &project.path;
        match command {
            Command::PlayPause if self.is_playing() => self.played_secs = None,
            Command::PlayPause if path.keys.len() > 1 => {
                if self.secs >= path.duration_secs() {
                    self.seek(path, 0.0);
                }
                self.follows = true;
                self.played_secs = Some(now_secs);
            }
            Command::AddKey => self.add_key(project),
            Command::UpdateKey => {
                if let Some(index) = path.key_at(self.secs) {
                    project.path.keys[index].scene = Arc::new(project.scene.clone());
                    self.forget_if_stored(&project.scene);
                }
            }
            Command::DeleteKey => {
                if let Some(index) = self.selected(path) {
                    project.path.keys.remove(index);
                    self.selected = None;
                }
            }
            Command::PreviousKey => {
                if let Some(index) = path.keys.iter().rposition(|k| k.time_secs < self.secs - 1e-9)
                {
                    self.show_key(path, index);
                }
            }
            Command::NextKey => {
                if let Some(index) = path.keys.iter().position(|k| k.time_secs > self.secs + 1e-9) {
                    self.show_key(path, index);
                }
            }
            _ => {}
        }
    }

    /// Adds the view as a key at the playhead.
    ///
    /// If the playhead is at a key, the new key follows the last key.
    fn add_key(&mut self, project: &mut Project) {
        let path = &mut project.path;
        let secs = match path.key_at(self.secs) {
            None => self.secs,
            Some(_) => path.duration_secs() + NEXT_KEY_SECS,
        };
        let secs = path.frame_secs(path.nearest_frame(secs)).min(KEY_TIME.max);
        let scene = Arc::new(project.scene.clone());
        let key = Key { time_secs: secs, easing: Easing::default(), scene };
        // At the maximum time there is no room for another key.
        if path.key_at(secs).is_none()
            && let Some(index) = path.insert(key)
        {
            self.secs = secs;
            self.selected = Some(index);
            self.forget_if_stored(&project.scene);
        }
    }

    /// Keeps the user's own view aside unless `stored`, the scene of a key, is that view.
    fn forget_if_stored(&mut self, stored: &Scene) {
        self.aside.take_if(|own| **own == *stored);
    }

    /// Ends a frame of the interface: advances the playback and updates the view.
    ///
    /// `before` is the project at the frame's start. The view shows the path's scene if the
    /// playhead has moved, or if the path has changed and the view was on the path.
    pub fn end_frame(&mut self, editor: &mut Editor, before: &Project, now_secs: f64) {
        let project = editor.project();
        let scene_edited = project.scene != before.scene;
        self.selected = self.selected(&project.path);
        if project.path.is_empty() || (scene_edited && !self.follows) {
            self.played_secs = None;
        }
        if let Some(played_secs) = self.played_secs {
            let step_secs = (now_secs - played_secs).clamp(0.0, MAX_STEP_SECS);
            self.secs = looped(self.secs + step_secs, project.path.duration_secs());
            self.played_secs = Some(now_secs);
            self.follows = true;
        }
        let was_restored = std::mem::take(&mut self.was_restored);
        if was_restored {
            self.sync_to(project);
        }
        // A restored project shows its scene without a change.
        let path_edited = !was_restored && project.path != before.path;
        let path_changed_below = self.was_on_path && !scene_edited && path_edited;
        let follows = std::mem::take(&mut self.follows);
        if std::mem::take(&mut self.returns) {
            if let Some(own) = self.aside.take() {
                // The view that it replaces is the user's own too, unless it is the path's.
                if !self.was_on_path && *own != project.scene {
                    self.aside = Some(Box::new(project.scene.clone()));
                }
                editor.show(*own, self.was_on_path);
            }
        } else if follows || path_changed_below {
            let was_on_path = self.was_on_path;
            if let Some(scene) = self.path_scene(&project.path).cloned() {
                if !was_on_path && scene != project.scene {
                    self.aside = Some(Box::new(project.scene.clone()));
                }
                editor.show(scene, was_on_path);
            }
        }
    }

    /// Moves the playhead to the key whose scene is in view, if any.
    ///
    /// Otherwise clamps the playhead to the path's duration.
    fn sync_to(&mut self, project: &Project) {
        let keys = &project.path.keys;
        self.secs = self.secs.min(project.path.duration_secs());
        if let Some(index) = keys.iter().position(|key| *key.scene == project.scene) {
            self.secs = keys[index].time_secs;
            self.selected = Some(index);
        }
    }

    /// Stops the playback after the whole project was replaced.
    pub fn stop(&mut self) {
        self.played_secs = None;
        self.follows = false;
        self.aside = None;
        self.was_restored = true;
    }
}

/// `secs` on a path that repeats after `duration_secs`.
fn looped(secs: f64, duration_secs: f64) -> f64 {
    if secs <= duration_secs { secs } else { (secs - duration_secs).min(duration_secs) }
}
