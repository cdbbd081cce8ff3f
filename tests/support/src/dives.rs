//! The dives that `docs/dives.md` lists, and a flight down one of them.

use mandelight::scene::{
    Camera, Path, PrecisePoint, Project, Quality, Scene,
    path::{Easing, Key},
    presets::{self, Preset},
};

/// A dive's row of `docs/dives.md`: its depth in scene units, and its link's fragment.
pub fn row_of(dive: &Preset) -> (f64, String) {
    let docs = include_str!("../../../docs/dives.md");
    let start = format!("| {} |", dive.name);
    let row = docs.lines().find(|line| line.contains(&start)).expect(dive.name);
    let cells: Vec<&str> = row.split('|').map(str::trim).collect();
    // The last number: the one before it is the power.
    let depth = cells.iter().rev().find_map(|cell| cell.parse().ok());
    let (_, fragment) = row.split_once("/#").expect("a link");
    let fragment = fragment.split(')').next().unwrap_or_default().to_owned();
    (depth.expect("a depth such as 1e-20"), fragment)
}

/// A flight from the whole bulb down to the deepest dive, and past it to 1e-25 of another eye.
pub fn fall() -> Project {
    let end = presets::dives().last().map(|dive| (dive.scene)()).expect("a dive");
    let mut end = Scene { quality: Quality { samples: 1, ..end.quality.clone() }, ..end };
    let unit = end.camera.view_unit();
    // The same place from just 1e-25 away.
    let pivot = end.camera.pivot.clone();
    let away = &end.camera.position - &pivot;
    end.camera.position = pivot.moved_by(away * (1e-25 / unit), 1e-31);
    let whole = Camera::default();
    let mut start = end.clone();
    start.camera = Camera { pivot: PrecisePoint::ORIGIN, ..whole };
    let key = |time_secs, scene: &Scene| Key {
        time_secs,
        easing: Easing::Linear,
        scene: scene.clone().into(),
    };
    let keys = vec![key(0.0, &start), key(4.0, &end)];
    Project { scene: start, path: Path { frames_per_second: 2, keys, ..Path::default() } }
}
