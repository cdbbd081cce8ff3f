//! Variations of a scene: other shapes, colours, lights and views near to it.
//!
//! In: a scene, how far to go, what must stay, a seed. Out: a valid scene, the same from the same seed.

use glam::{DQuat, DVec3};

use super::{
    Camera, GradientStop, LightFrame, Scene,
    dice::Dice,
    gradient,
    param::{self, Param, Scale},
};
use crate::formula::table::{Kind, Value};

/// Greatest change of a number, as a part of its range.
const RANGE_PART: f64 = 0.15;
/// Greatest change of a number, as a part of itself, beside [`ZERO_PART`] of its range.
const OWN_PART: f64 = 0.4;
/// Part of the range by which a number near 0 changes at most.
const ZERO_PART: f64 = 0.04;
/// Greatest turn of a light or of the camera, in radians.
const MAX_TURN_RAD: f64 = 0.9;
/// Greatest shift of hues, in radians.
const MAX_HUE_RAD: f64 = 0.8;
/// Greatest change of the camera's distance, as a natural logarithm.
const MAX_ZOOM: f64 = 0.5;

/// What a variation leaves as it is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Locks {
    /// The fractal.
    pub shape: bool,
    /// The surface's colours.
    pub colors: bool,
    /// The lights and the background.
    pub light: bool,
    /// The camera.
    pub view: bool,
}

/// A part of a scene's variation: changes the scene by an amount from 0 to 1.
type Change = fn(&mut Scene, f64, &mut Dice);

/// A scene near to `scene`: `amount` 0 is the scene itself, 1 goes far.
///
/// What is locked does not change how the rest varies. A part whose variation would be invalid stays.
pub fn vary(scene: &Scene, amount: f64, locks: Locks, seed: u64) -> Scene {
    let amount = if amount.is_finite() { amount.clamp(0.0, 1.0) } else { 0.0 };
    let mut varied = scene.clone();
    if amount == 0.0 {
        return varied;
    }
    let mut seeds = Dice::new(seed);
    let parts: [(bool, Change); 4] =
        [(locks.shape, shape), (locks.colors, colors), (locks.light, light), (locks.view, view)];
    for (is_locked, change) in parts {
        let mut dice = Dice::new(seeds.bits());
        if is_locked {
            continue;
        }
        let before = varied.clone();
        change(&mut varied, amount, &mut dice);
        if varied.validate().is_err() {
            varied = before;
        }
    }
    varied
}

fn shape(scene: &mut Scene, amount: f64, dice: &mut Dice) {
    for (field, value) in scene.fractal.fields_mut() {
        match (field.kind, value) {
            (Kind::Number { param, .. }, Value::Number(number)) => {
                *number = near(*number, param, amount, dice);
            }
            (Kind::Vector { param, .. }, Value::Vector(numbers)) => {
                for number in numbers {
                    *number = near(*number, param, amount, dice);
                }
            }
            (Kind::Switch { .. }, Value::Switch(is_on)) => *is_on ^= dice.chance(0.15 * amount),
            (Kind::Choice { options, .. }, Value::Choice(word)) if dice.chance(0.15 * amount) => {
                *word = dice.pick(options).map_or(*word, |option| option.word);
            }
            _ => {}
        }
    }
    scene.fractal.bailout = scene.fractal.bailout.min(scene.fractal.max_bailout());
}

/// A number near `number`, with as few digits as a slider gives.
fn near(number: f64, param: &Param, amount: f64, dice: &mut Dice) -> f64 {
    let range = param.max - param.min;
    let most = (RANGE_PART * range).min(OWN_PART * number.abs() + ZERO_PART * range);
    let moved = number + amount * most * dice.signed();
    let rounded = match param.scale {
        Scale::Integer => moved.round(),
        Scale::Linear | Scale::Logarithmic => {
            // A tenth of a slider's step: fine, and short in documents.
            let grain = 10.0 / param.step;
            (moved * grain).round() / grain
        }
    };
    param.clamp(rounded)
}

fn colors(scene: &mut Scene, amount: f64, dice: &mut Dice) {
    let surface = &mut scene.surface;
    let is_replaced = dice.chance(0.8 * amount);
    let named: Vec<_> = gradient::library().collect();
    let chosen = dice.pick(&named);
    if let Some(chosen) = chosen.filter(|_| is_replaced) {
        surface.gradient.clone_from(&chosen.stops);
    }
    let hue = amount * MAX_HUE_RAD * dice.signed();
    for GradientStop { color, .. } in &mut surface.gradient {
        *color = turned_hue(*color, hue);
    }
    let coloring = &mut surface.coloring;
    coloring.offset = param::COLOR_OFFSET.clamp(coloring.offset + 0.5 * amount * dice.signed());
    let repeats = coloring.repeats * (0.7 * amount * dice.signed()).exp();
    coloring.repeats = param::COLOR_REPEATS.clamp((repeats * 100.0).round() / 100.0);
}

