//! What pictures must be like, whatever they show.

use std::f64::consts::TAU;

use glam::DVec3;
use mandelight::{
    gpu::readback::Readback,
    render::{
        Pace, Region, View,
        frame::record,
        integrator::DIRECT,
        recorder::{Dispatches, Recorder},
        schedule::{Display, KeptPixels, Points, Stage, Trace, Work},
        targets::Targets,
        uniforms::Inputs,
    },
    scene::{EnvironmentLight, LightFrame, PointLight, PrecisePoint, Scene, ToneCurve},
};
use mandelight_test_support::{
    compare::difference,
    device::gpu,
    view::{finished, pipelines, pixels, sampled, settle, still},
};

const SIZE: [u32; 2] = [120, 80];

/// While something moves the picture is sparse, yet nearer to the full one than a picture of
/// nearest known pixels would be.
#[test]
fn a_sparse_picture_is_filled_in_better_than_by_nearest_pixels() {
    let scene = sampled(Scene::default(), 1);
    let size = [256, 192];
    let full = still(&scene, size);
    for level in [2, 4, 6] {
        let filled = sparse(&scene, size, level);
        let nearest = nearest_fill(&full, size, 1 << (level / 2));
        let (filled_error, _) = difference(&filled, &full);
        let (nearest_error, _) = difference(&nearest, &full);
        assert!(
            filled_error < 0.95 * nearest_error,
            "level {level}: {filled_error} against {nearest_error}"
        );
    }
}

/// The picture as it is shown from one lattice level alone.
pub fn sparse(scene: &Scene, size: [u32; 2], level: u32) -> Vec<u8> {
    let pipelines = pipelines();
    let mut targets = Targets::new(&pipelines.layouts, Region::whole(size));
    let inputs = Inputs::new(scene, Region::whole(size));
    targets.fit_direct(&pipelines.layouts, inputs.has_indirect());
    targets.upload(&pipelines.gpu.queue, &inputs);
    let passes = pipelines.of_frame(&inputs);
    let mut dispatches = Dispatches::default();
    let trace =
        |points: Points, from| Work::Trace(Trace::whole(points, from, inputs.shining(), size));
    let indirect = inputs.has_indirect().then(|| trace(Points::Indirect(level), Stage::Indirect));
    let show = Work::Display(Display {
        level,
        fill: level > 0,
        from_film: false,
        adapt: 1.0,
        kept: KeptPixels::default(),
        refines: false,
    });
    let works = [Some(trace(Points::Level(level), Stage::March)), indirect, Some(show)];
    for work in works.into_iter().flatten() {
        let mut recorder =
            Recorder::new(&pipelines.layouts, &passes, &targets, &inputs, &mut dispatches);
        record(&DIRECT, &mut recorder, work);
        pipelines.gpu.queue.submit([recorder.finish()]);
    }
    let readback = Readback::texture(&pipelines.gpu, &targets.texture, size);
    readback.wait(&pipelines.gpu).expect("the picture's bytes")
}

/// The full picture as its lattice pixels alone would show it.
fn nearest_fill(full: &[u8], [width, height]: [u32; 2], spacing: u32) -> Vec<u8> {
    let nearest = |v: u32, side: u32| {
        let rounded = (v + spacing / 2) / spacing * spacing;
        if rounded < side { rounded } else { v / spacing * spacing }
    };
    (0..height)
        .flat_map(|y| (0..width).map(move |x| (x, y)))
        .flat_map(|(x, y)| {
            let at = 4 * (nearest(y, height) * width + nearest(x, width)) as usize;
            full[at..at + 4].to_vec()
        })
        .collect()
}

/// A whole power drawn by its own pipelines looks as it does by the general ones. A power next
/// to it takes the general pipelines' polar path.
#[test]
fn specialised_and_general_pipelines_agree() {
    for power in [2.0, 3.0, 8.0] {
        let mut scene = sampled(Scene::default(), 1);
        scene.fractal.set("power", power);
        scene.fractal.iterations = 6;
        let special = still(&scene, SIZE);
        scene.fractal.set("power", power + 1e-6);
        let general = still(&scene, SIZE);
        let (mean, _) = difference(&special, &general);
        assert!(mean < 1.0, "power {power}: mean difference {mean}");
    }
}

