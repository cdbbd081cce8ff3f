//! Indirect light in views: what an edit of it costs, tiles, sparse lattices.

use mandelight::{
    render::{
        Eyes, Pace, Region, View,
        pass::{indirect, march, normal, shade, shadow},
    },
    scene::{Indirect, IndirectKind, Scene},
};

use crate::picture::sparse;
use mandelight_test_support::{
    compare::{assert_same, difference},
    view::{finished, pipelines, pixels, sampled, settle, still},
};

const SIZE: [u32; 2] = [96, 64];
const KINDS: [IndirectKind; 2] = [IndirectKind::Uniform, IndirectKind::Horizon];

fn lit(kind: IndirectKind, samples: u32) -> Scene {
    let indirect = Indirect { kind, radius: 0.1, ..Indirect::default() };
    Scene { indirect, ..sampled(Scene::default(), samples) }
}

fn cost_of(before: &Scene, after: &Scene) -> [u64; 5] {
    let mut view = finished(before, SIZE, Pace::Interactive);
    let old = view.dispatches().clone();
    view.set_scene(after, false);
    settle(&mut view);
    let cost = view.dispatches().since(&old);
    [march::PASS, normal::PASS, shadow::PASS, shade::PASS, indirect::PASS]
        .map(|pass| cost.of(&pass).dispatches)
}

#[test]
fn an_edit_of_indirect_light_touches_only_itself() {
    let before = lit(IndirectKind::Horizon, 1);
    let edits: [fn(&mut Indirect); 4] = [
        |i| i.radius = 0.05,
        |i| i.strength = 0.5,
        |i| i.ambient = 0.5,
        |i| i.kind = IndirectKind::Uniform,
    ];
    for edit in edits {
        let mut after = before.clone();
        edit(&mut after.indirect);
        let [march, normal, shadow, shade, indirect] = cost_of(&before, &after);
        assert_eq!([march, normal, shadow, shade], [0; 4]);
        assert!(indirect > 0);
    }
}

#[test]
fn what_is_off_costs_nothing() {
    let off = lit(IndirectKind::Off, 2);
    let mut other = off.clone();
    other.indirect.radius = 0.01;
    other.indirect.ambient = 1.0;
    assert_eq!(cost_of(&off, &other), [0; 5]);
    let view = finished(&off, SIZE, Pace::Interactive);
    assert!(!view.dispatches().passes().contains(&"indirect"));
    let [march, .., indirect] = cost_of(&lit(IndirectKind::Off, 1), &lit(IndirectKind::Uniform, 1));
    assert!(march == 0 && indirect > 0);
}

/// However the lattice was completed, the picture is the one that a still makes at once.
#[test]
fn refinement_with_indirect_light_ends_in_the_still() {
    pipelines().specialize(&Scene::default());
    for kind in KINDS {
        let scene = lit(kind, 3);
        for size in [SIZE, [37, 21]] {
            let refined = pixels(&finished(&scene, size, Pace::Interactive));
            let direct = still(&scene, size);
            assert_same(&refined, &direct, size, &format!("{kind:?} {size:?}"));
        }
    }
}

/// A tile with the whole picture's neighbours shows what is there in the whole picture.
#[test]
fn tiles_have_no_seams() {
    for kind in KINDS {
        let scene = lit(kind, 2);
        let whole = finished(&scene, SIZE, Pace::Still);
        let picture = pixels(&whole);
        let [x, y, width, height] = [32, 16, 40, 30];
        let region = Region {
            picture_px: SIZE,
            origin_px: [x, y],
            size_px: [width, height],
            eyes: Eyes::Camera,
        };
        let mut tile = View::new(pipelines(), region, Pace::Still);
        tile.lend_indirect_source(Some(whole.indirect_source()));
        tile.set_scene(&scene, false);
        settle(&mut tile);
        let row = |row: u32| {
            let at = 4 * ((y + row) * SIZE[0] + x) as usize;
            &picture[at..at + 4 * width as usize]
        };
        let cut: Vec<u8> = (0..height).flat_map(row).copied().collect();
        assert_eq!(difference(&pixels(&tile), &cut), (0.0, 0), "{kind:?}");
    }
}

/// Large pictures gather from a smaller one of all of the scene.
#[test]
fn a_smaller_picture_gives_nearly_the_same_indirect_light() {
    let size = [300, 200];
    let film = |view: &View| view.film().expect("the film's bytes");
    let apart = |a: &View, b: &View| -> f64 {
        film(a).iter().zip(film(b)).map(|(a, b)| f64::from((a[1] - b[1]).abs())).sum()
    };
    let direct = finished(&lit(IndirectKind::Off, 1), size, Pace::Still);
    for kind in KINDS {
        let scene = lit(kind, 1);
        let own = finished(&scene, size, Pace::Still);
        let overview = finished(&scene, [225, 150], Pace::Still);
        let mut view = View::new(pipelines(), Region::whole(size), Pace::Still);
        view.lend_indirect_source(Some(overview.indirect_source()));
        view.set_scene(&scene, false);
        settle(&mut view);
        let part = apart(&view, &own) / apart(&direct, &own);
        assert!(part < 0.3, "{kind:?}: off by {part} of what indirect light adds");
    }
}

/// What indirect light adds to a sparse lattice is what it adds to the whole picture.
#[test]
fn indirect_light_does_not_shimmer_while_the_lattice_fills() {
    let size = [240, 160];
    let mean = |kind, level| {
        let bytes = sparse(&lit(kind, 1), size, level);
        let sum: f64 = bytes.as_chunks::<4>().0.iter().map(|p| f64::from(p[1])).sum();
        sum / f64::from(size[0] * size[1])
    };
    for kind in KINDS {
        let added = |level| mean(kind, level) - mean(IndirectKind::Off, level);
        let whole = added(0);
        assert!(whole > 0.5, "{kind:?}: {whole}");
        for level in 1..=6 {
            let off = (added(level) / whole - 1.0).abs();
            // One pixel of 64 is far coarser than what there is to see.
            let allowed = if level <= 4 { 0.2 } else { 0.5 };
            assert!(off < allowed, "{kind:?}: off by {off} on level {level}");
        }
    }
}
