//! Windows over the picture close by their cross.

use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable as _;
use mandelight::{scene::Scene, ui::Settings};

use crate::stage::*;

#[test]
fn the_cross_closes_each_window() {
    for (key, modifiers, window) in [
        (Key::F1, Modifiers::NONE, "help window"),
        (Key::J, Modifiers::NONE, "share window"),
        (Key::K, Modifiers::COMMAND, "find window"),
    ] {
        let mut harness = stage(Scene::default(), Settings::default(), [1280.0, 720.0]);
        let is_open = |harness: &egui_kittest::Harness<'_, Stage>| {
            harness.state().interface.rects().get(window).is_some()
        };
        harness.key_press_modifiers(modifiers, key);
        harness.run_steps(4);
        assert!(is_open(&harness), "{window}");
        harness.get_by_label("Close window").click();
        harness.run_steps(8);
        assert!(!is_open(&harness), "{window}");
    }
}
