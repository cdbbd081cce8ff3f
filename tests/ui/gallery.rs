//! A gallery of the page's address: shown first, opened by its cards, and told of where it fails.

use egui_kittest::kittest::Queryable as _;
use mandelight::{
    scene::{gallery::Gallery, presets},
    ui::{Action, GalleryState, Settings},
};

use crate::stage::*;

fn with(state: GalleryState) -> egui_kittest::Harness<'static, Stage> {
    let mut harness =
        without_motion(stage(presets::opening(), Settings::default(), [1280.0, 720.0]));
    assert!(harness.query_by_label("Gallery").is_none(), "no gallery without an address");
    harness.state_mut().gallery = Some(state);
    harness.run();
    harness
}

#[test]
fn a_gallery_has_a_card_for_each_picture() {
    let files = ["reef.png", "deep/cove.png"].map(str::to_owned);
    let gallery = Gallery::new("Reefs", files).expect("a list");
    let address = "https://example.org/reefs/".to_owned();
    let mut harness = with(GalleryState::Ready { address, gallery });
    press(&mut harness, "Gallery");
    harness.get_by_label("Reefs");
    press(&mut harness, "cove");
    assert_eq!(harness.state().actions, [Action::OpenGalleryPicture(1)]);
}

#[test]
fn a_gallery_that_cannot_be_shown_says_why() {
    let mut harness = with(GalleryState::Loading);
    press(&mut harness, "Gallery");
    harness.get_by_label("Reading the gallery…");
    harness.state_mut().gallery = Some(GalleryState::Failed("No list is there.".to_owned()));
    harness.run();
    harness.get_by_label("No list is there.");
}
