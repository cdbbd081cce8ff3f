//! The camera's movements at every scale, from the whole scene to 1e-27, in a scene whose surface
//! is known exactly: the same gestures have the same effect, in pixels and seconds.

use std::sync::atomic::{AtomicU32, Ordering};

use glam::{DQuat, DVec2, DVec3};
use mandelight::{
    formula::{DistanceField, march::DEEP_FOOTPRINT},
    fractal::pixel_cone,
    scene::{Camera, PrecisePoint},
    ui::navigation::{FlyInput, Navigator, Viewport, World, flight::MAX_ZOOM_PER_SEC},
};

const VIEWPORT: Viewport = Viewport { aspect: 16.0 / 9.0, height_px: 1000.0, detail: 1.0 };
const SCALES: [f64; 6] = [0.3, 1e-5, 1e-9, 1e-13, 1e-20, 1e-26];

/// A ball about the scene's origin with a valley cut into it, whose walls meet at an exact point:
/// around that point it looks the same at every scale.
struct Valley {
    bottom: PrecisePoint,
    /// Normals of the walls.
    walls: [DVec3; 2],
    /// Radius of a boulder that hangs in the valley, four radii from the bottom and behind
    /// the camera; zero for none.
    boulder: f64,
}

impl Valley {
    const RADIUS: f64 = 1.1;

    fn new() -> Self {
        let digits = [
            "0.612345678901234567890123456789012345678901234567890123456789",
            "-0.301234567890123456789012345678901234567890123456789012345678",
            "0.498765432109876543210987654321098765432109876543210987654321",
        ];
        let bottom = PrecisePoint(digits.map(|text| text.parse().expect("a number")));
        let up = bottom.to_dvec3().normalize();
        let aside = up.any_orthonormal_vector();
        Self { bottom, walls: [up + aside, up - aside].map(DVec3::normalize), boulder: 0.0 }
    }

    /// Out of the valley.
    fn up(&self) -> DVec3 {
        (self.walls[0] + self.walls[1]).normalize()
    }

    /// From the bottom to that camera, and to the boulder.
    fn back(&self) -> DVec3 {
        let along = self.walls[0].cross(self.walls[1]).normalize();
        (self.up() + 0.4 * along + 0.1 * self.walls[0]).normalize()
    }

    /// A camera `unit` above the bottom that looks at it, somewhat from the side.
    fn camera(&self, unit: f64) -> Camera {
        let back = self.back();
        Camera {
            position: self.bottom.moved_by(back * unit, unit * 1e-12),
            pivot: self.bottom.clone(),
            ..Camera::looking_at(back, DVec3::ZERO, DVec3::Z)
        }
    }

    fn distance_at(&self, point: &PrecisePoint) -> f64 {
        self.distance(point - &self.bottom)
    }
}

impl DistanceField for Valley {
    fn origin(&self) -> PrecisePoint {
        self.bottom.clone()
    }

    fn center(&self) -> DVec3 {
        -self.bottom.to_dvec3()
    }

    fn finest_footprint(&self) -> f64 {
        DEEP_FOOTPRINT
    }

    fn distance(&self, point: DVec3) -> f64 {
        let from_ball = point.distance(self.center()) - Self::RADIUS;
        let from_walls = self.walls[0].dot(point).min(self.walls[1].dot(point));
        let from_boulder = point.distance(self.back() * 4.0 * self.boulder) - self.boulder;
        let distance = from_ball.max(from_walls);
        if self.boulder > 0.0 { distance.min(from_boulder).max(0.0) } else { distance.max(0.0) }
    }

    fn bounding_radius(&self) -> f64 {
        Self::RADIUS * 1.01
    }
}

fn world(field: &dyn DistanceField) -> World<'_> {
    World { field, viewport: VIEWPORT }
}

/// Where `point` appears, in pixels from the picture's centre.
fn seen_px(camera: &Camera, point: &PrecisePoint) -> DVec2 {
    let seen = camera.rotation().inverse() * (point - &camera.position);
    DVec2::new(seen.x, seen.y) / -seen.z / camera.half_height(VIEWPORT.aspect)
        * 0.5
        * VIEWPORT.height_px
}

fn to_px(ndc: DVec2) -> DVec2 {
    ndc * DVec2::new(VIEWPORT.aspect, 1.0) * 0.5 * VIEWPORT.height_px
}

fn picked(camera: &Camera, field: &Valley, ndc: DVec2) -> PrecisePoint {
    let offset = world(field).pick(camera, ndc).expect("the valley fills the picture");
    camera.position.moved_by(offset, 0.0)
}

