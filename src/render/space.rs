//! Render space: the floating origin and the unit of a view's coordinates.
//!
//! While f32 is fine enough, origin and unit are the scene's own. In deeper views the origin is an anchor, on
//! the surface where one is near, and the unit the distance from the eye to the anchor.

use std::sync::Arc;

use glam::DVec3;

use super::Region;
use crate::{
    formula::{ReferenceOrbit, march::COARSEST_FOOTPRINT},
    fractal::{FractalModel, Search, pixel_cone, search::nearest_depth},
    scene::{PrecisePoint, Scene},
};

/// Origin and unit of a view's coordinates, and the fractal that is drawn in them.
#[derive(Clone, Debug)]
pub struct RenderSpace {
    model: FractalModel,
    anchored: Option<Anchored>,
}

#[derive(Clone, Debug)]
struct Anchored {
    reference: Arc<dyn ReferenceOrbit>,
    scale: f64,
}

impl RenderSpace {
    /// The render space with the scene's own origin and unit.
    pub fn plain(model: &FractalModel) -> Self {
        Self { model: model.clone(), anchored: None }
    }

    /// The render space about the anchor of `reference`, for `scene`'s camera.
    pub fn about(model: &FractalModel, reference: Arc<dyn ReferenceOrbit>, scene: &Scene) -> Self {
        let way = (&scene.camera.position - reference.anchor()).length();
        // An eye inside the set is its own anchor; the view unit then sets the scale.
        let scale = if way > 0.0 { way } else { scene.camera.view_unit() };
        Self { model: model.clone(), anchored: Some(Anchored { reference, scale }) }
    }

    /// The render space that `scene` needs in `region`.
    ///
    /// Searches for an anchor if one is needed, which takes some milliseconds.
    pub fn of(scene: &Scene, region: Region) -> Self {
        Self::of_model(&FractalModel::new(&scene.fractal), scene, region)
    }

    /// [`Self::of`] with the scene's prepared fractal.
    pub fn of_model(model: &FractalModel, scene: &Scene, region: Region) -> Self {
        let search = wants_anchor(model, scene, region)
            .then(|| Search::new(&scene.fractal, &scene.camera, region.aspect(), None))
            .flatten();
        match search {
            Some(search) => Self::about(model, search.finish(), scene),
            None => Self::plain(model),
        }
    }

    /// The fractal.
    pub fn model(&self) -> &FractalModel {
        &self.model
    }

    /// The anchor's reference orbit; none in plain views.
    pub fn reference(&self) -> Option<&Arc<dyn ReferenceOrbit>> {
        Some(&self.anchored.as_ref()?.reference)
    }

    /// Scene units per unit of render space.
    pub fn scale(&self) -> f64 {
        self.anchored.as_ref().map_or(1.0, |anchored| anchored.scale)
    }

    /// A point of the scene in render space.
    pub fn point(&self, point: &PrecisePoint) -> DVec3 {
        match &self.anchored {
            None => point.to_dvec3(),
            Some(Anchored { reference, scale }) => (point - reference.anchor()) / *scale,
        }
    }

    /// The distance from the eye to the nearest surface, in render space.
    pub fn nearest(&self, scene: &Scene) -> f64 {
        match &self.anchored {
            None => self.model.clear_distance(&scene.camera.position),
            Some(Anchored { reference, scale }) => {
                let field = self.model.about(reference);
                field.clear_distance(&scene.camera.position - reference.anchor()) / scale
            }
        }
    }

    /// The radius of a pixel's cone at the surface nearest the eye, in scene units, by the estimate at the eye.
    ///
    /// The estimate may be several times too large; [`plain_footprint`] marches rays too.
    pub fn footprint(&self, scene: &Scene, region: Region) -> f64 {
        self.nearest(scene) * self.scale() * cone(scene, region)
    }

    /// The radius of a pixel's cone at the camera's pivot, in scene units.
    ///
    /// Where no surface is as near as the pivot, the set of too few iterations may be: it is thicker where orbits are slow.
    pub fn footprint_at_pivot(&self, scene: &Scene, region: Region) -> f64 {
        scene.camera.view_unit() * cone(scene, region)
    }
}

/// Whether pixels are too fine for plain f32, and an anchor can help.
pub fn wants_anchor(model: &FractalModel, scene: &Scene, region: Region) -> bool {
    plain_footprint(model, scene, region).is_some_and(|footprint| footprint < COARSEST_FOOTPRINT)
}

/// Largest overestimate of the distance at the eye that rays correct: a footprint of up to so many times
/// [`COARSEST_FOOTPRINT`] by that estimate is checked by rays, whose safe steps are shorter than estimates.
const MAX_OVERESTIMATE: f64 = 30.0;

/// The footprint of a pixel at the nearest surface, in scene units, in f64 about the scene's origin.
///
/// None for fractals without depth, which never have an anchor. f64 is too coarse to draw most views that want an
/// anchor, but fine enough to detect them.
pub fn plain_footprint(model: &FractalModel, scene: &Scene, region: Region) -> Option<f64> {
    if !model.has_depth() {
        return None;
    }
    let cone = cone(scene, region);
    let by_estimate = model.clear_distance(&scene.camera.position) * cone;
    if !(COARSEST_FOOTPRINT..MAX_OVERESTIMATE * COARSEST_FOOTPRINT).contains(&by_estimate) {
        return Some(by_estimate);
    }
    let (field, camera) = (&**model.whole(), &scene.camera);
    Some(cone * nearest_depth(field, camera, region.aspect(), cone, by_estimate / cone))
}

fn cone(scene: &Scene, region: Region) -> f64 {
    pixel_cone(&scene.camera, region.aspect(), f64::from(region.picture_px[1]))
}
