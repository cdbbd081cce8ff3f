//! The way down: views of several places, from the whole set to the last depth, in half decades.
//!
//! A view's time is that of its passes over a part of its pixels, single workgroups spread over the whole
//! picture. Counting kernels find the estimates of the same pixels. Each view is drawn in turn with a
//! reference: a view of the same place in plain f32.

mod places;

use std::{collections::HashMap, sync::Arc};

use mandelight::{
    render::{
        Pipelines, Region,
        pipelines::{Passes, PipelineKey, PipelineVariant},
        uniforms::FrameUniforms,
    },
    scene::Scene,
};
use serde::Serialize;

use super::{
    counts::Counts,
    failure::Failure,
    ours::{Split, counting_passes},
    statistics::median,
    views::SIZE_PX,
};

pub use places::{PLACES, Place};

/// What `--views` calls the table.
pub const NAME: &str = "descent";

/// One workgroup in so many is drawn at the default size, and at others as many pixels as there.
const SPREAD: u32 = 16;

/// How far away the reference is, scene units.
pub const REFERENCE: f64 = 1e-2;
/// The view whose time of a picture others are compared with.
const PICTURE_OF: &str = "2e-3";
/// The deepest view: 1e-27.
const DEEPEST: i32 = 27;

/// One view of a place.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// What scripts call it: `descent-<place>-<power>-<scale>`.
    pub name: String,
    /// The place and the power.
    pub place: String,
    /// The distance, as names have it.
    pub scale: String,
    /// The pipelines that draw it.
    pub key: String,
    /// Nanoseconds a pixel.
    pub pixel_ns: f64,
    /// What a pixel takes.
    pub counts: Counts,
    /// Nanoseconds a distance estimate.
    pub estimate_ns: f64,
    /// That over the reference's.
    pub cost: f64,
    /// The time of a picture over the plain view's at [`PICTURE_OF`].
    pub picture: f64,
    /// Times of an estimate and estimates a pixel over those half a decade above, or the reverse
    /// where that is larger; 1 in the first view.
    pub changes: [f64; 2],
}

/// The distances of a descent, scene units, with their names.
pub fn distances() -> Vec<(String, f64)> {
    let mut distances = vec![("2e-3".to_owned(), 2e-3)];
    for half in 2..=2 * DEEPEST {
        let whole = (half + 1) / 2;
        distances.push(if half % 2 == 0 {
            (format!("1e-{whole}"), 10_f64.powi(-whole))
        } else {
            (format!("3e-{whole}"), 10_f64.sqrt() * 10_f64.powi(-whole))
        });
    }
    distances
}

/// The kernels that draw views, and the copies of them that count.
struct Bench<'a> {
    pipelines: &'a Arc<Pipelines>,
    counting: HashMap<PipelineKey, Passes>,
    size_px: [u32; 2],
    spread: u32,
    rounds: u32,
}

impl Bench<'_> {
    /// What the pixels of a part of a view take.
    fn count(&mut self, split: &Split<'_>) -> Result<Counts, Failure> {
        let key = PipelineKey::of(split.frame());
        if !self.counting.contains_key(&key) {
            self.counting.insert(key, counting_passes(self.pipelines, split)?);
        }
        let mut counts = Counts::default();
        for (_, counted) in split.count(&self.counting[&key])? {
            counts += counted;
        }
        Ok(counts)
    }

    /// Draws a view so many rounds, each in turn with `reference`: nanoseconds a pixel, how many
    /// times those of the reference, and what a pixel takes.
    fn measure(
        &mut self,
        scene: &Scene,
        reference: &Split<'_>,
    ) -> Result<(PipelineKey, [f64; 2], Counts), Failure> {
        let (mut times, mut counts, mut pixels) = ([0.0; 2], Counts::default(), 0.0);
        let mut key = PipelineKey::of(&FrameUniforms::new(scene, Region::whole(self.size_px)));
        for region in regions(self.size_px) {
            let pipelines = self.pipelines;
            let split = prepared(pipelines, scene, region, self.spread);
            key = PipelineKey::of(split.frame());
            let ns = |split: &Split<'_>| -> f64 {
                split.draw_ms().into_iter().map(|(_, ms)| ms * 1e6).sum()
            };
            let rounds: Vec<_> = (0..self.rounds)
                .map(|_| {
                    let beside = ns(reference) / reference.pixels();
                    let here = ns(&split);
                    [here, here / beside]
                })
                .collect();
            for (sum, k) in times.iter_mut().zip(0..) {
                *sum += median(&rounds.iter().map(|round| round[k]).collect::<Vec<_>>());
            }
            pixels += split.pixels();
            counts += self.count(&split)?;
        }
        Ok((key, times.map(|time| time / pixels), counts.per(pixels)))
    }

    /// Measures all views of a place, from the top down.
    fn descend(&mut self, place: &Place) -> Result<Vec<Row>, Failure> {
        let mut rows: Vec<Row> = Vec::new();
        let whole = regions(self.size_px)[0];
        let reference = prepared(self.pipelines, &place.scene(REFERENCE)?, whole, self.spread);
        let reference_estimates = self.count(&reference)?.estimates / reference.pixels();
        for (scale, distance) in distances() {
            let (key, [pixel_ns, times], counts) =
                self.measure(&place.scene(distance)?, &reference)?;
            rows.push(Row {
                name: format!("{NAME}-{}-{}-{scale}", place.name, place.set()),
                place: format!("{} {}", place.name, place.set()),
                scale,
                key: key.to_string(),
                pixel_ns,
                counts,
                estimate_ns: pixel_ns / counts.estimates,
                cost: times * reference_estimates / counts.estimates,
                picture: times,
                changes: [1.0; 2],
            });
        }
        compare(&mut rows);
        // It is compared with, but no step of the way.
        rows.retain(|row| row.scale != PICTURE_OF);
        Ok(rows)
    }
}

