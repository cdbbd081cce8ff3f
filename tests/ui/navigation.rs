//! The camera's movements by their properties: what is under the pointer stays there, orbits
//! keep their radius, and no movement whatever gets the eye inside.

use glam::{DQuat, DVec2, DVec3};
use mandelight::{
    formula::{
        DistanceField,
        mandelbulb::{Mandelbulb, estimator::Estimator},
        march::PLAIN_FOOTPRINT,
    },
    fractal::camera_ray,
    scene::{Camera, PrecisePoint},
    ui::navigation::{
        FlyInput, MAX_EYE_DISTANCE, Navigator, Viewport, World, collide,
        flight::{FLIGHT_SECS, MAX_ZOOM_PER_SEC},
        fly::{MAX_FALL_PER_SEC, MAX_RISE_PER_SEC},
    },
};
use mandelight_test_support::random::Random;

pub const VIEWPORT: Viewport = Viewport { aspect: 16.0 / 9.0, height_px: 720.0, detail: 1.0 };

pub fn random() -> Random {
    Random(0xD1B5_4A32_D192_ED03)
}

/// A wall at y = 0 with a round hole about the origin.
struct Wall {
    hole_radius: f64,
}

impl DistanceField for Wall {
    fn distance(&self, point: DVec3) -> f64 {
        let from_axis = point.x.hypot(point.z);
        let thickness = 0.1;
        let across = (point.y.abs() - thickness).max(0.0);
        across.hypot((self.hole_radius - from_axis).max(0.0))
    }

    fn bounding_radius(&self) -> f64 {
        1e3
    }
}

pub fn world(field: &dyn DistanceField) -> World<'_> {
    World { field, viewport: VIEWPORT }
}

pub fn bulb() -> Estimator {
    Estimator::new(&Mandelbulb::default())
}

/// Where `point` appears, in pixels from the picture's centre.
pub fn seen_px(camera: &Camera, point: &PrecisePoint) -> DVec2 {
    let seen = camera.rotation().inverse() * (point - &camera.position);
    DVec2::new(seen.x, seen.y) / -seen.z / camera.half_height(VIEWPORT.aspect)
        * 0.5
        * VIEWPORT.height_px
}

pub fn to_px(ndc: DVec2) -> DVec2 {
    ndc * DVec2::new(VIEWPORT.aspect, 1.0) * 0.5 * VIEWPORT.height_px
}

/// The surface point under `ndc`.
pub fn picked(camera: &Camera, field: &Estimator, ndc: DVec2) -> Option<PrecisePoint> {
    let offset = world(field).pick(camera, ndc)?;
    Some(camera.position.moved_by(offset, 1e-15))
}

#[test]
fn dolly_keeps_what_is_under_the_pointer_there() {
    let (field, mut random) = (bulb(), random());
    let mut tried = 0;
    for _ in 0..100 {
        let (mut camera, mut navigator) = (Camera::default(), Navigator::default());
        let ndc = random.ndc() * 0.4;
        let Some(point) = picked(&camera, &field, ndc) else { continue };
        tried += 1;
        for amount in [0.5, 0.3, -0.2, 1.0] {
            let depth = (&point - &camera.position).length();
            assert!(navigator.dolly(&mut camera, world(&field), ndc, amount));
            assert!((seen_px(&camera, &point) - to_px(ndc)).length() < 1e-3);
            let nearer = (&point - &camera.position).length() / depth;
            assert!(nearer < 1.0 || amount < 0.0);
        }
    }
    assert!(tried > 50);
}

#[test]
fn pan_keeps_the_held_point_under_the_pointer() {
    let (field, mut random) = (bulb(), random());
    let mut tried = 0;
    for _ in 0..100 {
        let (mut camera, mut navigator) = (Camera::default(), Navigator::default());
        let ndc = random.ndc() * 0.4;
        let Some(point) = picked(&camera, &field, ndc) else { continue };
        tried += 1;
        let (view_unit, orientation) = (camera.view_unit(), camera.orientation);
        navigator.begin_pan(&camera, world(&field), ndc);
        for _ in 0..5 {
            let to = random.ndc();
            navigator.drag(&mut camera, world(&field), to);
            assert!((seen_px(&camera, &point) - to_px(to)).length() < 1e-3);
        }
        navigator.end();
        assert!((camera.view_unit() - view_unit).abs() < 1e-6, "the pivot goes along");
        assert_eq!(camera.orientation, orientation);
    }
    assert!(tried > 50);
}

