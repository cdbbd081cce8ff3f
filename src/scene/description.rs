//! The whole description of a scene.

use serde::{Deserialize, Serialize};

use super::{
    background::{Background, BackgroundKind},
    bloom::Bloom,
    camera::Camera,
    environment_map::EnvironmentMap,
    fog::Fog,
    indirect::{Indirect, IndirectKind},
    integrator::{IntegratorKind, IntegratorSettings},
    lighting::Lights,
    medium::{Medium, MediumKind},
    quality::Quality,
    rig::RigKind,
    surface::Surface,
    tone::Tone,
};
use crate::formula::Fractal;

/// Everything a picture depends on, except its size in pixels.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Scene {
    /// The set that is drawn: a formula and its values.
    pub fractal: Fractal,
    /// Where it is seen from.
    pub camera: Camera,
    /// What lights it: at most [`MAX_LIGHTS`](super::MAX_LIGHTS) in all.
    pub lights: Lights,
    /// How its surface answers light, and its colours.
    pub surface: Surface,
    /// The medium that takes the surface's place in path tracing.
    pub medium: Medium,
    /// Air that scatters light.
    pub fog: Fog,
    /// Light that reaches the surface by way of others, as the direct integrator gathers it.
    pub indirect: Indirect,
    /// How the light of a picture at rest is computed.
    pub integrator: IntegratorSettings,
    /// What is seen where a ray meets nothing.
    pub background: Background,
    /// How scene radiance becomes display values.
    pub tone: Tone,
    /// Light that spreads around what is bright.
    pub bloom: Bloom,
    /// How much work a picture is given.
    pub quality: Quality,
}

impl Scene {
    /// Whether light paths are traced while the picture is at rest.
    pub fn traces_paths(&self) -> bool {
        self.integrator.kind == IntegratorKind::Path
    }

    /// Switches path tracing on, with enough samples for it, and denoised.
    pub fn trace_paths(&mut self) {
        /// Fewer samples are noisy.
        const SAMPLES: u32 = 256;
        if self.quality.samples < SAMPLES {
            // The first time; later, the choice of the last time stays.
            self.integrator.denoise = true;
        }
        self.integrator.kind = IntegratorKind::Path;
        self.quality.samples = self.quality.samples.max(SAMPLES);
    }

    /// Whether displays show denoised light.
    pub fn denoises(&self) -> bool {
        self.traces_paths() && self.integrator.denoise
    }

    /// Whether paths scatter inside the set, which has no surface for them.
    pub fn traces_medium(&self) -> bool {
        self.traces_paths() && self.medium.kind != MediumKind::None
    }

    /// Whether the scene has indirect light.
    pub fn has_indirect(&self) -> bool {
        self.indirect.kind != IndirectKind::Off
    }

    /// Lights the scene by `environment_map`, and shows a new map as the background.
    ///
    /// A map is new if the scene does not name it yet. A scene that names the map but has
    /// another kind of rig stays unchanged.
    pub fn surround_by(&mut self, environment_map: &EnvironmentMap) {
        let is_new = self.lights.rig.environment_map.name != environment_map.name();
        if is_new {
            self.background.kind = BackgroundKind::EnvironmentMap;
        }
        if is_new || self.lights.rig.kind == RigKind::EnvironmentMap {
            let room = self.lights.room_for_rig();
            self.lights.rig.light_by(environment_map, room);
        }
    }
}
