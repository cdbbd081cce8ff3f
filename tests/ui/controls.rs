//! Every control changes what it says it changes.

use egui::{Key, Modifiers, PointerButton};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use mandelight::{
    formula::{self, FormulaRef, Fractal, mandelbulb},
    render::report::Histogram,
    scene::{ColorSource, Scene, param, presets},
    ui::{Settings, SheetHeight},
};

use crate::stage::*;

#[test]
fn the_power_slider_changes_the_power_and_nothing_else() {
    let mut harness = workshop();
    slider(&harness, "Power").set_value_accesskit(5.0);
    harness.run();
    let mut expected = Scene::default();
    expected.fractal.set("power", 5.0);
    // The camera keeps the larger set framed, by its distance alone.
    let camera = scene(&harness).camera.clone();
    assert_eq!(camera.orientation, expected.camera.orientation);
    assert!(camera.view_unit() > expected.camera.view_unit());
    assert_eq!(*scene(&harness), Scene { camera, ..expected });
}

#[test]
fn dragging_the_rail_moves_the_value_and_a_double_click_resets_it() {
    let mut harness = workshop();
    let rail = slider(&harness, "Power").rect();
    drag(&mut harness, rail.center(), rail.center() + egui::vec2(rail.width() * 0.4, 0.0), 4);
    let dragged = power(&harness);
    assert!(dragged > 12.0 && dragged <= 16.0, "dragged to {dragged}");
    let at = rail.center();
    harness.event(egui::Event::PointerMoved(at));
    for pressed in [true, false, true, false] {
        pointer(&harness, at, PointerButton::Primary, pressed, Modifiers::NONE);
    }
    harness.run();
    assert_eq!(power(&harness), mandelbulb::POWER.default);
}

#[test]
fn every_slider_in_reach_of_the_scene_moves_its_value() {
    // Turning each rail to its ends changes the scene and keeps it valid: no dead control.
    let mut harness = workshop();
    press(&mut harness, "Form: Julia");
    harness.get_by_label("Auto exposure").click();
    harness.run();
    press(&mut harness, "Add point light");
    press(&mut harness, "Sky light: Sky");
    for param in param::of(FormulaRef::default()) {
        if param == &param::SCREEN_HEIGHT {
            press(&mut harness, "Stereo: Stacked");
        }
        if param == &param::ROUGHNESS {
            press(&mut harness, "Material: Physical");
        }
        if param == &param::MEAN_FREE_PATH {
            press(&mut harness, "Material: Cloud");
        }
        if param == &param::FOG_ANISOTROPY {
            harness.get_by_label("Ground fog").click();
            harness.run();
        }
        if param == &param::EXPOSURE {
            press(&mut harness, "Material: Physical");
        }
        if param == &param::BOUNCES {
            harness.get_by_label("Path tracing").click();
            harness.run();
        }
        if param == &param::FIREFLY_LIMIT {
            harness.get_by_label("Limit fireflies").click();
            harness.run();
        }
        if param == &param::INDIRECT_RADIUS {
            press(&mut harness, "Indirect light: Horizon");
        }
        let rails: Vec<_> = rails_of(&harness, param.path);
        for id in rails {
            let before = scene(&harness).clone();
            for value in [param.min, param.max] {
                let rail = harness.get_by(|node| {
                    node.author_id() == Some(param.path) && node.label() == Some(id.clone())
                });
                rail.set_value_accesskit(value);
                harness.run();
                assert_eq!(scene(&harness).validate(), Ok(()), "{} at {value}", param.path);
            }
            assert_ne!(*scene(&harness), before, "{} does nothing", param.path);
        }
    }
}

fn power(harness: &egui_kittest::Harness<'_, Stage>) -> f64 {
    scene(harness).fractal.number("power").expect("a Mandelbulb")
}

fn rails_of(harness: &egui_kittest::Harness<'_, Stage>, path: &str) -> Vec<String> {
    harness
        .query_all(
            egui_kittest::kittest::By::new().predicate(|node| node.author_id() == Some(path)),
        )
        .filter_map(|node| node.accesskit_node().label())
        .collect()
}