#[test]
fn two_fingers_approach_the_held_point() {
    let (field, mut camera, mut navigator) = (bulb(), Camera::default(), Navigator::default());
    let ndc = DVec2::new(0.1, 0.2);
    let point = picked(&camera, &field, ndc).expect("the bulb is there");
    navigator.begin_pan(&camera, world(&field), ndc);
    for i in 1..=10 {
        let to = ndc + DVec2::new(0.03, -0.02) * f64::from(i);
        navigator.drag(&mut camera, world(&field), to);
        navigator.dolly(&mut camera, world(&field), to, 0.1);
        assert!((seen_px(&camera, &point) - to_px(to)).length() < 1e-2);
    }
    assert!((&point - &camera.position).length() < 1.5);
}

/// Asserts that the eye is outside and that the straight way from `before` never was inside.
fn assert_free(field: &impl DistanceField, before: DVec3, camera: &Camera, what: &str) {
    let eye = camera.position.to_dvec3();
    assert!(eye.is_finite() && camera.rotation().is_finite(), "{what}: {camera:?}");
    for i in 0..=16 {
        let place = before.lerp(eye, f64::from(i) / 16.0);
        assert!(field.distance(place) > 0.0, "{what}: inside at {place}, from {before} to {eye}");
    }
}

#[test]
fn no_flight_of_keys_enters_the_surface() {
    let mut random = random();
    for fractal in [Mandelbulb::default(), Mandelbulb { power: 3.0, ..Mandelbulb::default() }] {
        let field = Estimator::new(&fractal);
        let (mut camera, mut navigator) = (Camera::default(), Navigator::default());
        let (mut input, mut closest) = (FlyInput::default(), f64::INFINITY);
        for i in 0..4000 {
            if i % 40 == 0 {
                let inward = camera.rotation().inverse() * -camera.position.to_dvec3().normalize();
                let travel = DVec3::new(inward.x, inward.y, -inward.z) + random.in_cube() * 0.6;
                input = FlyInput {
                    travel,
                    roll: random.signed().round(),
                    faster: i % 80 == 0,
                    ..input
                };
            }
            input.look_rad = random.ndc() * 0.05;
            navigator.fly(&mut camera, world(&field), input, 1.0 / 30.0);
            let eye = camera.position.to_dvec3();
            assert!(field.distance(eye) > 0.0, "inside at {eye}");
            closest = closest.min(field.distance(eye));
            // The straight way from where it slid to.
            let way = random.in_cube().normalize() * field.distance(eye) * 4.0;
            let moved = collide::advance(world(&field), &camera, way);
            let gone = Camera { position: PrecisePoint::from(eye + moved), ..camera.clone() };
            assert_free(&field, eye, &gone, "advance");
        }
        assert!(closest < 1e-3, "it never came to the surface: {closest}");
    }
}

#[test]
fn no_gesture_enters_the_surface() {
    let (field, mut random) = (bulb(), random());
    let (mut camera, mut navigator) = (Camera::default(), Navigator::default());
    let mut closest = f64::INFINITY;
    for i in 0..1500 {
        let before = camera.position.to_dvec3();
        let ndc = random.ndc();
        match i % 3 {
            0 => {
                navigator.dolly(&mut camera, world(&field), ndc * 0.5, 0.8 + random.signed());
                assert_free(&field, before, &camera, "dolly");
            }
            1 => {
                navigator.begin_pan(&camera, world(&field), ndc);
                navigator.drag(&mut camera, world(&field), random.ndc());
                assert!(field.distance(camera.position.to_dvec3()) > 0.0, "pan");
            }
            _ => {
                navigator.begin_orbit(&camera, world(&field), ndc);
                navigator.drag(&mut camera, world(&field), ndc + random.ndc() * 0.3);
                assert!(field.distance(camera.position.to_dvec3()) > 0.0, "orbit");
            }
        }
        closest = closest.min(field.distance(camera.position.to_dvec3()));
        if i % 100 == 0 {
            camera = Camera::default();
        }
    }
    assert!(closest < 1e-3, "the moves never came near the surface: {closest}");
}

