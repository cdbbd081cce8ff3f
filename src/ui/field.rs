//! Which distance field the camera moves in.
//!
//! In: the scene, the picture's shape, and the field about a deep place where the renderer has
//! one. Out: the field by which movements are measured. Nothing here knows how fields are made.

use std::{fmt, sync::Arc};

use glam::DVec3;

use super::navigation::Viewport;
use crate::{
    fractal::{
        DEEP_FOOTPRINT, DeepField, DistanceField, Estimator, PLAIN_FOOTPRINT, Reference,
        deep::has_depth, pixel_cone,
    },
    scene::{Fractal, PrecisePoint, Scene},
};

/// The part of [`PLAIN_FOOTPRINT`] below which no plain field brings a camera: such a view came
/// from elsewhere.
const FROM_ELSEWHERE: f64 = 0.1;

/// Finds the field, and keeps what takes time to make.
#[derive(Default)]
pub struct Fields {
    /// The field about the deep place in view, where there is one, and the set that it is of.
    deep: Option<(Fractal, Arc<DeepField>)>,
    plain: Option<(Fractal, Arc<Estimator>)>,
}

impl fmt::Debug for Fields {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Fields").field("plain", &self.plain).finish_non_exhaustive()
    }
}

impl Fields {
    /// Takes a deep place, where it is one of this set.
    pub fn set_reference(&mut self, reference: Option<&Arc<Reference>>, fractal: &Fractal) {
        let reference = reference.filter(|reference| reference.is_of(fractal));
        let is_known = |(known, deep): &(Fractal, Arc<DeepField>)| {
            known == fractal && reference.is_some_and(|new| Arc::ptr_eq(new, deep.reference()))
        };
        if !self.deep.as_ref().is_some_and(is_known) {
            self.deep = reference.map(|reference| {
                let field = DeepField::new(reference.clone(), fractal, DEEP_FOOTPRINT);
                (fractal.clone(), Arc::new(field))
            });
        }
    }

    /// The field for movements in `scene`: the deep one where there is one, otherwise the plain
    /// one. Where a view is deeper than that holds and the deep one is yet to come, the pivot
    /// stands for the surface: movements keep their scale.
    pub fn choose(&mut self, scene: &Scene, viewport: Viewport) -> Arc<dyn DistanceField> {
        if let Some((_, deep)) = &self.deep {
            return deep.clone();
        }
        let plain = self.plain(&scene.fractal);
        let camera = &scene.camera;
        let footprint =
            camera.view_unit() * pixel_cone(camera, viewport.aspect, viewport.height_px);
        if has_depth(&scene.fractal) && footprint < FROM_ELSEWHERE * PLAIN_FOOTPRINT {
            let pivot = camera.pivot.clone();
            return Arc::new(Unknown { pivot, bounding_radius: plain.bounding_radius() });
        }
        plain
    }

    fn plain(&mut self, fractal: &Fractal) -> Arc<Estimator> {
        match &self.plain {
            Some((known, estimator)) if known == fractal => estimator.clone(),
            _ => {
                let estimator = Arc::new(Estimator::new(fractal));
                self.plain = Some((fractal.clone(), estimator.clone()));
                estimator
            }
        }
    }
}

/// A surface of which only one point is known.
struct Unknown {
    pivot: PrecisePoint,
    bounding_radius: f64,
}

impl DistanceField for Unknown {
    fn origin(&self) -> PrecisePoint {
        self.pivot.clone()
    }

    fn center(&self) -> DVec3 {
        -self.pivot.to_dvec3()
    }

    fn finest_footprint(&self) -> f64 {
        DEEP_FOOTPRINT
    }

    fn distance(&self, point: DVec3) -> f64 {
        point.length()
    }

    fn bounding_radius(&self) -> f64 {
        self.bounding_radius
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use super::*;
    use crate::{
        scene::Camera,
        ui::navigation::{Navigator, World},
    };

    const VIEWPORT: Viewport = Viewport { aspect: 1.5, height_px: 800.0, detail: 1.0 };

    /// A scene that looks at a place deep in the set, as a link may open it.
    fn deep_scene(power: f64) -> Scene {
        let pivot = PrecisePoint::ORIGIN.moved_by(DVec3::new(0.7, -0.3, 0.4), 0.0);
        let camera = Camera {
            position: pivot.moved_by(DVec3::Z * 1e-20, 0.0),
            pivot,
            ..Camera::looking_at(DVec3::Z, DVec3::ZERO, DVec3::Y)
        };
        Scene { camera, fractal: Fractal { power, ..Default::default() }, ..Default::default() }
    }

    #[test]
    fn a_deep_view_keeps_its_scale_before_its_field_is_known() {
        let mut scene = deep_scene(8.0);
        let field = Fields::default().choose(&scene, VIEWPORT);
        let world = World { field: &*field, viewport: VIEWPORT };
        let mut navigator = Navigator::default();
        for (amount, wanted) in [(-1.0, 1_f64.exp() * 1e-20), (2.0, (-1_f64).exp() * 1e-20)] {
            navigator.dolly(&mut scene.camera, world, DVec2::ZERO, amount);
            let unit = scene.camera.view_unit();
            assert!((unit / wanted - 1.0).abs() < 0.01, "{unit:e} instead of {wanted:e}");
        }
    }

    #[test]
    fn views_that_plain_pictures_hold_for_have_the_plain_field() {
        let mut fields = Fields::default();
        let mut is_plain =
            |scene: &Scene| fields.choose(scene, VIEWPORT).finest_footprint() == PLAIN_FOOTPRINT;
        assert!(is_plain(&Scene::default()));
        assert!(!is_plain(&deep_scene(8.0)));
        // No pictures go that deep: movements keep to what they show.
        assert!(is_plain(&deep_scene(8.5)));
    }

    #[test]
    fn the_deep_field_comes_first() {
        let scene = deep_scene(8.0);
        let anchor = scene.camera.pivot.clone();
        let reference = Arc::new(Reference::new(&scene.fractal, anchor.clone()).expect("a power"));
        let mut fields = Fields::default();
        fields.set_reference(Some(&reference), &scene.fractal);
        assert_eq!(fields.choose(&scene, VIEWPORT).origin(), anchor);
        // It is of no other set.
        let other = deep_scene(7.0);
        fields.set_reference(Some(&reference), &other.fractal);
        assert!(fields.deep.is_none());
    }
}
