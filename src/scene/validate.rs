//! Whether a scene keeps to its ranges.
//!
//! In: any [`Scene`]. Out: nothing, or the first field at fault by its path in the document,
//! with what is wrong. The ranges themselves are [`param`]'s. Positions need no check here:
//! a [`Precise`](super::Precise) cannot hold a coordinate out of range.

use glam::{DVec3, DVec4};

use super::{
    camera::{Camera, MIN_VIEW_UNIT},
    description::Scene,
    environment_map::MAX_NAME_CHARS,
    fog::Fog,
    light::MAX_LIGHTS,
    lighting::Lights,
    medium::Medium,
    param::{self, Param},
    rig::{MAX_RIG_RADIANCE, RIG_DIRECTION_TOLERANCE, Rig, RigLight, Sky},
    surface::{Coloring, GradientStop, MAX_GRADIENT_STOPS, Surface},
};
use crate::formula::{
    Fractal, hybrid,
    param::SECTION_BAND_REACH,
    section::{MAX_SECTION_PLANES, SectionPlane},
    table::{Field, Kind, Value},
};

/// How far the length of a direction or orientation may be from 1.
pub(super) const UNIT_TOLERANCE: f64 = 1e-6;

/// A field whose value cannot be used.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{path}: {message}")]
pub struct Invalid {
    /// The field in the document: `lights.environment[2].intensity`.
    pub path: String,
    /// What is wrong: `1000 is outside 0 to 100`.
    pub message: String,
}

impl Invalid {
    fn new(path: impl Into<String>, message: impl Into<String>) -> Self {
        Self { path: path.into(), message: message.into() }
    }
}

impl Scene {
    /// Checks every field against its range.
    ///
    /// # Errors
    ///
    /// The first field at fault, in document order.
    pub fn validate(&self) -> Result<(), Invalid> {
        check_fractal(&self.fractal)?;
        check_camera(&self.camera)?;
        check_lights(&self.lights)?;
        check_surface(&self.surface)?;
        check_medium(&self.medium)?;
        check_fog(&self.fog)?;
        check_color(|| "background.top".into(), self.background.top)?;
        check_color(|| "background.bottom".into(), self.background.bottom)?;
        check(&param::EXPOSURE, self.tone.exposure)?;
        check(&param::KEY, self.tone.key)?;
        check(&param::WHITE_POINT, self.tone.white_point)?;
        check(&param::INDIRECT_RADIUS, self.indirect.radius)?;
        check(&param::INDIRECT_STRENGTH, self.indirect.strength)?;
        check(&param::INDIRECT_AMBIENT, self.indirect.ambient)?;
        check(&param::INDIRECT_DIRECTIONS, self.indirect.directions.into())?;
        check(&param::INDIRECT_SAMPLES, self.indirect.samples.into())?;
        check(&param::BOUNCES, self.integrator.bounces.into())?;
        if let Some(reach) = self.integrator.reach {
            check(&param::BOUNCE_REACH, reach)?;
        }
        check(&param::NOISE, self.integrator.noise)?;
        if let Some(limit) = self.integrator.firefly_limit {
            check(&param::FIREFLY_LIMIT, limit)?;
        }
        check(&param::BLOOM_STRENGTH, self.bloom.strength)?;
        check(&param::BLOOM_RADIUS, self.bloom.radius)?;
        check(&param::BLOOM_THRESHOLD, self.bloom.threshold)?;
        check(&param::BLOOM_PASSES, self.bloom.passes.into())?;
        check(&param::MOTION_BUDGET, self.quality.motion_budget_ms)?;
        check(&param::SAMPLES, self.quality.samples.into())?;
        check(&param::DETAIL, self.quality.detail)
    }
}

/// A number at a path without an index.
fn check(param: &Param, value: f64) -> Result<(), Invalid> {
    check_at(param, 0, value)
}

/// A number at `param`'s path, `index` in place of its `[]`.
fn check_at(param: &Param, index: usize, value: f64) -> Result<(), Invalid> {
    if param.accepts(value) {
        return Ok(());
    }
    let message = format!("{} is outside {}", shown(value), param.range_text());
    Err(Invalid::new(param.path_at(index), message))
}

