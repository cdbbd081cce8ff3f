//! The timeline: keys are made, moved, changed and deleted there, and the view follows the playhead.

use egui::{Key, Rect, accesskit::Role, pos2, vec2};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use mandelight::{
    scene::{
        Camera, Path, Project, Scene,
        path::{Easing, Key as PathKey, MAX_KEYS},
    },
    ui::{Action, ExportProgress, MissingEncoders, SequenceFormat, Settings},
};

use crate::stage::*;

fn open() -> Settings {
    Settings { timeline_open: true, ..Settings::default() }
}

/// Keys at 0, 3 and 6 seconds, whose powers are 8, 5 and 3.
fn project() -> Project {
    let key = |time_secs: f64, power: f64, x: f64| {
        let mut scene = Scene::default();
        scene.fractal.set("power", power);
        scene.camera =
            Camera::looking_at(glam::DVec3::new(x, -2.5, 1.0), glam::DVec3::ZERO, glam::DVec3::Z);
        PathKey { time_secs, easing: Easing::Smooth, scene: scene.into() }
    };
    let mut project = Project::from(Scene::default());
    project.path.keys = vec![key(0.0, 8.0, 1.0), key(3.0, 5.0, 0.0), key(6.0, 3.0, -1.0)];
    project
}

fn path<'h>(harness: &'h egui_kittest::Harness<'_, Stage>) -> &'h Path {
    &harness.state().interface.project().path
}

fn times(harness: &egui_kittest::Harness<'_, Stage>) -> Vec<f64> {
    path(harness).keys.iter().map(|key| key.time_secs).collect()
}

fn track(harness: &egui_kittest::Harness<'_, Stage>) -> Rect {
    harness.state().interface.rects().get("timeline track").expect("the track is there")
}

/// Where a time lies on the ruler, from where two keys' diamonds are.
fn ruler_at(harness: &egui_kittest::Harness<'_, Stage>, secs: f64) -> egui::Pos2 {
    let x = |name: &str| harness.get_by_label(name).rect().center().x;
    let (first, second) = (x("Key 1 at 0.00 s"), x("Key 2 at 3.00 s"));
    pos2(first + (second - first) * (secs / 3.0) as f32, track(harness).top() + 6.0)
}

#[test]
fn views_become_keys_and_the_playhead_brings_them_back() {
    let mut harness = stage(Scene::default(), Settings::default(), [1280.0, 720.0]);
    press(&mut harness, "Animate");
    assert!(harness.state().interface.settings().timeline_open);
    let first = scene(&harness).clone();
    press(&mut harness, "Add key");
    slider(&harness, "Power").set_value_accesskit(5.0);
    harness.run();
    let second = scene(&harness).clone();
    harness.key_press(Key::K);
    harness.run();
    assert_eq!(times(&harness), [0.0, 3.0]);
    let scenes: Vec<&Scene> = path(&harness).keys.iter().map(|key| &*key.scene).collect();
    assert_eq!(scenes, [&first, &second]);

    harness.key_press(Key::Comma);
    harness.run();
    assert_eq!(*scene(&harness), first);
    harness.key_press(Key::Period);
    harness.run();
    assert_eq!(*scene(&harness), second);
    harness.key_press_modifiers(egui::Modifiers::COMMAND, Key::Z);
    harness.run();
    assert_eq!((times(&harness), scene(&harness)), (vec![0.0], &second), "the view stays");
    harness.key_press_modifiers(egui::Modifiers::COMMAND, Key::Y);
    harness.run();
    // Two keys and the slider; going from key to key loses nothing, so it is no step.
    assert_eq!(undo_all(&mut harness), 3);
    assert_eq!(*scene(&harness), first);
    assert!(path(&harness).is_empty());
}

#[test]
fn scrubbing_shows_every_moment_and_keeps_a_view_of_one_s_own() {
    let mut harness = stage(project(), open(), [1280.0, 720.0]);
    let own = scene(&harness).clone();
    let (from, to) = (ruler_at(&harness, 0.5), ruler_at(&harness, 1.5));
    drag(&mut harness, from, to, 10);
    assert_eq!(*scene(&harness), own, "a view of one's own stays");
    press(&mut harness, "Return to path");
    let moment = path(&harness).at(1.5).unwrap();
    assert_eq!(*scene(&harness), moment, "the view is what the path has at 1.5 s");
    assert!((5.0..8.0).contains(&moment.fractal.number("power").unwrap()));
    assert_eq!(path(&harness).keys, project().path.keys, "scrubbing changes no key");
    // Close to a key the playhead snaps to it.
    let near = ruler_at(&harness, 3.0) + vec2(3.0, 0.0);
    drag(&mut harness, to, near, 4);
    assert_eq!(*scene(&harness), *path(&harness).keys[1].scene);
    // Further scrubbing adds no step; the view that the path replaced can be had back, also by undo.
    drag(&mut harness, from, to, 3);
    press(&mut harness, "Return to my view");
    assert_eq!(*scene(&harness), own);
    press(&mut harness, "Return to path");
    assert_eq!(undo_all(&mut harness), 2);
    assert_eq!(*scene(&harness), own);
}

