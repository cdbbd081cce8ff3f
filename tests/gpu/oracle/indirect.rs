//! Indirect light against its definition in f64, on sample points that were made up for it.

use bytemuck::cast_slice;
use glam::{DVec2, DVec3};
use mandelight::{
    gpu::readback::Readback,
    render::{
        Region,
        frame::record,
        integrator::DIRECT,
        recorder::{Dispatches, Recorder},
        schedule::{Points, Stage, Trace, Work},
        targets::Targets,
        uniforms::Inputs,
    },
    scene::{GradientStop, Indirect, IndirectKind, Scene},
};
use mandelight_test_support::{device::pipelines, oracle::rays, statistics::quantile};

const SIZE: [u32; 2] = [48, 32];

/// A sample point that nothing computed.
#[derive(Clone, Copy)]
struct Made {
    /// Depth along the pixel's ray; 0 for the background.
    depth: f64,
    normal: DVec3,
    direct: f64,
}

/// Without lights of its own, white, so that all that arrives on the film is indirect.
fn scene(indirect: Indirect) -> Scene {
    let mut scene = Scene { indirect, ..Scene::default() };
    scene.lights.environment.clear();
    scene.surface.ambient = 0.0;
    scene.surface.gradient = vec![GradientStop { position: 0.0, color: [1.0; 3] }];
    scene.background.top = [0.0; 3];
    scene.background.bottom = [0.0; 3];
    scene
}

fn all_pixels() -> impl Iterator<Item = [u32; 2]> {
    (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| [x, y]))
}

fn octahedral(n: DVec3) -> u32 {
    let flat = n / (n.x.abs() + n.y.abs() + n.z.abs());
    let sign = |v: f64| if v < 0.0 { -1.0 } else { 1.0 };
    let folded = if n.z < 0.0 {
        DVec2::new((1.0 - flat.y.abs()) * sign(flat.x), (1.0 - flat.x.abs()) * sign(flat.y))
    } else {
        DVec2::new(flat.x, flat.y)
    };
    let part = |v: f64| u32::from((v * 32767.0).round() as i16 as u16);
    part(folded.x) | (part(folded.y) << 16)
}

/// White of a radiance below 512 in the packing of `shaders/lib/shared_exponent.wgsl`.
fn shared_exponent(radiance: f64) -> u32 {
    let exponent = ((radiance.max(1e-6).log2().floor() as i32).max(-16) + 17).max(0);
    let mantissa = (radiance * f64::from(24 - exponent).exp2()).round() as u32;
    mantissa | (mantissa << 9) | (mantissa << 18) | ((exponent as u32) << 27)
}

/// The indirect light of the kernels, red of each pixel.
fn indirect_shaded(scene: &Scene, made: &[Made]) -> Vec<f64> {
    let pipelines = pipelines();
    let gpu = &pipelines.gpu;
    let region = Region::whole(SIZE);
    let mut targets = Targets::new(&pipelines.layouts, region);
    targets.fit_direct(&pipelines.layouts, true);
    let inputs = Inputs::new(scene, region);
    targets.upload(&gpu.queue, &inputs);
    let surface: Vec<_> =
        made.iter().map(|m| [(m.depth as f32).to_bits(), octahedral(m.normal)]).collect();
    let direct: Vec<_> = made.iter().map(|m| shared_exponent(m.direct)).collect();
    gpu.queue.write_buffer(&targets.center.surface, 0, cast_slice(&surface));
    gpu.queue.write_buffer(&targets.direct, 0, cast_slice(&direct));
    let passes = pipelines.of_frame(&inputs);
    let mut dispatches = Dispatches::default();
    let mut recorder =
        Recorder::new(&pipelines.layouts, &passes, &targets, &inputs, &mut dispatches);
    let points = Points::Indirect(0);
    let trace = Trace::whole(points, Stage::Indirect, 0, SIZE);
    record(&DIRECT, &mut recorder, Work::Trace(trace));
    gpu.queue.submit([recorder.finish()]);
    assert_eq!((dispatches.passes(), dispatches.total()), (vec!["indirect"], 1));
    let bytes = Readback::buffer(gpu, &targets.film_rg).wait(gpu).expect("the film's bytes");
    let red = |pair: &[u8; 8]| f64::from(bytemuck::cast::<_, [f32; 2]>(*pair)[0]);
    bytes.as_chunks::<8>().0.iter().map(red).collect()
}

/// The noise by which samples are placed, for a pixel's centre sample.
fn noise([x, y]: [u32; 2], salt: f32) -> f64 {
    let dot = (x as f32 + salt) * 0.067_110_56 + (y as f32 + salt) * 0.005_837_15;
    f64::from((52.982_918_f32 * dot.fract()).fract())
}

