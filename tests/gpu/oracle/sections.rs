//! Section planes against plain geometry, and against the Mandelbrot set of complex numbers.

use glam::{DVec2, DVec3};
use mandelight::{
    formula::section::SectionPlane,
    render::Pace,
    scene::{Camera, EnvironmentLight, Normals, Scene},
};
use mandelight_test_support::{
    oracle::{light, rays},
    statistics::quantile,
    view::{finished, pixels, sampled},
};

const SIZE: [u32; 2] = [96, 72];

/// The bulb of power 2 cut at z = 0, seen from above.
fn slice() -> Scene {
    let mut scene = sampled(Scene::default(), 1);
    assert!(scene.fractal.set("power", 2.0));
    scene.fractal.iterations = 60;
    scene.fractal.section_planes =
        vec![SectionPlane { band_reach: 4.0, ..SectionPlane::default() }];
    let eye = DVec3::new(-0.6, 0.0, 3.4);
    scene.camera = Camera::looking_at(eye, DVec3::new(-0.6, 0.0, 0.0), DVec3::Y);
    scene.quality.normals = Normals::Analytic;
    scene
}

/// Depth and point of the plane z = 0 that a pixel sees.
fn seen(scene: &Scene, pixel: [u32; 2]) -> (f64, DVec3) {
    let eye = scene.camera.position.to_dvec3();
    let direction = rays::direction(&scene.camera, SIZE, pixel);
    let depth = eye.z / -direction.z;
    (depth, eye + depth * direction)
}

fn all() -> impl Iterator<Item = (usize, [u32; 2])> {
    (0..SIZE[0] * SIZE[1]).map(|i| (i as usize, [i % SIZE[0], i / SIZE[0]]))
}

/// Steps of z² + c until it escapes, made smooth; none if it stays.
fn smooth_iterations(c: DVec2, bailout: f64, most: u32) -> Option<f64> {
    let mut z = c;
    for n in 0..most {
        if z.length() > bailout {
            return Some(f64::from(n) - (z.length().ln() / bailout.ln()).log2());
        }
        z = DVec2::new(z.x * z.x - z.y * z.y, 2.0 * z.x * z.y) + c;
    }
    None
}

#[test]
fn the_slice_of_the_square_bulb_is_the_mandelbrot_set() {
    let mut scene = slice();
    // Colours alone.
    (scene.surface.ambient, scene.surface.diffuse, scene.surface.specular) = (1.0, 0.0, 0.0);
    scene.tone.exposure = 0.0;
    let view = finished(&scene, SIZE, Pace::Still);
    let (samples, shown) = (view.gbuffer().expect("samples"), pixels(&view));
    let mut as_iterations = scene.clone();
    as_iterations.surface.coloring.repeats = scene.surface.sections.repeats;
    let (mut off, mut wrong, mut inside, mut count) = (Vec::new(), 0, 0, 0);
    for (i, pixel) in all() {
        let (depth, point) = seen(&scene, pixel);
        if point.length() > 1.5 {
            continue;
        }
        count += 1;
        assert!((f64::from(samples.depth[i]) - depth).abs() < 1e-5 * depth, "{pixel:?}");
        let normal = samples.normal[i].as_dvec3();
        assert!(normal.angle_between(DVec3::Z).to_degrees() < 0.01, "{pixel:?}: {normal}");
        let expected = match smooth_iterations(point.truncate(), scene.fractal.bailout, 60) {
            Some(smooth) => light::color_at(&as_iterations, smooth),
            None => {
                inside += 1;
                scene.surface.sections.inside.map(f64::from).into()
            }
        };
        let expected = light::display(&scene, expected);
        let found = DVec3::from_array([0, 1, 2].map(|k| f64::from(shown[4 * i + k])));
        let difference = (found - expected).abs().max_element();
        off.push(difference);
        wrong += u32::from(difference > 8.0);
    }
    assert!(inside > 300 && count > 3000, "{inside} of {count} inside");
    // Dither and rounding; at the rim of the set orbits take any number of steps.
    let typical = quantile(off, 0.9);
    assert!(typical < 1.6, "display values differ by {typical}");
    assert!(f64::from(wrong) < 0.02 * f64::from(count), "{wrong} of {count} differ");
}

#[test]
fn light_from_the_cut_side_reaches_the_whole_cut() {
    let mut scene = slice();
    let toward = |direction: DVec3| EnvironmentLight {
        direction: direction.normalize().to_array(),
        casts_shadows: true,
        ..EnvironmentLight::default()
    };
    scene.lights.environment =
        [DVec3::new(0.3, 0.2, 1.0), DVec3::new(0.98, 0.0, 0.05), DVec3::NEG_Z].map(toward).into();
    let view = finished(&scene, SIZE, Pace::Still);
    let samples = view.gbuffer().expect("samples");
    let hits = all().filter(|(i, _)| samples.depth[*i] > 0.0);
    let bits: Vec<_> = hits.map(|(i, _)| samples.visibility[i] & 0b111).collect();
    assert!(bits.len() > 2000);
    assert!(
        bits.iter().all(|bits| *bits == 0b011),
        "lights above reach it, the one below does not"
    );
}

#[test]
fn the_uncut_half_looks_as_before() {
    let mut scene = sampled(Scene::default(), 1);
    scene.lights.environment.clear();
    // Behind everything: nothing is cut, but rays are clipped at the plane.
    let behind = SectionPlane {
        point: DVec3::new(0.0, 0.0, 1.4).into(),
        band_reach: 0.0,
        ..SectionPlane::default()
    };
    let plain = finished(&scene, SIZE, Pace::Still).gbuffer().expect("samples");
    scene.fractal.section_planes = vec![behind];
    let cut = finished(&scene, SIZE, Pace::Still).gbuffer().expect("samples");
    let footprint = rays::cone(&scene.camera, SIZE);
    let off = plain
        .depth
        .iter()
        .zip(&cut.depth)
        .filter(|(a, b)| f64::from((*a - *b).abs()) > footprint * f64::from(a.max(**b)));
    assert!(off.count() < 20, "a pixel in 350");
}
