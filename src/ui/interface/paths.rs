//! The camera path and its timeline: paths that are made by one command, and whether the timeline is open.

use super::Interface;
use crate::{
    scene::{Path, Project},
    ui::{
        dive,
        export_size::{ExportSize, VideoSpec},
    },
};

/// Seconds of a turn around the scene.
const TURNTABLE_SECS: f64 = 12.0;

impl Interface {
    /// Makes the last dive the camera path.
    pub(super) fn keep_dive(&mut self, wide: bool) {
        let Project { scene, mut path } = self.project().clone();
        path.keys = dive::keys(self.pilot.dive_record(), &scene);
        self.pilot.forget_dive();
        self.use_path(path, wide);
    }

    /// Makes a turn around the scene the camera path.
    pub(super) fn make_turntable(&mut self, wide: bool) {
        let Project { scene, path } = self.project();
        let keys = Path::turntable(scene, TURNTABLE_SECS, path.frames_per_second).keys;
        self.use_path(Path { keys, ..path.clone() }, wide);
    }

    /// Replaces the camera path, as one undo step, and shows the timeline.
    fn use_path(&mut self, path: Path, wide: bool) {
        self.editor.replace(Project { path, ..self.project().clone() });
        if !self.settings.timeline_open {
            self.toggle_timeline(wide);
        }
    }

    /// The video that the timeline would save; none while it has nothing to save or is hidden.
    pub fn video(&self) -> Option<VideoSpec> {
        let path = &self.project().path;
        if !self.settings.timeline_open || path.frame_count() == 0 {
            return None;
        }
        // A video has both eyes' pictures in each frame.
        let export = ExportSize { pair: false, ..self.settings.export };
        let layout = self.scene().camera.stereo.layout;
        let size_px = export.file_px(self.view_px, layout);
        Some(VideoSpec { size_px, frames_per_second: path.frames_per_second })
    }

    /// Shows the timeline where it is hidden.
    pub(super) fn show_timeline(&mut self, wide: bool) {
        if !self.settings.timeline_open || (!wide && self.settings.panel_open) {
            self.toggle_timeline(wide);
        }
    }

    /// Shows or hides the timeline. A narrow window has room for either timeline or open sheet.
    pub(super) fn toggle_timeline(&mut self, wide: bool) {
        let open = &mut self.settings.timeline_open;
        let hidden_by_sheet = !wide && self.settings.panel_open;
        *open = !*open || hidden_by_sheet;
        if *open && !wide {
            self.settings.panel_open = false;
        }
        if !*open {
            self.timeline.stop();
        }
    }
}
