//! Light paths: the program's path tracer beside one in a single kernel.
//!
//! In: the program's pipelines. Out: a row per view. Both sides draw a diffuse surface under a sky, with rays of any
//! length. The time to equal noise is the time of a sample times its variance: each side's variance is about its own
//! mean, so errors of the picture do not count.

use std::sync::Arc;

use glam::DVec3;
use mandelight::{
    fractal::FractalModel,
    render::{Pipelines, Region, space::RenderSpace, uniforms::Inputs},
    scene::{GradientStop, IntegratorKind, RigKind, Scene, SurfaceModel, color::luminance},
};
use serde::Serialize;

use super::{
    counts::Counts,
    deep,
    failure::Failure,
    literal_paths::{LiteralPaths, Picture},
    ours,
    statistics::median,
    tuning,
    views::{self, sampled},
};

/// The table's name for `--views`.
pub const NAME: &str = "paths";
/// Width and height, unless another size is chosen.
const SIZE_PX: [u32; 2] = [96, 72];
/// The name of the view in the crevice.
const CREVICE: &str = "paths-crevice";
/// Bounces of the comparison.
pub const BOUNCES: u32 = 4;
/// Bounces of the pictures whose times are told apart.
const SERIES: [u32; 5] = [0, 1, 2, 4, 8];
/// The part of the light that the surface reflects.
pub const ALBEDO: f32 = 0.7;
/// Samples of a timed picture of the program: its later samples outweigh the first.
pub const SAMPLES: u32 = 32;
/// Samples of the program's picture that is taken for the truth.
const MANY_SAMPLES: u32 = 8 * SAMPLES;
/// Samples of a timed picture of the single kernel.
const LITERAL_SAMPLES: u32 = 8;
/// Largest difference of the sides' mean radiance, over the program's.
const MAX_DIFFERENCE: f64 = 0.05;
/// The same in the crevice, whose near walls the single kernel's one epsilon blurs.
const MAX_DIFFERENCE_IN_CREVICE: f64 = 0.2;

/// One view.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// The view's name in the output.
    pub name: &'static str,
    /// The program.
    pub ours: Side,
    /// The path tracer in one kernel; none where it cannot draw the view.
    pub literal: Option<Side>,
    /// Time to equal noise of the single kernel, over that of the program.
    pub ratio: Option<f64>,
    /// What each bounce adds to a path, for some numbers of bounces in turn.
    pub bounces: Vec<Bounce>,
    /// The largest number of estimates of a later bounce, over that of the first.
    pub growth: f64,
    /// Whether both sides' mean radiance agrees.
    pub agrees: bool,
}

/// One side's paths.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Side {
    /// Time of a path, microseconds.
    pub path_us: f64,
    /// Distance estimates and orbit steps of a path.
    pub counts: Counts,
    /// Mean luminance of the picture.
    pub radiance: f64,
    /// Variance of a picture's luminance times its samples, as the mean over all pixels.
    pub variance: f64,
}

/// What some bounces of a path take.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Bounce {
    /// The last of them.
    pub last: u32,
    /// The time of each, microseconds a path.
    pub us: f64,
    /// The distance estimates of each.
    pub estimates: f64,
}

/// A view's scene with a diffuse surface of one colour under a sky, and rays of a length in view units.
///
/// The sides' iteration limits differ, and so would colours of orbits.
pub fn diffuse(mut scene: Scene, reach: Option<f64>) -> Scene {
    scene.surface.model = SurfaceModel::BlinnPhong;
    scene.surface.specular = 0.0;
    scene.surface.diffuse = 1.0;
    scene.surface.emission = 0.0;
    scene.surface.gradient = vec![GradientStop { position: 0.0, color: [ALBEDO; 3] }];
    scene.lights.environment.clear();
    scene.lights.point.clear();
    let rig = &mut scene.lights.rig;
    rig.kind = RigKind::Sky;
    // Of the centre samples alone.
    rig.count = 3;
    rig.shadow_reach = reach;
    rig.sky.sun_strength = 0.0;
    scene.integrator.kind = IntegratorKind::Path;
    scene.integrator.reach = reach;
    scene
}

/// A scene with another number of bounces.
pub fn bouncing(scene: &Scene, bounces: u32) -> Scene {
    let mut scene = scene.clone();
    scene.integrator.bounces = bounces;
    scene
}

