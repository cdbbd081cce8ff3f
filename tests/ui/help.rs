//! The help window: what it links.

use egui::{OpenUrl, OutputCommand, accesskit::Role};
use egui_kittest::kittest::Queryable as _;
use mandelight::{scene::Scene, ui::Settings};

use crate::stage::*;

#[test]
fn the_help_window_opens_the_licences_in_a_tab_of_their_own() {
    let mut harness = stage(Scene::default(), Settings::default(), [1280.0, 900.0]);
    press(&mut harness, "Help");
    let link = "Licences of the software and fonts in this page";
    harness.get_by_role_and_label(Role::Link, link).scroll_to_me();
    harness.run();
    harness.get_by_role_and_label(Role::Link, link).click();
    let mut opened = Vec::new();
    for _ in 0..3 {
        harness.step();
        let commands = &harness.output().platform_output.commands;
        opened.extend(commands.iter().filter_map(|command| match command {
            OutputCommand::OpenUrl(OpenUrl { url, new_tab }) => Some((url.clone(), *new_tab)),
            _ => None,
        }));
    }
    assert_eq!(opened, [("./licenses.txt".to_owned(), true)]);
}
