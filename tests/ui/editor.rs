//! The formula editor: what is typed is drawn, what is wrong is told, what is kept stays.

use egui::{Key, Modifiers, Pos2, Rect, accesskit::Role};
use egui_kittest::{Harness, kittest::Queryable as _};
use mandelight::{
    formula::{self, Fractal},
    scene::{Scene, presets},
    ui::Settings,
};

use crate::stage::*;

/// A page with the editor open on a formula.
fn editing(id: &str) -> Harness<'static, Stage> {
    editing_in(id, [1280.0, 3000.0])
}

/// The same in a window of this size.
fn editing_in(id: &str, size: [f32; 2]) -> Harness<'static, Stage> {
    let fractal = Fractal::new(formula::find(id).expect("a formula"));
    let scene = Scene { fractal, ..Scene::default() };
    let mut harness = stage(scene, unfolded(), size);
    // The button may be out of sight.
    button(&harness, "Edit the formula…").click_accesskit();
    harness.run();
    harness
}

/// Replaces the editor's text by `text`, and waits until it is read.
fn type_whole(harness: &mut Harness<'_, Stage>, text: &str) {
    let field = harness.get_by_role_and_label(Role::MultilineTextInput, "Formula text");
    field.focus();
    harness.run();
    harness.key_press_modifiers(Modifiers::COMMAND, Key::A);
    harness.run();
    harness.event(egui::Event::Text(text.to_owned()));
    harness.run_steps(40);
}

/// Types words into the open list's search field.
fn search(harness: &mut Harness<'_, Stage>, words: &str) {
    harness.get_by_label("Search formulas").focus();
    harness.run();
    harness.event(egui::Event::Text(words.to_owned()));
    harness.run();
}

fn text_of(harness: &Harness<'_, Stage>) -> String {
    let field = harness.get_by_role_and_label(Role::MultilineTextInput, "Formula text");
    field.value().unwrap_or_default()
}

const TEXT: &str = "name \"Typed\";\nparam scale = 2 from -3 to 3 label \"Scale\";\n\
                    step { z = scale * box_fold(z, 1) * sphere_fold_scale(z, 0.5, 1) + c; }\n\
                    bailout 100;\nestimate linear;\nbound 12;\n";

#[test]
fn a_typed_formula_is_drawn_with_the_values_that_stay() {
    let mut harness = editing("mandelbox");
    assert!(text_of(&harness).contains("name \"Mandelbox\""));
    slider(&harness, "Scale").set_value_accesskit(-1.5);
    harness.run();
    type_whole(&mut harness, TEXT);
    let drawn = &scene(&harness).fractal;
    assert_eq!(drawn.formula().text(), Some(TEXT));
    assert_eq!(drawn.number("scale"), Some(-1.5));
    // One more parameter, and one more slider.
    let more =
        TEXT.replace("step {", "param twist = 10 from 0 to 90 degrees label \"Twist\";\nstep {");
    type_whole(&mut harness, &more);
    assert!(harness.query_by_role_and_label(Role::Slider, "Twist").is_some());
    assert_eq!(scene(&harness).fractal.number("scale"), Some(-1.5));
    // The text of what an undo brings back. The text field has its own undo while it has the focus.
    harness.key_press(Key::Escape);
    harness.run();
    undo_all(&mut harness);
    harness.run();
    assert!(text_of(&harness).contains("name \"Mandelbox\""));
}

#[test]
fn a_wrong_text_keeps_the_picture_and_says_where_it_is_wrong() {
    let mut harness = editing("mandelbox");
    type_whole(&mut harness, TEXT);
    let before = scene(&harness).clone();
    type_whole(&mut harness, &TEXT.replace("+ c;", "+ ccc;"));
    assert_eq!(*scene(&harness), before);
    assert!(harness.query_by_label_contains("line 3, column").is_some());
    assert!(text_of(&harness).contains("ccc"), "the wrong text stays");
    type_whole(&mut harness, TEXT);
    assert!(harness.query_by_label_contains("line 3, column").is_none());
}

