//! Light paths beside Mandelbulber's Monte Carlo global illumination.
//!
//! In: the program's pipelines, and `mandelbulber2` on this machine. Out: a row per view. Both sides draw a diffuse
//! surface of one colour under a white sky, with the camera, the iterations and the bounces of the same scene.
//! Mandelbulber runs on the processor, as llvmpipe does; on a GPU the ratio tells nothing about the algorithms.

use std::{
    ffi::OsStr,
    fs::File,
    io::BufReader,
    path::Path,
    process::{Command, Stdio},
    sync::Arc,
    time::Instant,
};

use mandelight::{
    render::Pipelines,
    scene::{Background, Scene},
};
use serde::Serialize;

use super::{
    failure::Failure,
    image_file,
    ours::draw_ms,
    paths::{self, BOUNCES, SAMPLES},
    statistics::median,
    views::{self, sampled},
};

/// The table's name for `--views`.
pub const NAME: &str = "mandelbulber";
/// The program.
const PROGRAM: &str = "mandelbulber2";
/// Its settings, without the camera and the numbers that come from the scene.
const SETTINGS: &str = include_str!("mandelbulber.fract");
/// Width and height, unless another size is chosen.
const SIZE_PX: [u32; 2] = [240, 180];
/// Samples of Mandelbulber's two pictures, which are independent of each other.
const THEIR_SAMPLES: [u32; 2] = [16, 64];
/// The noise whose time is given: the standard deviation of the picture's luminance over its mean.
const NOISE: f64 = 0.05;
/// Largest difference of the sides' mean radiance, over the program's.
///
/// Mandelbulber's light is not the integral of the rendering equation, so no tight bound holds.
const MAX_DIFFERENCE: f64 = 0.2;
/// Columns between both sides' pictures.
const GAP_PX: usize = 4;

/// One view.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// The view's name in the output.
    pub name: &'static str,
    /// The program.
    pub ours: Side,
    /// Mandelbulber.
    pub theirs: Side,
    /// Time to equal noise of Mandelbulber, over that of the program.
    pub ratio: f64,
    /// Whether both sides' mean radiance agrees.
    pub agrees: bool,
}

/// One side's pictures.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Side {
    /// Time of a sample of all pixels, milliseconds; Mandelbulber's without its start.
    pub sample_ms: f64,
    /// Mean luminance of the picture.
    pub radiance: f64,
    /// Variance of a picture's luminance times its samples, as the mean over all pixels.
    pub variance: f64,
}

impl Side {
    /// Time until the noise is [`NOISE`], seconds.
    pub fn secs_to_noise(&self) -> f64 {
        let samples = self.variance / (NOISE * self.radiance).powi(2);
        1e-3 * self.sample_ms * samples
    }
}

/// True if `mandelbulber2` can be started.
pub fn is_installed() -> bool {
    command().arg("--version").status().is_ok_and(|status| status.success())
}

/// Measures all views; the program's times are medians of so many rounds.
///
/// Also writes both sides' pictures, side by side and drawn in equal time, to the folder.
///
/// # Errors
/// If Mandelbulber is missing or fails, the device is lost, or a file can't be written.
pub fn measure(
    pipelines: &Arc<Pipelines>,
    rounds: u32,
    size_px: Option<[u32; 2]>,
    folder: Option<&Path>,
) -> Result<Vec<Row>, Failure> {
    if !is_installed() {
        return Err(format!("{PROGRAM} does not start: install Mandelbulber 2").into());
    }
    let size_px = size_px.unwrap_or(SIZE_PX);
    let cases = [("mandelbulber-whole", views::whole()), ("mandelbulber-filled", views::filled())];
    cases
        .into_iter()
        .map(|(name, scene)| {
            let row =
                measure_view(pipelines, name, &under_white_sky(scene), size_px, rounds, folder)?;
            row.print();
            Ok(row)
        })
        .collect()
}

