//! A fractal prepared once per edit: interface, navigation and renderer share its distance fields.

use std::{
    fmt,
    sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError},
};

use crate::{
    formula::{DistanceField, Fractal, ReferenceOrbit, march::DEEP_FOOTPRINT},
    scene::PrecisePoint,
};

/// A fractal with its distance fields. Clones share the fields.
#[derive(Clone)]
pub struct FractalModel(Arc<Prepared>);

struct Prepared {
    fractal: Fractal,
    /// The field with the scene's own iterations.
    whole: Arc<dyn DistanceField>,
    /// The same field with the iterations of the deepest views.
    deepest: OnceLock<Arc<dyn DistanceField>>,
    fields: Mutex<Fields>,
}

/// Fields that are made on first use.
#[derive(Default)]
struct Fields {
    /// The plain field made last, with its iterations.
    finer: Option<(u32, Arc<dyn DistanceField>)>,
    deep: Option<Deep>,
}

/// The newest reference orbit, and the field about its anchor.
#[derive(Clone)]
struct Deep {
    reference: Arc<dyn ReferenceOrbit>,
    field: Arc<dyn DistanceField>,
}

impl fmt::Debug for FractalModel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("FractalModel").field(&self.0.fractal).finish()
    }
}

impl FractalModel {
    /// Prepares `fractal`, which must be within its ranges. Takes up to a millisecond.
    pub fn new(fractal: &Fractal) -> Self {
        let whole = fractal.distance_field();
        let (deepest, fields) = (OnceLock::new(), Mutex::default());
        Self(Arc::new(Prepared { fractal: fractal.clone(), whole, deepest, fields }))
    }

    /// The fractal.
    pub fn fractal(&self) -> &Fractal {
        &self.0.fractal
    }

    /// The field about the scene's origin, with the scene's own iterations.
    pub fn whole(&self) -> &Arc<dyn DistanceField> {
        &self.0.whole
    }

    /// Radius about the scene's origin of a sphere that holds the set, in scene units.
    pub fn bounding_radius(&self) -> f64 {
        self.0.whole.bounding_radius()
    }

    /// Whether views finer than f32 allows can be drawn about an anchor.
    pub fn has_depth(&self) -> bool {
        self.0.fractal.formula().has_depth(&self.0.fractal)
    }

    /// Iterations of a view whose pixels have radius `footprint` at the nearest surface.
    ///
    /// `footprint` is in scene units.
    pub fn iterations_for(&self, footprint: f64) -> u32 {
        self.0.fractal.formula().iterations_for(&self.0.fractal, footprint)
    }

    /// The field about the scene's origin, with iterations for pixels of radius `footprint`.
    pub fn finer(&self, footprint: f64) -> Arc<dyn DistanceField> {
        let iterations = self.iterations_for(footprint);
        if iterations == self.0.fractal.iterations {
            return self.0.whole.clone();
        }
        let mut fields = self.fields();
        if let Some((known, field)) = &fields.finer
            && *known == iterations
        {
            return field.clone();
        }
        let field = self.with_iterations(iterations);
        fields.finer = Some((iterations, field.clone()));
        field
    }

    /// Stores the newest reference orbit, or none; an orbit of another fractal counts as none.
    pub fn set_reference(&self, reference: Option<&Arc<dyn ReferenceOrbit>>) {
        let reference = reference.filter(|reference| reference.is_of(&self.0.fractal));
        let mut fields = self.fields();
        let is_known = match (&fields.deep, reference) {
            (Some(deep), Some(new)) => Arc::ptr_eq(&deep.reference, new),
            (None, None) => true,
            _ => false,
        };
        if !is_known {
            fields.deep = reference.map(|reference| Deep {
                reference: reference.clone(),
                field: self.0.fractal.field_about(
                    reference.clone(),
                    DEEP_FOOTPRINT,
                    DEEP_FOOTPRINT,
                ),
            });
        }
    }

    /// The field about the newest anchor, if any, for the deepest views.
    pub fn deep(&self) -> Option<Arc<dyn DistanceField>> {
        Some(self.fields().deep.as_ref()?.field.clone())
    }

