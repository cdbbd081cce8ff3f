//! Fills the uniforms that the shaders read of a scene.
//!
//! In: a scene, its region. Out: bytes. `tests/source/shaders.rs` compares each struct, field
//! by field, with its twin in `shaders/types/`.

mod background;
mod camera;
mod dispatch_params;
mod lights;
mod march;
mod media;
mod paths;
mod shared;
mod surface;
mod tone;

use std::sync::Arc;

pub use dispatch_params::*;
pub use lights::lights;
pub use shared::*;

use super::{
    Region,
    color_curve::{ColorCurve, LayerCurves},
    schedule::Stale,
    sky::SampledSky,
    space::RenderSpace,
    sub_frame::SubFrame,
};
use crate::{
    formula::{Packed, PackedFor, contract::MAX_UNIFORM_BYTES, trap::MAX_TRAP},
    gpu::host_shared::{Array, HostShared},
    scene::{
        self, ColorSource, Coloring, EnvironmentMap, IndirectKind, MAX_LIGHTS, Normals, Scene,
    },
};

/// Bytes of the shaders' `FrameUniforms`, with room for any formula's part.
pub const FRAME_BYTES: u64 = (FrameUniforms::SIZE + MAX_UNIFORM_BYTES) as u64;

/// Number of entries of the gradient table.
pub const GRADIENT_ENTRIES: usize = 256;

/// The greatest value of a formula's channel that colours tell apart.
const MAX_CHANNEL: f64 = 4.0;

impl FrameUniforms {
    /// The uniforms of `scene` in `region`; finds the render space itself.
    pub fn new(scene: &Scene, region: Region) -> Self {
        Self::about(scene, region, &RenderSpace::of(scene, region))
    }

    /// The uniforms of `scene` in `region`, in the render space `space`.
    ///
    /// Without the kernel's step limits, which [`Inputs::about`] adds.
    pub fn about(scene: &Scene, region: Region, space: &RenderSpace) -> Self {
        let camera = camera::camera(scene, region, space);
        let march = march::march(scene, region, space, camera.hit_cone);
        let iterations = march.iterations;
        Self {
            camera,
            eyes: camera::eyes(&scene.camera, region, space),
            march,
            surface: surface::surface(scene),
            first_layer: layer(&scene.surface.coloring, iterations),
            second_layer: second_layer(&scene.surface, iterations),
            sections: surface::sections(scene, space),
            indirect: indirect(&scene.indirect, region),
            background: background::background(scene),
            medium: media::medium(scene, space),
            fog: media::fog(scene, space),
            tone: tone::tone(&scene.tone),
            bloom: tone::bloom(&scene.bloom),
            paths: paths::paths(scene, space),
            picture_px: region.picture_px,
            origin_px: region.origin_px,
            size_px: region.film_px(),
            normals: match scene.quality.normals {
                Normals::None => 0,
                Normals::Three => 1,
                Normals::Six => 2,
                Normals::Eighteen => 3,
                Normals::TwentySix => 4,
                Normals::Analytic => 5,
            },
            color_curves: Array::default(),
        }
    }
}

fn indirect(indirect: &scene::Indirect, region: Region) -> Indirect {
    Indirect {
        kind: match indirect.kind {
            IndirectKind::Off => 0,
            IndirectKind::Uniform => 1,
            IndirectKind::Horizon => 2,
        },
        radius: indirect.radius as f32,
        strength: indirect.strength as f32,
        ambient: indirect.ambient as f32,
        directions: indirect.directions,
        samples: indirect.samples,
        source_px: region.size_px,
    }
}

/// One layer of colours; `iterations` are those of the view.
fn layer(coloring: &Coloring, iterations: u32) -> ColorLayer {
    let (source, greatest) = match coloring.source {
        ColorSource::Iterations => (1, f64::from(iterations + 1)),
        ColorSource::Channel => (2, MAX_CHANNEL),
        ColorSource::Position => (3, 1.0),
        ColorSource::Normal => (4, 1.0),
        ColorSource::PointTrap => (5, MAX_TRAP),
        ColorSource::AxisTrap => (6, MAX_TRAP),
        ColorSource::PlaneTrap => (7, MAX_TRAP),
        ColorSource::SphereTrap => (8, MAX_TRAP),
        ColorSource::CubeTrap => (9, MAX_TRAP),
    };
    ColorLayer {
        center: coloring.center.map(|x| x as f32),
        source,
        axis: coloring.axis.direction().as_vec3().to_array(),
        size: coloring.size as f32,
        greatest: greatest as f32,
        repeats: coloring.repeats as f32,
        offset: coloring.offset as f32,
        follows_view: u32::from(coloring.follows_view),
        curve_low: 0.0,
        curve_per_value: 1.0,
        amount: 1.0,
    }
}

