//! A camera path: scrubbed, played, saved as videos and as pictures, with encoders that fail.

use std::{fs::File, io::BufReader, path::Path as FilePath};

use mandelight::{
    export,
    scene::{
        Path, Project, document,
        path::{Easing, Key},
        presets,
    },
};
use serde_json::Value;

use crate::{picture::Picture, video, visit::Visit};

/// A path of two keys and three frames.
pub fn short_path() -> Project {
    let scene = presets::opening_scenes()[0].scene;
    let key = |time_secs, power| {
        let mut scene = scene();
        scene.fractal.set("power", power);
        scene.quality.samples = 1;
        Key { time_secs, easing: Easing::Linear, scene: scene.into() }
    };
    let keys = vec![key(0.0, 8.0), key(1.0, 7.0)];
    let scene = (*keys[0].scene).clone();
    Project { scene, path: Path { frames_per_second: 2, keys, ..Path::default() } }
}

#[test]
fn a_path_is_scrubbed_played_and_saved_as_videos_and_as_a_zip_of_its_frames() {
    let project = short_path();
    let document = document::project_to_json(&project);
    let visit = Visit::run_with("sequence", [("MANDELIGHT_PATH", document)]);
    let scrubbed = visit.scene("scrubbed");
    let power = scrubbed.fractal.number("power").expect("a Mandelbulb");
    assert!((7.0..8.0).contains(&power), "{power}");

    let names: Vec<_> = (0..3).map(export::frame_name).collect();
    for (pointer, prefix) in [("/frames", "frames"), ("/streamed", "streamed")] {
        assert_eq!(visit.seen.pointer(pointer), Some(&serde_json::json!(names)));
        for (i, name) in names.iter().enumerate() {
            let file = visit.folder.join(format!("{prefix}-{name}"));
            assert!(Picture::read_png(&file).contrast() > 5.0, "{name} is empty");
            let text = export::scene_text(BufReader::new(File::open(&file).unwrap())).unwrap();
            let carried = document::from_json(&text.unwrap()).unwrap();
            assert_eq!(carried, project.path.frame(i as u32).unwrap(), "{prefix}, {name}");
        }
    }
    for name in ["/name", "/suggested"] {
        assert!(visit.text(name).ends_with(".zip"), "{}", visit.text(name));
    }
    let named: Vec<&str> =
        visit.seen["video_names"].as_array().unwrap().iter().filter_map(Value::as_str).collect();
    let files = [
        ("video.mp4", "frames"),
        ("video.webm", "frames"),
        ("resumed.mp4", "frames"),
        ("streamed.mp4", "streamed"),
    ];
    assert_eq!(named.len(), files.len());
    for (name, (file, prefix)) in named.iter().zip(files) {
        assert_eq!(FilePath::new(name).extension(), FilePath::new(file).extension());
        let pictures = names.iter().map(|name| visit.folder.join(format!("{prefix}-{name}")));
        video::shows_frames(&visit.folder.join(file), &pictures.collect::<Vec<_>>());
    }
    assert_eq!(visit.seen["muxers"], serde_json::json!([0, 1]), "the muxer comes with a video");
    assert!(visit.number("/faulty_left") < 0.0, "no encoder was replaced");
    for said in ["failed", "substitute", "reason"] {
        assert_eq!(visit.seen[said], true, "{said}");
    }
    assert_eq!(visit.seen["offered"], serde_json::json!([0, 0, 1]));
    let cancelled = serde_json::json!({ "isClosed": false, "encoders": ["closed"] });
    assert_eq!(visit.seen["cancelled"], cancelled);
    turntable_was_streamed(&visit);
}

/// Part of a video's bytes that are written, at least, before its last frame is encoded.
const STREAMED_PART: f64 = 0.3;

fn turntable_was_streamed(visit: &Visit) {
    let path = document::project_from_json(visit.text("/scenes/turntable")).unwrap().path;
    let frames = path.frame_count();
    assert_eq!(frames, 12, "12 seconds of one frame");
    assert_eq!(visit.number("/frames_encoded"), f64::from(frames));
    video::lasts(&visit.folder.join("turntable.mp4"), frames, 12.0);

    let bytes_of = |is_counted: &dyn Fn(f64) -> bool| -> f64 {
        let number = |write: &Value, name: &str| write[name].as_f64().unwrap();
        let writes = visit.seen["writes"].as_array().unwrap().iter();
        let counted = writes.filter(|write| is_counted(number(write, "frames")));
        counted.map(|write| number(write, "bytes")).sum()
    };
    let early = bytes_of(&|encoded| encoded < f64::from(frames)) / bytes_of(&|_| true);
    println!("{early:.2} of the turntable's bytes were written before its last frame");
    assert!(early > STREAMED_PART, "{early}: {:#}", visit.seen["writes"]);
    assert_ne!(visit.seen["times_left"], serde_json::json!([]), "no time left was shown");
}
