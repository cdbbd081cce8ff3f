//! The results of the session, part by part, as text and as JSON.
//!
//! In: costs of edits, a replay, release times, errors. Out: quantiles, means and printed lines.

use serde::Serialize;

use super::{
    super::statistics::nearest_rank,
    difference::Difference,
    edits::Costs,
    quality::Quality,
    replay::{Frame, Replay},
    session::{PARTS, SIZE_PX},
};

/// Longest time of a moving frame that counts as in time, budgets.
const IN_TIME_BUDGETS: f64 = 1.25;

/// All results of the session.
#[derive(Clone, Debug, Serialize)]
pub struct Results {
    /// Width and height, pixels.
    pub size_px: [u32; 2],
    /// The motion budget: a twentieth of a full frame, milliseconds.
    pub budget_ms: f64,
    /// Costs of edits at full resolution.
    pub costs: Costs,
    /// The results of each part, then of the whole session.
    pub parts: Vec<PartResults>,
    /// Fraction of the processors that other programs used, where the system has figures.
    pub others: Option<f64>,
}

/// The results of one part of the session.
#[derive(Clone, Debug, Serialize)]
pub struct PartResults {
    /// The part's name.
    pub name: &'static str,
    /// The number of moving frames.
    pub frames: usize,
    /// Median of the frame times, budgets.
    pub p50: f64,
    /// 95th percentile of the frame times, budgets.
    pub p95: f64,
    /// Longest frame time, budgets.
    pub max: f64,
    /// Fraction of the frames that took at most 1.25 budgets.
    pub in_time: f64,
    /// 95th percentile of the time from input to picture, budgets.
    pub lag_p95: f64,
    /// Median of the pixels per computed pixel.
    pub pixels_per_sample: f64,
    /// Time from release to the first picture of all pixels, in full frames.
    pub release: Option<f64>,
    /// Mean differences from the full frame: of shown pictures, and of nearest-neighbour filling.
    pub errors: Option<[Difference; 2]>,
}

impl PartResults {
    fn new(name: &'static str, frames: &[&Frame], budget_ms: f64, qualities: &[&Quality]) -> Self {
        let in_budgets = |secs: fn(&Frame) -> f64| -> Vec<f64> {
            frames.iter().map(|frame| secs(frame) * 1e3 / budget_ms).collect()
        };
        let mut times = in_budgets(|frame| frame.secs);
        let in_time = times.iter().filter(|&&time| time <= IN_TIME_BUDGETS).count();
        let mut sparse: Vec<_> =
            frames.iter().map(|frame| f64::from(frame.pixels_per_sample)).collect();
        let mean = |of: fn(&Quality) -> Difference| {
            Difference::mean_of(&qualities.iter().map(|quality| of(quality)).collect::<Vec<_>>())
        };
        Self {
            name,
            frames: frames.len(),
            p50: nearest_rank(&mut times, 0.5),
            p95: nearest_rank(&mut times, 0.95),
            max: nearest_rank(&mut times, 1.0),
            in_time: in_time as f64 / times.len().max(1) as f64,
            lag_p95: nearest_rank(&mut in_budgets(|frame| frame.lag_secs), 0.95),
            pixels_per_sample: nearest_rank(&mut sparse, 0.5),
            release: None,
            errors: (!qualities.is_empty())
                .then(|| [mean(|quality| quality.shown), mean(|quality| quality.nearest)]),
        }
    }
}

impl Results {
    /// Computes the results from the measurements.
    pub fn new(
        budget_ms: f64,
        costs: Costs,
        replay: &Replay,
        releases: &[Option<f64>],
        qualities: &[Quality],
    ) -> Self {
        let part_results = |name, part: Option<usize>| {
            let is_meant = |of: usize| part.is_none_or(|part| part == of);
            let frames: Vec<_> = replay.frames.iter().filter(|it| is_meant(it.part)).collect();
            let qualities: Vec<_> = qualities.iter().filter(|it| is_meant(it.part)).collect();
            PartResults::new(name, &frames, budget_ms, &qualities)
        };
        let mut parts: Vec<_> = PARTS
            .iter()
            .enumerate()
            .map(|(part, of)| {
                let release = releases.get(part).copied().flatten();
                PartResults { release, ..part_results(of.name, Some(part)) }
            })
            .collect();
        parts.push(part_results("all", None));
        Self { size_px: SIZE_PX, budget_ms, costs, parts, others: replay.others }
    }

    /// Prints tables for people and `feel` lines for scripts.
    pub fn print(&self) {
        let [width, height] = self.size_px;
        let Costs { camera_ms, light_ms, intensity_ms, exposure_ms } = self.costs;
        println!("\nfeel: a recorded session; {width}x{height}, 3 lights");
        println!(
            "  a full frame takes {camera_ms:.1} ms, the motion budget is a twentieth: {:.2} ms",
            self.budget_ms
        );
        if let Some(others) = self.others {
            println!("  other programs had {:.0} % of the processors meanwhile", 100.0 * others);
        }
        println!(
            "  in budgets      frames  p50    p95    max    in time  lag p95  one pixel of  release"
        );
        for part in &self.parts {
            let PartResults { name, frames, p50, p95, max, in_time, lag_p95, .. } = part;
            let release = part.release.map_or(String::new(), |release| format!("{release:.2}"));
            println!(
                "  {name:15} {frames:6}  {p50:<5.2}  {p95:<5.2}  {max:<5.2}  {:5.1} %  {lag_p95:<7.2}  {:<12}  {release}",
                100.0 * in_time,
                part.pixels_per_sample
            );
        }
        println!("  errors (nearest)  steps of 1/255   Oklab x 100      1 - SSIM");
        for PartResults { name, errors, .. } in &self.parts {
            if let Some([shown, nearest]) = errors {
                println!(
                    "  {name:15}  {:6.2} ({:6.2})  {:6.2} ({:6.2})  {:.3} ({:.3})",
                    shown.mean,
                    nearest.mean,
                    shown.oklab,
                    nearest.oklab,
                    shown.structure,
                    nearest.structure
                );
            }
        }
        for (edit, ms) in
            [("light", light_ms), ("intensity", intensity_ms), ("exposure", exposure_ms)]
        {
            println!("feel {edit} {:.3}", ms / camera_ms);
        }
        for PartResults { name, in_time, max, release, .. } in &self.parts {
            let release = release.map_or(String::new(), |release| format!(" release {release:.2}"));
            println!("feel {name} in-time {in_time:.3} worst {max:.2}{release}");
        }
    }
}
