//! Light paths against those of an oracle in f64: path by path on the same random numbers, and in the mean against
//! paths in even directions.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};
use mandelight::{
    formula::{self, Fractal, mandelbulb::Mandelbulb, own},
    render::Pace,
    scene::{
        Axis, Background, Camera, ColorSource, Coloring, DrivenByLayer, EnvironmentLight,
        GradientStop, IntegratorKind, Lights, Normals, PointLight, Rig, RigKind, Scene, Sky,
        SurfaceModel,
    },
};
use mandelight_test_support::{
    oracle::{
        estimate,
        orbits::Orbits,
        paths::{Paths, drawn, field::Distance, material::Material, numbers},
    },
    random::Random,
    statistics::quantile,
    view::{finished, sampled},
};

const SIZE: [u32; 2] = [32, 24];
/// Paths of each pixel.
const PATHS: u32 = 8;
/// Paths of each pixel where many of them end elsewhere.
const MANY_PATHS: u32 = 32;
/// Samples of a still that are no paths: that of the pixel's centre.
const NO_PATHS: u32 = 0;

/// Four colours at whole entries of the table that the kernels read.
fn gradient(colors: [[f32; 3]; 4]) -> Vec<GradientStop> {
    let stop = |(i, color)| GradientStop { position: 0.25 * f64::from(i), color };
    (0_u8..).zip(colors).map(stop).collect()
}

fn along(source: ColorSource, axis: Axis) -> Coloring {
    Coloring { source, axis, ..Coloring::default() }
}

fn toward(x: f64, y: f64, z: f64) -> [f64; 3] {
    DVec3::new(x, y, z).normalize().to_array()
}

/// The scene with traced paths and the usual colours.
fn traced(fractal: Fractal, camera: Camera, lights: Lights) -> Scene {
    let mut scene = Scene {
        fractal,
        camera,
        lights,
        background: Background::gradient([0.1, 0.2, 0.4], [0.4, 0.3, 0.2]),
        ..Scene::default()
    };
    scene.integrator.kind = IntegratorKind::Path;
    scene.quality.detail = 0.25;
    scene.surface.coloring = along(ColorSource::Position, Axis::X);
    scene.surface.gradient =
        gradient([[0.9, 0.5, 0.3], [0.4, 0.7, 0.9], [0.8, 0.8, 0.5], [0.6, 0.4, 0.8]]);
    scene.surface.second_layer.coloring = along(ColorSource::Normal, Axis::Z);
    scene.surface.second_layer.gradient =
        gradient([[0.1, 0.2, 0.3], [0.9, 0.8, 0.4], [0.3, 0.6, 0.7], [1.0, 0.9, 0.8]]);
    scene
}

/// Three balls over a floor within a bounding sphere.
fn balls() -> Scene {
    let text = "name \"Balls\"; step { z = z; } estimate distance \
                min(min(p.z + 1, length(p - vec3(-0.5, 0, -0.4)) - 0.6), \
                min(length(p - vec3(0.7, 0.2, -0.65)) - 0.35, length(p - vec3(0.2, -0.8, -0.75)) - 0.25)); \
                bound 3; iterations 2;";
    let lights = Lights {
        environment: vec![
            EnvironmentLight {
                direction: toward(0.5, -0.2, 0.8),
                color: [1.0, 0.8, 0.6],
                intensity: 0.7,
                size_deg: 25.0,
                shadow_reach: None,
                ..EnvironmentLight::default()
            },
            EnvironmentLight {
                direction: toward(-0.4, -0.8, 0.3),
                color: [0.5, 0.7, 1.0],
                intensity: 0.2,
                ..EnvironmentLight::default()
            },
        ],
        point: vec![PointLight {
            position: DVec3::new(0.4, -0.4, 0.5).into(),
            intensity: 0.5,
            radius: 0.25,
            ..PointLight::default()
        }],
        rig: Rig {
            kind: RigKind::Sky,
            intensity: 0.6,
            shadow_reach: None,
            sky: Sky { sun_size_deg: 12.0, ..Sky::default() },
            ..Rig::default()
        },
        follow_view: false,
    };
    let camera =
        Camera::looking_at(DVec3::new(0.6, -3.0, 1.2), DVec3::new(0.0, 0.0, -0.6), DVec3::Z);
    let fractal = Fractal::new(own::alone(text).expect("a formula"));
    let mut scene = traced(fractal, camera, lights);
    scene.integrator.bounces = 5;
    scene.integrator.reach = None;
    scene.surface.model = SurfaceModel::Physical;
    (scene.surface.roughness, scene.surface.metalness) = (0.55, 0.7);
    (scene.surface.coat, scene.surface.coat_roughness) = (0.6, 0.35);
    scene.surface.emission = 0.15;
    scene.surface.driven_by_layer =
        DrivenByLayer { roughness: true, metalness: true, coat: true, emission: true };
    scene
}

