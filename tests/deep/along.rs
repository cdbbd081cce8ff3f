//! The kernels' distance estimates along rays, from the eye to the surface, against the march's.

use glam::DVec3;
use mandelight::{gpu::Gpu, render::pass::probe};

use super::{
    agree::gpu,
    arithmetic::Real,
    parallel::in_parallel,
    rays::Looking,
    views::{self, ANCHORS},
};

/// The scales of the views that are asked about: those whose points an f32 tells apart.
const ASKED: &[f64] = &[1.0, 1e-3];
/// Parts of the way to the surface at which estimates are compared.
const PLACES: [f64; 6] = [0.1, 0.4, 0.7, 0.85, 0.95, 1.0];
/// One ray of so many pixels.
const EVERY: usize = 5;

fn estimates_agree(gpu: &Gpu, power: f64) {
    for anchor in ANCHORS.iter().filter(|anchor| anchor.power == power) {
        for &scale in ASKED.iter().filter(|&&scale| scale >= anchor.deepest) {
            let (scene, size) = (anchor.scene(scale), views::SMALL);
            let looking = Looking::new(&scene, size, views::plenty(&scene));
            let pixels: Vec<_> = (0..size[1])
                .flat_map(|y| (0..size[0]).map(move |x| [x, y]))
                .step_by(EVERY)
                .collect();
            let points: Vec<_> = in_parallel(&pixels, |&pixel| {
                let direction = looking.direction(super::rays::centre(pixel));
                let depth = looking.depth(pixel)?;
                // Points that an f32 holds exactly: the march gets the very same ones.
                let at = |part| looking.at(direction, part * depth);
                let rounded =
                    |part| at(part).each_ref().map(Real::to_f64).map(|v| f64::from(v as f32));
                Some(PLACES.map(|part| DVec3::from_array(rounded(part))))
            });
            let points: Vec<_> = points.into_iter().flatten().flatten().collect();
            let answers = probe::ask(gpu, &scene, &points, true).expect("the answers");
            let expected = in_parallel(&points, |point| {
                looking.set.estimate(&point.to_array().map(Real::from_f64), scale).distance
            });
            let off = answers.iter().zip(&expected);
            let mut off: Vec<_> =
                off.map(|(a, &e)| (f64::from(a.distance) - e).abs() / e.max(1e-300)).collect();
            off.sort_by(f64::total_cmp);
            let quantile = |part: f64| off[((off.len() - 1) as f64 * part) as usize];
            let (median, most) = (quantile(0.5), quantile(0.99));
            let view = format!("power {power} {} at {scale:e}", anchor.name);
            println!("{view}: {} estimates off by {median:.1e}, {most:.1e}", off.len());
            assert!(off.len() >= 60, "{view}: {} estimates", off.len());
            assert!(median < 1e-3, "{view}: half of the estimates are off by {median}");
            assert!(most < 1e-2, "{view}: the last percent is off by {most}");
        }
    }
}

#[test]
fn estimates_along_rays() {
    let gpu = gpu();
    for power in [2.0, 3.0, 8.0, 16.0] {
        estimates_agree(&gpu, power);
    }
}
