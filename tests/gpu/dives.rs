//! The dives as pictures: something to see in each, in stills and in the frames of a flight.

use std::{ops::ControlFlow, process::Command};

use mandelight::{
    export::{StillJob, StillOptions},
    render::{Pace, View},
    scene::{document, presets},
};
use mandelight_test_support::{
    device::pipelines,
    dives::{fall, row_of},
    picture::Picture,
    view::{finished, rgb, sampled},
};

const SIZE_PX: [u32; 2] = [48, 32];

#[test]
fn each_shows_a_surface_at_the_depth_told() {
    for dive in presets::dives() {
        let scene = (dive.scene)();
        let (depth, _) = row_of(dive);
        let view = finished(&sampled(scene, 1), SIZE_PX, Pace::Still);
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

/// The picture's brightness, 0 to 255.
fn lumas(view: &View) -> Vec<f64> {
    let luma = |pixel: &[u8; 3]| pixel.iter().map(|&c| f64::from(c)).sum::<f64>() / 3.0;
    rgb(view).iter().map(luma).collect()
}

#[test]
fn frames_of_a_flight_down_are_the_stills_of_their_scenes() {
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
        let drawn = Picture::of(&std::fs::read(file).unwrap()).bytes;
        let scene = project.path.frame(frame).unwrap();
        let job =
            StillJob::new(pipelines(), &scene, StillOptions::new(SIZE_PX), Vec::new()).unwrap();
        let still = job.run(|_| ControlFlow::Continue(())).unwrap();
        assert_eq!(drawn, Picture::of(&still).bytes, "frame {frame}");
        let colors: std::collections::HashSet<_> = drawn.chunks_exact(3).collect();
        assert!(colors.len() > 200, "frame {frame} has {} colours", colors.len());
    }
}
