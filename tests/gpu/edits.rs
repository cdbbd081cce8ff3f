//! Whatever was edited, in which order, and how far the picture was when the next edit came: it
//! ends as the picture of a view that never saw another scene.

use glam::DVec3;
use mandelight::{
    formula::Ray,
    fractal::FractalModel,
    render::{Pace, Pipelines, Region, View},
    scene::{
        EnvironmentLight, IndirectKind, Normals, PointLight, PrecisePoint, RigKind, Scene, follow,
        presets,
    },
};
use mandelight_test_support::{
    compare::{RESIZED, SAME, Tolerance, assert_same, assert_within, complaint},
    view::{finished, pipelines, pixels, sampled, settle, still},
};

const SIZE: [u32; 2] = [67, 50];

/// Numbers that look random: a linear congruential generator (Knuth's MMIX constants).
struct Dice(u64);

impl Dice {
    /// A number below `count`.
    fn below(&mut self, count: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        ((self.0 >> 33) % count as u64) as usize
    }

    fn unit(&mut self) -> f64 {
        self.below(1 << 20) as f64 / f64::from(1 << 20)
    }

    fn direction(&mut self) -> [f64; 3] {
        let [x, y, z] = [(); 3].map(|()| self.unit() - 0.5);
        DVec3::new(x, y, z + 0.01).normalize_or(DVec3::Z).to_array()
    }

    fn color(&mut self) -> [f32; 3] {
        [(); 3].map(|()| self.unit() as f32)
    }
}

/// Changes something of the scene; most often lights.
fn edit(scene: &mut Scene, dice: &mut Dice) {
    let lights = &mut scene.lights;
    let count = lights.environment.len();
    let any = if count > 0 { dice.below(count) } else { 0 };
    match (dice.below(18), count) {
        (0 | 1, 0..=5) => lights.environment.insert(
            any,
            EnvironmentLight {
                direction: dice.direction(),
                color: dice.color(),
                ..EnvironmentLight::default()
            },
        ),
        (2, 1..) => {
            lights.environment.remove(any);
        }
        (3..=5, 1..) => lights.environment[any].direction = dice.direction(),
        (6, 1..) => lights.environment[any].color = dice.color(),
        (7 | 8, 1..) => lights.environment[any].muted ^= true,
        (9, 1..) => lights.environment[any].solo ^= true,
        (10, 1..) => lights.environment[any].casts_shadows ^= true,
        (11, _) if lights.point.is_empty() => lights.point.push(PointLight::default()),
        (11, _) => lights.point[0].position = (1.4 * DVec3::from_array(dice.direction())).into(),
        (12, _) => {
            lights.rig.kind = [RigKind::Sky, RigKind::None][dice.below(2)];
            lights.rig.count = 3 + dice.below(3) as u32;
        }
        (13, _) => scene.surface.diffuse = dice.unit(),
        (14, _) => scene.quality.normals = [Normals::Six, Normals::Analytic][dice.below(2)],
        (15, _) => {
            let kinds = [IndirectKind::Off, IndirectKind::Uniform, IndirectKind::Horizon];
            scene.indirect.kind = kinds[dice.below(3)];
        }
        (16, _) => scene.camera.vertical_fov_deg = 30.0 + 20.0 * dice.unit(),
        _ => scene.tone.exposure = dice.unit(),
    }
}

/// Edits a view's scene again and again, at any moment of its refinement, gives it another region
/// now and then, and lets it finish.
fn edited(
    pipelines: &'static std::sync::Arc<Pipelines>,
    dice: &mut Dice,
) -> (Scene, View, Tolerance) {
    let mut scene = sampled(Scene::default(), 1 + dice.below(2) as u32);
    // Openings on sparse lattices have the most to remember.
    scene.quality.motion_budget_ms = 4.0;
    let mut view = View::new(pipelines, Region::whole(SIZE), Pace::Interactive);
    let (mut now_secs, mut tolerance) = (0.0, SAME);
    for _ in 0..12 {
        for _ in 0..=dice.below(2) {
            edit(&mut scene, dice);
        }
        if dice.below(4) == 0 {
            // The same size elsewhere in a larger picture, or another size, of which two keep pixels.
            let other = Region { picture_px: [90, 70], origin_px: [20, 11], ..Region::whole(SIZE) };
            let sizes = [SIZE, [40, 33], [91, 50], [53, 50]];
            let region = sizes.get(dice.below(5)).map_or(other, |&size_px| Region::whole(size_px));
            view.set_region(region);
            tolerance = RESIZED;
        }
        view.set_scene(&scene, dice.below(3) == 0);
        for _ in 0..dice.below(9) {
            now_secs += 0.016;
            view.pump(now_secs);
            if dice.below(2) == 0 {
                pipelines.gpu.wait();
            }
        }
    }
    view.set_scene(&scene, false);
    for _ in 0..20_000 {
        now_secs += 0.016;
        if !view.pump(now_secs) {
            return (scene, view, tolerance);
        }
        pipelines.gpu.wait();
    }
    panic!("the view never rests: {:?}", view.report());
}