fn distance_to_balls() -> Distance {
    Box::new(|p| {
        let ball = |center: DVec3, radius: f64| p.distance(center) - radius;
        (p.z + 1.0)
            .min(ball(DVec3::new(-0.5, 0.0, -0.4), 0.6))
            .min(ball(DVec3::new(0.7, 0.2, -0.65), 0.35))
            .min(ball(DVec3::new(0.2, -0.8, -0.75), 0.25))
    })
}

/// How two pictures of the same paths differ.
struct Agreement {
    /// Part of the pixels that are within a thousandth.
    close: f64,
    /// Mean radiance over the oracle's.
    mean: f64,
    /// Standard error of that, if differences of pixels are chance.
    chance: f64,
}

fn channels(film: &[DVec3]) -> f64 {
    film.iter().map(|pixel| pixel.element_sum()).sum()
}

/// The film of a scene with so many paths a pixel.
fn film(scene: &Scene, paths: u32) -> Vec<DVec3> {
    let view = finished(&sampled(scene.clone(), paths + NO_PATHS), SIZE, Pace::Still);
    let film = view.film().expect("a film");
    film.into_iter().map(|pixel| DVec3::from(pixel.map(f64::from))).collect()
}

fn pixels() -> impl Iterator<Item = [u32; 2]> {
    (0..SIZE[0] * SIZE[1]).map(|i| [i % SIZE[0], i / SIZE[0]])
}

/// Draws a scene's paths with the kernels and with the oracle.
fn compared(name: &str, scene: &Scene, paths: &Paths, count: u32) -> Agreement {
    let found = film(scene, count);
    let mean_of = |pixel| {
        let sum: DVec3 = (0..count).map(|index| paths.traced(pixel, index)).sum();
        sum / f64::from(count)
    };
    let wanted: Vec<_> = pixels().map(mean_of).collect();
    let floor = channels(&wanted) / (3 * wanted.len()) as f64;
    let off: Vec<f64> = found
        .iter()
        .zip(&wanted)
        .map(|(a, b)| (a - b).abs().max_element() / b.max_element().max(0.1 * floor))
        .collect();
    let within =
        |most: f64| off.iter().filter(|off| **off < most).count() as f64 / off.len() as f64;
    let (close, mean) = (within(1e-3), channels(&found) / channels(&wanted));
    let squares: f64 = found.iter().zip(&wanted).map(|(a, b)| (a - b).element_sum().powi(2)).sum();
    let chance = squares.sqrt() / channels(&wanted);
    println!(
        "{name}: {:.1} % of the pixels within 1e-3, {:.1} % within 1e-2, {:.1} % within 0.1, median {:.1e}; \
         mean radiance {:.4}, {mean:.5} of the oracle's, chance {chance:.5}",
        100.0 * close,
        100.0 * within(1e-2),
        100.0 * within(0.1),
        quantile(off.clone(), 0.5),
        channels(&found) / (3 * found.len()) as f64,
    );
    if std::env::var_os("PATHS_MAP").is_some() {
        for row in off.chunks(SIZE[0] as usize) {
            let mark = |off: &f64| match *off {
                off if off < 1e-3 => '.',
                off if off < 1e-2 => '-',
                off if off < 0.1 => '+',
                _ => '#',
            };
            println!("{}", row.iter().map(mark).collect::<String>());
        }
    }
    Agreement { close, mean, chance }
}

#[test]
fn paths_among_balls_are_those_of_the_oracle() {
    let scene = balls();
    let paths = Paths::new(drawn(&scene, SIZE), SIZE, distance_to_balls());
    let Agreement { close, mean, chance } = compared("balls", &scene, &paths, PATHS);
    // Cones of camera rays go before the kernels' rays, which then end their last steps elsewhere.
    assert!(close > 0.85, "{close} of the pixels are close");
    assert!((mean - 1.0).abs() < 5e-4 + 4.0 * chance, "{mean} of the oracle's light");
}