/// The first thing that people try: a key, another view, another time, a second key.
#[test]
fn a_new_view_becomes_a_key_at_the_time_that_is_clicked() {
    let mut harness = stage(Scene::default(), open(), [1280.0, 720.0]);
    harness.key_press(Key::K);
    harness.run();
    let first = scene(&harness).clone();
    let center = harness.state().interface.rects().get("view").unwrap().center();
    drag(&mut harness, center, center + vec2(120.0, 30.0), 5);
    harness.run_steps(60);
    let second = scene(&harness).clone();
    assert_ne!(second, first, "the drag turns the view");

    let at = track(&harness).center();
    drag(&mut harness, at - vec2(200.0, 12.0), at - vec2(0.0, 12.0), 5);
    assert_eq!(*scene(&harness), second, "the playhead leaves the new view alone");
    harness.key_press(Key::K);
    harness.run();
    let [start, end] = times(&harness)[..] else { panic!("{:?}", times(&harness)) };
    assert!(start == 0.0 && (1.5..4.0).contains(&end), "the second key is at {end}");
    let scenes: Vec<&Scene> = path(&harness).keys.iter().map(|key| &*key.scene).collect();
    assert_eq!(scenes, [&first, &second]);
}

/// Playing and going to a key show the path; nothing that was in view is lost by it.
#[test]
fn a_view_that_the_path_replaces_is_put_aside() {
    let shows: [fn(&mut egui_kittest::Harness<'_, Stage>); 3] = [
        |harness| {
            harness.key_press(Key::Space);
            harness.run_steps(5);
            harness.key_press(Key::Space);
        },
        |harness| harness.key_press(Key::Period),
        |harness| harness.get_by_label("Key 2 at 3.00 s").click(),
    ];
    for show in shows {
        let mut harness = stage(project(), open(), [1280.0, 720.0]);
        let own = scene(&harness).clone();
        show(&mut harness);
        harness.run();
        assert_ne!(*scene(&harness), own);
        press(&mut harness, "Return to my view");
        assert_eq!(*scene(&harness), own);
        assert!(harness.query_by_label("Return to my view").is_none());
    }
}

/// Work on the path drops neither the view put aside nor a view made there.
#[test]
fn a_view_put_aside_stays_until_it_is_stored_or_shown_again() {
    let mut harness = stage(project(), open(), [1280.0, 720.0]);
    let own = scene(&harness).clone();
    harness.key_press(Key::Period);
    harness.run();
    // The key's view is stored again, and then changed.
    harness.key_press(Key::K);
    harness.run();
    assert_eq!(path(&harness).keys.len(), project().path.keys.len() + 1);
    harness.key_press(Key::ArrowRight);
    harness.run();
    let other = scene(&harness).clone();
    press(&mut harness, "Return to my view");
    assert_eq!(*scene(&harness), own);
    press(&mut harness, "Return to my view");
    assert_eq!(*scene(&harness), other);
    press(&mut harness, "Return to my view");
    // Stored, it need not be kept; the other one is.
    harness.key_press(Key::K);
    harness.run();
    press(&mut harness, "Return to my view");
    assert_eq!(*scene(&harness), other);
    assert!(harness.query_by_label("Return to my view").is_none());
}

#[test]
fn the_preview_counts_as_movement() {
    let mut harness = stage(project(), open(), [1280.0, 720.0]);
    harness.key_press(Key::Space);
    harness.run_steps(3);
    assert!(harness.state().interface.is_moving(), "playing is a movement");
    let early = scene(&harness).clone();
    harness.run_steps(60);
    assert_ne!(*scene(&harness), early, "a second of playing shows another moment");
    harness.key_press(Key::Space);
    harness.run();
    assert!(!harness.state().interface.is_moving());
    let rest = scene(&harness).clone();
    harness.run_steps(10);
    assert_eq!(*scene(&harness), rest);

    // Over the end it begins anew, and a hand on the picture stops it.
    harness.key_press(Key::Space);
    harness.run_steps(60 * 8);
    assert!(harness.state().interface.is_moving());
    let center = harness.state().interface.rects().get("view").unwrap().center();
    drag(&mut harness, center, center + vec2(60.0, 0.0), 5);
    harness.run_steps(30);
    assert!(!harness.state().interface.is_moving());
}

#[test]
fn a_key_is_dragged_between_its_neighbours_as_one_step() {
    let mut harness = stage(project(), open(), [1280.0, 720.0]);
    let at = |harness: &egui_kittest::Harness<'_, Stage>, name: &str| {
        harness.get_by_label(name).rect().center()
    };
    harness.get_by_label("Key 2 at 3.00 s").click();
    harness.run();
    let from = at(&harness, "Key 2 at 3.00 s");
    let to = pos2(ruler_at(&harness, 4.0).x, from.y);
    drag(&mut harness, from, to, 10);
    let [_, moved, _] = times(&harness)[..] else { panic!("a key is gone") };
    assert!((moved - 4.0).abs() < 0.05, "moved to {moved}");
    assert_eq!((moved * 30.0).fract(), 0.0, "keys lie on frames");
    assert_eq!(*scene(&harness), *path(&harness).keys[1].scene, "the view goes along");
    // Past the last key it stops a frame before it.
    let from = harness.get_by_label(&format!("Key 2 at {moved:.2} s")).rect().center();
    drag(&mut harness, from, from + vec2(900.0, 0.0), 10);
    let secs = times(&harness)[1];
    assert!((5.9..6.0).contains(&secs), "stopped at {secs}");
    assert_eq!(path(&harness).validate(), Ok(()));
    // The first of the steps is the view that the click on the key replaced.
    assert_eq!(undo_all(&mut harness), 3);
    assert_eq!(*scene(&harness), project().scene);
    assert_eq!(path(&harness).keys, project().path.keys);
}