/// The views, each with whether the single kernel can draw it.
fn cases() -> Result<Vec<(&'static str, Scene, bool)>, Failure> {
    let names = [("paths-whole", "whole"), ("paths-filled", "filled"), (CREVICE, "crevice")];
    let mut cases = Vec::new();
    for (name, view) in names {
        let view = views::all().into_iter().find(|known| known.name == view);
        cases.push((name, diffuse(view.ok_or("a view is missing")?.scene, None), true));
    }
    cases.push(("paths-deep-1e-9", diffuse(deep::scene(1e-9)?, Some(1.0)), false));
    Ok(cases)
}

/// Measures all views; each side's times are medians of so many rounds.
///
/// # Errors
/// If the device is lost, or a kernel can't be counted.
pub fn measure(
    pipelines: &Arc<Pipelines>,
    rounds: u32,
    size_px: Option<[u32; 2]>,
) -> Result<Vec<Row>, Failure> {
    let size_px = size_px.unwrap_or(SIZE_PX);
    let literal = [LiteralPaths::new(&pipelines.gpu), LiteralPaths::counting(&pipelines.gpu)?];
    cases()?
        .into_iter()
        .map(|(name, scene, is_plain)| {
            let literal = is_plain.then_some(&literal);
            let row = measure_view(pipelines, name, &scene, size_px, rounds, literal)?;
            row.print();
            Ok(row)
        })
        .collect()
}

fn measure_view(
    pipelines: &Arc<Pipelines>,
    name: &'static str,
    scene: &Scene,
    size_px: [u32; 2],
    rounds: u32,
    literal: Option<&[LiteralPaths; 2]>,
) -> Result<Row, Failure> {
    let pixels: f64 = size_px.into_iter().map(f64::from).product();
    let own = bouncing(scene, BOUNCES);
    let inputs = Inputs::about(
        &own,
        Region::whole(size_px),
        &RenderSpace::plain(&FractalModel::new(&own.fractal)),
    );
    let tuning = literal.map(|_| tuning::find(&own, size_px));
    let kernels = tuning.zip(literal).map(|(tuning, [timed, counting])| {
        [(timed, false), (counting, true)]
            .map(|(paths, counts)| Picture::new(paths, &inputs, &own, tuning, counts))
    });
    let series = SERIES.map(|bounces| sampled(bouncing(scene, bounces), SAMPLES));
    let (mut ours_us, mut literal_us) = (vec![Vec::new(); SERIES.len()], Vec::new());
    for round in 0..=rounds {
        for (scene, times) in series.iter().zip(&mut ours_us) {
            let (ms, _) = ours::draw_ms(pipelines, scene, size_px);
            // The first round is a warm-up.
            if round > 0 {
                times.push(1e3 * ms / (pixels * f64::from(SAMPLES)));
            }
        }
        if let Some([picture, _]) = &kernels {
            let samples = if round > 0 { LITERAL_SAMPLES } else { 1 };
            let ms = picture.draw_ms(samples);
            if round > 0 {
                literal_us.push(1e3 * ms / (pixels * f64::from(samples)));
            }
        }
    }
    let medians: Vec<_> = ours_us.iter().map(|times| median(times)).collect();
    let at = SERIES.iter().position(|bounces| *bounces == BOUNCES).unwrap_or(0);
    let (radiance, variance) = our_noise(pipelines, &own, size_px)?;
    let counts = our_counts(pipelines, &series, size_px)?;
    let ours = Side { path_us: medians[at], counts: counts[at], radiance, variance };
    let literal = match &kernels {
        Some([picture, counting]) => {
            let outcome = picture.outcome()?;
            counting.draw_ms(1);
            Some(Side {
                path_us: median(&literal_us),
                counts: counting.counts()?.per(pixels),
                radiance: outcome.radiance,
                variance: outcome.variance,
            })
        }
        None => None,
    };
    let cost = |side: &Side| side.path_us * side.variance;
    let estimates: Vec<_> = counts.iter().map(|counts| counts.estimates).collect();
    let bounces = per_bounce(&medians, &estimates);
    let growths = bounces.iter().skip(1).map(|later| later.estimates / bounces[0].estimates);
    Ok(Row {
        name,
        ratio: literal.map(|literal| cost(&literal) / cost(&ours)),
        growth: growths.fold(0.0, f64::max),
        agrees: literal.is_none_or(|literal| {
            let most = if name == CREVICE { MAX_DIFFERENCE_IN_CREVICE } else { MAX_DIFFERENCE };
            (literal.radiance / ours.radiance - 1.0).abs() < most
        }),
        ours,
        literal,
        bounces,
    })
}