#[test]
fn every_parameter_of_every_formula_has_a_control() {
    for formula in formula::all() {
        let mut fractal = Fractal::new(formula);
        // Some formulas show more fields in another form.
        fractal.set("julia", true);
        let mut scene = Scene { fractal, ..Scene::default() };
        // Controls of layers and traps show where they have an effect.
        scene.surface.coloring.source = ColorSource::SphereTrap;
        scene.surface.second_layer.amount = 0.5;
        (scene.fog.density, scene.fog.height) = (0.5, Some(0.5));
        let mut harness = stage(scene, unfolded(), [1280.0, 6000.0]);
        for switch in ["Auto exposure", "Depth of field", "Path tracing", "Limit fireflies"] {
            harness.get_by_label(switch).click();
            harness.run();
        }
        press(&mut harness, "Add light");
        press(&mut harness, "Cut open");
        let mut missing: Vec<_> =
            param::of(formula).filter(|param| rails_of(&harness, param.path).is_empty()).collect();
        press(&mut harness, "Add point light");
        missing.retain(|param| rails_of(&harness, param.path).is_empty());
        let others = [
            "Sky light: Sky",
            "Sky light: Environment map",
            "Stereo: Stacked",
            "Indirect light: Horizon",
            "Material: Physical",
            "Material: Cloud",
        ];
        for other in others {
            press(&mut harness, other);
            missing.retain(|param| rails_of(&harness, param.path).is_empty());
        }
        assert!(missing.is_empty(), "no control of {formula:?} for {missing:#?}");
    }
}

#[test]
fn typed_values_are_clamped() {
    let mut harness = workshop();
    press(&mut harness, "Power value");
    harness.key_press_modifiers(Modifiers::COMMAND, Key::A);
    harness.get_by_label("Power value").type_text("99");
    harness.key_press(Key::Enter);
    harness.run();
    assert_eq!(power(&harness), mandelbulb::POWER.max);
    assert_eq!(undo_all(&mut harness), 1, "typing is one step");
}

#[test]
fn nonsense_typed_changes_nothing() {
    for text in ["nan", "inf", "-inf", "", "8 apples", "1e999"] {
        let mut harness = workshop();
        press(&mut harness, "Ambient value");
        harness.get_by_label("Ambient value").type_text(text);
        harness.key_press(Key::Enter);
        harness.run();
        assert_eq!(scene(&harness).validate(), Ok(()), "{text:?}");
    }
}

#[test]
fn arrow_keys_step_a_focused_slider_and_do_not_turn_the_view() {
    let mut harness = workshop();
    slider(&harness, "Power").focus();
    harness.run();
    for _ in 0..3 {
        harness.key_press(Key::ArrowRight);
    }
    harness.run();
    assert!((power(&harness) - 8.3).abs() < 1e-9);
    assert_eq!(scene(&harness).camera.orientation, Scene::default().camera.orientation);
    assert_eq!(undo_all(&mut harness), 1, "a run of presses is one step");
}

#[test]
fn lights_are_added_copied_muted_soloed_and_removed() {
    let mut harness = workshop();
    let start = Scene::default().lights.environment.len();
    press(&mut harness, "Add light");
    assert_eq!(scene(&harness).lights.environment.len(), start + 1);
    press(&mut harness, "Duplicate");
    let lights = &scene(&harness).lights.environment;
    assert_eq!(lights.len(), start + 2);
    assert_eq!(lights[start], lights[start + 1]);
    let name = format!("Light {}", start + 1);
    press(&mut harness, &format!("{name} off"));
    press(&mut harness, &format!("Only {name}"));
    let light = &scene(&harness).lights.environment[start];
    assert!(light.muted && light.solo);
    press(&mut harness, "Remove");
    assert_eq!(scene(&harness).lights.environment.len(), start + 1);
    press(&mut harness, "Add point light");
    press(&mut harness, "Duplicate");
    assert_eq!(scene(&harness).lights.point.len(), 2);
    press(&mut harness, "Remove");
    press(&mut harness, "Remove");
    assert!(scene(&harness).lights.point.is_empty());
    undo_all(&mut harness);
    assert_eq!(*scene(&harness), Scene::default());
}

#[test]
fn gradient_stops_are_added_and_removed() {
    let mut harness = workshop();
    let bar = button(&harness, "Gradient").rect();
    harness.hover_at(bar.center());
    let at = bar.left_center() + egui::vec2(bar.width() * 0.5, 0.0);
    for pressed in [true, false] {
        pointer(&harness, at, PointerButton::Primary, pressed, Modifiers::NONE);
    }
    harness.run();
    let count = Scene::default().surface.gradient.len();
    let stops = &scene(&harness).surface.gradient;
    assert_eq!(stops.len(), count + 1);
    assert!(stops.iter().any(|stop| (stop.position - 0.5).abs() < 0.01));
    // Without a pointer, in the widest gap.
    let widest =
        stops.windows(2).map(|pair| pair[1].position - pair[0].position).fold(0.0, f64::max);
    button(&harness, "Gradient").click_accesskit();
    harness.run();
    button(&harness, "Gradient").focus();
    harness.run();
    harness.key_press(Key::Enter);
    harness.run();
    let stops = &scene(&harness).surface.gradient;
    assert_eq!(stops.len(), count + 3);
    let gaps = stops.windows(2).map(|pair| pair[1].position - pair[0].position);
    assert!(gaps.clone().filter(|gap| (gap - widest / 2.0).abs() < 1e-9).count() >= 2);
    for _ in 0..count + 5 {
        let remove = button(&harness, "Remove stop");
        if !remove.accesskit_node().is_disabled() {
            remove.click();
        }
        harness.run();
    }
    assert_eq!(scene(&harness).surface.gradient.len(), 1, "the last stop stays");
}

