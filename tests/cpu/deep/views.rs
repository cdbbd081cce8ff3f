//! The deep views: anchors that lie on the surface, orbits that are long enough, and numbers that are fine enough.

use mandelight::{formula::mandelbulb::Mandelbulb, gpu::device::in_parallel};
use mandelight_test_support::{
    deep::{
        arithmetic::{Number, Real},
        brackets::Verdict,
        orbit::Set,
        random_views::random_view,
        rays::{SetView, centre, pixels},
        views::{ANCHORS, SMALL, plenty},
    },
    random::Random,
};

/// Orbits of points that rays visit leave before they are cut, so that longer ones change nothing.
#[test]
fn plenty_of_steps_is_enough() {
    let views: Vec<_> = ANCHORS.iter().map(|anchor| anchor.scene(anchor.deepest)).collect();
    in_parallel(&views, |scene| {
        let looking = SetView::exact(scene, SMALL, plenty(scene));
        for pixel in [[2, 2], [6, 4], [9, 5]] {
            let depth = looking.depth(pixel).expect("a hit");
            let point = looking.at(looking.direction(centre(pixel)), depth);
            let steps = looking.set.estimate(&point, depth).steps;
            assert!(
                steps < plenty(scene),
                "{steps} steps for power {}",
                Mandelbulb::of(&scene.fractal).power
            );
        }
    });
}

#[test]
fn anchors_are_on_the_surface() {
    for anchor in ANCHORS {
        let scene = anchor.scene(anchor.deepest);
        let set = Set::new(&Mandelbulb::of(&scene.fractal), plenty(&scene));
        let distance = set.estimate(&anchor.position.map(Real::parse), anchor.deepest).distance;
        assert!(
            distance < 1e-4 * anchor.deepest,
            "power {} {}: {distance}",
            anchor.power,
            anchor.name
        );
    }
}

/// Random views, from 1 to 1e-10 scene units.
const VIEWS: usize = 24;

/// Where f64 follows the orbits, rays end where those of 192 bits do, and the same depths are right.
#[test]
fn views_in_f64_are_those_of_more_digits() {
    let mut random = Random(0x5EED_F640);
    let (mut coarse_views, mut fine_views, mut hits) = (0, 0, 0);
    let mut apart = Vec::new();
    while coarse_views + fine_views < VIEWS {
        let Some(view) = random_view(&mut random, 1e-10) else { continue };
        let iterations = plenty(&view.scene);
        let Some(coarse) = SetView::in_f64(&view.scene, SMALL, iterations) else {
            fine_views += 1;
            continue;
        };
        coarse_views += 1;
        let fine = SetView::exact(&view.scene, SMALL, iterations);
        let pixels: Vec<_> = pixels(SMALL).collect();
        let rays = in_parallel(&pixels, |&(pixel, index): &([u32; 2], usize)| {
            let depths = [coarse.depth(pixel), fine.depth(pixel)];
            // Verdicts take longer.
            let direction = fine.direction(centre(pixel));
            let is_judged = index % 4 == 0;
            let verdicts = is_judged
                .then(|| [coarse.judge(direction, depths[1]), fine.judge(direction, depths[1])]);
            (depths, verdicts)
        });
        hits += rays.iter().filter(|(depths, _)| depths.iter().any(Option::is_some)).count();
        apart.extend(rays.into_iter().filter(|(depths, verdicts)| {
            let is_apart = match *depths {
                [Some(a), Some(b)] => (a - b).abs() > 0.01 * fine.footprint(b),
                [a, b] => a.is_some() != b.is_some(),
            };
            is_apart || verdicts.is_some_and(|[a, b]| a != b)
        }));
    }
    println!("{coarse_views} views in f64, {} of {hits} rays apart: {apart:?}", apart.len());
    assert!(coarse_views >= 10 && fine_views >= 2, "{coarse_views} and {fine_views} views");
    assert!(hits > 1000 && apart.len() * 1000 <= hits, "{} of {hits} rays: {apart:?}", apart.len());
}

/// Footprints by which a depth is moved.
const OFFSET: f64 = 6.0;

/// Depths of a march are right. Most of those in front of the surface are too near, and most of those behind it wrong.
#[test]
fn most_depths_in_front_of_and_behind_the_surface_are_wrong() {
    let mut random = Random(0x5EED_BE51);
    let (mut hits, mut right, mut too_near, mut wrong_behind) = (0, 0, 0, 0);
    for view in std::iter::repeat_with(|| random_view(&mut random, 1e-10)).flatten().take(VIEWS) {
        let looking = SetView::exact(&view.scene, SMALL, plenty(&view.scene));
        let pixels: Vec<_> = pixels(SMALL).step_by(7).collect();
        let rays = in_parallel(&pixels, |&(pixel, _): &([u32; 2], usize)| {
            let direction = looking.direction(centre(pixel));
            let depth = looking.depth(pixel)?;
            let offset = OFFSET * looking.footprint(depth);
            Some([0.0, -offset, offset].map(|by| looking.judge(direction, Some(depth + by))))
        });
        for [at, before, behind] in rays.into_iter().flatten() {
            hits += 1;
            right += usize::from(at == Verdict::Right);
            too_near += usize::from(before == Verdict::TooNear);
            wrong_behind += usize::from(behind != Verdict::Right);
        }
    }
    println!("of {hits}: {right} right, {too_near} too near, {wrong_behind} wrong behind");
    // In front of and behind most other rays, dust or another layer may be near.
    assert!(hits > 300 && right == hits, "{right} of {hits}");
    assert!(too_near * 4 > hits * 3 && wrong_behind * 3 > hits * 2, "{too_near}, {wrong_behind}");
}
