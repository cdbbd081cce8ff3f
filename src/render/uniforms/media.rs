//! The uniforms of the set's medium and of fog.

use glam::DVec3;

use super::{Fog, GRADIENT_ENTRIES, Light, Medium};
use crate::{
    render::space::RenderSpace,
    scene::{GradientStop, MediumKind, Scene, color},
};

/// Greatest length in render space, so that an f32 holds its square.
const MAX_LENGTH: f64 = 1e15;

/// The medium in place of the set's surface; its default without one.
pub fn medium(scene: &Scene, space: &RenderSpace) -> Medium {
    let medium = &scene.medium;
    let view_unit = scene.camera.view_unit() / space.scale();
    let range = medium.dense_iterations - medium.thin_iterations;
    Medium {
        color: medium.color,
        kind: match medium.kind {
            MediumKind::None => return Medium::default(),
            MediumKind::Set => 1,
            MediumKind::Iterations => 2,
        },
        mean_free_path: (medium.mean_free_path * view_unit).min(MAX_LENGTH) as f32,
        anisotropy: medium.anisotropy as f32,
        thin: medium.thin_iterations as f32,
        // Counts in the wrong order make a hard edge.
        per_iteration: range.max(1e-3).recip() as f32,
    }
}

/// The gradients of the two colour layers; that of the medium's own colour if there is a medium.
pub fn gradients(scene: &Scene) -> [[[f32; 4]; GRADIENT_ENTRIES]; 2] {
    let surface = &scene.surface;
    if scene.medium.kind != MediumKind::None {
        let color = scene.medium.color.map(|albedo| reflectance(albedo, scene.medium.anisotropy));
        return [color::gradient_lut(&[GradientStop { position: 0.0, color }]); 2];
    }
    [&surface.gradient, &surface.second_layer.gradient].map(|stops| color::gradient_lut(stops))
}

/// Reflectance of a deep medium under light from all sides, by its single-scattering albedo and mean cosine
/// (C. Kulla, A. Conty, Revisiting Physically Based Shading at Imageworks, 2017, after van de Hulst).
fn reflectance(albedo: f32, anisotropy: f64) -> f32 {
    let albedo = f64::from(albedo);
    let s = ((1.0 - albedo) / (1.0 - albedo * anisotropy)).sqrt();
    ((1.0 - s) * (1.0 - 0.139 * s) / (1.0 + 1.17 * s)) as f32
}

/// Fog in black light; its default without fog.
pub fn fog(scene: &Scene, space: &RenderSpace) -> Fog {
    let fog = &scene.fog;
    if fog.density <= 0.0 {
        return Fog::default();
    }
    let view_unit = scene.camera.view_unit() / space.scale();
    let length = |views: f64| (views * view_unit).clamp(-MAX_LENGTH, MAX_LENGTH) as f32;
    Fog {
        color: fog.color,
        density: (fog.density / view_unit) as f32,
        center: space.point(&scene.camera.pivot).as_vec3().to_array(),
        radius: length(fog.radius),
        ambient: [0.0; 3],
        anisotropy: fog.anisotropy as f32,
        level: length(fog.level),
        inverse_height: fog.height.map_or(0.0, |height| (1.0 / (height * view_unit)) as f32),
    }
}

impl Fog {
    /// The fog in the light of `lights`, as its centre sees them without shadows.
    pub fn lit_by(mut self, lights: &[Light]) -> Self {
        if self.density <= 0.0 {
            return self;
        }
        let center = DVec3::from_array(self.center.map(f64::from));
        for light in lights {
            let place = DVec3::from_array(light.vector.map(f64::from));
            let gain = match light.kind {
                0 => 1.0,
                _ => {
                    // At least the mean over the ball for a light in its middle.
                    let least = f64::from(self.radius).powi(2) / 3.0;
                    let size = f64::from(light.size).powi(2);
                    center.distance_squared(place).max(least).max(size).max(1e-24).recip()
                }
            };
            for (channel, color) in light.color.into_iter().enumerate() {
                // Irradiance over 4 pi, of a light whose colour is the irradiance over pi.
                let radiance = 0.25 * gain * f64::from(color);
                self.ambient[channel] += self.color[channel] * radiance.min(1e30) as f32;
            }
        }
        self
    }
}
