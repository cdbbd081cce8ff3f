//! The picture in the window: a view of the scene, and the texture by which egui shows it.
//!
//! In: the scene, the size of the viewport. Out: a texture for the interface, always a finished
//! picture, and the view's report. Compute is submitted here, apart from egui's own pass.

use std::sync::Arc;

use eframe::egui_wgpu::RenderState;

use crate::{
    render::{Pace, Pipelines, Region, Report, View, frame::Dispatches},
    scene::{EnvironmentMap, Scene, StereoLayout},
    ui,
};

/// A viewport that changes its size is followed once it has kept it for this long, seconds;
/// until then egui stretches the picture that there is.
const SETTLED_SECS: f64 = 0.12;

/// A view and its texture in egui.
pub struct Picture {
    pipelines: Arc<Pipelines>,
    state: RenderState,
    view: Option<View>,
    shown: Option<Shown>,
    wanted: Option<(Region, f64)>,
}

/// What egui shows.
struct Shown {
    picture: ui::Picture,
    generation: u64,
}

impl Picture {
    /// A picture without a size, hence without a view.
    pub fn new(pipelines: Arc<Pipelines>, state: RenderState) -> Self {
        Self { pipelines, state, view: None, shown: None, wanted: None }
    }

    /// The picture to show, once there is one.
    pub fn shown(&self) -> Option<ui::Picture> {
        self.shown.as_ref().map(|shown| shown.picture)
    }

    /// The newest picture on the GPU.
    pub fn texture(&self) -> Option<&wgpu::Texture> {
        self.view.as_ref().and_then(View::texture)
    }

    /// What the view is doing.
    pub fn report(&self) -> Report {
        self.view.as_ref().map(View::report).unwrap_or_default()
    }

    /// Compute dispatches so far.
    pub fn dispatches(&self) -> Dispatches {
        self.view.as_ref().map(View::dispatches).unwrap_or_default()
    }

    /// Asks for a picture of `size_px` pixels, `scale` times as large a side, that both eyes of a
    /// layout share. Returns after how many seconds to ask again while the size is still settling.
    pub fn resize(
        &mut self,
        size_px: [u32; 2],
        layout: StereoLayout,
        scale: f64,
        now_secs: f64,
    ) -> Option<f64> {
        let scaled_px = size_px.map(|side| (f64::from(side) * scale).round() as u32);
        let region = Region::whole_within_limits(scaled_px).shared_by(layout);
        let Some(view) = &mut self.view else {
            self.view = Some(View::new(&self.pipelines, region, Pace::Interactive));
            return None;
        };
        if view.region() == region {
            self.wanted = None;
            return None;
        }
        if view.region().eyes != region.eyes {
            // Asked for by a click: at once.
            view.set_region(region);
            return None;
        }
        let since_secs = match self.wanted {
            Some((wanted, since_secs)) if wanted == region => since_secs,
            _ => now_secs,
        };
        self.wanted = Some((region, since_secs));
        let left_secs = since_secs + SETTLED_SECS - now_secs;
        if left_secs > 0.0 {
            return Some(left_secs);
        }
        view.set_region(region);
        None
    }

    /// Gives the view its scene; `moving` says that more changes are expected at once.
    pub fn set_scene(&mut self, scene: &Scene, moving: bool) {
        if let Some(view) = &mut self.view {
            view.set_scene(scene, moving);
        }
    }

    /// Says that the interface draws a frame.
    pub fn note_frame(&mut self) {
        if let Some(view) = &mut self.view {
            view.note_frame();
        }
    }

    /// Says that the interface has just submitted its drawing of a frame.
    pub fn time_frame(&mut self) {
        if let Some(view) = &mut self.view {
            view.time_frame();
        }
    }

    /// Says whether the interface shows the film's histogram.
    pub fn watch_histogram(&mut self, wanted: bool) {
        if let Some(view) = &mut self.view {
            view.watch_histogram(wanted);
        }
    }

    /// Gives the view the environment map that is at hand.
    pub fn set_environment_map(&mut self, environment_map: Option<&Arc<EnvironmentMap>>) {
        if let Some(view) = &mut self.view {
            view.set_environment_map(environment_map);
        }
    }

    /// Draws as much as fits now. Returns whether there is more to do.
    pub fn pump(&mut self, now_secs: f64) -> bool {
        let Some(view) = &mut self.view else { return false };
        let busy = view.pump(now_secs);
        self.show_newest();
        busy
    }

    /// Lets egui show the view's texture, where it is another one than before.
    fn show_newest(&mut self) {
        let Some(view) = &self.view else { return };
        let generation = view.texture_generation();
        let Some(texture) = view.texture() else { return };
        if self.shown.as_ref().is_some_and(|shown| shown.generation == generation) {
            return;
        }
        let device = &self.state.device;
        let texture_view = texture.create_view(&wgpu::TextureViewDescriptor::default());
        let filter = wgpu::FilterMode::Linear;
        let mut renderer = self.state.renderer.write();
        let id = match &self.shown {
            Some(Shown { picture: ui::Picture { texture: id, .. }, .. }) => {
                renderer.update_egui_texture_from_wgpu_texture(device, &texture_view, filter, *id);
                *id
            }
            None => renderer.register_native_texture(device, &texture_view, filter),
        };
        let stretch = view.region().eyes.pixel_aspect();
        let size_px = [texture.width() * stretch, texture.height()];
        let picture = ui::Picture { texture: id, size_px };
        self.shown = Some(Shown { picture, generation });
    }
}

impl Drop for Picture {
    fn drop(&mut self) {
        if let Some(shown) = &self.shown {
            self.state.renderer.write().free_texture(&shown.picture.texture);
        }
    }
}
