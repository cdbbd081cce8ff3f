//! Surface material (Blinn-Phong, thesis 3.2) and colouring.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::param;
use crate::{
    formula::trap::{Trap, TrapShape},
    reading::at_most,
};

/// Maximum number of stops in a gradient.
pub const MAX_GRADIENT_STOPS: usize = 64;

/// The value that selects a colour of the gradient.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ColorSource {
    /// The smooth iteration count (thesis eq. 3.1, for any power).
    Iterations,
    /// Orbit trap: the smallest distance of the orbit from a point, by default the origin.
    #[default]
    #[serde(alias = "origin_trap")]
    PointTrap,
    /// Orbit trap: the smallest distance of the orbit from a line along an axis.
    AxisTrap,
    /// Orbit trap: the smallest distance of the orbit from a plane across an axis.
    PlaneTrap,
    /// Orbit trap: the smallest distance of the orbit from a sphere's surface.
    SphereTrap,
    /// Orbit trap: the smallest distance of the orbit from a cube's surface.
    CubeTrap,
    /// The formula's own channel, such as a count of folds, on average over the steps.
    Channel,
    /// The point's position along an axis: 0 at one end of the set, 1 at the other.
    Position,
    /// The direction of the surface: 0 against an axis, 1 along it.
    Normal,
}

impl ColorSource {
    /// The shape of the orbit trap; none for other values.
    pub fn trap_shape(self) -> Option<TrapShape> {
        match self {
            Self::PointTrap => Some(TrapShape::Point),
            Self::AxisTrap => Some(TrapShape::Axis),
            Self::PlaneTrap => Some(TrapShape::Plane),
            Self::SphereTrap => Some(TrapShape::Sphere),
            Self::CubeTrap => Some(TrapShape::Cube),
            Self::Iterations | Self::Channel | Self::Position | Self::Normal => None,
        }
    }

    /// Whether the value depends on [`Coloring::axis`].
    pub fn has_axis(self) -> bool {
        matches!(self, Self::AxisTrap | Self::PlaneTrap | Self::Position | Self::Normal)
    }

    /// Whether the value depends on [`Coloring::size`].
    pub fn has_size(self) -> bool {
        matches!(self, Self::SphereTrap | Self::CubeTrap)
    }
}

/// An axis of the scene.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Axis {
    /// To the right at the start.
    X,
    /// Away from the viewer at the start.
    Y,
    /// Up.
    #[default]
    Z,
}

impl Axis {
    /// The unit vector along the axis.
    pub fn direction(self) -> DVec3 {
        match self {
            Self::X => DVec3::X,
            Self::Y => DVec3::Y,
            Self::Z => DVec3::Z,
        }
    }
}

/// The mapping from a value of a point or its orbit to a position in the gradient.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Coloring {
    /// The value.
    pub source: ColorSource,
    /// The direction of lines, of planes' normals, of positions and of normals.
    pub axis: Axis,
    /// Centre of the orbit trap, each coordinate in [`param::TRAP_CENTER`].
    pub center: [f64; 3],
    /// Radius of the sphere or half width of the cube of an orbit trap, range [`param::TRAP_SIZE`].
    pub size: f64,
    /// Whether the gradient spans the values in view, instead of those from 0 to 1.
    pub follows_view: bool,
    /// Repeats of the gradient per unit of the value, or over the values in view, range [`param::COLOR_REPEATS`].
    pub repeats: f64,
    /// Start position in the gradient, range [`param::COLOR_OFFSET`].
    pub offset: f64,
}

impl Default for Coloring {
    fn default() -> Self {
        Self {
            source: ColorSource::default(),
            axis: Axis::default(),
            center: [param::TRAP_CENTER.default; 3],
            size: param::TRAP_SIZE.default,
            follows_view: false,
            repeats: param::COLOR_REPEATS.default,
            offset: param::COLOR_OFFSET.default,
        }
    }
}

impl Coloring {
    /// The orbit trap that the colours depend on; none if they depend on another value.
    pub fn trap(&self) -> Option<Trap> {
        let shape = self.source.trap_shape()?;
        let center = DVec3::from_array(self.center);
        Some(Trap { shape, center, axis: self.axis.direction(), size: self.size })
    }
}

/// One colour of the gradient.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GradientStop {
    /// Position in the gradient, 0 to 1.
    pub position: f64,
    /// Linear Rec. 709, each channel 0 to 1.
    pub color: [f32; 3],
}

/// How the surface reflects light.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SurfaceModel {
    /// A diffuse surface with a highlight (Blinn 1977; thesis 3.2).
    #[default]
    BlinnPhong,
    /// A diffuse surface or metal with GGX reflection (B. Walter et al., EGSR 2007), under a clear coat: reflects no
    /// more light than it gets.
    Physical,
}

/// Values of the surface that the second layer of colours drives: each is multiplied by the brightness of the layer's
/// gradient, and emission takes the gradient's colour.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct DrivenByLayer {
    /// Drives [`Surface::roughness`].
    pub roughness: bool,
    /// Drives [`Surface::metalness`].
    pub metalness: bool,
    /// Drives [`Surface::coat`].
    pub coat: bool,
    /// Drives [`Surface::emission`].
    pub emission: bool,
}

impl DrivenByLayer {
    /// Whether the layer drives any value.
    pub fn any(self) -> bool {
        self != Self::default()
    }
}