#[test]
fn presets_open_and_keep_the_quality_that_was_chosen() {
    let mut harness = without_motion(workshop());
    slider(&harness, "Samples").set_value_accesskit(3.0);
    harness.run();
    for list in presets::lists() {
        press(&mut harness, list.name);
        for preset in list.presets {
            press(&mut harness, preset.name);
            let expected = (preset.scene)();
            assert_eq!(scene(&harness).fractal, expected.fractal, "{}", preset.name);
            assert_eq!(scene(&harness).lights, expected.lights, "{}", preset.name);
            assert_eq!(scene(&harness).quality.samples, 3);
            assert_eq!(scene(&harness).validate(), Ok(()), "{}", preset.name);
        }
    }
}

#[test]
fn every_control_has_a_hover_text() {
    let mut harness = workshop();
    press(&mut harness, "Form: Julia");
    harness.get_by_label("Auto exposure").click();
    harness.run();
    press(&mut harness, "Picture size: Custom");
    press(&mut harness, "Sky light: Sky");
    press(&mut harness, "Add point light");
    // The parts of a control share its text, so one look at each name is enough.
    let controls: std::collections::BTreeMap<_, _> = harness
        .root()
        .children_recursive()
        .filter(|node| egui::accessibility::is_input(node.accesskit_node().role()))
        .filter_map(|node| Some((node.accesskit_node().label()?, node.rect().center())))
        .collect();
    assert!(controls.len() > 60, "only {} controls found", controls.len());
    let mut silent = Vec::new();
    // A pointer at rest is enough: the usual wait of half a second is 30 frames a control.
    harness.ctx.all_styles_mut(|style| style.interaction.tooltip_delay = 0.0);
    for (label, at) in controls {
        harness.event(egui::Event::PointerGone);
        harness.run_steps(2);
        harness.hover_at(at);
        harness.run_steps(12);
        let layers = harness.ctx.memory(|memory| memory.areas().visible_layer_ids());
        if !layers.iter().any(|layer| layer.order == egui::Order::Tooltip) {
            silent.push(label);
        }
    }
    assert!(silent.is_empty(), "no hover text: {silent:#?}");
}

/// The histogram costs the renderer something, so it is asked for only where it can be seen.
#[test]
fn the_histogram_is_wanted_while_it_is_in_sight() {
    let mut folded = stage(Scene::default(), Settings::default(), [1280.0, 720.0]);
    folded.run();
    assert!(!folded.state().interface.wants_histogram());
    let mut harness = workshop();
    assert!(harness.state().interface.wants_histogram());
    harness.key_press(Key::P);
    harness.run();
    assert!(!harness.state().interface.wants_histogram(), "the panel is hidden");
    harness.key_press(Key::P);
    let mut bins = vec![0; 128];
    (bins[40], bins[60]) = (75, 25);
    harness.state_mut().report.histogram =
        Some(Histogram { bins: bins.into(), adapted_stops: 0.0 });
    harness.run();
    let area = harness.get_by_label("Histogram").rect();
    harness.hover_at(area.left_center() + egui::vec2(area.width() * 40.5 / 128.0, 0.0));
    harness.run_steps(40);
    harness.get_by_label_contains("75.0 % of the picture");
}

#[test]
fn settings_survive_as_json() {
    let settings = unfolded();
    let text = serde_json::to_string(&settings).expect("plain data");
    assert_eq!(
        serde_json::from_str::<mandelight::ui::Settings>(&text).expect("its own text"),
        settings
    );
    // What an older visit did not know takes its default.
    let sparse: mandelight::ui::Settings = serde_json::from_str("{}").expect("an empty object");
    assert_eq!(sparse, mandelight::ui::Settings::default());
}

#[test]
fn a_colour_is_picked_in_the_square_and_typed() {
    let mut harness = workshop();
    let before = scene(&harness).background.top;
    harness.get_by_label("Background top").click();
    harness.run();
    let square = slider(&harness, "Saturation and brightness").rect();
    drag(&mut harness, square.center(), square.right_top() + egui::vec2(-2.0, 2.0), 5);
    let bright = scene(&harness).background.top;
    assert!(bright.into_iter().fold(0.0, f32::max) > 0.9, "{before:?} became {bright:?}");
    harness.get_by_label("Colour value").click();
    harness.run();
    harness.key_press_modifiers(Modifiers::COMMAND, Key::A);
    harness.get_by_label("Colour value").type_text("#ff0000");
    harness.key_press(Key::Enter);
    harness.run();
    assert_eq!(scene(&harness).background.top, [1.0, 0.0, 0.0]);
    harness.key_press(Key::Escape);
    harness.run();
    assert!(harness.query_by_label("Hue").is_none(), "the picker closes");
    assert_eq!(undo_all(&mut harness), 2, "one step for the drag, one for the text");
    assert_eq!(*scene(&harness), Scene::default());
}

