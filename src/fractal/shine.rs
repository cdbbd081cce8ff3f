//! Where light has to come from to reach a place of the surface.

use glam::DVec3;

use super::spiral;
use crate::formula::{
    DistanceField,
    march::{Estimate, MarchPolicy, Ray},
};

/// Directions that are tried.
const DIRECTIONS: u32 = 96;
/// Steps of the ray along each.
const MAX_STEPS: u32 = 160;
/// Least cosine between light and normal: below it a place stays dark.
const LEAST_COSINE: f64 = 0.35;
/// Start of a ray above the surface, in footprints, as that of the renderer's shadow rays.
const RISE: f64 = 2.0;

/// A place of the surface, in the field's coordinates.
pub struct Place {
    /// The point.
    pub point: DVec3,
    /// Radius of a pixel there, in scene units.
    pub footprint: f64,
    /// Unit vector toward the eye.
    pub toward_eye: DVec3,
}

/// The unit vector toward a light that reaches `place`, the nearest one to `wanted` of those tried.
///
/// It makes an angle of at most 70 degrees with the normal. Where everything around is in the way, it is
/// the direction toward the eye, which sees the place.
pub fn toward_light(field: &dyn DistanceField, place: &Place, wanted: DVec3) -> DVec3 {
    let normal = field.normal(place.point, place.footprint);
    let normal = if normal.dot(place.toward_eye) < 0.0 { place.toward_eye } else { normal };
    let origin = place.point + normal * (RISE * place.footprint);
    let is_clear = |direction| is_clear(field, Ray { origin, direction }, place.footprint);
    let mut tried: Vec<DVec3> = spiral::directions(DIRECTIONS)
        .chain([wanted])
        .filter(|direction| direction.dot(normal) > LEAST_COSINE)
        .collect();
    tried.sort_by(|a, b| b.dot(wanted).total_cmp(&a.dot(wanted)));
    tried.into_iter().find(|&direction| is_clear(direction)).unwrap_or(place.toward_eye)
}

/// Whether nothing blocks a ray from near a place, by the renderer's rule for shadow rays.
fn is_clear(field: &dyn DistanceField, ray: Ray, footprint: f64) -> bool {
    let MarchPolicy { shadow_cone, shadow_margin, .. } = MarchPolicy::default();
    let [cone, margin] = [shadow_cone, shadow_margin].map(f64::from);
    let mut depth = 0.0;
    for _ in 0..MAX_STEPS {
        let point = ray.at(depth);
        let out = point - field.center();
        if out.length() > field.bounding_radius() && out.dot(ray.direction) > 0.0 {
            return true;
        }
        let Estimate { distance, step } = field.clear_estimate(point);
        if distance < (cone * depth).max(margin * footprint) {
            return false;
        }
        depth += step;
    }
    false
}
