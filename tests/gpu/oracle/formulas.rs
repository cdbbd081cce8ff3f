//! The kernels that are made from texts, against the oracle's own equations.

use glam::DVec3;
use mandelight::{
    formula::{self, Fractal},
    gpu::device::in_parallel,
    scene::Scene,
};
use mandelight_test_support::{oracle::formulas, probe, random::Random, statistics::quantile};

/// The direction whose derivative the kernels carry where a text gives none and no ray passes.
const ANY_DIRECTION: DVec3 = DVec3::new(0.48, 0.6, 0.64);

/// The fractals that are compared: each text as it is, with other values, and in its Julia form.
fn fractals() -> Vec<Fractal> {
    let mut all = Vec::new();
    for (id, _) in formula::texts() {
        let fractal = Fractal::new(formula::find(id).expect("a formula"));
        let mut other = fractal.clone();
        let turned = other.set("rotation", [10.0, -20.0, 35.0])
            | other.set("power", 3.4)
            | other.set("slice", 0.2)
            | other.set("inner_radius", 0.4)
            | other.set("shift", [0.1, -0.05, 0.02]);
        all.extend(turned.then_some(other));
        let mut julia = fractal.clone();
        all.extend(julia.set("julia", true).then_some(julia));
        all.push(fractal);
    }
    all
}

fn points(fractal: &Fractal, count: usize) -> Vec<DVec3> {
    let radius = 1.1 * fractal.formula().distance_field(fractal).bounding_radius();
    let mut random = Random(0x0DDB_1A5E_5BAD_5EED);
    // Points that an f32 holds exactly: the oracle gets the very same ones.
    (0..count).map(|_| random.in_ball(radius).as_vec3().as_dvec3()).collect()
}

#[test]
fn texts_agree_with_the_oracle_at_random_points() {
    let mut failures = Vec::new();
    for fractal in fractals() {
        let scene = Scene { fractal: fractal.clone(), ..Scene::default() };
        let points = points(&fractal, 3000);
        let answers = probe::ask(&scene, &points, true).expect("answers");
        let field = fractal.formula().distance_field(&fractal);
        let expected = in_parallel(&points, |&point| {
            let moved = point + DVec3::splat(1e-6 * point.length());
            let [here, beside] =
                [point, moved].map(|point| formulas::distance(&fractal, point, ANY_DIRECTION));
            (here, (beside - here).abs(), formulas::orbit(&fractal, point, ANY_DIRECTION))
        });
        let (mut off, mut host_off, mut color_off) = (Vec::new(), Vec::new(), Vec::new());
        for ((point, answer), (distance, sensitivity, end)) in
            points.iter().zip(&answers).zip(expected)
        {
            assert!(answer.distance.is_finite() && answer.step <= answer.distance, "{point}");
            // A point whose estimate is that sensitive is as uncertain in single precision.
            if distance < 1e-3
                || sensitivity > 1e-3 * distance
                || end.uncertain.is_nan()
                || end.uncertain > 1e-6
            {
                continue;
            }
            off.push((f64::from(answer.distance) - distance).abs() / distance);
            host_off.push((field.distance(*point) - distance).abs() / distance);
            if end.escaped {
                let smooth = f64::from(answer.smooth_iterations);
                color_off.push((smooth - end.smooth_iterations).abs());
            }
        }
        let name = format!("{} {:?}", fractal.formula().id(), fractal.values());
        // Of some Julia forms nothing remains.
        if off.len() < 300 && fractal.is_on("julia") {
            continue;
        }
        if off.len() < 300 {
            failures.push(format!("{name}: {} points", off.len()));
            continue;
        }
        let (most, host) = (quantile(off.clone(), 0.99), quantile(host_off, 0.999));
        let colors = if color_off.len() > 100 { quantile(color_off, 0.99) } else { 0.0 };
        if most > 1e-4 || host > 3e-5 || colors > 2e-3 {
            failures.push(format!(
                "{name}: estimates {most:.1e}, host {host:.1e}, colours {colors:.1e}"
            ));
        }
    }
    assert!(failures.is_empty(), "\n{}", failures.join("\n"));
}

#[test]
fn gradients_of_texts_agree_with_the_oracle() {
    let mut failures = Vec::new();
    for fractal in fractals() {
        let scene = Scene { fractal: fractal.clone(), ..Scene::default() };
        let points = points(&fractal, 2000);
        let answers = probe::ask(&scene, &points, true).expect("answers");
        let derived = formulas::is_derived(&fractal);
        let expected = in_parallel(&points, |&point| gradient(&fractal, point, derived));
        let pairs = answers.iter().zip(expected).filter_map(|(answer, expected)| {
            Some(expected?.angle_between(answer.gradient.as_dvec3()).to_degrees())
        });
        let off: Vec<_> = pairs.collect();
        let name = format!("{} {:?}", fractal.formula().id(), fractal.values());
        if off.len() < 200 && fractal.is_on("julia") {
            continue;
        }
        if off.len() < 200 {
            failures.push(format!("{name}: {} gradients", off.len()));
            continue;
        }
        let (median, most) = (quantile(off.clone(), 0.5), quantile(off, 0.97));
        if median > 0.01 || most > 1.0 {
            failures.push(format!("{name}: gradients off by {median:.1e}°, {most:.1e}°"));
        }
    }
    assert!(failures.is_empty(), "\n{}", failures.join("\n"));
}

/// The gradient by central differences; none where two spacings disagree, as at an edge.
fn gradient(fractal: &Fractal, point: DVec3, derived: bool) -> Option<DVec3> {
    let distance = formulas::distance(fractal, point, ANY_DIRECTION);
    if distance < 1e-3 {
        return None;
    }
    let steps = formulas::orbit(fractal, point, ANY_DIRECTION).steps;
    let value = |point: DVec3| {
        if derived {
            formulas::height(fractal, point, steps)
        } else {
            formulas::distance(fractal, point, ANY_DIRECTION)
        }
    };
    let slope = |spacing: f64| {
        let along = |axis: DVec3| value(point + spacing * axis) - value(point - spacing * axis);
        DVec3::new(along(DVec3::X), along(DVec3::Y), along(DVec3::Z)).try_normalize()
    };
    let (fine, coarse) = (slope(1e-5 * distance)?, slope(1e-4 * distance)?);
    (fine.angle_between(coarse) < 1e-3).then_some(fine)
}