#[test]
fn paths_through_a_sponge_are_those_of_the_oracle() {
    let mut fractal = Fractal::new(formula::find("menger_sponge").expect("a formula"));
    fractal.iterations = 2;
    let lights = Lights {
        environment: vec![
            EnvironmentLight {
                direction: toward(0.6, -0.7, 0.9),
                intensity: 1.2,
                size_deg: 40.0,
                shadow_reach: Some(0.8),
                ..EnvironmentLight::default()
            },
            EnvironmentLight {
                direction: toward(-0.7, -0.3, 0.5),
                color: [0.4, 0.6, 1.0],
                intensity: 0.6,
                ..EnvironmentLight::default()
            },
            EnvironmentLight {
                direction: toward(0.2, 0.3, 1.0),
                intensity: 0.1,
                size_deg: 10.0,
                casts_shadows: false,
                ..EnvironmentLight::default()
            },
        ],
        point: vec![PointLight {
            position: DVec3::new(-1.2, -1.6, 1.5).into(),
            ..PointLight::default()
        }],
        rig: Rig::default(),
        follow_view: false,
    };
    let camera =
        Camera::looking_at(DVec3::new(1.9, -3.1, 1.7), DVec3::new(0.0, 0.0, -0.1), DVec3::Z);
    let mut scene = traced(fractal, camera, lights);
    scene.quality.normals = Normals::Six;
    scene.integrator.bounces = 4;
    scene.integrator.reach = Some(0.5);
    (scene.surface.diffuse, scene.surface.specular, scene.surface.shininess) = (0.8, 0.2, 24.0);
    scene.surface.emission = 0.1;
    scene.surface.second_layer.amount = 0.3;
    let drawn = drawn(&scene, SIZE);
    let orbits = Orbits::of(&drawn.fractal);
    let paths = Paths::new(drawn, SIZE, Box::new(move |p| orbits.distance(p)));
    let Agreement { close, mean, chance } = compared("sponge", &scene, &paths, PATHS);
    assert!(close > 0.8, "{close} of the pixels are close");
    assert!((mean - 1.0).abs() < 2e-3 + 4.0 * chance, "{mean} of the oracle's light");
}

#[test]
fn paths_over_a_mandelbulb_are_those_of_the_oracle() {
    let lights = Lights {
        environment: Vec::new(),
        point: vec![PointLight {
            position: DVec3::new(1.4, -1.5, 0.4).into(),
            color: [1.0, 0.6, 0.5],
            radius: 0.2,
            ..PointLight::default()
        }],
        rig: Rig {
            kind: RigKind::Sky,
            intensity: 1.5,
            shadow_reach: None,
            sky: Sky { sun_size_deg: 20.0, ..Sky::default() },
            ..Rig::default()
        },
        follow_view: false,
    };
    let camera = Camera::looking_at(DVec3::new(0.4, -2.8, 0.9), DVec3::ZERO, DVec3::Z);
    let mut scene = traced(Fractal::from(Mandelbulb::default()), camera, lights);
    scene.quality.normals = Normals::Six;
    scene.quality.detail = 1.0;
    scene.integrator.bounces = 3;
    scene.integrator.reach = None;
    scene.surface.model = SurfaceModel::Physical;
    (scene.surface.roughness, scene.surface.metalness) = (0.5, 0.6);
    scene.surface.coat = 0.3;
    let drawn = drawn(&scene, SIZE);
    let bulb = Mandelbulb::of(&drawn.fractal);
    let paths = Paths::new(drawn, SIZE, Box::new(move |p| estimate::distance(&bulb, p)));
    let Agreement { close, mean, chance } = compared("mandelbulb", &scene, &paths, MANY_PATHS);
    assert!(close > 0.7, "{close} of the pixels are close");
    assert!((mean - 1.0).abs() < 2e-3 + 4.0 * chance, "{mean} of the oracle's light");
}

