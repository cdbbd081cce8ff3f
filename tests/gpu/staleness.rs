//! The levels of staleness, held by counting dispatches: an edit restarts only its own.

use mandelight::{
    render::{
        Activity, Pace, View,
        pass::{self, bloom, histogram, mean, shade, shadow, tone},
        recorder::Dispatches,
    },
    scene::{
        BloomOrder, EnvironmentLight, IndirectKind, LightFrame, Normals, PointLight, Scene,
        ToneCurve, ToneMean,
    },
};
use mandelight_test_support::{
    compare::{assert_same, difference},
    view::{finished, pipelines, pixels, sampled, settle},
};

const SIZE: [u32; 2] = [96, 64];

/// Settles an interactive view, edits its scene, settles it again; returns the dispatches that
/// the edit cost.
fn cost_of(samples: u32, edit: impl FnOnce(&mut Scene)) -> Dispatches {
    cost_from(sampled(Scene::default(), samples), |_| (), edit)
}

/// The same from another scene.
fn cost_from(
    mut scene: Scene,
    prepare: impl FnOnce(&mut Scene),
    edit: impl FnOnce(&mut Scene),
) -> Dispatches {
    prepare(&mut scene);
    let mut view = finished(&scene, SIZE, Pace::Interactive);
    let before = view.dispatches().clone();
    edit(&mut scene);
    view.set_scene(&scene, false);
    settle(&mut view);
    view.dispatches().since(&before)
}

/// The passes without those over mip levels and statistics alone.
fn film_passes(dispatches: &Dispatches) -> Vec<&'static str> {
    let mut passes = dispatches.passes();
    passes.retain(|pass| !["blur", "expose", "reduce"].contains(pass));
    passes
}

/// Number of shadow rays, if every sample point faced every light.
fn shadow_rays(dispatches: &Dispatches) -> u64 {
    dispatches.of(&shadow::PASS).samples
}

#[test]
fn a_tone_edit_touches_only_the_film() {
    let cost = cost_of(3, |scene| scene.tone.exposure = 1.0);
    assert_eq!((cost.passes(), cost.total()), (vec!["tone"], 1));
}

#[test]
fn what_moves_no_light_marches_nothing() {
    let edits: [fn(&mut Scene); 10] = [
        |scene| scene.lights.environment[0].intensity = 1.0,
        |scene| scene.lights.environment[0].color = [0.1, 0.2, 0.3],
        |scene| scene.lights.environment[1].intensity = 0.0,
        |scene| scene.lights.environment[1].muted = true,
        |scene| scene.lights.environment[2].solo = true,
        |scene| scene.lights.environment.reverse(),
        |scene| {
            scene.lights.environment.remove(0);
        },
        |scene| scene.surface.diffuse = 0.5,
        |scene| scene.surface.coloring.repeats = 3.0,
        |scene| scene.background.top = [0.5; 3],
    ];
    for indirect in [IndirectKind::Off, IndirectKind::Uniform] {
        for edit in edits {
            let scene = sampled(Scene::default(), 1);
            let cost = cost_from(scene, |scene| scene.indirect.kind = indirect, edit);
            for pass in cost.passes() {
                let is_light = ["camera_rays", "shade", "indirect"].contains(&pass);
                assert!(is_light || pass::DISPLAY.iter().any(|shown| shown.name == pass), "{pass}");
            }
            assert!(cost.of(&shade::PASS).dispatches > 0);
        }
    }
}

/// What the shadow rays of one light over the picture count as. Edits at rest open on every pixel
/// or a lattice, whose own levels add up to as much but for what reaches beyond the region.
fn is_one_light(rays: u64) -> bool {
    let pixels = u64::from(SIZE[0] * SIZE[1]);
    (pixels..pixels * 3 / 2).contains(&rays)
}

#[test]
fn a_light_that_moves_is_marched_alone() {
    let edits: [fn(&mut Scene); 5] = [
        |scene| scene.lights.environment[0].direction = [0.0, -1.0, 0.0],
        |scene| scene.lights.environment[1].shadow_reach = Some(0.3),
        |scene| scene.lights.environment.insert(0, EnvironmentLight::default()),
        |scene| scene.lights.point.push(PointLight::default()),
        |scene| {
            scene.lights.environment.remove(1);
            scene.lights.point.push(PointLight::default());
        },
    ];
    for edit in edits {
        let cost = cost_of(1, edit);
        let passes = cost.passes();
        assert!(!passes.contains(&"march") && !passes.contains(&"normal"), "{passes:?}");
        assert!(is_one_light(shadow_rays(&cost)), "{cost:?}");
    }
    // No ray at all where nothing blocks them.
    let edits: [fn(&mut Scene); 3] = [
        |scene| scene.lights.environment[1].casts_shadows = false,
        |scene| scene.lights.environment[2].frame = LightFrame::Scene,
        |scene| scene.quality.shadows = false,
    ];
    for edit in edits {
        let cost = cost_of(1, edit);
        let passes = cost.passes();
        assert!(passes.contains(&"shade") && !passes.contains(&"shadow"), "{passes:?}");
        assert!(!passes.contains(&"march") && !passes.contains(&"normal"), "{passes:?}");
    }
}

