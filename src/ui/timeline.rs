//! The playhead: which moment of the camera path is in view, and what keys do with it.
//!
//! In: the project under edit and the wishes of panel and keyboard. Out: an edited path, and the
//! scene of the moment in view. Whenever the playhead moves, the view follows it; a view of one's
//! own that it replaces is a step that undo brings back. Knows no widgets.

use std::sync::Arc;

use super::{editor::Editor, shortcuts::Command};
use crate::scene::{
    Path, Project, Scene,
    path::{Easing, KEY_TIME, Key},
};

/// From the last key to one that is added after it, seconds.
const NEXT_KEY_SECS: f64 = 3.0;
/// The longest that playing goes on at once after a pause of the page, seconds.
const LONGEST_STEP_SECS: f64 = 0.25;

/// The playhead and the selected key. They belong to no scene.
#[derive(Debug, Default)]
pub(super) struct Timeline {
    /// Where the playhead stands, seconds.
    secs: f64,
    /// Since when it plays, on egui's clock.
    played_secs: Option<f64>,
    /// Whether the pointer drags the playhead or a key.
    pub held: bool,
    /// The key under edit.
    selected: Option<usize>,
    /// First and last frame of the sequence to save; none for all.
    pub frames: Option<[u32; 2]>,
    /// Whether the view is to show the playhead's moment.
    follows: bool,
    /// What the path has at the playhead, as last looked up.
    moment: Option<Moment>,
    /// Whether the view showed the playhead's moment when this frame began.
    was_on_path: bool,
    /// Whether scene and path were replaced as a whole.
    was_restored: bool,
}

/// A looked-up moment.
#[derive(Debug)]
struct Moment {
    path: Path,
    secs: f64,
    scene: Scene,
}

impl Timeline {
    /// Where the playhead stands, seconds.
    pub fn secs(&self) -> f64 {
        self.secs
    }

    /// Whether time runs.
    pub fn is_playing(&self) -> bool {
        self.played_secs.is_some()
    }

    /// Whether the view is on its way through the path.
    pub fn is_moving(&self) -> bool {
        self.held || self.is_playing()
    }

    /// The key under edit, where the path has it.
    pub fn selected(&self, path: &Path) -> Option<usize> {
        self.selected.filter(|&index| index < path.keys.len())
    }

    /// Puts the playhead at the frame nearest to `secs`; the view follows.
    pub fn seek(&mut self, path: &Path, secs: f64) {
        let last_secs = path.frame_secs(path.frame_count().saturating_sub(1));
        let secs = path.frame_secs(path.nearest_frame(secs.clamp(0.0, last_secs)));
        // A key that lies off the frames is met all the same.
        self.secs = path.key_at(secs).map_or(secs, |index| path.keys[index].time_secs);
        self.selected = path.key_at(self.secs).or(self.selected);
        self.follows = true;
    }

    /// Selects a key and goes there.
    pub fn select(&mut self, path: &Path, index: usize) {
        if let Some(key) = path.keys.get(index) {
            self.secs = key.time_secs;
            self.selected = Some(index);
            self.follows = true;
        }
    }

