//! Section planes: each cuts away the half of space that its direction points to.

use std::sync::Arc;

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::{
    march::{DistanceField, Estimate, Ray},
    param,
    recurrence::OrbitPosition,
};
use crate::precise::PrecisePoint;

/// Most section planes of a fractal.
pub const MAX_SECTION_PLANES: usize = 3;

/// A plane that cuts the set open. Several planes leave the intersection of what each of them leaves.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct SectionPlane {
    /// A point of the plane.
    pub point: PrecisePoint,
    /// The plane's normal, a unit vector, toward the side that is cut away.
    pub direction: [f64; 3],
    /// Distance from the set within which the plane is drawn, range [`param::SECTION_BAND_REACH`].
    ///
    /// There it shows the bands of equal iterations around the slice. At 0 only the slice is drawn.
    pub band_reach: f64,
}

impl Default for SectionPlane {
    fn default() -> Self {
        Self {
            point: PrecisePoint::ORIGIN,
            direction: [0.0, 0.0, 1.0],
            band_reach: param::SECTION_BAND_REACH.default,
        }
    }
}

impl SectionPlane {
    /// The unit normal, toward the side that is cut away.
    pub fn normal(&self) -> DVec3 {
        DVec3::from_array(self.direction)
    }
}

/// The field of what section planes leave of the set of `field`.
pub fn cut(field: Arc<dyn DistanceField>, planes: &[SectionPlane]) -> Arc<dyn DistanceField> {
    if planes.is_empty() {
        return field;
    }
    let planes = planes.iter().map(|plane| Plane {
        normal: plane.normal(),
        offset: field.local(&plane.point).dot(plane.normal()),
        band_reach: plane.band_reach,
    });
    Arc::new(CutField { planes: planes.collect(), field })
}

/// A section plane in a field's coordinates.
struct Plane {
    normal: DVec3,
    /// Coordinate of the plane along its normal.
    offset: f64,
    band_reach: f64,
}

impl Plane {
    /// Height of `point` over the plane; what is above is cut away.
    fn height(&self, point: DVec3) -> f64 {
        self.normal.dot(point) - self.offset
    }
}

/// A field that section planes cut.
struct CutField {
    field: Arc<dyn DistanceField>,
    planes: Vec<Plane>,
}

impl CutField {
    /// The greatest height of `point` over a plane.
    fn height(&self, point: DVec3) -> f64 {
        self.planes.iter().map(|plane| plane.height(point)).fold(f64::NEG_INFINITY, f64::max)
    }

    /// The depth at which `ray` comes below all planes, and the band reach of the plane that it crosses there.
    ///
    /// None if it starts below all planes or never gets there.
    fn entry(&self, ray: Ray) -> Option<(f64, f64)> {
        let (mut entry, mut band_reach) = (0.0, 0.0);
        for plane in self.planes.iter().filter(|plane| plane.height(ray.origin) > 0.0) {
            let depth = plane.height(ray.origin) / -plane.normal.dot(ray.direction);
            // A ray along the plane or away from it.
            if !(0.0..f64::INFINITY).contains(&depth) {
                return None;
            }
            if depth > entry {
                (entry, band_reach) = (depth, plane.band_reach);
            }
        }
        // Up to rounding: the point lies on a plane.
        let offset = self.planes.iter().map(|plane| plane.offset.abs()).fold(0.0, f64::max);
        let is_left = self.height(ray.at(entry)) <= 1e-9 * entry + 1e-14 * offset;
        (entry > 0.0 && is_left).then_some((entry, band_reach))
    }
}

impl DistanceField for CutField {
    fn origin(&self) -> PrecisePoint {
        self.field.origin()
    }

    fn finest_footprint(&self) -> f64 {
        self.field.finest_footprint()
    }

    fn distance(&self, point: DVec3) -> f64 {
        self.field.distance(point).max(self.height(point))
    }

    fn is_inside(&self, point: DVec3) -> bool {
        self.height(point) <= 0.0 && self.field.is_inside(point)
    }

    fn estimate(&self, point: DVec3) -> Estimate {
        let (Estimate { distance, step }, height) =
            (self.field.estimate(point), self.height(point));
        Estimate { distance: distance.max(height), step: step.max(height) }
    }

    fn orbit(&self, point: DVec3, length: usize) -> Vec<OrbitPosition> {
        self.field.orbit(point, length)
    }

    fn center(&self) -> DVec3 {
        self.field.center()
    }

    fn bounding_radius(&self) -> f64 {
        self.field.bounding_radius()
    }

    fn needs_hit_check(&self) -> bool {
        self.field.needs_hit_check()
    }

    fn trace(
        &self,
        ray: Ray,
        cone: f64,
        max_depth: f64,
        max_steps: u32,
    ) -> Result<Option<f64>, f64> {
        if let Some((depth, band_reach)) = self.entry(ray)
            && depth <= max_depth
            && ray.at(depth).distance(self.center()) <= self.bounding_radius()
            && (self.field.is_inside(ray.at(depth))
                || self.field.distance(ray.at(depth)) <= band_reach.max(cone * depth))
        {
            return Ok(Some(depth));
        }
        super::march::trace(self, ray, cone, max_depth, max_steps)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formula::Fractal;

    fn down(x: f64, y: f64) -> Ray {
        Ray { origin: DVec3::new(x, y, 3.0), direction: DVec3::NEG_Z }
    }

    fn bulb(planes: &[SectionPlane]) -> Arc<dyn DistanceField> {
        let fractal = Fractal::default();
        cut(fractal.formula().distance_field(&fractal), planes)
    }

    #[test]
    fn rays_end_on_the_plane() {
        let field = bulb(&[SectionPlane { band_reach: 0.0, ..SectionPlane::default() }]);
        let depth = field.march(down(0.3, 0.2), 1e-3, 9.0).expect("a hit");
        assert!((depth - 3.0).abs() < 1e-9, "{depth}");
        assert!(field.normal(DVec3::new(0.3, 0.2, 0.0), 1e-4).angle_between(DVec3::Z) < 1e-6);
        // Outside of the slice, rays pass the plane.
        assert_eq!(field.march(down(1.0, 0.2), 1e-3, 9.0), None);
    }

    #[test]
    fn bands_widen_the_slice() {
        let field = bulb(&[SectionPlane { band_reach: 2.0, ..SectionPlane::default() }]);
        let depth = field.march(down(1.0, 0.2), 1e-3, 9.0).expect("a hit");
        assert!((depth - 3.0).abs() < 1e-9, "{depth}");
    }

    #[test]
    fn what_one_plane_leaves_another_cuts() {
        let toward_x = SectionPlane { direction: [1.0, 0.0, 0.0], ..SectionPlane::default() };
        let field = bulb(&[SectionPlane::default(), toward_x]);
        assert_eq!(field.march(down(0.3, 0.2), 1e-3, 9.0), None);
        let hit = field.march(down(-0.3, 0.2), 1e-3, 9.0);
        assert!(hit.is_some_and(|depth| (depth - 3.0).abs() < 1e-9));
    }
}
