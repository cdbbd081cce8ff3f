//! The dives: frozen documents, as deep as docs/dives.md says.

use mandelight::scene::{document, link, presets};
use mandelight_test_support::dives::{fall, row_of};

#[test]
fn there_are_sixteen_half_of_them_off_the_equator_and_every_name_is_its_own() {
    assert_eq!((presets::opening_scenes().len(), presets::dives().len()), (8, 16));
    let height = |dive: &presets::Preset| (dive.scene)().camera.pivot.to_dvec3().z.abs();
    assert!(presets::dives().iter().filter(|dive| height(dive) > 0.1).count() >= 8);
    let names: std::collections::HashSet<&str> = presets::all().map(|p| p.name).collect();
    assert_eq!(names.len(), presets::all().count());
    let power = |dive: &presets::Preset| (dive.scene)().fractal.number("power");
    let powers: Vec<f64> = presets::dives().iter().filter_map(power).collect();
    for power in [3.0, 4.0, 6.0, 8.0, 12.0, 16.0] {
        assert!(powers.contains(&power), "power {power}");
    }
    assert!(presets::dives().iter().any(|dive| (dive.scene)().fractal.is_on("julia")));
}

#[test]
fn each_is_a_valid_document_and_the_one_of_its_link() {
    for dive in presets::dives() {
        let scene = (dive.scene)();
        assert_eq!(scene.validate(), Ok(()), "{}", dive.name);
        assert_eq!(document::from_json(&document::to_json(&scene)).as_ref(), Ok(&scene));
        let fragment = link::to_fragment(&scene).unwrap();
        // docs/scene.md states these lengths.
        assert!((600..=850).contains(&fragment.len()), "{}: {}", dive.name, fragment.len());
        let (_, told) = row_of(dive);
        assert_eq!(link::from_fragment(&told).as_ref(), Ok(&scene), "{}: #{fragment}", dive.name);
    }
}

#[test]
fn each_is_as_deep_as_told() {
    for dive in presets::dives() {
        let ratio = (dive.scene)().camera.view_unit() / row_of(dive).0;
        assert!((0.9..1.1).contains(&ratio), "{}: {ratio} of what is told", dive.name);
    }
}

#[test]
fn a_path_from_the_whole_to_1e_25_falls_evenly() {
    let path = fall().path;
    let units: Vec<f64> = (0..9).map(|i| path.frame(i).unwrap().camera.view_unit()).collect();
    assert!((units[8] / 1e-25 - 1.0).abs() < 1e-3, "{:e}", units[8]);
    for (i, pair) in units.windows(2).enumerate() {
        let fallen = (pair[0] / pair[1]).log10();
        assert!((2.0..5.0).contains(&fallen), "by {fallen} powers of ten after frame {i}");
        let scene = path.frame(i as u32).unwrap();
        assert_eq!(scene.validate(), Ok(()), "frame {i}");
    }
}