#[test]
fn keys_are_selected_eased_updated_and_deleted() {
    let mut harness = stage(project(), open(), [1280.0, 720.0]);
    harness.get_by_label("Key 2 at 3.00 s").click();
    harness.run();
    assert_eq!(scene(&harness).fractal.number("power"), Some(5.0));
    press(&mut harness, "Easing: Hold");
    assert_eq!(path(&harness).keys[1].easing, Easing::Hold);

    slider(&harness, "Power").set_value_accesskit(9.0);
    harness.run();
    assert_eq!(
        path(&harness).keys[1].scene.fractal.number("power"),
        Some(5.0),
        "a key stays as it is"
    );
    press(&mut harness, "Update key");
    assert_eq!(path(&harness).keys[1].scene.fractal.number("power"), Some(9.0));

    press(&mut harness, "Delete key");
    assert_eq!(times(&harness), [0.0, 6.0]);
    assert!(undo_all(&mut harness) >= 4);
    assert_eq!(path(&harness).keys, project().path.keys);
}

#[test]
fn times_and_rates_are_typed_and_kept_in_range() {
    let mut harness = stage(project(), open(), [1280.0, 720.0]);
    harness.get_by_label("Key 2 at 3.00 s").click();
    harness.run();
    for (text, secs) in
        [("4.5", 4.5), ("99", 6.0 - 1.0 / 30.0), ("-3", 1.0 / 30.0), ("2 apples", 1.0 / 30.0)]
    {
        press(&mut harness, "Time value");
        harness.get_by_label("Time value").type_text(text);
        harness.key_press(Key::Enter);
        harness.run();
        assert!((times(&harness)[1] - secs).abs() < 1e-9, "{text} gave {:?}", times(&harness));
    }
    press(&mut harness, "Frame rate value");
    harness.get_by_label("Frame rate value").type_text("1000");
    harness.key_press(Key::Enter);
    harness.run();
    assert_eq!(path(&harness).frames_per_second, 240);
    press(&mut harness, "Motion blur value");
    harness.get_by_label("Motion blur value").type_text("0.5");
    harness.key_press(Key::Enter);
    harness.run();
    assert_eq!(path(&harness).shutter, 0.5);
    assert_eq!(path(&harness).validate(), Ok(()));
}

#[test]
fn a_full_path_takes_no_more_keys_and_one_key_does_not_play() {
    let mut full = project();
    full.path.keys = (0..MAX_KEYS)
        .map(|i| PathKey { time_secs: i as f64, ..project().path.keys[0].clone() })
        .collect();
    let mut harness = stage(full.clone(), open(), [1280.0, 720.0]);
    harness.key_press(Key::K);
    harness.run();
    assert_eq!(path(&harness).keys.len(), MAX_KEYS);

    full.path.keys.truncate(1);
    let mut harness = stage(full, open(), [1280.0, 720.0]);
    harness.key_press(Key::Space);
    harness.run_steps(20);
    assert!(!harness.state().interface.is_moving());
}