#[test]
fn dolly_stops_where_f32_pictures_end() {
    let (field, mut camera, mut navigator) = (bulb(), Camera::default(), Navigator::default());
    for _ in 0..200 {
        navigator.dolly(&mut camera, world(&field), DVec2::ZERO, 0.3);
    }
    let camera_status = world(&field).camera_status(&camera);
    assert!(camera_status.at_precision_limit && camera_status.distance > 0.0, "{camera_status:?}");
    assert!(camera_status.footprint <= PLAIN_FOOTPRINT);
    assert!(camera_status.distance >= 0.9 * world(&field).clearance(&camera), "{camera_status:?}");
    // And it comes out again.
    navigator.dolly(&mut camera, world(&field), DVec2::ZERO, -4.0);
    assert!(!world(&field).camera_status(&camera).at_precision_limit);
}

#[test]
fn an_eye_caught_inside_gets_out() {
    let field = bulb();
    let mut camera = Camera::looking_at(DVec3::new(0.3, 0.0, 0.0), DVec3::ZERO, DVec3::Z);
    let mut navigator = Navigator::default();
    assert_eq!(field.distance(camera.position.to_dvec3()), 0.0);
    for _ in 0..100_000 {
        let backward = FlyInput { travel: DVec3::NEG_Z, faster: true, ..FlyInput::default() };
        navigator.fly(&mut camera, world(&field), backward, 0.1);
        if field.distance(camera.position.to_dvec3()) > 0.1 {
            return;
        }
    }
    panic!("still inside at {}", camera.position.to_dvec3());
}

#[test]
fn the_eye_stays_where_coordinates_are_allowed() {
    let (field, mut camera, mut navigator) = (bulb(), Camera::default(), Navigator::default());
    for _ in 0..200 {
        navigator.dolly(&mut camera, world(&field), DVec2::new(0.2, 0.1), -1.0);
        let away = FlyInput { travel: DVec3::NEG_Z, faster: true, ..FlyInput::default() };
        navigator.fly(&mut camera, world(&field), away, 0.1);
        // Positions are rounded to what the view can show.
        assert!(camera.position.to_dvec3().length() <= MAX_EYE_DISTANCE * (1.0 + 1e-8));
    }
    assert!(camera.position.to_dvec3().length() > 0.9 * MAX_EYE_DISTANCE);
}

#[test]
fn speed_changes_smoothly_past_a_hole_and_never_dies() {
    let field = Wall { hole_radius: 0.3 };
    let dt_secs = 1.0 / 60.0;
    // Along the wall at a small distance, across the mouth of the hole.
    let start = DVec3::new(-1.0, -0.15, 0.0);
    let mut camera = Camera::looking_at(start, start + DVec3::X, DVec3::Z);
    let mut navigator = Navigator::default();
    let forward = FlyInput { travel: DVec3::Z, ..FlyInput::default() };
    let mut speeds = Vec::new();
    for _ in 0..60 * 60 {
        let before = camera.position.to_dvec3();
        assert!(
            navigator.fly(&mut camera, world(&field), forward, dt_secs),
            "it stands still at {before}"
        );
        assert_free(&field, before, &camera, "past the hole");
        speeds.push(navigator.speed().expect("it flies"));
        if camera.position.to_dvec3().x > 1.0 {
            break;
        }
    }
    assert!(camera.position.to_dvec3().x > 1.0, "it has passed the hole");
    for pair in speeds.windows(2) {
        let change = (pair[1] / pair[0]).ln();
        let allowed = -MAX_FALL_PER_SEC * dt_secs - 1e-9..=MAX_RISE_PER_SEC * dt_secs + 1e-9;
        assert!(allowed.contains(&change), "{change}");
    }
    let (slowest, fastest) =
        speeds.iter().fold((f64::MAX, 0.0_f64), |(a, b), &s| (a.min(s), b.max(s)));
    assert!(fastest > 1.5 * slowest, "the hole was felt");
}

#[test]
fn flying_head_on_into_a_wall_stops_before_it_and_slides_along() {
    let field = Wall { hole_radius: 0.0 };
    let start = DVec3::new(0.0, -1.0, 0.0);
    let mut camera = Camera::looking_at(start, DVec3::new(0.5, 0.0, 0.0), DVec3::Z);
    let mut navigator = Navigator::default();
    let forward = FlyInput { travel: DVec3::Z, faster: true, ..FlyInput::default() };
    for _ in 0..600 {
        navigator.fly(&mut camera, world(&field), forward, 1.0 / 30.0);
    }
    let eye = camera.position.to_dvec3();
    assert!(eye.y < -0.1 && eye.y > -0.11, "{eye}");
    assert!(eye.x > 0.46, "it went on along the wall: {eye}");
}

