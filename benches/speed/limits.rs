//! What measurements must not fall behind: `limits.txt`, and how a run is held to it.
//!
//! A limit is a line that begins as the benchmark's own: a measure, a view, a number. `ratio` has a
//! floor, all others a ceiling. Counts hardly depend on the machine, so their limits leave a hundredth to
//! spare; times do.

use std::{collections::BTreeMap, fmt};

/// What is measured of a view.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Measure {
    /// The literal kernel's time over the program's.
    Ratio,
    /// The time of an estimate over that of a plain view.
    Cost,
    /// Distance estimates a pixel.
    Estimates,
    /// Orbit steps a pixel.
    Steps,
}

impl Measure {
    const ALL: [Self; 4] = [Self::Ratio, Self::Cost, Self::Estimates, Self::Steps];

    fn name(self) -> &'static str {
        match self {
            Self::Ratio => "ratio",
            Self::Cost => "cost",
            Self::Estimates => "estimates",
            Self::Steps => "steps",
        }
    }

    /// The limit that a measured value sets. Machines of one kind differ by a factor of two, and the
    /// program's share of that is larger than the literal kernel's; what both sides of a cost take
    /// differs by less.
    fn limit(self, value: f64) -> f64 {
        match self {
            Self::Ratio => value / 2.0,
            Self::Cost => value * 1.5,
            Self::Estimates | Self::Steps => value * 1.01,
        }
    }

    /// Whether a value keeps to a limit.
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

/// The limits, by measure and view.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Limits(BTreeMap<(Measure, String), f64>);

impl Limits {
    /// Reads a file of limits; `#` begins a comment.
    ///
    /// # Errors
    /// The first line that is no limit.
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

    /// How much of a run has no limit yet.
    pub fn missing(&self, run: &[Measured]) -> usize {
        let has_limit =
            |measured: &&Measured| self.0.contains_key(&(measured.measure, measured.view.clone()));
        run.iter().filter(|measured| !has_limit(measured)).count()
    }

    /// What of a run breaks a limit.
    pub fn complaints(&self, run: &[Measured]) -> Vec<String> {
        let complaint = |Measured { measure, view, value }: &Measured| {
            let limit = self.0.get(&(*measure, view.clone()))?;
            let falls = !measure.is_within(*value, *limit);
            falls.then(|| format!("{measure} {view} {value:.3} breaks its limit of {limit:.3}"))
        };
        run.iter().filter_map(complaint).collect()
    }

    /// `text` with limits for what had none, and nearer ones where a run allows for them. Comments
    /// stay.
    ///
    /// # Errors
    /// As [`Self::parse`].
    pub fn tightened(text: &str, run: &[Measured]) -> Result<String, String> {
        let limits = Self::parse(text)?;
        let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
        for Measured { measure, view, value } in run {
            let limit = measure.limit(*value);
            let words = format!("{measure} {view} ");
            match limits.0.get(&(*measure, view.clone())) {
                None => lines.push(format!("{words}{limit:.3}")),
                // It keeps to the old one with room to spare.
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
