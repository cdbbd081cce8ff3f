//! Nothing a hand or a file can do breaks the interface, or makes a scene invalid.

use egui::{Event, Key, Modifiers, PointerButton, pos2};
use mandelight::scene::{
    EnvironmentLight, GradientStop, MAX_GRADIENT_STOPS, MAX_LIGHTS, PointLight, Scene, dice, param,
};

use crate::stage::*;

/// A scene as full and as extreme as a document may be.
fn crowded() -> Scene {
    let mut scene = Scene::default();
    scene.fractal.set("power", 16.0);
    scene.fractal.bailout = scene.fractal.max_bailout();
    scene.fractal.set("julia", true);
    scene.lights.environment = vec![
        EnvironmentLight {
            intensity: param::ENVIRONMENT_INTENSITY.max,
            shadow_reach: Some(param::SHADOW_REACH.min),
            ..Default::default()
        };
        MAX_LIGHTS / 2
    ];
    scene.lights.point =
        vec![
            PointLight { intensity: param::POINT_INTENSITY.max, ..Default::default() };
            MAX_LIGHTS / 2
        ];
    scene.surface.gradient =
        vec![GradientStop { position: 0.5, color: [1.0, 0.0, 1.0] }; MAX_GRADIENT_STOPS];
    scene.camera.vertical_fov_deg = param::VERTICAL_FOV.max;
    scene
}

#[test]
fn a_crowded_scene_is_shown_and_takes_no_more_lights() {
    let scene_in = crowded();
    assert_eq!(scene_in.validate(), Ok(()), "the test's own scene");
    let mut harness = stage(scene_in.clone(), unfolded(), [1280.0, 4000.0]);
    for label in ["Add light", "Add point light", "Duplicate"] {
        press(&mut harness, label);
    }
    assert_eq!(scene(&harness).lights.len(), MAX_LIGHTS);
    assert_eq!(*scene(&harness), scene_in, "looking changes nothing");
}

#[test]
fn looking_at_every_preset_changes_nothing() {
    for preset in mandelight::scene::presets::all() {
        let mut harness = stage((preset.scene)(), unfolded(), [1280.0, 4000.0]);
        harness.run_steps(5);
        assert_eq!(*scene(&harness), (preset.scene)(), "{}", preset.name);
    }
}

/// Numbers as random as a test needs, the same every time.
struct Dice(dice::Dice);

impl Dice {
    fn below(&mut self, limit: u64) -> u64 {
        self.0.bits() % limit
    }

    fn part(&mut self) -> f32 {
        self.below(10_000) as f32 / 10_000.0
    }
}

/// One random event of a restless visitor.
fn event(dice: &mut Dice, size: [f32; 2], down: &mut bool) -> Event {
    let at = pos2(dice.part() * size[0], dice.part() * size[1]);
    let modifiers = [Modifiers::NONE, Modifiers::NONE, Modifiers::SHIFT, Modifiers::COMMAND]
        [dice.below(4) as usize];
    match dice.below(10) {
        0..4 => Event::PointerMoved(at),
        4..7 => {
            *down = !*down;
            let button = [PointerButton::Primary, PointerButton::Primary, PointerButton::Secondary]
                [dice.below(3) as usize];
            Event::PointerButton { pos: at, button, pressed: *down, modifiers }
        }
        7 => wheel(dice.part() * 400.0 - 200.0),
        8 => Event::Text(["9", "-", "1e9", "nan", ".5"][dice.below(5) as usize].to_owned()),
        _ => {
            let keys = [
                Key::Enter,
                Key::Escape,
                Key::Tab,
                Key::ArrowLeft,
                Key::ArrowUp,
                Key::F,
                Key::H,
                Key::A,
                Key::W,
                Key::S,
                Key::P,
                Key::Num2,
                Key::Z,
                Key::Y,
                Key::Questionmark,
                Key::Delete,
                Key::Plus,
                Key::Space,
                Key::PageDown,
                Key::T,
                Key::K,
                Key::U,
                Key::Comma,
                Key::Period,
            ];
            let key = keys[dice.below(keys.len() as u64) as usize];
            Event::Key {
                key,
                physical_key: None,
                pressed: dice.below(3) > 0,
                repeat: false,
                modifiers,
            }
        }
    }
}

#[test]
fn a_restless_visitor_cannot_break_it() {
    for (seed, size) in [(1, [1280.0, 720.0]), (2, [360.0, 640.0]), (3, [900.0, 1600.0])] {
        let mut dice = Dice(dice::Dice::new(seed));
        let start = if seed == 3 { crowded() } else { Scene::default() };
        let mut harness = stage(start, unfolded(), size);
        let mut down = false;
        for i in 0..400 {
            harness.event(event(&mut dice, size, &mut down));
            harness.step();
            assert_eq!(scene(&harness).validate(), Ok(()), "seed {seed}, event {i}");
            let path = &harness.state().interface.project().path;
            assert_eq!(path.validate(), Ok(()), "seed {seed}, event {i}");
        }
        // An open field takes the keys of undo for its own text.
        for _ in 0..3 {
            harness.key_press(Key::Escape);
            harness.run();
        }
        undo_all(&mut harness);
        assert_eq!(scene(&harness).validate(), Ok(()));
    }
}
