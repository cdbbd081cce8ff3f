//! The camera: eye, pivot, orientation, field of view, lens and stereo.

use glam::{DQuat, DVec3};
use serde::{Deserialize, Serialize};

use super::{lens::Lens, param, stereo::Stereo};
use crate::precise::{MAX_COORDINATE, PrecisePoint};

/// Smallest distance from eye to pivot, in scene units: below the deepest zoom that renders.
pub const MIN_VIEW_UNIT: f64 = 1e-30;
/// View unit, in scene units, below which near lengths are measured in view units.
pub const CLOSE_VIEW_UNIT: f64 = 1e-3;

/// A rotation as the document stores it: `[x, y, z, w]`, length 1 within 1e-6.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Quaternion(pub [f64; 4]);

impl From<DQuat> for Quaternion {
    fn from(q: DQuat) -> Self {
        Self(q.to_array())
    }
}

impl From<Quaternion> for DQuat {
    fn from(q: Quaternion) -> Self {
        DQuat::from_array(q.0).normalize()
    }
}

/// Maximum z component of an upright camera's right vector.
const LEVEL: f64 = 1e-3;

/// A camera. In the camera's frame +X is right, +Y is up and −Z is forward.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Camera {
    /// The eye, in scene units.
    pub position: PrecisePoint,
    /// The point that the camera orbits around. The distance from eye to pivot is the view unit,
    /// at least [`MIN_VIEW_UNIT`].
    pub pivot: PrecisePoint,
    /// Rotation `world_from_camera`.
    pub orientation: Quaternion,
    /// Angle between the picture's lower and upper edges, range [`param::VERTICAL_FOV`], degrees.
    /// [`Self::half_height`] handles pictures taller than wide. Unused in stereo.
    pub vertical_fov_deg: f64,
    /// The lens.
    pub lens: Lens,
    /// The viewer's eyes and screen, for stereo pictures.
    pub stereo: Stereo,
}

impl Camera {
    /// A camera at `position` that looks at `pivot`, its +Y near `up`.
    pub fn looking_at(position: DVec3, pivot: DVec3, up: DVec3) -> Self {
        let back = (position - pivot).normalize_or(DVec3::Z);
        let right = up.cross(back).try_normalize().unwrap_or_else(|| back.any_orthonormal_vector());
        let orientation = DQuat::from_mat3(&glam::DMat3::from_cols(right, back.cross(right), back));
        Self {
            position: PrecisePoint::from(position),
            pivot: PrecisePoint::from(pivot),
            orientation: orientation.normalize().into(),
            vertical_fov_deg: param::VERTICAL_FOV.default,
            lens: Lens::default(),
            stereo: Stereo::default(),
        }
    }

    /// The camera with this orientation that sees a whole ball of `radius` about the origin.
    ///
    /// A ball so large that the eye would be out of range is seen from as far as the eye may be.
    pub fn seeing_ball(&self, radius: f64) -> Self {
        /// Room about the ball; a wide field of view needs no less distance than 60 degrees.
        const ROOM: f64 = 1.05;
        let half = 0.5 * self.vertical_fov_deg.to_radians();
        let distance = (ROOM * radius / half.sin().min(0.5)).min(MAX_COORDINATE);
        Self {
            position: PrecisePoint::from(-distance * self.forward()),
            pivot: PrecisePoint::from(DVec3::ZERO),
            ..self.clone()
        }
    }

    /// The rotation `world_from_camera`.
    pub fn rotation(&self) -> DQuat {
        self.orientation.into()
    }

    /// The unit vector of the viewing direction, in world space.
    pub fn forward(&self) -> DVec3 {
        self.rotation() * DVec3::NEG_Z
    }

    /// True if the horizon is level: the right vector is horizontal, and up is not down.
    pub fn is_upright(&self) -> bool {
        let rotation = self.rotation();
        (rotation * DVec3::X).z.abs() <= LEVEL && (rotation * DVec3::Y).z >= -LEVEL
    }

    /// Distance from eye to pivot, in scene units; never zero.
    pub fn view_unit(&self) -> f64 {
        (&self.pivot - &self.position).length().max(f64::MIN_POSITIVE)
    }

    /// True if near lengths are measured in view units, not in scene units.
    pub fn is_close(&self) -> bool {
        self.view_unit() < CLOSE_VIEW_UNIT
    }

    /// Half the picture's height at distance 1, for a width over height of `aspect`.
    ///
    /// `tan(fov/2)` for a landscape picture. In a portrait picture the angle spans the width, so
    /// that a view framed on a desktop's screen fits a phone's. In stereo, the screen's half
    /// height for every aspect.
    pub fn half_height(&self, aspect: f64) -> f64 {
        if self.stereo.is_on() {
            return self.stereo.half_height();
        }
        (self.vertical_fov_deg.to_radians() * 0.5).tan() / aspect.min(1.0)
    }
}

impl Default for Camera {
    fn default() -> Self {
        Self::looking_at(DVec3::new(1.76, -2.86, 1.2), DVec3::ZERO, DVec3::Z)
    }
}