/// Light adds up: 64 equal lights of a 64th of the strength are one light.
#[test]
fn sixty_four_lights_are_the_sum_of_their_parts() {
    let mut scene = sampled(Scene::default(), 1);
    scene.tone.curve = ToneCurve::Linear;
    let light = EnvironmentLight { intensity: 0.8, ..EnvironmentLight::default() };
    scene.lights.environment = vec![light.clone()];
    let one = still(&scene, SIZE);
    scene.lights.environment = vec![EnvironmentLight { intensity: 0.8 / 64.0, ..light }; 64];
    let many = still(&scene, SIZE);
    let (_, largest) = difference(&one, &many);
    assert!(largest <= 1, "largest difference {largest}");
}

/// A point light far away is a directional light.
#[test]
fn a_distant_point_light_is_a_directional_light() {
    let mut scene = sampled(Scene::default(), 1);
    let direction = DVec3::new(0.3, -0.8, 0.5).normalize();
    scene.lights.environment = vec![EnvironmentLight {
        direction: direction.to_array(),
        intensity: 1.5,
        ..EnvironmentLight::default()
    }];
    let directional = still(&scene, SIZE);
    let distance = 95.0;
    scene.lights.environment.clear();
    scene.lights.point = vec![PointLight {
        position: PrecisePoint::from(direction * distance),
        intensity: 1.5 * distance * distance,
        ..PointLight::default()
    }];
    let (mean, _) = difference(&directional, &still(&scene, SIZE));
    assert!(mean < 1.0, "mean difference {mean}");
}

/// The bulb of power n turns into itself by 360/(n−1) degrees about its axis: so does a picture
/// of it whose camera and lights turn along.
#[test]
fn the_bulb_has_its_rotational_symmetry() {
    for power in [3.0, 8.0] {
        let mut scene = sampled(Scene::default(), 1);
        scene.fractal.set("power", power);
        let before = still(&scene, SIZE);
        let turn = glam::DQuat::from_rotation_z(TAU / (power - 1.0));
        let camera = &mut scene.camera;
        camera.position = PrecisePoint::from(turn * camera.position.to_dvec3());
        camera.pivot = PrecisePoint::from(turn * camera.pivot.to_dvec3());
        camera.orientation = (turn * camera.rotation()).into();
        let fixed = |light: &&mut EnvironmentLight| light.frame == LightFrame::Scene;
        for light in scene.lights.environment.iter_mut().filter(fixed) {
            light.direction = (turn * DVec3::from_array(light.direction)).to_array();
        }
        let (mean, _) = difference(&before, &still(&scene, SIZE));
        assert!(mean < 2.0, "power {power}: mean difference {mean}");
    }
}

/// Without a tone curve every channel grows with the light on it. (Reinhard's curve on luminance
/// lowers a channel where light of another colour is added.)
fn linear_scene() -> Scene {
    let mut scene = sampled(Scene::default(), 1);
    scene.tone.curve = ToneCurve::Linear;
    scene.tone.exposure = -2.0;
    scene
}

#[test]
fn shadows_only_darken() {
    let mut scene = linear_scene();
    let shadowed = still(&scene, SIZE);
    scene.quality.shadows = false;
    let unshadowed = still(&scene, SIZE);
    let darker = shadowed.iter().zip(&unshadowed).filter(|(s, u)| s > u).count();
    assert_eq!(darker, 0, "channels are brighter in shadow");
    assert!(difference(&shadowed, &unshadowed).0 > 0.5, "shadows make no difference");
}

/// A shorter reach removes blockers, so it only brightens.
#[test]
fn a_shorter_shadow_reach_only_brightens() {
    let mut scene = linear_scene();
    let whole = still(&scene, SIZE);
    for light in &mut scene.lights.environment {
        light.shadow_reach = Some(0.02);
    }
    let short = still(&scene, SIZE);
    let darker = whole.iter().zip(&short).filter(|(w, s)| w > s).count();
    // Marching from another start meets thin blockers at slightly other distances.
    assert!(darker * 200 < whole.len(), "{darker} channels of {} got darker", whole.len());
    assert!(difference(&whole, &short).0 > 1.0);
}

