//! Normals of every kind and shadows of every light, against the field in f64.

use glam::DVec3;
use mandelight::{
    formula::{
        DistanceField,
        mandelbulb::{Mandelbulb, deep::DeepField},
    },
    gpu::device::in_parallel,
    scene::{EnvironmentLight, Indirect, IndirectKind, LightFrame, Normals, PointLight, Scene},
};

use super::places::{self, Drawn, cone, drawn, found};

const SIZE: [u32; 2] = [36, 24];
const SCALES: [f64; 3] = [1e-6, 1e-13, 1e-27];

/// A pixel's point of the surface in the field's coordinates, and its hit distance.
struct Seen {
    index: usize,
    point: DVec3,
    normal: DVec3,
    toward_eye: DVec3,
    hit: f64,
}

fn seen(scene: &Scene, field: &DeepField, drawn: &Drawn) -> Vec<Seen> {
    let hit = scene.quality.detail * cone(scene, SIZE);
    let point = |index: usize| {
        let depth = f64::from(drawn.samples.depth[index]);
        let ray = places::ray(scene, SIZE, index, &field.origin());
        let normal = drawn.samples.normal[index].as_dvec3();
        (depth > 0.0).then(|| Seen {
            index,
            point: ray.at(depth),
            normal,
            toward_eye: -ray.direction,
            hit: hit * depth,
        })
    };
    let seen: Vec<_> = (0..drawn.film.len()).filter_map(point).collect();
    assert!(seen.len() * 2 > drawn.film.len(), "{} hits", seen.len());
    seen
}

/// The weights of the grid points that a kind of normal is made of (thesis figure 3.3).
fn grid(kind: Normals) -> Vec<(DVec3, DVec3)> {
    let offset =
        |k: i32| DVec3::new(f64::from(k % 3), f64::from(k / 3 % 3), f64::from(k / 9)) - 1.0;
    let is_in = |offset: &DVec3| {
        let away = offset.abs().element_sum();
        match kind {
            Normals::None | Normals::Analytic => false,
            Normals::Three => away <= 1.0 && offset.min_element() >= 0.0,
            Normals::Six => away == 1.0,
            Normals::Eighteen => away == 1.0 || away == 2.0,
            Normals::TwentySix => away > 0.0,
        }
    };
    let weight = |offset: DVec3| if offset == DVec3::ZERO { -DVec3::ONE } else { offset };
    (0..27).map(offset).filter(is_in).map(|offset| (offset, weight(offset))).collect()
}

/// The normal of that kind in f64; for the analytic one, of very small differences, or where these face away or are 0, of all
/// neighbours of a place in front of the point, or the nearest direction that does not.
fn normal(field: &DeepField, kind: Normals, seen: &Seen) -> DVec3 {
    let normal = fitted(field, kind, seen, seen.point);
    let is_away = kind == Normals::Analytic && normal.dot(seen.toward_eye) < 0.0;
    if !is_away {
        return normal;
    }
    let wide = fitted(field, Normals::TwentySix, seen, seen.point + seen.hit * seen.toward_eye);
    let toward = wide.dot(seen.toward_eye).min(0.0);
    if toward == 0.0 {
        return wide;
    }
    // Turned a hundredth of a radian further than a right angle.
    let across = (wide - toward * seen.toward_eye).normalize_or(seen.toward_eye);
    (across + 0.01 * seen.toward_eye).normalize()
}

/// The slope of the estimate about `center`, of any length.
fn fitted(field: &DeepField, kind: Normals, seen: &Seen, center: DVec3) -> DVec3 {
    let (kind, spacing) = match kind {
        Normals::None => return seen.toward_eye,
        Normals::Analytic => (Normals::Six, 1e-4 * seen.hit),
        kind => (kind, seen.hit),
    };
    let slope =
        |(offset, weight): (DVec3, DVec3)| weight * field.distance(center + spacing * offset);
    grid(kind).into_iter().map(slope).sum()
}

