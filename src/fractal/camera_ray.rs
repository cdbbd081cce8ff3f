//! Camera rays through a picture's pixels.
//!
//! Conventions, shared with the kernels: the ray of pixel (x, y) passes through the pixel's centre
//! (x + 0.5, y + 0.5); normalised device coordinates run from −1 to 1, x right and y up;
//! depth is Euclidean distance along the unit ray. A pixel's cone has radius
//! `half_height / height_px` per unit of depth, half the pixel's width.

use glam::{DVec2, DVec3};

use crate::{
    formula::march::Ray,
    scene::{Camera, PrecisePoint},
};

/// The camera ray through `ndc`, in coordinates relative to `origin`.
///
/// `aspect` is the picture's width over its height; `origin` is a field's
/// [`DistanceField::origin`](crate::formula::DistanceField::origin).
pub fn camera_ray(camera: &Camera, origin: &PrecisePoint, ndc: DVec2, aspect: f64) -> Ray {
    let half_height = camera.half_height(aspect);
    let in_camera = DVec3::new(ndc.x * aspect * half_height, ndc.y * half_height, -1.0);
    Ray { origin: &camera.position - origin, direction: camera.rotation() * in_camera.normalize() }
}

/// Where `camera` sees the point at `offset` from the eye; none behind the eye.
///
/// `aspect` is the picture's width over its height.
pub fn ndc_of(camera: &Camera, offset: DVec3, aspect: f64) -> Option<DVec2> {
    let seen = camera.rotation().inverse() * offset;
    let scale = camera.half_height(aspect) * -seen.z;
    (seen.z < 0.0).then(|| DVec2::new(seen.x / (scale * aspect), seen.y / scale))
}

/// The radius of a pixel's cone per unit of depth.
///
/// `aspect` is the picture's width over its height, `height_px` its height in pixels.
pub fn pixel_cone(camera: &Camera, aspect: f64, height_px: f64) -> f64 {
    camera.half_height(aspect) / height_px.max(1.0)
}
