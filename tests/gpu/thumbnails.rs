//! The pictures on the buttons of scenes and dives show what the presets draw now.

use std::io::Cursor;

use image::{ImageFormat, ImageReader, imageops::FilterType};
use mandelight::{
    scene::{Scene, presets},
    ui::{
        opening,
        thumbnail::{SIZE_PX, jpeg},
    },
};
use mandelight_test_support::view::{sampled, still};

/// Sides of the blocks whose means are compared, pixels: a block of JPEG's keeps its mean.
const BLOCK: usize = 8;

/// [`Difference::most`] that JPEG and fewer samples may make: 18.4 measured.
const MOST: f64 = 30.0;

/// [`Difference::mean`] that JPEG and fewer samples may make: 2.9 measured.
const MEAN: f64 = 4.5;

/// How much more scenes with a medium may differ: 1.5 and 3.9 times as much measured, with 64 samples.
const NOISY: f64 = 5.5;

/// A scene at a thumbnail's size, of fewer samples.
fn drawn(scene: Scene) -> Vec<u8> {
    // The tone curve darkens noise: few light paths would look darker.
    let samples = match scene.traces_paths() {
        true if is_noisy(&scene) => 32,
        true => 64,
        false => 8,
    };
    still(&sampled(scene, samples), SIZE_PX)
}

/// Whether light scatters in a medium: few paths are dark then, and many take long.
fn is_noisy(scene: &Scene) -> bool {
    scene.traces_medium() || scene.fog.density > 0.0
}

/// Means of each block's channels, of RGBA.
fn blocks(rgba: &[u8], size_px: [u32; 2]) -> Vec<[f64; 3]> {
    let [width, height] = size_px.map(|side| side as usize);
    let mut means = vec![[0.0; 3]; width.div_ceil(BLOCK) * height.div_ceil(BLOCK)];
    for (i, pixel) in rgba.as_chunks::<4>().0.iter().enumerate() {
        let (x, y) = (i % width / BLOCK, i / width / BLOCK);
        let mean = &mut means[y * width.div_ceil(BLOCK) + x];
        for channel in 0..3 {
            mean[channel] += f64::from(pixel[channel]) / (BLOCK * BLOCK) as f64;
        }
    }
    means
}

/// How far two pictures are apart, block by block, in steps of 1/255.
#[derive(Debug)]
struct Difference {
    /// Of the block's channel that differs most.
    most: f64,
    /// Of all blocks' channels.
    mean: f64,
}

impl Difference {
    /// Of two pictures of `size_px`, RGBA.
    fn of(a: &[u8], b: &[u8], size_px: [u32; 2]) -> Self {
        let pairs = blocks(a, size_px).into_iter().zip(blocks(b, size_px));
        let apart: Vec<f64> = pairs
            .flat_map(|(a, b)| [0, 1, 2].map(|channel| (a[channel] - b[channel]).abs()))
            .collect();
        let most = apart.iter().copied().fold(0.0, f64::max);
        Self { most, mean: apart.iter().sum::<f64>() / apart.len() as f64 }
    }
}

/// Says how a thumbnail's file differs from its scene.
fn fault(scene: Scene, file: Option<&[u8]>) -> Option<String> {
    let Some(file) = file else { return Some("there is none".to_owned()) };
    let picture = match ImageReader::with_format(Cursor::new(file), ImageFormat::Jpeg).decode() {
        Ok(picture) => picture.to_rgba8(),
        Err(error) => return Some(error.to_string()),
    };
    if picture.dimensions() != SIZE_PX.into() {
        return Some(format!("it has {:?} pixels, not {SIZE_PX:?}", picture.dimensions()));
    }
    let [most, mean] =
        [MOST, MEAN].map(|limit| if is_noisy(&scene) { NOISY * limit } else { limit });
    let difference = Difference::of(picture.as_raw(), &drawn(scene), SIZE_PX);
    println!("{difference:?}");
    let differs = difference.most > most || difference.mean > mean;
    differs.then(|| format!("{difference:.1?}, of {most} and {mean} allowed"))
}

#[test]
fn every_preset_has_a_thumbnail_of_itself() {
    let faults: Vec<String> = presets::all()
        .filter_map(|preset| {
            let fault = fault((preset.scene)(), jpeg(preset))?;
            Some(format!("the thumbnail of {}: {fault}", preset.name))
        })
        .collect();
    assert!(
        faults.is_empty(),
        "{}\nrun `cargo xtask thumbnails` and look at the pictures",
        faults.join("\n")
    );
}

#[test]
fn the_page_opens_on_the_picture_of_its_first_scene() {
    let file = include_bytes!("../../www/opening.jpg");
    assert!(file.len() < 100_000, "{} bytes stand in the document", file.len());
    let picture = ImageReader::with_format(Cursor::new(file), ImageFormat::Jpeg).decode();
    let picture = picture.expect("a JPEG file");
    assert_eq!([picture.width(), picture.height()], [opening::SIDE_PX; 2]);
    let size_px = [512, 512];
    let small = picture.resize_exact(size_px[0], size_px[1], FilterType::Triangle).to_rgba8();
    let now = still(&sampled(opening::scene(), 4), size_px);
    let difference = Difference::of(small.as_raw(), &now, size_px);
    println!("{difference:?}");
    // At half the resolution, silhouettes differ: 36.5 measured.
    let is_alike = difference.most < 1.5 * MOST && difference.mean < MEAN;
    assert!(is_alike, "{difference:?}: run `cargo xtask thumbnails opening`");
}

#[test]
fn a_missing_damaged_or_other_thumbnail_is_a_fault() {
    let [first, other] = [0, 1].map(|i| presets::all().nth(i).expect("two presets"));
    let scene = || (first.scene)();
    assert!(fault(scene(), None).is_some_and(|fault| fault.contains("none")));
    let file = jpeg(first).expect("a thumbnail");
    assert!(fault(scene(), Some(&file[..100])).is_some());
    assert!(fault(scene(), jpeg(other)).is_some_and(|fault| fault.contains("allowed")));
}

#[test]
fn small_changes_of_a_scene_are_faults() {
    let changes: [fn(&mut Scene); 2] =
        [|scene| scene.tone.exposure += 0.3, |scene| scene.camera.vertical_fov_deg *= 1.08];
    for preset in [presets::all().next(), presets::all().last()].into_iter().flatten() {
        for (i, change) in changes.into_iter().enumerate() {
            let mut scene = (preset.scene)();
            change(&mut scene);
            let fault = fault(scene, jpeg(preset));
            assert!(fault.is_some(), "{}: change {i} is not seen", preset.name);
        }
    }
}

#[test]
fn all_thumbnails_together_are_small() {
    let bytes: usize = presets::all().filter_map(jpeg).map(<[u8]>::len).sum();
    assert!(bytes < 280_000, "{bytes} bytes: lower the JPEG quality");
}