    /// Moves a key, as far as its neighbours let it, to the frame nearest to `secs`. A playhead
    /// on it goes along.
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
        let went_along = (self.secs - key.time_secs).abs() < 1e-9;
        key.time_secs = secs.clamp(low, high);
        if went_along {
            self.secs = key.time_secs;
        }
    }

    /// Whether the view shows the playhead's moment.
    fn is_on_path(&mut self, project: &Project) -> bool {
        self.moment(&project.path).is_some_and(|scene| *scene == project.scene)
    }

    fn moment(&mut self, path: &Path) -> Option<&Scene> {
        let known = self.moment.as_ref().is_some_and(|m| m.secs == self.secs && m.path == *path);
        if !known {
            let scene = path.at(self.secs);
            self.moment = scene.map(|scene| Moment { path: path.clone(), secs: self.secs, scene });
        }
        self.moment.as_ref().map(|moment| &moment.scene)
    }

    /// Begins a frame of the interface. What the path has at the playhead is only looked up
    /// where somebody sees it.
    pub fn begin(&mut self, project: &Project, open: bool) {
        self.held = false;
        self.was_on_path = open && self.is_on_path(project);
    }

    /// Whether the view showed the playhead's moment when this frame began.
    pub fn was_on_path(&self) -> bool {
        self.was_on_path
    }

    /// Does what a key or a button asks for.
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
                }
            }
            Command::DeleteKey => {
                if let Some(index) = self.selected(path) {
                    project.path.keys.remove(index);
                    self.selected = None;
                    self.secs = self.secs.min(project.path.duration_secs());
                }
            }
            Command::PreviousKey => {
                if let Some(index) = path.keys.iter().rposition(|k| k.time_secs < self.secs - 1e-9)
                {
                    self.select(path, index);
                }
            }
            Command::NextKey => {
                if let Some(index) = path.keys.iter().position(|k| k.time_secs > self.secs + 1e-9) {
                    self.select(path, index);
                }
            }
            _ => {}
        }
    }

    /// Keeps the view as a key: at the playhead or, where there is a key already, after the last.
    fn add_key(&mut self, project: &mut Project) {
        let path = &mut project.path;
        let secs = match path.key_at(self.secs) {
            None => self.secs,
            Some(_) => path.duration_secs() + NEXT_KEY_SECS,
        };
        let secs = path.frame_secs(path.nearest_frame(secs)).min(KEY_TIME.max);
        let scene = Arc::new(project.scene.clone());
        let key = Key { time_secs: secs, easing: Easing::default(), scene };
        // Beyond the longest path there is no room for another.
        if path.key_at(secs).is_none()
            && let Some(index) = path.insert(key)
        {
            self.secs = secs;
            self.selected = Some(index);
        }
    }

    /// Ends a frame of the interface that began with `before`: plays on, and puts the playhead's
    /// moment in view where it has moved, or where the path has changed under a view that was
    /// on it.
    pub fn follow(&mut self, editor: &mut Editor, before: &Project, now_secs: f64) {
        let project = editor.project();
        let by_hand = project.scene != before.scene;
        self.selected = self.selected(&project.path);
        if project.path.is_empty() || (by_hand && !self.follows) {
            self.played_secs = None;
        }
        if let Some(played_secs) = self.played_secs {
            let step_secs = (now_secs - played_secs).clamp(0.0, LONGEST_STEP_SECS);
            self.secs = looped(self.secs + step_secs, project.path.duration_secs());
            self.played_secs = Some(now_secs);
            self.follows = true;
        }
        let was_restored = std::mem::take(&mut self.was_restored);
        if was_restored {
            self.meet(project);
        }
        // What undo brings back is shown as it was.
        let edited = !was_restored && project.path != before.path;
        let carried = self.was_on_path && !by_hand && edited;
        if std::mem::take(&mut self.follows) || carried {
            let can_be_made_again = self.was_on_path;
            if let Some(scene) = self.moment(&project.path).cloned() {
                editor.show(scene, can_be_made_again);
            }
        }
    }

    /// Puts the playhead at the key whose scene is in view, if one is, and onto the path in any
    /// case.
    fn meet(&mut self, project: &Project) {
        let keys = &project.path.keys;
        self.secs = self.secs.min(project.path.duration_secs());
        if let Some(index) = keys.iter().position(|key| *key.scene == project.scene) {
            self.secs = keys[index].time_secs;
            self.selected = Some(index);
        }
    }

    /// Scene and path were replaced: nothing plays on.
    pub fn stop(&mut self) {
        self.played_secs = None;
        self.follows = false;
        self.was_restored = true;
    }
}

/// `secs` on a path that begins anew after `duration_secs`.
fn looped(secs: f64, duration_secs: f64) -> f64 {
    if secs <= duration_secs { secs } else { (secs - duration_secs).min(duration_secs) }
}
