//! Lights with a size: the light of their whole face against closed forms and quadrature in f64.

use glam::DVec3;
use mandelight::{
    formula::{Fractal, own},
    render::{Pace, Region},
    scene::{Camera, EnvironmentLight, GradientStop, Lights, PointLight, Scene, param},
};
use mandelight_test_support::{
    device::gpu,
    oracle::rays,
    probe::{bind_group, filled},
    statistics::quantile,
    view::{finished, finished_in, sampled},
};

const SIZE: [u32; 2] = [64, 48];
/// Centre and radius of the ball over the floor at z = -1.
const BALL: (DVec3, f64) = (DVec3::new(0.0, 0.0, 0.2), 0.4);

/// A white floor in the light of `lights`, seen from above, with the ball or without.
fn floor(with_ball: bool, lights: Lights) -> Scene {
    let ball =
        if with_ball { "min(p.z + 1, length(p - vec3(0, 0, 0.2)) - 0.4)" } else { "p.z + 1" };
    let text = format!(
        "name \"Floor\"; step {{ z = z; }} estimate distance {ball}; bound 3; iterations 2;"
    );
    let mut scene = Scene {
        fractal: Fractal::new(own::alone(&text).expect("a formula")),
        camera: Camera::looking_at(
            DVec3::new(0.0, -2.2, 3.2),
            DVec3::new(0.0, 0.0, -1.0),
            DVec3::Z,
        ),
        lights,
        ..Scene::default()
    };
    scene.surface.gradient = vec![GradientStop { position: 0.0, color: [1.0; 3] }];
    (scene.surface.ambient, scene.surface.diffuse, scene.surface.specular) = (0.0, 1.0, 0.0);
    // Shadow rays are blocked within half a hit distance: a finer one makes the ball less fat.
    scene.quality.detail = param::DETAIL.min;
    scene
}

/// For each pixel within the floor: where its ray ends, and its radiance.
fn seen(scene: &Scene) -> Vec<(DVec3, f64)> {
    let view = finished(scene, SIZE, Pace::Still);
    let (film, samples) = (view.film().expect("a film"), view.gbuffer().expect("samples"));
    let eye = scene.camera.position.to_dvec3();
    let at = |i: usize| {
        let pixel = [i as u32 % SIZE[0], i as u32 / SIZE[0]];
        eye + f64::from(samples.depth[i]) * rays::direction(&scene.camera, SIZE, pixel)
    };
    // Rays end a pixel's radius above the surface.
    let is_floor = |i: &usize| samples.depth[*i] > 0.0 && (at(*i).z + 1.0).abs() < 0.08;
    // Samples of a pixel beside the ball may see the ball.
    let width = SIZE[0] as usize;
    let is_inner = |i: &usize| {
        let near = [
            i - width - 1,
            i - width,
            i - width + 1,
            i - 1,
            *i,
            i + 1,
            i + width - 1,
            i + width,
            i + width + 1,
        ];
        near.iter().all(is_floor)
    };
    let inner = (width + 1..film.len() - width - 1).filter(is_inner);
    inner.map(|i| (at(i), f64::from(film[i][0]))).collect()
}

/// Directions spread evenly over a cap of half angle `half` about `axis`.
fn cap(axis: DVec3, half: f64) -> Vec<DVec3> {
    const SIDE: u32 = 96;
    let side = axis.any_orthonormal_vector();
    let other = axis.cross(side);
    let cell = |i: u32| (f64::from(i) + 0.5) / f64::from(SIDE);
    let places = (0..SIDE * SIDE).map(|i| [cell(i % SIDE), cell(i / SIDE)]);
    places
        .map(|[u, v]| {
            let cosine = 1.0 - u * (1.0 - half.cos());
            let (sine, turn) = ((1.0 - cosine * cosine).sqrt(), std::f64::consts::TAU * v);
            cosine * axis + sine * (turn.cos() * side + turn.sin() * other)
        })
        .collect()
}

#[test]
fn a_ball_throws_the_shadow_of_the_whole_light() {
    let direction = DVec3::new(0.3, 0.1, 0.9).normalize();
    let light = EnvironmentLight {
        direction: direction.to_array(),
        size_deg: 30.0,
        intensity: 0.8,
        shadow_reach: None,
        ..EnvironmentLight::default()
    };
    let lights = Lights { environment: vec![light], ..Lights::default() };
    let scene = sampled(floor(true, lights), 256);
    let half = 15.0_f64.to_radians();
    let directions = cap(direction, half);
    let (center, radius) = BALL;
    let expected = |point: DVec3| {
        let away = center - point;
        let reach = (radius / away.length()).asin().cos();
        let is_free = |d: &&DVec3| d.dot(away.normalize()) < reach;
        let sum: f64 = directions.iter().filter(is_free).map(|d| d.z).sum();
        // A face of even radiance whose irradiance, at a right angle, is the intensity.
        0.8 * 2.0 / (1.0 + half.cos()) * sum / directions.len() as f64
    };
    let mut off: Vec<f64> = Vec::new();
    let mut levels = [0; 3];
    for (point, found) in seen(&scene) {
        let wanted = expected(point);
        levels[(wanted * 3.0 / 0.76).min(2.0) as usize] += 1;
        off.push((found - wanted).abs());
    }
    assert!(levels.iter().all(|&count| count > 40), "umbra, penumbra, light: {levels:?}");
    let (mean, most) = (off.iter().sum::<f64>() / off.len() as f64, quantile(off, 0.99));
    println!("off by {mean:.4} in the mean, {most:.4} at most");
    assert!(mean < 0.006 && most < 0.03, "off by {mean}, {most}");
}