/// Places of the pointer, spread over the middle of the picture.
fn pointer_positions() -> impl Iterator<Item = DVec2> + Clone {
    (0..24).map(|i| {
        let (sin, cos) = (2.4 * f64::from(i)).sin_cos();
        DVec2::new(cos, sin) * 0.45 * (f64::from(i) / 24.0).sqrt()
    })
}

#[test]
fn dolly_keeps_what_is_under_the_pointer_at_every_scale() {
    let field = Valley::new();
    for scale in SCALES {
        for ndc in pointer_positions() {
            let (mut camera, mut navigator) = (field.camera(scale), Navigator::default());
            let point = picked(&camera, &field, ndc);
            for amount in [0.4, -0.9, 0.2, 0.5, -1.5] {
                let before = (&point - &camera.position).length();
                assert!(navigator.dolly(&mut camera, world(&field), ndc, amount), "{scale:e}");
                let off = (seen_px(&camera, &point) - to_px(ndc)).length();
                assert!(off < 0.1, "{scale:e}: off by {off} px");
                let nearer = before / (&point - &camera.position).length();
                // The pick is within the hit distance of the surface.
                assert!((nearer.ln() - amount).abs() < 0.02, "{scale:e}: {nearer} for {amount}");
            }
        }
    }
}

#[test]
fn a_dive_by_the_wheel_ends_at_the_limit_and_comes_back_the_same_way() {
    let field = Valley::new();
    let (mut camera, mut navigator) = (field.camera(2.0), Navigator::default());
    // Off the picture's centre.
    let turned = camera.rotation() * DQuat::from_rotation_y(0.1) * DQuat::from_rotation_x(0.07);
    camera.orientation = turned.into();
    let start = camera.clone();
    let mut notches = 0;
    // The pointer follows the bottom, as a hand does.
    let mut notch = |camera: &mut Camera, amount: f64| {
        let ndc = seen_px(camera, &field.bottom) / to_px(DVec2::ONE);
        navigator.dolly(camera, world(&field), ndc, amount)
    };
    while notch(&mut camera, 0.2) && notches < 1000 {
        assert!(field.distance_at(&camera.position) > 0.0, "inside after {notches} notches");
        assert_eq!(camera_fault(&camera), None, "after {notches} notches");
        notches += 1;
    }
    assert!(world(&field).camera_status(&camera).at_precision_limit);
    // Twenty-seven orders of magnitude are 311 notches of a fifth.
    assert!((290..340).contains(&notches), "{notches} notches");
    let distance = field.distance_at(&camera.position);
    assert!((0.2e-27..1.5e-27).contains(&distance), "the eye stops at {distance:e}");
    for _ in 0..notches {
        notch(&mut camera, -0.2);
    }
    let unit = start.view_unit();
    // The last notches before the limit are cut short, those on the way back are whole.
    let [was, is] = [&start, &camera].map(|it| &it.position - &field.bottom);
    assert!(was.angle_between(is) < 1e-3, "it came back another way");
    let farther = (is.length() / was.length()).ln();
    assert!((-0.1..0.6).contains(&farther), "farther out by {farther}");
    assert!((camera.view_unit() / unit / farther.exp() - 1.0).abs() < 0.1);
    assert_eq!(camera.orientation, start.orientation);
}

/// What a document would find wrong with this camera.
fn camera_fault(camera: &Camera) -> Option<String> {
    let scene = mandelight::scene::Scene { camera: camera.clone(), ..Default::default() };
    scene.validate().err().map(|fault| fault.to_string())
}

#[test]
fn the_pivot_keeps_up_with_what_is_approached() {
    let field = Valley::new();
    for scale in SCALES {
        for part in [1e-9, 1e-3, 1e3] {
            let (mut camera, mut navigator) = (field.camera(scale), Navigator::default());
            // Left behind where something else was looked at.
            camera.pivot = camera.position.moved_by(camera.forward() * scale * part, 0.0);
            navigator.dolly(&mut camera, world(&field), DVec2::ZERO, 0.2);
            let ratio = camera.view_unit() / (&field.bottom - &camera.position).length();
            assert!((0.01..100.0).contains(&ratio), "{scale:e}: a pivot at {ratio} of the depth");
            assert_eq!(camera_fault(&camera), None);
        }
    }
}

#[test]
fn a_pointer_over_what_rays_creep_along_takes_little_time() {
    /// A floor that rays run along, and how often it was asked.
    struct Floor(AtomicU32);
    impl DistanceField for Floor {
        fn distance(&self, point: DVec3) -> f64 {
            self.0.fetch_add(1, Ordering::Relaxed);
            point.z.max(0.0)
        }
        fn bounding_radius(&self) -> f64 {
            50.0
        }
    }
    let floor = Floor(Default::default());
    // A ray that leaves the floor so slowly goes more than a thousand steps before it misses.
    let camera = Camera::looking_at(DVec3::Z * 1e-3, DVec3::new(0.0, 40.0, 0.15), DVec3::Z);
    let picked = world(&floor).pick(&camera, DVec2::ZERO).expect("it is along there");
    assert!(picked.angle_between(camera.forward()) < 1e-6 && picked.length() > 0.0);
    let asked = floor.0.into_inner();
    assert!(asked <= 400, "asked {asked} times");
}

