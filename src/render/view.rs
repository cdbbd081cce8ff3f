//! One picture in progress: its buffers, its schedule, and the scene that it shows.

use std::sync::Arc;

use super::{
    anchors::Anchors,
    environment_texture::EnvironmentTexture,
    filling::Filling,
    frame::{self, Dispatches, Recorder},
    histogram_readback::HistogramReadback,
    indirect::IndirectSource,
    memory::Memory,
    pipelines::{PipelineKey, Pipelines},
    post::{Need, Post, Tasks},
    preparation::Preparation,
    region::Region,
    report::{Activity, Report},
    schedule::{Arithmetic, Pace, Schedule, Stale, Work},
    space::{self, RenderSpace},
    targets::{Targets, texture_bytes},
    uniforms::Inputs,
};
use crate::{
    gpu::timing::Stopwatch,
    scene::{EnvironmentMap, IndirectKind, Quality, Scene},
};

mod prepare;
mod read;

/// Which statistics describe the film as it is.
#[derive(Clone, Copy, Debug, Default)]
struct StatsValidity {
    mean: bool,
    histogram: bool,
}

/// One picture in progress.
pub struct View {
    pipelines: Arc<Pipelines>,
    region: Region,
    pace: Pace,
    anchors: Anchors,
    /// Where the coordinates of the scene begin.
    space: RenderSpace,
    /// It was found for this region.
    is_space_current: bool,
    targets: Targets,
    schedule: Schedule,
    /// Of the view's own work, and of frames of the interface: those are none.
    stopwatch: Stopwatch<Option<Work>>,
    scene: Option<Scene>,
    /// The environment map that is at hand.
    environment_map: Option<Arc<EnvironmentMap>>,
    /// It came since the scene was looked at.
    is_environment_map_new: bool,
    inputs: Option<Inputs>,
    pending: Option<Scene>,
    moving: bool,
    stats_validity: StatsValidity,
    filling: Filling,
    histogram_readback: HistogramReadback,
    /// What another view knows of the whole picture, of which this one draws a part.
    lent_post: Option<Arc<Post>>,
    /// The same of where its indirect light comes from.
    lent_indirect_source: Option<IndirectSource>,
    /// Pipelines on their way.
    preparation: Option<Preparation>,
    dispatches: Dispatches,
    /// The texture of the newest picture; while a new region has none, that of the old one.
    shown: Option<wgpu::Texture>,
    texture_generation: u64,
    now_secs: f64,
    changed_secs: f64,
    finished_secs: f64,
    busy_ms: f64,
    frame_ms: f64,
    pictures: u64,
}

impl View {
    /// Allocates the buffers of `region`, which is cut down where it does not
    /// [fit](Region::fits). Nothing is drawn before it has a scene.
    pub fn new(pipelines: &Arc<Pipelines>, region: Region, pace: Pace) -> Self {
        let region = drawable(region);
        Self {
            pipelines: pipelines.clone(),
            region,
            pace,
            anchors: Anchors::default(),
            space: RenderSpace::plain(),
            is_space_current: false,
            targets: Targets::new(pipelines, region),
            schedule: Schedule::new(pace, region.film_px()),
            stopwatch: Stopwatch::default(),
            scene: None,
            environment_map: None,
            is_environment_map_new: false,
            inputs: None,
            pending: None,
            moving: false,
            stats_validity: StatsValidity::default(),
            filling: Filling::default(),
            histogram_readback: HistogramReadback::default(),
            lent_post: None,
            lent_indirect_source: None,
            preparation: None,
            dispatches: Dispatches::default(),
            shown: None,
            texture_generation: 0,
            now_secs: 0.0,
            changed_secs: 0.0,
            finished_secs: 0.0,
            busy_ms: 0.0,
            frame_ms: 0.0,
            pictures: 0,
        }
    }

    /// The rectangle that is drawn.
    pub fn region(&self) -> Region {
        self.region
    }

    /// Gives the view another rectangle; buffers are made again where its size differs.
    pub fn set_region(&mut self, region: Region) {
        let region = drawable(region);
        if region == self.region {
            return;
        }
        // Two regions of one size can hold different eye layouts, so discard the film statistics.
        let same_size = region.size_px == self.region.size_px
            && region.film_px() == self.region.film_px()
            && region.display_px() == self.region.display_px();
        if !same_size {
            let environment_texture = self.targets.environment_texture.clone();
            self.targets = Targets { environment_texture, ..Targets::new(&self.pipelines, region) };
        }
        self.stats_validity = StatsValidity::default();
        self.region = region;
        self.schedule.resize(region.film_px());
        let Some(scene) = &self.scene else { return };
        if space::wants_anchor(scene, region) == self.space.reference().is_some() {
            self.upload(self.inputs_of(scene));
        } else {
            // Other pixels want other coordinates.
            self.is_space_current = false;
            self.pending = self.pending.take().or_else(|| self.scene.clone());
            self.inputs = None;
        }
    }

