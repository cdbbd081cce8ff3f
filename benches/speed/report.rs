//! What was measured: for people as it comes, as JSON at the end.

use serde::Serialize;

use super::{
    compare::Comparison,
    counts::Counts,
    deep, descent, feel,
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
    pub feel: Option<feel::Results>,
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
