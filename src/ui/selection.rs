//! The selected light, colour layer and gradient stops.

use super::widgets::ArrowSteps;
use crate::scene::{Coloring, GradientStop, Lights, Surface};

/// The selected light, colour layer and gradient stops, which are not part of a scene.
#[derive(Clone, Copy, Debug, Default)]
pub struct Selection {
    /// The selected light; none if the scene has no light or none is chosen yet.
    pub light: Option<LightRef>,
    /// Indices of the selected stops of the two layers' gradients.
    stops: [usize; 2],
    /// The layer that gets the gradient of a file.
    pub gradient_target: LayerRef,
    /// Arrow-key presses on a light's row, and the light: its handle applies them.
    pub moved_light: Option<(LightRef, ArrowSteps)>,
    /// True if the pointer or the keyboard is at a control of a light in this frame.
    pub uses_lights: bool,
}

impl Selection {
    /// A selection of this light.
    pub fn of(light: LightRef) -> Self {
        Self { light: Some(light), ..Self::default() }
    }

    /// Index of the selected stop of a layer's gradient.
    pub fn stop_mut(&mut self, layer: LayerRef) -> &mut usize {
        &mut self.stops[layer as usize]
    }
}

/// A layer of the surface's colours.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LayerRef {
    /// The lower layer.
    #[default]
    First,
    /// The layer over it.
    Second,
}

impl LayerRef {
    /// The layer's value and gradient.
    pub fn of(self, surface: &mut Surface) -> (&mut Coloring, &mut Vec<GradientStop>) {
        let second = &mut surface.second_layer;
        match self {
            Self::First => (&mut surface.coloring, &mut surface.gradient),
            Self::Second => (&mut second.coloring, &mut second.gradient),
        }
    }
}

/// A reference to a light of the scene, by its index.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LightRef {
    /// A directional light.
    Environment(usize),
    /// A point light.
    Point(usize),
}

impl LightRef {
    /// True if the scene has this light.
    pub fn exists(self, lights: &Lights) -> bool {
        match self {
            Self::Environment(index) => index < lights.environment.len(),
            Self::Point(index) => index < lights.point.len(),
        }
    }

    /// The light's name in the list of lights.
    pub fn name(self) -> String {
        match self {
            Self::Environment(index) => format!("Light {}", index + 1),
            Self::Point(index) => format!("Point {}", index + 1),
        }
    }
}