/// The surface's material and colouring.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Surface {
    /// How the surface reflects light.
    pub model: SurfaceModel,
    /// Fraction of the colour that is visible without light, range [`param::AMBIENT`]. Path tracing has none.
    pub ambient: f64,
    /// Blinn-Phong: diffuse reflectance, range [`param::DIFFUSE`].
    pub diffuse: f64,
    /// Blinn-Phong: specular reflectance, range [`param::SPECULAR`].
    pub specular: f64,
    /// Blinn-Phong: exponent, range [`param::SHININESS`].
    pub shininess: f64,
    /// Physical: roughness, range [`param::ROUGHNESS`]; its square is GGX's width.
    pub roughness: f64,
    /// Physical: part of the surface that is metal, range [`param::METALNESS`].
    pub metalness: f64,
    /// Physical: reflectance at normal incidence of what is not metal; linear Rec. 709, each channel 0 to 1.
    pub specular_color: [f32; 3],
    /// Physical: part of the surface under a clear coat, range [`param::COAT`].
    pub coat: f64,
    /// Physical: roughness of the coat, range [`param::COAT_ROUGHNESS`].
    pub coat_roughness: f64,
    /// Emitted radiance over the surface's colour, range [`param::EMISSION`].
    pub emission: f64,
    /// Which of these values the second layer of colours drives.
    pub driven_by_layer: DrivenByLayer,
    /// The mapping from a value to the gradient.
    pub coloring: Coloring,
    /// 1 to [`MAX_GRADIENT_STOPS`] stops with non-decreasing positions. The gradient wraps: the
    /// last stop blends to the first.
    #[serde(deserialize_with = "at_most::<MAX_GRADIENT_STOPS, _, _>")]
    pub gradient: Vec<GradientStop>,
    /// A second layer of colours over the first.
    pub second_layer: SecondLayer,
    /// The colours of section planes.
    pub sections: SectionColors,
}

/// The colours that section planes show: the first layer's gradient by smooth iterations (thesis eq. 3.1) outside
/// of the set, and one colour inside.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct SectionColors {
    /// Repeats of the gradient per iteration, range [`param::SECTION_REPEATS`].
    pub repeats: f64,
    /// Colour of the inside, linear Rec. 709, each channel 0 to 1.
    pub inside: [f32; 3],
}

impl Default for SectionColors {
    fn default() -> Self {
        Self { repeats: param::SECTION_REPEATS.default, inside: [0.06, 0.055, 0.055] }
    }
}

/// A layer of colours that is blended over the surface's first.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct SecondLayer {
    /// Part of the layer in the colour, range [`param::SECOND_LAYER_AMOUNT`]; 0 is off.
    pub amount: f64,
    /// The mapping from a value to the layer's gradient.
    pub coloring: Coloring,
    /// The layer's gradient, as [`Surface::gradient`].
    #[serde(deserialize_with = "at_most::<MAX_GRADIENT_STOPS, _, _>")]
    pub gradient: Vec<GradientStop>,
}

impl SecondLayer {
    /// Whether the layer is visible.
    pub fn is_on(&self) -> bool {
        self.amount > 0.0
    }
}

impl Surface {
    /// Whether the second layer is visible, or drives a value of the surface.
    pub fn uses_second_layer(&self) -> bool {
        self.second_layer.is_on() || self.driven_by_layer.any()
    }

    /// Whether the colours of a layer in use follow the view.
    pub fn follows_view(&self) -> bool {
        self.coloring.follows_view
            || (self.uses_second_layer() && self.second_layer.coloring.follows_view)
    }

    /// The orbit traps of the first and of the second layer; none for layers with other values.
    pub fn traps(&self) -> [Option<Trap>; 2] {
        let second = self.second_layer.coloring.trap();
        [self.coloring.trap(), second.filter(|_| self.uses_second_layer())]
    }
}

impl Default for SecondLayer {
    fn default() -> Self {
        let stop = |position, color| GradientStop { position, color };
        Self {
            amount: param::SECOND_LAYER_AMOUNT.default,
            coloring: Coloring::default(),
            gradient: vec![
                stop(0.0, [0.02, 0.05, 0.12]),
                stop(0.4, [0.05, 0.28, 0.42]),
                stop(0.75, [0.75, 0.85, 0.80]),
            ],
        }
    }
}

impl Default for Surface {
    fn default() -> Self {
        let stop = |position, color| GradientStop { position, color };
        Self {
            model: SurfaceModel::default(),
            ambient: param::AMBIENT.default,
            diffuse: param::DIFFUSE.default,
            specular: param::SPECULAR.default,
            shininess: param::SHININESS.default,
            roughness: param::ROUGHNESS.default,
            metalness: param::METALNESS.default,
            specular_color: [0.04; 3],
            coat: param::COAT.default,
            coat_roughness: param::COAT_ROUGHNESS.default,
            emission: param::EMISSION.default,
            driven_by_layer: DrivenByLayer::default(),
            coloring: Coloring::default(),
            // The last stop is below 1, so the blend back to the first is not abrupt.
            gradient: vec![
                stop(0.0, [0.10, 0.02, 0.05]),
                stop(0.3, [0.62, 0.16, 0.06]),
                stop(0.52, [0.90, 0.55, 0.20]),
                stop(0.7, [0.92, 0.82, 0.62]),
                stop(0.85, [0.25, 0.32, 0.42]),
            ],
            second_layer: SecondLayer::default(),
            sections: SectionColors::default(),
        }
    }
}