#[test]
fn tab_completes_the_word_at_the_cursor() {
    let mut harness = editing("mandelbox");
    type_whole(&mut harness, "name \"A\"; step { z = quaternion_p");
    harness.key_press(Key::Tab);
    harness.run_steps(3);
    assert!(text_of(&harness).ends_with("z = quaternion_product"), "{}", text_of(&harness));
}

#[test]
fn kept_formulas_are_listed_and_can_be_removed() {
    let mut harness = editing("mandelbox");
    type_whole(&mut harness, TEXT);
    press(&mut harness, "Keep in my formulas");
    assert_eq!(harness.state().interface.settings().formulas, [TEXT]);
    press(&mut harness, "Formula: Typed");
    assert!(harness.query_by_role_and_label(Role::Button, "Typed").is_some());
    press(&mut harness, "Remove from my formulas");
    assert!(harness.state().interface.settings().formulas.is_empty());
}

/// A link brings its formula as a text to read.
#[test]
fn the_text_of_a_linked_formula_can_be_read() {
    let formula = formula::own::of_text(TEXT).expect("a formula");
    let scene = Scene { fractal: Fractal::new(formula), ..Scene::default() };
    let mut harness = stage(scene, unfolded(), [1280.0, 3000.0]);
    press(&mut harness, "Edit the formula…");
    assert_eq!(text_of(&harness), TEXT);
}

#[test]
fn a_closed_editor_has_drawn_its_text() {
    let mut harness = editing("mandelbox");
    let field = harness.get_by_role_and_label(Role::MultilineTextInput, "Formula text");
    field.focus();
    harness.run();
    harness.key_press_modifiers(Modifiers::COMMAND, Key::A);
    harness.run();
    harness.event(egui::Event::Text(TEXT.to_owned()));
    harness.step();
    assert_eq!(text_of(&harness), TEXT);
    // The window takes its new size.
    harness.run_steps(4);
    press(&mut harness, "Close window");
    assert!(harness.query_by_label("Close window").is_none());
    assert_eq!(scene(&harness).fractal.formula().text(), Some(TEXT));
}

/// Its texts would be taller than the screen if they had no width.
#[test]
fn the_editor_stays_on_the_screen_however_small_it_is_made() {
    let fractal = Fractal::new(formula::find("mandelbox").expect("a formula"));
    let screen = [1280.0, 720.0];
    let settings = Settings { timeline_open: true, ..unfolded() };
    let mut harness = stage(Scene { fractal, ..Scene::default() }, settings, screen);
    harness.get_by_label("Edit the formula…").click_accesskit();
    harness.run();
    type_whole(&mut harness, "name \"A name that is not closed, and a long one at that;");
    let window = |harness: &Harness<'_, Stage>| {
        let close = harness.get_by_label("Close window").rect().center();
        let areas = harness.ctx.memory(|memory| {
            let layers = memory.areas().visible_layer_ids().into_iter();
            let windows = layers.filter(|layer| layer.order == egui::Order::Middle);
            windows.filter_map(|layer| memory.area_rect(layer.id)).collect::<Vec<_>>()
        });
        let mut around = areas.into_iter().filter(|rect| rect.contains(close));
        around.next_back().expect("the editor's window")
    };
    for _ in 0..3 {
        let rect = window(&harness);
        let width = rect.width();
        drag(&mut harness, rect.left_center(), rect.right_center(), 6);
        let rect = window(&harness);
        assert!(rect.width() <= width, "{rect:?}");
        drag(&mut harness, rect.center_bottom(), rect.center_top(), 6);
        let rect = window(&harness);
        let all = egui::Rect::from_min_size(egui::Pos2::ZERO, screen.into());
        assert!(all.contains_rect(rect), "{rect:?}");
    }
    // What has no room scrolls.
    let size = window(&harness).size();
    assert!(size.x < 400.0 && size.y < 200.0, "{size:?}");
}

