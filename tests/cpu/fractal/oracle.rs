//! `src/fractal` and `src/scene` against the oracle.

use glam::{DVec2, DVec3};
use mandelight::{
    formula::{
        DistanceField,
        mandelbulb::{Mandelbulb, Sine, estimator::Estimator},
    },
    fractal::{camera_ray, pixel_cone},
    gpu::device::in_parallel,
    scene::PrecisePoint,
};
use mandelight_test_support::{
    oracle::{estimate, rays, views},
    random::Random,
    statistics::quantile,
};

fn fractals() -> Vec<Mandelbulb> {
    let bulb = |power: f64| Mandelbulb { power, ..Mandelbulb::default() };
    let mut all: Vec<_> = [2.0, 3.0, 5.0, 8.0, 13.0, 16.0, 2.5, 6.75, 15.9].map(bulb).into();
    all.push(Mandelbulb { sine: Sine::Negative, ..bulb(8.0) });
    all.push(Mandelbulb { sine: Sine::Negative, ..bulb(4.3) });
    all.push(Mandelbulb { julia: true, ..bulb(8.0) });
    all.push(Mandelbulb { julia: true, julia_constant: [-0.2, 0.6, 0.2], ..bulb(2.0) });
    all.push(Mandelbulb { julia: true, julia_constant: [0.5, 0.5, 0.3], ..bulb(4.5) });
    all.push(Mandelbulb { iterations: 5, bailout: 16.0, ..bulb(8.0) });
    all
}

#[test]
fn estimates_agree_to_rounding() {
    for fractal in fractals() {
        let estimator = Estimator::new(&fractal);
        let mut random = Random(0x1234_5678_9ABC_DEF1);
        let mut away = 0;
        for _ in 0..4000 {
            let point = random.in_ball(1.3 * estimator.bounding_radius());
            let (found, expected) =
                (estimator.distance(point), estimate::distance(&fractal, point));
            let off = (found - expected).abs();
            if estimate::orbit(&fractal, point).r <= fractal.bailout {
                continue;
            }
            if expected > 1e-2 {
                away += 1;
                assert!(off <= 1e-12 * expected, "{fractal:?} at {point}: {found} for {expected}");
            }
            // Anywhere: what one rounding grows to along the orbit.
            let allowed = 8.0 * f64::EPSILON * estimate::error_growth(&fractal, point);
            assert!(off <= allowed * expected, "{fractal:?} at {point}: {found} for {expected}");
        }
        assert!(away > 1000, "{away} points away from the surface");
    }
}

#[test]
fn estimates_inside_are_zero() {
    for fractal in [Mandelbulb::default(), Mandelbulb { power: 2.5, ..Mandelbulb::default() }] {
        let estimator = Estimator::new(&fractal);
        for point in [DVec3::ZERO, DVec3::new(0.2, 0.1, -0.1), DVec3::new(0.0, 0.0, 0.3)] {
            assert_eq!(
                (estimator.distance(point), estimate::distance(&fractal, point)),
                (0.0, 0.0)
            );
        }
    }
}

#[test]
fn rays_and_cones_are_those_of_the_pixels() {
    let [width, height] = views::SIZE.map(f64::from);
    for view in views::all() {
        let camera = &view.scene.camera;
        assert!(
            (pixel_cone(camera, width / height, height) / rays::cone(camera, views::SIZE) - 1.0)
                .abs()
                < 1e-14
        );
        for pixel in [[0, 0], [95, 0], [17, 60]] {
            let [x, y] = pixel.map(|v| f64::from(v) + 0.5);
            let ndc = DVec2::new(2.0 * x / width - 1.0, 1.0 - 2.0 * y / height);
            let expected = rays::direction(camera, views::SIZE, pixel);
            let found = camera_ray(camera, &PrecisePoint::ORIGIN, ndc, width / height).direction;
            assert!((found - expected).length() < 1e-14);
        }
    }
}

#[test]
fn depths_and_normals_agree_on_whole_views() {
    let [width, height] = views::SIZE;
    let pixels: Vec<_> =
        (0..height).flat_map(|y| (0..width).map(move |x| [x, y])).step_by(5).collect();
    for view in views::all() {
        let scene = &view.scene;
        let estimator = Estimator::new(&Mandelbulb::of(&scene.fractal));
        let cone = rays::cone(&scene.camera, views::SIZE);
        let both = in_parallel(&pixels, |&[x, y]| {
            let origin = scene.camera.position.to_dvec3();
            let direction = rays::direction(&scene.camera, views::SIZE, [x, y]);
            let ray = mandelight::formula::Ray { origin, direction };
            let found = estimator.march(ray, cone * scene.quality.detail, f64::INFINITY);
            (ray, found, rays::march(scene, views::SIZE, [x, y]))
        });
        let mut off = Vec::new();
        for (ray, found, expected) in &both {
            let (Some(found), Some(expected)) = (found, expected) else { continue };
            off.push((found - expected).abs() / (cone * expected));
            let (point, spacing) = (ray.at(*found), cone * found);
            let normal = estimator.normal(point, spacing);
            let angle = normal
                .dot(rays::normal(&Mandelbulb::of(&scene.fractal), point, spacing))
                .clamp(-1.0, 1.0)
                .acos();
            assert!(angle < 1e-4, "{}: {angle}", view.name);
        }
        let differ = both.iter().filter(|(_, a, b)| a.is_some() != b.is_some()).count();
        assert!(
            differ as f64 <= 0.005 * both.len() as f64,
            "{}: {differ} of {}",
            view.name,
            both.len()
        );
        assert!(quantile(off, 0.99) < 2.0, "{}", view.name);
    }
}