/// The second layer of colours; its default if it is not in use.
fn second_layer(surface: &scene::Surface, iterations: u32) -> ColorLayer {
    if !surface.uses_second_layer() {
        return ColorLayer { greatest: 1.0, ..ColorLayer::default() };
    }
    let second = &surface.second_layer;
    ColorLayer { amount: second.amount as f32, ..layer(&second.coloring, iterations) }
}

impl ColorLayer {
    /// Whether marches store the same values for `other`.
    fn has_values_of(&self, other: &Self) -> bool {
        let stored = |layer: &Self| (layer.source, layer.center, layer.axis, layer.size);
        stored(self) == stored(other)
    }
}

/// All inputs that a picture's passes read of its scene.
#[derive(Clone, PartialEq)]
pub struct Inputs {
    /// Camera, march, surface, tone, region.
    pub frame: FrameUniforms,
    /// The formula's uniforms, and the kernel that reads them.
    pub formula: Packed,
    /// The lights, in the scene's order.
    pub lights: [Light; MAX_LIGHTS],
    /// The gradients of the two colour layers: linear Rec. 709, periodic.
    pub gradients: [[[f32; 4]; GRADIENT_ENTRIES]; 2],
    /// The [`EnvironmentMap::id`] of the shown environment map; none if none is shown.
    pub environment_map: Option<u64>,
    /// The sky that paths see; none without one.
    pub sky: Option<Arc<SampledSky>>,
    /// The sub-frame of motion blur; none for other pictures.
    pub sub_frame: Option<SubFrame>,
}

impl Inputs {
    /// The inputs of `scene` in `region`; finds the render space itself.
    pub fn new(scene: &Scene, region: Region) -> Self {
        Self::about(scene, region, &RenderSpace::of(scene, region))
    }

    /// The inputs of `scene` in `region`, in the render space `space`.
    pub fn about(scene: &Scene, region: Region, space: &RenderSpace) -> Self {
        let mut frame = FrameUniforms::about(scene, region, space);
        let model = space.model();
        let formula = model.fractal().formula().pack(
            model.fractal(),
            &PackedFor {
                iterations: frame.march.iterations,
                scale: space.scale(),
                hit_cone: frame.camera.hit_cone,
                reference: space.reference(),
                bounding_radius: model.bounding_radius(),
                traps: scene.surface.traps(),
            },
        );
        let lights = lights(scene, space);
        frame.fog = frame.fog.lit_by(&lights);
        frame.march =
            frame.march.with_step_limits(formula.step_limits).with_series(formula.series_steps);
        Self {
            frame,
            formula,
            lights,
            gradients: media::gradients(scene),
            environment_map: None,
            sky: None,
            sub_frame: None,
        }
    }

    /// The bytes of the shaders' `FrameUniforms`: the frame, then the formula's part.
    pub fn frame_bytes(&self) -> Vec<u8> {
        [self.frame.to_bytes(), self.formula.uniforms.clone()].concat()
    }

    /// The inputs with the environment map `at_hand`, if `scene` shows it.
    pub fn with_environment_map(mut self, scene: &Scene, at_hand: Option<&EnvironmentMap>) -> Self {
        let shown = background::shown(scene, at_hand);
        self.environment_map = shown.map(EnvironmentMap::id);
        let gain = scene.lights.rig.intensity as f32;
        self.frame.background.map_gain = if shown.is_some() { gain } else { 0.0 };
        self
    }