#[test]
fn a_camera_at_rest_does_not_move() {
    let (field, mut camera, mut navigator) = (bulb(), Camera::default(), Navigator::default());
    let before = camera.clone();
    assert!(!navigator.fly(
        &mut camera,
        world(&field),
        FlyInput { faster: true, ..FlyInput::default() },
        0.1
    ));
    assert!(!navigator.advance(&mut camera, 0.1));
    assert!(!navigator.drag(&mut camera, world(&field), DVec2::ONE));
    assert!(!navigator.dolly(&mut camera, world(&field), DVec2::ZERO, 0.0));
    assert!(!navigator.dolly(&mut camera, world(&field), DVec2::ZERO, f64::NAN));
    assert_eq!(camera, before);
    assert_eq!(navigator.speed(), None);
}

/// Steps a flight to its end, asserting that the eye is never inside.
fn fly_out(navigator: &mut Navigator, camera: &mut Camera, field: &impl DistanceField) -> u32 {
    let mut frames = 0;
    while navigator.advance(camera, 1.0 / 60.0) {
        frames += 1;
        assert!(
            field.distance(camera.position.to_dvec3()) > 0.0,
            "inside at {:?}",
            camera.position.to_dvec3()
        );
        assert!(frames < 1000, "a flight ends");
    }
    frames
}

#[test]
fn home_is_reached_exactly_and_never_through_the_surface() {
    let (field, mut random) = (bulb(), random());
    let (mut flown, mut cut) = (0, 0);
    for i in 0..60 {
        let (mut camera, mut navigator) = (Camera::default(), Navigator::default());
        let eye = random.in_cube().normalize() * 3.0;
        camera = Camera {
            vertical_fov_deg: 60.0,
            ..Camera::looking_at(eye, DVec3::ZERO, camera.forward())
        };
        for _ in 0..i % 20 {
            navigator.dolly(&mut camera, world(&field), random.ndc() * 0.1, 0.5);
        }
        let zoom = camera.view_unit() / Camera::default().view_unit();
        navigator.fly_to(&mut camera, world(&field), &Camera::default());
        match fly_out(&mut navigator, &mut camera, &field) {
            0 => cut += 1,
            frames => {
                flown += 1;
                // Turns and ways around are worth a zoom by e¹⁰ at most.
                let secs = FLIGHT_SECS + (zoom.ln().abs() + 10.0) / MAX_ZOOM_PER_SEC;
                assert!(f64::from(frames) <= secs * 60.0 + 2.0, "{frames} frames");
            }
        }
        assert_eq!(camera, Camera::default());
    }
    assert!(flown > 40 && cut < 20, "{flown} flown, {cut} cut");
}

#[test]
fn frame_all_fits_the_bounding_sphere_in_any_picture() {
    let (field, mut random) = (bulb(), random());
    for aspect in [0.46, 1.0, 16.0 / 9.0] {
        let world = World { field: &field, viewport: Viewport { aspect, ..VIEWPORT } };
        let (mut camera, mut navigator) = (Camera::default(), Navigator::default());
        camera.orientation =
            DQuat::from_euler(glam::EulerRot::ZYX, random.signed(), random.signed(), 1.2).into();
        let orientation = camera.orientation;
        navigator.frame_all(&mut camera, world);
        fly_out(&mut navigator, &mut camera, &field);
        assert_eq!(camera.orientation, orientation);
        // The picture's edges pass beside the sphere, and not far beside it.
        let clear = |ndc: DVec2| {
            let ray = camera_ray(&camera, &field.origin(), ndc, aspect);
            ray.sphere_span(field.center(), field.bounding_radius()).is_none()
        };
        for along in [-1.0, -0.5, 0.0, 0.5, 1.0] {
            assert!(
                clear(DVec2::new(1.0, along)) && clear(DVec2::new(along, -1.0)),
                "aspect {aspect}"
            );
        }
        let narrow = if aspect < 1.0 { DVec2::new(0.9, 0.0) } else { DVec2::new(0.0, 0.9) };
        assert!(!clear(narrow), "aspect {aspect}: there is room to spare");
    }
}