    /// Gives the view its scene. Only what changed becomes stale. `moving` says that more
    /// changes are expected at once (a drag, a flight): the view then stays on a sparse lattice.
    pub fn set_scene(&mut self, scene: &Scene, moving: bool) {
        self.moving = moving;
        self.schedule.set_moving(moving);
        let is_new = self.scene.as_ref() != Some(scene) || self.is_environment_map_new;
        self.pending = is_new.then(|| scene.clone());
    }

    /// Says that the interface has drawn a frame, with what [`Self::report`] said before it: no
    /// pipeline is compiled before that could be read.
    pub fn note_frame(&mut self) {
        if let Some(preparation) = &mut self.preparation {
            preparation.note_frame();
        }
    }

    /// Says that the interface has just submitted its drawing of a frame: that is no part of what
    /// pictures take, and how often they are shown on their way hangs on it.
    pub fn time_frame(&mut self) {
        self.stopwatch.note(&self.pipelines.gpu, None);
    }

    /// Gives the view the environment map that is at hand: a scene that names it and
    /// has it as background shows it.
    pub fn set_environment_map(&mut self, environment_map: Option<&Arc<EnvironmentMap>>) {
        if self.environment_map.as_ref().map(|old| old.id()) == environment_map.map(|new| new.id())
        {
            return;
        }
        self.environment_map = environment_map.cloned();
        // The scene is looked at again, in its turn.
        self.is_environment_map_new = true;
        self.pending = self.pending.take().or_else(|| self.scene.clone());
    }

    /// Submits as much work as fits now, without waiting. Call it once per displayed frame, or,
    /// for a still, in a loop with a device poll. `now_secs` is any steady clock. Returns true
    /// while there is more to do.
    pub fn pump(&mut self, now_secs: f64) -> bool {
        self.now_secs = now_secs;
        self.collect();
        if self.inputs.is_none() {
            if self.pending.is_none() {
                return false;
            }
            if !self.look() {
                return true;
            }
        }
        if self.prepare() {
            // What is prepared for later takes nothing of the time that a picture took.
            if self.pending.is_some() || !self.schedule.status(now_secs).idle {
                self.finished_secs = now_secs;
            }
            return true;
        }
        // What it shows may want other pipelines.
        if self.schedule.accepts_changes() && self.look() && self.prepare() {
            return true;
        }
        self.schedule.set_arithmetic(self.arithmetic());
        while let Some(work) = self.schedule.next(now_secs) {
            self.submit(work);
        }
        self.histogram_readback.read(&self.pipelines.gpu, &self.targets.post.statistics);
        let idle = self.schedule.status(now_secs).idle
            && !self.histogram_readback.is_reading()
            && self.pending.is_none();
        if !idle {
            self.finished_secs = now_secs;
        }
        !idle || self.preparation.is_some()
    }

    /// Waits until the oldest piece of work has finished, or all work where the view has none in
    /// flight: between two pumps of a still. On the web this returns at once.
    pub fn wait(&self) {
        self.stopwatch.wait(&self.pipelines.gpu);
    }

    /// Takes note of what the GPU has finished.
    fn collect(&mut self) {
        self.pipelines.gpu.poll();
        let mut ended = Vec::new();
        while let Some(finished) = self.stopwatch.next_finished() {
            ended.push((finished.mark, finished.busy_ms));
        }
        self.schedule.collect(&ended);
        for (work, busy_ms) in ended {
            let Some(work) = work else { continue };
            self.busy_ms += busy_ms;
            if matches!(work, Work::Show { .. }) {
                self.frame_ms = std::mem::take(&mut self.busy_ms);
                self.pictures += 1;
            }
        }
    }

    /// Takes the scene that came last, if any, and if its coordinates are known.
    fn look(&mut self) -> bool {
        let Some(scene) = self.pending.take() else { return false };
        // What no ray sees changes no coordinates either: an anchor found since can wait.
        let is_same_view = self.scene.as_ref().is_some_and(|old| {
            old.camera == scene.camera && old.fractal == scene.fractal && self.is_space_current
        });
        if !is_same_view {
            let Some(space) = self.anchors.space(&scene, self.region, self.pace) else {
                self.pending = Some(scene);
                return false;
            };
            self.space = space;
            self.is_space_current = true;
        }
        self.apply(scene);
        true
    }