/// The panel scrolls: within it, a list shows several rows at any height of the window.
#[test]
fn the_list_of_formulas_shows_several_rows_in_a_low_window() {
    let mut harness = stage(Scene::default(), unfolded(), [1280.0, 700.0]);
    harness.get_by_role_and_label(Role::Button, "Formula: Mandelbulb").scroll_to_me();
    harness.run();
    press(&mut harness, "Formula: Mandelbulb");
    let rows = ["Aexion", "Amazing Surf", "Benesi pine tree"]
        .map(|name| harness.get_by_role_and_label(Role::Button, name).rect());
    let height = rows[0].height();
    assert!(rows.windows(2).all(|pair| pair[1].top() >= pair[0].bottom()), "{rows:?}");
    assert!(rows[2].bottom() - rows[0].top() > 2.9 * height, "{rows:?}");
}

#[test]
fn a_card_brings_the_view_that_it_shows_and_leaves_light_and_colours() {
    let mut harness = stage(Scene::default(), unfolded(), [1280.0, 3000.0]);
    let before = scene(&harness).clone();
    press(&mut harness, "Formula: Mandelbulb");
    search(&mut harness, "inversions");
    press(&mut harness, "Kleinian");
    let preset = presets::all().find(|preset| preset.name == "Kleinian").expect("a scene");
    let expected = (preset.scene)();
    let scene = scene(&harness);
    assert_eq!(scene.fractal, expected.fractal);
    assert_eq!(scene.camera, expected.camera);
    assert_eq!((&scene.lights, &scene.surface), (&before.lights, &before.surface));
}

#[test]
fn kept_formulas_are_steps_of_hybrids_too() {
    let mut harness = editing("mandelbox");
    type_whole(&mut harness, TEXT);
    press(&mut harness, "Keep in my formulas");
    press(&mut harness, "Mix with another formula");
    search(&mut harness, "typed");
    press(&mut harness, "Typed");
    let hybrid = scene(&harness).fractal.hybrid().expect("a hybrid").clone();
    assert_eq!(hybrid.steps.len(), 2);
    assert!(hybrid.steps.iter().all(|step| step.formula().text() == Some(TEXT)));
}

/// In a low window, no room is left empty below the text.
#[test]
fn the_text_has_the_room_that_a_low_window_leaves() {
    let mut harness = without_motion(editing_in("quaternion_julia", [844.0, 390.0]));
    touch(&mut harness);
    harness.run();
    let functions = painted(&harness, "Functions")[0];
    let window = harness.state().interface.rects().get("formula window").expect("the window");
    let empty = window.bottom() - functions.bottom();
    assert!((0.0..40.0).contains(&empty), "{functions:?} in {window:?}");
}

/// A turned phone shows the whole editor in its other shape, and the first shape after it is turned back.
#[test]
fn the_window_of_a_turned_phone_is_as_wide_as_its_side() {
    let [upright, lying] = [[390.0, 844.0], [844.0, 390.0]];
    let mut harness = without_motion(editing_in("quaternion_julia", upright));
    touch(&mut harness);
    let mut shapes = Vec::new();
    for size in [upright, lying, upright] {
        harness.set_size(size.into());
        harness.run();
        let rect = |name: &str| harness.state().interface.rects().get(name).expect("a part");
        let window = rect("formula window");
        assert!(Rect::from_min_size(Pos2::ZERO, size.into()).contains_rect(window), "{window:?}");
        // In the upright shape, the sheet below the status line makes room for the window.
        let status = rect("status");
        assert!(size == upright || window.bottom() <= status.top(), "{window:?}, {status:?}");
        shapes.push(window.size());
    }
    assert!(shapes[1].x > upright[0], "{shapes:?}");
    assert_eq!(shapes[0], shapes[2]);
}
