//! A few small pictures that were looked at and found right.
//!
//! `cargo xtask bless` draws them again; look at them before you commit.

use std::{fs, path::PathBuf};

use mandelight::scene::{ColorSource, PointLight, PrecisePoint, Scene};

use mandelight_test_support::{
    compare::difference,
    view::{sampled, still},
};

const SIZE: [u32; 2] = [160, 100];

/// Largest mean difference, in steps of 1/255, between drivers.
const TOLERANCE: f64 = 1.5;

fn path(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/gpu/golden").join(format!("{name}.png"))
}

fn check(name: &str, scene: &Scene) {
    let drawn = still(&sampled(scene.clone(), 4), SIZE);
    let path = path(name);
    if std::env::var_os("MANDELIGHT_BLESS").is_some() {
        let file = fs::File::create(&path).expect("the golden picture's file");
        let mut encoder = png::Encoder::new(file, SIZE[0], SIZE[1]);
        encoder.set_color(png::ColorType::Rgba);
        let mut writer = encoder.write_header().expect("a PNG header");
        writer.write_image_data(&drawn).expect("the golden picture");
        return;
    }
    let file = fs::File::open(&path).unwrap_or_else(|error| {
        panic!("{}: {error}; look at the picture and run `cargo xtask bless`", path.display())
    });
    let mut reader = png::Decoder::new(std::io::BufReader::new(file)).read_info().expect("a PNG");
    let mut golden = vec![0; drawn.len()];
    reader.next_frame(&mut golden).expect("the golden picture");
    let (mean, largest) = difference(&drawn, &golden);
    assert!(
        mean <= TOLERANCE,
        "{name} differs by {mean:.2} on the mean, {largest} at most, of {TOLERANCE} allowed"
    );
}

#[test]
fn golden_default() {
    check("default", &Scene::default());
}

#[test]
fn golden_julia_lit_by_a_point() {
    let mut scene = Scene::default();
    scene.fractal.julia = true;
    scene.surface.coloring.source = ColorSource::AxisTrap;
    scene.lights.point = vec![PointLight {
        position: PrecisePoint::from(glam::DVec3::new(0.9, -1.4, 0.2)),
        color: [1.0, 0.5, 0.2],
        ..PointLight::default()
    }];
    check("julia", &scene);
}

#[test]
fn golden_real_power() {
    let mut scene = Scene::default();
    scene.fractal.power = 4.6;
    scene.surface.coloring.source = ColorSource::Iterations;
    scene.surface.coloring.repeats = 0.2;
    check("real_power", &scene);
}