/// The operators as `shaders/pass/indirect.wgsl` and the thesis define them.
fn expected(scene: &Scene, made: &[Made], pixel: [u32; 2]) -> f64 {
    let Indirect { kind, radius, strength, ambient, directions, samples } = scene.indirect.clone();
    let camera = &scene.camera;
    let own = made[(pixel[1] * SIZE[0] + pixel[0]) as usize];
    if own.depth == 0.0 {
        return 0.0;
    }
    let point = rays::direction(camera, SIZE, pixel) * own.depth;
    let aspect = f64::from(SIZE[0]) / f64::from(SIZE[1]);
    let reach = radius * 2.0 * camera.half_height(aspect) * own.depth;
    let seen = |aside: DVec2| {
        let height = f64::from(SIZE[1]);
        let at = DVec2::new(f64::from(pixel[0]) + 0.5, f64::from(pixel[1]) + 0.5) + aside * height;
        let at = at.floor();
        let inside = at.x >= 0.0 && at.y >= 0.0 && at.x < f64::from(SIZE[0]) && at.y < height;
        let other = inside.then(|| made[(at.y as u32 * SIZE[0] + at.x as u32) as usize])?;
        let offset =
            rays::direction(camera, SIZE, [at.x as u32, at.y as u32]) * other.depth - point;
        let weight = (2.0 - offset.length() / reach).clamp(0.0, 1.0);
        (other.depth > 0.0).then_some((weight, offset, other))
    };
    let (turn, along) = (noise(pixel, 0.0), noise(pixel, 37.0));
    let (mut sum, mut total) = (0.0, 0.0);
    if kind == IndirectKind::Uniform {
        let count = i64::from(samples);
        let stride = radius / (f64::from(samples) + 0.5);
        for y in -count..=count {
            for x in -count..=count {
                let place = DVec2::new(x as f64 + turn - 0.5, y as f64 + along - 0.5) * stride;
                let Some((weight, _, other)) = seen(place) else { continue };
                sum += weight * own.normal.dot(other.normal).max(0.0) * other.direct;
                total += weight;
            }
        }
        return strength * sum / f64::max(total, 1e-6);
    }
    for d in 0..directions {
        let angle = std::f64::consts::TAU * (f64::from(d) + turn) / f64::from(directions);
        let mut horizon = 0.0;
        for k in 0..samples {
            let part = (f64::from(k) + along) / f64::from(samples);
            let aside = DVec2::from_angle(angle) * part * radius;
            let Some((weight, offset, other)) = seen(aside) else { continue };
            if weight <= 0.0 || offset.length() < 0.02 * part * reach {
                continue;
            }
            let height = own.normal.dot(offset.normalize()).clamp(0.0, 1.0);
            if height >= horizon {
                horizon = height;
                sum += weight * (1.0 - height) * (ambient + other.direct);
                total += weight;
            }
        }
    }
    strength * if total > 0.0 { sum / total } else { ambient }
}

/// Hills with light on them, and some sky.
fn hills(scene: &Scene) -> Vec<Made> {
    let camera = &scene.camera;
    let depth = |[x, y]: [f64; 2]| {
        if y < 5.0 { 0.0 } else { 2.0 + 0.12 * (0.6 * x).sin() + 0.1 * (0.5 * y + 0.2 * x).cos() }
    };
    let made = |[x, y]: [u32; 2]| {
        let [fx, fy] = [f64::from(x), f64::from(y)];
        let lean = DVec3::new((0.6 * fx).cos(), (0.5 * fy).sin(), 2.0);
        let direct = 0.4 + 0.35 * (0.3 * fx).sin() * (0.4 * fy).cos();
        Made { depth: depth([fx, fy]), normal: (camera.rotation() * lean).normalize(), direct }
    };
    all_pixels().map(made).collect()
}

#[test]
fn indirect_light_is_what_its_definition_says() {
    for kind in [IndirectKind::Uniform, IndirectKind::Horizon] {
        let scene = scene(Indirect { kind, radius: 0.2, strength: 1.3, ..Indirect::default() });
        let made = hills(&scene);
        let found = indirect_shaded(&scene, &made);
        let errors: Vec<_> = all_pixels()
            .zip(&found)
            .map(|(pixel, found)| (found - expected(&scene, &made, pixel)).abs())
            .collect();
        let lit = found.iter().sum::<f64>() / found.len() as f64;
        assert!((0.1..1.0).contains(&lit), "{kind:?}: mean {lit}");
        // f32 puts a sample that falls between two pixels into the other one here and there.
        assert!(quantile(errors.clone(), 0.9) < 2e-3, "{kind:?}: {}", quantile(errors, 0.9));
        let mean = errors.iter().sum::<f64>() / errors.len() as f64;
        assert!(mean < 2e-3, "{kind:?}: mean error {mean}");
    }
}

/// A bright wall close to the eye and a dark one far behind it.
#[test]
fn light_does_not_leak_across_an_edge_in_depth() {
    for kind in [IndirectKind::Uniform, IndirectKind::Horizon] {
        let ambient = 0.0;
        let scene = scene(Indirect { kind, radius: 0.2, ambient, ..Indirect::default() });
        let toward_eye = -scene.camera.forward();
        let wall = |[x, _]: [u32; 2]| {
            let (depth, direct) = if x < 24 { (1.0, 1.0) } else { (4.0, 0.0) };
            Made { depth, normal: toward_eye, direct }
        };
        let made: Vec<_> = all_pixels().map(wall).collect();
        for ([x, y], light) in all_pixels().zip(indirect_shaded(&scene, &made)) {
            if x < 24 {
                assert!(light > 0.5, "{kind:?}: {light} on the bright wall at {x}, {y}");
            } else {
                assert_eq!(light, 0.0, "{kind:?}: on the dark wall at {x}, {y}");
            }
        }
    }
}

/// A lit wall that fills the picture is lit alike up to the picture's border.
#[test]
fn the_border_of_the_picture_is_no_edge() {
    for kind in [IndirectKind::Uniform, IndirectKind::Horizon] {
        let scene = scene(Indirect { kind, radius: 0.15, ambient: 0.25, ..Indirect::default() });
        let toward_eye = -scene.camera.forward();
        // A plane across the view.
        let plane = |pixel| Made {
            depth: 2.0 / rays::direction(&scene.camera, SIZE, pixel).dot(-toward_eye),
            normal: toward_eye,
            direct: 0.5,
        };
        let made: Vec<_> = all_pixels().map(plane).collect();
        let wanted = if kind == IndirectKind::Uniform { 0.5 } else { 0.75 };
        for (pixel, light) in all_pixels().zip(indirect_shaded(&scene, &made)) {
            assert!((light - wanted).abs() < 0.01, "{kind:?}: {light} at {pixel:?}");
        }
    }
}
