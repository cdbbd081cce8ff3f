//! Tools, not tests: find the views, say what they are like, and how long orbits are.
//!
//! Run one with `cargo test --test cpu -- --ignored --nocapture NAME`.

use glam::DVec3;
use mandelight::{
    formula::mandelbulb::Mandelbulb,
    gpu::device::in_parallel,
    scene::{PrecisePoint, Scene},
};
use mandelight_test_support::{
    deep::{
        arithmetic::{Number, Point, Real, moved},
        orbit::Set,
        rays::{self, SetView, Size},
        views::{self, ANCHORS, SCALES},
    },
    random::Random,
};

/// What the estimate is at an anchor, scene units.
const MIN_DISTANCE: f64 = 1e-33;

/// A way to the surface: where it ends, where it led, and what orbits needed on it, estimates with
/// steps.
struct Way {
    end: Point,
    direction: DVec3,
    orbits: Vec<(f64, u32)>,
}

/// Marches from `start` along `direction` until the estimate is below [`MIN_DISTANCE`].
fn approach(set: &Set, kind: &str, start: DVec3, direction: DVec3) -> Option<Way> {
    let mut point = start.to_array().map(Real::from_f64);
    let mut orbits = vec![];
    // Along the axis the estimate is as smooth as that of a plane set, and steps are short where the
    // parallels are.
    let is_axis = kind.contains("axis");
    let (mut gone, mut part, mut here) = (0.0, 1.0, set.estimate(&point, 1e-2));
    for _ in 0..if is_axis { 10_000 } else { 1500 } {
        orbits.push((here.distance, here.steps));
        if here.distance < MIN_DISTANCE {
            return Some(Way { end: point, direction, orbits });
        }
        let step = if is_axis { 0.2 * here.distance } else { here.step };
        let step = (part * step).min(0.05);
        if gone + step > 3.0 || step < 1e-6 * here.distance {
            return None;
        }
        let next = moved(&point, direction * step);
        let there = set.estimate(&next, 1e-2 * here.distance);
        if there.distance == 0.0 {
            part *= 0.5;
            continue;
        }
        part = f64::min(1.0, part * 1.5);
        (point, here, gone) = (next, there, gone + step);
    }
    None
}

/// About where the axis meets the set of a power, measured.
fn polar_height(power: f64) -> f64 {
    match power {
        16.0 => 0.96,
        8.0 => 0.86,
        _ => 1.09,
    }
}

/// Where lines start and lead: anywhere, in the plane of the equator, along the axis, or close
/// beside it.
fn line(kind: &str, power: f64, random: &mut Random) -> (DVec3, DVec3) {
    let (mut from, mut to) = (2.0 * random.in_ball(1.0).normalize(), random.in_ball(0.6));
    match kind {
        "axis" => return (DVec3::Z * 2.0, DVec3::NEG_Z),
        "equator" => (from.z, to.z) = (0.0, 0.0),
        // Close to where the axis meets the set.
        "beside the axis" => {
            let (sin, cos) = (random.unit() * 6.3).sin_cos();
            let radius = 0.01 + 0.02 * random.unit();
            to = DVec3::new(radius * cos, radius * sin, polar_height(power));
            let down = 0.6 * random.in_ball(1.0) + DVec3::NEG_Z;
            let direction = (down.normalize() * 1e4).round() / 1e4;
            return (to - 0.5 * direction, direction);
        }
        _ => (),
    }
    // As few digits as the source of the views has.
    (from, ((to - from).normalize() * 1e4).round() / 1e4)
}

fn ways(fractal: &Mandelbulb, kind: &str, count: usize) -> Vec<Way> {
    let set = Set::new(fractal, 400);
    let mut random = Random(0x9E37_79B9_7E5A_7C15);
    let lines: Vec<_> = (0..count).map(|_| line(kind, fractal.power, &mut random)).collect();
    let found = in_parallel(&lines, |&(from, direction)| approach(&set, kind, from, direction));
    found.into_iter().flatten().collect()
}

