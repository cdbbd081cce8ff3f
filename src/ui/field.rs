//! Which distance field the camera moves in.
//!
//! In: the scene's prepared fractal, which may know an anchor, and the picture's shape. Out: the field
//! by which movements are measured. Nothing here knows how fields are made.

use std::sync::Arc;

use glam::DVec3;

use super::navigation::Viewport;
use crate::{
    formula::{
        DistanceField,
        march::{DEEP_FOOTPRINT, PLAIN_FOOTPRINT},
    },
    fractal::{FractalModel, pixel_cone},
    scene::{PrecisePoint, Scene},
};

/// The part of [`PLAIN_FOOTPRINT`] below which no plain field brings a camera: such a view came
/// from elsewhere.
const FROM_ELSEWHERE: f64 = 0.1;

/// The field for movements in `scene`, of which `model` is the fractal: the one about an anchor where
/// there is an anchor, otherwise the plain one with the iterations that the view is drawn with. Where a
/// view is deeper than the plain one holds and the anchor is yet to come, the pivot stands for the
/// surface: movements keep their scale.
pub fn field_of(model: &FractalModel, scene: &Scene, viewport: Viewport) -> Arc<dyn DistanceField> {
    if let Some(deep) = model.deep() {
        return deep;
    }
    let camera = &scene.camera;
    let cone = pixel_cone(camera, viewport.aspect, viewport.height_px);
    let nearest = model.clear_distance(&camera.position);
    let plain = model.finer((nearest * cone).max(PLAIN_FOOTPRINT));
    let footprint = camera.view_unit() * cone;
    if model.has_depth() && footprint < FROM_ELSEWHERE * PLAIN_FOOTPRINT {
        let pivot = camera.pivot.clone();
        return Arc::new(Unknown { pivot, bounding_radius: plain.bounding_radius() });
    }
    plain
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
        formula::mandelbulb::Mandelbulb,
        scene::{Camera, Fractal},
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
        let fractal = Mandelbulb { power, ..Default::default() }.into();
        Scene { camera, fractal, ..Default::default() }
    }

    #[test]
    fn a_deep_view_keeps_its_scale_before_its_field_is_known() {
        let mut scene = deep_scene(8.0);
        let field = field_of(&FractalModel::new(&scene.fractal), &scene, VIEWPORT);
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
        let is_plain = |scene: &Scene| {
            let model = FractalModel::new(&scene.fractal);
            field_of(&model, scene, VIEWPORT).finest_footprint() == PLAIN_FOOTPRINT
        };
        assert!(is_plain(&Scene::default()));
        assert!(!is_plain(&deep_scene(8.0)));
        // No pictures go that deep: movements keep to what they show.
        assert!(is_plain(&deep_scene(8.5)));
    }

    #[test]
    fn a_plain_field_has_the_iterations_that_its_view_is_drawn_with() {
        let fractal = Fractal::default().with_iterations(6);
        let model = FractalModel::new(&fractal);
        let (whole, finer) = (model.whole(), model.finer(PLAIN_FOOTPRINT));
        let told = |eye: DVec3| {
            let camera = Camera::looking_at(eye, DVec3::ZERO, DVec3::Z);
            let scene = Scene { camera, fractal: fractal.clone(), ..Default::default() };
            field_of(&model, &scene, VIEWPORT).distance(eye)
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
        let steps = scene.fractal.formula().begin_reference(&scene.fractal, anchor.clone());
        let reference = steps.expect("a whole power").finish();
        let model = FractalModel::new(&scene.fractal);
        model.set_reference(Some(&reference));
        assert_eq!(field_of(&model, &scene, VIEWPORT).origin(), anchor);
        // It is of no other set.
        let other = FractalModel::new(&deep_scene(7.0).fractal);
        other.set_reference(Some(&reference));
        assert!(other.deep().is_none());
    }
}
