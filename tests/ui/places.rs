//! Find places: the button, the search in slices, the pins, and the flight to one.

use egui::{Event, Key, PointerButton, Pos2, Rect, accesskit::Role};
use egui_kittest::{
    Harness, Node,
    kittest::{NodeT as _, Queryable as _},
};
use glam::{DQuat, DVec3};
use mandelight::{
    formula,
    formula::Fractal,
    scene::{Camera, PrecisePoint, Scene},
    ui::{SMALL_PICTURE_PX, Settings, SmallPicture, ViewTexture},
};

use crate::stage::*;

const WIDE: [f32; 2] = [1280.0, 720.0];
const PHONE: [f32; 2] = [390.0, 844.0];
/// Frames within which every search of these tests ends.
const MOST_FRAMES: u32 = 3000;

fn opening(size: [f32; 2]) -> Harness<'static, Stage> {
    let mut harness = stage(Scene::default(), Settings::default(), size);
    harness.run();
    harness
}

fn words(harness: &Harness<'_, Stage>) -> String {
    let about = |node: &Node<'_>| node.accesskit_node().label().unwrap_or_default();
    let nodes = harness.query_all_by_role(Role::Status);
    nodes.map(|node| about(&node)).find(|it| it.contains("place")).unwrap_or_default()
}

/// Runs frames until the search has ended.
fn found(harness: &mut Harness<'_, Stage>) {
    for _ in 0..MOST_FRAMES {
        harness.step();
        let words = words(harness);
        if !words.starts_with("Looking") {
            return;
        }
    }
    panic!("the search has not ended: {}", words(harness));
}

fn pins<'h>(harness: &'h Harness<'_, Stage>) -> Vec<Node<'h>> {
    harness.query_all_by_role(Role::Button).filter(|node| is_pin(node)).collect()
}

fn is_pin(node: &Node<'_>) -> bool {
    node.accesskit_node().label().is_some_and(|label| label.starts_with("Place "))
}

fn pin<'h>(harness: &'h Harness<'_, Stage>, number: usize) -> Node<'h> {
    let name = format!("Place {number}:");
    let pins = harness.query_all_by_role(Role::Button);
    pins.into_iter()
        .find(|node| node.accesskit_node().label().is_some_and(|it| it.starts_with(&name)))
        .expect("the pin is shown")
}

fn wanted(harness: &Harness<'_, Stage>) -> Vec<SmallPicture> {
    harness.state().interface.small_pictures().cloned().collect()
}

/// Where a point is in the window: a pinhole camera by its field of view.
fn projected(camera: &Camera, point: &PrecisePoint, view: Rect) -> Pos2 {
    let orientation = DQuat::from(camera.orientation);
    let offset = point - &camera.position;
    let [right, up, back] = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| orientation * axis);
    let depth = -offset.dot(back);
    // The angle spans the shorter side.
    let shorter = f64::from(view.width().min(view.height()));
    let focal = 0.5 * shorter / (0.5 * camera.vertical_fov_deg.to_radians()).tan();
    let x = focal * offset.dot(right) / depth;
    let y = focal * offset.dot(up) / depth;
    view.center() + egui::vec2(x as f32, -y as f32)
}