/// A number as a person would write it: no row of 300 zeros.
fn shown(value: f64) -> String {
    let plain = value == 0.0 || (1e-5..1e9).contains(&value.abs());
    if plain { value.to_string() } else { format!("{value:e}") }
}

fn check_fractal(fractal: &Fractal) -> Result<(), Invalid> {
    check(&param::ITERATIONS, fractal.iterations.into())?;
    check(&param::BAILOUT, fractal.bailout)?;
    check_values(fractal.fields())?;
    check_section_planes(&fractal.section_planes)?;
    let steps = fractal.hybrid().map_or(&[][..], |hybrid| &hybrid.steps);
    for (i, step) in steps.iter().enumerate() {
        check_at(&hybrid::REPEATS, i, step.repeats.into())?;
        check_values(step.fields()).map_err(|error| Invalid {
            path: error.path.replacen("fractal.", &format!("fractal.steps[{i}]."), 1),
            ..error
        })?;
    }
    let most = fractal.max_bailout();
    if fractal.bailout > most {
        let value = shown(fractal.bailout);
        let message =
            format!("{value} is above {most:.2}, the most that {} allows", named(fractal));
        return Err(Invalid::new(param::BAILOUT.path, message));
    }
    Ok(())
}

fn check_section_planes(planes: &[SectionPlane]) -> Result<(), Invalid> {
    if planes.len() > MAX_SECTION_PLANES {
        let message =
            format!("{} are too many; a scene has at most {MAX_SECTION_PLANES}", planes.len());
        return Err(Invalid::new("fractal.section_planes", message));
    }
    for (i, plane) in planes.iter().enumerate() {
        let length = plane.normal().length();
        check_unit_length(|| format!("fractal.section_planes[{i}].direction"), length)?;
        check_at(&SECTION_BAND_REACH, i, plane.band_reach)?;
    }
    Ok(())
}

/// A formula's own values.
fn check_values<'a>(
    mut values: impl Iterator<Item = (&'static Field, &'a Value)>,
) -> Result<(), Invalid> {
    values.try_for_each(|(field, value)| match (field.kind, value) {
        (Kind::Number { param, .. }, Value::Number(number)) => check(param, *number),
        (Kind::Vector { param, .. }, Value::Vector(numbers)) => {
            (0..).zip(numbers).try_for_each(|(i, number)| check_at(param, i, *number))
        }
        // Whatever a switch or a choice can hold is allowed.
        _ => Ok(()),
    })
}

/// What the fractal's first field says of it: `power 8`.
fn named(fractal: &Fractal) -> String {
    match fractal.fields().next() {
        Some((field, Value::Number(number))) => format!("{} {number}", field.name),
        _ => fractal.formula().name().to_owned(),
    }
}

fn check_camera(camera: &Camera) -> Result<(), Invalid> {
    let distance = (&camera.pivot - &camera.position).length();
    if distance < MIN_VIEW_UNIT {
        let message = format!(
            "is {} from camera.position; it must be {MIN_VIEW_UNIT:e} or more away",
            shown(distance)
        );
        return Err(Invalid::new("camera.pivot", message));
    }
    let length = DVec4::from_array(camera.orientation.0).length();
    check_unit_length(|| "camera.orientation".into(), length)?;
    check(&param::VERTICAL_FOV, camera.vertical_fov_deg)?;
    check(&param::F_NUMBER, camera.lens.f_number)?;
    check(&param::FOCUS, camera.lens.focus)?;
    check(&param::BLADES, camera.lens.blades.into())?;
    check(&param::SCREEN_HEIGHT, camera.stereo.screen_height_cm)?;
    check(&param::EYE_DISTANCE, camera.stereo.eye_distance_cm)?;
    check(&param::EYE_SEPARATION, camera.stereo.eye_separation_cm)
}

