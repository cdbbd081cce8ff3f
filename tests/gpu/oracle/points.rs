//! The formula's kernels at given points, against the oracle.

use glam::DVec3;
use mandelight::{
    formula::{
        self, Fractal,
        mandelbulb::{Mandelbulb, Sine, estimator::Estimator},
    },
    gpu::device::in_parallel,
    render::Pace,
    scene::{Camera, Scene},
};
use mandelight_test_support::{
    oracle::{estimate, normals, quaternion, rays},
    probe,
    random::Random,
    statistics::quantile,
    view::{finished, sampled},
};

#[test]
fn estimates_at_random_points_agree_with_the_oracle() {
    let bulb = |power: f64| Mandelbulb { power, ..Mandelbulb::default() };
    let mut fractals: Vec<_> =
        [2.0, 3.0, 5.0, 8.0, 11.0, 16.0, 2.5, 5.5, 6.75, 15.9].map(bulb).into();
    fractals.push(Mandelbulb { sine: Sine::Negative, ..bulb(8.0) });
    fractals.push(Mandelbulb { julia: true, ..bulb(8.0) });
    fractals.push(Mandelbulb { julia: true, julia_constant: [-0.2, 0.6, 0.2], ..bulb(2.5) });
    // As far as an f32 goes.
    let widest = |power: f64| Mandelbulb { bailout: bulb(power).max_bailout(), ..bulb(power) };
    fractals.extend([2.0, 3.0, 8.0, 16.0, 5.5].map(widest));
    for fractal in fractals {
        let scene = Scene { fractal: fractal.clone().into(), ..Scene::default() };
        let scene = probe::with_traps(scene);
        let estimator = Estimator::new(&fractal);
        let radius = 1.2 * estimator.bounding_radius();
        let mut random = Random(0x0DDB_1A5E_5BAD_5EED);
        // Points that an f32 holds exactly: the oracle gets the very same ones.
        let points: Vec<_> =
            (0..4096).map(|_| random.in_ball(radius).as_vec3().as_dvec3()).collect();
        for specialised in [false, true] {
            let answers = probe::ask(&scene, &points, specialised).expect("the answers");
            let mut away = 0;
            let mut rounding = Vec::new();
            for (&point, answer) in points.iter().zip(&answers) {
                let expected = estimate::distance(&fractal, point);
                let orbit = estimate::orbit(&fractal, point);
                let off = (f64::from(answer.distance) - expected).abs() / expected.max(1e-30);
                if expected > 1e-2 && orbit.r > fractal.bailout {
                    away += 1;
                    assert!(off < 1e-4, "{fractal:?} at {point}: {answer:?}, expected {expected}");
                    // The same steps as on the CPU, whose safety is tested.
                    let step = estimator.estimate(point).step;
                    let off = (f64::from(answer.step) - step).abs();
                    // A step may end at a seam, whose distance is as exact as the orbit's points.
                    let at_seam = if fractal.power.fract() == 0.0 { 0.0 } else { 1e-6 };
                    assert!(
                        off < 2e-4 * step + at_seam,
                        "{fractal:?} at {point}: {answer:?}, expected a step of {step}"
                    );
                    let smooth = estimate::smooth_iterations(&fractal, point);
                    assert!((f64::from(answer.smooth_iterations) - smooth).abs() < 1e-3);
                }
                if orbit.r > fractal.bailout {
                    let rounded = f64::from(f32::EPSILON) * estimate::error_growth(&fractal, point);
                    rounding.push(off / rounded);
                    let traps = answer.traps.into_iter().zip(orbit.traps);
                    rounding
                        .extend(traps.map(|(found, expected)| {
                            (f64::from(found) - expected).abs() / rounded
                        }));
                }
            }
            assert!(away > 1000, "{away} points away from the surface");
            // Nearer, estimates and traps are off by no more than rounding that grows along the orbit.
            let most = quantile(rounding, 0.999);
            assert!(most < 3.0, "{fractal:?}: {most} roundings");
        }
    }
}

