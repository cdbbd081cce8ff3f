//! The share window: what it offers, and that it fits.

use egui::{Key, Rect, accesskit::Role};
use egui_kittest::kittest::Queryable as _;
use mandelight::{
    scene::{Scene, presets},
    ui::{Action, Settings},
};

use crate::stage::*;

#[test]
fn a_view_is_shared_as_link_code_and_picture() {
    let mut harness = stage(presets::opening(), Settings::default(), [1280.0, 720.0]);
    press(&mut harness, "Share");
    harness.get_by_role_and_label(Role::Image, "QR code of the link to this view");
    assert!(harness.query_by_label("Send picture…").is_none(), "this system has no share sheet");
    let wanted = [("Copy picture", Action::CopyPicture), ("Copy link", Action::CopyLink)];
    for (name, action) in wanted {
        harness.state_mut().actions.clear();
        // The panel has such buttons too; the window's are drawn last.
        harness.get_all_by_role_and_label(Role::Button, name).last().expect("a button").click();
        harness.run();
        assert_eq!(harness.state().actions, [action]);
    }
    harness.key_press(Key::Escape);
    harness.run();
    assert!(harness.query_by_label("Copy picture").is_none(), "Escape closes it");
    harness.key_press(Key::J);
    harness.run();
    assert!(harness.query_by_label("Copy picture").is_some());
}

#[test]
fn the_share_sheet_is_offered_where_there_is_one() {
    let mut harness = stage(Scene::default(), Settings::default(), [390.0, 844.0]);
    harness.state_mut().has_share_sheet = true;
    press(&mut harness, "Share");
    press(&mut harness, "Send picture…");
    assert_eq!(harness.state().actions, [Action::SharePicture]);
}

#[test]
fn the_share_window_fits_every_window() {
    for size in [[390.0, 844.0], [844.0, 390.0], [320.0, 480.0], [1280.0, 720.0]] {
        let mut harness = stage(Scene::default(), Settings::default(), size);
        press(&mut harness, "Share");
        let shown = harness.state().interface.rects().get("share window").expect("the window");
        let window = Rect::from_min_size(egui::Pos2::ZERO, size.into());
        assert!(window.contains_rect(shown), "{shown:?} in {size:?}");
    }
}

#[test]
fn nothing_of_the_share_window_is_cut_off() {
    for size in [[390.0, 844.0], [844.0, 390.0], [640.0, 420.0], [1280.0, 720.0]] {
        let mut harness = stage(Scene::default(), Settings::default(), size);
        harness.state_mut().has_share_sheet = true;
        press(&mut harness, "Share");
        let rects = harness.state().interface.rects();
        let window = rects.get("share window").expect("the window");
        for name in ["QR code", "Send picture…", "Copy link", "Copy picture", "Save picture"] {
            let rect = rects.get(name).unwrap_or(Rect::NOTHING);
            assert!(window.contains_rect(rect), "{name}: {rect:?} in {window:?} of {size:?}");
        }
    }
}