/// What each bounce takes, from what the paths of the [`SERIES`] take.
fn per_bounce(path_us: &[f64], estimates: &[f64]) -> Vec<Bounce> {
    let each = |pair: [usize; 2], values: &[f64]| {
        let [before, last] = pair;
        (values[last] - values[before]) / f64::from(SERIES[last] - SERIES[before])
    };
    (1..SERIES.len())
        .map(|k| Bounce {
            last: SERIES[k],
            us: each([k - 1, k], path_us),
            estimates: each([k - 1, k], estimates),
        })
        .collect()
}

/// Mean luminance of the program's picture, and its variance times its samples.
///
/// # Errors
/// If the device is lost.
pub fn our_noise(
    pipelines: &Arc<Pipelines>,
    scene: &Scene,
    size_px: [u32; 2],
) -> Result<(f64, f64), Failure> {
    let drawn = |samples| -> Result<Vec<f64>, Failure> {
        let (_, view) = ours::draw_ms(pipelines, &sampled(scene.clone(), samples), size_px);
        let film = view.film()?;
        Ok(film.into_iter().map(|color| luminance(DVec3::from(color.map(f64::from)))).collect())
    };
    let (some, many) = (drawn(SAMPLES)?, drawn(MANY_SAMPLES)?);
    let pixels = many.len() as f64;
    let squares: f64 = some.iter().zip(&many).map(|(a, b)| (a - b) * (a - b)).sum();
    // The samples are the first ones of the picture with more: of independent samples, the difference of both has this
    // part of the variance.
    let part = 1.0 - f64::from(SAMPLES) / f64::from(MANY_SAMPLES);
    let variance = squares / pixels * f64::from(SAMPLES) / part;
    Ok((many.iter().sum::<f64>() / pixels, variance))
}

/// Counts of a path of the program in each scene; the scenes share their kernel.
fn our_counts(
    pipelines: &Arc<Pipelines>,
    scenes: &[Scene],
    size_px: [u32; 2],
) -> Result<Vec<Counts>, Failure> {
    let pixels = size_px.into_iter().map(f64::from).product();
    let runners: Vec<_> =
        scenes.iter().map(|scene| ours::PassRunner::new(pipelines, scene, size_px)).collect();
    let first = runners.first().ok_or("there is no scene")?;
    let passes = ours::counting_passes(pipelines, first)?;
    runners.iter().map(|runner| Ok(runner.count_paths(&passes)?.per(pixels))).collect()
}

impl Row {
    /// Prints the view's table for people, and its `ratio` line for scripts.
    fn print(&self) {
        let Self { name, ours, literal, bounces, growth, .. } = self;
        println!("\n{name}: light paths of {BOUNCES} bounces");
        println!("  {:<22}{:>12}{:>12}", "", "literal", "ours");
        let row = |label: &str, value: fn(&Side) -> f64| {
            let literal = literal.map_or("–".to_owned(), |side| format!("{:.4}", value(&side)));
            println!("  {label:<22}{literal:>12}{:>12.4}", value(ours));
        };
        row("µs a path", |side| side.path_us);
        row("million paths a second", |side| 1.0 / side.path_us);
        row("estimates a path", |side| side.counts.estimates);
        row("steps a path", |side| side.counts.steps);
        row("variance a sample", |side| side.variance);
        row("mean radiance", |side| side.radiance);
        let times: Vec<_> =
            bounces.iter().map(|Bounce { last, us, .. }| format!("{us:.2} to {last}")).collect();
        println!("  µs a bounce: {}", times.join(", "));
        let estimates: Vec<_> = bounces
            .iter()
            .map(|Bounce { last, estimates, .. }| format!("{estimates:.2} to {last}"))
            .collect();
        println!("  estimates a bounce: {}", estimates.join(", "));
        if !self.agrees {
            println!("  FAIL: the sides' mean radiance differs");
        }
        if let Some(ratio) = self.ratio {
            println!("ratio {name} {ratio:.2}");
        }
        println!("bounce {name} {growth:.2}");
    }
}