    /// The inputs with the sky that light paths see; without one, the rig's lights stand for it.
    pub fn with_sky(
        mut self,
        scene: &Scene,
        space: &RenderSpace,
        sky: Option<&Arc<SampledSky>>,
    ) -> Self {
        if let Some(sky) = sky.filter(|_| scene.traces_paths()) {
            paths::add_sky(&mut self.frame.paths, scene, space, sky);
            self.sky = Some(sky.clone());
        }
        self
    }

    /// The inputs of a sub-frame.
    pub fn with_sub_frame(mut self, sub_frame: Option<SubFrame>) -> Self {
        self.sub_frame = sub_frame;
        self
    }

    /// The inputs with the number of samples over which light paths replace the direct picture.
    pub fn with_preview(mut self, samples: u32) -> Self {
        if self.traces_paths() {
            self.frame.paths.preview_samples = samples as f32;
        }
        self
    }

    /// Whether light paths are traced for jittered samples.
    pub fn traces_paths(&self) -> bool {
        self.frame.paths.ray_reach > 0.0
    }

    /// Whether paths scatter inside the set, which has no surface for them.
    pub fn traces_medium(&self) -> bool {
        self.traces_paths() && self.frame.medium.kind != 0
    }

    /// The inputs with another view's indirect source; `eye_px` is the size of one eye's picture.
    pub fn with_indirect_source(mut self, eye_px: Option<[u32; 2]>) -> Self {
        self.frame.indirect.source_px = eye_px.unwrap_or(self.frame.indirect.source_px);
        self
    }

    /// The two layers of colours.
    pub fn layers(&self) -> [&ColorLayer; 2] {
        [&self.frame.first_layer, &self.frame.second_layer]
    }

    /// The greatest values that can select a colour in each layer.
    pub fn greatest_color_values(&self) -> [f64; 2] {
        self.layers().map(|layer| layer.greatest.into())
    }

    /// Whether the colours of a layer follow the view.
    pub fn follows_colors(&self) -> bool {
        self.layers().iter().any(|layer| layer.follows_view != 0)
    }

    /// The inputs with colour curves, for layers that follow one; straight lines if there are none.
    pub fn with_color_curves(mut self, curves: Option<&LayerCurves>) -> Self {
        if self.follows_colors() {
            let lines = self.greatest_color_values().map(ColorCurve::line);
            let curves = curves.unwrap_or(&lines);
            let frame = &mut self.frame;
            for (layer, curve) in
                [&mut frame.first_layer, &mut frame.second_layer].into_iter().zip(curves)
            {
                [layer.curve_low, layer.curve_per_value] = curve.range();
            }
            frame.color_curves = ColorCurve::packed(curves);
        }
        self
    }

    /// Whether marches store the colour values of `old`.
    pub fn has_color_values_of(&self, old: &Self) -> bool {
        self.layers().into_iter().zip(old.layers()).all(|(new, old)| new.has_values_of(old))
    }

    /// The inputs with the visibility bits that `old` gave to the same lights.
    pub fn with_bits_of(mut self, old: Option<&Self>) -> Self {
        if let Some(old) = old {
            let count = self.lights_in_use().len();
            lights::keep_bits(&mut self.lights[..count], old.lights_in_use());
        }
        self
    }

    /// The visibility bits of the lights that shine; other lights need none.
    pub fn shining(&self) -> u64 {
        lights::shining(self.lights_in_use())
    }

    /// Whether jittered samples take the place of centre samples on the film: if centre samples show another light, or
    /// would be a large part of a sub-frame, all in the middle of pixels.
    pub fn replaces_center_samples(&self) -> bool {
        self.traces_paths()
            || self.sub_frame.is_some()
            || self.frame.camera.lens_radius > 0.0
            || lights::any_with_size(self.lights_in_use())
    }

    /// The visibility bits of the lights that have shadow rays.
    pub fn casting(&self) -> u64 {
        lights::casting(self.lights_in_use())
    }

    /// The visibility bits of the lights whose shadow rays differ from those in `old`.
    ///
    /// Includes lights that do not shine.
    pub fn moved_since(&self, old: &Self) -> u64 {
        lights::moved(self.lights_in_use(), old.lights_in_use())
    }

    /// The lights of the scene, shining or not.
    pub fn lights_in_use(&self) -> &[Light] {
        let count = self.frame.surface.light_count as usize;
        &self.lights[..count.min(MAX_LIGHTS)]
    }

