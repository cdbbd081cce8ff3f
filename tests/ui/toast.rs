//! A notice goes from the page after its seconds, and does not come back.

use egui_kittest::{Harness, kittest::Queryable as _};
use mandelight::{
    scene::presets,
    ui::{Notice, Settings, toast::Toast},
};

use crate::stage::*;

/// Runs frames as the page does: the toast expires, and the interface shows what is left of it.
fn frames(harness: &mut Harness<'_, Stage>, toast: &mut Toast, count: usize) {
    for _ in 0..count {
        toast.expire(now_secs(harness));
        harness.state_mut().notice = toast.notice().cloned();
        harness.step();
    }
}

fn now_secs(harness: &Harness<'_, Stage>) -> f64 {
    harness.ctx.input(|input| input.time)
}

#[test]
fn a_notice_goes_from_the_page_and_stays_away() {
    const TEXT: &str = "Link copied.";
    let mut harness = stage(presets::opening(), Settings::default(), [1280.0, 720.0]);
    let mut toast = Toast::default();
    let is_shown = |harness: &Harness<'_, Stage>| harness.query_by_label(TEXT).is_some();
    frames(&mut harness, &mut toast, 3);
    let until_secs = now_secs(&harness) + 2.0;
    toast.show(Notice { text: TEXT.to_owned(), ..Notice::default() }, until_secs);
    frames(&mut harness, &mut toast, 60);
    assert!(is_shown(&harness), "after a second");
    let left_secs = toast.remaining_secs(now_secs(&harness)).expect("the page wakes up for it");
    assert!((0.9..1.1).contains(&left_secs), "{left_secs}");
    frames(&mut harness, &mut toast, 64);
    for _ in 0..5 {
        assert!(!is_shown(&harness), "{} seconds after its time", now_secs(&harness) - until_secs);
        frames(&mut harness, &mut toast, 60);
    }
    // A message that is not about the same has a time of its own.
    toast.show(Notice { text: "Saved.".into(), ..Notice::default() }, now_secs(&harness) + 1.0);
    frames(&mut harness, &mut toast, 3);
    harness.get_by_label("Saved.");
    assert!(!is_shown(&harness));
}
