//! Stills in tiles, OpenEXR, sequences, links and documents, and two eyes, of deep scenes.

use std::{
    io::{Cursor, Read},
    ops::ControlFlow,
    sync::Arc,
};

use glam::{DMat3, DVec3};
use mandelight::{
    export::{
        Archive, PictureFormat, StillJob, StillOptions, StillStatus, frame_name, scene_text,
        sequence::SequenceJob,
    },
    formula::{DistanceField, mandelbulb::Mandelbulb},
    render::{Eyes, Pace, Region},
    scene::{
        Bloom, Camera, EnvironmentLight, Indirect, IndirectKind, LightFrame, Path, PointLight,
        Scene, Stereo, StereoLayout, document, link,
        path::{Easing, Key},
    },
};
use mandelight_test_support::{
    picture::Picture,
    view::{finished, finished_in, pipelines, sampled},
};

use super::places::{self, cone};
use crate::exr::read_exr;

const SIZE: [u32; 2] = [53, 38];

fn file(scene: &Scene, tile_px: [u32; 2], format: PictureFormat) -> Vec<u8> {
    let options = StillOptions { tile_px, format, ..StillOptions::new(SIZE) };
    let job = StillJob::new(pipelines(), scene, options, Vec::new()).expect("a still");
    job.run(|_| ControlFlow::Continue(())).expect("its file")
}

fn rgb(png: &[u8]) -> Vec<u8> {
    Picture::of(png).bytes
}

/// A rugged place, whose light comes along: it is dark in such depths.
fn lit(scale: f64) -> Scene {
    let mut scene = places::at(Mandelbulb { julia: true, ..Mandelbulb::default() }, scale);
    let direction = DVec3::new(0.5, 0.6, 0.8).normalize().to_array();
    let light = EnvironmentLight { direction, frame: LightFrame::View, ..Default::default() };
    scene.lights.environment = vec![light];
    scene
}

/// A scene whose picture depends on all of it at once.
fn glowing(scale: f64) -> Scene {
    let mut scene = sampled(lit(scale), 2);
    scene.tone.auto_exposure = true;
    scene.bloom = Bloom { strength: 0.5, threshold: 0.3, ..Bloom::default() };
    scene.indirect = Indirect { kind: IndirectKind::Horizon, ..Indirect::default() };
    scene
}

#[test]
fn tiles_join_without_a_seam() {
    for scale in [1e-9, 1e-20] {
        let scene = glowing(scale);
        let whole = rgb(&file(&scene, SIZE, PictureFormat::Png));
        let colors = whole.chunks(3).collect::<std::collections::HashSet<_>>().len();
        assert!(colors > 100, "{colors} colours");
        for tile_px in [[20, 11], [53, 9]] {
            let tiled = rgb(&file(&scene, tile_px, PictureFormat::Png));
            assert!(whole == tiled, "{scale:e}: tiles of {tile_px:?} differ");
        }
    }
}

#[test]
fn open_exr_has_depths_and_places_in_scene_units() {
    for scale in [1e-13, 1e-27] {
        let scene = sampled(places::scene(scale), 1);
        let image = read_exr(&file(&scene, [20, 11], PictureFormat::Exr))
            .expect("a file that the exr crate reads");
        let channels = &image.layer_data.channel_data.list;
        let channel = |name: &str| -> Vec<f32> {
            let found = channels.iter().find(|channel| channel.name.to_string() == name);
            found.expect("the channel").sample_data.values_as_f32().collect()
        };
        let depth = finished(&scene, SIZE, Pace::Still).gbuffer().expect("a G-buffer").depth;
        let (z, place) = (channel("Z"), ["P.X", "P.Y", "P.Z"].map(channel));
        let field = places::field(&scene, SIZE);
        let pivot = field.local(&scene.camera.pivot);
        let eye = field.local(&scene.camera.position);
        let mut met = 0;
        for index in 0..depth.len() {
            if !z[index].is_finite() {
                assert_eq!(depth[index], 0.0);
                continue;
            }
            met += 1;
            let depth = f64::from(depth[index]);
            let ray = places::ray(&scene, SIZE, index, &field.origin());
            let ahead = depth * ray.direction.dot(scene.camera.forward());
            assert!((f64::from(z[index]) / ahead - 1.0).abs() < 1e-5, "{}, {ahead}", z[index]);
            // On the surface, as the field sees it, and on the pixel's ray.
            let point = pivot + DVec3::from_array([0, 1, 2].map(|i| f64::from(place[i][index])));
            let off = (point - ray.at(depth)).length();
            assert!(off < 1e-5 * scale, "{scale:e}: {off:e} beside the ray");
            let hits = field.distance(point) / (cone(&scene, SIZE) * (point - eye).length());
            assert!(hits < 1.5, "{scale:e}: {hits} hit distances off the surface");
        }
        assert!(met * 2 > depth.len(), "{met} hits");
    }
}

