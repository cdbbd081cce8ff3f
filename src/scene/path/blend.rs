//! The scene between two keys: every number of it, found by itself.
//!
//! In: up to four neighbouring keys' scenes. Out: a valid scene. It walks through the scenes'
//! JSON, so that a field added to the scene goes along without being named here. Numbers run in
//! the scale of their parameter's table row, directions along great circles, exact points as
//! [`Places`]; words, switches and lists of another length stay as the earlier key has them.

use std::sync::Arc;

use glam::{DQuat, DVec3};
use serde_json::{Map, Number, Value};

use super::{
    curve::{Line, Span},
    place::{Place, Places},
    rotation::{Directions, Rotations},
};
use crate::{
    formula::{
        Fractal,
        table::{Field, Value as FieldValue},
    },
    precise::PrecisePoint,
    scene::{
        camera::{CLOSE_VIEW_UNIT, Camera},
        description::Scene,
        light::MAX_LIGHTS,
        param::{self, Param, Scale},
    },
};

/// How fine the eye's position is kept, in view units: below a hundredth of a pixel of the
/// largest pictures.
const EYE_GRAIN: f64 = 1e-8;

/// In close views, points within so many view units of the pivot are near by.
const NEAR_BY: f64 = 1e3;
/// Numbers below this part of their parameter's step lie far below it.
const FAR_BELOW: f64 = 1e-3;

/// Something of the keys before, at the beginning, at the end and after; the second and third
/// are always there.
type Four<T> = [Option<T>; 4];

/// The scene at `span`'s place between the second and the third of `keys`.
pub fn scenes(keys: Four<Arc<Scene>>, span: &Span) -> Scene {
    let [_, Some(from), ..] = &keys else { return Scene::default() };
    let cameras = keys.each_ref().map(|key| key.as_ref().map(|scene| &scene.camera));
    // Every key of a scene's JSON is a string, which is all that could fail.
    let values = keys.each_ref().map(|key| serde_json::to_value(key.as_deref()?).ok());
    let places = cameras.map(|camera| camera.map(place));
    let walk = Walk { span, fractal: &from.fractal, places };
    let mut path = String::new();
    let blended = walk.value(&mut path, values.each_ref().map(Option::as_ref));
    let scene = blended.and_then(|value| serde_json::from_value::<Scene>(value).ok());
    let mut scene = scene.unwrap_or_else(|| (**from).clone());
    if let Some(Camera { position, pivot, orientation, .. }) = camera(cameras, span) {
        // Field of view and screen are numbers like any others.
        scene.camera = Camera { position, pivot, orientation, ..scene.camera };
    }
    settle(&mut scene, from);
    // Whatever rule a scene may get that holds at both keys and not between them.
    if scene.validate().is_err() { (**from).clone() } else { scene }
}

/// The camera: its pivot and view unit as a place, its turn, and where in its own frame the eye
/// lies as seen from the pivot, so that an orbit stays one.
fn camera(keys: Four<&Camera>, span: &Span) -> Option<Camera> {
    let places = keys.map(|key| key.map(place));
    let turns = keys.map(|key| key.map(Camera::rotation));
    let sides = keys.map(|key| {
        key.map(|camera| {
            let eye_from_pivot = &camera.position - &camera.pivot;
            camera.rotation().inverse() * eye_from_pivot.normalize_or(DVec3::Z)
        })
    });
    let place = span.point(&Places, places.each_ref().map(Option::as_ref))?;
    let turn: DQuat = span.point(&Rotations, turns.each_ref().map(Option::as_ref))?;
    let side = span.point(&Directions, sides.each_ref().map(Option::as_ref))?;
    let eye = place.point.moved_by(turn * side * place.unit, EYE_GRAIN * place.unit);
    Some(Camera {
        position: eye,
        pivot: place.point,
        orientation: turn.into(),
        ..Camera::default()
    })
}

fn place(camera: &Camera) -> Place {
    Place { point: camera.pivot.clone(), unit: camera.view_unit() }
}

/// Restores the rules that hold between fields.
fn settle(scene: &mut Scene, from: &Scene) {
    round_whole(scene.fractal.fields_mut());
    for step in scene.fractal.steps_mut() {
        round_whole(step.fields_mut());
    }
    scene.fractal.bailout = scene.fractal.bailout.min(scene.fractal.max_bailout());
    let surface = &mut scene.surface;
    for gradient in [&mut surface.gradient, &mut surface.second_layer.gradient] {
        let mut last = 0.0_f64;
        for stop in gradient {
            last = last.max(stop.position);
            stop.position = last;
        }
    }
    // Two full scenes may have too many lights between them: what only appears waits.
    let lights = &mut scene.lights;
    if lights.len() > MAX_LIGHTS {
        lights.rig.count = lights.rig.count.min(from.lights.rig.count);
    }
    while lights.len() > MAX_LIGHTS && lights.environment.len() > from.lights.environment.len() {
        lights.environment.pop();
    }
    while lights.len() > MAX_LIGHTS && lights.point.len() > from.lights.point.len() {
        lights.point.pop();
    }
}

