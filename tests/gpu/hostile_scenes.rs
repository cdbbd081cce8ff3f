//! Random scenes that documents may hold, drawn small: every float is finite, and no validation fails.
//!
//! `cargo test --release --test gpu hostile_scenes -- --ignored --nocapture` draws 2000 other scenes each run and prints
//! its seed; `MANDELIGHT_SEED` draws those of a run again, and `MANDELIGHT_SCENES` sets their number.

use std::{fs, ops::ControlFlow, path::Path};

use mandelight::{
    export::{Eye, PictureFormat, StillJob, StillOptions},
    render::{Pace, Region, View},
    scene::document,
};
use mandelight_test_support::{
    device::{gpu, pipelines},
    hostile::{HostileScene, HostileScenes},
    random::Random,
    variables,
    view::{pixels, settle},
};

use crate::exr::read_exr;

/// Width and height of the pictures.
const SIZE: [u32; 2] = [24, 16];
/// Another size, which keeps pixels.
const NARROW: [u32; 2] = [20, 16];
/// Scenes in the ordinary tests.
const SCENES: usize = 40;
/// Scenes of a long run, unless the environment says otherwise.
const MANY_SCENES: usize = 2000;

/// What is drawn of a scene.
#[derive(Clone, Copy, Debug)]
enum Drawing {
    /// A still, whose buffers are read.
    Still,
    /// The next scene of one view that someone watches, first while it moves, then in two more sizes.
    Watched,
    /// A file.
    File(PictureFormat),
}

/// The first number that is none, with what it is of.
fn not_finite<'a>(of: &str, values: impl IntoIterator<Item = &'a f32>) -> Result<(), String> {
    match values.into_iter().enumerate().find(|(_, value)| !value.is_finite()) {
        Some((index, value)) => Err(format!("{of}: {value} at {index}")),
        None => Ok(()),
    }
}

/// Reads everything of a finished view.
fn check_view(view: &View) -> Result<(), String> {
    let gbuffer = view.gbuffer().map_err(|error| error.to_string())?;
    not_finite("depth", &gbuffer.depth)?;
    if let Some(depth) = gbuffer.depth.iter().find(|depth| **depth < 0.0) {
        return Err(format!("depth: {depth}"));
    }
    not_finite("normal", gbuffer.normal.iter().flat_map(AsRef::<[f32; 3]>::as_ref))?;
    not_finite("film", view.film().map_err(|error| error.to_string())?.iter().flatten())?;
    if let Some(light) = view.denoised().map_err(|error| error.to_string())? {
        not_finite("denoised light", light.iter().flatten())?;
    }
    let histogram = view.report().histogram.ok_or("no histogram")?;
    not_finite("exposure", [&histogram.adapted_stops])?;
    let picture = pixels(view);
    let is_opaque = picture.as_chunks::<4>().0.iter().all(|pixel| pixel[3] == 255);
    is_opaque.then_some(()).ok_or_else(|| "the picture has holes".to_owned())
}

/// Draws scenes; one view stays from scene to scene.
struct Drawer {
    watched: View,
}

impl Drawer {
    fn new() -> Self {
        let mut watched = View::new(pipelines(), Region::whole(SIZE), Pace::Interactive);
        watched.watch_histogram(true);
        Self { watched }
    }

    fn check(&mut self, hostile: &HostileScene, drawing: Drawing) -> Result<(), String> {
        let faults = gpu().faults();
        let HostileScene { scene, environment_map, .. } = hostile;
        scene.validate().map_err(|error| format!("refused: {error}"))?;
        match drawing {
            Drawing::Still => {
                let mut view = View::new(pipelines(), Region::whole(SIZE), Pace::Still);
                view.set_environment_map(environment_map.as_ref());
                view.watch_histogram(true);
                view.set_scene(scene, false);
                settle(&mut view);
                check_view(&view)?;
            }
            Drawing::Watched => {
                let view = &mut self.watched;
                view.set_environment_map(environment_map.as_ref());
                for is_moving in [true, false] {
                    view.set_scene(scene, is_moving);
                    settle(view);
                }
                check_view(view)?;
                for size_px in [NARROW, SIZE] {
                    view.set_region(Region::whole(size_px));
                    settle(view);
                    check_view(view)?;
                }
            }
            Drawing::File(format) => check_file(hostile, format)?,
        }
        match gpu().faults() - faults {
            0 => Ok(()),
            count => Err(format!("{count} validation errors")),
        }
    }
}