#[test]
fn the_button_searches_and_puts_the_pins_away() {
    for (size, most) in [(WIDE, 12), (PHONE, 6)] {
        let mut harness = opening(size);
        button(&harness, "Find places").click();
        harness.run_steps(3);
        assert!(words(&harness).starts_with("Looking for places: "), "{}", words(&harness));
        found(&mut harness);
        let count = pins(&harness).len();
        assert!((most / 2..=most).contains(&count), "{count} pins in {size:?}");
        assert_eq!(words(&harness), format!("{count} places. Choose one to fly there."));
        let view = harness.state().interface.rects().get("view").expect("the view");
        let buttons = harness.state().interface.rects().get("find places").expect("the button");
        let rects: Vec<_> = pins(&harness).iter().map(|node| node.rect()).collect();
        for (index, rect) in rects.iter().enumerate() {
            assert!(view.contains_rect(*rect), "{rect:?} in {size:?}");
            assert!(!rect.intersects(buttons), "{rect:?} covers the button");
            assert!(rect.width() >= 44.0 && rect.height() >= 44.0);
            for other in &rects[index + 1..] {
                assert!(!rect.intersects(*other), "{rect:?} covers {other:?} in {size:?}");
            }
        }
        assert_eq!(wanted(&harness).len(), count);
        for (index, node) in pins(&harness).iter().enumerate() {
            let name = node.accesskit_node().label().expect("a name");
            let is_named = ["repeating shapes", "small copy"]
                .iter()
                .any(|kind| name.starts_with(&format!("Place {}: {kind}, zoom ", index + 1)));
            assert!(is_named, "{name}");
        }
        press(&mut harness, "Hide places");
        assert!(pins(&harness).is_empty() && wanted(&harness).is_empty());
        assert_eq!(words(&harness), "");
        assert_eq!(*scene(&harness), Scene::default());
    }
}

#[test]
fn the_key_searches_and_escape_puts_the_pins_away() {
    let mut harness = opening(WIDE);
    harness.key_press(Key::N);
    harness.run_steps(3);
    assert!(words(&harness).starts_with("Looking"), "{}", words(&harness));
    harness.key_press(Key::Escape);
    harness.run();
    assert_eq!(words(&harness), "");
    harness.key_press(Key::N);
    found(&mut harness);
    assert!(!pins(&harness).is_empty());
    // A pin with the keyboard's focus keeps no key to itself.
    pin(&harness, 1).focus();
    harness.step();
    harness.key_press(Key::Escape);
    harness.run();
    harness.key_press(Key::Escape);
    harness.run();
    assert!(pins(&harness).is_empty());
}

#[test]
fn pictures_stand_beside_the_points_of_their_places() {
    let mut harness = opening(WIDE);
    harness.key_press(Key::N);
    found(&mut harness);
    let view = harness.state().interface.rects().get("view").expect("the view");
    // A little way around: pins stay with their places.
    for orbits in 0..3 {
        for (index, picture) in wanted(&harness).iter().enumerate() {
            let place = &picture.scene.camera.pivot;
            let at = projected(&scene(&harness).camera, place, view);
            let rect = pin(&harness, index + 1).rect();
            let gap = rect.distance_to_pos(at);
            assert!((4.0..200.0).contains(&gap), "{at} is {gap} points from {rect:?} ({orbits})");
        }
        harness.key_press(Key::ArrowRight);
        harness.run_steps(60);
    }
}

#[test]
fn the_point_of_a_pin_follows_its_place_to_the_pixel() {
    let mut harness = opening(WIDE);
    harness.key_press(Key::N);
    found(&mut harness);
    let view = harness.state().interface.rects().get("view").expect("the view");
    let dots = |harness: &Harness<'_, Stage>| -> Vec<Pos2> {
        let shapes = harness.output().shapes.iter();
        shapes
            .filter_map(|clipped| match &clipped.shape {
                egui::Shape::Circle(circle)
                    if circle.radius == 4.0 && circle.fill == egui::Color32::WHITE =>
                {
                    Some(circle.center)
                }
                _ => None,
            })
            .collect()
    };
    for _ in 0..2 {
        let dots = dots(&harness);
        let wanted = wanted(&harness);
        assert_eq!(dots.len(), wanted.len());
        for picture in &wanted {
            let at = projected(&scene(&harness).camera, &picture.scene.camera.pivot, view);
            let off = dots.iter().map(|dot| dot.distance(at)).fold(f32::INFINITY, f32::min);
            assert!(off < 0.05, "no point within {off} of {at}");
        }
        harness.key_press(Key::ArrowUp);
        harness.run_steps(60);
    }
}