/// What replaces a path is looked at and added to from a moment that it has.
#[test]
fn another_document_brings_the_playhead_back_onto_its_path() {
    let mut harness = stage(project(), open(), [1280.0, 720.0]);
    harness.get_by_label("Key 3 at 6.00 s").click();
    harness.run();
    harness.state_mut().interface.replace_project(Scene::default());
    harness.run();
    press(&mut harness, "Add key");
    assert_eq!(times(&harness), [0.0]);
}

#[test]
fn a_sequence_is_asked_for_by_its_frames_and_shows_its_progress() {
    let mut harness = stage(project(), open(), [1280.0, 720.0]);
    let size_px = harness.state().interface.view_size_px();
    press(&mut harness, "Save video");
    press(&mut harness, "First frame value");
    harness.get_by_label("First frame value").type_text("20");
    harness.key_press(Key::Enter);
    harness.run();
    press(&mut harness, "Last frame value");
    harness.get_by_label("Last frame value").type_text("5000");
    harness.key_press(Key::Enter);
    harness.run();
    press(&mut harness, "Save video");
    let saved = |frames, format| Action::SaveSequence { size_px, frames, format, pair: false };
    let [all, some] = [[0, 181], [20, 181]].map(|frames| saved(frames, SequenceFormat::Mp4));
    assert_eq!(harness.state().actions, [all, some]);
    harness.get_by_role_and_label(Role::ComboBox, "Kind of file").click();
    harness.run();
    press(&mut harness, "PNGs");
    press(&mut harness, "Save frames");
    assert_eq!(harness.state().actions.last(), Some(&saved([20, 181], SequenceFormat::Pngs)));

    // A kind that the browser cannot encode isn't offered, and a stored choice of it gets a substitute.
    let kinds = |harness: &mut egui_kittest::Harness<'_, Stage>| {
        harness.get_by_role_and_label(Role::ComboBox, "Kind of file").click();
        harness.run();
        let kinds = ["MP4", "WebM", "PNGs"]
            .map(|kind| harness.query_all_by_role_and_label(Role::Button, kind).next().is_some());
        harness.key_press(Key::Escape);
        harness.run();
        kinds
    };
    assert_eq!(kinds(&mut harness), [true; 3]);
    harness.state_mut().missing_encoders = MissingEncoders::OfThisSize { mp4: false, webm: true };
    assert_eq!(kinds(&mut harness), [true, false, true]);
    harness.get_by_role_and_label(Role::ComboBox, "Kind of file").click();
    harness.run();
    harness.get_by_label("This browser cannot encode WebM videos of this size.");
    press(&mut harness, "MP4");
    harness.state_mut().missing_encoders = MissingEncoders::All;
    assert_eq!(kinds(&mut harness), [false, false, true]);
    press(&mut harness, "Save frames");
    assert_eq!(harness.state().actions.last(), Some(&saved([20, 181], SequenceFormat::Pngs)));

    harness.state_mut().actions.clear();
    harness.state_mut().export = Some(ExportProgress { done: 0.3, remaining_secs: Some(75.0) });
    harness.run();
    assert!(harness.query_by_label("Save video").is_none());
    // One progress and one button, in the panel; in the timeline while the panel is hidden.
    harness.run();
    assert_eq!(harness.get_all_by_label("Cancel").count(), 1);
    harness.key_press(egui::Key::P);
    harness.run();
    harness.get_by_label("Cancel").click();
    harness.run();
    assert_eq!(harness.state().actions, [Action::CancelExport]);
}

#[test]
fn it_fits_every_window_and_every_control_says_what_it_does() {
    for size in [[360.0, 640.0], [390.0, 844.0], [844.0, 390.0], [700.0, 500.0], [1280.0, 720.0]] {
        let mut harness = stage(project(), Settings::default(), size);
        press_tool(&mut harness, "Animate");
        harness.get_by_label("Key 2 at 3.00 s").click();
        harness.run();
        harness.run();
        let rects = harness.state().interface.rects();
        let [view, strip] = ["view", "timeline"].map(|name| rects.get(name).expect(name));
        let both = view.intersect(strip);
        assert!(both.width() < 0.6 || both.height() < 0.6, "{view:?} and {strip:?} in {size:?}");
        let part = view.area() / (size[0] * size[1]);
        assert!(part > 0.25, "the view has {part} of {size:?}");
        let window = Rect::from_min_size(egui::Pos2::ZERO, size.into()).expand(0.5);
        for node in harness.root().children_recursive() {
            let inside = node.accesskit_node().bounding_box().is_some()
                && strip.contains(node.rect().center());
            if inside && egui::accessibility::is_input(node.accesskit_node().role()) {
                let label = node.accesskit_node().label();
                assert!(window.contains_rect(node.rect()), "{label:?} in {size:?}");
                assert!(label.is_some(), "a control without a name in {size:?}");
            }
        }
        press(&mut harness, "Hide timeline");
        let rects = harness.state().interface.rects();
        assert!(rects.get("timeline").is_none(), "it stays in {size:?}");
    }
}