/// No ray is marched toward a light without light, whatever else is; it gets its rays once it
/// shines, and keeps them.
#[test]
fn lights_without_light_wait_for_their_rays() {
    let dark: [fn(&mut Scene); 3] = [
        |scene| scene.lights.environment[1].muted = true,
        |scene| scene.lights.environment[1].intensity = 0.0,
        |scene| scene.lights.environment[1].color = [0.0; 3],
    ];
    let first = sampled(Scene::default(), 1);
    // Two of its lights cast shadows.
    let both = finished(&first, SIZE, Pace::Interactive).dispatches().clone();
    let both = shadow_rays(&both);
    for darken in dark {
        let mut scene = first.clone();
        darken(&mut scene);
        let mut view = finished(&scene, SIZE, Pace::Interactive);
        let one = shadow_rays(view.dispatches());
        assert!(is_one_light(one) && is_one_light(both / 2), "{one} {both}");
        let mut next = |scene: &Scene| {
            let before = view.dispatches().clone();
            view.set_scene(scene, false);
            settle(&mut view);
            let cost = view.dispatches().since(&before);
            assert!(!cost.passes().contains(&"march"));
            shadow_rays(&cost)
        };
        // Moved in the dark.
        scene.lights.environment[1].direction = [0.0, 0.0, 1.0];
        assert_eq!(next(&scene), 0);
        let mut bright = scene.clone();
        bright.lights.environment[1] =
            EnvironmentLight { direction: [0.0, 0.0, 1.0], ..first.lights.environment[1].clone() };
        assert!(is_one_light(next(&bright)));
        assert_eq!([next(&scene), next(&bright)], [0; 2]);
    }
}

#[test]
fn a_light_that_moves_in_the_dark_costs_nothing() {
    let cost = cost_from(
        sampled(Scene::default(), 2),
        |scene| scene.lights.environment[0].muted = true,
        |scene| {
            scene.lights.environment[0].direction = [0.0, 0.0, 1.0];
            scene.lights.environment[0].casts_shadows = false;
        },
    );
    assert_eq!(cost, Dispatches::default());
}

#[test]
fn the_eyes_separation_costs_nothing_where_there_is_one_picture() {
    let cost = cost_of(2, |scene| scene.camera.stereo.eye_separation_cm = 3.0);
    assert_eq!(cost, Dispatches::default());
    // What is measured from the pivot is light alone.
    let cost = cost_of(1, |scene| scene.camera.pivot = glam::DVec3::new(0.1, 0.0, 0.2).into());
    assert!(!cost.passes().contains(&"march"));
}

#[test]
fn an_edit_of_the_normals_marches_no_camera_ray() {
    let cost = cost_of(1, |scene| scene.quality.normals = Normals::TwentySix);
    let passes = cost.passes();
    assert!(!passes.contains(&"march"));
    assert!(["normal", "shadow", "shade"].iter().all(|pass| passes.contains(pass)), "{passes:?}");
}

#[test]
fn further_samples_after_a_light_edit_march_again() {
    let cost = cost_of(2, |scene| scene.surface.diffuse = 0.5);
    assert!(cost.passes().contains(&"march"));
}

#[test]
fn a_geometry_edit_marches() {
    let edits: [fn(&mut Scene); 4] = [
        |scene| _ = scene.fractal.set("power", 7.0),
        |scene| scene.fractal.iterations = 10,
        |scene| scene.camera.vertical_fov_deg = 30.0,
        |scene| scene.quality.detail = 2.0,
    ];
    for edit in edits {
        assert!(cost_of(1, edit).passes().contains(&"march"));
    }
}

/// What no scene asked for is neither computed nor allocated.
#[test]
fn mean_histogram_and_bloom_cost_nothing_while_off() {
    let view = finished(&sampled(Scene::default(), 3), SIZE, Pace::Interactive);
    let passes = view.dispatches().passes();
    assert!(["mean", "histogram", "bloom"].iter().all(|pass| !passes.contains(pass)), "{passes:?}");
    assert!(view.post().bytes().into_iter().sum::<u64>() < 64);
}

