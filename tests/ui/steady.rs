//! What people hold and look at stays in place: rows of lists, headings, the framed set.

use egui::{Rect, vec2};
use egui_kittest::{Harness, kittest::Queryable as _};
use glam::DVec2;
use mandelight::{
    formula::table::Value,
    fractal::{FractalModel, camera_ray, pixel_cone},
    scene::{Scene, presets},
    ui::Settings,
};

use crate::stage::*;

fn rect(harness: &Harness<'_, Stage>, name: &str) -> Rect {
    harness.state().interface.rects().get(name).unwrap_or_else(|| panic!("no {name}"))
}

#[test]
fn opening_the_lights_moves_nothing_above_or_under_the_pointer() {
    for height in [2400.0, 720.0] {
        let settings = Settings { more_open: true, ..Settings::default() };
        let mut harness = stage(Scene::default(), settings, [1280.0, height]);
        harness.run();
        // Where the window is low, the panel is scrolled to the heading first.
        harness.get_by_label("All lights").scroll_to_me();
        harness.run();
        let places = |harness: &Harness<'_, Stage>| {
            ["key light ball", "exposure", "more", "All lights"].map(|name| rect(harness, name))
        };
        let before = places(&harness);
        assert!(before[3].bottom() < height, "{before:?}");
        harness.get_by_label("All lights").click();
        harness.run();
        assert!(harness.query_by_label("Add light").is_some(), "the section is open");
        assert_eq!(before, places(&harness), "in a window {height} points high");
    }
}

#[test]
fn the_list_shows_whole_rows_and_a_new_light_is_in_sight() {
    for height in [5000.0, 844.0] {
        // A phone's rows are taller than a desktop's.
        let width = if height < 1000.0 { 390.0 } else { 1280.0 };
        let mut harness = stage(Scene::default(), unfolded(), [width, height]);
        harness.run();
        let lights = scene(&harness).lights.environment.len();
        for count in lights + 1..lights + 12 {
            harness.get_by_label("Add light").click_accesskit();
            harness.run();
            assert_eq!(scene(&harness).lights.environment.len(), count);
            let list = rect(&harness, "light list");
            let rows =
                (1..=count).map(|index| harness.get_by_label(&format!("Light {index}")).rect());
            let rows: Vec<Rect> = rows.collect();
            let new = rows[count - 1];
            assert!(list.expand(0.6).contains_rect(new), "{count}: {new:?} in {list:?}");
            let whole = rows.iter().filter(|row| list.expand(0.6).contains_rect(**row)).count();
            assert_eq!(whole, count.min(6), "{count} rows in {list:?}");
            let partly = rows.iter().filter(|row| {
                let seen = row.intersect(list).height();
                seen > 2.0 && seen < row.height() - 2.0
            });
            assert_eq!(partly.count(), 0, "{count} rows in {list:?}");
        }
    }
}

fn power(scene: &Scene) -> f64 {
    match scene.fractal.fields().next() {
        Some((_, Value::Number(power))) => *power,
        other => panic!("{other:?}"),
    }
}

/// The size of the set's bounding sphere in the picture: its radius over the eye's distance.
fn apparent_size(harness: &Harness<'_, Stage>) -> f64 {
    let scene = scene(harness);
    let radius = FractalModel::new(&scene.fractal).whole().bounding_radius();
    radius / scene.camera.position.to_dvec3().length()
}

/// Whether the surface touches the picture's border: rays are marched along it.
fn is_cut_off(harness: &Harness<'_, Stage>) -> bool {
    let camera = &scene(harness).camera;
    let model = FractalModel::new(&scene(harness).fractal);
    let field = model.whole();
    let aspect = f64::from(rect(harness, "view").aspect_ratio());
    let cone = pixel_cone(camera, aspect, f64::from(rect(harness, "view").height()));
    let along = (0..=40).map(|index| f64::from(index) / 20.0 - 1.0);
    let mut border = along
        .flat_map(|at| [(at, -1.0), (at, 1.0), (-1.0, at), (1.0, at)])
        .map(|(x, y)| camera_ray(camera, &field.origin(), DVec2::new(x, y), aspect));
    border.any(|ray| field.trace(ray, cone, f64::INFINITY, 1000).unwrap_or_else(Some).is_some())
}

#[test]
fn the_power_is_set_finely_and_the_set_stays_framed() {
    for start in [Scene::default(), presets::opening()] {
        let mut harness = stage(start.clone(), Settings::default(), [1280.0, 720.0]);
        harness.run();
        let size = apparent_size(&harness);
        assert!(!is_cut_off(&harness));
        // From 8 toward the lowest power, in steps of 30 points.
        let rail = slider(&harness, "Power").rect();
        let mut at = rail.left() + rail.width() * 6.0 / 14.0;
        while at > rail.left() + 30.0 {
            let before = power(scene(&harness));
            let y = rail.center().y;
            drag(&mut harness, egui::pos2(at, y), egui::pos2(at - 30.0, y), 3);
            let moved = before - power(scene(&harness));
            assert!((0.2..2.5).contains(&moved), "30 points move the power by {moved}");
            let now = apparent_size(&harness);
            let power = power(scene(&harness));
            assert!((now / size - 1.0).abs() < 1e-3, "{now} for {size} at power {power}");
            assert!(!is_cut_off(&harness), "at power {power}");
            at -= 30.0;
        }
        assert!(power(scene(&harness)) < 4.0);
        undo_all(&mut harness);
        assert_eq!(*scene(&harness), start, "the camera comes back too");
    }
}

#[test]
fn a_close_view_stays_where_it_is_when_the_power_changes() {
    let dive = presets::all().find(|preset| preset.name == "Rosette").expect("a dive");
    let mut harness = stage((dive.scene)(), Settings::default(), [1280.0, 720.0]);
    harness.run();
    let camera = scene(&harness).camera.clone();
    let rail = slider(&harness, "Power").rect();
    drag(&mut harness, rail.center(), rail.center() + vec2(40.0, 0.0), 3);
    assert_eq!(scene(&harness).camera, camera);
}
