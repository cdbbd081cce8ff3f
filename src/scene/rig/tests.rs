//! Tests of a rig's lights against numerical integrals of the sky or the environment map.

use std::f64::consts::{PI, TAU};

use super::*;
use crate::scene::{Scene, color::luminance, link};

/// ∫ radiance · weight over the sphere, by the midpoint rule.
fn integral(sky: &Sky, weight: impl Fn(DVec3) -> f64) -> DVec3 {
    let (rows, columns) = (2000, 64);
    let mut sum = DVec3::ZERO;
    for row in 0..rows {
        let polar = (f64::from(row) + 0.5) / f64::from(rows) * PI;
        for column in 0..columns {
            let azimuth = (f64::from(column) + 0.5) / f64::from(columns) * TAU;
            let (sin, cos) = polar.sin_cos();
            let direction = DVec3::new(sin * azimuth.cos(), sin * azimuth.sin(), cos);
            sum += sky.radiance(direction) * (weight(direction) * sin);
        }
    }
    sum * (PI / f64::from(rows) * TAU / f64::from(columns))
}

fn skies() -> Vec<Sky> {
    vec![
        Sky::default(),
        Sky { ground: [0.9, 0.1, 0.0], zenith: [0.0, 0.0, 1.0], ..Sky::default() },
        Sky { ground: [0.0; 3], horizon: [0.0; 3], ..Sky::default() },
        Sky { zenith: [0.0; 3], horizon: [0.0; 3], ..Sky::default() },
    ]
}

fn rig(sky: Sky, count: u32) -> Rig {
    Rig { kind: RigKind::Sky, count, sky, ..Rig::default() }
}

#[test]
fn a_skys_lights_preserve_its_energy_for_every_count() {
    for sky in skies() {
        let sun = DVec3::from_array(sky.sun_color.map(f64::from)) * sky.sun_strength;
        let expected = integral(&sky, |_| 1.0) / PI + sun;
        for count in 3..=64 {
            for sun_lights in [1, 2, 7, 32] {
                let lights = rig(Sky { sun_lights, ..sky.clone() }, count).lights();
                assert_eq!(lights.len(), count as usize);
                let sum: DVec3 = lights.iter().map(|(_, strength)| *strength).sum();
                let off = ((sum - expected) / expected.max(DVec3::splat(1e-9))).abs();
                assert!(off.max_element() < 1e-5, "{count} lights: {sum}, expected {expected}");
                assert!(lights.iter().all(|(to, _)| (to.length() - 1.0).abs() < 1e-9));
                assert!(lights.iter().all(|(_, strength)| strength.min_element() > -1e-12));
            }
        }
    }
}

#[test]
fn the_lights_approximate_the_skys_irradiance_for_every_normal() {
    let worst = |count| {
        skies()
            .into_iter()
            .map(|sky| {
                let sky = Sky { sun_strength: 0.0, ..sky };
                let lights = rig(sky.clone(), count).lights();
                let brightest = luminance(integral(&sky, |to| to.z.max(0.0)))
                    .max(luminance(integral(&sky, |to| (-to.z).max(0.0))));
                (0..40)
                    .map(|i| {
                        let z: f64 = 1.0 - (f64::from(i) + 0.5) / 20.0;
                        let (sin, cos) = (f64::from(i) * 1.7).sin_cos();
                        let n = DVec3::new(cos, sin, 0.0) * (1.0 - z * z).sqrt() + DVec3::Z * z;
                        let of = |to: DVec3| n.dot(to).max(0.0);
                        let lit: f64 =
                            lights.iter().map(|(to, s)| luminance(*s) * of(*to) * PI).sum();
                        (lit - luminance(integral(&sky, of))).abs() / brightest
                    })
                    .fold(0.0, f64::max)
            })
            .fold(0.0, f64::max)
    };
    let (many, few) = (worst(64), worst(16));
    assert!(many < 0.04 && few < 0.12, "64 lights are off by {many}, 16 by {few}");
}

#[test]
fn a_skys_lights_move_continuously_while_it_is_edited() {
    let at = |step: u32| {
        let blue = 0.3 + step as f32 * 1e-3;
        rig(Sky { zenith: [0.1, 0.2, blue], ..Sky::default() }, 24).lights()
    };
    for step in 0..50 {
        for ((a, before), (b, after)) in at(step).iter().zip(at(step + 1)) {
            assert!((*a - b).length() < 0.01 && (*before - after).length() < 0.01, "step {step}");
        }
    }
}

#[test]
fn the_suns_lights_lie_on_its_disc() {
    let sky = Sky { sun_lights: 12, sun_size_deg: 20.0, ..Sky::default() };
    let center = DVec3::from_array(sky.sun_direction);
    let lights = rig(sky, 32).lights();
    let angle = |to: DVec3| to.dot(center).clamp(-1.0, 1.0).acos().to_degrees();
    assert!(lights[..12].iter().all(|(to, _)| angle(*to) < 10.0));
    assert!(lights[..12].iter().any(|(to, _)| angle(*to) > 8.0));
    let alone = rig(Sky { sun_size_deg: 20.0, ..Sky::default() }, 32).lights();
    assert!(angle(alone[0].0) < 1e-5);
}

#[test]
fn an_environment_maps_lights_are_valid_and_preserve_its_energy() {
    let environment_map = EnvironmentMap::from_fn("studio.hdr", [64, 32], |to| {
        DVec3::new(1.0 + to.z, 0.3, if to.x > 0.8 { 900.0 } else { 0.1 })
    });
    let mut scene = Scene::default();
    for count in [3, 17, 61] {
        scene.lights.rig.count = count;
        let room = scene.lights.room_for_rig();
        scene.lights.rig.light_by(&environment_map, room);
        assert_eq!(scene.validate(), Ok(()));
        assert_eq!(scene.lights.rig.environment_map.name, "studio.hdr");
        let lights = scene.lights.rig.lights();
        assert_eq!(lights.len(), count as usize);
        let sum: DVec3 = lights.iter().map(|(_, strength)| *strength * PI).sum();
        assert!(
            ((sum - environment_map.energy()) / environment_map.energy()).abs().max_element()
                < 1e-5
        );
    }
    // The scene with the most lights still fits into a link.
    let link = link::to_fragment(&scene).unwrap();
    assert_eq!(link::from_fragment(&link), Ok(scene.clone()));
    assert!(link.len() < 4096, "{} characters", link.len());
    // The rig gets at most the lights that the scene has room for.
    scene.lights.rig.count = 64;
    let room = scene.lights.room_for_rig();
    scene.lights.rig.light_by(&environment_map, room);
    assert_eq!(scene.lights.len(), 64);
    assert_eq!(scene.validate(), Ok(()));
}

#[test]
fn rotating_an_environment_map_rotates_its_lights() {
    let mut rig = Rig::default();
    let environment_map = EnvironmentMap::from_fn("one", [64, 32], |to| {
        DVec3::splat(if to.dot(DVec3::Y) > 0.99 { 100.0 } else { 0.0 })
    });
    rig.light_by(&environment_map, 64);
    rig.environment_map.rotation_deg = 90.0;
    let strongest = rig.lights().into_iter().max_by(|a, b| a.1.x.total_cmp(&b.1.x)).unwrap();
    // Counterclockwise as seen from above: from +y to −x.
    assert!(strongest.0.dot(DVec3::NEG_X) > 0.98, "{}", strongest.0);
}
