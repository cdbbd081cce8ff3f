//! The cost of depth in half decades: several places, seen from 1e-1 down to 1e-27.
//!
//! In: the program's pipelines. Out: a row per place and distance. A view's time is the sum of
//! its passes over single workgroups that are spread over the picture; counting kernels count
//! the estimates of the same workgroups. Each round also draws a reference: the same place in
//! plain f32.

mod places;

use std::{
    collections::{HashMap, hash_map::Entry},
    sync::Arc,
};

use mandelight::{
    formula::{Kernel, mandelbulb::variant::Variant},
    render::{Pipelines, Region, pipeline_set, pipelines::FramePipelines},
    scene::Scene,
};
use serde::Serialize;

use super::{
    counts::Counts,
    failure::Failure,
    ours::{PassRunner, counting_passes},
    statistics::median,
    views::SIZE_PX,
};

pub use places::{PLACES, Place};

/// The table's name for `--views`.
pub const NAME: &str = "descent";

/// One of this many workgroups is drawn at the default size; other sizes draw as many pixels.
const WORKGROUP_STRIDE: u32 = 16;

/// Distance from the eye to the surface in the reference view, scene units.
pub const REFERENCE: f64 = 1e-2;
/// The scale of the view that [`Row::picture`] divides by.
const PICTURE_REFERENCE: &str = "2e-3";
/// The deepest view is at 10 to the power of minus this.
const DEEPEST: i32 = 27;

/// One view of a place.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// The view's name in the output: `descent-<place>-<power>-<scale>`.
    pub name: String,
    /// The place and the power.
    pub place: String,
    /// The distance as part of a name, such as `3e-5`.
    pub scale: String,
    /// The key of the pipelines that draw the view.
    pub key: String,
    /// Time of a pixel, nanoseconds.
    pub pixel_ns: f64,
    /// Counts per pixel.
    pub counts: Counts,
    /// Time of a distance estimate, nanoseconds.
    pub estimate_ns: f64,
    /// Time of an estimate divided by that of the reference in the same rounds.
    pub cost: f64,
    /// Time of a picture divided by that of the view at [`PICTURE_REFERENCE`].
    pub picture: f64,
    /// Changes from the view half a decade above, as factors of at least 1.
    ///
    /// The first is of the time of an estimate, the second of the estimates per pixel; 1 in
    /// the first view.
    pub changes: [f64; 2],
}

/// Names and distances of all views of a place, scene units.
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

/// The settings of a run, and the counting pipelines by key.
struct Bench<'a> {
    pipelines: &'a Arc<Pipelines>,
    counting: HashMap<Kernel, FramePipelines<'a>>,
    size_px: [u32; 2],
    workgroup_stride: u32,
    rounds: u32,
}

impl<'a> Bench<'a> {
    /// Counts the drawn pixels of a view.
    fn count(&mut self, runner: &PassRunner<'_>) -> Result<Counts, Failure> {
        let key = runner.kernel();
        if let Entry::Vacant(entry) = self.counting.entry(key) {
            entry.insert(counting_passes(self.pipelines, runner)?);
        }
        let mut counts = Counts::default();
        for (_, counted) in runner.count(&self.counting[&key])? {
            counts += counted;
        }
        Ok(counts)
    }