#[test]
fn a_pin_shows_its_small_picture_once_it_is_drawn() {
    let mut harness = stage(Scene::default(), unfolded(), WIDE);
    harness.run();
    harness.key_press(Key::N);
    found(&mut harness);
    let wanted = wanted(&harness);
    let shown = |harness: &Harness<'_, Stage>| -> Vec<(egui::TextureId, Rect)> {
        let shapes = harness.output().shapes.iter();
        let with_texture = shapes.filter_map(|clipped| match &clipped.shape {
            egui::Shape::Rect(rect) => Some((rect.brush.as_ref()?.fill_texture_id, rect.rect)),
            _ => None,
        });
        with_texture.collect()
    };
    assert_eq!(shown(&harness), []);
    let drawn = |number: u64| ViewTexture {
        texture: egui::TextureId::User(number),
        size_px: SMALL_PICTURE_PX,
    };
    for (index, picture) in wanted.iter().enumerate().skip(1) {
        assert_eq!(picture.scene.quality.samples, 2);
        harness.state_mut().small_pictures.by_id.insert(picture.id, drawn(index as u64));
    }
    harness.step();
    let shown = shown(&harness);
    assert_eq!(shown.len(), wanted.len() - 1);
    for (texture, rect) in shown {
        let egui::TextureId::User(number) = texture else { panic!("{texture:?}") };
        assert!(pin(&harness, number as usize + 1).rect().center().distance(rect.center()) < 0.1);
    }
    // Another look is another picture.
    assert_eq!(self::wanted(&harness), wanted);
    slider(&harness, "Exposure").set_value_accesskit(1.5);
    harness.run_steps(4);
    let redrawn = self::wanted(&harness);
    assert_ne!(redrawn[0].id, wanted[0].id);
    assert_eq!(redrawn[0].scene.tone.exposure, 1.5);
    assert_eq!(redrawn[0].scene.camera, wanted[0].scene.camera);
}

#[test]
fn a_click_flies_to_the_place_as_one_step_of_the_history() {
    let mut harness = opening(WIDE);
    let home = scene(&harness).camera.clone();
    harness.key_press(Key::N);
    found(&mut harness);
    let to = wanted(&harness)[1].scene.camera.clone();
    let at = pin(&harness, 2).rect().center();
    harness.event(Event::PointerMoved(at));
    harness.step();
    pointer(&harness, at, PointerButton::Primary, true, egui::Modifiers::NONE);
    harness.step();
    pointer(&harness, at, PointerButton::Primary, false, egui::Modifiers::NONE);
    harness.run_steps(10);
    assert!(pins(&harness).is_empty(), "pins are put away on the way");
    let under_way = scene(&harness).camera.clone();
    assert!(under_way != home && under_way != to, "a flight, no jump");
    harness.run_steps(200);
    assert_eq!(scene(&harness).camera, to);
    assert_eq!(undo_all(&mut harness), 1);
    assert_eq!(scene(&harness).camera, home);
}

#[test]
fn a_pin_answers_the_keyboard_and_home_leads_back() {
    let mut harness = opening(WIDE);
    let home = scene(&harness).camera.clone();
    harness.key_press(Key::N);
    found(&mut harness);
    let to = wanted(&harness)[0].scene.camera.clone();
    pin(&harness, 1).focus();
    harness.step();
    harness.key_press(Key::Enter);
    harness.run_steps(200);
    assert_eq!(scene(&harness).camera, to);
    harness.key_press(Key::H);
    harness.run_steps(300);
    assert_eq!(scene(&harness).camera, home);
}

#[test]
fn a_new_view_cancels_the_search() {
    let mut harness = opening(WIDE);
    for new_view in [Key::Num3, Key::Num2] {
        button(&harness, "Find places").click();
        harness.run_steps(3);
        assert!(words(&harness).starts_with("Looking"));
        harness.key_press(new_view);
        harness.run_steps(3);
        assert_eq!(words(&harness), "");
        button(&harness, "Find places");
    }
}

