//! Motion blur: a view that draws a picture as the mean of sub-frames.

use std::sync::Arc;

use super::StillOptions;
use crate::{
    render::{
        Pace, Pipelines, Region, View, display_values::DisplayValues,
        pass::assess_noise::SAMPLES_PER_ROUND, report::ClampedLight, sub_frame::SubFrame,
    },
    scene::{EnvironmentMap, Path, Scene, param::NOISE},
};

/// Most sub-frames of a picture: what moves farther than as many pixels shows steps.
const MAX_SUB_FRAMES: u32 = 64;

/// The scenes of a picture: one, or with motion blur those of its sub-frames.
#[derive(Clone)]
pub(super) struct SubFrames {
    /// In the order in which they are drawn: the middle of the shutter time last. Its depths and normals remain.
    scenes: Vec<Scene>,
}

impl SubFrames {
    /// A picture without motion blur.
    pub fn single(scene: Scene) -> Self {
        Self { scenes: vec![scene] }
    }

    /// The picture of frame `frame` of `path`, whose scene is `scene`; both as `options` show them.
    pub fn of_frame(path: &Path, frame: u32, scene: &Scene, options: &StillOptions) -> Self {
        let samples = scene.quality.samples;
        // Where noise is estimated, whole rounds; at least a few sub_frames.
        let needs_rounds =
            scene.traces_paths() && (options.denoises(scene) || scene.integrator.noise > 0.0);
        let round = if needs_rounds { SAMPLES_PER_ROUND } else { 1 };
        let count = (samples / round).clamp(samples.min(SAMPLES_PER_ROUND), MAX_SUB_FRAMES);
        let scenes = path.shutter_scenes(frame, count);
        let mut scenes: Vec<_> = scenes.iter().map(|scene| options.shown(scene)).collect();
        if scenes.len() < 2 {
            return Self::single(scene.clone());
        }
        let middle = scenes.remove(scenes.len() / 2);
        scenes.push(middle);
        for scene in &mut scenes {
            scene.quality.samples = samples.div_ceil(count);
            // The mean of several pictures has less noise than each.
            let noise = scene.integrator.noise * f64::from(count).sqrt();
            scene.integrator.noise = noise.min(NOISE.max);
        }
        Self { scenes }
    }

    /// The same sub-frames, or fewer of them, with `samples` of each pixel in all, each changed by `change`.
    pub fn reduced(&self, samples: u32, change: impl Fn(&mut Scene)) -> Self {
        let count = self.scenes.len().min(samples.max(1) as usize);
        let step = self.scenes.len().div_ceil(count);
        // From the last on: the middle stays.
        let mut scenes: Vec<_> = self.scenes.iter().rev().step_by(step).cloned().collect();
        scenes.reverse();
        let samples = samples.div_ceil(scenes.len() as u32);
        for scene in &mut scenes {
            scene.quality.samples = samples;
            change(scene);
        }
        Self { scenes }
    }

    /// Changes each scene.
    pub fn change(&mut self, change: impl Fn(&mut Scene)) {
        self.scenes.iter_mut().for_each(change);
    }

    /// All scenes.
    pub fn scenes(&self) -> &[Scene] {
        &self.scenes
    }
}

/// A view that draws the sub-frames of a picture one after the other.
pub(super) struct SubFrameView {
    view: View,
    sub_frames: SubFrames,
    /// Index of the sub-frame that is being drawn.
    index: u32,
    /// What the firefly limit removed from the complete sub-frames; none without a limit.
    clamped_light: Option<ClampedLight>,
    is_finished: bool,
}

impl SubFrameView {
    /// A view of `region`, whose display holds `display_values`.
    pub fn new(
        pipelines: &Arc<Pipelines>,
        region: Region,
        environment_map: Option<&Arc<EnvironmentMap>>,
        sub_frames: SubFrames,
        display_values: DisplayValues,
    ) -> Self {
        let mut view = View::new(pipelines, region, Pace::Still);
        view.set_display_values(display_values);
        view.set_environment_map(environment_map);
        let mut this = Self { view, sub_frames, index: 0, clamped_light: None, is_finished: false };
        this.begin(0);
        this
    }

    /// A view that has the samples of a picture without motion blur.
    pub fn of_samples(view: View, sub_frames: SubFrames) -> Self {
        Self { view, sub_frames, index: 0, clamped_light: None, is_finished: false }
    }

    /// Draws without waiting; true while there is more to do.
    pub fn pump(&mut self, now_secs: f64) -> bool {
        if self.is_finished {
            return false;
        }
        if self.view.pump(now_secs) {
            return true;
        }
        if let Some(of_sub_frame) = self.view.report().clamped_light {
            let all = self.clamped_light.get_or_insert_default();
            all.light += of_sub_frame.light;
            all.clamped += of_sub_frame.clamped;
        }
        self.is_finished = self.index + 1 == self.count();
        if !self.is_finished {
            self.begin(self.index + 1);
        }
        !self.is_finished
    }

    /// Draws another region, from its first sub-frame on.
    pub fn set_region(&mut self, region: Region) {
        self.view.set_region(region);
        self.begin(0);
    }

    fn begin(&mut self, index: u32) {
        self.index = index;
        self.is_finished = false;
        let count = self.count();
        let scene = &self.sub_frames.scenes[index as usize];
        if count == 1 {
            self.view.set_scene(scene, false);
            return;
        }
        let first_sample = index * scene.quality.samples;
        self.view.set_sub_frame(scene, SubFrame { index, count, first_sample });
    }

    fn count(&self) -> u32 {
        // At most `MAX_SUB_FRAMES`.
        self.sub_frames.scenes.len() as u32
    }

    /// Completed fraction of the samples, 0 to 1.
    pub fn part_done(&self) -> f64 {
        let report = self.view.report();
        let of_sub_frame = f64::from(report.samples_done) / f64::from(report.samples_wanted.max(1));
        let done = if self.is_finished { 1.0 } else { of_sub_frame.min(1.0) };
        (f64::from(self.index) + done) / f64::from(self.count())
    }

    /// What the firefly limit removed from all complete sub-frames of all regions; none without a limit.
    pub fn clamped_light(&self) -> Option<ClampedLight> {
        self.clamped_light
    }

    /// Sets what the firefly limit removed from regions that another view drew.
    pub fn set_clamped_light(&mut self, clamped_light: Option<ClampedLight>) {
        self.clamped_light = clamped_light;
    }

    /// True if the picture is complete.
    pub fn is_finished(&self) -> bool {
        self.is_finished
    }

    /// The view, for its results.
    pub fn view(&self) -> &View {
        &self.view
    }

    /// The view, for what others lend it.
    pub fn view_mut(&mut self) -> &mut View {
        &mut self.view
    }
}