    /// Uploads a new scene and tells the schedule what it made stale.
    fn apply(&mut self, scene: Scene) {
        let inputs = self.inputs_of(&scene);
        self.is_environment_map_new = false;
        let stale = match &self.inputs {
            None => Some(Stale::Geometry),
            Some(old) => inputs.stale_since(old),
        };
        self.upload(inputs);
        let Quality { motion_budget_ms, samples, .. } = scene.quality;
        self.schedule.aim(motion_budget_ms, samples);
        self.schedule.set_indirect(scene.indirect.kind != IndirectKind::Off);
        self.schedule.set_adapting(scene.tone.auto_exposure);
        if let Some(stale) = stale {
            self.schedule.change(stale, self.moving, self.now_secs);
            self.changed_secs = self.now_secs;
        }
        self.scene = Some(scene);
    }

    /// The scene as this view's passes read it.
    fn inputs_of(&self, scene: &Scene) -> Inputs {
        Inputs::about(scene, self.region, &self.space)
            .with_environment_map(scene, self.environment_map.as_deref())
            .with_indirect_source(self.lent_indirect_source.as_ref().map(|lent| lent.eye_px))
            .with_bits_of(self.inputs.as_ref())
    }

    fn upload(&mut self, inputs: Inputs) {
        let moved = self.inputs.as_ref().map_or(u64::MAX, |old| inputs.moved_since(old));
        self.schedule.set_lights(inputs.shining(), moved);
        self.schedule.set_casting(inputs.casting());
        self.targets.upload(&self.pipelines.gpu.queue, &inputs);
        self.fit_post(Need::of(&inputs.frame));
        self.targets.fit_direct(&self.pipelines, inputs.has_indirect());
        if self.targets.environment_texture.id != inputs.environment_map {
            let shown =
                self.environment_map.as_deref().filter(|_| inputs.environment_map.is_some());
            self.targets.environment_texture =
                Arc::new(EnvironmentTexture::new(&self.pipelines, shown));
        }
        self.inputs = Some(inputs);
    }

    /// Allocates what the scene needs to know of its film as a whole, and frees what it doesn't.
    fn fit_post(&mut self, need: Need) {
        let need = if self.lent_post.is_some() { Need::default() } else { need };
        if self.targets.post.need() != need {
            self.targets.post = Arc::new(self.targets.post.with_need(&self.pipelines, need));
            self.stats_validity = StatsValidity::default();
        }
    }

    /// What the next piece of work has to find out about the film as a whole.
    fn tasks(&mut self, work: Work) -> Tasks {
        let Work::Show { fill, adapt, .. } = work else {
            self.stats_validity = StatsValidity::default();
            return Tasks::default();
        };
        if fill {
            self.stats_validity = StatsValidity::default();
        }
        if self.lent_post.is_some() {
            return Tasks::default();
        }
        let need = self.targets.post.need();
        let tasks = Tasks {
            mean: need.mean && !self.stats_validity.mean,
            histogram: self.histogram_readback.is_wanted() && !self.stats_validity.histogram,
            adapt: need.mean.then_some(adapt),
            bloom: need.bloom,
        };
        self.stats_validity.mean |= tasks.mean;
        self.stats_validity.histogram |= tasks.histogram;
        tasks
    }

    /// What powers are raised by.
    fn arithmetic(&self) -> Arithmetic {
        match self.inputs.as_ref().map(|inputs| PipelineKey::of(&inputs.frame)) {
            Some(key) if key.is_deep() => Arithmetic::Deep,
            None | Some(PipelineKey { power: 0, .. }) => Arithmetic::Real,
            Some(key) if self.pipelines.has_own(key) => Arithmetic::SpecializedPipeline,
            Some(_) => Arithmetic::Whole,
        }
    }

    /// The lattice level whose samples a display is made of by themselves, where it is.
    fn upsample_level(&mut self, work: Work) -> Option<u32> {
        let picture = &self.inputs.as_ref()?.frame;
        let is_plain = picture.eyes.count == 1
            && self.lent_post.is_none()
            && self.targets.post.need().is_none()
            && !self.histogram_readback.is_wanted();
        self.filling.upsample_level(work, is_plain, self.targets.finest_spread(picture.size_px))
    }

