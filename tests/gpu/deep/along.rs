//! The kernels' distance estimates and colour data along rays, from the eye to the surface, against
//! the march's.

use glam::DVec3;
use mandelight::{
    formula::mandelbulb::deep,
    gpu::device::in_parallel,
    render::{Region, space::RenderSpace},
    scene::Scene,
};
use mandelight_test_support::{
    deep::{
        arithmetic::{Number, Point, Real, sum},
        orbit::Estimate,
        rays::{SetView, centre},
        views::{self, ANCHORS},
    },
    probe::{self, Answer},
    statistics::quantile,
};

/// Parts of the way to the surface at which estimates are compared.
const PLACES: [f64; 6] = [0.1, 0.4, 0.7, 0.85, 0.95, 1.0];
/// One ray of so many pixels.
const EVERY: usize = 5;

/// A view's points as the kernels get them and as the march does: the very same ones.
struct Asked {
    /// From where the space's coordinates begin, in its units, each as exact as an f32.
    offset: DVec3,
    point: Point,
}

/// Some points along the rays that hit.
fn asked(scene: &Scene, looking: &SetView<'_>, space: &RenderSpace) -> Vec<Asked> {
    let begins = match space.reference() {
        Some(reference) => reference.anchor().0.each_ref().map(|v| Real::parse(&v.to_string())),
        None => [0.0; 3].map(Real::from_f64),
    };
    let eye = space.point(&scene.camera.position);
    let scale = Real::from_f64(space.scale());
    let pixels: Vec<_> = (0..looking.size[1])
        .flat_map(|y| (0..looking.size[0]).map(move |x| [x, y]))
        .step_by(EVERY)
        .collect();
    let found = in_parallel(&pixels, |&pixel| {
        let direction = looking.direction(centre(pixel));
        let depth = looking.depth(pixel)? / space.scale();
        Some(PLACES.map(|part| {
            let offset = (eye + part * depth * direction).as_vec3().as_dvec3();
            let way = offset.to_array().map(|v| Real::from_f64(v) * scale);
            Asked { offset, point: sum(&begins, &way) }
        }))
    });
    found.into_iter().flatten().flatten().collect()
}

fn estimates_agree(power: f64) {
    let (mut told_quickly, mut told) = (0, 0);
    for anchor in ANCHORS.iter().filter(|anchor| anchor.power == power) {
        for scale in anchor.scales() {
            let (scene, size) = (probe::with_traps(anchor.scene(scale)), views::SMALL);
            let looking = SetView::exact(&scene, size, views::plenty(&scene));
            let space = RenderSpace::of(&scene, Region::whole(views::size(scale)));
            let asked = asked(&scene, &looking, &space);
            let offsets: Vec<_> = asked.iter().map(|asked| asked.offset).collect();
            let answers = probe::ask_about(&scene, &space, &offsets).expect("the answers");
            let expected =
                in_parallel(&asked, |Asked { point, .. }| looking.set.estimate(point, scale));
            let pairs: Vec<_> = answers.iter().zip(&expected).collect();
            let view = format!("power {power} {} at {scale:e}", anchor.name);
            assert!(pairs.len() >= 60, "{view}: {} estimates", pairs.len());
            let quantiles = |off: &dyn Fn(&Answer, &Estimate) -> f64| {
                let off: Vec<_> = pairs.iter().map(|(a, e)| off(a, e)).collect();
                [0.5, 0.99].map(|part| quantile(off.clone(), part))
            };
            let off = |found: f32, expected: &Estimate| {
                let expected = expected.distance / space.scale();
                (f64::from(found) - expected).abs() / expected.max(1e-300)
            };
            let of_distance = quantiles(&|answer, expected| off(answer.distance, expected));
            // As rays ask, and careful only where they have to be.
            let of_rays = quantiles(&|answer, expected| {
                off(answer.quick_distance.unwrap_or(answer.distance), expected)
            });
            let quick = answers.iter().filter(|answer| answer.quick_distance.is_some()).count();
            let quick_part = quick as f64 / answers.len() as f64;
            // Elsewhere the two ways are one.
            if space
                .reference()
                .and_then(deep::reference_of)
                .is_some_and(|reference| !reference.rotates())
            {
                told_quickly += quick;
                told += answers.len();
            }
            let of_count = quantiles(&|answer, expected| {
                (f64::from(answer.smooth_iterations) - expected.smooth_iterations).abs()
            });
            let of_traps = quantiles(&|answer, expected| {
                let traps = answer.traps.map(f64::from);
                let off = [0, 1].map(|i| (traps[i] - expected.traps[i].min(2.0)).abs());
                f64::max(off[0], off[1])
            });
            let text = |[median, most]: [f64; 2]| format!("{median:.1e}, {most:.1e}");
            println!(
                "{view}: estimates off by {}, those of rays by {} ({quick_part:.2} quick), \
                 counts by {}, traps by {}",
                text(of_distance),
                text(of_rays),
                text(of_count),
                text(of_traps),
            );
            // Of the colours a display shows 255 steps.
            for (what, [median, most]) in [
                ("estimates", of_distance),
                ("estimates of rays", of_rays),
                ("counts", of_count),
                ("traps", of_traps),
            ] {
                assert!(median < 1e-3, "{view}: half of the {what} are off by {median}");
                assert!(most < 1e-2, "{view}: the last percent of the {what} is off by {most}");
            }
        }
    }
    assert!(told_quickly * 5 > told * 4, "power {power}: {told_quickly} of {told} are quick");
}

#[test]
fn estimates_along_rays_agree_with_the_march() {
    for power in [2.0, 3.0, 8.0, 16.0] {
        estimates_agree(power);
    }
}
