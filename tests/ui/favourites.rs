//! Views that are kept: listed with pictures, opened, renamed, removed.

use egui::Key;
use egui_kittest::kittest::Queryable as _;
use mandelight::{
    scene::{document, presets},
    ui::{Action, Settings},
};

use crate::stage::*;

#[test]
fn a_view_is_kept_opened_renamed_and_removed() {
    let start = presets::opening();
    let mut harness = without_motion(stage(start.clone(), Settings::default(), [1280.0, 720.0]));
    press(&mut harness, "Mine");
    press(&mut harness, "Keep this view");
    assert_eq!(harness.state().actions, [Action::KeepFavourite]);
    // The shell answers with the document and a picture.
    let kept = document::project_to_json_compact(harness.state().interface.project());
    let jpeg = mandelight::ui::thumbnail::jpeg(&presets::opening_scenes()[0]).expect("a picture");
    harness.state_mut().interface.keep_favourite(kept, jpeg.to_vec());
    harness.run();
    assert!(harness.state_mut().interface.favourites_mut().take_changed());
    button(&harness, "View 1");

    harness.key_press(Key::Num3);
    harness.run();
    assert_ne!(*scene(&harness), start);
    press(&mut harness, "View 1");
    assert_eq!(*scene(&harness), start, "the kept view is back");
    harness.key_press_modifiers(egui::Modifiers::COMMAND, Key::Z);
    harness.run();
    assert_ne!(*scene(&harness), start, "opening it is a step");

    harness.get_by_label("Name of the view").focus();
    harness.run();
    harness.get_by_label("Name of the view").type_text("!");
    harness.run();
    assert!(harness.query_by_label("View 1!").is_some(), "the card has the new name");
    press(&mut harness, "Remove");
    assert!(harness.state_mut().interface.favourites_mut().list().is_empty());
}

#[test]
fn a_kept_view_that_cannot_be_read_changes_nothing() {
    let mut harness =
        without_motion(stage(presets::opening(), Settings::default(), [1280.0, 720.0]));
    press(&mut harness, "Mine");
    harness.state_mut().interface.keep_favourite("{".to_owned(), Vec::new());
    harness.run();
    press(&mut harness, "View 1");
    assert_eq!(*scene(&harness), presets::opening());
    assert_eq!(harness.state().actions, [Action::ReportUnreadableFavourite]);
}

/// With rows for fingers, the field is higher than a line of text.
#[test]
fn the_name_of_a_kept_view_stands_in_the_middle_of_its_field() {
    let mut harness =
        without_motion(stage(presets::opening(), Settings::default(), [844.0, 800.0]));
    touch(&mut harness);
    press(&mut harness, "Mine");
    let kept = document::project_to_json_compact(harness.state().interface.project());
    harness.state_mut().interface.keep_favourite(kept, Vec::new());
    harness.run();
    let field = harness.get_by_label("Name of the view").rect();
    assert!(field.height() >= 44.0, "{field:?}");
    let names = painted(&harness, "View 1");
    let text = names.iter().find(|text| field.contains_rect(**text)).expect("the name");
    let off = text.center().y - field.center().y;
    assert!(off.abs() < 3.0, "{text:?} in {field:?}");
}