/// Rounds the numbers that are whole at both keys.
fn round_whole<'a>(fields: impl Iterator<Item = (&'static Field, &'a mut FieldValue)>) {
    let is_whole = |field: &Field| field.param().is_some_and(|param| param.scale == Scale::Integer);
    for (_, value) in fields.filter(|(field, _)| is_whole(field)) {
        if let FieldValue::Number(number) = value {
            *number = number.round();
        }
    }
}

/// The formulas of a fractal, with those of a hybrid's steps.
fn formulas(fractal: &Value) -> impl Iterator<Item = Option<&Value>> {
    let steps = fractal.get("steps").and_then(Value::as_array).into_iter().flatten();
    [fractal].into_iter().chain(steps).map(|of| of.get("formula"))
}

/// A walk through four scenes' JSON at once.
struct Walk<'a> {
    span: &'a Span,
    /// The earlier key's, whose formula the numbers between have.
    fractal: &'a Fractal,
    /// Where the cameras look.
    places: Four<Place>,
}

impl Walk<'_> {
    /// The value at `path`; none where a key that must be there isn't.
    fn value(&self, path: &mut String, values: Four<&Value>) -> Option<Value> {
        let (from, to) = (values[1]?, values[2]?);
        // Nothing lies between two formulas: the earlier key's stays.
        if path == "fractal" && !formulas(from).eq(formulas(to)) {
            return Some(from.clone());
        }
        if from == to && values[0].is_none_or(|v| v == from) && values[3].is_none_or(|v| v == to) {
            return Some(from.clone());
        }
        Some(match (from, to) {
            (Value::Object(a), Value::Object(b)) if a.keys().eq(b.keys()) => {
                self.object(path, a, values)
            }
            (Value::Array(a), Value::Array(b)) => {
                self.array(path, a, b, values).unwrap_or_else(|| from.clone())
            }
            (Value::Number(_), Value::Number(_)) => {
                self.number(path, values).unwrap_or_else(|| from.clone())
            }
            _ => from.clone(),
        })
    }

    fn object(
        &self,
        path: &mut String,
        fields: &Map<String, Value>,
        values: Four<&Value>,
    ) -> Value {
        let blended = fields.iter().map(|(name, field)| {
            let here = path.len();
            if here > 0 {
                path.push('.');
            }
            path.push_str(name);
            let values = values.map(|value| value.and_then(|value| value.get(name)));
            let value = self.value(path, values).unwrap_or_else(|| field.clone());
            path.truncate(here);
            (name.clone(), value)
        });
        Value::Object(blended.collect())
    }

    fn array(
        &self,
        path: &mut String,
        a: &[Value],
        b: &[Value],
        values: Four<&Value>,
    ) -> Option<Value> {
        // The camera's own is made from places and turns.
        if path == "camera.position" || path == "camera.orientation" {
            return None;
        }
        if let Some(point) = self.exact_point(values) {
            return Some(point);
        }
        if path.ends_with("direction")
            && let Some(direction) = self.direction(values)
        {
            return Some(direction);
        }
        let here = path.len();
        path.push_str("[]");
        let items = (0..a.len().max(b.len())).map(|index| {
            let item = values.map(|list| list.and_then(|list| list.get(index)).cloned());
            let item = lit_on_both_sides(item)?;
            self.value(path, item.each_ref().map(Option::as_ref))
        });
        let items = items.collect::<Option<Vec<_>>>();
        path.truncate(here);
        items.map(Value::Array)
    }

    fn number(&self, path: &str, values: Four<&Value>) -> Option<Value> {
        let param = self.fractal.param(path).or_else(|| param::find(path));
        let numbers = values.map(|value| value.and_then(Value::as_f64));
        let line = Interpolation::of(param, numbers);
        let numbers = numbers.map(|value| value.map(|v| line.onto(v)));
        let at = self.span.point(&Line, numbers.each_ref().map(Option::as_ref))?;
        let is_whole = |value: Option<&Value>| value.is_some_and(|v| v.is_u64() || v.is_i64());
        // A curve keeps between its keys, so this only takes rounding back.
        let within = |value: f64| param.map_or(value, |param| value.clamp(param.min, param.max));
        let value = within(line.from(at));
        Some(if is_whole(values[1]) && is_whole(values[2]) {
            Value::from(value.round() as i64)
        } else {
            Value::Number(Number::from_f64(value)?)
        })
    }

    fn exact_point(&self, values: Four<&Value>) -> Option<Value> {
        let mut seen = self.places.iter();
        let places = values.map(|value| {
            let unit = seen.next()?.as_ref()?.unit;
            let point = exact_point(value?)?;
            Some(Place { point, unit })
        });
        let point = self.near_by(&places).or_else(|| {
            let place = self.span.point(&Places, places.each_ref().map(Option::as_ref))?;
            Some(place.point)
        })?;
        serde_json::to_value(point).ok()
    }

    /// A blended point that moves with a small view; none if a key has the point far away.
    ///
    /// The place as seen from the pivot, in view units, is blended by differences.
    fn near_by(&self, points: &Four<Place>) -> Option<PrecisePoint> {
        let mut is_close = false;
        let mut offsets = [None; 4];
        for (offset, (point, seen)) in offsets.iter_mut().zip(points.iter().zip(&self.places)) {
            let (Some(point), Some(seen)) = (point, seen) else { continue };
            let in_view = (&point.point - &seen.point) / seen.unit;
            if in_view.length() > NEAR_BY {
                return None;
            }
            is_close |= seen.unit < CLOSE_VIEW_UNIT;
            *offset = Some(in_view);
        }
        if !is_close {
            return None;
        }
        let along = |axis: usize| {
            let numbers = offsets.map(|offset| offset.map(|offset| offset[axis]));
            self.span.point(&Line, numbers.each_ref().map(Option::as_ref))
        };
        let offset = DVec3::new(along(0)?, along(1)?, along(2)?);
        let seen = self.span.point(&Places, self.places.each_ref().map(Option::as_ref))?;
        Some(seen.point.moved_by(offset * seen.unit, EYE_GRAIN * seen.unit))
    }

    fn direction(&self, values: Four<&Value>) -> Option<Value> {
        let vectors = values.map(|value| value.and_then(unit_vector));
        let vector = self.span.point(&Directions, vectors.each_ref().map(Option::as_ref))?;
        Some(vector.to_array().to_vec().into())
    }
}