/// Lights, shares, weights and ends of paths change the noise, not the light.
#[test]
fn paths_have_the_light_of_paths_in_even_directions() {
    // Even directions seldom meet small lights.
    let mut physical = balls();
    physical.lights.environment[0].size_deg = 70.0;
    physical.lights.rig.sky.sun_size_deg = 45.0;
    physical.surface.coat_roughness = 0.5;
    let mut blinn_phong = physical.clone();
    blinn_phong.surface.model = SurfaceModel::BlinnPhong;
    (blinn_phong.surface.diffuse, blinn_phong.surface.specular) = (0.7, 0.2);
    for (name, scene) in [("physical", physical), ("Blinn-Phong", blinn_phong)] {
        let paths = Paths::new(drawn(&scene, SIZE), SIZE, distance_to_balls());
        let found = film(&scene, 64);
        let mut random = Random(0x5eed);
        const PLAIN: u32 = 2000;
        let plain: Vec<(DVec3, f64)> = pixels()
            .map(|pixel| {
                let (mut sum, mut squares) = (DVec3::ZERO, 0.0);
                for index in 0..PLAIN {
                    let seen = paths.plain(pixel, index % 64, &mut random);
                    sum += seen;
                    squares += seen.element_sum().powi(2);
                }
                let count = f64::from(PLAIN);
                let mean = sum / count;
                (mean, (squares / count - mean.element_sum().powi(2)) / count)
            })
            .collect();
        // Quarters of the picture, and all of it.
        let quarter = |i: usize| {
            let [x, y] = [i as u32 % SIZE[0], i as u32 / SIZE[0]];
            2 * (2 * y / SIZE[1]) + 2 * x / SIZE[0]
        };
        for part in 0..=4 {
            let inside = |i: &usize| part == 4 || quarter(*i) == part;
            let (mut of_kernels, mut of_oracle, mut variance) = (0.0, 0.0, 0.0);
            for i in (0..found.len()).filter(inside) {
                of_kernels += found[i].element_sum();
                of_oracle += plain[i].0.element_sum();
                variance += plain[i].1;
            }
            let (ratio, chance) = (of_kernels / of_oracle, variance.sqrt() / of_oracle);
            println!("{name}, part {part}: {ratio:.5} of the oracle's, chance {chance:.5}");
            assert!((ratio - 1.0).abs() < 4.0 * chance + 0.004, "{name}, part {part}: {ratio}");
        }
    }
}

/// A black sky leaves points that no light reaches.
#[test]
fn a_sun_in_a_black_sky_gives_finite_light() {
    let mut scene = balls();
    scene.lights.environment.clear();
    scene.lights.point.clear();
    let black = [0.0; 3];
    let sky = Sky { zenith: black, horizon: black, ground: black, ..Sky::default() };
    scene.lights.rig.sky = sky;
    scene.surface.emission = 0.0;
    let found = film(&scene, PATHS);
    let spoiled = found.iter().filter(|pixel| !pixel.is_finite()).count();
    println!("{spoiled} of {} pixels are no numbers", found.len());
    assert!(spoiled == 0, "{spoiled} pixels are no numbers");
    let paths = Paths::new(drawn(&scene, SIZE), SIZE, distance_to_balls());
    let Agreement { close, mean, .. } = compared("sun alone", &scene, &paths, PATHS);
    assert!(close > 0.9 && (mean - 1.0).abs() < 2e-3, "{close} close, {mean} of the light");
}

fn physical(roughness: f64, metalness: f64, coat: f64) -> Material {
    Material::Physical {
        color: DVec3::ONE,
        metalness,
        specular_color: DVec3::splat(0.04),
        roughness,
        coat,
        coat_roughness: 0.25,
    }
}

/// Roughness, metalness and coat of several materials.
const MATERIALS: [[f64; 3]; 6] = [
    [0.3, 0.0, 0.0],
    [0.3, 1.0, 0.0],
    [0.6, 0.5, 0.5],
    [1.0, 1.0, 0.0],
    [1.0, 0.0, 1.0],
    [0.1, 1.0, 1.0],
];

/// How far the table of albedos is off between its entries.
const FURNACE: f64 = 6e-3;

fn viewer(cosine: f64) -> DVec3 {
    let aside = (1.0 - cosine * cosine).sqrt();
    DVec3::new(0.6 * aside, -0.8 * aside, cosine)
}

