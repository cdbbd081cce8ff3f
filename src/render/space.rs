//! Render space: the floating origin and the unit of a view's coordinates.
//!
//! While f32 is fine enough they are the scene's own. Deeper, the origin is an anchor on the surface and
//! the unit the distance from the eye to the anchor.

use std::sync::Arc;

use glam::DVec3;

use super::Region;
use crate::{
    fractal::{
        DistanceField, Estimator, Reference,
        deep::{self, DeepField, Search},
        pixel_cone,
    },
    scene::{PrecisePoint, Scene},
};

/// Origin and unit of a view's coordinates.
#[derive(Clone, Debug, Default)]
pub struct RenderSpace {
    anchored: Option<Anchored>,
}

#[derive(Clone, Debug)]
struct Anchored {
    reference: Arc<Reference>,
    scale: f64,
}

impl RenderSpace {
    /// The scene's own origin and unit.
    pub fn plain() -> Self {
        Self::default()
    }

    /// The anchor of `reference`, for what `scene`'s camera sees.
    pub fn about(reference: Arc<Reference>, scene: &Scene) -> Self {
        let way = (&scene.camera.position - reference.anchor()).length();
        // An eye that is the anchor itself, for want of a surface, has its view for a unit.
        let scale = if way > 0.0 { way } else { scene.camera.view_unit() };
        Self { anchored: Some(Anchored { reference, scale }) }
    }

    /// The one that `scene` needs in `region`, searched for at once where that is an anchor: for
    /// some milliseconds.
    pub fn of(scene: &Scene, region: Region) -> Self {
        if !wants_anchor(scene, region) {
            return Self::plain();
        }
        match Search::new(&scene.fractal, &scene.camera, region.aspect(), None) {
            Some(search) => Self::about(search.finish(), scene),
            None => Self::plain(),
        }
    }

    /// The anchor's orbit, where there is an anchor.
    pub fn reference(&self) -> Option<&Arc<Reference>> {
        Some(&self.anchored.as_ref()?.reference)
    }

    /// Scene units of a length of one.
    pub fn scale(&self) -> f64 {
        self.anchored.as_ref().map_or(1.0, |anchored| anchored.scale)
    }

    /// A point of the scene in these coordinates.
    pub fn point(&self, point: &PrecisePoint) -> DVec3 {
        match &self.anchored {
            None => point.to_dvec3(),
            Some(Anchored { reference, scale }) => (point - reference.anchor()) / *scale,
        }
    }

    /// The distance from the eye to the nearest surface, in these units.
    pub fn nearest(&self, scene: &Scene) -> f64 {
        match &self.anchored {
            None => Estimator::new(&scene.fractal).clear_distance(scene.camera.position.to_dvec3()),
            Some(Anchored { reference, scale }) => {
                let field =
                    DeepField::new(reference.clone(), &scene.fractal, deep::FINEST_FOOTPRINT);
                field.clear_distance(&scene.camera.position - reference.anchor()) / scale
            }
        }
    }

    /// The radius of a pixel's cone at the surface that is nearest to the eye, scene units.
    pub fn footprint(&self, scene: &Scene, region: Region) -> f64 {
        self.nearest(scene) * self.scale() * cone(scene, region)
    }
}

/// Whether a scene's pixels in this region are too fine for coordinates about the scene's origin,
/// and an anchor helps.
pub fn wants_anchor(scene: &Scene, region: Region) -> bool {
    deep::has_depth(&scene.fractal) && plain_footprint(scene, region) < deep::COARSEST_FOOTPRINT
}

/// In f64 about the scene's origin: far too coarse for most views that want an anchor, and yet
/// enough to know them.
pub fn plain_footprint(scene: &Scene, region: Region) -> f64 {
    let eye = scene.camera.position.to_dvec3();
    Estimator::new(&scene.fractal).clear_distance(eye) * cone(scene, region)
}

fn cone(scene: &Scene, region: Region) -> f64 {
    pixel_cone(&scene.camera, region.aspect(), f64::from(region.picture_px[1]))
}
