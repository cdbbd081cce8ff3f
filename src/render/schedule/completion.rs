//! What has ended, and what it says of costs.
//!
//! In: pieces of work and frames of the interface as they are found finished. Out: measurements. Some
//! browsers run several pieces as one and tell of all when the last one ends, as if the first had
//! taken all of the time and the others none. What a piece costs, and what its pixels, would come out
//! as anything then.

use super::{Cost, InFlight, Schedule, Work};
use crate::render::lattice::WORKGROUP_THREADS;

/// What ends so soon after the one before it, milliseconds, and took so small a part of the time that
/// it was expected to take, is taken to have shared the time of both.
const TOGETHER_MS: f64 = 2.0;
const TOGETHER: f64 = 0.05;

/// One thing that has ended.
#[derive(Clone, Copy)]
struct Completion {
    /// What it was; none for a frame of the interface.
    work: Option<(Work, InFlight)>,
    /// The GPU's time from the end of the one before it, milliseconds.
    busy_ms: f64,
    expected_ms: f64,
}

impl Completion {
    /// Whether its end was told with that of the one before it.
    fn is_told_late(&self) -> bool {
        self.busy_ms < TOGETHER_MS && self.busy_ms < TOGETHER * self.expected_ms
    }
}

impl Schedule {
    /// Pieces of work that [`Self::next`] gave, and frames of the interface (none), have been found
    /// finished, in their order: each with the GPU's time from the end of the one before it.
    pub fn collect(&mut self, ended: &[(Option<Work>, f64)]) {
        let mut all = Vec::new();
        for &(work, busy_ms) in ended {
            let work = match work {
                // What is not known to be in flight tells nothing.
                Some(work) => {
                    let Some(piece) = self.in_flight.pop_front() else { continue };
                    Some((work, piece))
                }
                None => None,
            };
            let expected_ms = work.map_or(self.cost.interface_ms(), |(_, piece)| piece.expected_ms);
            all.push(Completion { work, busy_ms, expected_ms });
        }
        for group in all.chunk_by(|_, next| next.is_told_late()) {
            self.is_told_late |= group.len() > 1;
            learn(&mut self.cost, group);
        }
    }
}

/// Takes note of what ended at once.
fn learn(cost: &mut Cost, group: &[Completion]) {
    let sum = |value: fn(&Completion) -> f64| group.iter().map(value).sum::<f64>();
    let (busy_ms, expected_ms) = (sum(|ended| ended.busy_ms), sum(|ended| ended.expected_ms));
    // Of kinds, each has the part of the time that it was expected to take.
    let took_ms = |ended: &Completion| match group {
        [_] => busy_ms,
        _ => busy_ms * ended.expected_ms / expected_ms,
    };
    // Pieces of a trace have the same part each, as if they had been of one size: to go by what was
    // expected would only confirm it.
    let traces = group.iter().filter_map(|ended| match ended.work {
        Some((Work::Trace(trace), piece)) => Some((trace, piece, took_ms(ended))),
        _ => None,
    });
    let traces: Vec<_> = traces.collect();
    let mean = |values: f64| values / traces.len() as f64;
    let workgroups = mean(traces.iter().map(|(trace, ..)| f64::from(trace.workgroups)).sum());
    let trace_ms = mean(traces.iter().map(|(.., ms)| ms).sum());
    for (trace, InFlight { aim, arithmetic, .. }, _) in &traces {
        let pixels = workgroups * f64::from(WORKGROUP_THREADS);
        cost.traced(trace.job(), *aim, *arithmetic, pixels, trace_ms);
    }
    for ended in group {
        match ended.work {
            Some((Work::Show { .. }, _)) => cost.shown(took_ms(ended)),
            None => cost.interface_drawn(took_ms(ended)),
            Some((Work::Trace(_), _)) => {}
        }
    }
}
