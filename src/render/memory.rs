//! GPU memory of a view by purpose, as in thesis 4.4, "Memory Consumption".
//!
//! In: the sizes of buffers and textures. Out: bytes, and a scene that needs the most memory. The
//! window's own pictures and the interface's textures belong to the code that shows the view, and are
//! not counted.

use std::sync::Arc;

use glam::DVec3;

use crate::scene::{
    BackgroundKind, EnvironmentLight, EnvironmentMap, IndirectKind, IntegratorKind, MAX_LIGHTS,
    RigKind, RigLight, Scene, StereoLayout, SurfaceModel, environment_map,
};

/// GPU memory of a view in bytes, by purpose.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Memory {
    /// The centre samples of all pixels: depth, normal, colour data, visibility.
    pub sample_points: u64,
    /// The jittered samples of one batch.
    pub jittered_samples: u64,
    /// The rays of one batch.
    pub rays: u64,
    /// Work queues between the passes of a batch.
    pub work_queues: u64,
    /// Light paths of one batch, noise estimates of all pixels, and the sky's textures.
    pub paths: u64,
    /// Denoised light of all pixels.
    pub denoiser: u64,
    /// Sums of the sub-frames of motion blur.
    pub shutter: u64,
    /// Direct light of the centre samples, as the source of indirect light.
    pub direct_light: u64,
    /// Sums of radiance, 32-bit.
    pub film: u64,
    /// The film's mip levels, for the mean and the bloom.
    pub mip_levels: u64,
    /// The blur's buffer beside the mip levels.
    pub blur: u64,
    /// The environment map.
    pub environment_map: u64,
    /// The display picture; also a picture of another size while that is still shown.
    pub display: u64,
    /// Frame uniforms, formula table, lights, gradient, dispatch parameters, statistics.
    pub uniforms: u64,
}

impl Memory {
    /// Each purpose with its bytes, in the order of a frame.
    pub fn purposes(&self) -> [(&'static str, u64); 14] {
        let Self {
            sample_points,
            jittered_samples,
            rays,
            work_queues,
            paths,
            denoiser,
            shutter,
            direct_light,
            film,
            mip_levels,
            blur,
            environment_map,
            display,
            uniforms,
        } = *self;
        [
            ("sample points", sample_points),
            ("jittered samples", jittered_samples),
            ("rays", rays),
            ("work queues", work_queues),
            ("light paths", paths),
            ("denoiser", denoiser),
            ("motion blur", shutter),
            ("direct light", direct_light),
            ("film", film),
            ("mip levels", mip_levels),
            ("blur", blur),
            ("environment map", environment_map),
            ("display", display),
            ("uniforms", uniforms),
        ]
    }

    /// The sum over all purposes.
    pub fn total(&self) -> u64 {
        self.purposes().iter().map(|(_, bytes)| bytes).sum()
    }
}

/// Bytes in readable form: `113.5 MiB`.
pub fn mebibytes(bytes: u64) -> String {
    format!("{:.1} MiB", bytes as f64 / f64::from(1_u32 << 20))
}

/// The scene of [`everything_on`] in path-traced light, with a sky of that map.
pub fn everything_traced() -> (Scene, Arc<EnvironmentMap>) {
    let (mut scene, environment_map) = everything_on();
    scene.lights.environment.clear();
    scene.lights.rig.kind = RigKind::EnvironmentMap;
    scene.lights.rig.environment_map.lights =
        vec![RigLight { direction: [0.0, 0.0, 1.0], strength: [1.0; 3] }];
    scene.surface.model = SurfaceModel::Physical;
    (scene.integrator.kind, scene.integrator.denoise) = (IntegratorKind::Path, true);
    (scene, environment_map)
}

/// A scene that uses every buffer of direct light, and the largest environment map.
pub fn everything_on() -> (Scene, Arc<EnvironmentMap>) {
    let mut scene = Scene::default();
    scene.camera.stereo.layout = StereoLayout::SideBySide;
    let light = EnvironmentLight {
        direction: DVec3::new(0.6, -0.64, 0.48).to_array(),
        intensity: 0.05,
        ..EnvironmentLight::default()
    };
    scene.lights.environment = vec![light; MAX_LIGHTS];
    scene.lights.rig.kind = RigKind::None;
    scene.indirect.kind = IndirectKind::Horizon;
    scene.background.kind = BackgroundKind::EnvironmentMap;
    scene.tone.auto_exposure = true;
    scene.bloom.strength = 0.3;
    let environment_map =
        EnvironmentMap::from_fn("environment map", environment_map::MAX_SIZE_PX, |_| {
            DVec3::splat(0.2)
        });
    scene.lights.rig.environment_map.name = environment_map.name().to_owned();
    (scene, Arc::new(environment_map))
}
