//! One picture in progress: its buffers, its schedule, and the scene that it shows.

use std::sync::Arc;

use super::{
    anchors::Anchors,
    display_parts::DisplayDivision,
    display_values::DisplayValues,
    environment_texture::EnvironmentTexture,
    histogram_readback::HistogramReadback,
    indirect::IndirectSource,
    integrator::{self, DIRECT, Integrator},
    noise_control::NoiseControl,
    occupancy::Occupancy,
    pipelines::Pipelines,
    post::{Need, Post},
    preparation::Preparation,
    reconstruction::Reconstruction,
    recorder::Dispatches,
    region::Region,
    schedule::{Pace, Schedule, Stale},
    sky::{SampledSky, SkyCache},
    space::RenderSpace,
    sub_frame::SubFrame,
    targets::Targets,
    uniforms::Inputs,
};
use crate::{
    fractal::SharedModel,
    gpu::timing::Stopwatch,
    scene::{EnvironmentMap, Quality, Scene},
};

mod color_following;
mod colors;
mod display;
mod from_samples;
mod parts;
mod paths;
mod prepare;
mod read;
mod report;
mod resize;
mod submit;

use color_following::ColorFollowing;
pub use parts::PieceTime;
use parts::{Lent, Recording, Shown, StatsValidity, Submitted, Times};

/// One picture in progress.
pub struct View {
    pipelines: Arc<Pipelines>,
    region: Region,
    display_values: DisplayValues,
    pace: Pace,
    anchors: Anchors,
    /// Models of the edited fractal, shared with navigation and interface.
    models: SharedModel,
    /// The scene's render space; none before the first scene.
    space: Option<RenderSpace>,
    /// True if the render space was found for the current region.
    is_space_current: bool,
    targets: Targets,
    integrator: &'static Integrator,
    schedule: Schedule,
    /// Times the view's own work; none marks a frame of the interface.
    stopwatch: Stopwatch<Option<Submitted>>,
    /// The display of which parts are left to submit.
    display_under_way: Option<Recording>,
    /// Its parts.
    display_division: DisplayDivision,
    scene: Option<Scene>,
    /// The loaded environment map.
    environment_map: Option<Arc<EnvironmentMap>>,
    /// The sky that light paths see.
    sky: Option<Arc<SampledSky>>,
    sky_cache: SkyCache,
    /// True if the map came after the scene was last read.
    is_environment_map_new: bool,
    inputs: Option<Inputs>,
    pending: Option<Scene>,
    /// The sub-frame of motion blur that the newest scene is; none for other pictures.
    sub_frame: Option<SubFrame>,
    moving: bool,
    stats_validity: StatsValidity,
    reconstruction: Reconstruction,
    histogram_readback: HistogramReadback,
    noise_control: NoiseControl,
    lent: Lent,
    colors: ColorFollowing,
    /// The pipelines in preparation.
    preparation: Option<Preparation>,
    dispatches: Dispatches,
    shown: Shown,
    times: Times,
}

impl View {
    /// Allocates the buffers of `region`, reduced to [fit](Region::fits); draws nothing without a scene.
    pub fn new(pipelines: &Arc<Pipelines>, region: Region, pace: Pace) -> Self {
        let region = drawable(region);
        let integrator = &DIRECT;
        let mut schedule = Schedule::new(integrator.plan, pace, region.film_px());
        schedule.set_occupancy(Occupancy::of(pipelines.gpu.cpu));
        Self {
            pipelines: pipelines.clone(),
            region,
            display_values: DisplayValues::default(),
            pace,
            anchors: Anchors::default(),
            models: SharedModel::default(),
            space: None,
            is_space_current: false,
            targets: Targets::new(&pipelines.layouts, region),
            integrator,
            schedule,
            stopwatch: Stopwatch::default(),
            display_under_way: None,
            display_division: DisplayDivision::default(),
            scene: None,
            environment_map: None,
            sky: None,
            sky_cache: SkyCache::default(),
            is_environment_map_new: false,
            inputs: None,
            pending: None,
            sub_frame: None,
            moving: false,
            stats_validity: StatsValidity::default(),
            reconstruction: Reconstruction::default(),
            histogram_readback: HistogramReadback::default(),
            noise_control: NoiseControl::default(),
            lent: Lent::default(),
            colors: ColorFollowing::default(),
            preparation: None,
            dispatches: Dispatches::default(),
            shown: Shown::default(),
            times: Times::default(),
        }
    }