/// Draws the scene into a file; every value of an OpenEXR file is finite, or as its format says.
fn check_file(hostile: &HostileScene, format: PictureFormat) -> Result<(), String> {
    let options = StillOptions {
        environment_map: hostile.environment_map.clone(),
        format,
        is_transparent: format.has_alpha() && hostile.scene.quality.samples == 2,
        is_deep: format == PictureFormat::Png && hostile.scene.quality.samples == 3,
        // The formats of both eyes refuse some layouts.
        eye: Some(Eye::Left),
        // Several tiles, and an overview of the whole.
        tile_px: [16, 16],
        ..StillOptions::new(SIZE)
    };
    let job = StillJob::new(pipelines(), &hostile.scene, options, Vec::new());
    let job = job.map_err(|error| format!("refused: {error}"))?;
    let file = job.run(|_| ControlFlow::Continue(())).map_err(|error| error.to_string())?;
    if format != PictureFormat::Exr {
        return Ok(());
    }
    let image = read_exr(&file).map_err(|error| error.to_string())?;
    for channel in &image.layer_data.channel_data.list {
        let name = channel.name.to_string();
        let values: Vec<_> = channel.sample_data.values_as_f32().collect();
        let is_finite = |value: &f32| value.is_finite() || (name == "Z" && *value == f32::INFINITY);
        if let Some(value) = values.iter().find(|value| !is_finite(value)) {
            return Err(format!("channel {name}: {value}"));
        }
    }
    Ok(())
}

/// Draws scenes of a seed; those that fail are stored, to look at.
fn failing_scenes(seed: u64, count: usize) -> Vec<String> {
    println!("MANDELIGHT_SEED={seed}");
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("hostile-scenes");
    fs::create_dir_all(&folder).expect("a folder");
    let (mut scenes, mut random) = (HostileScenes::new(seed), Random(!seed | 1));
    let (mut drawer, mut failing) = (Drawer::new(), Vec::new());
    for index in 0..count {
        let hostile = scenes.next_scene();
        let drawing = match (random.unit() * 8.0) as u32 {
            0 => Drawing::File(PictureFormat::Exr),
            1 => {
                let formats = [PictureFormat::Png, PictureFormat::Jpeg, PictureFormat::WebP];
                Drawing::File(formats[index % formats.len()])
            }
            2..5 => Drawing::Watched,
            _ => Drawing::Still,
        };
        let start = std::time::Instant::now();
        let result = drawer.check(&hostile, drawing);
        println!("{index}, {:.1} s: {drawing:?}, {}", start.elapsed().as_secs_f64(), hostile.name);
        if let Err(reason) = result {
            let file = folder.join(format!("{seed}-{index}.json"));
            fs::write(&file, document::to_json(&hostile.scene)).expect("a file");
            println!("    {reason}");
            failing.push(format!(
                "{index}: {drawing:?}, {}: {reason}, {}",
                hostile.name,
                file.display()
            ));
        }
    }
    failing
}

/// The seed of the ordinary tests.
const SEED: u64 = 20;

#[test]
fn forty_scenes_are_finite() {
    let failing = failing_scenes(SEED, SCENES);
    assert!(failing.is_empty(), "{failing:#?}");
}

#[test]
#[ignore = "an hour, and other scenes each run: see CONTRIBUTING.md"]
fn hostile_scenes_are_finite() {
    let count = variables::number("MANDELIGHT_SCENES").map_or(MANY_SCENES, |count| count as usize);
    let failing = failing_scenes(variables::seed(), count);
    assert!(failing.is_empty(), "{failing:#?}");
}