#[test]
fn tone_edits_find_out_nothing_anew() {
    let glowing = |scene: &mut Scene| {
        scene.tone.auto_exposure = true;
        scene.bloom.strength = 0.3;
    };
    let edits: [fn(&mut Scene); 6] = [
        |scene| scene.tone.exposure = 1.0,
        |scene| scene.tone.key = 0.3,
        |scene| scene.tone.mean = ToneMean::Arithmetic,
        |scene| scene.tone.curve = ToneCurve::Agx,
        |scene| scene.bloom.radius = 0.1,
        |scene| scene.bloom.order = BloomOrder::Before,
    ];
    for edit in edits {
        let cost = cost_from(sampled(Scene::default(), 2), glowing, edit);
        assert_eq!(film_passes(&cost), ["bloom", "tone"]);
        assert_eq!([&bloom::PASS, &tone::PASS].map(|pass| cost.of(pass).dispatches), [1, 1]);
    }
    // One after the other is switched on.
    let cost = cost_of(2, |scene| scene.tone.auto_exposure = true);
    assert_eq!(film_passes(&cost), ["mean", "tone"]);
    assert_eq!([&mean::PASS, &tone::PASS].map(|pass| cost.of(pass).dispatches), [1, 1]);
    let cost = cost_of(2, |scene| scene.bloom.strength = 0.3);
    assert_eq!(film_passes(&cost), ["bloom", "tone"]);
    assert_eq!([&bloom::PASS, &tone::PASS].map(|pass| cost.of(pass).dispatches), [1, 1]);
}

#[test]
fn a_histogram_is_made_only_while_it_is_watched() {
    let mut scene = sampled(Scene::default(), 2);
    let mut view = finished(&scene, SIZE, Pace::Interactive);
    assert_eq!(view.report().histogram, None);
    let before = view.dispatches().clone();
    view.watch_histogram(true);
    settle(&mut view);
    let cost = view.dispatches().since(&before);
    assert_eq!((cost.passes(), cost.total()), (vec!["histogram", "tone"], 2));
    let histogram = view.report().histogram.expect("a histogram");
    assert_eq!(histogram.bins.iter().sum::<u32>(), SIZE[0] * SIZE[1]);

    // The film stays as it is: so does what is known of it.
    scene.tone.exposure = 1.0;
    view.set_scene(&scene, false);
    settle(&mut view);
    assert_eq!(view.dispatches().of(&histogram::PASS).dispatches, 1);
    scene.lights.environment[0].intensity = 20.0;
    view.set_scene(&scene, false);
    settle(&mut view);
    assert_ne!(view.report().histogram.expect("a histogram"), histogram);

    let before = view.dispatches().clone();
    view.watch_histogram(false);
    settle(&mut view);
    assert_eq!(view.dispatches(), &before);
    assert_eq!(view.report().histogram, None);
}

#[test]
fn the_same_scene_costs_nothing() {
    assert_eq!(cost_of(2, |_| ()), Dispatches::default());
}

#[test]
fn a_resting_view_submits_nothing() {
    // A view that comes to rest sooner compiles them later.
    pipelines().specialize(&Scene::default());
    let mut view = finished(&sampled(Scene::default(), 2), SIZE, Pace::Interactive);
    let before = view.dispatches().clone();
    for frame in 0..50 {
        assert!(!view.pump(1000.0 + f64::from(frame)));
    }
    assert_eq!(view.dispatches(), &before);
    assert_eq!(view.report().activity, Activity::Idle);
    assert_eq!(view.report().samples_done, 2);
}

/// However the lattice was completed, the picture is the one that a still makes at once.
#[test]
fn refinement_ends_in_the_still() {
    let scene = sampled(Scene::default(), 3);
    pipelines().specialize(&Scene::default());
    for size in [SIZE, [101, 67], [5, 3]] {
        let refined = pixels(&finished(&scene, size, Pace::Interactive));
        let direct = pixels(&finished(&scene, size, Pace::Still));
        assert_same(&refined, &direct, size, &format!("{size:?}"));
    }
}

/// A view whose scene went through edits shows what a fresh one does.
#[test]
fn edits_leave_nothing_behind() {
    let first = sampled(Scene::default(), 2);
    let mut second = first.clone();
    second.fractal.set("power", 5.0);
    let mut third = second.clone();
    third.surface.ambient = 0.3;
    let mut view: View = finished(&first, SIZE, Pace::Interactive);
    for scene in [&second, &third] {
        view.set_scene(scene, false);
        settle(&mut view);
    }
    // The centre samples of a new power come from the general pipelines.
    let (mean, _) = difference(&pixels(&view), &pixels(&finished(&third, SIZE, Pace::Still)));
    assert!(mean < 0.5, "mean difference {mean}");
}
