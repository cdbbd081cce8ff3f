//! OpenEXR files against what the renderer knows, read by the `exr` crate and by OpenEXR's own
//! tools, which `cargo xtask test` sees to.

use std::{collections::BTreeMap, fs, io::Cursor, ops::ControlFlow, path::Path, process::Command};

use exr::prelude::{AnyChannels, FlatSamples, Image, Layer, ReadChannels as _, ReadLayers as _};
use glam::{DVec3, Vec3};
use mandelight::{
    export::{self, PictureFormat, StillJob, StillOptions, exr::ExrStream},
    render::{Pace, View},
    scene::{Background, Camera, IntegratorKind, Precise, PrecisePoint, Scene, document},
};
use mandelight_test_support::{
    device::pipelines,
    picture::Picture,
    view::{finished, sampled},
};

const SIZE: [u32; 2] = [53, 38];

/// Every channel's values by name, and the attributes that are text.
struct Decoded {
    channels: BTreeMap<String, Vec<f32>>,
    notes: BTreeMap<String, String>,
}

/// The first layer of an OpenEXR file, as the `exr` crate reads it.
pub fn read_exr(file: &[u8]) -> exr::error::Result<Image<Layer<AnyChannels<FlatSamples>>>> {
    exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .first_valid_layer()
        .all_attributes()
        .from_buffered(Cursor::new(file))
}

fn decoded(file: &[u8]) -> Decoded {
    let image = read_exr(file).expect("a file that the exr crate reads");
    let layer = &image.layer_data;
    assert_eq!((layer.size.0, layer.size.1), (SIZE[0] as usize, SIZE[1] as usize));
    let channels = layer.channel_data.list.iter().map(|channel| {
        let values = channel.sample_data.values_as_f32().collect();
        (channel.name.to_string(), values)
    });
    let own = layer.attributes.other.iter().chain(&image.attributes.other);
    let notes =
        own.filter_map(|(name, value)| Some((name.to_string(), value.to_text().ok()?.to_string())));
    Decoded { channels: channels.collect(), notes: notes.collect() }
}

fn file_of(scene: &Scene, tile_px: [u32; 2]) -> Vec<u8> {
    let options = StillOptions { tile_px, format: PictureFormat::Exr, ..StillOptions::new(SIZE) };
    let job = StillJob::new(pipelines(), scene, options, Vec::new()).unwrap();
    job.run(|_| ControlFlow::Continue(())).unwrap()
}

/// The same picture as one view, which a file in tiles must not differ from.
fn view_of(scene: &Scene) -> View {
    finished(scene, SIZE, Pace::Still)
}

/// Before a transparent background the colours are those of the picture before black, and alpha is that of a PNG.
#[test]
fn a_transparent_background_adds_an_alpha_channel() {
    let mut scene = sampled(Scene::default(), 16);
    scene.background = Background::gradient([0.0; 3], [0.0; 3]);
    for kind in [IntegratorKind::Direct, IntegratorKind::Path] {
        scene.integrator.kind = kind;
        scene.integrator.noise = 0.0;
        let black = decoded(&file_of(&scene, [64, 64])).channels;
        let options = |format| StillOptions {
            format,
            is_transparent: true,
            tile_px: [64, 64],
            ..StillOptions::new(SIZE)
        };
        let still = |format| {
            let job = StillJob::new(pipelines(), &scene, options(format), Vec::new()).unwrap();
            job.run(|_| ControlFlow::Continue(())).unwrap()
        };
        let channels = decoded(&still(PictureFormat::Exr)).channels;
        assert_eq!(channels.len(), black.len() + 1);
        let alpha = &channels["A"];
        let png = Picture::of(&still(PictureFormat::Png)).bytes;
        for (i, (alpha, pixel)) in alpha.iter().zip(png.as_chunks::<4>().0).enumerate() {
            assert!((alpha * 255.0 - f32::from(pixel[3])).abs() < 0.51, "{kind:?}: {alpha}");
            for name in ["R", "G", "B"] {
                let (over, opaque) = (channels[name][i], black[name][i]);
                let error = (over - opaque).abs();
                assert!(error <= 1e-4 * opaque.abs().max(0.1), "{kind:?}: {over} {opaque}");
            }
        }
        assert!(alpha.contains(&0.0) && alpha.contains(&1.0) && alpha.contains(&0.5));
    }
}