/// On the polar axis the longitude is that of +x, and so it is right beside it.
#[test]
fn estimates_on_the_axis_agree_with_the_oracle() {
    for power in [2.0, 3.0, 4.0, 7.0, 8.0, 16.0, 5.5] {
        let scene = Scene {
            fractal: Mandelbulb { power, ..Mandelbulb::default() }.into(),
            ..Scene::default()
        };
        let radius = Estimator::new(&Mandelbulb::of(&scene.fractal)).bounding_radius();
        let heights = (0..768).map(|i| radius * (f64::from(i) / 256.0 - 1.5));
        let on_axis = heights.map(|z| DVec3::new(0.0, 0.0, z).as_vec3().as_dvec3());
        let points: Vec<_> = on_axis.collect();
        for specialised in [false, true] {
            let answers = probe::ask(&scene, &points, specialised).expect("the answers");
            let mut away = 0;
            for (&point, answer) in points.iter().zip(&answers) {
                let expected = estimate::distance(&Mandelbulb::of(&scene.fractal), point);
                if expected > 1e-2 {
                    away += 1;
                    let off = (f64::from(answer.distance) - expected).abs() / expected;
                    assert!(off < 1e-4, "power {power} at {point}: {answer:?} for {expected}");
                    assert!(answer.step > 0.0 && answer.step <= answer.distance);
                } else {
                    assert!(answer.distance.is_finite() && answer.step.is_finite());
                }
            }
            assert!(away > 100, "power {power}: {away} points away from the surface");
        }
    }
}

/// Gradients by carried derivatives against gradients by differences, at points near and far, on
/// both sides of the axis and of the seam.
#[test]
fn gradients_at_random_points_agree_with_the_oracle() {
    let bulb = |power: f64| Mandelbulb { power, ..Mandelbulb::default() };
    let mut fractals: Vec<_> = [2.0, 3.0, 5.0, 8.0, 11.0, 16.0, 2.5, 6.75, 15.9].map(bulb).into();
    fractals.push(Mandelbulb { sine: Sine::Negative, ..bulb(8.0) });
    fractals.push(Mandelbulb { sine: Sine::Negative, ..bulb(5.5) });
    fractals.push(Mandelbulb { julia: true, ..bulb(8.0) });
    fractals.push(Mandelbulb { julia: true, julia_constant: [-0.2, 0.6, 0.2], ..bulb(2.5) });
    for fractal in fractals {
        let scene = Scene { fractal: fractal.clone().into(), ..Scene::default() };
        let radius = 1.2 * Estimator::new(&fractal).bounding_radius();
        let mut random = Random(0xF00D_FACE_5BAD_5EED);
        let points: Vec<_> =
            (0..4096).map(|_| random.in_ball(radius).as_vec3().as_dvec3()).collect();
        let expected = in_parallel(&points, |&point| {
            let distance = estimate::distance(&fractal, point);
            (distance > 1e-4).then(|| normals::gradient(&fractal, point, distance)).flatten()
        });
        for specialised in [false, true] {
            let answers = probe::ask(&scene, &points, specialised).expect("the answers");
            let known = answers.iter().zip(&expected).filter_map(|(answer, expected)| {
                let expected = expected.as_ref().filter(|e| e.uncertain_deg < 1e-4)?;
                Some(normals::angle_deg(answer.gradient.as_dvec3(), expected.unit))
            });
            let off: Vec<_> = known.collect();
            assert!(off.len() > 2000, "{fractal:?}: {} gradients", off.len());
            // Rounding grows along the orbit; a few points lie across a real power's seam.
            let (median, most) = (quantile(off.clone(), 0.5), quantile(off, 0.99));
            assert!(median < 2e-4 && most < 0.01, "{fractal:?}: off by {median}°, {most}°");
        }
    }
}

/// Where formulas divide by nothing: on the axis, beside it, and at the origin.
#[test]
fn gradients_are_finite_on_the_axis_and_zero_inside() {
    for (power, julia) in [(2.0, false), (3.0, false), (8.0, false), (4.5, false), (7.0, true)] {
        let mut scene = Scene::default();
        scene.fractal =
            Mandelbulb { power, julia, iterations: 100, ..Mandelbulb::of(&scene.fractal) }.into();
        scene.fractal.set("julia_constant", [0.0, 0.0, 0.9]);
        for specialised in [false, true] {
            let heights = (0..512).map(|i| f64::from(i) / 256.0 - 1.0);
            let beside = |z| [0.0, 1e-30, 1e-12].map(|x| DVec3::new(x, 0.0, z));
            let points: Vec<_> = heights.flat_map(beside).collect();
            for answer in probe::ask(&scene, &points, specialised).expect("the answers") {
                assert!(answer.gradient.is_finite(), "power {power}: {answer:?}");
                let flat = answer.gradient == glam::Vec3::ZERO;
                assert_eq!(flat, answer.distance == 0.0, "power {power}: {answer:?}");
            }
        }
    }
}

