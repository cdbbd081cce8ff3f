//! The live view: the picture in the window and its texture in egui.
//!
//! In: the scene, the size of the viewport. Out: a texture of the newest complete picture, and the
//! view's report. Submits its compute work apart from egui's pass.

use std::sync::Arc;

use eframe::egui_wgpu::RenderState;

use crate::{
    fractal::SharedModel,
    render::{Activity, Pace, Pipelines, Region, Report, View},
    scene::{EnvironmentMap, Scene},
    ui,
};

/// Seconds that a new viewport size must last before the view is resized. Until then egui shows the
/// old picture.
const SETTLE_SECS: f64 = 0.12;

/// A [`View`] of the size of the viewport, and its texture in egui.
pub struct LiveView {
    pipelines: Arc<Pipelines>,
    render_state: RenderState,
    /// Shared with the interface, which moves by them.
    models: SharedModel,
    view: Option<View>,
    shown: Option<Shown>,
    kept: Option<Kept>,
    /// Textures that the interface may have to paint once more.
    discarded: Vec<egui::TextureId>,
    /// A new size that has not settled, and since when.
    pending_region: Option<(Region, f64)>,
}

/// The texture that egui shows.
#[derive(Clone, Copy)]
struct Shown {
    picture: ui::ViewTexture,
    /// The view's texture generation.
    generation: u64,
}

/// A picture from before a change of size, which stays on the screen until the new one is as good.
struct Kept {
    shown: Shown,
    scene: Scene,
    /// Samples of each of its pixels.
    samples: u32,
}

impl LiveView {
    /// A live view without a size and without a picture.
    pub fn new(pipelines: Arc<Pipelines>, render_state: RenderState, models: &SharedModel) -> Self {
        let models = models.clone();
        Self {
            pipelines,
            render_state,
            models,
            view: None,
            shown: None,
            kept: None,
            discarded: Vec::new(),
            pending_region: None,
        }
    }

    /// The picture for egui; `None` before the first one.
    pub fn shown(&self) -> Option<ui::ViewTexture> {
        self.shown.as_ref().map(|shown| shown.picture)
    }

    /// The picture from before a change of size, until the newest is as good.
    pub fn kept(&self) -> Option<ui::KeptPicture> {
        self.kept.as_ref().map(|kept| ui::KeptPicture { picture: kept.shown.picture, span: 1.0 })
    }

    /// The newest picture on the GPU.
    pub fn texture(&self) -> Option<&wgpu::Texture> {
        self.view.as_ref().and_then(View::texture)
    }

    /// The view, once it has a size.
    pub fn view(&self) -> Option<&View> {
        self.view.as_ref()
    }

    /// The picture on the screen, if a still of `scene` and `size_px` would be the same picture.
    ///
    /// Stereo pictures have another layout.
    pub fn finished(&self, scene: &Scene, size_px: [u32; 2]) -> Option<&wgpu::Texture> {
        let (view, texture) = (self.view.as_ref()?, self.texture()?);
        let report = view.report();
        let is_finished = report.is_finished()
            && report.samples_done >= report.samples_wanted
            && !view.has_pending_scene();
        let is_same_size = [texture.width(), texture.height()] == size_px;
        (is_finished && !scene.camera.stereo.is_on() && is_same_size).then_some(texture)
    }

    /// The view's report.
    pub fn report(&self) -> Report {
        self.view.as_ref().map(View::report).unwrap_or_default()
    }

    /// True once the first sharp picture of the newest scene is complete.
    pub fn is_sharp(&self) -> bool {
        let Some(view) = &self.view else { return false };
        let report = view.report();
        let is_at_rest = matches!(report.activity, Activity::Idle | Activity::Refining);
        let is_shown = report.samples_done > 0 && !view.is_amid_display();
        is_at_rest && is_shown && !view.has_pending_scene()
    }

    /// Compute dispatches so far.
    pub fn dispatches(&self) -> u64 {
        self.view.as_ref().map_or(0, |view| view.dispatches().total())
    }

    /// Resizes the picture of `scene` to `size_px` times `scale`, a size that both eyes share.
    /// Returns the seconds until the size settles, if it has not.
    pub fn resize(
        &mut self,
        scene: &Scene,
        size_px: [u32; 2],
        scale: f64,
        now_secs: f64,
    ) -> Option<f64> {
        let layout = scene.camera.stereo.layout;
        let scaled_px = size_px.map(|side| (f64::from(side) * scale).round() as u32);
        let region = Region::whole_within_limits(scaled_px).shared_by(layout);
        let Some(view) = &mut self.view else {
            let mut view = View::new(&self.pipelines, region, Pace::Interactive);
            view.share_models(&self.models);
            self.view = Some(view);
            return None;
        };
        if view.region() == region {
            self.pending_region = None;
            return None;
        }
        if view.region().eyes != region.eyes {
            // A stereo layout changes by a click, so there is nothing to settle.
            view.set_region(region);
            return None;
        }
        let since_secs = match self.pending_region {
            Some((pending, since_secs)) if pending == region => since_secs,
            _ => now_secs,
        };
        self.pending_region = Some((region, since_secs));
        let left_secs = since_secs + SETTLE_SECS - now_secs;
        if left_secs > 0.0 {
            return Some(left_secs);
        }
        self.keep_picture(scene);
        if let Some(view) = &mut self.view {
            view.set_region(region);
        }
        None
    }