fn check_lights(lights: &Lights) -> Result<(), Invalid> {
    if lights.len() > MAX_LIGHTS {
        let message = format!(
            "{} lights are too many; a scene has at most {MAX_LIGHTS} in all",
            lights.len()
        );
        return Err(Invalid::new("lights", message));
    }
    for (i, light) in lights.environment.iter().enumerate() {
        let length = DVec3::from_array(light.direction).length();
        check_unit_length(|| format!("lights.environment[{i}].direction"), length)?;
        check_color(|| format!("lights.environment[{i}].color"), light.color)?;
        check_at(&param::ENVIRONMENT_INTENSITY, i, light.intensity)?;
        check_at(&param::ENVIRONMENT_SIZE, i, light.size_deg)?;
        if let Some(reach) = light.shadow_reach {
            check_at(&param::SHADOW_REACH, i, reach)?;
        }
    }
    for (i, light) in lights.point.iter().enumerate() {
        check_color(|| format!("lights.point[{i}].color"), light.color)?;
        check_at(&param::POINT_INTENSITY, i, light.intensity)?;
        check_at(&param::POINT_RADIUS, i, light.radius)?;
    }
    check_rig(&lights.rig)
}

fn check_rig(rig: &Rig) -> Result<(), Invalid> {
    check(&param::RIG_COUNT, rig.count.into())?;
    check(&param::RIG_INTENSITY, rig.intensity)?;
    if let Some(reach) = rig.shadow_reach {
        check(&param::RIG_SHADOW_REACH, reach)?;
    }
    let Sky { sun_strength, sun_size_deg, sun_lights, .. } = rig.sky;
    let at = |field: &str| format!("lights.rig.sky.{field}");
    check_color(|| at("zenith"), rig.sky.zenith)?;
    check_color(|| at("horizon"), rig.sky.horizon)?;
    check_color(|| at("ground"), rig.sky.ground)?;
    let sun_length = DVec3::from_array(rig.sky.sun_direction).length();
    check_unit_length(|| at("sun_direction"), sun_length)?;
    check_color(|| at("sun_color"), rig.sky.sun_color)?;
    check(&param::SUN_STRENGTH, sun_strength)?;
    check(&param::SUN_SIZE, sun_size_deg)?;
    check(&param::SUN_LIGHTS, sun_lights.into())?;
    let map = &rig.environment_map;
    let characters = map.name.chars().count();
    if characters > MAX_NAME_CHARS {
        let message = format!("has {characters} characters; a name has at most {MAX_NAME_CHARS}");
        return Err(Invalid::new("lights.rig.picture.name", message));
    }
    check(&param::RIG_ROTATION, map.rotation_deg)?;
    if map.lights.len() > MAX_LIGHTS {
        let message = format!("{} are too many; a rig has at most {MAX_LIGHTS}", map.lights.len());
        return Err(Invalid::new("lights.rig.picture.lights", message));
    }
    (0..).zip(&map.lights).try_for_each(|(i, light)| check_rig_light(i, light))
}

fn check_rig_light(i: usize, light: &RigLight) -> Result<(), Invalid> {
    let at = |field: &str| format!("lights.rig.picture.lights[{i}].{field}");
    let length = DVec3::from_array(light.direction.map(f64::from)).length();
    check_length_within(|| at("direction"), length, RIG_DIRECTION_TOLERANCE)?;
    match light.strength.iter().position(|channel| !(0.0..=MAX_RIG_RADIANCE).contains(channel)) {
        None => Ok(()),
        Some(channel) => {
            let value = shown(light.strength[channel].into());
            let message = format!("{value} is outside 0 to {MAX_RIG_RADIANCE}");
            Err(Invalid::new(format!("{}[{channel}]", at("strength")), message))
        }
    }
}

