//! The results of a whole run, as JSON and as measurements with limits.
//!
//! In: the results of each view and table. Out: what the limits check.

use serde::Serialize;

use super::{
    compare::Comparison,
    counts::Counts,
    deep, descent, feel, formulas,
    limits::{Measure, Measured},
    mandelbulber, paths, pieces, powers, scaling, start, step_costs,
};

/// All results of one run.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Report {
    /// The adapter's name and backend.
    pub adapter: String,
    /// The comparisons, in the order of measurement.
    pub views: Vec<Comparison>,
    /// The cost of an orbit step for each power.
    pub powers: Option<powers::Table>,
    /// The cost of depth.
    pub deep: Vec<deep::Row>,
    /// The cost of depth in half decades.
    pub descent: Vec<descent::Row>,
    /// Light paths.
    pub paths: Vec<paths::Row>,
    /// Light paths beside Mandelbulber's.
    pub mandelbulber: Vec<mandelbulber::Row>,
    /// Growth of a picture's time.
    pub scaling: Vec<scaling::Row>,
    /// Start-up times.
    pub start: Option<start::Starts>,
    /// The cost of orbit steps of formulas' texts.
    pub step_costs: Vec<step_costs::Row>,
    /// Pictures of all formulas.
    pub formulas: Vec<formulas::Row>,
    /// The replayed session.
    pub feel: Option<feel::Results>,
    /// How long pieces of work keep the GPU.
    pub pieces: Vec<pieces::Row>,
}

impl Report {
    /// All measurements that can have a limit.
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
        for row in &self.paths {
            add(Measure::Estimates, row.name, row.ours.counts.estimates);
            add(Measure::Steps, row.name, row.ours.counts.steps);
            if let Some(ratio) = row.ratio {
                add(Measure::Ratio, row.name, ratio);
            }
            add(Measure::Bounce, row.name, row.growth);
        }
        for row in &self.mandelbulber {
            add(Measure::Ratio, row.name, row.ratio);
        }
        for row in &self.step_costs {
            add(Measure::TextEstimate, row.formula, row.estimate);
            if let Some(gradient) = row.gradient {
                add(Measure::TextGradient, row.formula, gradient);
            }
        }
        for row in &self.formulas {
            let bulb_ms = self.formulas.first().map_or(f64::NAN, |bulb| bulb.compilation_ms);
            add(Measure::Compilation, row.formula, row.compilation_ms / bulb_ms);
            if let Some(part) = row.overstepped {
                add(Measure::Overstepped, row.formula, 100.0 * part);
            }
        }
        if let Some(summary) = pieces::summary(&self.pieces) {
            add(Measure::OverTwoBudgets, pieces::NAME, summary.over);
            add(Measure::LongestPiece, pieces::NAME, summary.longest_ms);
        }
        all
    }

    /// True if every ratio counts, every power is within the fit, and light paths agree.
    pub fn is_good(&self) -> bool {
        self.views.iter().all(|view| view.complaints.is_empty())
            && self.paths.iter().all(|row| row.agrees)
            && self.mandelbulber.iter().all(|row| row.agrees)
            && self.powers.as_ref().is_none_or(powers::Table::is_good)
    }
}