    /// Draws a view and `reference` in turn, `rounds` times each.
    ///
    /// Returns nanoseconds per pixel, the same divided by the reference's, and counts per pixel.
    fn measure(
        &mut self,
        scene: &Scene,
        reference: &PassRunner<'_>,
    ) -> Result<(Kernel, [f64; 2], Counts), Failure> {
        let (mut times, mut counts, mut pixels) = ([0.0; 2], Counts::default(), 0.0);
        let mut kernels = Vec::new();
        for region in regions(self.size_px) {
            let pipelines = self.pipelines;
            let runner = prepared(pipelines, scene, region, self.workgroup_stride);
            kernels.push(runner.kernel());
            let ns = |runner: &PassRunner<'_>| -> f64 {
                runner.draw_ms().into_iter().map(|(_, ms)| ms * 1e6).sum()
            };
            let rounds: Vec<_> = (0..self.rounds)
                .map(|_| {
                    let reference_ns = ns(reference) / reference.pixels();
                    let view_ns = ns(&runner);
                    [view_ns, view_ns / reference_ns]
                })
                .collect();
            for (sum, k) in times.iter_mut().zip(0..) {
                *sum += median(&rounds.iter().map(|round| round[k]).collect::<Vec<_>>());
            }
            pixels += runner.pixels();
            counts += self.count(&runner)?;
        }
        // A picture has at least one part.
        let kernel = kernels.pop().expect("a region");
        Ok((kernel, times.map(|time| time / pixels), counts.per(pixels)))
    }

    /// Measures all views of a place from the largest distance to the smallest.
    fn measure_place(&mut self, place: &Place) -> Result<Vec<Row>, Failure> {
        let mut rows: Vec<Row> = Vec::new();
        let whole = regions(self.size_px)[0];
        let reference =
            prepared(self.pipelines, &place.scene(REFERENCE)?, whole, self.workgroup_stride);
        let reference_estimates = self.count(&reference)?.estimates / reference.pixels();
        for (scale, distance) in distances() {
            let (kernel, [pixel_ns, times], counts) =
                self.measure(&place.scene(distance)?, &reference)?;
            rows.push(Row {
                name: format!("{NAME}-{}-{}-{scale}", place.name, place.set()),
                place: format!("{} {}", place.name, place.set()),
                scale,
                key: Variant::from_number(kernel.variant).to_string(),
                pixel_ns,
                counts,
                estimate_ns: pixel_ns / counts.estimates,
                cost: times * reference_estimates / counts.estimates,
                picture: times,
                changes: [1.0; 2],
            });
        }
        fill_comparisons(&mut rows);
        // This view serves as a divisor only.
        rows.retain(|row| row.scale != PICTURE_REFERENCE);
        Ok(rows)
    }
}

/// A part of a view, with compiled pipelines and one warm-up draw.
fn prepared<'a>(
    pipelines: &'a Pipelines,
    scene: &Scene,
    region: Region,
    workgroup_stride: u32,
) -> PassRunner<'a> {
    let runner = PassRunner::with_stride(pipelines, scene, region, workgroup_stride);
    pipelines.prepare_together(&pipeline_set::specialized(runner.inputs()));
    runner.draw_ms();
    runner
}

/// Fills in [`Row::picture`] and [`Row::changes`].
fn fill_comparisons(rows: &mut [Row]) {
    let picture =
        rows.iter().find(|row| row.scale == PICTURE_REFERENCE).map_or(1.0, |row| row.picture);
    let mut above: Option<(f64, f64)> = None;
    for row in rows {
        row.picture /= picture;
        if row.scale == PICTURE_REFERENCE {
            continue;
        }
        let change = |here: f64, above: f64| f64::max(here / above, above / here);
        if let Some((ns, estimates)) = above {
            row.changes = [change(row.cost, ns), change(row.counts.estimates, estimates)];
        }
        above = Some((row.cost, row.counts.estimates));
    }
}

/// The whole picture as one region, or its quarters where it is too large for a view.
fn regions(size_px: [u32; 2]) -> Vec<Region> {
    let whole = Region::whole(size_px);
    if whole.fits() {
        return vec![whole];
    }
    let half = size_px.map(|side| side / 2);
    let corner = |i: u32| [(i & 1) * half[0], (i >> 1) * half[1]];
    (0..4).map(|i| Region { origin_px: corner(i), size_px: half, ..whole }).collect()
}

/// Measures every place, `rounds` times a view.
///
/// # Errors
/// If the device is lost, or a kernel can't be counted.
pub fn measure(
    pipelines: &Arc<Pipelines>,
    rounds: u32,
    size_px: Option<[u32; 2]>,
    only: &[String],
) -> Result<Vec<Row>, Failure> {
    let size_px = size_px.unwrap_or(SIZE_PX);
    let pixels = |[width, height]: [u32; 2]| u64::from(width) * u64::from(height);
    let workgroup_stride = u64::from(WORKGROUP_STRIDE) * pixels(size_px) / pixels(SIZE_PX);
    let workgroup_stride = u32::try_from(workgroup_stride)?.max(1);
    let mut bench =
        Bench { pipelines, counting: HashMap::new(), size_px, workgroup_stride, rounds };
    let mut rows = Vec::new();
    for place in PLACES {
        let name = format!("{NAME}-{}-{}", place.name, place.set());
        if !only.is_empty() && !only.iter().any(|part| name.contains(part)) {
            continue;
        }
        let of_place = bench.measure_place(place)?;
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

/// Prints the largest value of each column with its view.
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