    /// Whether points are lit as in `old`; `self` must have [its bits](Self::with_bits_of).
    fn is_lit_as(&self, old: &Self) -> bool {
        fn shining(inputs: &Inputs) -> impl Iterator<Item = &Light> {
            inputs.lights_in_use().iter().filter(|light| light.color != [0.0; 3])
        }
        shining(self).eq(shining(old))
    }

    /// Whether there is indirect light.
    pub fn has_indirect(&self) -> bool {
        self.frame.indirect.kind != 0
    }

    /// How far around a pixel its indirect light comes from, in pixels; 0 without indirect light.
    ///
    /// Light paths leave none on the film.
    pub fn indirect_radius_px(&self) -> u32 {
        /// The places of both samples in their pixels.
        const ROUNDING_PX: f32 = 2.0;
        if !self.has_indirect() || self.traces_paths() {
            return 0;
        }
        let height = self.frame.picture_px[1] as f32;
        (self.frame.indirect.radius * height + ROUNDING_PX).ceil() as u32
    }

    /// As [`Self::stale_since`], as if both pictures had one width.
    pub fn stale_but_for_width(&self, old: &Self) -> Option<Stale> {
        let mut narrowed = self.clone();
        let (frame, old_frame) = (&mut narrowed.frame, &old.frame);
        frame.camera.aspect = old_frame.camera.aspect;
        frame.picture_px[0] = old_frame.picture_px[0];
        frame.size_px[0] = old_frame.size_px[0];
        frame.eyes.second_at = old_frame.eyes.second_at;
        frame.indirect.source_px[0] = old_frame.indirect.source_px[0];
        narrowed.stale_since(old)
    }

    /// The level of results that differ from `old`; none if no pass reads a difference.
    ///
    /// `self` must have the [visibility bits](Self::with_bits_of) of `old`.
    pub fn stale_since(&self, old: &Self) -> Option<Stale> {
        let cuts = |frame: &FrameUniforms| {
            let Sections { planes, band_reach, count, .. } = frame.sections;
            (planes, band_reach, count)
        };
        let paths = |frame: &FrameUniforms| PathTracing {
            preview_samples: 0.0,
            noise: 0.0,
            denoise: 0,
            ..frame.paths
        };
        let (new_frame, old_frame) = (&self.frame, &old.frame);
        let same_geometry = new_frame.camera == old_frame.camera
            && new_frame.eyes == old_frame.eyes
            && new_frame.march == old_frame.march
            && self.formula == old.formula
            && self.has_color_values_of(old)
            && cuts(new_frame) == cuts(old_frame)
            && new_frame.picture_px == old_frame.picture_px
            && new_frame.origin_px == old_frame.origin_px
            && new_frame.size_px == old_frame.size_px;
        let surface = |inputs: &Self| Surface { light_count: 0, ..inputs.frame.surface };
        let same_light = surface(self) == surface(old)
            && self.layers() == old.layers()
            && new_frame.sections == old_frame.sections
            && new_frame.color_curves == old_frame.color_curves
            && new_frame.background == old_frame.background
            && new_frame.medium == old_frame.medium
            && new_frame.fog == old_frame.fog
            && paths(new_frame) == paths(old_frame)
            && self.sky == old.sky
            && self.environment_map == old.environment_map
            && self.is_lit_as(old)
            && self.gradients == old.gradients
            && self.has_indirect() == old.has_indirect()
            && self.sub_frame == old.sub_frame;
        if !same_geometry {
            Some(Stale::Geometry)
        } else if new_frame.normals != old_frame.normals {
            Some(Stale::Normals)
        } else if !same_light {
            Some(Stale::Light)
        } else if self.has_indirect() && new_frame.indirect != old_frame.indirect {
            // With light paths, the direct picture is stored in place of the direct light.
            Some(if self.traces_paths() { Stale::Light } else { Stale::Indirect })
        } else {
            let same_tone = new_frame.tone == old_frame.tone
                && new_frame.bloom == old_frame.bloom
                && new_frame.paths == old_frame.paths;
            (!same_tone).then_some(Stale::Tone)
        }
    }
}
