//! Colour layers: orbit traps of every shape, and the channels of formulas.

use glam::{DVec3, Vec4Swizzles as _};
use mandelight::{
    formula::{self, Fractal, mandelbulb::Mandelbulb},
    fractal::FractalModel,
    scene::{Axis, ColorSource, Coloring, Scene},
};
use mandelight_test_support::{
    oracle::{estimate, folds, light, orbits::Orbits},
    probe::{self, Answer},
    random::Random,
    statistics::quantile,
};

fn fractal(id: &str) -> Fractal {
    Fractal::new(formula::find(id).expect("a formula"))
}

/// Radius of a sphere that holds the set.
fn radius(fractal: &Fractal) -> f64 {
    FractalModel::new(fractal).bounding_radius()
}

fn points(count: usize, radius: f64) -> Vec<DVec3> {
    let mut random = Random(0x5EED_0FC0_1025);
    (0..count).map(|_| random.in_ball(radius).as_vec3().as_dvec3()).collect()
}

#[test]
fn orbit_traps_of_every_shape_agree_with_the_oracle() {
    let by =
        |source, axis, center, size| Coloring { source, axis, center, size, ..Coloring::default() };
    let pairs = [
        (
            by(ColorSource::PointTrap, Axis::Z, [0.4, -0.3, 0.2], 1.0),
            by(ColorSource::SphereTrap, Axis::Z, [0.1, 0.2, -0.3], 0.6),
        ),
        (
            by(ColorSource::AxisTrap, Axis::X, [0.0, 0.2, 0.3], 1.0),
            by(ColorSource::CubeTrap, Axis::Z, [-0.1, 0.3, 0.0], 0.5),
        ),
        (
            by(ColorSource::PlaneTrap, Axis::Y, [0.0, 0.25, 0.0], 1.0),
            by(ColorSource::AxisTrap, Axis::Y, [0.5, 0.0, 0.0], 1.0),
        ),
    ];
    for id in ["mandelbulb", "mandelbox", "quaternion_julia"] {
        for (first, second) in &pairs {
            let mut scene = Scene { fractal: fractal(id), ..Scene::default() };
            scene.surface.coloring = first.clone();
            scene.surface.second_layer.coloring = second.clone();
            scene.surface.second_layer.amount = 0.5;
            let points = points(2000, 0.8 * radius(&scene.fractal));
            let answers = probe::ask(&scene, &points, false).expect("answers");
            let (orbit, scale) = (escaping_orbits(&scene.fractal), trap_scale(&scene));
            let mut off = Vec::new();
            for (&point, answer) in points.iter().zip(&answers) {
                let Some(seen) = orbit(point) else { continue };
                for (found, coloring) in answer.traps.into_iter().zip([first, second]) {
                    let expected = seen.iter().map(|&z| light::trap_distance(coloring, z));
                    let expected = (scale * expected.fold(f64::INFINITY, f64::min)).min(2.0);
                    off.push((f64::from(found) - expected).abs());
                }
            }
            assert!(off.len() > 500, "{id}: {} values", off.len());
            let most = quantile(off, 0.98);
            assert!(most < 1e-3, "{id}, {:?}: off by {most}", first.source);
        }
    }
}

/// Gives orbits' points after the start, of orbits that escape.
fn escaping_orbits(fractal: &Fractal) -> Box<dyn Fn(DVec3) -> Option<Vec<DVec3>>> {
    if fractal.formula().id() == "mandelbulb" {
        let bulb = Mandelbulb::of(fractal);
        return Box::new(move |point| {
            let orbit = estimate::orbit(&bulb, point);
            (orbit.r > bulb.bailout).then_some(orbit.points)
        });
    }
    let orbits = Orbits::of(fractal);
    Box::new(move |point| {
        let end = orbits.orbit(point);
        end.escaped.then(|| end.points.iter().map(|z| z.xyz()).collect())
    })
}

/// Large sets have their traps scaled to the range of colours.
fn trap_scale(scene: &Scene) -> f64 {
    if scene.fractal.formula().id() == "mandelbulb" {
        return 1.0;
    }
    (2.0 / radius(&scene.fractal)).min(1.0)
}

#[test]
fn channels_count_the_folds_of_the_equations() {
    for id in ["mandelbox", "kaleidoscopic_octahedron"] {
        let fractal = fractal(id);
        let scene = Scene { fractal: fractal.clone(), ..Scene::default() };
        let points = points(2000, 0.8 * radius(&fractal));
        let answers = probe::ask(&scene, &points, false).expect("answers");
        let off = |(&point, answer): (&DVec3, &Answer)| {
            let count = if id == "mandelbox" { box_folds } else { mirrors };
            let (folds, steps) = count(&fractal, point)?;
            Some((f64::from(answer.channel) - folds / f64::from(steps.max(1))).abs())
        };
        let off: Vec<_> = points.iter().zip(&answers).filter_map(off).collect();
        assert!(off.len() > 500, "{id}: {}", off.len());
        // A fold within rounding of its limit may count differently.
        let most = quantile(off, 0.98);
        assert!(most < 1e-5, "{id}: off by {most}");
    }
}

/// Components beyond the fold limit, and inversions, with the steps of an orbit that escapes.
fn box_folds(fractal: &Fractal, point: DVec3) -> Option<(f64, u32)> {
    let number = |name: &str| fractal.number(name).expect("a number");
    let (limit, scale) = (number("fold_limit"), number("scale"));
    let (mut z, mut folds) = (point, 0.0);
    for steps in 0..fractal.iterations {
        if z.length() > fractal.bailout {
            return Some((folds, steps));
        }
        folds += z.to_array().into_iter().filter(|x| x.abs() > limit).count() as f64;
        z = folds::box_folded(z, DVec3::splat(limit));
        let factor = folds::sphere_factor(z, number("inner_radius"), number("outer_radius"));
        folds += if factor > 1.0 { 1.0 } else { 0.0 };
        z = scale * factor * z + point;
    }
    None
}

/// Mirrors that an orbit is behind.
fn mirrors(fractal: &Fractal, point: DVec3) -> Option<(f64, u32)> {
    let scale = fractal.number("scale").expect("a number");
    let offset = folds::vec3(fractal, "offset");
    let (mut z, mut count) = (point, 0.0);
    for steps in 0..fractal.iterations {
        if z.length() > fractal.bailout {
            return Some((count, steps));
        }
        z = folds::turned(fractal, z);
        for normal in [[1, -1, 0], [1, 1, 0], [1, 0, -1], [1, 0, 1]] {
            let normal = DVec3::from_array(normal.map(f64::from)).normalize();
            count += if z.dot(normal) < 0.0 { 1.0 } else { 0.0 };
            z = folds::mirrored(z, normal);
        }
        z = scale * z - (scale - 1.0) * offset;
    }
    None
}
