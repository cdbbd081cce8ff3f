//! What the session showed, part by part: as text and as plain data.

use serde::Serialize;

use super::{
    super::statistics::nearest_rank,
    difference::Difference,
    edits::Costs,
    quality::Quality,
    replay::{Frame, Replay},
    session::{PARTS, SIZE_PX},
};

/// What a moving frame may take, in budgets, to count as in time.
const IN_TIME: f64 = 1.25;

/// All that the replay found.
#[derive(Clone, Debug, Serialize)]
pub struct Results {
    /// Width and height, pixels.
    pub size_px: [u32; 2],
    /// A twentieth of a full frame, milliseconds.
    pub budget_ms: f64,
    /// What edits cost at full resolution.
    pub costs: Costs,
    /// The parts of the session, then all of it.
    pub parts: Vec<Feel>,
    /// Part of the machine's processors that other programs had during the replay, 0 to 1, where
    /// the machine tells.
    pub others: Option<f64>,
}

/// How a part of the session felt.
#[derive(Clone, Debug, Serialize)]
pub struct Feel {
    /// The part's name.
    pub name: &'static str,
    /// Its moving pictures.
    pub frames: usize,
    /// Quantiles of their times, in budgets.
    pub p50: f64,
    /// As above.
    pub p95: f64,
    /// As above.
    pub max: f64,
    /// Part of them that took no more than 1.25 budgets.
    pub in_time: f64,
    /// From a hand's move to its picture, 95 %, in budgets.
    pub lag_p95: f64,
    /// One pixel of so many was computed, in the median.
    pub pixels_per_sample: f64,
    /// From the release to the picture of all pixels, in a full frame's own time.
    pub release: Option<f64>,
    /// Difference against the full frame: of what was shown, and of nearest-pixel filling.
    pub errors: Option<[Difference; 2]>,
}

impl Feel {
    fn new(name: &'static str, frames: &[&Frame], budget_ms: f64, qualities: &[&Quality]) -> Self {
        let in_budgets = |secs: fn(&Frame) -> f64| -> Vec<f64> {
            frames.iter().map(|frame| secs(frame) * 1e3 / budget_ms).collect()
        };
        let mut times = in_budgets(|frame| frame.secs);
        let in_time = times.iter().filter(|&&time| time <= IN_TIME).count();
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
    /// Sums up what was measured.
    pub fn new(
        budget_ms: f64,
        costs: Costs,
        replay: &Replay,
        releases: &[Option<f64>],
        qualities: &[Quality],
    ) -> Self {
        let feel = |name, part: Option<usize>| {
            let is_meant = |of: usize| part.is_none_or(|part| part == of);
            let frames: Vec<_> = replay.frames.iter().filter(|it| is_meant(it.part)).collect();
            let qualities: Vec<_> = qualities.iter().filter(|it| is_meant(it.part)).collect();
            Feel::new(name, &frames, budget_ms, &qualities)
        };
        let mut parts: Vec<_> = PARTS
            .iter()
            .enumerate()
            .map(|(part, of)| {
                let release = releases.get(part).copied().flatten();
                Feel { release, ..feel(of.name, Some(part)) }
            })
            .collect();
        parts.push(feel("all", None));
        Self { size_px: SIZE_PX, budget_ms, costs, parts, others: replay.others }
    }

    /// Tells it to people, and its figures to scripts.
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
            let Feel { name, frames, p50, p95, max, in_time, lag_p95, .. } = part;
            let release = part.release.map_or(String::new(), |release| format!("{release:.2}"));
            println!(
                "  {name:15} {frames:6}  {p50:<5.2}  {p95:<5.2}  {max:<5.2}  {:5.1} %  {lag_p95:<7.2}  {:<12}  {release}",
                100.0 * in_time,
                part.pixels_per_sample
            );
        }
        println!("  errors (nearest)  steps of 1/255   Oklab x 100      1 - SSIM");
        for Feel { name, errors, .. } in &self.parts {
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
        for Feel { name, in_time, max, release, .. } in &self.parts {
            let release = release.map_or(String::new(), |release| format!(" release {release:.2}"));
            println!("feel {name} in-time {in_time:.3} worst {max:.2}{release}");
        }
    }
}