#[test]
fn level_puts_the_horizon_right() {
    let (field, mut camera, mut navigator) = (bulb(), Camera::default(), Navigator::default());
    let (forward, eye) = (camera.forward(), camera.position.clone());
    camera.orientation = (camera.rotation() * DQuat::from_rotation_z(1.0)).into();
    navigator.level(&mut camera, world(&field));
    fly_out(&mut navigator, &mut camera, &field);
    assert!((camera.rotation() * DVec3::X).z.abs() < 1e-9);
    assert!((camera.forward() - forward).length() < 1e-9);
    assert_eq!(camera.position, eye);
}

/// The zoom rate rises evenly at the start, falls evenly at the end, and never turns back.
#[test]
fn flights_set_off_and_arrive_gently_between_whole_and_close_views() {
    let field = bulb();
    for i in 0..12 {
        let (mut close, mut navigator) = (Camera::default(), Navigator::default());
        let ndc = DVec2::from_angle(f64::from(i)) * 0.3;
        for _ in 0..24 {
            navigator.dolly(&mut close, world(&field), ndc, 0.25);
        }
        let home = Camera::default();
        for (from, to, direction) in [(&close, &home, 1.0), (&home, &close, -1.0)] {
            let mut camera = from.clone();
            navigator.fly_to(&mut camera, world(&field), to);
            let mut units = vec![from.view_unit()];
            while navigator.advance(&mut camera, 1.0 / 60.0) {
                units.push(camera.view_unit());
            }
            let rates = units.windows(2).map(|pair| direction * (pair[1] / pair[0]).ln());
            let rates: Vec<f64> = [0.0].into_iter().chain(rates).chain([0.0]).collect();
            let most = rates.iter().copied().fold(0.0, f64::max);
            assert!(rates.len() > 50 && most > 0.15, "{} frames, {most}", rates.len());
            for pair in rates.windows(2) {
                assert!(pair[0] >= 0.0 && (pair[1] - pair[0]).abs() < 0.05 * most, "{pair:?}");
            }
        }
    }
}

/// A field whose estimates are nothing like distances, as those of one's own formulas may be.
struct Senseless {
    estimate: f64,
    bounding_radius: f64,
}

impl DistanceField for Senseless {
    fn distance(&self, _point: DVec3) -> f64 {
        self.estimate
    }

    fn bounding_radius(&self) -> f64 {
        self.bounding_radius
    }
}

#[test]
fn senseless_estimates_leave_every_movement_finite() {
    let estimates = [0.0, 1e-300, 1e-9, 1.0, 7e24, f64::MAX, f64::INFINITY, f64::NAN, -1.0];
    let radii = [1e-6, 1.2, 1e3];
    let mut random = random();
    for (estimate, bounding_radius) in
        estimates.into_iter().flat_map(|estimate| radii.map(|radius| (estimate, radius)))
    {
        let field = Senseless { estimate, bounding_radius };
        let mut camera = Camera::default();
        let mut navigator = Navigator::default();
        for _ in 0..6 {
            let mut ndc = || DVec2::new(random.signed(), random.signed());
            navigator.begin_orbit(&camera, world(&field), ndc());
            navigator.drag(&mut camera, world(&field), ndc());
            navigator.begin_pan(&camera, world(&field), ndc());
            navigator.drag(&mut camera, world(&field), ndc());
            navigator.end();
            navigator.dolly(&mut camera, world(&field), ndc(), 0.7);
            navigator.dolly(&mut camera, world(&field), ndc(), -0.4);
            let travel = DVec3::new(0.5, 0.0, 1.0);
            let input = FlyInput { travel, ..FlyInput::default() };
            navigator.fly(&mut camera, world(&field), input, 0.1);
            navigator.approach(&mut camera, world(&field), ndc());
            navigator.advance(&mut camera, 0.3);
            navigator.frame_all(&mut camera, world(&field));
            navigator.advance(&mut camera, 10.0);
            navigator.level(&mut camera, world(&field));
            let what = format!("an estimate of {estimate}, a radius of {bounding_radius}");
            let points = [camera.position.to_dvec3(), camera.pivot.to_dvec3()];
            assert!(points.iter().all(|point| point.is_finite()), "{what}: {points:?}");
            assert!(camera.view_unit() > 0.0, "{what}");
        }
    }
}