    /// The rectangle that the view draws.
    pub fn region(&self) -> Region {
        self.region
    }

    /// Sets the scene; only changed results become stale.
    ///
    /// `moving` announces further changes soon (a drag, a flight): the view then stays on a sparse lattice.
    pub fn set_scene(&mut self, scene: &Scene, moving: bool) {
        self.moving = moving;
        self.schedule.set_moving(moving);
        let had_sub_frames = self.sub_frame.take().is_some();
        let is_new =
            self.scene.as_ref() != Some(scene) || self.is_environment_map_new || had_sub_frames;
        self.pending = is_new.then(|| scene.clone());
    }

    /// Sets the scene of a sub-frame, whose film is averaged with those of the sub-frames before it.
    ///
    /// For stills; call it once the sub-frame before is complete. The picture is that of the last one.
    pub fn set_sub_frame(&mut self, scene: &Scene, sub_frame: SubFrame) {
        self.sub_frame = Some(sub_frame);
        self.pending = Some(scene.clone());
    }

    /// Shares fractal models with other users, such as the interface's navigation.
    pub fn share_models(&mut self, models: &SharedModel) {
        self.models = models.clone();
    }

    /// Notes that the interface has drawn a frame, with the [report](Self::report) from before it.
    ///
    /// No pipeline is compiled before its announcement could be read.
    pub fn note_frame(&mut self) {
        if let Some(preparation) = &mut self.preparation {
            preparation.note_frame();
        }
    }

    /// Notes input at the interface that someone waits for the answer of, such as a click: for some frames, at most one
    /// long piece of this view's work delays it. Call it before the frame's [`Self::pump`].
    pub fn note_input(&mut self, now_secs: f64) {
        self.schedule.note_input(now_secs);
    }

    /// Notes that the interface has just submitted its drawing of a frame.
    ///
    /// This time is no part of a picture's cost; it decides how often an unfinished picture is shown. `is_only_work`:
    /// nothing but this view's work and the interface use the GPU.
    pub fn time_frame(&mut self, is_only_work: bool, now_secs: f64) {
        self.schedule.frame_submitted(is_only_work, now_secs);
        self.stopwatch.note(&self.pipelines.gpu, None);
    }

    /// Requests a frame of the interface that reports progress. Returns whether it may be drawn now.
    ///
    /// To measure one, work in flight ends first. Call it while the view is pumped: it then learns what has ended.
    pub fn request_frame(&mut self, now_secs: f64) -> bool {
        self.schedule.request_frame(now_secs)
    }

    /// Sets the loaded environment map; a scene that names it and has it as background shows it.
    pub fn set_environment_map(&mut self, environment_map: Option<&Arc<EnvironmentMap>>) {
        if self.environment_map.as_ref().map(|old| old.id()) == environment_map.map(|new| new.id())
        {
            return;
        }
        self.environment_map = environment_map.cloned();
        // The next pump that accepts a change applies the scene again.
        self.is_environment_map_new = true;
        self.pending = self.pending.take().or_else(|| self.scene.clone());
    }

