//! Path tracing against pictures of the same scenes by Mitsuba 3, which `tests/references/mitsuba.py` renders.

use std::path::Path;

use glam::DVec3;
use mandelight::{
    formula::{Fractal, own},
    render::Pace,
    scene::{
        Axis, Background, Camera, ColorSource, EnvironmentLight, Fog, GradientStop, IntegratorKind,
        Lights, Medium, MediumKind, PointLight, Rig, RigKind, Scene, Sky, SurfaceModel, param,
    },
};
use mandelight_test_support::view::{finished, sampled};

/// Width and height of the references.
const SIZE: [usize; 2] = [48, 36];
/// The pictures here have so many pixels a side for each of the reference's: paths start a few pixels' radii above
/// the surface, which is nearer to a light.
const FINER: usize = 4;
/// A block's side, in pixels of the references.
const BLOCK: usize = 6;

/// Linear radiance, the first row on top.
struct Picture(Vec<DVec3>);

impl Picture {
    fn of(scene: &Scene) -> Self {
        let size = SIZE.map(|side| (side * FINER) as u32);
        let film = finished(scene, size, Pace::Still).film().expect("a film");
        let mut pixels = vec![DVec3::ZERO; SIZE[0] * SIZE[1]];
        for (i, radiance) in film.into_iter().enumerate() {
            let [x, y] = [i % (SIZE[0] * FINER), i / (SIZE[0] * FINER)].map(|place| place / FINER);
            pixels[y * SIZE[0] + x] +=
                DVec3::from_array(radiance.map(f64::from)) / (FINER * FINER) as f64;
        }
        Self(pixels)
    }

    fn reference(name: &str) -> Self {
        let path = Path::new(env!("CARGO_MANIFEST_DIR"))
            .join(format!("tests/references/mitsuba_{name}.exr"));
        let image = exr::prelude::read_first_rgba_layer_from_file(
            path,
            |size, _| vec![DVec3::ZERO; size.area()],
            |pixels, at, (r, g, b, _): (f32, f32, f32, f32)| {
                pixels[at.y() * SIZE[0] + at.x()] = DVec3::new(r.into(), g.into(), b.into());
            },
        )
        .expect("a reference picture");
        let size = image.layer_data.size;
        assert_eq!([size.width(), size.height()], SIZE);
        Self(image.layer_data.channel_data.pixels)
    }

    /// The mean of the pixels from `first` on, as many as `size` says.
    fn mean(&self, first: [usize; 2], size: [usize; 2]) -> DVec3 {
        let rows = first[1]..first[1] + size[1];
        let sum: DVec3 = rows.flat_map(|y| &self.0[y * SIZE[0] + first[0]..][..size[0]]).sum();
        sum / (size[0] * size[1]) as f64
    }

    /// The means of all parts of this size.
    fn means(&self, size: [usize; 2]) -> Vec<DVec3> {
        let [columns, rows] = [SIZE[0] / size[0], SIZE[1] / size[1]];
        (0..columns * rows)
            .map(|i| self.mean([i % columns * size[0], i / columns * size[1]], size))
            .collect()
    }
}

/// Greatest differences, relative; those of parts over the part's own radiance and half of the picture's.
#[derive(Debug)]
struct Differences {
    whole: f64,
    quarters: f64,
    blocks: f64,
}

impl Differences {
    fn of(name: &str, scene: &Scene) -> Self {
        let (found, wanted) = (Picture::of(scene), Picture::reference(name));
        let mean = wanted.mean([0, 0], SIZE);
        let greatest = |size: [usize; 2]| {
            let pairs = found.means(size).into_iter().zip(wanted.means(size));
            pairs
                .map(|(found, wanted)| {
                    ((found - wanted) / wanted.max(0.5 * mean)).abs().max_element()
                })
                .fold(0.0, f64::max)
        };
        let all = Self {
            whole: greatest(SIZE),
            quarters: greatest(SIZE.map(|side| side / 2)),
            blocks: greatest([BLOCK; 2]),
        };
        println!("{name}: {} over {mean}, {all:?}", found.mean([0, 0], SIZE));
        all
    }