/// The turn replaces the path as one undo step, and begins where the view is.
#[test]
fn a_turntable_becomes_the_path() {
    let mut harness = stage(project(), open(), [1280.0, 720.0]);
    let (before, camera) =
        (harness.state().interface.project().clone(), scene(&harness).camera.clone());
    press(&mut harness, "Turntable");
    let path = harness.state().interface.project().path.clone();
    assert_eq!(path.keys.first().map(|key| key.scene.camera.pivot.clone()), Some(camera.pivot));
    assert_eq!(path.frame_count(), 12 * path.frames_per_second);
    harness.state_mut().interface.editor_mut().undo();
    assert_eq!(harness.state().interface.project().path, before.path);
}

/// The playhead's grip stands beside the number of its time, not over it.
#[test]
fn the_playhead_covers_no_number_at_its_own_time() {
    let mut harness = stage(project(), open(), [1280.0, 720.0]);
    harness.run();
    let [zero] = painted(&harness, "0.0")[..] else { panic!("one number 0") };
    let grips = shapes(&harness).into_iter().filter(
        |shape| matches!(shape, egui::Shape::Path(path) if path.closed && path.points.len() == 5),
    );
    let grips: Vec<_> = grips.map(egui::Shape::visual_bounding_rect).collect();
    let grip = grips.iter().find(|grip| (grip.top() - zero.top()).abs() < 12.0);
    let grip = grip.expect("a grip at the numbers");
    assert!(
        grip.center().x < zero.left() && zero.left() - grip.center().x < 20.0,
        "{grip:?} {zero:?}"
    );
    assert!(!grip.intersects(zero), "{grip:?} covers {zero:?}");
}

/// Keys that are close together share no place: each is clicked at its own diamond.
#[test]
fn close_keys_share_no_touch_area() {
    for has_touch in [false, true] {
        let mut crowded = project();
        for (key, secs) in crowded.path.keys.iter_mut().zip([0.0, 0.2, 0.3]) {
            key.time_secs = secs;
        }
        let mut harness = stage(crowded, open(), [1280.0, 720.0]);
        if has_touch {
            touch(&mut harness);
        }
        let names = ["Key 1 at 0.00 s", "Key 2 at 0.20 s", "Key 3 at 0.30 s"];
        let areas = names.map(|name| harness.get_by_label(name).rect());
        for (pair, names) in areas.windows(2).zip(names.windows(2)) {
            assert!(pair[0].right() <= pair[1].left() + 0.01, "{names:?}: {pair:?}");
        }
        // Away from neighbours, the area has its full width.
        let half = if has_touch { 22.0 } else { 10.0 };
        let diamonds = shapes(&harness).into_iter().filter_map(|shape| match shape {
            egui::Shape::Path(path) if path.closed && path.points.len() == 4 => {
                Some(shape.visual_bounding_rect().center())
            }
            _ => None,
        });
        let on_lane = diamonds.filter(|at| areas[0].y_range().contains(at.y));
        let (left, right) = on_lane
            .fold((f32::MAX, f32::MIN), |(left, right), at| (left.min(at.x), right.max(at.x)));
        assert!((left - areas[0].left() - half).abs() < 0.5, "{left}: {areas:?}");
        assert!((areas[2].right() - right - half).abs() < 0.5, "{right}: {areas:?}");
        for (index, name) in names.into_iter().enumerate() {
            harness.get_by_label(name).click();
            harness.run();
            let power = path(&harness).keys[index].scene.fractal.number("power");
            assert_eq!(scene(&harness).fractal.number("power"), power, "{name}");
        }
    }
}

/// A damaged or hand-written path may have keys at one time: each can still be reached.
#[test]
fn keys_at_one_time_keep_some_width() {
    let mut crowded = project();
    for key in &mut crowded.path.keys {
        key.time_secs = 1.0;
    }
    let harness = stage(crowded, open(), [1280.0, 720.0]);
    for index in 1..=3 {
        let area = harness.get_by_label(&format!("Key {index} at 1.00 s")).rect();
        assert!(area.width() >= 5.9, "{area:?}");
    }
}
