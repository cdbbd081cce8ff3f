//! How far pictures are from the reference.

use glam::{DVec3, Vec3};
use mandelight::{fractal::Ray, scene::Scene};
use serde::Serialize;

use super::{
    pixels::{pixel_ray, spread},
    reference::{Reference, Truth},
    statistics::{in_parallel, mean, quantile},
};

/// What 99 % of the depths have to stay within, footprints.
const DEPTH_P99_WITHIN: f64 = 1.5;
/// Part of the shadow bits that may differ.
const SHADOWS_WITHIN: f64 = 0.03;

/// What one side says of a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shown {
    /// Depth along the ray; 0 where it met nothing.
    pub depth: f32,
    /// Unit normal.
    pub normal: Vec3,
    /// A bit a light that reaches the point.
    pub visibility: u64,
}

/// One side's errors on the pixels that were compared.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Errors {
    /// Part of the pixels that are hit by one of side and reference only.
    pub hits: f64,
    /// Depth, footprints: the mean.
    pub depth_mean: f64,
    /// What 99 % of the depths stay within.
    pub depth_p99: f64,
    /// Normals and shadows at the side's own points: what its normal and shadow rays do wrong.
    pub own: Surface,
    /// The same against what the reference sees at its own points: what is wrong in the picture.
    /// Even a part of a footprint's difference in depth turns a normal there.
    pub there: Surface,
}

/// Errors of normals and shadows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Surface {
    /// Angle between normals, degrees: the mean.
    pub normal_mean: f64,
    /// What 95 % of them stay within.
    pub normal_p95: f64,
    /// Part of the bits, one a light and pixel, that differ.
    pub shadows: f64,
}

impl Errors {
    /// Every column by name.
    pub fn columns(&self) -> [(&'static str, f64); 9] {
        [
            ("hit or miss", self.hits),
            ("depth mean", self.depth_mean),
            ("depth p99", self.depth_p99),
            ("normal mean", self.own.normal_mean),
            ("normal p95", self.own.normal_p95),
            ("shadow bits", self.own.shadows),
            ("normal mean there", self.there.normal_mean),
            ("normal p95 there", self.there.normal_p95),
            ("shadow bits there", self.there.shadows),
        ]
    }

    /// What keeps a ratio from counting: each column that is worse than the literal kernel's, and
    /// each limit that is passed.
    pub fn complaints(&self, literal: &Self, normals_within_deg: f64) -> Vec<String> {
        let worse = self
            .columns()
            .into_iter()
            .zip(literal.columns())
            .filter(|((_, ours), (_, theirs))| ours > theirs)
            .map(|((name, _), _)| format!("{name} is worse than the literal kernel's"));
        let passed = [
            ("depth p99", self.depth_p99, DEPTH_P99_WITHIN),
            ("normal mean", self.own.normal_mean, normals_within_deg),
            ("shadow bits", self.own.shadows, SHADOWS_WITHIN),
        ]
        .into_iter()
        .filter(|(_, found, limit)| found >= limit)
        .map(|(name, found, limit)| format!("{name} is {found:.3}, which is not below {limit}"));
        worse.chain(passed).collect()
    }
}

/// The reference's pixels of a view.
pub struct Truths {
    reference: Reference,
    rays: Vec<Ray>,
    lights: usize,
    /// The compared pixels.
    pub pixels: Vec<[u32; 2]>,
    truths: Vec<Option<Truth>>,
}

impl Truths {
    /// Looks at about `count` pixels, spread evenly.
    pub fn new(scene: &Scene, size_px: [u32; 2], count: u32) -> Self {
        let reference = Reference::new(scene, size_px);
        let pixels = spread(size_px, count);
        let truths = in_parallel(&pixels, |&pixel| reference.look(pixel));
        let rays = pixels.iter().map(|&pixel| pixel_ray(scene, size_px, pixel)).collect();
        Self { reference, rays, lights: scene.lights.environment.len(), pixels, truths }
    }

    /// Part of the pixels that are hit, and part of the bits that are set.
    pub fn coverage(&self) -> (f64, f64) {
        let hit: Vec<_> = self.truths.iter().flatten().collect();
        let lit: u32 = hit.iter().map(|truth| truth.visibility.count_ones()).sum();
        let part = |a: f64, b: usize| a / b.max(1) as f64;
        (part(hit.len() as f64, self.truths.len()), part(lit.into(), hit.len() * self.lights))
    }

    /// Compares what a side shows of [`Self::pixels`].
    pub fn compare(&self, shown: &[Shown]) -> Errors {
        let all: Vec<_> = shown.iter().zip(&self.truths).zip(&self.rays).collect();
        let differ = all.iter().filter(|((s, t), _)| (s.depth > 0.0) != t.is_some()).count();
        let both: Vec<_> = all
            .iter()
            .filter_map(|((s, t), ray)| Some((**s, (**t)?, **ray)).filter(|_| s.depth > 0.0))
            .collect();
        let depths: Vec<_> = both
            .iter()
            .map(|(s, t, _)| (f64::from(s.depth) - t.depth).abs() / t.footprint)
            .collect();
        let there: Vec<_> = both.iter().map(|(_, t, _)| (t.normal, t.visibility)).collect();
        let own = in_parallel(&both, |(s, t, ray)| {
            let point = ray.at(s.depth.into());
            let normal = self.reference.normal(point, t.footprint);
            (normal, self.reference.visibility(point, normal, t.footprint))
        });
        let surface = |expected: &[(DVec3, u64)]| {
            let pairs = || both.iter().zip(expected);
            let angles: Vec<_> = pairs()
                .map(|((s, _, _), (normal, _))| angle_deg(s.normal.as_dvec3(), *normal))
                .collect();
            let wrong: u32 =
                pairs().map(|((s, _, _), (_, bits))| (s.visibility ^ bits).count_ones()).sum();
            Surface {
                normal_mean: mean(&angles),
                normal_p95: quantile(angles, 0.95),
                shadows: f64::from(wrong) / (both.len() * self.lights).max(1) as f64,
            }
        };
        Errors {
            hits: differ as f64 / all.len().max(1) as f64,
            depth_mean: mean(&depths),
            depth_p99: quantile(depths, 0.99),
            own: surface(&own),
            there: surface(&there),
        }
    }
}

/// The angle between two vectors, degrees, exact for small ones; 0 where one of them is none.
fn angle_deg(a: DVec3, b: DVec3) -> f64 {
    a.cross(b).length().atan2(a.dot(b)).to_degrees()
}
