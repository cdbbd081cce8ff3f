//! Where the scene is seen from.

use glam::{DQuat, DVec3};
use serde::{Deserialize, Serialize};

use super::{PrecisePoint, Stereo, param};

/// Least distance from eye to pivot, in scene units: below the deepest zoom that can be drawn.
pub const MIN_VIEW_UNIT: f64 = 1e-30;

/// A rotation in the document: `[x, y, z, w]`, length 1 within 1e-6.
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

/// A pinhole camera. In its own frame +X is right, +Y up, and it looks along −Z.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Camera {
    /// The eye, in scene units.
    pub position: PrecisePoint,
    /// The point that orbiting turns about; its distance to the eye, at least
    /// [`MIN_VIEW_UNIT`], is the view unit.
    pub pivot: PrecisePoint,
    /// Rotation `world_from_camera`.
    pub orientation: Quaternion,
    /// Angle between the picture's lower and upper edges, in [`param::VERTICAL_FOV`], degrees;
    /// see [`Self::half_height`] for pictures taller than wide. In stereo the screen decides.
    pub vertical_fov_deg: f64,
    /// Both eyes of a picture in stereo.
    pub stereo: Stereo,
}

impl Camera {
    /// A camera at `position` that looks at `pivot` with `up` as near to upward as it can be.
    pub fn looking_at(position: DVec3, pivot: DVec3, up: DVec3) -> Self {
        let back = (position - pivot).normalize_or(DVec3::Z);
        let right = up.cross(back).try_normalize().unwrap_or_else(|| back.any_orthonormal_vector());
        let orientation = DQuat::from_mat3(&glam::DMat3::from_cols(right, back.cross(right), back));
        Self {
            position: PrecisePoint::from(position),
            pivot: PrecisePoint::from(pivot),
            orientation: orientation.normalize().into(),
            vertical_fov_deg: param::VERTICAL_FOV.default,
            stereo: Stereo::default(),
        }
    }

    /// `world_from_camera`.
    pub fn rotation(&self) -> DQuat {
        self.orientation.into()
    }

    /// The unit vector that the camera looks along, in world space.
    pub fn forward(&self) -> DVec3 {
        self.rotation() * DVec3::NEG_Z
    }

    /// Distance from eye to pivot, in scene units; never zero.
    pub fn view_unit(&self) -> f64 {
        (&self.pivot - &self.position).length().max(f64::MIN_POSITIVE)
    }

    /// Half the height, at distance one, of a picture whose width over height is `aspect`:
    /// `tan(fov/2)`. A picture taller than wide spans the angle across its width instead, so
    /// that a view framed on a desktop's screen fits a phone's. In stereo it is the screen's,
    /// whatever the shape.
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