/// In light from all sides a white surface of any roughness or coat is as bright as the light; one that is in part
/// metal is darker.
#[test]
fn a_white_furnace_hides_physical_surfaces() {
    const SAMPLES: u32 = 1 << 16;
    for [roughness, metalness, coat] in MATERIALS {
        for cosine in [0.2, 0.5, 0.95] {
            let seen = physical(roughness, metalness, coat).seen(DVec3::Z, viewer(cosine));
            let sum: f64 = (0..SAMPLES)
                .map(|i| {
                    let lobe = numbers::point(i, 1).x;
                    let wi = seen.sample(lobe, numbers::point(i, 2));
                    let density = seen.density(wi);
                    if density > 0.0 { seen.value(wi).x / density } else { 0.0 }
                })
                .sum();
            let albedo = sum / f64::from(SAMPLES);
            println!("{roughness} {metalness} {coat} {cosine}: {albedo:.5}");
            let is_mixed = metalness > 0.0 && metalness < 1.0;
            let least = if is_mixed { 0.7 } else { 1.0 - FURNACE };
            let is_right = albedo > least && albedo < 1.0 + FURNACE;
            assert!(is_right, "{roughness} {metalness} {coat} {cosine}: {albedo}");
        }
    }
}

/// Directions over the surface are as frequent as the density says.
#[test]
fn sampled_directions_follow_their_density() {
    const SAMPLES: u32 = 1 << 16;
    // Cells of equal solid angle, and places in each along a side.
    const CELLS: [usize; 2] = [12, 6];
    const FINE: u32 = 24;
    let blinn_phong =
        Material::BlinnPhong { diffuse: DVec3::splat(0.5), specular: 0.3, exponent: 20.0 };
    let materials = MATERIALS.iter().take(5).map(|&[roughness, metalness, coat]| {
        (format!("{roughness} {metalness} {coat}"), physical(roughness, metalness, coat))
    });
    for (name, material) in materials.chain([("Blinn-Phong".to_owned(), blinn_phong)]) {
        for cosine in [0.3, 0.9] {
            let seen = material.seen(DVec3::Z, viewer(cosine));
            let cell = |wi: DVec3| {
                let place = DVec2::new(wi.y.atan2(wi.x) / TAU + 0.5, wi.z);
                let column = ((place.x * CELLS[0] as f64) as usize).min(CELLS[0] - 1);
                ((place.y * CELLS[1] as f64) as usize).min(CELLS[1] - 1) * CELLS[0] + column
            };
            let mut counts = [0.0; CELLS[0] * CELLS[1]];
            for i in 0..SAMPLES {
                let wi = seen.sample(numbers::point(i, 3).x, numbers::point(i, 4));
                if wi.z > 0.0 {
                    counts[cell(wi)] += 1.0 / f64::from(SAMPLES);
                }
            }
            let mut expected = [0.0; CELLS[0] * CELLS[1]];
            let places = CELLS.map(|side| side as u32 * FINE);
            for i in 0..places[0] * places[1] {
                let part = |at: u32, count: u32| (f64::from(at) + 0.5) / f64::from(count);
                let turn = TAU * (part(i % places[0], places[0]) - 0.5);
                let z = part(i / places[0], places[1]);
                let aside = (1.0 - z * z).sqrt();
                let wi = DVec3::new(aside * turn.cos(), aside * turn.sin(), z);
                expected[cell(wi)] += seen.density(wi) * TAU / f64::from(places[0] * places[1]);
            }
            let whole: f64 = expected.iter().sum();
            let apart = |(a, b): (&f64, &f64)| (a - b).abs();
            let worst = counts.iter().zip(&expected).map(apart).fold(0.0, f64::max);
            println!("{name}, {cosine}: {whole:.4} over the surface, cells within {worst:.4}");
            assert!(whole < 1.001, "{name}, {cosine}: {whole}");
            assert!(worst < 3e-3, "{name}, {cosine}: {worst}");
        }
    }
    // The highlight alone is as bright as its share says where it is seen from above.
    let seen = blinn_phong.seen(DVec3::Z, DVec3::Z);
    let steps = 400_000;
    let albedo: f64 = (0..steps)
        .map(|i| {
            let z = (f64::from(i) + 0.5) / f64::from(steps);
            let wi = DVec3::new((1.0 - z * z).sqrt(), 0.0, z);
            seen.value(wi).x * TAU / f64::from(steps)
        })
        .sum();
    let highlight = 0.3 * 8.0 / 22.0;
    println!("highlight {:.5}, its share {highlight:.5}", albedo - 0.5);
}
