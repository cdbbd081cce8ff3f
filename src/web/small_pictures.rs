//! Small pictures of the interface, drawn one at a time in a view of their own.
//!
//! In: the small pictures that the interface wants. Out: their textures in egui. The engine decides when
//! there is time for them; pictures that are no longer wanted are freed.

use std::sync::Arc;

use eframe::egui_wgpu::RenderState;

use crate::{
    render::{Activity, Pace, Pipelines, Region, View},
    scene::EnvironmentMap,
    ui::{SMALL_PICTURE_PX, SmallPicture, SmallPictureId, SmallTextures, ViewTexture},
};

/// Bytes of a small picture.
const PICTURE_BYTES: u64 = 4 * SMALL_PICTURE_PX[0] as u64 * SMALL_PICTURE_PX[1] as u64;

/// The small pictures on one device.
pub struct SmallPictures {
    pipelines: Arc<Pipelines>,
    render_state: RenderState,
    wanted: Vec<SmallPicture>,
    textures: SmallTextures,
    /// Textures that only the last frame's drawing still uses.
    discarded: Vec<egui::TextureId>,
    view: Option<View>,
    /// The picture that the view draws.
    drawn: Option<SmallPictureId>,
    environment_map: Option<Arc<EnvironmentMap>>,
}

impl SmallPictures {
    /// No pictures.
    pub fn new(pipelines: Arc<Pipelines>, render_state: RenderState) -> Self {
        Self {
            pipelines,
            render_state,
            wanted: Vec::new(),
            textures: SmallTextures::default(),
            discarded: Vec::new(),
            view: None,
            drawn: None,
            environment_map: None,
        }
    }

    /// The finished pictures.
    pub fn textures(&self) -> &SmallTextures {
        &self.textures
    }

    /// Sets the wanted pictures, the first ones first, and frees the others. Call it once a frame.
    ///
    /// This frame's drawing is not submitted yet, so its textures are freed by the next call.
    pub fn want<'a>(&mut self, wanted: impl Iterator<Item = &'a SmallPicture> + Clone) {
        self.free_discarded();
        if !wanted.clone().map(|it| it.id).eq(self.wanted.iter().map(|it| it.id)) {
            self.wanted = wanted.cloned().collect();
            let is_wanted = |id: &SmallPictureId| self.wanted.iter().any(|it| it.id == *id);
            let unwanted = self.textures.by_id.extract_if(.., |id, _| !is_wanted(id));
            self.discarded.extend(unwanted.map(|(_, picture)| picture.texture));
        }
        if !self.has_work() {
            self.view = None;
            self.drawn = None;
        }
        self.count_memory();
    }

    /// Sets the loaded environment map.
    pub fn set_environment_map(&mut self, environment_map: Option<&Arc<EnvironmentMap>>) {
        self.environment_map = environment_map.cloned();
        if let Some(view) = &mut self.view {
            view.set_environment_map(environment_map);
        }
    }

    /// Notes that the interface draws a frame.
    pub fn note_frame(&mut self) {
        if let Some(view) = &mut self.view {
            view.note_frame();
        }
    }

    /// True while wanted pictures are missing.
    pub fn has_work(&self) -> bool {
        self.next().is_some()
    }

    /// True while the next picture waits for its pipelines.
    pub fn is_compiling(&self) -> bool {
        let activity = self.view.as_ref().map(|view| view.report().activity);
        matches!(activity, Some(Activity::Compiling(_)))
    }

    /// Submits as much work as fits now. Returns whether a picture was finished.
    pub fn pump(&mut self, now_secs: f64) -> bool {
        let Some(next) = self.next().cloned() else { return false };
        let (pipelines, environment_map) = (&self.pipelines, self.environment_map.as_ref());
        let view = self.view.get_or_insert_with(|| {
            let region = Region::whole(SMALL_PICTURE_PX);
            let mut view = View::new(pipelines, region, Pace::Interactive);
            view.set_environment_map(environment_map);
            view
        });
        if self.drawn.replace(next.id) != Some(next.id) {
            view.set_scene(&next.scene, false);
        }
        if view.pump(now_secs) {
            return false;
        }
        if let Some(texture) = view.texture() {
            let picture = copied(&self.render_state, texture);
            self.textures.by_id.insert(next.id, picture);
        }
        self.count_memory();
        true
    }

    /// The first wanted picture that is missing.
    fn next(&self) -> Option<&SmallPicture> {
        self.wanted.iter().find(|wanted| !self.textures.by_id.contains_key(&wanted.id))
    }

    fn free_discarded(&mut self) {
        if self.discarded.is_empty() {
            return;
        }
        let mut renderer = self.render_state.renderer.write();
        for texture in self.discarded.drain(..) {
            renderer.free_texture(&texture);
        }
    }

    fn count_memory(&mut self) {
        let view = self.view.as_ref().map_or(0, |view| view.report().memory.total());
        self.textures.memory_bytes = view + PICTURE_BYTES * self.textures.by_id.len() as u64;
    }
}

impl Drop for SmallPictures {
    fn drop(&mut self) {
        let shown = std::mem::take(&mut self.textures.by_id);
        self.discarded.extend(shown.into_values().map(|picture| picture.texture));
        self.free_discarded();
    }
}

/// A copy of `texture`, registered with egui.
fn copied(render_state: &RenderState, texture: &wgpu::Texture) -> ViewTexture {
    let device = &render_state.device;
    let copy = device.create_texture(&wgpu::TextureDescriptor {
        label: Some("small picture"),
        size: texture.size(),
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: texture.format(),
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    });
    let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    encoder.copy_texture_to_texture(texture.as_image_copy(), copy.as_image_copy(), texture.size());
    render_state.queue.submit([encoder.finish()]);
    let view = copy.create_view(&wgpu::TextureViewDescriptor::default());
    let mut renderer = render_state.renderer.write();
    let texture_id = renderer.register_native_texture(device, &view, wgpu::FilterMode::Linear);
    ViewTexture { texture: texture_id, size_px: [texture.width(), texture.height()] }
}