/// A colour with its hue turned about the axis of greys, and its luminance kept.
fn turned_hue(color: [f32; 3], angle_rad: f64) -> [f32; 3] {
    let luminance = |[r, g, b]: [f64; 3]| 0.2126 * r + 0.7152 * g + 0.0722 * b;
    let linear = color.map(f64::from);
    let turn = DQuat::from_axis_angle(DVec3::ONE.normalize(), angle_rad);
    let turned = (turn * DVec3::from_array(linear)).max(DVec3::ZERO).to_array();
    let scale = luminance(linear) / luminance(turned).max(1e-9);
    let brightest = turned.iter().copied().fold(1e-9, f64::max);
    turned.map(|channel| ((channel * scale.min(1.0 / brightest)) as f32).clamp(0.0, 1.0))
}

fn light(scene: &mut Scene, amount: f64, dice: &mut Dice) {
    let toward_eye = scene.camera.rotation() * DVec3::Z;
    for light in &mut scene.lights.environment {
        let axis = DVec3::new(dice.signed(), dice.signed(), dice.signed()).normalize_or(DVec3::Z);
        let turn = DQuat::from_axis_angle(axis, amount * MAX_TURN_RAD * dice.signed());
        let before = DVec3::from_array(light.direction);
        let mut after = turn * before;
        // A light in front of the surface stays there: no variation is dark for that.
        let front = if light.frame == LightFrame::View { DVec3::Z } else { toward_eye };
        let depth = after.dot(front);
        if before.dot(front) > 0.2 && depth < 0.2 {
            after += front * (0.2 - depth);
        }
        light.direction = after.normalize_or(before).to_array();
        light.color = turned_hue(light.color, 0.5 * amount * MAX_HUE_RAD * dice.signed());
    }
    let hue = amount * MAX_HUE_RAD * dice.signed();
    scene.background.top = turned_hue(scene.background.top, hue);
    scene.background.bottom = turned_hue(scene.background.bottom, hue);
}

fn view(scene: &mut Scene, amount: f64, dice: &mut Dice) {
    let camera = &scene.camera;
    let unit = camera.view_unit();
    let up = camera.rotation() * DVec3::Y;
    let right = camera.rotation() * DVec3::X;
    let turn = DQuat::from_axis_angle(up, amount * MAX_TURN_RAD * dice.signed())
        * DQuat::from_axis_angle(right, 0.5 * amount * MAX_TURN_RAD * dice.signed());
    let zoom = (amount * MAX_ZOOM * dice.signed()).exp();
    let offset = turn * (&camera.position - &camera.pivot) * zoom;
    let position = camera.pivot.moved_by(offset, 1e-4 * unit);
    let orientation = Camera::looking_at(offset, DVec3::ZERO, up).orientation;
    scene.camera = Camera { position, orientation, ..camera.clone() };
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::presets;

    const AMOUNTS: [f64; 3] = [0.1, 0.5, 1.0];

    #[test]
    fn every_variation_is_valid_and_the_same_again() {
        for (seed, preset) in (0..).zip(presets::all()) {
            let scene = (preset.scene)();
            assert_eq!(vary(&scene, 0.0, Locks::default(), seed), scene);
            for amount in AMOUNTS {
                let varied = vary(&scene, amount, Locks::default(), seed);
                assert_eq!(varied.validate(), Ok(()), "{} by {amount}", preset.name);
                assert_ne!(varied, scene, "{} by {amount}", preset.name);
                assert_eq!(varied, vary(&scene, amount, Locks::default(), seed));
            }
        }
    }

    #[test]
    fn what_is_locked_stays_and_the_rest_varies_as_without() {
        let scene = presets::opening();
        let all = Locks { shape: true, colors: true, light: true, view: true };
        assert_eq!(vary(&scene, 1.0, all, 3), scene);
        let free = vary(&scene, 1.0, Locks::default(), 3);
        let shape = vary(&scene, 1.0, Locks { shape: true, ..Locks::default() }, 3);
        assert_eq!(shape, Scene { fractal: scene.fractal.clone(), ..free.clone() });
        let view = vary(&scene, 1.0, Locks { view: true, ..Locks::default() }, 3);
        assert_eq!(view.camera, scene.camera);
        assert_eq!(view.fractal, free.fractal);
    }

    #[test]
    fn greater_amounts_change_more() {
        let scene = presets::opening();
        let power = scene.fractal.number("power").expect("a bulb");
        let [small, middle, great] = AMOUNTS.map(|amount| {
            let changes = (0..200).map(|seed| {
                let varied = vary(&scene, amount, Locks::default(), seed);
                (varied.fractal.number("power").expect("a bulb") - power).abs()
            });
            changes.sum::<f64>()
        });
        assert!(small < middle && middle < great, "{small}, {middle}, {great}");
    }

    #[test]
    fn turned_hues_keep_greys_and_luminance() {
        assert!(turned_hue([0.5; 3], 1.0).iter().all(|c| (c - 0.5).abs() < 1e-6));
        let luminance = |[r, g, b]: [f32; 3]| 0.2126 * r + 0.7152 * g + 0.0722 * b;
        let color = [0.2, 0.1, 0.05];
        assert!((luminance(turned_hue(color, 0.8)) - luminance(color)).abs() < 1e-4);
    }
}