#[test]
fn pins_vanish_once_the_view_has_moved_on() {
    let mut harness = opening(WIDE);
    for (key, presses) in [(Key::ArrowRight, 7), (Key::Plus, 6)] {
        harness.key_press(Key::A);
        harness.run_steps(200);
        harness.key_press(Key::N);
        found(&mut harness);
        let count = pins(&harness).len();
        assert!(count > 0);
        harness.key_press(key);
        harness.run_steps(60);
        assert!(!pins(&harness).is_empty(), "a step by {key:?} keeps pins");
        for _ in 1..presses {
            harness.key_press(key);
            harness.run_steps(60);
        }
        assert!(pins(&harness).is_empty(), "pins are left after {presses} steps by {key:?}");
        assert!(wanted(&harness).is_empty());
        button(&harness, "Find places");
    }
}

#[test]
fn the_search_waits_while_the_camera_moves() {
    let mut harness = opening(WIDE);
    let view = harness.state().interface.rects().get("view").expect("the view");
    harness.key_press(Key::N);
    harness.run_steps(3);
    let at = view.center();
    harness.event(Event::PointerMoved(at));
    harness.step();
    pointer(&harness, at, PointerButton::Primary, true, egui::Modifiers::NONE);
    harness.step();
    for i in 1..20 {
        harness.event(Event::PointerMoved(at + egui::vec2(2.0 * i as f32, 0.0)));
        harness.step();
        if i > 4 {
            assert_eq!(words(&harness), "Looking for places once the view stands still");
        }
    }
    pointer(&harness, at, PointerButton::Primary, false, egui::Modifiers::NONE);
    found(&mut harness);
    assert!(!pins(&harness).is_empty());
}

#[test]
fn a_view_without_places_says_so() {
    let quaternion = formula::all().find(|it| it.id() != "mandelbulb").expect("another formula");
    let scene_before = Scene { fractal: Fractal::new(quaternion), ..Scene::default() };
    let mut harness = stage(scene_before, Settings::default(), WIDE);
    harness.run();
    harness.key_press(Key::N);
    found(&mut harness);
    assert!(words(&harness).starts_with("No places in this view."), "{}", words(&harness));
    assert!(pins(&harness).is_empty());
    press(&mut harness, "Hide places");
    assert_eq!(words(&harness), "");
}

/// Captions, the row of buttons and the search's words each have a place of their own, and hints wait.
#[test]
fn the_words_of_a_dive_and_of_pins_cover_nothing() {
    for size in [WIDE, PHONE] {
        let mut harness = opening(size);
        let rect =
            |harness: &Harness<'_, Stage>, name: &str| harness.state().interface.rects().get(name);
        let shown = |harness: &Harness<'_, Stage>, name: &str| {
            rect(harness, name).unwrap_or_else(|| panic!("{name} is shown in {size:?}"))
        };
        assert!(rect(&harness, "hint").is_some());
        harness.key_press(Key::D);
        harness.run_steps(200);
        let [status, button] = ["dive status", "dive"].map(|name| shown(&harness, name));
        assert!(!status.intersects(button), "{status:?} covers {button:?}");
        assert_eq!(rect(&harness, "hint"), None, "in {size:?}");

        // What is left of the dive is the offer to keep it.
        harness.key_press(Key::D);
        harness.run_steps(4);
        harness.key_press(Key::N);
        harness.run_steps(4);
        harness.key_down(Key::C);
        harness.run_steps(4);
        let names = ["dive", "keep dive", "places words", "comparing"];
        let rects = names.map(|name| shown(&harness, name));
        for (index, a) in rects.iter().enumerate() {
            for (other, b) in rects.iter().enumerate().skip(index + 1) {
                assert!(!a.intersects(*b), "{} and {}: {a:?}, {b:?}", names[index], names[other]);
            }
        }
    }
}