    /// The field about the anchor of `reference`, for the deepest views.
    pub fn about(&self, reference: &Arc<dyn ReferenceOrbit>) -> Arc<dyn DistanceField> {
        match &self.fields().deep {
            Some(deep) if Arc::ptr_eq(&deep.reference, reference) => deep.field.clone(),
            _ => self.0.fractal.field_about(reference.clone(), DEEP_FOOTPRINT, DEEP_FOOTPRINT),
        }
    }

    /// The distance estimate at `point` in scene units, kept right outside the bounding sphere.
    ///
    /// An orbit that has not escaped within the scene's own iterations says nothing of the distance. With
    /// [depth](Self::has_depth), the orbit goes on.
    pub fn clear_distance(&self, point: &PrecisePoint) -> f64 {
        let field = if self.has_depth() { self.deepest() } else { self.whole() };
        field.clear_distance(point.to_dvec3())
    }

    /// The field about the scene's origin, with the iterations of the deepest views.
    fn deepest(&self) -> &Arc<dyn DistanceField> {
        self.0.deepest.get_or_init(|| self.with_iterations(self.iterations_for(DEEP_FOOTPRINT)))
    }

    /// The field about the scene's origin, with so many iterations.
    fn with_iterations(&self, iterations: u32) -> Arc<dyn DistanceField> {
        self.0.fractal.with_iterations(iterations).distance_field()
    }

    fn fields(&self) -> MutexGuard<'_, Fields> {
        // Each write stores a whole entry, so the fields are valid even if a thread panicked with the lock.
        self.0.fields.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The model of the edited fractal. Clones share the model.
#[derive(Clone, Debug, Default)]
pub struct SharedModel(Arc<Mutex<Option<FractalModel>>>);

impl SharedModel {
    /// The model of `fractal`: the stored model if it matches, else a new one, which replaces it.
    pub fn of(&self, fractal: &Fractal) -> FractalModel {
        let mut model = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        match &*model {
            Some(known) if known.fractal() == fractal => known.clone(),
            _ => model.insert(FractalModel::new(fractal)).clone(),
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::formula::mandelbulb::{Mandelbulb, Sine};

    #[test]
    fn a_model_is_made_once_an_edit() {
        let (shared, fractal) = (SharedModel::default(), Fractal::default());
        let first = shared.of(&fractal);
        assert!(Arc::ptr_eq(&first.0, &shared.clone().of(&fractal).0));
        let edited = fractal.with_iterations(3);
        assert!(!Arc::ptr_eq(&first.0, &shared.of(&edited).0));
    }

    /// A Julia set of power 4, and a point whose orbit takes 58 steps to escape: with 16 steps it counts as inside.
    #[test]
    fn the_distance_is_that_of_an_orbit_which_escapes() {
        let set = Mandelbulb {
            power: 4.0,
            sine: Sine::Negative,
            julia: true,
            julia_constant: [0.4396951370975969, -0.3908801596996004, 0.5325636195343663],
            ..Mandelbulb::default()
        };
        let model = FractalModel::new(&set.into());
        let point =
            DVec3::new(0.208_283_617_952_339_5, 0.304_448_711_768_176_46, 0.303_879_543_963_897_1);
        assert_eq!(model.whole().clear_distance(point), 0.0);
        let distance = model.clear_distance(&point.into());
        assert!(distance > 0.0 && distance < 1e-12, "{distance}");
        // Orbits that escape sooner take no further steps.
        let far = DVec3::new(0.0, -2.0, 0.5);
        let (deepest, own) = (model.clear_distance(&far.into()), model.whole().clear_distance(far));
        assert!((deepest / own - 1.0).abs() < 1e-9, "{deepest} and {own}");
    }

    #[test]
    fn finer_fields_are_kept() {
        let model = FractalModel::new(&Fractal::default());
        assert!(Arc::ptr_eq(model.whole(), &model.finer(1.0)));
        assert!(Arc::ptr_eq(&model.finer(1e-6), &model.finer(1e-6)));
    }
}