/// A path that dives.
fn path() -> Path {
    let key = |time_secs, scale| Key {
        time_secs,
        easing: Easing::Smooth,
        scene: Arc::new(sampled(lit(scale), 1)),
    };
    let keys = vec![key(0.0, 1e-2), key(0.5, 1e-5), key(1.0, 1e-12)];
    Path { frames_per_second: 4, keys, ..Path::default() }
}

/// The files of a sequence's frames.
fn sequence(frames: std::ops::Range<u32>) -> Vec<Vec<u8>> {
    let options = StillOptions::new([36, 24]);
    let sink = Archive::new(Cursor::new(Vec::new()));
    let mut job = SequenceJob::new(pipelines(), path(), frames.clone(), options, false, sink)
        .expect("frames");
    let mut now_secs = 0.0;
    while !matches!(job.step(now_secs).expect("a step"), StillStatus::Done { .. }) {
        pipelines().gpu.wait();
        now_secs += 0.01;
    }
    let archive = job.finish().and_then(Archive::finish);
    let mut archive = zip::ZipArchive::new(archive.expect("a zip")).expect("a zip");
    frames
        .map(|frame| {
            let mut bytes = Vec::new();
            let mut entry = archive.by_name(&frame_name(frame)).expect("the frame");
            entry.read_to_end(&mut bytes).expect("its bytes");
            bytes
        })
        .collect()
}

#[test]
fn a_frame_alone_is_the_frame_of_the_sequence() {
    let all = sequence(0..5);
    for frame in [1, 3, 4] {
        assert!(sequence(frame..frame + 1)[0] == all[frame as usize], "frame {frame}");
    }
    for (frame, file) in (0..).zip(&all) {
        let colors =
            rgb(file).chunks(3).map(<[u8]>::to_vec).collect::<std::collections::HashSet<_>>();
        assert!(colors.len() > 60, "frame {frame} has {} colours", colors.len());
        let scene = path().frame(frame).expect("a frame");
        println!("frame {frame}: {:e} away, {} colours", scene.camera.view_unit(), colors.len());
    }
}

#[test]
fn links_and_files_bring_deep_scenes_back() {
    let mut scene = glowing(1e-27);
    let position = scene.camera.position.moved_by(DVec3::new(3e-28, -2e-28, 4e-28), 1e-36);
    scene.lights.point = vec![PointLight { position, ..PointLight::default() }];
    assert_eq!(scene.validate(), Ok(()));
    let text = document::to_json(&scene);
    assert_eq!(document::from_json(&text).as_ref(), Ok(&scene));
    let fragment = link::to_fragment(&scene).expect("a link");
    assert!(fragment.len() < 2000, "a link of {} letters", fragment.len());
    assert_eq!(link::from_fragment(&fragment).expect("its scene"), scene);
    let png = file(&scene, SIZE, PictureFormat::Png);
    let inside = scene_text(Cursor::new(&png)).expect("a PNG").expect("a scene in it");
    assert_eq!(document::from_json(&inside).as_ref(), Ok(&scene));
}

