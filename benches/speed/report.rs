//! What was measured: for people as it comes, as JSON at the end.

use serde::Serialize;

use super::{
    counts::Counts,
    deep, descent,
    errors::Errors,
    feel,
    limits::{Measure, Measured},
    powers, scaling, start,
};

/// Everything that one run measured.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Report {
    /// The adapter's name and backend.
    pub adapter: String,
    /// The views, in the order in which they were measured.
    pub views: Vec<Comparison>,
    /// What an orbit step costs, power by power.
    pub powers: Option<powers::Table>,
    /// What depth costs.
    pub deep: Vec<deep::Row>,
    /// What every half decade on the way down costs.
    pub descent: Vec<descent::Row>,
    /// How time grows with what is asked for.
    pub scaling: Vec<scaling::Row>,
    /// How long it takes until there is a picture.
    pub start: Option<start::Starts>,
    /// The recorded session, where it was asked for.
    pub feel: Option<feel::Report>,
}

impl Report {
    /// All that has a limit.
    pub fn measured(&self) -> Vec<Measured> {
        let mut all = Vec::new();
        let mut add = |measure, view: &str, value| {
            all.push(Measured { measure, view: view.to_owned(), value });
        };
        let mut add_counts = |view: &str, counts: Counts, times: &[(Measure, f64)]| {
            add(Measure::Estimates, view, counts.estimates);
            add(Measure::Steps, view, counts.steps);
            for &(measure, value) in times {
                add(measure, view, value);
            }
        };
        for view in &self.views {
            add_counts(view.view, view.ours.counts, &[(Measure::Ratio, view.ratio)]);
        }
        for row in &self.deep {
            add_counts(row.name, row.counts, &[(Measure::Cost, row.cost)]);
        }
        for row in &self.descent {
            add_counts(&row.name, row.counts, &[(Measure::Cost, row.cost)]);
        }
        if let Some(worst) = descent::worst(&self.descent) {
            add(Measure::Cost, &format!("{}-worst", descent::NAME), worst);
        }
        all
    }

    /// True where every picture is good enough for its ratio to count, and every power costs no
    /// more than its products.
    pub fn is_good(&self) -> bool {
        self.views.iter().all(|view| view.complaints.is_empty())
            && self.powers.as_ref().is_none_or(powers::Table::is_good)
    }
}

/// One view by both sides.
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
    /// How many lights there are.
    pub lights: usize,
    /// Part of the pixels that hit the set, and of the bits that are set, by the reference.
    pub hit: f64,
    /// As above.
    pub lit: f64,
    /// The thesis's algorithm.
    pub literal: Side,
    /// The program.
    pub ours: Side,
    /// Literal time over ours.
    pub ratio: f64,
    /// The adapter's multiply-adds, measured in the same rounds, GFLOP/s.
    pub peak_gflops: f64,
    /// The program's share of that, 0 to 1: orbit steps as the mathematics needs them, over all of
    /// its time; none for a power that isn't whole.
    pub peak_share: Option<f64>,
    /// What keeps the ratio from counting; empty where it counts.
    pub complaints: Vec<String>,
    /// What the program's passes take for the first sample of a pixel, and what a later one takes.
    pub our_counts: Vec<(&'static str, Counts)>,
    /// Times of the program's passes over one sample of each pixel, milliseconds.
    pub passes_ms: Vec<(&'static str, f64)>,
}

/// One side of a comparison.
#[derive(Clone, Debug, Serialize)]
pub struct Side {
    /// Median time, milliseconds.
    pub ms: f64,
    /// Each round's.
    pub rounds_ms: Vec<f64>,
    /// The part of the machine's processors that drawing kept busy, 0 to 1; 0 where it does not tell.
    pub busy: f64,
    /// Most iterations of an orbit.
    pub iterations: u32,
    /// One sample's errors.
    pub errors: Errors,
    /// What a sample of a pixel takes in the mean.
    pub counts: Counts,
}

impl Comparison {
    /// Tells it to people, and its ratio to scripts.
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