    /// Submits as much work as fits now, without waiting; returns true while there is more to do.
    ///
    /// Call it once per displayed frame, or, for a still, in a loop with a device poll. `now_secs` is any
    /// steady clock.
    pub fn pump(&mut self, now_secs: f64) -> bool {
        self.times.advance(now_secs);
        self.collect();
        if self.pending.is_some() {
            self.skip_denoiser();
        }
        // The film must not change between the parts of a display.
        if self.continue_display() {
            self.times.is_working = true;
            return true;
        }
        if self.inputs.is_none() {
            if self.pending.is_none() {
                return false;
            }
            if !self.apply_pending() {
                self.times.is_working = true;
                return true;
            }
        }
        if self.prepare() {
            // Preparation for later use does not count as time of the current picture.
            self.times.is_working = self.pending.is_some() || !self.schedule.status(now_secs).idle;
            return true;
        }
        // The new scene may need other pipelines.
        if self.schedule.accepts_changes() && self.apply_pending() && self.prepare() {
            self.times.is_working = true;
            return true;
        }
        self.schedule.set_arithmetic(self.arithmetic());
        while !self.waits_for_colors()
            && let Some(work) = self.schedule.next(now_secs)
        {
            self.clear_path_counts(work);
            self.submit(work);
            self.note_round(work);
            if self.is_amid_display() {
                self.times.is_working = true;
                return true;
            }
        }
        self.end_at_noise();
        self.follow_colors();
        self.histogram_readback.read(&self.pipelines.gpu, &self.targets.post.statistics);
        let idle = self.schedule.status(now_secs).idle
            && !self.histogram_readback.is_reading()
            && !self.noise_control.is_reading()
            && !self.waits_for_colors()
            && self.pending.is_none();
        self.times.is_working = !idle;
        !idle || self.preparation.is_some()
    }

    /// Waits for the oldest piece of work; for all work if none is in flight.
    ///
    /// For use between two pumps of a still. On the web this returns at once.
    pub fn wait(&self) {
        self.stopwatch.wait(&self.pipelines.gpu);
    }

    /// Applies the pending scene, if any, once its render space is known; returns whether it did.
    fn apply_pending(&mut self) -> bool {
        let Some(scene) = self.pending.take() else { return false };
        // The render space depends on camera and fractal only: an anchor found since then can wait.
        let is_same_view = self.scene.as_ref().is_some_and(|old| {
            old.camera == scene.camera && old.fractal == scene.fractal && self.is_space_current
        });
        if !is_same_view {
            let model = self.models.of(&scene.fractal);
            let space = self.anchors.space(&model, &scene, self.region, self.pace);
            model.set_reference(self.anchors.reference().as_ref());
            if space.is_none() {
                self.pending = Some(scene);
                return false;
            }
            self.space = space;
            self.is_space_current = true;
        }
        self.apply(scene);
        true
    }

    /// Uploads a new scene and passes its stale level to the schedule.
    fn apply(&mut self, scene: Scene) {
        self.sky = self.sky_cache.sky_of(&scene, self.environment_map.as_ref());
        let Some(space) = &self.space else { return };
        let inputs = self.inputs_about(&scene, space);
        self.is_environment_map_new = false;
        let target = |inputs: &Inputs| (inputs.frame.paths.noise, inputs.frame.tone.exposure);
        let has_other_target =
            self.inputs.as_ref().is_some_and(|old| target(old) != target(&inputs));
        let stale = match &self.inputs {
            None => Some(Stale::Geometry),
            Some(old) => inputs.stale_since(old),
        };
        self.integrator = integrator::of(&inputs);
        self.schedule.set_plan(self.integrator.plan);
        self.upload(inputs);
        let Quality { motion_budget_ms, samples, .. } = scene.quality;
        self.schedule.aim(motion_budget_ms, samples.saturating_add(self.replaced_samples()));
        // A still's paths replace all centre samples, whose indirect light no one sees.
        let is_unseen = self.pace == Pace::Still && scene.traces_paths();
        self.schedule.set_indirect((self.integrator.gathers)(&scene) && !is_unseen);
        self.schedule.set_adapting(scene.tone.auto_exposure);
        if let Some(stale) = stale {
            self.schedule.change(stale, self.moving, self.times.now_secs());
            if self.schedule.is_at_jump() {
                self.display_division.expect_longer();
            }
            self.times.note_change();
        }
        if has_other_target {
            self.schedule.set_converged(false);
        }
        self.scene = Some(scene);
    }

    /// The inputs of `scene`, in the current render space if the fractal is the same.
    fn inputs_of(&self, scene: &Scene) -> Inputs {
        let model = self.models.of(&scene.fractal);
        match self.space.as_ref().filter(|space| space.model().fractal() == &scene.fractal) {
            Some(space) => self.inputs_about(scene, space),
            None => self.inputs_about(scene, &RenderSpace::plain(&model)),
        }
    }