/// Three decimal strings.
fn exact_point(value: &Value) -> Option<PrecisePoint> {
    if value.as_array()?.iter().all(Value::is_string) {
        serde_json::from_value(value.clone()).ok()
    } else {
        None
    }
}

fn unit_vector(value: &Value) -> Option<DVec3> {
    let vector: [f64; 3] = serde_json::from_value(value.clone()).ok()?;
    let vector = DVec3::from_array(vector);
    vector.is_normalized().then(|| vector.normalize())
}

/// A light that only one of two keys has, with a dark twin in the other.
///
/// None for anything else that only one of the keys has.
fn lit_on_both_sides(light: Four<Value>) -> Option<Four<Value>> {
    Some(match light {
        [_, Some(there), None, _] => [None, Some(there.clone()), Some(unlit(there)?), None],
        [_, None, Some(there), _] => [None, Some(unlit(there.clone())?), Some(there), None],
        both => both,
    })
}

/// The same light without any strength; none for what is no light.
fn unlit(mut light: Value) -> Option<Value> {
    light.get("intensity")?;
    light["intensity"] = 0.0.into();
    if light.get("solo").is_some() {
        light["solo"] = false.into();
    }
    Some(light)
}

/// How a number is interpolated along a path.
enum Interpolation {
    /// By equal steps.
    Even,
    /// By equal ratios.
    Ratios,
    /// By equal ratios from one step of the parameter on, by equal steps near zero.
    RatiosFrom(f64),
}

impl Interpolation {
    /// The interpolation of the parameter table. Where all numbers are above zero and some are far below the
    /// parameter's step, as the intensities of lights deep in the set are, it is by ratios: they
    /// follow the zoom.
    fn of(param: Option<&Param>, numbers: Four<f64>) -> Self {
        let Some(param) = param.filter(|param| param.scale == Scale::Logarithmic) else {
            return Self::Even;
        };
        let mut all = numbers.iter().flatten();
        let is_tiny = |v: &f64| *v < FAR_BELOW * param.step;
        if param.min > 0.0 || (all.clone().all(|v| *v > 0.0) && all.any(is_tiny)) {
            Self::Ratios
        } else {
            Self::RatiosFrom(param.step)
        }
    }

    /// Where a value lies on the line on which it goes at an even pace.
    fn onto(&self, value: f64) -> f64 {
        match self {
            Self::Even => value,
            Self::Ratios => value.ln(),
            Self::RatiosFrom(step) => (value / step).ln_1p(),
        }
    }

    /// The inverse of [`Self::onto`].
    fn from(&self, at: f64) -> f64 {
        match self {
            Self::Even => at,
            Self::Ratios => at.exp(),
            Self::RatiosFrom(step) => step * at.exp_m1(),
        }
    }
}