    /// Keeps the picture of `scene` on the screen while the one of another size is made.
    fn keep_picture(&mut self, scene: &Scene) {
        let (Some(shown), report) = (self.shown, self.report()) else { return };
        let samples = report.samples_done;
        let has_better = self.kept.as_ref().is_some_and(|kept| kept.samples > samples);
        if samples > 0 && !has_better && !scene.camera.stereo.is_on() {
            self.drop_kept();
            self.kept = Some(Kept { shown, scene: scene.clone(), samples });
        }
    }

    /// Removes the kept picture from the screen.
    fn drop_kept(&mut self) {
        let Some(Kept { shown: Shown { picture, generation }, .. }) = self.kept.take() else {
            return;
        };
        // Without a newer picture, the screen still shows this one.
        if self.shown.is_none_or(|shown| shown.generation != generation) {
            self.discarded.push(picture.texture);
        }
    }

    /// Frees the textures that the frame before needed: call it between two frames' drawing.
    pub fn free_discarded(&mut self) {
        let mut renderer = self.render_state.renderer.write();
        self.discarded.drain(..).for_each(|texture| renderer.free_texture(&texture));
    }

    /// Removes the kept picture once the newest one has as many samples, or is finished.
    fn replace_kept(&mut self) {
        let (Some(kept), Some(shown)) = (&self.kept, &self.shown) else { return };
        let report = self.report();
        let is_as_good = report.samples_done >= kept.samples || report.activity == Activity::Idle;
        if shown.generation != kept.shown.generation && is_as_good {
            self.drop_kept();
        }
    }

    /// Sets the scene; `moving` announces more changes at once.
    pub fn set_scene(&mut self, scene: &Scene, moving: bool) {
        if self.kept.as_ref().is_some_and(|kept| kept.scene != *scene) {
            self.drop_kept();
        }
        if let Some(view) = &mut self.view {
            view.set_scene(scene, moving);
        }
    }

    /// Notes that the interface draws a frame.
    pub fn note_frame(&mut self) {
        if let Some(view) = &mut self.view {
            view.note_frame();
        }
    }

    /// Notes input at the interface that someone waits for the answer of, such as a click.
    pub fn note_input(&mut self, now_secs: f64) {
        if let Some(view) = &mut self.view {
            view.note_input(now_secs);
        }
    }

    /// Notes that the interface has just submitted its drawing of a frame. `is_only_work`: nothing but the view's work and
    /// the interface use the GPU.
    pub fn time_frame(&mut self, is_only_work: bool, now_secs: f64) {
        if let Some(view) = &mut self.view {
            view.time_frame(is_only_work, now_secs);
        }
    }

    /// Requests a frame of the interface that reports progress. Returns whether it may be drawn now.
    pub fn request_frame(&mut self, now_secs: f64) -> bool {
        self.view.as_mut().is_none_or(|view| view.request_frame(now_secs))
    }

    /// Turns the film's histogram in the report on or off.
    pub fn watch_histogram(&mut self, wanted: bool) {
        if let Some(view) = &mut self.view {
            view.watch_histogram(wanted);
        }
    }

    /// Sets the loaded environment map.
    pub fn set_environment_map(&mut self, environment_map: Option<&Arc<EnvironmentMap>>) {
        if let Some(view) = &mut self.view {
            view.set_environment_map(environment_map);
        }
    }

    /// Submits as much work as fits now. Returns whether more is left.
    pub fn pump(&mut self, now_secs: f64) -> bool {
        let Some(view) = &mut self.view else { return false };
        let busy = view.pump(now_secs);
        self.update_egui_texture();
        self.replace_kept();
        busy
    }

    /// Registers the view's texture with egui when the view has replaced it.
    fn update_egui_texture(&mut self) {
        let Some(view) = &self.view else { return };
        let generation = view.texture_generation();
        let Some(texture) = view.texture() else { return };
        if self.shown.as_ref().is_some_and(|shown| shown.generation == generation) {
            return;
        }
        let device = &self.render_state.device;
        let texture_view = texture.create_view(&wgpu::TextureViewDescriptor::default());
        let filter = wgpu::FilterMode::Linear;
        let mut renderer = self.render_state.renderer.write();
        let kept_generation = self.kept.as_ref().map(|kept| kept.shown.generation);
        let id = match &self.shown {
            Some(Shown { picture: ui::ViewTexture { texture: id, .. }, generation })
                if Some(*generation) != kept_generation =>
            {
                renderer.update_egui_texture_from_wgpu_texture(device, &texture_view, filter, *id);
                *id
            }
            _ => renderer.register_native_texture(device, &texture_view, filter),
        };
        let stretch = view.region().eyes.pixel_aspect();
        let size_px = [texture.width() * stretch, texture.height()];
        let picture = ui::ViewTexture { texture: id, size_px };
        self.shown = Some(Shown { picture, generation });
    }
}

impl Drop for LiveView {
    fn drop(&mut self) {
        self.drop_kept();
        self.free_discarded();
        if let Some(shown) = &self.shown {
            self.render_state.renderer.write().free_texture(&shown.picture.texture);
        }
    }
}
