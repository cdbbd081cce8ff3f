//! Whole views of every formula of a text: hits, depths and normals against the equations in f64.

use super::formulas::gradient;
use glam::{DMat3, DVec3};
use mandelight::{
    formula::section::SectionPlane,
    gpu::device::in_parallel,
    render::Pace,
    scene::{Camera, Normals, Scene, presets},
};
use mandelight_test_support::{
    oracle::{formula_rays::FormulaRays, rays::cone},
    statistics::quantile,
    view::{finished, sampled},
};

/// Factors of the hit distance at which the oracle's ray ends: earliest, latest.
///
/// A step from outside the hit distance may end beyond a corner that the ray passes within it; nothing that the
/// ray passes within half of it may be missed. Along an edge, estimates that differ by a thousandth end far apart.
const HIT_FACTORS: [f64; 2] = [1.05, 0.5];
/// Width and height of every picture.
const SIZE: [u32; 2] = [48, 32];
/// The formula's scene, and a view from the other side and closer.
fn views(scene: &Scene) -> [Scene; 2] {
    let mut scene = sampled(scene.clone(), 1);
    scene.quality.normals = Normals::Analytic;
    scene.lights.environment.clear();
    let mut other = scene.clone();
    let pivot = scene.camera.pivot.to_dvec3();
    let away = scene.camera.position.to_dvec3() - pivot;
    let turned = DMat3::from_rotation_z(2.2) * away * 0.8;
    let eye = pivot + turned + DVec3::new(0.0, 0.0, -0.1);
    let vertical_fov_deg = scene.camera.vertical_fov_deg;
    other.camera = Camera { vertical_fov_deg, ..Camera::looking_at(eye, pivot, DVec3::Z) };
    [scene, other]
}

/// The normal of the section plane that `point` lies on.
fn on_section(scene: &Scene, point: DVec3, depth: f64) -> Option<DVec3> {
    let mut planes = scene.fractal.section_planes.iter();
    let found = planes
        .find(|plane| (point - plane.point.to_dvec3()).dot(plane.normal()).abs() < 1e-6 * depth);
    found.map(SectionPlane::normal)
}

/// What differs between a view and the oracle.
struct Differences {
    /// Part of the pixels that hit.
    hit: f64,
    /// Part of the pixels that only the view or only the oracle hits.
    one_sided: f64,
    /// 99th percentile of the depths' differences, in footprints.
    depth: f64,
    /// Median angle between the normals, degrees.
    normal_deg: f64,
}

/// The largest differences that pass.
struct Limits {
    one_sided: f64,
    depth: f64,
    normal_deg: f64,
}

impl Differences {
    /// Prints the differences; an error if one is over its limit, or if hardly a pixel hits.
    fn check(&self, name: &str, limits: &Limits) -> Result<(), String> {
        let Self { hit, one_sided, depth, normal_deg } = self;
        let line = format!(
            "{name}: {hit:.2} hit, {one_sided:.4} one-sided, depth p99 {depth:.2} footprints, \
             normals {normal_deg:.3}°"
        );
        println!("{line}");
        let is_good = *hit >= 0.05
            && *one_sided <= limits.one_sided
            && *depth <= limits.depth
            && *normal_deg <= limits.normal_deg;
        if is_good { Ok(()) } else { Err(line) }
    }
}

fn differences(scene: &Scene) -> Differences {
    let view = finished(scene, SIZE, Pace::Still);
    let samples = view.gbuffer().expect("samples");
    let rays = FormulaRays::new(scene, SIZE);
    let indexed: Vec<u32> = (0..SIZE[0] * SIZE[1]).collect();
    let expected = in_parallel(&indexed, |&i| {
        let pixel = [i % SIZE[0], i / SIZE[0]];
        let depth = f64::from(samples.depth[i as usize]);
        let normal = (depth > 0.0)
            .then(|| {
                let point = rays.at(pixel, depth);
                let on_plane = on_section(scene, point, depth);
                on_plane.or_else(|| gradient(&rays.orbits, point, 1e-8 * depth))
            })
            .flatten();
        (HIT_FACTORS.map(|factor| rays.march(pixel, factor)), normal)
    });
    let count = expected.len() as f64;
    let (mut depths, mut normals, mut hits, mut one_sided) = (vec![], vec![], 0, 0);
    for (i, ([first, last], normal)) in expected.into_iter().enumerate() {
        let depth = f64::from(samples.depth[i]);
        hits += u32::from(depth > 0.0);
        if depth == 0.0 {
            one_sided += u32::from(last.is_some());
            continue;
        }
        let Some(first) = first else {
            one_sided += 1;
            continue;
        };
        let (early, late) = (first - depth, depth - last.unwrap_or(f64::INFINITY));
        let off = early.max(late).max(0.0);
        depths.push(off / (cone(&scene.camera, SIZE) * first));
        let found = samples.normal[i].as_dvec3();
        normals.extend(normal.map(|normal| found.angle_between(normal).to_degrees()));
    }
    Differences {
        hit: f64::from(hits) / count,
        one_sided: f64::from(one_sided) / count,
        depth: quantile(depths, 0.99),
        normal_deg: quantile(normals, 0.5),
    }
}

#[test]
fn views_of_every_formula_agree_with_the_oracle() {
    let mut failures = Vec::new();
    for preset in presets::formulas() {
        let scene = (preset.scene)();
        for (number, view) in views(&scene).iter().enumerate() {
            let limits = Limits { one_sided: 0.005, depth: 2.0, normal_deg: 1.0 };
            failures.extend(
                differences(view).check(&format!("{} {number}", preset.name), &limits).err(),
            );
        }
    }
    assert!(failures.is_empty(), "{failures:#?}");
}

/// A plane through `point`.
fn plane(point: [f64; 3], direction: DVec3, band_reach: f64) -> SectionPlane {
    let direction = direction.normalize().to_array();
    SectionPlane { point: DVec3::from_array(point).into(), direction, band_reach }
}

#[test]
fn views_of_cut_sets_agree_with_the_oracle() {
    let oblique = plane([0.05, 0.0, 0.1], DVec3::new(0.5, -1.0, 0.7), 0.0);
    let corner = vec![
        plane([0.1, 0.0, 0.0], DVec3::X, 0.0),
        plane([0.0, -0.1, 0.0], DVec3::NEG_Y, 0.05),
        plane([0.0, 0.0, 0.2], DVec3::Z, 0.0),
    ];
    let front = plane([0.0; 3], DVec3::NEG_Y, 0.1);
    let limits = Limits { one_sided: 0.005, depth: 2.0, normal_deg: 0.1 };
    let mut failures = Vec::new();
    for (id, planes) in [
        ("quaternion_julia", vec![front]),
        ("mandelbox", vec![oblique.clone()]),
        ("menger_sponge", corner.clone()),
        ("quaternion_mandelbrot", corner),
        ("juliabulb", vec![oblique]),
    ] {
        let preset = presets::formulas()
            .iter()
            .find(|preset| (preset.scene)().fractal.formula().id() == id)
            .expect("a scene");
        for (number, mut view) in views(&(preset.scene)()).into_iter().enumerate() {
            view.fractal.section_planes.clone_from(&planes);
            failures.extend(differences(&view).check(&format!("{id} {number}"), &limits).err());
        }
    }
    assert!(failures.is_empty(), "{failures:#?}");
}
