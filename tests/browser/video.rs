//! Videos that the page saved, decoded by FFmpeg.

use std::{
    path::{Path, PathBuf},
    process::Command,
};

use serde_json::Value;

use crate::picture::Picture;

/// Mean difference that compression and half the resolution of colours may cost, in 8-bit steps.
const MAX_STEPS: f64 = 6.0;

/// Asserts that a video shows the pictures of these files, each in its place, and no others.
pub fn shows_frames(video: &Path, pictures: &[PathBuf]) {
    let name = video.display();
    let picture_of = |index: usize| PathBuf::from(format!("{name}-{index}.png"));
    for index in 1..=pictures.len() + 1 {
        // One of an earlier run would hide that a frame is missing.
        let _ = std::fs::remove_file(picture_of(index));
    }
    let decoded = Command::new("ffmpeg")
        .args(["-v", "error", "-y", "-i"])
        .arg(video)
        .arg(format!("{name}-%d.png"))
        .output()
        .expect("FFmpeg");
    assert!(decoded.status.success(), "{name}: {}", String::from_utf8_lossy(&decoded.stderr));
    let frames: Vec<Picture> = pictures.iter().map(|file| Picture::read_png(file)).collect();
    for index in 0..frames.len() {
        let shown = Picture::read_png(&picture_of(index + 1));
        assert_eq!(shown.size_px, frames[index].size_px.map(|side| side.next_multiple_of(2)));
        let shown = shown.crop([0, 0], frames[index].size_px);
        let steps: Vec<f64> = frames.iter().map(|frame| frame.difference(&shown).mean).collect();
        assert!(steps[index] < MAX_STEPS, "{name}, frame {index}: {steps:?} steps");
        let is_nearest = (0..frames.len()).all(|other| steps[index] <= steps[other]);
        assert!(is_nearest, "{name}, frame {index}: {steps:?} steps");
    }
    assert!(!picture_of(frames.len() + 1).exists(), "{name} has more frames");
}

/// Asserts that a video has this number of frames, and lasts `secs` seconds.
pub fn lasts(video: &Path, frames: u32, secs: f64) {
    let name = video.display();
    let probed = Command::new("ffprobe")
        .args(["-v", "error", "-count_frames", "-select_streams", "v:0"])
        .args(["-show_entries", "stream=nb_read_frames:format=duration", "-of", "json"])
        .arg(video)
        .output()
        .expect("ffprobe, which comes with FFmpeg");
    assert!(probed.status.success(), "{name}: {}", String::from_utf8_lossy(&probed.stderr));
    let found: Value = serde_json::from_slice(&probed.stdout).unwrap();
    let number = |pointer: &str| found.pointer(pointer)?.as_str()?.parse::<f64>().ok();
    assert_eq!(number("/streams/0/nb_read_frames"), Some(f64::from(frames)), "{name}: {found}");
    let duration = number("/format/duration").unwrap_or_default();
    assert!((duration - secs).abs() < 0.01, "{name} lasts {duration} s: {found}");
}