fn check_surface(surface: &Surface) -> Result<(), Invalid> {
    check(&param::AMBIENT, surface.ambient)?;
    check(&param::DIFFUSE, surface.diffuse)?;
    check(&param::SPECULAR, surface.specular)?;
    check(&param::SHININESS, surface.shininess)?;
    check(&param::ROUGHNESS, surface.roughness)?;
    check(&param::METALNESS, surface.metalness)?;
    check_color(|| "surface.specular_color".into(), surface.specular_color)?;
    check(&param::COAT, surface.coat)?;
    check(&param::COAT_ROUGHNESS, surface.coat_roughness)?;
    check(&param::EMISSION, surface.emission)?;
    check_layer(&surface.coloring, &surface.gradient)?;
    let second = &surface.second_layer;
    check(&param::SECOND_LAYER_AMOUNT, second.amount)?;
    check(&param::SECTION_REPEATS, surface.sections.repeats)?;
    check_color(|| "surface.sections.inside".into(), surface.sections.inside)?;
    check_layer(&second.coloring, &second.gradient).map_err(|error| Invalid {
        path: error.path.replacen("surface.", "surface.second_layer.", 1),
        ..error
    })
}

fn check_medium(medium: &Medium) -> Result<(), Invalid> {
    check_color(|| "medium.color".into(), medium.color)?;
    check(&param::MEAN_FREE_PATH, medium.mean_free_path)?;
    check(&param::MEDIUM_ANISOTROPY, medium.anisotropy)?;
    check(&param::THIN_ITERATIONS, medium.thin_iterations)?;
    check(&param::DENSE_ITERATIONS, medium.dense_iterations)
}

fn check_fog(fog: &Fog) -> Result<(), Invalid> {
    check(&param::FOG_DENSITY, fog.density)?;
    check_color(|| "fog.color".into(), fog.color)?;
    check(&param::FOG_ANISOTROPY, fog.anisotropy)?;
    if let Some(height) = fog.height {
        check(&param::FOG_HEIGHT, height)?;
    }
    check(&param::FOG_LEVEL, fog.level)?;
    check(&param::FOG_RADIUS, fog.radius)
}

/// A layer of colours, with the paths of the first one.
fn check_layer(coloring: &Coloring, gradient: &[GradientStop]) -> Result<(), Invalid> {
    (0..).zip(coloring.center).try_for_each(|(i, x)| check_at(&param::TRAP_CENTER, i, x))?;
    check(&param::TRAP_SIZE, coloring.size)?;
    check(&param::COLOR_REPEATS, coloring.repeats)?;
    check(&param::COLOR_OFFSET, coloring.offset)?;
    let count = gradient.len();
    if !(1..=MAX_GRADIENT_STOPS).contains(&count) {
        let message = format!("has {count} stops; a gradient has 1 to {MAX_GRADIENT_STOPS}");
        return Err(Invalid::new("surface.gradient", message));
    }
    let mut before = 0.0;
    for (i, stop) in gradient.iter().enumerate() {
        check_at(&param::STOP_POSITION, i, stop.position)?;
        if stop.position < before {
            let message = format!(
                "{} lies before the stop ahead of it, at {}",
                shown(stop.position),
                shown(before)
            );
            return Err(Invalid::new(param::STOP_POSITION.path_at(i), message));
        }
        before = stop.position;
        check_color(|| format!("surface.gradient[{i}].color"), stop.color)?;
    }
    Ok(())
}

/// A linear colour: each channel 0 to 1.
fn check_color(path: impl Fn() -> String, color: [f32; 3]) -> Result<(), Invalid> {
    match color.iter().position(|channel| !(0.0..=1.0).contains(channel)) {
        None => Ok(()),
        Some(i) => {
            let message = format!("{} is outside 0 to 1", shown(color[i].into()));
            Err(Invalid::new(format!("{}[{i}]", path()), message))
        }
    }
}

/// The length of a direction or an orientation.
fn check_unit_length(path: impl Fn() -> String, length: f64) -> Result<(), Invalid> {
    check_length_within(path, length, UNIT_TOLERANCE)
}

fn check_length_within(
    path: impl Fn() -> String,
    length: f64,
    tolerance: f64,
) -> Result<(), Invalid> {
    if (length - 1.0).abs() <= tolerance {
        return Ok(());
    }
    Err(Invalid::new(path(), format!("has length {}; it must be 1", shown(length))))
}
