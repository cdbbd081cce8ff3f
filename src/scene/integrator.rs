//! How the light is computed that a picture at rest shows.

use serde::{Deserialize, Serialize};

use super::param;

/// The integrator of a picture at rest. While anything moves, the direct integrator draws.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum IntegratorKind {
    /// Light straight from the lights, and [`Indirect`](super::Indirect) light gathered on the screen.
    #[default]
    Direct,
    /// Path tracing: light that bounces between surfaces.
    Path,
}

/// Settings of the integrator.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct IntegratorSettings {
    /// The integrator.
    pub kind: IntegratorKind,
    /// Most bounces of a path, range [`param::BOUNCES`]; 0: light straight from the lights.
    pub bounces: u32,
    /// Longest distance between surfaces of a path, range [`param::BOUNCE_REACH`], view units; unlimited if none.
    ///
    /// Farther surfaces send no light and hide no sky.
    pub reach: Option<f64>,
    /// Noise target, range [`param::NOISE`]: error of a pixel over its display brightness plus 0.1.
    ///
    /// Converged pixels get no more samples. 0: every pixel gets the samples of [`Quality`](super::Quality).
    pub noise: f64,
    /// Whether noise of path tracing is smoothed for display. OpenEXR files keep the noise.
    pub denoise: bool,
    /// Greatest luminance of a path, range [`param::FIREFLY_LIMIT`]; no limit if none.
    ///
    /// Removes bright dots, and the light in them: the picture gets darker where few paths carry much light.
    pub firefly_limit: Option<f64>,
}

impl Default for IntegratorSettings {
    fn default() -> Self {
        Self {
            kind: IntegratorKind::Direct,
            bounces: param::BOUNCES.default as u32,
            reach: Some(param::BOUNCE_REACH.default),
            noise: param::NOISE.default,
            denoise: false,
            firefly_limit: None,
        }
    }
}