#[test]
fn normals_of_every_kind_agree_with_the_field() {
    for scale in SCALES {
        let mut scene = places::scene(scale);
        let field = places::field(&scene, SIZE);
        let space = places::about(field.reference().clone(), &scene);
        for kind in [
            Normals::None,
            Normals::Three,
            Normals::Six,
            Normals::Eighteen,
            Normals::TwentySix,
            Normals::Analytic,
        ] {
            scene.quality.normals = kind;
            let drawn = drawn(&scene, SIZE, &space);
            let seen = seen(&scene, &field, &drawn);
            let mut angles = in_parallel(&seen, |seen| {
                normal(&field, kind, seen).angle_between(seen.normal).to_degrees()
            });
            angles.sort_by(f64::total_cmp);
            let mean = angles.iter().sum::<f64>() / angles.len() as f64;
            let most = angles[angles.len() * 99 / 100];
            println!("{kind:?} at {scale:e}: {mean:.4}, {most:.4} degrees");
            assert!(mean < 0.05, "{kind:?} at {scale:e}: {mean} degrees");
            assert!(most < 0.5, "{kind:?} at {scale:e}: {most} degrees");
        }
    }
}

/// A scene with lights of every kind, in the order of their bits.
fn lit(fractal: Mandelbulb, scale: f64) -> Scene {
    let mut scene = places::at(fractal, scale);
    let rotation = scene.camera.rotation();
    let from = |direction: DVec3, frame: LightFrame, shadow_reach: Option<f64>| EnvironmentLight {
        direction: direction.normalize().to_array(),
        frame,
        shadow_reach,
        ..EnvironmentLight::default()
    };
    let outward = -scene.camera.forward();
    let aside = rotation * DVec3::X;
    scene.lights.environment = vec![
        from(outward + 0.8 * aside, LightFrame::Scene, Some(3.0)),
        from(DVec3::new(-0.7, 0.4, 0.6), LightFrame::View, Some(30.0)),
        from(outward + 0.4 * aside, LightFrame::Scene, None),
    ];
    let place = |way: DVec3| scene.camera.position.moved_by(rotation * way * scale, 1e-9 * scale);
    let point =
        |position| PointLight { position, intensity: scale * scale, ..PointLight::default() };
    scene.lights.point =
        vec![point(place(DVec3::new(0.5, 0.4, 0.1))), point(place(DVec3::new(-0.6, 0.2, -0.1)))];
    // Far behind the eye.
    let position = (outward * 3.0).into();
    scene.lights.point.push(PointLight { position, ..PointLight::default() });
    scene
}

/// The ways to a point's lights: unit vectors, and how far blockers may be.
fn ways(scene: &Scene, field: &DeepField, point: DVec3) -> Vec<(DVec3, f64)> {
    let environment = scene.lights.environment.iter().map(|light| {
        let direction = DVec3::from_array(light.direction);
        let toward = match light.frame {
            LightFrame::Scene => direction,
            LightFrame::View => scene.camera.rotation() * direction,
        };
        let reach = light.shadow_reach.map_or(f64::INFINITY, |v| v * scene.camera.view_unit());
        (toward, reach)
    });
    let points = scene.lights.point.iter().map(|light| {
        let way = field.local(&light.position) - point;
        (way.normalize(), way.length())
    });
    environment.chain(points).collect()
}

/// How wide a blocker must be to count: its distance from the ray over that to the point.
const SHADOW_CONE: f64 = 0.004;

/// How near the surface comes to a light's ray, over how near blocks it: below 1 the light is blocked.
/// Rays run inward in short steps, to one hit distance before the point, which is lifted off the
/// surface by two (thesis 4.5).
fn openness(field: &DeepField, power: f64, origin: DVec3, hit: f64, way: (DVec3, f64)) -> f64 {
    let (toward, reach) = way;
    let low = (4.0 - power).clamp(0.0, 1.0);
    let from_center = origin - field.center();
    let beside = from_center.dot(toward);
    let radius = field.bounding_radius();
    let far = -beside + (beside * beside - from_center.length_squared() + radius * radius).sqrt();
    let (mut s, mut least) = (far.min(reach), f64::INFINITY);
    while s > hit && least > 0.5 {
        let blocks = (SHADOW_CONE * (1.0 - 0.5 * low) * s).max((0.5 - 0.35 * low) * hit);
        let here = field.estimate(origin + toward * s);
        least = least.min(here.distance / blocks);
        s -= here.step.max(0.1 * blocks);
    }
    least
}

