//! A random walk over the page, after which it holds no more than before.

use mandelight::scene::presets;

use crate::visit::Visit;

/// Memory of the module and of the GPU by which rounds may differ: a few pictures and galleys.
const MAX_GROWTH_BYTES: f64 = (8 << 20) as f64;

/// Small pictures of a window full of them.
const MAX_SMALL_PICTURES: f64 = 64.0;

/// egui's textures beside the gallery's thumbnails: the font, the opening picture, thumbnails of favourites.
const MAX_OTHER_UI_TEXTURES: usize = 16;

#[test]
fn a_walk_over_the_page_breaks_nothing_and_leaves_nothing_behind() {
    let visit = Visit::run("walk");
    let rounds = visit.seen["rounds"].as_array().unwrap();
    let number = |round: usize, pointer: &str| visit.number(&format!("/rounds/{round}{pointer}"));
    for round in rounds {
        assert_eq!(round["errors"]["count"], 0, "{round}");
        println!("{round}");
    }
    let ratios: Vec<_> = visit.seen["ratios"].as_array().unwrap().iter().collect();
    assert!(ratios.windows(2).any(|pair| pair[0] != pair[1]), "one pixel ratio: {ratios:?}");
    let last = rounds.len() - 1;
    for pointer in ["/textures/bytes", "/buffers/bytes", "/memoryBytes"] {
        let [before, after] = [last - 1, last].map(|round| number(round, pointer));
        assert!(after - before <= MAX_GROWTH_BYTES, "{pointer}: {before} became {after}");
    }
    // A thumbnail is kept from when it is first in sight, which may be in any round.
    let most = presets::all().count() + MAX_OTHER_UI_TEXTURES;
    assert!(number(last, "/uiTextures") <= most as f64, "{}", rounds[last]);
    // A round may end in a window with pictures.
    assert!(number(last, "/smallPictures") <= MAX_SMALL_PICTURES, "{}", rounds[last]);
}
