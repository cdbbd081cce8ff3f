//! What a dive says over the picture, and how it is kept as a camera path.

use std::sync::Arc;

use egui::{Button, Label, Response, RichText, Ui};

use super::{
    floating::{CaptionArea, framed},
    navigation::guide::GuideStatus,
    rects::Rects,
    shortcuts::Command,
    widgets::Help as _,
};
use crate::scene::{
    Camera, Scene,
    path::{Easing, Key},
};

/// Name and hover text of the button that begins a dive.
pub const BEGIN: (&str, &str) = ("Dive", "Fly down by itself, from one place to the next (D)");
/// Name and hover text of the button during a dive.
pub const STOP: (&str, &str) = ("Stop the dive", "Stop here (D, or touch the picture)");

/// The keys of a path that repeats a dive with the rest of `scene`.
///
/// `record` holds the dive's cameras with their times in seconds.
pub fn keys(record: &[(f64, Camera)], scene: &Scene) -> Vec<Key> {
    let key = |(time_secs, camera): &(f64, Camera)| {
        let scene = Arc::new(Scene { camera: camera.clone(), ..scene.clone() });
        Key { time_secs: *time_secs, easing: Easing::Smooth, scene }
    };
    let mut keys: Vec<Key> = record.iter().map(key).collect();
    keys.dedup_by(|later, earlier| later.time_secs <= earlier.time_secs);
    keys
}

/// Shows the dive's status at the lower edge of the picture, and afterwards the offer to keep it.
///
/// Returns its response; none if nothing is shown.
pub fn show(
    ui: &Ui,
    area: CaptionArea,
    status: GuideStatus,
    has_record: bool,
    rects: &mut Rects,
    commands: &mut Vec<Command>,
) -> Option<Response> {
    let text = match status {
        GuideStatus::Searching => "Looking for a place to dive to…",
        GuideStatus::Diving => "Diving. Touch the picture to stop.",
        GuideStatus::NoPlace => "No place to dive to in this view. Show more of the surface.",
        GuideStatus::AtEnd => "This is as deep as it goes.",
        GuideStatus::Idle => "",
    };
    let is_over = matches!(status, GuideStatus::Idle | GuideStatus::AtEnd);
    if text.is_empty() && !has_record {
        return None;
    }
    let shown = framed(ui, area.lowest(ui, "dive status"), area.width(), |ui| {
        ui.horizontal_wrapped(|ui| {
            if !text.is_empty() {
                ui.add(Label::new(RichText::new(text)).selectable(false).wrap());
            }
            if is_over && has_record {
                let hover = "Make this dive the camera path, instead of the present one, to play, edit and save it";
                let keep = ui.add(Button::new("Keep as a path")).help(hover);
                rects.record("keep dive", &keep);
                if keep.clicked() {
                    commands.push(Command::KeepDive);
                }
            }
        });
    });
    rects.record("dive status", &shown.response);
    Some(shown.response)
}