/// A part of a view, with its pipelines ready and drawn once.
fn prepared<'a>(pipelines: &'a Pipelines, scene: &Scene, region: Region, spread: u32) -> Split<'a> {
    let split = Split::spread(pipelines, scene, region, spread);
    for variant in PipelineVariant::special(split.frame()) {
        pipelines.prepare(variant);
    }
    split.draw_ms();
    split
}

/// Fills in what is seen beside other rows.
fn compare(rows: &mut [Row]) {
    let picture = rows.iter().find(|row| row.scale == PICTURE_OF).map_or(1.0, |row| row.picture);
    let mut above: Option<(f64, f64)> = None;
    for row in rows {
        row.picture /= picture;
        if row.scale == PICTURE_OF {
            continue;
        }
        let change = |here: f64, above: f64| f64::max(here / above, above / here);
        if let Some((ns, estimates)) = above {
            row.changes = [change(row.cost, ns), change(row.counts.estimates, estimates)];
        }
        above = Some((row.cost, row.counts.estimates));
    }
}

/// A picture's regions: all of it, or quarters that a view can draw.
fn regions(size_px: [u32; 2]) -> Vec<Region> {
    let whole = Region::whole(size_px);
    if whole.fits() {
        return vec![whole];
    }
    let half = size_px.map(|side| side / 2);
    let corner = |i: u32| [(i & 1) * half[0], (i >> 1) * half[1]];
    (0..4).map(|i| Region { origin_px: corner(i), size_px: half, ..whole }).collect()
}

/// Measures every place, so many rounds a view.
///
/// # Errors
/// Where the device is lost, or a kernel can't be counted.
pub fn measure(
    pipelines: &Arc<Pipelines>,
    rounds: u32,
    size_px: Option<[u32; 2]>,
    only: &[String],
) -> Result<Vec<Row>, Failure> {
    let size_px = size_px.unwrap_or(SIZE_PX);
    let pixels = |[width, height]: [u32; 2]| u64::from(width) * u64::from(height);
    let spread = u64::from(SPREAD) * pixels(size_px) / pixels(SIZE_PX);
    let spread = u32::try_from(spread)?.max(1);
    let mut bench = Bench { pipelines, counting: HashMap::new(), size_px, spread, rounds };
    let mut rows = Vec::new();
    for place in PLACES {
        let name = format!("{NAME}-{}-{}", place.name, place.set());
        if !only.is_empty() && !only.iter().any(|part| name.contains(part)) {
            continue;
        }
        let of_place = bench.descend(place)?;
        print_place(&of_place, size_px);
        rows.extend(of_place);
    }
    print_worst(&rows);
    Ok(rows)
}

fn print_place(rows: &[Row], size_px: [u32; 2]) {
    let Some(first) = rows.first() else { return };
    println!("\ndescent: {} in {}x{}", first.place, size_px[0], size_px[1]);
    println!(
        "  {:<8}{:>22}{:>10}{:>11}{:>11}{:>9}{:>7}{:>9}{:>9}{:>9}",
        "",
        "pipelines",
        "ns/pixel",
        "estimates",
        "steps each",
        "ns each",
        "cost",
        "picture",
        "ns x",
        "count x"
    );
    for row in rows {
        let Counts { estimates, steps } = row.counts;
        println!(
            "  {:<8}{:>22}{:>10.0}{estimates:>11.1}{:>11.2}{:>9.1}{:>7.2}{:>9.2}{:>9.2}{:>9.2}",
            row.scale,
            row.key,
            row.pixel_ns,
            steps / estimates,
            row.estimate_ns,
            row.cost,
            row.picture,
            row.changes[0],
            row.changes[1],
        );
    }
    for row in rows {
        println!("cost {} {:.2}", row.name, row.cost);
    }
}

/// The largest cost; none without rows.
pub fn worst(rows: &[Row]) -> Option<f64> {
    rows.iter().map(|row| row.cost).reduce(f64::max)
}

/// Tells the worst of all rows, each with where that is.
fn print_worst(rows: &[Row]) {
    let worst = |what: &str, value: fn(&Row) -> f64| {
        if let Some(row) = rows.iter().max_by(|a, b| value(a).total_cmp(&value(b))) {
            println!("  {what}: {:.2} at {}", value(row), row.name);
        }
    };
    println!("\ndescent: the worst of all");
    worst("time of an estimate, over plain", |row| row.cost);
    worst("time of a picture, over plain", |row| row.picture);
    worst("change of the time of an estimate in half a decade", |row| row.changes[0]);
    worst("change of the estimates a pixel in half a decade", |row| row.changes[1]);
    if let Some(cost) = self::worst(rows) {
        println!("cost {NAME}-worst {cost:.2}");
    }
}
