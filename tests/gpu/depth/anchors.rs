//! Another anchor makes no other picture, and none at all the same, where f32 can do without.

use std::{collections::HashSet, sync::Arc};

use mandelight::{
    formula::{
        ReferenceOrbit,
        mandelbulb::{Mandelbulb, variant::Variant},
    },
    render::{Region, space::RenderSpace, uniforms::Inputs},
    scene::Scene,
};
use mandelight_test_support::{compare::difference, view::still};

use super::places::{self, Drawn, cone, drawn, found};

const SIZE: [u32; 2] = [48, 32];

/// How two pictures of the same scene differ.
#[derive(Debug)]
struct Moved {
    /// Part of the pixels whose depths are so many footprints apart, or that one alone has hit.
    moved: f64,
    /// Nine of ten normals of the others are no farther apart, degrees.
    turned_deg: f64,
    /// Mean difference of radiances, of the mean radiance.
    relit: f64,
}

fn moved(scene: &Scene, a: &Drawn, b: &Drawn, footprints: f64) -> Moved {
    let cone = cone(scene, SIZE) as f32;
    let depths = a.samples.depth.iter().zip(&b.samples.depth);
    let far = |(a, b): &(&f32, &f32)| (*a - *b).abs() > footprints as f32 * cone * a.min(**b);
    let is_hit = |index: &usize| {
        let pair = (&a.samples.depth[*index], &b.samples.depth[*index]);
        *pair.0 > 0.0 && !far(&pair)
    };
    let hits: Vec<_> = (0..a.samples.depth.len()).filter(is_hit).collect();
    assert!(hits.len() * 3 > a.samples.depth.len(), "{} hits", hits.len());
    let angle = |index: usize| {
        let [a, b] = [a, b].map(|drawn| drawn.samples.normal[index].as_dvec3());
        a.angle_between(b).to_degrees()
    };
    let mut angles: Vec<_> = hits.iter().map(|index| angle(*index)).collect();
    angles.sort_by(f64::total_cmp);
    let turned_deg = angles[angles.len() * 9 / 10];
    let sum = |film: &[[f32; 3]]| film.iter().flatten().map(|v| f64::from(*v)).sum::<f64>();
    let differences = a.film.iter().flatten().zip(b.film.iter().flatten());
    let relit = differences.map(|(a, b)| f64::from((a - b).abs())).sum::<f64>() / sum(&a.film);
    Moved {
        moved: depths.filter(|pair| far(pair)).count() as f64 / a.film.len() as f64,
        turned_deg,
        relit,
    }
}

fn sets() -> [Mandelbulb; 3] {
    let power_3 = Mandelbulb { power: 3.0, iterations: 60, ..Mandelbulb::default() };
    let julia = Mandelbulb { julia: true, ..Mandelbulb::default() };
    [power_3, Mandelbulb::default(), julia]
}

#[test]
fn another_anchor_moves_nothing() {
    for fractal in sets() {
        for scale in [1e-4, 1e-6, 1e-13, 1e-20, 1e-27] {
            let scene = places::at(fractal.clone(), scale);
            let other = |ndc: [f64; 2]| -> Arc<dyn ReferenceOrbit> {
                places::anchor_at(&scene, SIZE, ndc.into()).expect("a surface there")
            };
            let first = drawn(&scene, SIZE, &places::about(found(&scene, SIZE), &scene));
            for ndc in [[0.7, 0.6], [-0.6, -0.8]] {
                let reference = other(ndc);
                let again = drawn(&scene, SIZE, &places::about(reference, &scene));
                // A tenth of a pixel, which is two footprints wide.
                let moved = moved(&scene, &first, &again, 0.2);
                println!("power {} at {scale:e} about {ndc:?}: {moved:?}", fractal.power);
                let Moved { moved, turned_deg, relit } = moved;
                assert!(moved <= 0.01, "{scale:e}: {moved} of the pixels move");
                // Steps reckon with what the anchor knows of directions across the ray's, so that a hit may
                // lie some hundredths of a pixel beside the other, where the surface is turned otherwise.
                assert!(turned_deg < 1.0, "{scale:e}: normals turn by {turned_deg}");
                assert!(relit < 0.02, "{scale:e}: light changes by {relit}");
            }
        }
    }
}