#[test]
fn a_glowing_ball_lights_a_floor_as_its_centre_would() {
    let position = DVec3::new(0.4, 0.2, 0.5);
    let light = PointLight {
        position: position.into(),
        intensity: 2.0,
        radius: 0.6,
        ..PointLight::default()
    };
    let lights = Lights { environment: Vec::new(), point: vec![light], ..Lights::default() };
    let scene = sampled(floor(false, lights), 128);
    let ratios: Vec<f64> = seen(&scene)
        .into_iter()
        .map(|(point, found)| {
            let away = position - point;
            found / (2.0 * away.z / away.length().powi(3))
        })
        .collect();
    assert!(ratios.len() > 800, "{} pixels", ratios.len());
    let mean = ratios.iter().sum::<f64>() / ratios.len() as f64;
    let worst = ratios.iter().map(|ratio| (ratio - 1.0).abs()).collect();
    println!("{mean:.5} of the closed form");
    // A sphere above the horizon lights as a point in its centre (J. H. Lambert, Photometria, 1760).
    assert!((mean - 1.0).abs() < 0.002, "{mean} of the closed form");
    assert!(quantile(worst, 0.99) < 0.02);
}

/// Random numbers are those of the picture's pixels, in whatever pieces it is drawn.
#[test]
fn pieces_of_a_picture_have_the_same_soft_shadows() {
    let light = EnvironmentLight { size_deg: 40.0, ..EnvironmentLight::default() };
    let lights = Lights { environment: vec![light], ..Lights::default() };
    let scene = sampled(floor(true, lights), 8);
    let whole = finished(&scene, SIZE, Pace::Still).film().expect("a film");
    let region = Region { origin_px: [20, 12], size_px: [24, 20], ..Region::whole(SIZE) };
    let piece = finished_in(&scene, region, Pace::Still).film().expect("a film");
    for (i, found) in piece.iter().enumerate() {
        let [x, y] = [20 + i % 24, 12 + i / 24];
        let wanted = whole[y * SIZE[0] as usize + x];
        let off = (0..3).map(|c| (found[c] - wanted[c]).abs()).fold(0.0, f32::max);
        assert!(off < 1e-4, "pixel {x}, {y}: {found:?} instead of {wanted:?}");
    }
}

/// The first 2^k points of a sequence lie in different cells of every grid of 2^k equal cells.
#[test]
fn sample_points_are_nets() {
    const POINTS: usize = 256;
    const SEEDS: usize = 64;
    let text = format!(
        "{}\n@group(0) @binding(0) var<storage, read> seeds: array<u32>;\n\
         @group(0) @binding(1) var<storage, read_write> points: array<vec2f>;\n\
         @compute @workgroup_size({POINTS})\n\
         fn main(@builtin(local_invocation_index) t: u32, @builtin(workgroup_id) w: vec3u) {{\n\
         points[w.x * {POINTS}u + t] = sobol_point(t, seeds[w.x]);\n}}\n",
        include_str!("../../shaders/lib/sobol.wgsl")
    );
    let gpu = gpu();
    let module = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("sobol"),
        source: wgpu::ShaderSource::Wgsl(text.into()),
    });
    let pipeline = gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: Some("sobol"),
        layout: None,
        module: &module,
        entry_point: Some("main"),
        compilation_options: Default::default(),
        cache: None,
    });
    let seeds: Vec<u32> = (0..SEEDS as u32).map(|i| i.wrapping_mul(0x9E37_79B9) ^ 0xA5A5).collect();
    let storage = wgpu::BufferUsages::STORAGE;
    let questions = filled(gpu, storage, bytemuck::cast_slice(&seeds));
    let answers = filled(gpu, storage | wgpu::BufferUsages::COPY_SRC, &vec![0; 8 * POINTS * SEEDS]);
    let group = bind_group(gpu, &pipeline, 0, &[&questions, &answers]);
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    {
        let mut pass = encoder.begin_compute_pass(&Default::default());
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.dispatch_workgroups(SEEDS as u32, 1, 1);
    }
    gpu.queue.submit([encoder.finish()]);
    let bytes =
        mandelight::gpu::readback::Readback::buffer(gpu, &answers).wait(gpu).expect("points");
    let points: &[[f32; 2]] = bytemuck::cast_slice(&bytes);
    let mut means = [0.0; 2];
    for sequence in points.chunks(POINTS) {
        for power in 0..=8_u32 {
            let count = 1_usize << power;
            for columns in (0..=power).map(|split| 1_usize << split) {
                let rows = count / columns;
                let mut is_taken = vec![false; count];
                for [x, y] in &sequence[..count] {
                    let cell = |value: f32, cells: usize| (value * cells as f32) as usize;
                    let index = cell(*x, columns) * rows + cell(*y, rows);
                    assert!(!is_taken[index], "{count} points in {columns} columns");
                    is_taken[index] = true;
                }
            }
        }
        // The first point alone is random, too.
        means = [0, 1].map(|axis| means[axis] + f64::from(sequence[0][axis]) / SEEDS as f64);
    }
    assert!(means.iter().all(|mean| (mean - 0.5).abs() < 0.12), "{means:?}");
}