#[test]
fn a_dolly_out_and_back_returns() {
    let field = Valley::new();
    for scale in SCALES {
        for ndc in pointer_positions() {
            let (mut camera, mut navigator) = (field.camera(scale), Navigator::default());
            let (start, point) = (camera.clone(), picked(&camera, &field, ndc));
            for amount in [-0.1, -0.1, -0.1, 0.1, 0.1, 0.1] {
                navigator.dolly(&mut camera, world(&field), ndc, amount);
            }
            let moved = (seen_px(&camera, &point) - seen_px(&start, &point)).length();
            let off = (&camera.position - &start.position).length() / scale;
            assert!(moved < 0.1 && off < 1e-3, "{scale:e}: {moved} px, {off} view units");
        }
    }
}

#[test]
fn pan_keeps_the_held_point_under_the_pointer_at_every_scale() {
    let field = Valley::new();
    for scale in SCALES {
        for ndc in pointer_positions() {
            let (mut camera, mut navigator) = (field.camera(scale), Navigator::default());
            let (point, unit) = (picked(&camera, &field, ndc), camera.view_unit());
            navigator.begin_pan(&camera, world(&field), ndc);
            for to in [ndc + 0.02, ndc * 0.9, ndc - 0.03] {
                navigator.drag(&mut camera, world(&field), to);
                let off = (seen_px(&camera, &point) - to_px(to)).length();
                assert!(off < 0.1, "{scale:e}: off by {off} px");
            }
            assert!((camera.view_unit() / unit - 1.0).abs() < 1e-5, "{scale:e}");
        }
    }
}

#[test]
fn orbit_keeps_its_radius_at_every_scale() {
    let field = Valley::new();
    for scale in SCALES {
        for ndc in pointer_positions().take(8) {
            let (mut camera, mut navigator) = (field.camera(scale), Navigator::default());
            navigator.begin_orbit(&camera, world(&field), ndc);
            let center = navigator.orbit_center().expect("an orbit is in progress").clone();
            let radius = (&camera.position - &center).length();
            let place = seen_px(&camera, &center);
            assert!(
                (place - to_px(ndc)).length() < 0.1,
                "{scale:e}: its centre is what was picked"
            );
            for step in 1..60 {
                let at = ndc + DVec2::new(0.004, -0.002) * f64::from(step);
                navigator.drag(&mut camera, world(&field), at);
                let now = (&camera.position - &center).length();
                assert!((now / radius - 1.0).abs() < 1e-5, "{scale:e}");
                assert!((seen_px(&camera, &center) - place).length() < 0.1, "{scale:e}");
            }
            assert_eq!(camera.pivot, center, "{scale:e}: the pivot follows");
            assert!((&camera.position - &center).angle_between(-camera.forward()) < 1.0);
        }
    }
}

#[test]
fn flying_halves_the_distance_in_the_same_time_at_every_scale() {
    let field = Valley::new();
    let forward = FlyInput { travel: DVec3::Z, ..FlyInput::default() };
    let secs = SCALES.map(|scale| {
        let (mut camera, mut navigator) = (field.camera(scale), Navigator::default());
        let start = field.distance_at(&camera.position);
        let mut frames = 0;
        while field.distance_at(&camera.position) > 0.5 * start && frames < 1000 {
            navigator.fly(&mut camera, world(&field), forward, 1.0 / 120.0);
            frames += 1;
        }
        f64::from(frames) / 120.0
    });
    let (least, most) = secs.iter().fold((f64::MAX, 0.0_f64), |(a, b), &s| (a.min(s), b.max(s)));
    assert!(least > 0.1 && most < 5.0 && most - least <= 1.0 / 60.0, "{secs:?}");
}

