//! The kernels that are made from texts, against the oracle's own equations.

use glam::DVec3;
use mandelight::{
    formula::table::Value,
    formula::{self, Fractal, HybridStep, HybridSteps, hybrid},
    gpu::device::in_parallel,
    scene::Scene,
};
use mandelight_test_support::{
    oracle::orbits::Orbits, probe, random::Random, statistics::quantile,
};

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
    all.extend(hybrids());
    all
}

/// The step called `id` with values.
fn step<const N: usize>(id: &str, repeats: u32, values: [(&str, Value); N]) -> HybridStep {
    let formula = hybrid::find_step(id).expect("a step's formula");
    let mut step = hybrid::step(formula).expect("a step");
    step.repeats = repeats;
    for (name, value) in values {
        assert!(step.set(name, value), "{id} has no {name}");
    }
    step
}

fn hybrid_of(loop_start: usize, steps: Vec<HybridStep>) -> Fractal {
    hybrid::fractal(HybridSteps { steps, loop_start }).expect("a hybrid")
}

/// Hybrids of powers, folds and transforms, with given and derived derivatives, repeats and loops.
fn hybrids() -> Vec<Fractal> {
    let bulb = |power: f64| step("mandelbulb", 1, [("power", power.into())]);
    let mut julia = hybrid_of(0, vec![step("mandelbox", 1, []), bulb(3.0)]);
    assert!(julia.set("julia", true));
    let mut all = vec![
        hybrid_of(0, vec![bulb(8.0)]),
        hybrid_of(0, vec![step("mandelbulb", 1, [("negative_sine", true.into())])]),
        hybrid_of(0, vec![step("mandelbox", 1, [("scale", (-1.5).into())]), bulb(2.0)]),
        hybrid_of(1, vec![step("mandelbox", 3, []), step("amazing_surf", 2, [])]),
        hybrid_of(0, vec![step("menger_sponge", 2, []), step("sierpinski_tetrahedron", 1, [])]),
        // One of three components among four, one without dr among those with it.
        hybrid_of(0, vec![step("quaternion_julia", 1, []), step("box_fold", 1, [])]),
        hybrid_of(0, vec![step("bristorbrot", 1, []), step("mandelbulb", 1, [])]),
        hybrid_of(0, vec![step("box_fold", 1, []), step("quaternion_mandelbrot", 2, [])]),
        julia,
    ];
    for (id, _) in formula::step_texts().filter(|(id, _)| *id != "mandelbulb") {
        all.push(hybrid_of(0, vec![step(id, 1, []), bulb(4.0)]));
        all.push(hybrid_of(1, vec![step(id, 1, []), step("menger_sponge", 1, [])]));
    }
    all
}

/// A scene that shows all of `fractal`: its view needs no iterations besides the fractal's own.
fn whole(fractal: &Fractal) -> Scene {
    let radius = fractal.formula().distance_field(fractal).bounding_radius();
    let scene = Scene::default();
    Scene { fractal: fractal.clone(), camera: scene.camera.seeing_ball(radius), ..scene }
}

/// The fractal in an error's words.
fn name(fractal: &Fractal) -> String {
    let steps = fractal.hybrid().map_or(&[][..], |hybrid| &hybrid.steps);
    let steps: Vec<_> = steps.iter().map(|s| format!("{:?}×{}", s.formula(), s.repeats)).collect();
    format!("{} {:?} {steps:?}", fractal.formula().id(), fractal.values())
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
        let scene = whole(&fractal);
        let points = points(&fractal, 3000);
        let answers = probe::ask(&scene, &points, true).expect("answers");
        let field = fractal.formula().distance_field(&fractal);
        let orbits = Orbits::of(&fractal);
        let expected = in_parallel(&points, |&point| {
            let moved = point + DVec3::splat(1e-6 * point.length());
            let [here, beside] = [point, moved].map(|point| orbits.distance(point));
            (here, (beside - here).abs(), orbits.orbit(point))
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
        let name = name(&fractal);
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

/// Hybrids take the bulb's steps from a text: it gives the colours that the bulb's own kernels give.
#[test]
fn the_text_of_the_bulb_and_its_own_kernels_agree() {
    for power in [2.0, 3.0, 5.5, 8.0, 16.0] {
        for (variant, is_negative) in [("positive_sine", false), ("negative_sine", true)] {
            let mut own = Fractal::default();
            assert!(own.set("power", power) && own.set("variant", Value::Choice(variant)));
            let values = [("power", power.into()), ("negative_sine", is_negative.into())];
            let mut text = hybrid_of(0, vec![step("mandelbulb", 1, values)]);
            (text.iterations, text.bailout) = (own.iterations, own.bailout);
            let points = points(&own, 2000);
            let [own, text] = [&own, &text].map(|fractal| {
                let scene = probe::with_traps(whole(fractal));
                probe::ask(&scene, &points, true).expect("answers")
            });
            let pairs = || own.iter().zip(&text);
            let traps = pairs().map(|(a, b)| f64::from((a.traps[0] - b.traps[0]).abs())).collect();
            let counts = pairs()
                .map(|(a, b)| f64::from((a.smooth_iterations - b.smooth_iterations).abs()))
                .collect();
            let longest = own.iter().map(|answer| answer.smooth_iterations).fold(0.0, f32::max);
            assert!(longest > 4.0, "power {power}, {variant}: all orbits are short");
            // Long orbits amplify rounding. A text's counts are smoothed by the growth of the last step, the bulb's
            // by its power: they differ by a part of a step.
            let (trap, count) = (quantile(traps, 0.95), quantile(counts, 0.95));
            let found = format!("power {power}, {variant}: traps {trap:.1e}, counts {count:.1e}");
            println!("{found}");
            assert!(trap < 1e-4 && count < 0.2, "{found}");
        }
    }
}

#[test]
fn gradients_of_texts_agree_with_the_oracle() {
    let mut failures = Vec::new();
    for fractal in fractals() {
        let scene = whole(&fractal);
        let points = points(&fractal, 2000);
        let answers = probe::ask(&scene, &points, true).expect("answers");
        let orbits = Orbits::of(&fractal);
        let expected = in_parallel(&points, |&point| {
            let distance = orbits.distance(point);
            (distance >= 1e-3).then(|| gradient(&orbits, point, 1e-5 * distance)).flatten()
        });
        let pairs = answers.iter().zip(expected).filter_map(|(answer, expected)| {
            Some(expected?.angle_between(answer.gradient.as_dvec3()).to_degrees())
        });
        let off: Vec<_> = pairs.collect();
        let name = name(&fractal);
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
pub fn gradient(orbits: &Orbits, point: DVec3, spacing: f64) -> Option<DVec3> {
    let derived = orbits.is_derived();
    let steps = orbits.orbit(point).steps;
    let value = |point: DVec3| {
        if derived { orbits.height(point, steps) } else { orbits.distance(point) }
    };
    let slope = |spacing: f64| {
        let along = |axis: DVec3| value(point + spacing * axis) - value(point - spacing * axis);
        DVec3::new(along(DVec3::X), along(DVec3::Y), along(DVec3::Z)).try_normalize()
    };
    let (fine, coarse) = (slope(spacing)?, slope(10.0 * spacing)?);
    (fine.angle_between(coarse) < 1e-3).then_some(fine)
}
