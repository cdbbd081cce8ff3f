//! One view drawn by both sides in turn: times, counts and errors.
//!
//! In: the arguments, pipelines of both sides, a view. Out: a [`Comparison`].

use std::{collections::HashMap, path::Path, sync::Arc, time::Instant};

use mandelight::{
    formula::mandelbulb::Mandelbulb,
    fractal::FractalModel,
    render::{self, Pipelines, Region, space::RenderSpace, uniforms::Inputs},
};
use serde::Serialize;

use super::{
    arguments::Arguments,
    counts::Counts,
    errors::{Errors, ReferencePixels, SideSample},
    failure::Failure,
    image_file,
    literal::{self, Literal, Picture, Tuning},
    load::Load,
    ours,
    peak::{self, Peak},
    statistics::median,
    tuning,
    views::{View, sampled},
};

/// Least duration of one side's turn, seconds.
const TURN_SECS: f64 = 0.4;

/// The measurements of one view on both sides.
#[derive(Clone, Debug, Serialize)]
pub struct Comparison {
    /// The view's name.
    pub view: &'static str,
    /// What it shows.
    pub about: &'static str,
    /// Width and height, pixels.
    pub size_px: [u32; 2],
    /// Samples a pixel.
    pub samples: u32,
    /// Number of lights.
    pub lights: usize,
    /// Fraction of pixels whose reference ray hits the set.
    pub hit: f64,
    /// Fraction of the hit pixels' visibility bits that the reference sets.
    pub lit: f64,
    /// The thesis's algorithm.
    pub literal: Side,
    /// The program.
    pub ours: Side,
    /// Literal time divided by the program's time.
    pub ratio: f64,
    /// Measured multiply-add throughput of the adapter, median of the same rounds, GFLOP/s.
    pub peak_gflops: f64,
    /// The program's share of [`Self::peak_gflops`], 0 to 1; none for a power that isn't whole.
    ///
    /// It divides the operations that the orbit steps need by the whole time of the picture.
    pub peak_share: Option<f64>,
    /// The reasons why the ratio does not count; empty where it counts.
    pub complaints: Vec<String>,
    /// The program's counts per pixel: each pass of the first sample, then a later sample.
    pub our_counts: Vec<(&'static str, Counts)>,
    /// Times of the program's passes over one sample per pixel, milliseconds.
    pub passes_ms: Vec<(&'static str, f64)>,
}

/// One side of a comparison.
#[derive(Clone, Debug, Serialize)]
pub struct Side {
    /// Median time, milliseconds.
    pub ms: f64,
    /// The time of each round, milliseconds.
    pub rounds_ms: Vec<f64>,
    /// Fraction of the machine's processors that drawing kept busy; 0 where the system has
    /// no figures.
    pub busy: f64,
    /// Iteration limit of an orbit.
    pub iterations: u32,
    /// Errors of one sample.
    pub errors: Errors,
    /// Mean counts of one sample of a pixel.
    pub counts: Counts,
}

impl Comparison {
    /// Prints a table for people and a `ratio` line for scripts.
    pub fn print(&self) {
        let Self { view, about, size_px: [width, height], samples, lights, .. } = self;
        println!("\n{view}: {about}");
        println!(
            "  {width}x{height}, {samples} samples, {lights} lights; {:.0} % of the pixels hit, {:.0} % of their lights' bits set",
            100.0 * self.hit,
            100.0 * self.lit
        );
        println!("  {:<18}{:>12}{:>12}", "", "literal", "ours");
        let row = |name: &str, literal: String, ours: String| {
            println!("  {name:<18}{literal:>12}{ours:>12}");
        };
        let (literal, ours) = (&self.literal, &self.ours);
        row("ms", format!("{:.1}", literal.ms), format!("{:.1}", ours.ms));
        row(
            "processors busy, %",
            format!("{:.0}", 100.0 * literal.busy),
            format!("{:.0}", 100.0 * ours.busy),
        );
        row("iterations", literal.iterations.to_string(), ours.iterations.to_string());
        row(
            "estimates a pixel",
            format!("{:.1}", literal.counts.estimates),
            format!("{:.1}", ours.counts.estimates),
        );
        row(
            "steps a pixel",
            format!("{:.1}", literal.counts.steps),
            format!("{:.1}", ours.counts.steps),
        );
        if let Some(share) = self.peak_share {
            let peak = format!("% of {:.0} GFLOP/s", self.peak_gflops);
            row(&peak, String::new(), format!("{:.1}", 100.0 * share));
        }
        let columns = literal.errors.columns().into_iter().zip(ours.errors.columns());
        for ((name, literal), (_, ours)) in columns {
            row(name, format!("{literal:.4}"), format!("{ours:.4}"));
        }
        for (name, counts) in &self.our_counts {
            println!(
                "  in {name}: {:.1} estimates, {:.1} steps a pixel",
                counts.estimates, counts.steps
            );
        }
        for (name, ms) in &self.passes_ms {
            println!("  pass {name} {ms:.1} ms");
        }
        if self.complaints.is_empty() {
            println!("  pass: the picture is as good");
        }
        for complaint in &self.complaints {
            println!("  FAIL: {complaint}");
        }
        println!("ratio {view} {:.2}", self.ratio);
    }
}

/// Measures a view on both sides.
///
/// # Errors
/// If the device is lost, or a picture can't be written.
pub fn compare(
    arguments: &Arguments,
    pipelines: &Arc<Pipelines>,
    literal: &Literal,
    peak: &Peak,
    view: &View,
) -> Result<Comparison, Failure> {
    let View { name, about, ref scene, size_px, stride, .. } = *view;
    let samples = scene.quality.samples;
    let tuning = tuning::find(scene, size_px);
    // The literal kernel has no anchors.
    let inputs = Inputs::about(
        scene,
        Region::whole(size_px),
        &RenderSpace::plain(&FractalModel::new(&scene.fractal)),
    );
    let literal_picture = Picture::new(literal, &inputs, samples, tuning, stride);

    // Errors are those of one sample. These pictures also warm up pipelines and drivers.
    let one_sample = sampled(scene.clone(), 1);
    let references = ReferencePixels::new(scene, size_px, arguments.error_pixels);
    let (hit, lit) = references.coverage();
    let literal_errors =
        references.compare(&literal_samples(literal, &inputs, tuning, &references)?);
    let (_, shown) = ours::draw_ms(pipelines, &one_sample, size_px);
    let our_errors = references.compare(&our_samples(&shown, size_px, &references)?);
    let complaints = our_errors.complaints(&literal_errors, view.normals_within_deg);
    drop(shown);

    let (mut literal_ms, mut ours_ms, mut gflops) = (Vec::new(), Vec::new(), Vec::new());
    let (mut literal_busy, mut ours_busy) = (Vec::new(), Vec::new());
    let rounds = if view.is_long { arguments.rounds.div_ceil(2) } else { arguments.rounds };
    for _ in 0..rounds {
        literal_ms.push(repeated_ms(&mut literal_busy, || literal_picture.draw_ms()));
        ours_ms.push(repeated_ms(&mut ours_busy, || ours::draw_ms(pipelines, scene, size_px).0));
        gflops.push(peak.gflops());
    }
    if let Some(folder) = &arguments.pictures {
        write_pictures(folder, pipelines, view, &literal_picture)?;
    }
    let pixels: f64 = size_px.into_iter().map(f64::from).product();
    let literal_counts = literal::counts(&pipelines.gpu, &inputs, tuning)?.per(pixels);
    let our_counts: Vec<_> = ours::counts(pipelines, scene, size_px)?
        .into_iter()
        .map(|(pass, counts)| (pass, counts.per(pixels)))
        .collect();
    let our_mean = mean_counts(&our_counts, samples);
    let side = |rounds_ms: Vec<f64>, busy: Vec<f64>, iterations, errors, counts| Side {
        ms: median(&rounds_ms),
        rounds_ms,
        busy: median(&busy),
        iterations,
        errors,
        counts,
    };
    let literal = side(literal_ms, literal_busy, tuning.iterations, literal_errors, literal_counts);
    let ours = side(ours_ms, ours_busy, scene.fractal.iterations, our_errors, our_mean);
    let peak_gflops = median(&gflops);
    let flop = Mandelbulb::of(&scene.fractal).integer_power().map(peak::flop_per_step);
    let steps = ours.counts.steps * pixels * f64::from(samples);
    let peak_share = flop.map(|flop| steps * flop / (ours.ms * 1e-3) / (peak_gflops * 1e9));
    let passes_ms =
        if arguments.passes { passes(arguments, pipelines, view, ours.ms) } else { Vec::new() };
    Ok(Comparison {
        view: name,
        about,
        size_px,
        samples,
        lights: scene.lights.len(),
        hit,
        lit,
        ratio: literal.ms / ours.ms,
        literal,
        ours,
        peak_gflops,
        peak_share,
        complaints,
        our_counts,
        passes_ms,
    })
}

/// Writes both sides' pictures of a view as PNG files.
fn write_pictures(
    folder: &Path,
    pipelines: &Arc<Pipelines>,
    view: &View,
    literal_picture: &Picture<'_>,
) -> Result<(), Failure> {
    let View { name, ref scene, size_px, .. } = *view;
    std::fs::create_dir_all(folder)?;
    let (_, shown) = ours::draw_ms(pipelines, scene, size_px);
    let ours = ours::display(pipelines, &shown)?;
    image_file::write(&folder.join(format!("{name}.png")), size_px, &ours)?;
    let (exposure, white) = (scene.tone.exposure, scene.tone.white_point);
    let literal = image_file::tone_mapped(&literal_picture.seen()?, size_px, exposure, white);
    image_file::write(&folder.join(format!("{name}-literal.png")), size_px, &literal)
}

/// The mean over all samples of the program's counts, which [`ours::counts`] lists by pass.
fn mean_counts(by_pass: &[(&'static str, Counts)], samples: u32) -> Counts {
    let mut mean = Counts::default();
    for (name, counts) in by_pass {
        let weight = if *name == ours::LATER { samples - 1 } else { 1 };
        mean += counts.per(f64::from(samples) / f64::from(weight));
    }
    mean
}

/// Mean time of as many pictures as fit [`TURN_SECS`], milliseconds.
///
/// Turns of equal length expose both sides to the same load of other programs. Appends the
/// fraction of the processors that this program used, where the system has figures.
fn repeated_ms(busy: &mut Vec<f64>, mut draw_ms: impl FnMut() -> f64) -> f64 {
    let (start, before) = (Instant::now(), Load::now());
    let (mut sum_ms, mut pictures) = (0.0, 0.0);
    while pictures == 0.0 || start.elapsed().as_secs_f64() < TURN_SECS {
        sum_ms += draw_ms();
        pictures += 1.0;
    }
    busy.extend(before.zip(Load::now()).map(|(before, now)| now.own_share_since(&before)));
    sum_ms / pictures
}

/// Times each pass over one sample per pixel, milliseconds.
///
/// `rest` is the time of one sample of the still minus the sum of the passes.
fn passes(
    arguments: &Arguments,
    pipelines: &Pipelines,
    view: &View,
    still_ms: f64,
) -> Vec<(&'static str, f64)> {
    let runner = ours::PassRunner::new(pipelines, &view.scene, view.size_px);
    runner.draw_ms();
    let rounds: Vec<_> = (0..arguments.rounds).map(|_| runner.draw_ms()).collect();
    let mut passes: Vec<_> = rounds[0]
        .iter()
        .enumerate()
        .map(|(index, (name, _))| {
            let times: Vec<_> = rounds.iter().map(|round| round[index].1).collect();
            (*name, median(&times))
        })
        .collect();
    let sum_ms: f64 = passes.iter().map(|(_, ms)| ms).sum();
    passes.push(("rest", still_ms / f64::from(view.scene.quality.samples) - sum_ms));
    passes
}

/// The literal kernel's first samples of the compared pixels.
fn literal_samples(
    literal: &Literal,
    inputs: &Inputs,
    tuning: Tuning,
    references: &ReferencePixels,
) -> Result<Vec<SideSample>, Failure> {
    let picture = Picture::new(literal, inputs, 1, tuning, 1);
    picture.draw_ms();
    let seen: HashMap<_, _> = picture.seen()?.into_iter().map(|seen| (seen.pixel, seen)).collect();
    let shown = references.pixels.iter().filter_map(|pixel| seen.get(pixel)).map(|seen| {
        SideSample { depth: seen.depth, normal: seen.normal, visibility: seen.visibility }
    });
    Ok(shown.collect())
}

/// The program's first samples of the compared pixels.
fn our_samples(
    view: &render::View,
    size_px: [u32; 2],
    references: &ReferencePixels,
) -> Result<Vec<SideSample>, Failure> {
    let samples = view.gbuffer()?;
    let shown =
        references.pixels.iter().map(|[x, y]| (y * size_px[0] + x) as usize).map(|i| SideSample {
            depth: samples.depth[i],
            normal: samples.normal[i],
            visibility: samples.visibility[i],
        });
    Ok(shown.collect())
}