#[test]
fn nothing_gets_the_eye_into_the_surface_at_any_scale() {
    let field = Valley::new();
    for scale in SCALES {
        let (mut camera, mut navigator) = (field.camera(scale), Navigator::default());
        let mut closest = f64::INFINITY;
        for (i, ndc) in pointer_positions().cycle().take(600).enumerate() {
            match i % 4 {
                0 => {
                    navigator.dolly(&mut camera, world(&field), ndc, 0.9);
                }
                1 => {
                    navigator.begin_pan(&camera, world(&field), ndc);
                    navigator.drag(&mut camera, world(&field), -2.0 * ndc);
                }
                2 => {
                    navigator.begin_orbit(&camera, world(&field), ndc);
                    navigator.drag(&mut camera, world(&field), ndc + DVec2::new(ndc.y, 0.3));
                }
                _ => {
                    let travel = DVec3::new(ndc.x, ndc.y, 1.0);
                    let input = FlyInput { travel, faster: true, ..FlyInput::default() };
                    navigator.fly(&mut camera, world(&field), input, 0.1);
                }
            }
            let distance = field.distance_at(&camera.position);
            assert!(distance > 0.0, "{scale:e}: inside after {i} movements");
            closest = closest.min(distance);
            if i % 20 == 19 {
                camera = field.camera(scale);
            }
        }
        assert!(closest < 0.05 * scale, "{scale:e}: it never came near: {closest:e}");
    }
}

/// Flies to the end and returns the view unit of every frame.
fn flown(navigator: &mut Navigator, camera: &mut Camera, field: &Valley) -> Vec<f64> {
    let mut units = vec![camera.view_unit()];
    while navigator.advance(camera, 1.0 / 60.0) {
        assert!(field.distance_at(&camera.position) > 0.0, "inside after {} frames", units.len());
        assert_eq!(camera_fault(camera), None);
        units.push(camera.view_unit());
        assert!(units.len() < 1000, "a flight ends");
    }
    units
}

/// Asserts that the zoom changes evenly, and never by more than its greatest rate.
fn assert_even(units: &[f64]) {
    let zooms: Vec<f64> = units.windows(2).map(|pair| (pair[1] / pair[0]).ln()).collect();
    let most = zooms.iter().fold(0.0_f64, |most, zoom| most.max(zoom.abs()));
    assert!(most < MAX_ZOOM_PER_SEC / 60.0 * 1.02, "a frame zooms by {most}");
    // It sets off and comes to rest gently.
    let ends = [zooms[0], zooms[zooms.len() - 1]].map(f64::abs);
    assert!(ends.iter().all(|end| *end < 0.1 * most), "{ends:?} at the ends, {most} between");
    // Between setting off and coming to rest; turning and rounding the ball take their share.
    let middle = &zooms[zooms.len() / 4..zooms.len() / 2];
    let least = middle.iter().fold(f64::MAX, |least, zoom| least.min(zoom.abs()));
    assert!(least > 0.8 * most, "between {least} and {most} a frame");
}

#[test]
fn home_from_the_deepest_place_is_one_smooth_flight() {
    let home = Camera::default();
    for boulder in [0.0, 1e-26, 1e-13] {
        let field = Valley { boulder, ..Valley::new() };
        let (mut camera, mut navigator) = (field.camera(1e-26), Navigator::default());
        navigator.fly_to(&mut camera, world(&field), &home);
        let units = flown(&mut navigator, &mut camera, &field);
        assert!((240..400).contains(&units.len()), "{} frames", units.len());
        assert_even(&units);
        assert_eq!(camera, home);
        assert!(!navigator.is_active());
    }
}

#[test]
fn asked_again_on_the_way_it_is_there_at_once() {
    let (field, home) = (Valley::new(), Camera::default());
    let (mut camera, mut navigator) = (field.camera(1e-20), Navigator::default());
    navigator.fly_to(&mut camera, world(&field), &home);
    navigator.advance(&mut camera, 0.5);
    assert_ne!(camera, home);
    navigator.fly_to(&mut camera, world(&field), &home);
    assert!(camera == home && !navigator.is_active());
}

#[test]
fn a_home_at_depth_is_reached_to_the_last_digit() {
    let field = Valley::new();
    let home = field.camera(1e-24);
    let (mut camera, mut navigator) = (Camera::default(), Navigator::default());
    navigator.fly_to(&mut camera, world(&field), &home);
    let units = flown(&mut navigator, &mut camera, &field);
    assert!(units.len() > 240, "a cut after {} frames", units.len());
    let reversed: Vec<f64> = units.iter().rev().copied().collect();
    assert_even(&reversed);
    assert_eq!(camera, home);
}

#[test]
fn frame_all_from_depth_shows_the_whole() {
    let field = Valley::new();
    let (mut camera, mut navigator) = (field.camera(1e-26), Navigator::default());
    let orientation = camera.orientation;
    navigator.frame_all(&mut camera, world(&field));
    assert_even(&flown(&mut navigator, &mut camera, &field));
    assert_eq!((camera.orientation, &camera.pivot), (orientation, &PrecisePoint::ORIGIN));
    let seen = Valley::RADIUS
        / (camera.view_unit() * pixel_cone(&camera, VIEWPORT.aspect, VIEWPORT.height_px));
    assert!((800.0..1000.0).contains(&seen), "the ball is {seen} px high");
}