#[test]
fn channels_hold_the_film_and_the_g_buffer() {
    let scene = sampled(Scene::default(), 3);
    let view = view_of(&scene);
    let (film, samples) = (view.film().unwrap(), view.gbuffer().unwrap());
    for tile_px in [[64, 64], [20, 11]] {
        let Decoded { channels, .. } = decoded(&file_of(&scene, tile_px));
        let names: Vec<_> = channels.keys().map(String::as_str).collect();
        assert_eq!(names, ["B", "G", "N.X", "N.Y", "N.Z", "P.X", "P.Y", "P.Z", "R", "Z"]);
        let at = |name: &str, i: usize| channels[name][i];
        let mut met = 0;
        for (i, radiance) in film.iter().enumerate() {
            let close = |a: f32, b: f32| (a - b).abs() <= 1e-5 * b.abs().max(0.1);
            for (name, expected) in ["R", "G", "B"].into_iter().zip(*radiance) {
                assert!(close(at(name, i), expected), "{name} of pixel {i} in {tile_px:?}");
            }
            let triple = |name: &str| {
                Vec3::from_array(["X", "Y", "Z"].map(|axis| at(&format!("{name}.{axis}"), i)))
            };
            if samples.depth[i] > 0.0 {
                met += 1;
                assert!((triple("N") - samples.normal[i]).length() < 1e-5);
                // The eye's distance to the point is the depth along the ray.
                let from_eye = scene.camera.position.to_dvec3() - scene.camera.pivot.to_dvec3();
                let away = (triple("P").as_dvec3() - from_eye).length() as f32;
                assert!((away / samples.depth[i] - 1.0).abs() < 1e-5, "pixel {i}");
            } else {
                assert_eq!((triple("N"), triple("P")), (Vec3::ZERO, Vec3::ZERO));
                assert_eq!(at("Z", i), f32::INFINITY);
            }
        }
        assert!((200..film.len() - 200).contains(&met), "{met} pixels meet the surface");
    }
}

/// The point from Z alone, along a ray that ends one unit ahead of the eye: no unit vector, no
/// square root, nothing that the file's own arithmetic uses.
#[test]
fn the_position_lies_as_far_ahead_as_the_depth_says() {
    let scene = sampled(Scene::default(), 1);
    let Decoded { channels, .. } = decoded(&file_of(&scene, [64, 64]));
    let camera = &scene.camera;
    let from_camera = glam::DMat3::from_quat(camera.rotation());
    let [width, height] = SIZE.map(f64::from);
    let half = (camera.vertical_fov_deg.to_radians() / 2.0).tan();
    let eye_from_anchor = camera.position.to_dvec3() - camera.pivot.to_dvec3();
    let mut met = 0;
    for (i, &z) in channels["Z"].iter().enumerate() {
        let z = f64::from(z);
        if !z.is_finite() {
            continue;
        }
        met += 1;
        let (x, y) = (i % SIZE[0] as usize, i / SIZE[0] as usize);
        let aside = ((x as f64 + 0.5) / width - 0.5) * 2.0 * half * width / height;
        let above = (0.5 - (y as f64 + 0.5) / height) * 2.0 * half;
        let expected = eye_from_anchor + from_camera * DVec3::new(aside, above, -1.0) * z;
        let found = DVec3::from_array(["P.X", "P.Y", "P.Z"].map(|name| channels[name][i].into()));
        assert!((found - expected).length() < 1e-6 * z, "pixel {i}: {found} {expected}");
    }
    assert!(met > 200);
}

/// A scene whose numbers need all their digits, and whose words need letters past Latin-1.
fn exact_scene() -> Scene {
    let mut scene = sampled(Scene::default(), 1);
    let coordinate = |text: &str| -> Precise { text.parse().unwrap() };
    let near = ["0.1234567890123456789012345678901234567890", "-0.5", "1.25"].map(coordinate);
    scene.camera = Camera { pivot: PrecisePoint(near), ..scene.camera };
    scene.lights.rig.environment_map.name = "Größe 夕焼け 🌅.hdr".into();
    scene
}

