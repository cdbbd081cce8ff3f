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
        deep::{has_depth, iterations_for},
        pixel_cone,
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
        let camera = &scene.camera;
        let cone = pixel_cone(camera, viewport.aspect, viewport.height_px);
        let plain = self.plain(&scene.fractal, camera.position.to_dvec3(), cone);
        let footprint = camera.view_unit() * cone;
        if has_depth(&scene.fractal) && footprint < FROM_ELSEWHERE * PLAIN_FOOTPRINT {
            let pivot = camera.pivot.clone();
            return Arc::new(Unknown { pivot, bounding_radius: plain.bounding_radius() });
        }
        plain
    }

    /// The field with the iterations that the view from `eye` is drawn with.
    fn plain(&mut self, fractal: &Fractal, eye: DVec3, cone: f64) -> Arc<Estimator> {
        let nearest = Estimator::new(fractal).clear_distance(eye);
        let iterations = iterations_for(fractal, (nearest * cone).max(PLAIN_FOOTPRINT));
        let drawn = Fractal { iterations, ..fractal.clone() };
        match &self.plain {
            Some((known, estimator)) if *known == drawn => estimator.clone(),
            _ => {
                let estimator = Arc::new(Estimator::new(&drawn));
                self.plain = Some((drawn, estimator.clone()));
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
    fn a_plain_field_has_the_iterations_that_its_view_is_drawn_with() {
        let fractal = Fractal { iterations: 6, ..Default::default() };
        let whole = Estimator::new(&fractal);
        let finer = iterations_for(&fractal, PLAIN_FOOTPRINT);
        let finer = Estimator::new(&Fractal { iterations: finer, ..fractal.clone() });
        let mut fields = Fields::default();
        let mut told = |eye: DVec3| {
            let camera = Camera::looking_at(eye, DVec3::ZERO, DVec3::Z);
            let scene = Scene { camera, fractal: fractal.clone(), ..Default::default() };
            fields.choose(&scene, VIEWPORT).distance(eye)
        };
        let far = DVec3::new(2.0, -2.0, 1.0);
        assert_eq!(told(far), whole.distance(far));
        // Where six steps take a point for one of the set that more tell from it.
        let near = (0..100_000)
            .map(|i| DVec3::new(0.5, -0.6, 0.4) * (1.5 - 1e-5 * f64::from(i)))
            .find(|&eye| whole.distance(eye) == 0.0 && finer.distance(eye) > 0.0)
            .expect("there is such a place");
        assert_eq!(told(near), finer.distance(near));
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