/// A scene with a diffuse surface of one colour under a white sky, before a black background.
fn under_white_sky(scene: Scene) -> Scene {
    let mut scene = paths::bouncing(&paths::diffuse(scene, None), BOUNCES);
    let sky = &mut scene.lights.rig.sky;
    (sky.zenith, sky.horizon, sky.ground) = ([1.0; 3], [1.0; 3], [1.0; 3]);
    scene.background = Background::gradient([0.0; 3], [0.0; 3]);
    scene
}

fn measure_view(
    pipelines: &Arc<Pipelines>,
    name: &'static str,
    scene: &Scene,
    size_px: [u32; 2],
    rounds: u32,
    folder: Option<&Path>,
) -> Result<Row, Failure> {
    let timed = sampled(scene.clone(), SAMPLES);
    // The first round is a warm-up.
    let ms: Vec<_> = (0..=rounds).map(|_| draw_ms(pipelines, &timed, size_px).0).skip(1).collect();
    let (radiance, variance) = paths::our_noise(pipelines, scene, size_px)?;
    let ours = Side { sample_ms: median(&ms) / f64::from(SAMPLES), radiance, variance };

    let (start_ms, _) = their_picture(scene, size_px, 1)?;
    let [few, many] = THEIR_SAMPLES;
    let (few_ms, some) = their_picture(scene, size_px, few)?;
    let (many_ms, most) = their_picture(scene, size_px, many)?;
    let theirs = Side {
        sample_ms: (many_ms - start_ms) / f64::from(many - 1),
        radiance: most.iter().sum::<f64>() / most.len() as f64,
        variance: variance_of([&some, &most]),
    };
    if let Some(folder) = folder {
        let samples = ((few_ms - start_ms) / ours.sample_ms).max(1.0) as u32;
        let (_, view) = draw_ms(pipelines, &sampled(scene.clone(), samples), size_px);
        let film: Vec<_> = view.film()?.into_iter().map(|[red, ..]| f64::from(red)).collect();
        println!("{name}: {few} samples of Mandelbulber take as long as {samples} of the program");
        std::fs::create_dir_all(folder)?;
        write_pair(&folder.join(format!("{name}.png")), size_px, [&film, &some])?;
    }
    Ok(Row {
        name,
        ratio: theirs.secs_to_noise() / ours.secs_to_noise(),
        agrees: (theirs.radiance / ours.radiance - 1.0).abs() < MAX_DIFFERENCE,
        ours,
        theirs,
    })
}

/// Variance of one sample, from two independent pictures with [`THEIR_SAMPLES`].
fn variance_of([some, most]: [&[f64]; 2]) -> f64 {
    let squares: f64 = some.iter().zip(most).map(|(a, b)| (a - b) * (a - b)).sum();
    let parts: f64 = THEIR_SAMPLES.into_iter().map(|samples| f64::from(samples).recip()).sum();
    squares / some.len() as f64 / parts
}

/// Mandelbulber, with no window.
fn command() -> Command {
    let mut command = Command::new(PROGRAM);
    command.env("QT_QPA_PLATFORM", "offscreen").stdout(Stdio::null()).stderr(Stdio::null());
    command
}

/// Draws the scene with Mandelbulber: milliseconds of the whole process, and each pixel's radiance before black.
fn their_picture(
    scene: &Scene,
    size_px: [u32; 2],
    samples: u32,
) -> Result<(f64, Vec<f64>), Failure> {
    let folder = tempfile::tempdir()?;
    let (settings, picture) = (folder.path().join("scene.fract"), folder.path().join("picture"));
    std::fs::write(&settings, SETTINGS)?;
    let started = Instant::now();
    let status = command()
        .env("HOME", folder.path())
        .args(["--nogui", "--format", "png16alpha"])
        .args([OsStr::new("--output"), picture.as_os_str()])
        .args(["--res", &size_px.map(|side| side.to_string()).join("x")])
        .args(["--override", &overrides(scene, samples)])
        .arg(&settings)
        .status()?;
    let ms = started.elapsed().as_secs_f64() * 1e3;
    if !status.success() {
        return Err(format!("{PROGRAM} ended with {status}").into());
    }
    Ok((ms, read(&picture.with_extension("png"), size_px)?))
}