#[test]
fn the_anchor_is_exact_and_the_scene_comes_along() {
    let scene = exact_scene();
    let file = file_of(&scene, [64, 64]);
    let Decoded { notes, .. } = decoded(&file);
    for (axis, coordinate) in ["x", "y", "z"].into_iter().zip(&scene.camera.pivot.0) {
        let found: Precise = notes[&format!("mandelight.anchor.{axis}")].parse().unwrap();
        assert_eq!(found, *coordinate);
    }
    assert!(notes["mandelight.anchor.x"].starts_with("0.12345678901234567890123456789012345"));
    assert!(notes["mandelight.Z"].contains("axis"));
    let text = export::exr_scene_text(Cursor::new(&file)).unwrap().unwrap();
    assert_eq!(document::from_json(&text), Ok(scene));
}

#[test]
fn files_that_carry_no_scene_are_told_apart() {
    let mut plain = Cursor::new(Vec::new());
    let white = exr::prelude::SpecificChannels::rgb(|_: exr::prelude::Vec2<usize>| {
        (1.0_f32, 1.0_f32, 1.0_f32)
    });
    use exr::prelude::WritableImage as _;
    exr::prelude::Image::from_channels((4, 2), white).write().to_buffered(&mut plain).unwrap();
    let plain = plain.into_inner();
    assert!(export::is_exr(&plain) && !export::is_exr(b"\x89PNG"));
    assert_eq!(export::exr_scene_text(Cursor::new(&plain)), Ok(None));
    for cut in [5, 20, 100, 200] {
        assert!(export::exr_scene_text(Cursor::new(&plain[..cut])).is_err(), "{cut} bytes");
    }
}

#[test]
fn missing_and_surplus_rows_are_errors() {
    let rows = |n: usize| vec![0; n * SIZE[0] as usize * 40];
    let stream = || ExrStream::new(Vec::new(), SIZE, &Scene::default()).unwrap();
    let mut short = stream();
    short.write_rows(&rows(SIZE[1] as usize - 1)).unwrap();
    assert!(short.finish().is_err());
    assert!(stream().write_rows(&rows(SIZE[1] as usize + 1)).is_err());
}

fn openexr(tool: &str, arguments: &[&Path]) -> String {
    let output = Command::new(tool).args(arguments).output().unwrap_or_else(|error| {
        panic!("{tool}: {error}: install OpenEXR's tools (on Debian: apt-get install openexr)")
    });
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    let complaint = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{tool}: {said}{complaint}");
    said
}

#[test]
fn openexrs_own_tools_read_header_and_pixels() {
    let folder = tempfile::tempdir().unwrap();
    let (ours, theirs) = (folder.path().join("ours.exr"), folder.path().join("theirs.exr"));
    let scene = exact_scene();
    let file = file_of(&scene, [20, 11]);
    fs::write(&ours, &file).unwrap();

    let header = openexr("exrheader", &[&ours]);
    for channel in ["B", "G", "N.X", "N.Y", "N.Z", "P.X", "P.Y", "P.Z", "R", "Z"] {
        assert!(header.contains(&format!("{channel}, 32-bit floating-point")), "{header}");
    }
    assert!(header.contains("0.12345678901234567890"), "{header}");
    assert!(header.contains("mandelight (type string)"), "{header}");
    let info = openexr("exrinfo", &["-s".as_ref(), "-v".as_ref(), &ours]);
    assert!(info.contains("uncompressed") || info.contains("none"), "{info}");

    // Every pixel through their reader, their tiles and their compression, and back.
    openexr("exrmaketiled", &["-z".as_ref(), "zip".as_ref(), &ours, &theirs]);
    let (ours, theirs) = (decoded(&file), decoded(&fs::read(&theirs).unwrap()));
    assert_eq!(ours.channels.len(), 10);
    assert!(ours.channels == theirs.channels, "OpenEXR reads other pixels");
    assert_eq!(ours.notes["mandelight"], theirs.notes["mandelight"]);
}