/// The points that each eye of a viewer in front of the screen sees are on the surface, as far away
/// as the picture says: eyes, screen and depths in centimetres, of which the eye's way to the pivot
/// has as many as the viewer's to the screen.
#[test]
fn both_eyes_see_the_surface_from_where_they_are() {
    for scale in [1e-13, 1e-27] {
        let mut scene = sampled(places::scene(scale), 1);
        let stereo = Stereo { layout: StereoLayout::SideBySide, ..Stereo::default() };
        scene.camera.stereo = stereo.clone();
        let field = places::field(&scene, SIZE);
        let Camera { position, .. } = &scene.camera;
        let middle = field.local(position);
        let from_camera = DMat3::from_quat(scene.camera.rotation());
        let units_per_cm = scene.camera.view_unit() / stereo.eye_distance_cm;
        let pixel_cm = stereo.screen_height_cm / f64::from(SIZE[1]);
        for (eyes, side) in [(Eyes::Left, -0.5), (Eyes::Right, 0.5)] {
            let region = Region { eyes, ..Region::whole(SIZE) };
            let view = finished_in(&scene, region, Pace::Still);
            let depth = view.gbuffer().expect("a G-buffer").depth;
            let eye_cm = DVec3::X * side * stereo.eye_separation_cm;
            let (mut met, mut off) = (0, 0);
            for (index, &depth) in depth.iter().enumerate().filter(|(_, depth)| **depth > 0.0) {
                let [x, y] = [index as u32 % SIZE[0], index as u32 / SIZE[0]];
                let aside = (f64::from(x) + 0.5 - 0.5 * f64::from(SIZE[0])) * pixel_cm;
                let up = (0.5 * f64::from(SIZE[1]) - f64::from(y) - 0.5) * pixel_cm;
                let way = DVec3::new(aside, up, -stereo.eye_distance_cm) - eye_cm;
                let depth = f64::from(depth);
                let from_eye = from_camera * way.normalize() * depth;
                let point = middle + from_camera * eye_cm * units_per_cm + from_eye;
                let hits = field.distance(point) / (cone(&scene, SIZE) * depth);
                met += 1;
                off += usize::from(!(0.3..1.3).contains(&hits));
            }
            println!("{eyes:?} at {scale:e}: {met} hits, {off} off");
            assert!(met * 2 > depth.len(), "{met} hits");
            assert!(off * 50 < met, "{eyes:?} at {scale:e}: {off} of {met} are off the surface");
        }
    }
}

/// Sixteen samples a pixel are nearly the mean of a picture with sixteen times as many pixels.
#[test]
fn samples_average_what_a_finer_picture_shows() {
    let size = [36, 24];
    let scene = |samples: u32, detail: f64| {
        let mut scene = sampled(lit(1e-20), samples);
        scene.quality.detail = detail;
        scene.quality.shadows = false;
        scene
    };
    let film = |scene: &Scene, size| finished(scene, size, Pace::Still).film().expect("a film");
    let fine = film(&scene(1, 4.0), size.map(|side| 4 * side));
    let mean = |index: usize| {
        let [x, y] = [index % size[0] as usize, index / size[0] as usize].map(|v| 4 * v);
        let width = 4 * size[0] as usize;
        let sum: f32 = (0..16).map(|k| fine[(y + k / 4) * width + x + k % 4][1]).sum();
        sum / 16.0
    };
    let off = |samples: u32| {
        let found = film(&scene(samples, 1.0), size);
        let sum: f32 = found.iter().enumerate().map(|(i, pixel)| (pixel[1] - mean(i)).abs()).sum();
        sum / found.iter().map(|pixel| pixel[1]).sum::<f32>()
    };
    let (one, sixteen) = (off(1), off(16));
    println!("off by {one} with one sample, by {sixteen} with sixteen");
    assert!(sixteen < 0.5 * one && sixteen < 0.05, "{one} {sixteen}");
}
