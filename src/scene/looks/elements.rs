//! Lights, materials and tones that complete looks are made of.

use glam::DVec3;

use super::{srgb, stop};
use crate::scene::{
    Axis, Bloom, BloomOrder, ColorSource, Coloring, EnvironmentLight, LightFrame, Lights, Rig,
    RigKind, SecondLayer, Sky, Surface, SurfaceModel, Tone, ToneCurve,
};

/// Lights that stay with the camera: directions (x right, y up, z backward), sRGB colours, strengths.
pub(super) fn headlights<const N: usize>(lights: [([f64; 3], u32, f64); N]) -> Lights {
    let light = |(direction, rgb, intensity)| EnvironmentLight {
        // A light from the front would show its shadows nowhere, and would darken crevices.
        casts_shadows: !is_frontal(direction),
        ..EnvironmentLight::headlight(direction, srgb(rgb), intensity)
    };
    Lights { environment: lights.map(light).into(), ..Lights::default() }
}

/// Whether a direction is within 37 degrees of the viewer's.
fn is_frontal(direction: [f64; 3]) -> bool {
    DVec3::from_array(direction).normalize_or(DVec3::Z).z > 0.8
}

/// A sky that turns with the camera.
pub(super) fn sky(intensity: f64, sky: Sky) -> Lights {
    let rig = Rig { kind: RigKind::Sky, frame: LightFrame::View, intensity, sky, ..Rig::default() };
    Lights { rig, environment: Vec::new(), ..Lights::default() }
}

/// The unit vector of a sun's direction, of any length.
pub(super) fn sun(direction: [f64; 3]) -> [f64; 3] {
    DVec3::from_array(direction).normalize_or(DVec3::Z).to_array()
}

/// A second layer by the direction of the surface: the gradient's start below, its middle at the sides, its end above.
pub(super) fn by_direction(amount: f64, colors: &[u32]) -> SecondLayer {
    // Near the ends, so that straight up does not wrap to straight down.
    let coloring = Coloring {
        source: ColorSource::Normal,
        axis: Axis::Z,
        repeats: 0.98,
        offset: 0.01,
        ..Coloring::default()
    };
    let last = colors.len().saturating_sub(1).max(1) as f64;
    let gradient = (0..).zip(colors).map(|(i, &rgb)| stop(f64::from(i) / last, rgb)).collect();
    SecondLayer { amount, coloring, gradient }
}

/// A physical surface without a coat.
pub(super) fn metal(roughness: f64, metalness: f64) -> Surface {
    Surface { model: SurfaceModel::Physical, roughness, metalness, ..Surface::default() }
}

/// Stone or plastic under a clear coat.
pub(super) fn glazed(roughness: f64, coat: f64) -> Surface {
    Surface { coat, coat_roughness: 0.12, ..metal(roughness, 0.0) }
}

/// A surface with hardly any highlight.
pub(super) fn matte(ambient: f64) -> Surface {
    Surface { ambient, specular: 0.05, shininess: 12.0, ..Surface::default() }
}

/// A tone curve and an exposure in stops.
pub(super) fn tone(curve: ToneCurve, exposure: f64) -> Tone {
    Tone { curve, exposure, ..Tone::default() }
}

/// A glow as of a lens.
pub(super) fn bloom(strength: f64, radius: f64, threshold: f64) -> Bloom {
    Bloom { strength, radius, threshold, order: BloomOrder::Before, ..Bloom::default() }
}