/// Estimates, colours and gradients of the quaternion Julia set, at points near and far.
#[test]
fn quaternion_julia_sets_agree_with_the_oracle() {
    let constants = [[-0.125, -0.256, 0.847, 0.0895], [-0.2, 0.8, 0.0, 0.0], [0.0; 4]];
    for (constant, slice) in constants.into_iter().zip([0.0, 0.3, -0.4]) {
        let mut fractal = Fractal::new(formula::find("quaternion_julia").expect("a formula"));
        assert!(fractal.set("constant", constant) && fractal.set("slice", slice));
        let scene = Scene { fractal: fractal.clone(), ..Scene::default() };
        let field = fractal.formula().distance_field(&fractal);
        // Footprints of a whole view add no iterations.
        let iterations = fractal.formula().iterations_for(&fractal, 0.1);
        assert_eq!(iterations, fractal.iterations);
        let mut random = Random(0x0DDB_1A5E_5BAD_5EED);
        let points: Vec<_> = (0..2000)
            .map(|_| random.in_ball(1.2 * field.bounding_radius()).as_vec3().as_dvec3())
            .collect();
        let answers = probe::ask(&scene, &points, true).expect("answers");
        let (mut escaped, mut turned) = (0, Vec::new());
        for (point, answer) in points.iter().zip(answers) {
            let expected = quaternion::distance(&fractal, *point);
            let orbit = quaternion::orbit(&fractal, *point);
            let distance = f64::from(answer.distance);
            // A radius near one is inside by one arithmetic and outside by the other.
            if expected == 0.0 || orbit.steps >= fractal.iterations {
                continue;
            }
            escaped += 1;
            let off = (distance - expected).abs() / expected;
            assert!(off < 2e-4 || expected < 1e-6, "{point}: {distance} instead of {expected}");
            let step = f64::from(answer.step);
            assert!(step <= distance && field.distance(*point) > 0.0);
            // The estimate bounds the way to the surface: no point within it is inside.
            let direction = DVec3::new(random.signed(), random.signed(), random.signed());
            let near = *point + direction.normalize_or(DVec3::X) * 0.99 * expected;
            let deeper = fractal.with_iterations(200);
            assert!(quaternion::distance(&deeper, near) > 0.0, "{point}: {expected} is too far");
            let spacing = 1e-5 * expected;
            let slope = |axis: DVec3| {
                quaternion::distance(&fractal, *point + axis * spacing)
                    - quaternion::distance(&fractal, *point - axis * spacing)
            };
            let gradient = DVec3::new(slope(DVec3::X), slope(DVec3::Y), slope(DVec3::Z));
            turned.push(gradient.angle_between(answer.gradient.as_dvec3()));
        }
        assert!(escaped > 1000, "{constant:?}: {escaped} of the points are outside");
        let most = quantile(turned, 0.98);
        assert!(most < 0.02, "{constant:?}: gradients are {most} rad off");
    }
}

/// With c = 0 the set is the unit ball, cut by the slice.
#[test]
fn a_quaternion_julia_set_without_a_constant_is_a_ball() {
    for slice in [0.0, 0.6] {
        let mut fractal = Fractal::new(formula::find("quaternion_julia").expect("a formula"));
        assert!(fractal.set("constant", [0.0; 4]) && fractal.set("slice", slice));
        let radius = (1.0 - slice * slice).sqrt();
        let camera = Camera::looking_at(DVec3::new(0.0, -3.0, 0.0), DVec3::ZERO, DVec3::Z);
        let scene = Scene { fractal, camera, ..Scene::default() };
        let size = [48, 32];
        let view = finished(&sampled(scene.clone(), 1), size, Pace::Still);
        let depths = view.gbuffer().expect("samples").depth;
        let (origin, mut hits) = (scene.camera.position.to_dvec3(), 0);
        for (i, &depth) in (0..).zip(&depths) {
            let direction = rays::direction(&scene.camera, size, [i % size[0], i / size[0]]);
            let along = -origin.dot(direction);
            let beside = (origin + along * direction).length();
            // A ray stops where the estimate, about half the radius times the distance, is the hit
            // distance; so a ray that passes by this closely may stop too.
            let outer = radius + 2.2 / radius * rays::hit_distance(&scene, size, along);
            if (0.98 * radius..outer).contains(&beside) {
                continue;
            }
            assert_eq!(depth > 0.0, beside < radius, "pixel {i}");
            if depth > 0.0 {
                let reach = |radius: f64| along - (radius * radius - beside * beside).sqrt();
                let range = reach(outer)..=reach(radius) + 1e-3;
                assert!(range.contains(&f64::from(depth)), "{depth} is not in {range:?}");
                hits += 1;
            }
        }
        assert!(hits > 100);
    }
}
