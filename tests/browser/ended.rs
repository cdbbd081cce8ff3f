//! What the next visit opens after one that ended by an error.

use mandelight::scene::{link, presets};

use crate::visit::Visit;

#[test]
fn a_scene_that_ended_the_page_is_offered_and_does_not_open_by_itself() {
    let [scene, other] = [3, 4].map(|index| (presets::opening_scenes()[index].scene)());
    let links = [("MANDELIGHT_LINK", &scene), ("MANDELIGHT_OTHER_LINK", &other)];
    let links = links.map(|(name, scene)| (name, link::to_fragment(scene).unwrap()));
    let visit = Visit::run_with("ended", links);

    assert!(visit.text("/notice/text").contains("error in the program"));
    let shown = visit.scene("shown");
    let opening = presets::opening();
    assert_eq!(visit.scene("instead").fractal, opening.fractal);
    assert_ne!(shown.fractal, opening.fractal);
    assert_eq!(visit.scene("taken"), shown);
    assert_eq!(visit.scene("again"), shown);

    assert_eq!(visit.scene("instead_of_link").fractal, opening.fractal);
    assert_eq!(visit.number("/samples"), 0.0);
    assert_eq!(visit.scene("reloaded").fractal, other.fractal);
    assert_ne!(scene, other);
}