/// Where f32 holds without an anchor, the two ways agree.
#[test]
fn an_anchor_changes_nothing_where_none_is_needed() {
    for fractal in &sets() {
        for scale in [1e-3, 3e-3] {
            let scene = places::at(fractal.clone(), scale);
            let plain = drawn(&scene, SIZE, &places::plain(&scene));
            let deep = drawn(&scene, SIZE, &places::about(found(&scene, SIZE), &scene));
            let moved = moved(&scene, &plain, &deep, 0.2);
            println!("power {} julia {} at {scale:e}: {moved:?}", fractal.power, fractal.julia);
            // Each way has other steps, so that thin lips are met by one way alone.
            assert!(moved.moved <= 0.0125, "{scale:e}: {moved:?}");
            assert!(moved.turned_deg < 1.0, "{scale:e}: {moved:?}");
            assert!(moved.relit < 0.02, "{scale:e}: {moved:?}");
        }
    }
}

/// In a dive the picture that is the first to have an anchor differs from the one before by no
/// more than others do.
#[test]
fn a_dive_hands_over_without_a_jump() {
    /// From each picture to the next.
    const NEARER: f64 = 0.99;
    let is_deep = |scale: f64| {
        let scene = places::scene(scale);
        RenderSpace::of(&scene, Region::whole(SIZE)).reference().is_some()
    };
    let mut scale = 3e-3;
    while !is_deep(NEARER * scale) {
        scale *= NEARER;
    }
    let frames: Vec<_> = (-4..=5)
        .map(|frame| {
            let mut scene = places::scene(scale * NEARER.powi(frame));
            scene.quality.samples = 4;
            still(&scene, SIZE)
        })
        .collect();
    let steps: Vec<_> = frames.windows(2).map(|pair| difference(&pair[0], &pair[1]).0).collect();
    println!("hands over at {scale:e}: {steps:.2?}");
    let (before, after) = (&steps[..4], &steps[5..]);
    let most = before.iter().chain(after).fold(0.0, |a, b| f64::max(a, *b));
    assert!(steps[4] <= 1.05 * most, "a step of {} between others of {most}", steps[4]);
}

/// On the way down orbits take ever more perturbed steps, then a series approximation and perturbed steps.
/// Where one form hands over to the next, both draw the same.
#[test]
fn every_hand_over_draws_the_same() {
    for fractal in &sets() {
        let key = |scale: f64| {
            let scene = places::at(fractal.clone(), scale);
            let space = places::about(found(&scene, SIZE), &scene);
            Variant::from_number(
                Inputs::about(&scene, Region::whole(SIZE), &space).formula.kernel.variant,
            )
        };
        let scales: Vec<_> = (0..26).map(|i| 1e-2 * 0.5_f64.powi(i)).collect();
        let mut forms = HashSet::new();
        for pair in scales.windows(2) {
            let (mut above, end) = (pair[0], pair[1]);
            let last = key(end);
            forms.insert(last);
            // There may be several between the two.
            while key(above) != last {
                let (old, mut below) = (key(above), end);
                for _ in 0..20 {
                    let middle = (above * below).sqrt();
                    *(if key(middle) == old { &mut above } else { &mut below }) = middle;
                }
                let [a, b] = [above, below].map(|scale| {
                    let scene = places::at(fractal.clone(), scale);
                    drawn(&scene, SIZE, &places::about(found(&scene, SIZE), &scene))
                });
                let moved = moved(&places::at(fractal.clone(), below), &a, &b, 0.2);
                let what = format!("{old} to {} at {below:e}: {moved:?}", key(below));
                println!("{what}");
                // Where orbits pass the origin soon after a series, its error grows: 1.4 % at most, all
                // other hand-overs 0.5 %.
                assert!(moved.moved <= 0.015, "{what}");
                // Another series, other steps: a hit may lie some hundredths of a pixel beside the other.
                assert!(moved.turned_deg < 1.5, "{what}");
                assert!(moved.relit < 0.025, "{what}");
                above = below;
            }
        }
        assert!(forms.len() >= 3, "power {}: {forms:?}", fractal.power);
    }
}