    fn inputs_about(&self, scene: &Scene, space: &RenderSpace) -> Inputs {
        Inputs::about(scene, self.region, space)
            .with_environment_map(scene, self.environment_map.as_deref())
            .with_sky(scene, space, self.sky.as_ref())
            .with_preview(self.preview_samples(scene))
            .with_sub_frame(self.sub_frame)
            .with_display_values(scene, self.display_values)
            .with_indirect_source(self.lent.indirect_source.as_ref().map(|lent| lent.eye_px))
            .with_bits_of(self.inputs.as_ref())
            .with_color_curves(self.colors.curves())
    }

    fn upload(&mut self, inputs: Inputs) {
        let moved = self.inputs.as_ref().map_or(u64::MAX, |old| inputs.moved_since(old));
        self.schedule.set_lights(inputs.shining(), moved);
        self.schedule.set_casting(inputs.casting());
        self.colors.follow(self.inputs.as_ref(), &inputs);
        // A pending assessment is of the picture before.
        self.noise_control = NoiseControl::default();
        self.targets.upload(&self.pipelines.gpu.queue, &inputs);
        self.fit_post(Need::of(&inputs.frame));
        if self.targets.environment_texture.id != inputs.environment_map {
            let shown =
                self.environment_map.as_deref().filter(|_| inputs.environment_map.is_some());
            self.targets.environment_texture =
                Arc::new(EnvironmentTexture::new(&self.pipelines.layouts, shown));
        }
        // After the environment map, whose texture a sky may share.
        (self.integrator.fit_targets)(&mut self.targets, &self.pipelines.layouts, &inputs);
        self.targets.fit_shutter(&self.pipelines.layouts, inputs.sub_frame.is_some());
        self.inputs = Some(inputs);
    }

    /// Allocates the post buffers that the scene needs, and frees the others.
    fn fit_post(&mut self, need: Need) {
        let need = if self.lent.post.is_some() { Need::default() } else { need };
        if self.targets.post.need() != need {
            self.targets.post =
                Arc::new(self.targets.post.with_need(&self.pipelines.layouts, need));
            self.stats_validity = StatsValidity::default();
        }
    }

    /// The post passes that the view's scene needs; none if another view lends their results.
    fn post_need(&self) -> Option<Need> {
        self.lent.post.is_none().then(|| self.targets.post.need())
    }

    /// Sets whether [`Report::histogram`](super::Report::histogram) is kept up to date.
    pub fn watch_histogram(&mut self, wanted: bool) {
        if wanted == self.histogram_readback.is_wanted() {
            return;
        }
        self.finish_display();
        self.histogram_readback = HistogramReadback::new(wanted);
        if wanted {
            self.schedule.show_again();
        }
    }

    /// The post results, for a view that draws a part of the same picture.
    pub fn post(&self) -> Arc<Post> {
        self.targets.post.clone()
    }

    /// Uses exposure and bloom of a view of the whole picture instead of its own.
    ///
    /// None ends the loan. The lender's picture must be finished, with the same tone and bloom settings.
    pub fn lend_post(&mut self, post: Option<Arc<Post>>) {
        self.finish_display();
        self.lent.post = post;
        if let Some(inputs) = &self.inputs {
            self.fit_post(Need::of(&inputs.frame));
            self.schedule.show_again();
        }
    }

    /// The centre samples of the whole picture, for a view of a part of it.
    pub fn indirect_source(&self) -> IndirectSource {
        IndirectSource::of(&self.targets, self.region.size_px)
    }

    /// Computes indirect light from the samples of a view of the whole picture.
    ///
    /// None ends the loan. The lender's picture must be finished and show the same scene, in any size. Call
    /// this before the view has a scene.
    pub fn lend_indirect_source(&mut self, source: Option<IndirectSource>) {
        self.lent.indirect_source = source;
    }

    /// Number of dispatches of each pass so far.
    pub fn dispatches(&self) -> &Dispatches {
        &self.dispatches
    }
}

/// `region` if a view can draw it, else its whole picture at a drawable size.
fn drawable(region: Region) -> Region {
    if region.fits() { region } else { Region::whole_within_limits(region.picture_px) }
}