#[test]
fn shadows_of_every_light_agree_with_the_field() {
    for scale in SCALES {
        let scene = lit(Mandelbulb::default(), scale);
        let field = places::field(&scene, SIZE);
        let drawn = drawn(&scene, SIZE, &places::about(field.reference().clone(), &scene));
        let seen = seen(&scene, &field, &drawn);
        let lights = scene.lights.len();
        let some: Vec<_> = seen.into_iter().step_by(2).collect();
        let found = in_parallel(&some, |seen| {
            let origin = seen.point + seen.normal * (2.0 * seen.hit);
            let bits = drawn.samples.visibility[seen.index];
            let ways = ways(&scene, &field, origin).into_iter().enumerate();
            ways.map(|(bit, way)| {
                let facing = seen.normal.dot(way.0) > 1e-3;
                facing.then(|| {
                    let open = openness(
                        &field,
                        Mandelbulb::of(&scene.fractal).power,
                        origin,
                        seen.hit,
                        way,
                    );
                    (open, bits >> bit & 1 == 1)
                })
            })
            .collect::<Vec<_>>()
        });
        for light in 0..lights {
            let all: Vec<_> = found.iter().filter_map(|pixel| pixel[light]).collect();
            // What blocks by a hair, steps of other lengths miss.
            let clear = |(open, _): &(f64, bool)| !(0.8..1.25).contains(open);
            let pairs: Vec<_> = all.iter().copied().filter(clear).collect();
            let part = |count: usize| count as f64 / pairs.len().max(1) as f64;
            let agree = part(pairs.iter().filter(|pair| (pair.0 > 1.0) == pair.1).count());
            let reached = part(pairs.iter().filter(|pair| pair.0 > 1.0).count());
            let (count, of) = (pairs.len(), all.len());
            println!(
                "{scale:e}, light {light}: {count} of {of}, {reached:.3} lit, {agree:.4} agree"
            );
            assert!(count >= 40 && count * 5 > of * 4, "{scale:e}, light {light}: {count} of {of}");
            assert!(agree >= 0.98, "{scale:e}, light {light}: {agree} agree");
        }
    }
}

/// Light of every kind, direct and indirect, is the same in scene units and in those of an anchor.
#[test]
fn light_is_the_same_with_and_without_an_anchor() {
    for kind in [IndirectKind::Off, IndirectKind::Uniform, IndirectKind::Horizon] {
        let mut scene = lit(Mandelbulb::default(), 2e-3);
        scene.indirect = Indirect { kind, ..Indirect::default() };
        let plain = drawn(&scene, SIZE, &places::plain(&scene));
        let deep = drawn(&scene, SIZE, &places::about(found(&scene, SIZE), &scene));
        let mean = |film: &[[f32; 3]]| film.iter().flatten().sum::<f32>() / film.len() as f32;
        let pairs = plain.film.iter().flatten().zip(deep.film.iter().flatten());
        let mut off: Vec<_> = pairs.map(|(a, b)| (a - b).abs() / mean(&plain.film)).collect();
        off.sort_by(f32::total_cmp);
        let (nine_tenths, average) =
            (off[off.len() * 9 / 10], off.iter().sum::<f32>() / off.len() as f32);
        println!("{kind:?}: mean {}, off by {average} and {nine_tenths}", mean(&plain.film));
        assert!(mean(&plain.film) > 0.05, "{kind:?}: dark");
        assert!(average < 0.02 && nine_tenths < 0.02, "{kind:?}: {average} {nine_tenths}");
    }
}
