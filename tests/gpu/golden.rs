//! A few small pictures that were looked at and found right.
//!
//! `cargo xtask bless` draws them again; look at them before you commit.

use std::{fs, path::PathBuf};

use mandelight::scene::{ColorSource, PointLight, PrecisePoint, Scene, presets};
use mandelight_test_support::{
    compare::{Tolerance, complaint},
    picture::Picture,
    view::{sampled, still},
};

const SIZE: [u32; 2] = [160, 100];

/// Another CPU or driver fuses and rounds other products, and rays that graze the surface then end
/// elsewhere: twice what differs between two orders of rays on one driver.
const TOLERANCE: Tolerance = Tolerance { pixels: 8, mean: 4.0, part: 0.01 };

fn path(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/gpu/golden").join(format!("{name}.png"))
}

fn bless(name: &str, drawn: &[u8]) {
    let file = fs::File::create(path(name)).expect("the golden picture's file");
    let mut encoder = png::Encoder::new(file, SIZE[0], SIZE[1]);
    encoder.set_color(png::ColorType::Rgba);
    let mut writer = encoder.write_header().expect("a PNG header");
    writer.write_image_data(drawn).expect("the golden picture");
}

/// Says how `drawn` differs from the golden picture of that name, or that there is none.
fn fault(name: &str, drawn: &[u8]) -> Option<String> {
    match fs::read(path(name)) {
        Ok(file) => complaint(drawn, &Picture::of(&file).bytes, SIZE, TOLERANCE),
        Err(error) => Some(format!("{error}; look at the picture and run `cargo xtask bless`")),
    }
}

fn check(name: &str, scene: &Scene) {
    let drawn = still(&sampled(scene.clone(), 4), SIZE);
    if std::env::var_os("MANDELIGHT_BLESS").is_some() {
        return bless(name, &drawn);
    }
    if let Some(fault) = fault(name, &drawn) {
        panic!("{}: {fault}", path(name).display());
    }
}

#[test]
fn a_missing_golden_picture_is_a_fault() {
    let fault = fault("of nothing", &vec![0; 4 * (SIZE[0] * SIZE[1]) as usize]);
    assert!(fault.is_some_and(|fault| fault.contains("cargo xtask bless")));
}

#[test]
fn the_opening_scene_looks_as_it_did() {
    check("opening", &presets::opening());
}

#[test]
fn a_julia_set_lit_by_a_point_looks_as_it_did() {
    let mut scene = Scene::default();
    scene.fractal.set("julia", true);
    scene.surface.coloring.source = ColorSource::AxisTrap;
    scene.lights.point = vec![PointLight {
        position: PrecisePoint::from(glam::DVec3::new(0.9, -1.4, 0.2)),
        color: [1.0, 0.5, 0.2],
        ..PointLight::default()
    }];
    check("julia", &scene);
}

#[test]
fn a_power_that_is_not_whole_looks_as_it_did() {
    let mut scene = Scene::default();
    scene.fractal.set("power", 4.6);
    scene.surface.coloring.source = ColorSource::Iterations;
    scene.surface.coloring.repeats = 0.2;
    check("real_power", &scene);
}
