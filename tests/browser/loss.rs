//! What a page does whose GPU is lost.

use std::fs;

use mandelight::scene::document;

use crate::{sequence::short_path, visit::Visit};

#[test]
fn a_lost_gpu_comes_back_with_the_same_scene() {
    let document = document::project_to_json(&short_path());
    let visit = Visit::run_with("loss", [("MANDELIGHT_PATH", document)]);
    assert_eq!(visit.text("/before"), visit.text("/after"));
    assert!(visit.seen["notice"].is_null(), "{}", visit.seen["notice"]);
    let [before, after] = ["before", "after"].map(|name| visit.pixels(name));
    assert!(before.contrast() > 5.0);
    // The picture after a loss may be smaller; it must not be empty.
    assert!(after.contrast() > 0.5 * before.contrast(), "{}", after.contrast());
    assert_eq!(visit.number("/cleared"), 0.0, "a complete picture clears the losses");

    // While the view moves, and while pipelines are compiled.
    assert_eq!(visit.text("/moved"), visit.text("/moved_after"));
    assert_ne!(visit.text("/moved"), visit.text("/after"));
    assert_eq!(visit.number("/power"), 5.0);

    // Files are those of a visit without a loss.
    let file = |name: &str| fs::read(visit.folder.join(name)).unwrap();
    assert!(file("resumed.png") == file("whole.png"), "the picture is another one");
    assert_eq!(visit.seen["edited_while_saving"], true);
    assert!(file("edited.png") == file("whole.png"), "an edit changed the picture being saved");
    assert_eq!(visit.number("/still_saving"), 2.0);
    assert_eq!(visit.seen["offered_notice"], true);
    assert_eq!(visit.seen["frames"].as_array().unwrap().len(), 3);
    assert_eq!(visit.number("/same_frames"), 3.0);

    // Twice: nothing is drawn until the visitor moves the view.
    assert_eq!(visit.number("/paused"), 0.0);
    assert_eq!(visit.number("/cleared_again"), 0.0);

    // Ten times: the page gave up at the third loss, and offered the scene at each next visit.
    assert!(visit.number("/given_up") >= 3.0);
    assert!(visit.text("/last_notice").contains("could not be restarted"));
    assert_eq!(visit.number("/kept_losses"), 10.0);
    let [lost, instead, taken] = ["/lost", "/opened_instead", "/taken"].map(|at| visit.text(at));
    assert_ne!(instead, lost);
    assert_eq!(taken, lost);
}
