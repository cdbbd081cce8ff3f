//! The field about an anchor in f64, on the polar axis and hard beside it, where even powers leave
//! differences nothing but longitudes.

use std::sync::Arc;

use glam::{DVec2, DVec3};
use mandelight::{
    formula::{
        DistanceField,
        mandelbulb::{
            Mandelbulb,
            deep::{DeepField, FINEST_FOOTPRINT, Reference},
        },
    },
    fractal::{Search, camera_ray},
    gpu::device::in_parallel,
    scene::PrecisePoint,
};
use mandelight_test_support::{
    deep::{
        arithmetic::{Number, Real, moved},
        orbit::Set,
        views,
    },
    statistics::quantile,
};

/// From how far away estimates are asked for.
const SCALES: [f64; 5] = [1e-6, 1e-9, 1e-13, 1e-20, 1e-27];

/// Parts of the way to the surface.
const PLACES: [f64; 6] = [0.1, 0.4, 0.7, 0.85, 0.95, 1.0];

/// How far from the axis anchors are.
const RADII: [f64; 4] = [0.0, 1e-9, 1e-5, 1e-3];

/// The point of the surface that is first met down a parallel to the axis.
fn anchor_under(fractal: &Mandelbulb, radius: f64) -> PrecisePoint {
    let set = Set::new(fractal, 400);
    let across = radius * DVec2::from_angle(0.7);
    let mut point = across.extend(1.6).to_array().map(Real::from_f64);
    let mut distance = set.estimate(&point, 1e-2).distance;
    let mut part = 0.2;
    while distance > 1e-33 {
        let next = moved(&point, DVec3::NEG_Z * (part * distance).min(0.05));
        let there = set.estimate(&next, 1e-2 * distance).distance;
        if there == 0.0 {
            part *= 0.5;
        } else {
            (point, distance) = (next, there);
            part = f64::min(0.2, part * 1.5);
        }
    }
    PrecisePoint(point.map(|v| v.to_decimal().parse().expect("a decimal number")))
}

/// Offsets along rays to the surface about `anchor`, for eyes that are `scale` away from it.
fn offsets(
    field: &DeepField,
    fractal: &Mandelbulb,
    anchor: &PrecisePoint,
    scale: f64,
) -> Vec<DVec3> {
    let scene = views::scene(fractal.clone(), anchor, DVec3::NEG_Z, scale);
    let mut offsets = vec![];
    for i in 0..20 {
        let ndc = 0.2 * f64::from(i).sqrt() * DVec2::from_angle(2.4 * f64::from(i));
        let ray = camera_ray(&scene.camera, anchor, ndc, 1.5);
        let mut depth = 0.0;
        for _ in 0..2000 {
            let estimate = field.estimate(ray.at(depth));
            if estimate.distance < 1e-3 * depth {
                offsets.extend(PLACES.map(|part| ray.at(part * depth)));
                break;
            }
            depth += estimate.step;
        }
    }
    offsets
}

/// Holds the field about points to the estimates of 192 bits, from all scales.
fn field_agrees(fractal: &Mandelbulb, radii: &[f64], name: &str) {
    let set = Set::new(fractal, 400);
    for (&radius, anchor) in radii.iter().zip(in_parallel(radii, |&r| anchor_under(fractal, r))) {
        let begins = anchor.0.each_ref().map(|v| Real::parse(&v.to_string()));
        let reference = Arc::new(Reference::new(fractal, anchor.clone()).expect("a whole power"));
        assert!(reference.rotates(), "{name}");
        // Of one that stays, points nearby cannot be told apart.
        let last = reference.points().last().expect("the anchor itself");
        let has_left = last.z.length() > fractal.bailout;
        for scale in SCALES {
            let field = DeepField::new(reference.clone(), fractal, FINEST_FOOTPRINT);
            let field = field.with_grain(1e-3 * scale);
            let offsets = offsets(&field, fractal, &anchor, scale);
            let off = in_parallel(&offsets, |&offset| {
                let expected = set.estimate(&moved(&begins, offset), scale).distance;
                (field.distance(offset) - expected).abs() / expected.max(1e-4 * scale)
            });
            let part = |part: f64| quantile(off.clone(), part);
            let view = format!("{name}, {radius:e} from the axis, at {scale:e}");
            println!("{view}: {} off by {:.1e}, {:.1e}", off.len(), part(0.5), part(0.99));
            assert!(off.len() >= 60, "{view}: {} estimates", off.len());
            assert!(!has_left || part(0.5) < 1e-6, "{view}: half of them by {}", part(0.5));
            // Beside the axis, sheets get thinner than numbers tell before the view is deepest.
            let is_told = radius == 0.0 || scale > 1e-20;
            assert!(!is_told || part(0.99) < 1e-2, "{view}: the last percent by {}", part(0.99));
        }
    }
}

/// Estimates in f64 against those of 192 bits, about points as near to the axis as one likes.
#[test]
fn estimates_beside_the_axis_agree_with_the_march() {
    for power in [4.0, 8.0, 16.0] {
        let fractal = Mandelbulb { power, ..Mandelbulb::default() };
        field_agrees(&fractal, &RADII, &format!("power {power}"));
    }
}

/// The same of Julia sets whose constant is by the axis too.
#[test]
fn estimates_of_julia_sets_beside_the_axis_agree_with_the_march() {
    for julia_constant in [[0.0, 0.0, 0.4], [3e-6, -4e-6, 0.4]] {
        let fractal =
            Mandelbulb { power: 8.0, julia: true, julia_constant, ..Mandelbulb::default() };
        field_agrees(&fractal, &RADII, &format!("constant {julia_constant:?}"));
    }
}

/// Searches end on the surface there, from all scales.
#[test]
fn anchors_beside_the_axis_lie_on_the_surface() {
    for power in [8.0, 16.0] {
        let fractal = Mandelbulb { power, ..Mandelbulb::default() };
        let set = Set::new(&fractal, 400);
        let on_axis = anchor_under(&fractal, 0.0);
        for toward in [DVec3::NEG_Z, DVec3::new(0.3, -0.2, -0.9)] {
            for scale in SCALES {
                let scene = views::scene(fractal.clone(), &on_axis, toward, scale);
                let search =
                    Search::new(&fractal.clone().into(), &scene.camera, 1.5, None).expect("whole");
                let anchor = search.finish().anchor().clone();
                let depth = (&scene.camera.position - &anchor).length();
                let point = anchor.0.each_ref().map(|v| Real::parse(&v.to_string()));
                let distance = set.estimate(&point, scale).distance;
                let view = format!("power {power} along {toward} at {scale:e}");
                println!("{view}: {} away, {:e} from the surface", depth / scale, distance / depth);
                assert!(0.1 * scale < depth && depth < 3.0 * scale, "{view}: {depth:e} away");
                assert!(distance < 1e-5 * depth, "{view}: {distance:e} at {depth:e}");
            }
        }
    }
}
