//! The dives: frozen documents, as deep as docs/dives.md says, and something to see in each.

use std::{
    io::BufReader,
    ops::ControlFlow,
    process::Command,
    sync::{Arc, LazyLock},
};

use mandelight::{
    export::{StillJob, StillOptions},
    gpu::{Gpu, readback::Readback},
    render::{Pace, Pipelines, Region, View},
    scene::{
        Camera, Path, PrecisePoint, Project, Scene, document, link,
        path::{Easing, Key},
        presets::{self, Preset},
    },
};

const SIZE_PX: [u32; 2] = [48, 32];

static PIPELINES: LazyLock<Arc<Pipelines>> = LazyLock::new(|| {
    let gpu = pollster::block_on(Gpu::open(None)).expect("a GPU, if only a software one");
    Pipelines::new(&gpu)
});

/// The dive's row of the docs: its depth in scene units, and its link's fragment.
fn row_of(dive: &Preset) -> (f64, String) {
    let docs = include_str!("../docs/dives.md");
    let start = format!("| {} |", dive.name);
    let row = docs.lines().find(|line| line.contains(&start)).expect(dive.name);
    let cells: Vec<&str> = row.split('|').map(str::trim).collect();
    let depth = cells.iter().find_map(|cell| cell.strip_suffix(" u")?.parse().ok());
    let (_, fragment) = row.split_once("/#").expect("a link");
    let fragment = fragment.split(')').next().unwrap_or_default().to_owned();
    (depth.expect("a depth such as 1e-20 u"), fragment)
}

#[test]
fn there_are_at_least_six_and_every_name_is_its_own() {
    assert!(presets::dives().len() >= 6);
    let names: std::collections::HashSet<&str> = presets::every().map(|p| p.name).collect();
    assert_eq!(names.len(), presets::all().len() + presets::dives().len());
    let powers: Vec<f64> = presets::dives().iter().map(|d| (d.scene)().fractal.power).collect();
    for power in [3.0, 4.0, 6.0, 8.0, 12.0, 16.0] {
        assert!(powers.contains(&power), "power {power}");
    }
    assert!(presets::dives().iter().any(|dive| (dive.scene)().fractal.julia));
}

#[test]
fn each_is_a_valid_document_and_the_one_of_its_link() {
    for dive in presets::dives() {
        let scene = (dive.scene)();
        assert_eq!(scene.validate(), Ok(()), "{}", dive.name);
        assert_eq!(document::from_json(&document::to_json(&scene)).as_ref(), Ok(&scene));
        let fragment = link::to_fragment(&scene).unwrap();
        // docs/scene.md tells these lengths.
        assert!((600..=850).contains(&fragment.len()), "{}: {}", dive.name, fragment.len());
        let (_, told) = row_of(dive);
        assert_eq!(link::from_fragment(&told).as_ref(), Ok(&scene), "{}: #{fragment}", dive.name);
    }
}

#[test]
fn each_shows_a_surface_as_deep_as_told() {
    for dive in presets::dives() {
        let scene = (dive.scene)();
        let (depth, _) = row_of(dive);
        let ratio = scene.camera.view_unit() / depth;
        assert!((0.9..1.1).contains(&ratio), "{}: {ratio} of what is told", dive.name);

        let mut one = scene.clone();
        one.quality.samples = 1;
        let mut view = View::new(&PIPELINES, Region::whole(SIZE_PX), Pace::Still);
        view.set_scene(&one, false);
        finish(&mut view);
        let mut hits = view.gbuffer().unwrap().depth;
        let count = hits.len();
        hits.retain(|&depth| depth > 0.0);
        assert!(hits.len() * 10 >= count * 3, "{}: {} of {count} hit", dive.name, hits.len());
        hits.sort_by(f32::total_cmp);
        let median = f64::from(hits[hits.len() / 2]) / depth;
        assert!((0.2..5.0).contains(&median), "{}: it shows what is at {median}", dive.name);

        let luma = lumas(&view);
        let mean = luma.iter().sum::<f64>() / count as f64;
        let variance = luma.iter().map(|l| (l - mean).powi(2)).sum::<f64>() / count as f64;
        println!("{}: {} hits, mean {mean:.0}, {:.0}", dive.name, hits.len(), variance.sqrt());
        assert!((40.0..225.0).contains(&mean), "{}: a mean of {mean}", dive.name);
        assert!(variance.sqrt() > 20.0, "{}: flat, {}", dive.name, variance.sqrt());
    }
}

fn finish(view: &mut View) {
    let mut now_secs = 0.0;
    while view.pump(now_secs) {
        PIPELINES.gpu.wait();
        now_secs += 0.01;
    }
}

/// The picture's brightness, 0 to 255.
fn lumas(view: &View) -> Vec<f64> {
    let gpu = &PIPELINES.gpu;
    let rgba = Readback::texture(gpu, view.texture().unwrap(), SIZE_PX).wait(gpu).unwrap();
    let luma = |pixel: &[u8]| pixel[..3].iter().map(|&c| f64::from(c)).sum::<f64>() / 3.0;
    rgba.chunks_exact(4).map(luma).collect()
}

/// A flight from the whole bulb down to the deepest dive, and past it to 1e-25 of another eye.
fn fall() -> Project {
    let end = presets::dives().last().map(|dive| (dive.scene)()).expect("a dive");
    let mut end =
        Scene { quality: mandelight::scene::Quality { samples: 1, ..end.quality.clone() }, ..end };
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
    Project { scene: start, path: Path { frames_per_second: 2, keys } }
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

#[test]
fn frames_of_such_a_path_are_the_stills_of_their_scenes() {
    let project = fall();
    let folder = tempfile::tempdir().unwrap();
    let (document, frames) = (folder.path().join("fall.json"), folder.path().join("frames"));
    std::fs::write(&document, document::project_to_json(&project)).unwrap();
    // Plain, about where the anchors begin, and deep.
    for frame in [0, 2, 5, 8] {
        let output = Command::new(env!("CARGO_BIN_EXE_mandelight"))
            .arg("frames")
            .arg(&document)
            .arg("-o")
            .arg(&frames)
            .args(["--quiet", "--size", &format!("{}x{}", SIZE_PX[0], SIZE_PX[1])])
            .args(["--frames", &frame.to_string()])
            .output()
            .unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let file = frames.join(format!("frame_{frame:06}.png"));
        let drawn = pixels(BufReader::new(std::fs::File::open(file).unwrap()));
        let scene = project.path.frame(frame).unwrap();
        let job =
            StillJob::new(&PIPELINES, &scene, StillOptions::new(SIZE_PX), Vec::new()).unwrap();
        let still = job.run(|_| ControlFlow::Continue(())).unwrap();
        assert_eq!(drawn, pixels(std::io::Cursor::new(still)), "frame {frame}");
        let colors: std::collections::HashSet<_> = drawn.chunks_exact(3).collect();
        assert!(colors.len() > 200, "frame {frame} has {} colours", colors.len());
    }
}

fn pixels(file: impl std::io::BufRead + std::io::Seek) -> Vec<u8> {
    let mut reader = png::Decoder::new(file).read_info().unwrap();
    let mut rgb = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut rgb).unwrap();
    rgb
}
