//! Errors of pictures against the reference.
//!
//! In: a scene and each side's samples. Out: [`Errors`], and the reasons why they are too large.

use glam::{DVec3, Vec3};
use mandelight::{formula::Ray, scene::Scene};
use serde::Serialize;

use super::{
    pixels::{evenly_spaced, pixel_ray},
    reference::{Reference, ReferencePixel},
    statistics::{in_parallel, mean, quantile},
};

/// Bound of the 99th percentile of depth errors, footprints.
const MAX_DEPTH_P99: f64 = 1.5;
/// Bound of the fraction of wrong shadow bits.
const MAX_SHADOW_ERRORS: f64 = 0.03;

/// One side's sample of a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SideSample {
    /// Depth along the ray; 0 for a miss.
    pub depth: f32,
    /// Unit normal.
    pub normal: Vec3,
    /// Bit k is set if light k reaches the point.
    pub visibility: u64,
}

/// One side's errors over the compared pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Errors {
    /// Fraction of pixels that only one of side and reference hits.
    pub hits: f64,
    /// Mean depth error, footprints.
    pub depth_mean: f64,
    /// 99th percentile of depth errors, footprints.
    pub depth_p99: f64,
    /// Errors at the side's own points: those of its normals and shadow rays alone.
    pub own: SurfaceErrors,
    /// Errors against the reference's points: those of the whole picture.
    ///
    /// A depth error of a fraction of a footprint already turns a fractal's normal.
    pub there: SurfaceErrors,
}

/// Errors of normals and shadows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct SurfaceErrors {
    /// Mean angle between normals, degrees.
    pub normal_mean: f64,
    /// 95th percentile of the angles, degrees.
    pub normal_p95: f64,
    /// Fraction of visibility bits, one per light and pixel, that differ.
    pub shadows: f64,
}

impl Errors {
    /// All columns with their names.
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

    /// The reasons why a ratio does not count.
    ///
    /// A column must not be larger than the literal kernel's, nor reach its bound.
    pub fn complaints(&self, literal: &Self, normals_within_deg: f64) -> Vec<String> {
        let worse = self
            .columns()
            .into_iter()
            .zip(literal.columns())
            .filter(|((_, ours), (_, theirs))| ours > theirs)
            .map(|((name, _), _)| format!("{name} is worse than the literal kernel's"));
        let passed = [
            ("depth p99", self.depth_p99, MAX_DEPTH_P99),
            ("normal mean", self.own.normal_mean, normals_within_deg),
            ("shadow bits", self.own.shadows, MAX_SHADOW_ERRORS),
        ]
        .into_iter()
        .filter(|(_, found, limit)| found >= limit)
        .map(|(name, found, limit)| format!("{name} is {found:.3}, which is not below {limit}"));
        worse.chain(passed).collect()
    }
}

/// The reference at the compared pixels of a view.
pub struct ReferencePixels {
    reference: Reference,
    rays: Vec<Ray>,
    lights: usize,
    /// The compared pixels.
    pub pixels: Vec<[u32; 2]>,
    references: Vec<Option<ReferencePixel>>,
}

impl ReferencePixels {
    /// Computes the reference at about `count` pixels, evenly spaced.
    pub fn new(scene: &Scene, size_px: [u32; 2], count: u32) -> Self {
        let reference = Reference::new(scene, size_px);
        let pixels = evenly_spaced(size_px, count);
        let references = in_parallel(&pixels, |&pixel| reference.pixel(pixel));
        let rays = pixels.iter().map(|&pixel| pixel_ray(scene, size_px, pixel)).collect();
        Self { reference, rays, lights: scene.lights.environment.len(), pixels, references }
    }

    /// Fraction of pixels that hit the set, and fraction of their visibility bits that are set.
    pub fn coverage(&self) -> (f64, f64) {
        let hit: Vec<_> = self.references.iter().flatten().collect();
        let lit: u32 = hit.iter().map(|pixel| pixel.visibility.count_ones()).sum();
        let fraction = |a: f64, b: usize| a / b.max(1) as f64;
        (
            fraction(hit.len() as f64, self.references.len()),
            fraction(lit.into(), hit.len() * self.lights),
        )
    }

    /// Compares one side's samples of [`Self::pixels`].
    pub fn compare(&self, samples: &[SideSample]) -> Errors {
        let all: Vec<_> = samples.iter().zip(&self.references).zip(&self.rays).collect();
        let differ = all
            .iter()
            .filter(|((sample, reference), _)| (sample.depth > 0.0) != reference.is_some())
            .count();
        let both: Vec<_> = all
            .iter()
            .filter(|((sample, _), _)| sample.depth > 0.0)
            .filter_map(|((sample, reference), ray)| Some((**sample, (**reference)?, **ray)))
            .collect();
        let depths: Vec<_> = both
            .iter()
            .map(|(sample, reference, _)| {
                (f64::from(sample.depth) - reference.depth).abs() / reference.footprint
            })
            .collect();
        let there: Vec<_> =
            both.iter().map(|(_, reference, _)| (reference.normal, reference.visibility)).collect();
        let own = in_parallel(&both, |(sample, reference, ray)| {
            let point = ray.at(sample.depth.into());
            let normal = self.reference.normal(point, reference.footprint);
            (normal, self.reference.visibility(point, normal, reference.footprint))
        });
        let surface = |expected: &[(DVec3, u64)]| {
            let pairs = || both.iter().zip(expected);
            let angles: Vec<_> = pairs()
                .map(|((sample, _, _), (normal, _))| angle_deg(sample.normal.as_dvec3(), *normal))
                .collect();
            let wrong: u32 = pairs()
                .map(|((sample, _, _), (_, bits))| (sample.visibility ^ bits).count_ones())
                .sum();
            SurfaceErrors {
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

/// The angle between two vectors, degrees, exact for small ones; 0 if a vector is zero.
fn angle_deg(a: DVec3, b: DVec3) -> f64 {
    a.cross(b).length().atan2(a.dot(b)).to_degrees()
}