/// What a view is like.
struct Look {
    /// Part of the pixels that hit.
    hit: f64,
    /// Part of them that change between two marches: beside each other, in steps of other lengths.
    differ: f64,
    /// Median depth in view units.
    depth: f64,
}

fn look(scene: &Scene, size: Size) -> Look {
    let looking = SetView::exact(scene, size, views::plenty(scene));
    let pixels: Vec<_> = (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| [x, y])).collect();
    let both = in_parallel(&pixels, |&pixel| {
        let centre = rays::centre(pixel);
        let beside = looking.direction(centre.map(|v| v + 1e-5));
        (looking.depth(pixel), looking.march(beside, |estimate| 0.6 * estimate.step))
    });
    let differ = both.iter().filter(|pair| match pair {
        (Some(a), Some(b)) => (a - b).abs() > looking.footprint(*a),
        (a, b) => a.is_some() != b.is_some(),
    });
    let differ = differ.count() as f64 / pixels.len() as f64;
    let mut depths: Vec<_> = both.iter().filter_map(|pair| pair.0).collect();
    depths.sort_by(f64::total_cmp);
    let hit = depths.len() as f64 / pixels.len() as f64;
    let depth = depths.get(depths.len() / 2).map_or(0.0, |depth| depth / scene.camera.view_unit());
    Look { hit, differ, depth }
}

#[test]
#[ignore = "a tool: prints anchors and what their views are like"]
fn find_views() {
    for (power, julia, kind, count) in [
        (2.0, false, "equator", 40),
        (3.0, false, "anywhere", 16),
        (8.0, false, "anywhere", 16),
        (8.0, false, "axis", 1),
        (3.0, false, "beside the axis", 12),
        (8.0, false, "beside the axis", 12),
        (16.0, false, "beside the axis", 12),
        (8.0, true, "anywhere", 16),
    ] {
        let fractal = Mandelbulb { power, julia, ..Mandelbulb::default() };
        for Way { end, direction, .. } in ways(&fractal, kind, count) {
            let position = end.each_ref().map(Real::to_decimal);
            let anchor = PrecisePoint(position.each_ref().map(|t| t.parse().expect("a number")));
            println!("power {power} julia {julia} {kind}: {position:?} toward {direction}");
            for scale in SCALES {
                let scene = views::scene(fractal.clone(), &anchor, direction, scale);
                let Look { hit, differ, depth } = look(&scene, views::SMALL);
                println!("  {scale:e}: {hit:.3} hit, {differ:.3} differ, at {depth:.2}");
            }
        }
    }
}

#[test]
#[ignore = "a tool: prints what the views are like"]
fn judge_views() {
    for anchor in ANCHORS {
        for scale in anchor.scales() {
            let Look { hit, differ, depth } = look(&anchor.scene(scale), views::SMALL);
            println!(
                "power {} {} at {scale:e}: {hit:.3} hit, {differ:.4} differ, at {depth:.2}",
                anchor.power, anchor.name
            );
        }
    }
}

#[test]
#[ignore = "a tool: prints how many steps orbits take, by the estimate they end with"]
fn lengths_of_orbits() {
    for (power, julia, kind) in [
        (2.0, false, "equator"),
        (3.0, false, "anywhere"),
        (8.0, false, "anywhere"),
        (8.0, true, "anywhere"),
        (16.0, false, "anywhere"),
        (16.0, true, "anywhere"),
    ] {
        let fractal = Mandelbulb { power, julia, ..Mandelbulb::default() };
        let found = ways(&fractal, kind, 60);
        println!("power {power} julia {julia}: {} ways", found.len());
        for digits in [2, 3, 4, 6, 9, 13, 16, 20, 24, 27, 30, 32] {
            let least = 10.0_f64.powi(-digits);
            let all = found.iter().flat_map(|way| &way.orbits);
            let near = all.filter(|orbit| (least..3.0 * least).contains(&orbit.0));
            let mut steps: Vec<_> = near.map(|orbit| orbit.1).collect();
            steps.sort_unstable();
            if let Some(most) = steps.last() {
                println!("  1e-{digits}: median {}, most {most}", steps[steps.len() / 2]);
            }
        }
    }
}