    fn assert_below(self, most: Self) {
        let is_near =
            self.whole < most.whole && self.quarters < most.quarters && self.blocks < most.blocks;
        assert!(is_near, "{self:?} instead of at most {most:?}");
    }
}

/// A path traced scene of the surface whose distance is `distance`, without background.
fn traced(distance: &str, bound: u32, bounces: u32, lights: Lights) -> Scene {
    let text = format!(
        "name \"Solid\"; step {{ z = z; }} estimate distance {distance}; bound {bound}; iterations 2;"
    );
    let mut scene = Scene {
        fractal: Fractal::new(own::alone(&text).expect("a formula")),
        lights,
        background: Background::gradient([0.0; 3], [0.0; 3]),
        ..Scene::default()
    };
    let surface = &mut scene.surface;
    (surface.ambient, surface.diffuse, surface.specular) = (0.0, 1.0, 0.0);
    let integrator = &mut scene.integrator;
    (integrator.kind, integrator.bounces, integrator.reach) = (IntegratorKind::Path, bounces, None);
    // Paths start and end at hit distances from the surface.
    scene.quality.detail = param::DETAIL.min;
    sampled(scene, 32)
}

/// Light of a disc of directions, and of a ball.
fn disc_and_ball() -> Lights {
    Lights {
        environment: vec![EnvironmentLight {
            direction: DVec3::new(0.5, 0.2, 0.9).normalize().to_array(),
            color: [1.0, 0.9, 0.7],
            intensity: 0.8,
            size_deg: 30.0,
            shadow_reach: None,
            ..EnvironmentLight::default()
        }],
        point: vec![PointLight {
            position: DVec3::new(-1.4, -0.8, 1.9).into(),
            color: [0.6, 0.8, 1.0],
            intensity: 4.0,
            radius: 0.3,
            ..PointLight::default()
        }],
        ..Lights::default()
    }
}

/// The rig that is a sky without a sun.
fn sky([zenith, horizon, ground]: [[f32; 3]; 3]) -> Rig {
    Rig {
        kind: RigKind::Sky,
        shadow_reach: None,
        sky: Sky { zenith, horizon, ground, sun_strength: 0.0, ..Sky::default() },
        ..Rig::default()
    }
}

/// A ball above a floor.
fn ball(lights: Lights) -> Scene {
    let distance = "min(p.z + 1, length(p - vec3(0, 0, -0.2)) - 0.6)";
    let mut scene = traced(distance, 3, 6, lights);
    let (eye, target) = (DVec3::new(0.0, -2.2, 3.2), DVec3::new(0.0, 0.0, -0.7));
    scene.camera = Camera { vertical_fov_deg: 36.0, ..Camera::looking_at(eye, target, DVec3::Z) };
    scene
}

#[test]
fn two_lights_shine_on_a_ball_and_a_floor_of_two_colours() {
    let mut scene = ball(disc_and_ball());
    let coloring = &mut scene.surface.coloring;
    (coloring.source, coloring.axis) = (ColorSource::Position, Axis::Z);
    (coloring.repeats, coloring.offset) = (1.0, 0.0);
    // The floor is at 0.333, and the ball's lowest point at 0.367.
    let (floor, body) = ([0.8, 0.8, 0.75], [0.75, 0.3, 0.15]);
    let stops = [(0.0, floor), (0.348, floor), (0.352, body), (0.99, body), (1.0, floor)];
    scene.surface.gradient =
        stops.map(|(position, color)| GradientStop { position, color }).to_vec();
    let found = Differences::of("diffuse_ball", &scene);
    found.assert_below(Differences { whole: 0.01, quarters: 0.015, blocks: 0.03 });
}