    fn submit(&mut self, work: Work) {
        let upsample_level = self.upsample_level(work);
        let tasks = if upsample_level.is_some() { Tasks::default() } else { self.tasks(work) };
        let Some(inputs) = &self.inputs else { return };
        let passes = self.pipelines.passes(&inputs.frame);
        let mut recorder =
            Recorder::new(&self.pipelines, &passes, &self.targets, inputs, &mut self.dispatches);
        recorder.tasks = tasks;
        recorder.upsample_level = upsample_level;
        if let Some(lent) = &self.lent_post {
            recorder.post = lent;
        }
        if let Some(lent) = &self.lent_indirect_source {
            recorder.indirect_source = lent.clone();
        }
        frame::record(&mut recorder, work);
        let commands = recorder.finish();
        self.stopwatch.submit(&self.pipelines.gpu, commands, Some(work));
        if matches!(work, Work::Show { .. }) && self.shown.as_ref() != Some(&self.targets.texture) {
            self.shown = Some(self.targets.texture.clone());
            self.texture_generation += 1;
        }
        if matches!(work, Work::Show { .. }) {
            self.histogram_readback.note_picture();
        }
    }

    /// Says whether the interface shows the film's histogram: [`Report::histogram`] has it then.
    pub fn watch_histogram(&mut self, wanted: bool) {
        if wanted == self.histogram_readback.is_wanted() {
            return;
        }
        self.histogram_readback = HistogramReadback::new(wanted);
        if wanted {
            self.schedule.show_again();
        }
    }

    /// What is known of the film as a whole: for a view that draws a part of the same picture.
    pub fn post(&self) -> Arc<Post> {
        self.targets.post.clone()
    }

    /// Has the view show its region by the exposure and the bloom of another view that draws all
    /// of the picture, rather than by what it would find in the region; none takes that back. The
    /// lender's picture is finished, and both have the same tone and bloom settings.
    pub fn lend_post(&mut self, post: Option<Arc<Post>>) {
        self.lent_post = post;
        if let Some(inputs) = &self.inputs {
            self.fit_post(Need::of(&inputs.frame));
            self.schedule.show_again();
        }
    }

    /// The centre samples, where they are all of the picture: for a view that draws a part of it.
    pub fn indirect_source(&self) -> IndirectSource {
        self.targets.indirect_source(self.region.size_px)
    }

    /// Has the view gather indirect light from the samples of another view that draws all of the
    /// picture, rather than from its region's own; none takes that back. The lender's picture is
    /// finished and shows the same scene, in any size. To be called before the view has a scene.
    pub fn lend_indirect_source(&mut self, source: Option<IndirectSource>) {
        self.lent_indirect_source = source;
    }

    /// What the view is doing.
    pub fn report(&self) -> Report {
        let status = self.schedule.status(self.now_secs);
        let activity = if let Some(preparation) = &self.preparation {
            Activity::Compiling(preparation.variant().name())
        } else if self.inputs.is_none() || (status.idle && self.pending.is_none()) {
            Activity::Idle
        } else if status.moving {
            Activity::Moving
        } else {
            Activity::Refining
        };
        Report {
            activity,
            size_px: self.region.display_px(),
            samples_done: status.samples_done,
            samples_so_far: status.samples_so_far,
            samples_wanted: self.scene.as_ref().map_or(1, |scene| scene.quality.samples),
            pixels_per_sample: 1 << status.shown_level,
            elapsed_secs: (self.finished_secs - self.changed_secs).max(0.0),
            frame_ms: self.frame_ms,
            frame_interval_secs: self.schedule.frame_interval_secs(),
            anchor_ms: self.anchors.took_ms(),
            histogram: self.histogram_readback.histogram().cloned(),
            memory: self.memory(),
            reference: self.anchors.reference(),
            pictures: self.pictures,
        }
    }

    /// What the view holds of the GPU's memory.
    fn memory(&self) -> Memory {
        let mut memory = self.targets.memory();
        if let Some(shown) = self.shown.as_ref().filter(|shown| **shown != self.targets.texture) {
            memory.display += texture_bytes(shown);
        }
        memory
    }

    /// How many dispatches of each pass there have been.
    pub fn dispatches(&self) -> Dispatches {
        self.dispatches
    }

    /// The newest picture: `Rgba8Unorm`, sRGB-encoded, opaque; usages TEXTURE_BINDING and
    /// COPY_SRC. It is always complete, never a half-filled lattice; none before the first.
    /// After a change of size it is the old one, in its own size, until there is a new one.
    pub fn texture(&self) -> Option<&wgpu::Texture> {
        self.shown.as_ref()
    }

    /// Changes whenever [`Self::texture`] is another texture than before.
    pub fn texture_generation(&self) -> u64 {
        self.texture_generation
    }
}

/// `region`, or as much of its picture as a view can draw.
fn drawable(region: Region) -> Region {
    if region.fits() { region } else { Region::whole_within_limits(region.picture_px) }
}
