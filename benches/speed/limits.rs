//! The limits of `limits.txt`, and the check of a run against them.
//!
//! In: the file's text and a run's measurements. Out: broken limits, or a text with tighter
//! limits. Each line is a measure, a view and a number, as the benchmark prints them. `ratio`
//! has a floor; the other measures have a ceiling.

use std::{collections::BTreeMap, fmt};

/// A kind of measurement that has limits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Measure {
    /// The literal kernel's time divided by the program's.
    Ratio,
    /// The time of an estimate divided by that of a plain view.
    Cost,
    /// Distance estimates per pixel.
    Estimates,
    /// Orbit steps per pixel.
    Steps,
    /// The time of a text's estimate divided by its baseline's.
    TextEstimate,
    /// The time of a text's gradient divided by its baseline's.
    TextGradient,
    /// The compilation of a formula's passes divided by that of the Mandelbulb's.
    Compilation,
    /// The largest number of estimates of a path's later bounce divided by that of the first.
    Bounce,
    /// Percentage of pixels whose rays pass the surface.
    Overstepped,
    /// Percentage of pieces of work that take over two motion budgets.
    OverTwoBudgets,
    /// The time of the longest piece of work, milliseconds.
    LongestPiece,
}

impl Measure {
    const ALL: [Self; 11] = [
        Self::Ratio,
        Self::Cost,
        Self::Estimates,
        Self::Steps,
        Self::TextEstimate,
        Self::TextGradient,
        Self::Compilation,
        Self::Bounce,
        Self::Overstepped,
        Self::OverTwoBudgets,
        Self::LongestPiece,
    ];

    fn name(self) -> &'static str {
        match self {
            Self::Ratio => "ratio",
            Self::Cost => "cost",
            Self::Estimates => "estimates",
            Self::Steps => "steps",
            Self::TextEstimate => "text-estimate",
            Self::TextGradient => "text-gradient",
            Self::Compilation => "compilation",
            Self::Bounce => "bounce",
            Self::Overstepped => "overstepped",
            Self::OverTwoBudgets => "over-two-budgets",
            Self::LongestPiece => "longest-piece",
        }
    }

    /// The limit for a measured value; none if the limit is chosen, whatever was measured.
    ///
    /// Counts hardly depend on the machine: 1 % of margin. Machines of one kind differ by a
    /// factor of two in `ratio`; both sides of `cost` run the same kernels, so `cost`
    /// differs by less.
    fn limit(self, value: f64) -> Option<f64> {
        Some(match self {
            Self::Ratio => value / 2.0,
            Self::Cost => value * 1.5,
            // Both sides run on one machine in turn.
            Self::TextEstimate | Self::TextGradient | Self::Compilation => value * 1.3,
            Self::Overstepped => value + 0.1,
            Self::OverTwoBudgets | Self::LongestPiece => return None,
            Self::Estimates | Self::Steps | Self::Bounce => value * 1.01,
        })
    }

    /// True if a value is within a limit.
    fn is_within(self, value: f64, limit: f64) -> bool {
        if self == Self::Ratio { value >= limit } else { value <= limit }
    }
}

impl fmt::Display for Measure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// A measurement of a view.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    /// What was measured.
    pub measure: Measure,
    /// The view's name.
    pub view: String,
    /// The measured value.
    pub value: f64,
}

/// Limits by measure and view.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Limits(BTreeMap<(Measure, String), f64>);

impl Limits {
    /// Parses a file of limits; `#` starts a comment.
    ///
    /// # Errors
    /// The first line that is not a limit.
    pub fn parse(text: &str) -> Result<Self, String> {
        let mut limits = BTreeMap::new();
        for (number, line) in (1..).zip(text.lines()) {
            let line = line.split('#').next().unwrap_or_default();
            let words: Vec<_> = line.split_whitespace().collect();
            let [measure, view, limit] = words[..] else {
                if words.is_empty() {
                    continue;
                }
                return Err(format!("line {number}: write a measure, a view and a number"));
            };
            let measure = Measure::ALL.into_iter().find(|known| known.name() == measure);
            let limit = limit.parse::<f64>().ok().filter(|limit| limit.is_finite());
            let (Some(measure), Some(limit)) = (measure, limit) else {
                return Err(format!("line {number}: {line:?} names no measure or no number"));
            };
            if limits.insert((measure, view.to_owned()), limit).is_some() {
                return Err(format!("line {number}: {measure} {view} has a limit already"));
            }
        }
        Ok(Self(limits))
    }

    /// The number of measurements without a limit.
    pub fn missing(&self, run: &[Measured]) -> usize {
        let has_limit =
            |measured: &&Measured| self.0.contains_key(&(measured.measure, measured.view.clone()));
        run.iter().filter(|measured| !has_limit(measured)).count()
    }

    /// A message for each measurement that breaks its limit.
    pub fn complaints(&self, run: &[Measured]) -> Vec<String> {
        let complaint = |Measured { measure, view, value }: &Measured| {
            let limit = self.0.get(&(*measure, view.clone()))?;
            // Limits have three decimals: a count that is its limit holds it.
            let rounded = (1e3 * value).round() / 1e3;
            let falls = !measure.is_within(rounded, *limit);
            falls.then(|| format!("{measure} {view} {value:.3} breaks its limit of {limit:.3}"))
        };
        run.iter().filter_map(complaint).collect()
    }

    /// `text` with new limits for measurements without one, and tighter limits where `run` allows.
    ///
    /// Comments stay.
    ///
    /// # Errors
    /// As [`Self::parse`].
    pub fn tightened(text: &str, run: &[Measured]) -> Result<String, String> {
        let limits = Self::parse(text)?;
        let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
        for Measured { measure, view, value } in run {
            let Some(limit) = measure.limit(*value) else { continue };
            let words = format!("{measure} {view} ");
            match limits.0.get(&(*measure, view.clone())) {
                None => lines.push(format!("{words}{limit:.3}")),
                // The new limit is tighter than the old one.
                Some(old) if measure.is_within(limit, *old) => {
                    let is_of = |line: &&mut String| {
                        line.split_whitespace().take(2).eq(words.split_whitespace())
                    };
                    for line in lines.iter_mut().filter(is_of) {
                        let comment = line.find('#').map_or("", |at| &line[at..]);
                        *line = format!("{words}{limit:.3} {comment}").trim_end().to_owned();
                    }
                }
                Some(_) => (),
            }
        }
        Ok(lines.join("\n") + "\n")
    }
}