#[test]
fn a_white_sky_shines_into_a_box() {
    // Two pairs of walls, the wall at the back, and a ball.
    let slab =
        |q: &str| format!("length(max({q}, vec3(0))) + min(max(max({q}.x, {q}.y), {q}.z), 0)");
    let [sides, ends, back] = [
        "(abs(vec3(abs(p.x) - 1.05, p.y, p.z)) - vec3(0.05, 1.1, 1.1))",
        "(abs(vec3(p.x, p.y, abs(p.z) - 1.05)) - vec3(1.1, 1.1, 0.05))",
        "(abs(vec3(p.x, p.y - 1.05, p.z)) - vec3(1.1, 0.05, 1.1))",
    ]
    .map(slab);
    let body = "length(p - vec3(-0.3, 0.2, -0.4)) - 0.45";
    let distance = format!("min(min({sides}, {ends}), min({back}, {body}))");
    let lights = Lights { environment: Vec::new(), rig: sky([[1.0; 3]; 3]), ..Lights::default() };
    let mut scene = traced(&distance, 2, 30, lights);
    let (eye, target) = (DVec3::new(0.2, -4.2, 0.3), DVec3::new(0.05, 0.0, 0.02));
    scene.camera = Camera { vertical_fov_deg: 26.0, ..Camera::looking_at(eye, target, DVec3::Z) };
    scene.surface.gradient = vec![GradientStop { position: 0.0, color: [0.9, 0.7, 0.4] }];
    let found = Differences::of("box", &scene);
    found.assert_below(Differences { whole: 0.01, quarters: 0.015, blocks: 0.03 });
}

#[test]
fn rough_metal_mirrors_lights_and_a_sky() {
    let lights =
        Lights { rig: sky([[0.2, 0.4, 0.9], [0.9, 0.6, 0.5], [0.3, 0.2, 0.1]]), ..disc_and_ball() };
    let mut scene = ball(lights);
    let surface = &mut scene.surface;
    surface.model = SurfaceModel::Physical;
    (surface.roughness, surface.metalness, surface.coat) = (0.3, 1.0, 0.0);
    surface.gradient = vec![GradientStop { position: 0.0, color: [1.0; 3] }];
    let found = Differences::of("metal_ball", &scene);
    // The light between the ball and the floor is the noisiest.
    found.assert_below(Differences { whole: 0.01, quarters: 0.015, blocks: 0.08 });
}

#[test]
fn two_lights_shine_through_fog() {
    let mut scene = ball(disc_and_ball());
    scene.lights.point[0].radius = 0.03;
    scene.surface.gradient = vec![GradientStop { position: 0.0, color: [0.8; 3] }];
    scene.integrator.bounces = 20;
    let unit = scene.camera.view_unit();
    scene.fog = Fog {
        density: 0.2 * unit,
        color: [0.9, 0.7, 0.5],
        anisotropy: 0.4,
        radius: 5.5 / unit,
        ..Fog::default()
    };
    let found = Differences::of("foggy_ball", &scene);
    // Fog close to the small light makes the reference noisy: one pixel is off by 29 %.
    found.assert_below(Differences { whole: 0.01, quarters: 0.015, blocks: 0.08 });
}

#[test]
fn light_scatters_inside_a_ball() {
    let text = "name \"Ball\"; step { z = z * length(z); } estimate distance length(p) - 1; bound 1.5; iterations 40;";
    let lights = Lights {
        environment: disc_and_ball().environment,
        rig: sky([[1.0; 3]; 3]),
        ..Lights::default()
    };
    let mut scene = traced("length(p) - 1", 2, 64, lights);
    scene.fractal = Fractal::new(own::alone(text).expect("a formula"));
    let eye = DVec3::new(0.0, -4.0, 1.0);
    let camera = Camera::looking_at(eye, DVec3::ZERO, DVec3::Z);
    scene.camera = Camera { vertical_fov_deg: 36.0, ..camera };
    scene.medium = Medium {
        kind: MediumKind::Set,
        color: [0.98, 0.9, 0.7],
        mean_free_path: 0.2 / scene.camera.view_unit(),
        anisotropy: -0.3,
        ..Medium::default()
    };
    let found = Differences::of("cloudy_ball", &scene);
    found.assert_below(Differences { whole: 0.01, quarters: 0.015, blocks: 0.04 });
}