#[test]
fn edits_at_any_moment_end_in_the_picture_of_a_fresh_view() {
    let pipelines = pipelines();
    // A view that comes to rest sooner compiles them later.
    pipelines.specialize(&Scene::default());
    for seed in 0..40 {
        let (scene, view, tolerance) = edited(pipelines, &mut Dice(seed));
        let mut fresh = View::new(pipelines, view.region(), Pace::Still);
        fresh.set_scene(&scene, false);
        settle(&mut fresh);
        let what = format!("seed {seed}: {scene:#?}");
        assert_within(&pixels(&view), &pixels(&fresh), view.region().size_px, tolerance, &what);
    }
}

/// The same where nothing is interrupted: each of a few edits of lights, one after the other.
#[test]
fn a_light_that_moves_ends_in_the_picture_of_a_fresh_view() {
    pipelines().specialize(&Scene::default());
    let mut scene = sampled(Scene::default(), 1);
    let mut view = finished(&scene, SIZE, Pace::Interactive);
    let edits: [fn(&mut Scene); 4] = [
        |scene| scene.lights.environment[1].direction = [0.0, -1.0, 0.0],
        |scene| scene.lights.environment[0].color = [0.1, 0.9, 0.1],
        |scene| {
            scene.lights.environment.remove(0);
        },
        |scene| scene.lights.environment.insert(0, EnvironmentLight::default()),
    ];
    for edit in edits {
        let before = pixels(&view);
        edit(&mut scene);
        view.set_scene(&scene, false);
        settle(&mut view);
        let after = pixels(&view);
        assert!(after != before, "the edit shows");
        assert_same(&after, &still(&scene, SIZE), SIZE, "an edit of lights");
    }
}

/// The opening scene, its eye moved to `unit` from the surface, toward the pivot.
fn close(unit: f64) -> Scene {
    let mut scene = sampled(presets::opening(), 1);
    scene.indirect.kind = IndirectKind::Off;
    let model = FractalModel::new(&scene.fractal);
    let camera = &mut scene.camera;
    let ray = Ray { origin: camera.position.to_dvec3(), direction: camera.forward() };
    let depth = model.whole().march(ray, 1e-7, f64::INFINITY).expect("the set is there");
    camera.pivot = PrecisePoint::from(ray.at(depth));
    camera.position = PrecisePoint::from(ray.at(depth - unit));
    scene
}

/// Close surfaces have more grazing rays, which end elsewhere where they start elsewhere: a few
/// pixels of a region, where a stale light changes most of them.
const CLOSE: Tolerance = Tolerance { pixels: 20, mean: 12.0, part: 0.04 };

/// Lights that follow the view turn while it comes closer, and while it turns there.
#[test]
fn lights_that_follow_end_in_the_picture_of_their_effective_set() {
    pipelines().specialize(&close(0.5));
    let mut view = finished(&close(0.5), SIZE, Pace::Interactive);
    let turned = |unit: f64| {
        let mut scene = close(unit);
        let turn = glam::DQuat::from_rotation_z(0.3) * scene.camera.rotation();
        scene.camera.orientation = turn.normalize().into();
        scene
    };
    let off = |unit: f64| {
        let mut scene = close(unit);
        scene.lights.follow_view = false;
        scene
    };
    for scene in [close(5e-3), close(2e-3), turned(2e-3), close(8e-4), off(8e-4), turned(8e-4)] {
        let before = pixels(&view);
        view.set_scene(&scene, false);
        settle(&mut view);
        let after = pixels(&view);
        assert!(complaint(&after, &before, SIZE, CLOSE).is_some(), "the change shows");
        let lights = follow::effective(&scene.lights, &scene.camera).into_owned();
        let fixed = Scene { lights, ..scene.clone() };
        let fresh = still(&scene, SIZE);
        assert!(fresh == still(&fixed, SIZE), "the lights are not the effective ones");
        let what = format!("a view of {:e}", scene.camera.view_unit());
        assert_within(&after, &fresh, SIZE, CLOSE, &what);
    }
}