/// The scene's numbers, as Mandelbulber's command line takes them.
///
/// Its `fov` is twice the tangent of half the vertical angle.
fn overrides(scene: &Scene, samples: u32) -> String {
    let (camera, fractal) = (&scene.camera, &scene.fractal);
    let vector = |vector: glam::DVec3| vector.to_array().map(|v| v.to_string()).join(" ");
    [
        format!("camera={}", vector(camera.position.to_dvec3())),
        format!("target={}", vector(camera.pivot.to_dvec3())),
        format!("camera_top={}", vector(camera.rotation() * glam::DVec3::Y)),
        format!("fov={}", 2.0 * camera.half_height(1.0)),
        format!("N={}", fractal.iterations),
        format!("bailout={}", fractal.bailout),
        format!("reflections_max={BOUNCES}"),
        format!("DOF_samples={samples}"),
    ]
    .join("#")
}

/// Radiance of each pixel of a picture of 16 bits a channel, without the white sky behind it.
fn read(path: &Path, size_px: [u32; 2]) -> Result<Vec<f64>, Failure> {
    let mut reader = png::Decoder::new(BufReader::new(File::open(path)?)).read_info()?;
    let info = reader.info();
    let is_expected = [info.width, info.height] == size_px
        && (info.color_type, info.bit_depth) == (png::ColorType::Rgba, png::BitDepth::Sixteen);
    if !is_expected {
        return Err(format!("{PROGRAM} wrote another kind of picture than was asked for").into());
    }
    let mut bytes = vec![0; reader.output_buffer_size().ok_or("the picture is too large")?];
    reader.next_frame(&mut bytes)?;
    let pixels = bytes.chunks_exact(8).map(|pixel| {
        let channel =
            |at: usize| f64::from(u16::from_be_bytes([pixel[at], pixel[at + 1]])) / 65535.0;
        // Red, green and blue are equal.
        let (radiance, alpha) = (channel(0), channel(6));
        (radiance - (1.0 - alpha)).max(0.0)
    });
    Ok(pixels.collect())
}

/// Writes two grey pictures side by side as a PNG file.
fn write_pair(path: &Path, size_px: [u32; 2], pair: [&[f64]; 2]) -> Result<(), Failure> {
    let [width, height] = size_px.map(|side| side as usize);
    let columns = 2 * width + GAP_PX;
    let mut rgba = vec![255; 4 * columns * height];
    for (first, radiance) in [0, width + GAP_PX].into_iter().zip(pair) {
        for (at, radiance) in radiance.iter().enumerate() {
            let pixel = 4 * (at / width * columns + first + at % width);
            rgba[pixel..pixel + 3].fill(image_file::encoded(*radiance));
        }
    }
    image_file::write(path, [columns as u32, size_px[1]], &rgba)
}

impl Row {
    /// Prints the view's table for people, and its `ratio` line for scripts.
    fn print(&self) {
        let Self { name, ours, theirs, ratio, agrees } = self;
        println!("\n{name}: light paths of {BOUNCES} bounces");
        println!("  {:<28}{:>14}{:>12}", "", "Mandelbulber", "ours");
        let row = |label: &str, value: fn(&Side) -> f64| {
            println!("  {label:<28}{:>14.4}{:>12.4}", value(theirs), value(ours));
        };
        row("ms a sample", |side| side.sample_ms);
        row("variance a sample", |side| side.variance);
        row("mean radiance", |side| side.radiance);
        row("seconds to 5 % noise", Side::secs_to_noise);
        if !agrees {
            println!("  FAIL: the sides' mean radiance differs");
        }
        println!("ratio {name} {ratio:.2}");
    }
}