/// Where the hover text stands that contains `text`. (Its control has the same text as a description.)
fn hover_text(harness: &egui_kittest::Harness<'_, Stage>, text: &str) -> egui::Rect {
    let is_shown = |node: &egui_kittest::kittest::AccessKitNode<'_>| {
        node.role() == egui::accesskit::Role::Label
            && node.value().is_some_and(|value| value.contains(text))
    };
    let shown = egui_kittest::kittest::By::new().predicate(is_shown);
    harness.get(shown).rect()
}

/// The help of a slider stands beside the panel, or above the row: the next control stays in sight.
#[test]
fn hover_texts_leave_the_next_control_in_sight() {
    for size in [[1280.0, 720.0], [390.0, 844.0]] {
        let settings = Settings { sheet: SheetHeight::Half, ..Settings::default() };
        let mut harness = stage(Scene::default(), settings, size);
        let row = slider(&harness, "Power").rect();
        harness.event(egui::Event::PointerMoved(row.center()));
        harness.run_steps(90);
        let help = hover_text(&harness, "Double click resets");
        assert!(help.bottom() <= row.top() || help.right() <= row.left(), "{help:?} and {row:?}");
    }
}

/// So does the help of every other kind of control.
#[test]
fn the_help_of_buttons_and_choices_hides_no_control() {
    let mut harness = stage(Scene::default(), unfolded(), [1280.0, 6000.0]);
    harness.run();
    for (name, help) in [
        ("Dives", "Views at very deep zooms"),
        ("Add light", "Add parallel light"),
        ("Sky light: Sky", "Adds the light of a sky"),
    ] {
        let at = harness.get_by_label(name).rect().center();
        harness.event(egui::Event::PointerMoved(at));
        harness.run_steps(90);
        let shown = hover_text(&harness, help);
        let panel = harness.state().interface.rects().get("panel").expect("the panel");
        assert!(shown.right() <= panel.left() + 1.0, "{name}: {shown:?} over {panel:?}");
    }
}

/// A starting point of light replaces the lights as one step, and nothing else.
#[test]
fn light_setups_replace_the_lights_by_a_click() {
    let mut harness = stage(Scene::default(), Settings::default(), [1280.0, 2000.0]);
    press(&mut harness, "Looks: Lights");
    let mut seen = vec![Scene::default().lights];
    for name in ["Studio", "Rim", "Sky", "Candle"] {
        press(&mut harness, &format!("Light: {name}"));
        let lights = scene(&harness).lights.clone();
        assert!(!seen.contains(&lights), "{name}");
        assert_eq!(*scene(&harness), Scene { lights: lights.clone(), ..Scene::default() });
        seen.push(lights);
    }
    assert_eq!(undo_all(&mut harness), 4);
    assert_eq!(*scene(&harness), Scene::default());
}

/// Each section's reset is one step, leaves the other sections alone, and all together make a new scene.
#[test]
fn sections_are_reset_one_by_one() {
    // A bulb, a hybrid, and a scene in path-traced light.
    let presets = [&presets::opening_scenes()[0], &presets::mixes()[0], &presets::traced()[0]];
    for preset in presets {
        let start = (preset.scene)();
        let mut harness = stage(start.clone(), unfolded(), [1280.0, 6000.0]);
        harness.run_steps(3);
        let names: Vec<String> = harness
            .root()
            .children_recursive()
            .filter_map(|node| node.accesskit_node().label())
            .filter(|label| label.starts_with("Reset: "))
            .collect();
        assert_eq!(names.len(), 12, "{names:?}");
        for name in &names {
            let before = scene(&harness).clone();
            harness.get_by_label(name).click_accesskit();
            harness.run_steps(3);
            assert_eq!(scene(&harness).validate(), Ok(()), "{name} of {}", preset.name);
            harness.get_by_label(name).click_accesskit();
            harness.run_steps(3);
            let again = scene(&harness).clone();
            if again != before {
                harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
                harness.run_steps(3);
                assert_eq!(*scene(&harness), before, "{name} of {} is one step", preset.name);
                harness.key_press_modifiers(Modifiers::COMMAND | Modifiers::SHIFT, Key::Z);
                harness.run_steps(3);
            }
        }
        let reset = scene(&harness).clone();
        let new = Scene {
            fractal: reset.fractal.clone(),
            camera: reset.camera.clone(),
            ..Scene::default()
        };
        assert_eq!(reset, new, "{}", preset.name);
    }
}