/// A light fixed to the view lights the same picture wherever the camera's roll turns it.
#[test]
fn view_lights_turn_with_the_camera() {
    let mut scene = sampled(Scene::default(), 1);
    scene.background.bottom = scene.background.top;
    for light in &mut scene.lights.environment {
        light.frame = LightFrame::View;
    }
    let size = [80, 80];
    let upright = still(&scene, size);
    // Rolled by a half turn: the picture is the same, upside down, as its lights are too.
    let roll = glam::DQuat::from_rotation_z(std::f64::consts::PI);
    scene.camera.orientation = (scene.camera.rotation() * roll).into();
    for light in &mut scene.lights.environment {
        light.direction = (roll * DVec3::from_array(light.direction)).to_array();
    }
    let mut rolled = still(&scene, size);
    rolled = rolled.as_chunks::<4>().0.iter().rev().flatten().copied().collect();
    let (mean, _) = difference(&upright, &rolled);
    assert!(mean < 1.5, "mean difference {mean}");
}

/// Oversampling smooths: neighbouring pixels differ less with 16 samples than with one.
#[test]
fn samples_smooth_the_picture() {
    let roughness = |picture: &[u8]| {
        let rows = picture.as_chunks::<4>().0.chunks(SIZE[0] as usize);
        rows.flat_map(|row| row.windows(2).map(|p| f64::from(p[0][1].abs_diff(p[1][1])))).sum()
    };
    let one: f64 = roughness(&still(&sampled(Scene::default(), 1), SIZE));
    let many: f64 = roughness(&still(&sampled(Scene::default(), 16), SIZE));
    assert!(many < 0.9 * one, "{many} against {one}");
}

/// The largest desktop screens fit into default limits. The camera looks away, so that no
/// orbit is followed.
#[test]
fn a_5k_view_works_within_default_limits() {
    let mut scene = sampled(Scene::default(), 1);
    let away = scene.camera.position.to_dvec3() * 2.0;
    scene.camera =
        mandelight::scene::Camera::looking_at(scene.camera.position.to_dvec3(), away, DVec3::Z);
    scene.background.top = [0.2; 3];
    scene.background.bottom = [0.2; 3];
    let view = finished(&scene, [5120, 2880], Pace::Still);
    let picture = pixels(&view);
    // 0.2 under Reinhard's curve is 0.169, sRGB 114, and every pixel was written.
    assert!(picture.as_chunks::<4>().0.iter().all(|p| (113..=115).contains(&p[0]) && p[3] == 255));
}

#[test]
fn the_time_of_a_picture_begins_with_its_size() {
    let mut view = View::new(pipelines(), Region::whole(SIZE), Pace::Interactive);
    view.set_scene(&sampled(Scene::default(), 1), false);
    let finish = |view: &mut View, mut now_secs: f64| {
        let mut pumps = 0;
        while view.pump(now_secs) {
            gpu().wait();
            now_secs += 0.01;
            pumps += 1;
        }
        pumps
    };
    let first = finish(&mut view, 0.0);
    let first_secs = view.report().elapsed_secs;
    // At rest, time does not count, however seldom the page is drawn.
    for idle_secs in [60.0, 3600.0] {
        view.pump(idle_secs);
    }
    assert_eq!(view.report().elapsed_secs, first_secs);
    view.set_region(Region::whole([60, 90]));
    let second = finish(&mut view, 3600.0);
    let most_secs = 0.01 * f64::from(second + 1);
    let elapsed_secs = view.report().elapsed_secs;
    assert!(
        elapsed_secs > 0.0 && elapsed_secs <= most_secs,
        "{elapsed_secs} s after {first} and {second} pumps"
    );
}

#[test]
fn a_new_size_shows_the_old_picture_until_there_is_a_new_one() {
    let scene = sampled(Scene::default(), 1);
    let mut view = finished(&scene, SIZE, Pace::Interactive);
    view.set_region(Region::whole([60, 90]));
    assert_eq!(view.texture().map(wgpu::Texture::width), Some(SIZE[0]));
    settle(&mut view);
    assert_eq!(view.texture().map(wgpu::Texture::width), Some(60));
    assert!(difference(&pixels(&view), &still(&scene, [60, 90])).0 < 0.5);
}
