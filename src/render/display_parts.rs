//! Divides displays that take long: their parts are submitted one after another.
//!
//! In: the parts of a display, and how long submitted parts took. Out: the parts to submit next. Each submit waits for
//! the end of the one before it, so that frames of the interface and other programs get the GPU between them. A part that was never
//! measured is submitted alone. Where displays are fast, each later one is a single submit.

use std::{
    collections::{BTreeMap, VecDeque},
    ops::Range,
};

use super::lattice::WORKGROUP_SIDE;

/// A step of a display: passes that are never submitted apart. In the order of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum DisplayPart {
    /// The pixels between those of a sparse lattice, and the mean of sub-frames.
    Fill,
    /// Statistics of the whole film, and exposure.
    Statistics,
    /// The light that blooms.
    Bloom,
    /// Some rows of a stage of the denoiser: 0 makes the denoiser's input, n is iteration n - 1.
    Denoise(u32, Rows),
    /// Some rows from film to display values.
    Tone(Rows),
}

impl DisplayPart {
    /// The rows of a part of a pass over the pixels.
    fn rows(self) -> Option<Rows> {
        match self {
            Self::Denoise(_, rows) | Self::Tone(rows) => Some(rows),
            Self::Fill | Self::Statistics | Self::Bloom => None,
        }
    }
}

/// About how many pixels of a pass are submitted together on a CPU adapter. SwiftShader takes up to two microseconds for each.
const CPU_PIXELS: u32 = 1 << 16;

/// Some rows of workgroups of a pass over the pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Rows {
    /// The first one.
    pub first: u32,
    /// One past the last one; [`u32::MAX`] if there are no rows after them.
    pub end: u32,
}

impl Rows {
    /// All rows.
    pub const ALL: Self = Self { first: 0, end: u32::MAX };

    /// All rows of a picture of `size_px`, in runs that take a CPU adapter no longer than a submit should.
    pub fn runs(size_px: [u32; 2]) -> impl Iterator<Item = Self> + Clone {
        let [_, all_rows] = size_px.map(|side| side.div_ceil(WORKGROUP_SIDE));
        let rows = (CPU_PIXELS / (WORKGROUP_SIDE * size_px[0])).max(1);
        (0..all_rows).step_by(rows as usize).map(move |first| {
            let end = first + rows;
            Self { first, end: if end < all_rows { end } else { u32::MAX } }
        })
    }
}

/// Consecutive parts of a display, submitted together: all that it has from `first` to `last`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PartRange {
    /// The first part.
    pub first: DisplayPart,
    /// The last part.
    pub last: DisplayPart,
}

impl PartRange {
    /// All parts of a display.
    pub const ALL: Self = Self { first: DisplayPart::Fill, last: DisplayPart::Tone(Rows::ALL) };

    /// A single part.
    pub const fn only(part: DisplayPart) -> Self {
        Self { first: part, last: part }
    }

    /// Whether `part` is among them.
    pub fn contains(self, part: DisplayPart) -> bool {
        self.overlaps(Self::only(part))
    }

    /// Whether any of `others` is among them.
    pub fn overlaps(self, others: Self) -> bool {
        self.first <= others.last && others.first <= self.last
    }

    /// The rows of a pass over the pixels that are among them; empty if none are. `part`: the pass's part with some rows.
    pub fn rows_of(self, part: impl Fn(Rows) -> DisplayPart) -> Range<u32> {
        let edge = |row| part(Rows { first: row, end: row });
        let rows_at = |end: DisplayPart| end.rows().filter(|rows| part(*rows) == end);
        let start = match rows_at(self.first) {
            Some(rows) => rows.first,
            None if self.first < edge(0) => 0,
            None => return 0..0,
        };
        let end = match rows_at(self.last) {
            Some(rows) => rows.end,
            None if self.last > edge(u32::MAX) => u32::MAX,
            None => return 0..0,
        };
        start..end
    }

    /// Whether the display is complete with them.
    pub fn are_last(self) -> bool {
        matches!(self.last, DisplayPart::Tone(Rows { end: u32::MAX, .. }))
    }
}

/// Longest expected time of parts that are submitted together, milliseconds.
const MAX_TOGETHER_MS: f64 = 100.0;

/// The same in trials, milliseconds, whatever the latency. Some browsers report completions late, so that each part alone seems
/// to take long: trials show how much of that is latency.
const MAX_IN_TRIAL_MS: f64 = 2.0 * MAX_TOGETHER_MS;

/// The least that remains of an expected time after a measurement: slow fills of coarse lattices alternate with fast ones.
const LEAST_REMAINING: f64 = 0.5;

/// How many times as long as known parts those of another view may take: its tone curve may be expensive, and its bloom and tone
/// mapping by general pipelines until special ones are compiled.
const OTHER_VIEW: f64 = 3.0;

/// A submit that has not ended.
#[derive(Clone, Debug)]
struct InFlight {
    /// Its parts, in order.
    parts: Vec<DisplayPart>,
    /// Whether the display is of another size than those to come.
    is_of_old_size: bool,
}

/// Decides which parts of a display are submitted together, by what they took before.
#[derive(Clone, Debug, Default)]
pub struct DisplayDivision {
    /// Expected time of each part that has been measured, milliseconds.
    expected_ms: BTreeMap<DisplayPart, f64>,
    /// Whether the display under way, or else the next one, is the first of another view.
    is_of_other_view: bool,
    /// Parts of the display under way that have not been submitted, in order.
    left: Vec<DisplayPart>,
    /// Number of displays since the one whose parts were not all known. Trials are the first, second, fourth and so on.
    known_displays: u32,
    /// The submits that have not ended, in order.
    in_flight: VecDeque<InFlight>,
    /// Time of the ended parts of the display under way, milliseconds.
    ended_ms: f64,
    /// Time of the shortest submit, milliseconds: no completion is later than that by latency. None before the first one.
    shortest_ms: Option<f64>,
}

impl DisplayDivision {
    /// Forgets what parts took: displays of another size take another time.
    pub fn forget_times(&mut self) {
        self.expected_ms.clear();
        self.shortest_ms = None;
        self.in_flight.iter_mut().for_each(|submit| submit.is_of_old_size = true);
    }

    /// Expects the next display, of another view, to take longer. Where displays are fast, it remains one submit.
    pub fn expect_longer(&mut self) {
        self.is_of_other_view = true;
    }

    /// Begins a display that has `parts`, in order, of which the last are [`DisplayPart::Tone`]. All parts of the display before
    /// have been submitted.
    pub fn begin(&mut self, parts: impl IntoIterator<Item = DisplayPart>) {
        debug_assert!(self.left.is_empty(), "one display at a time");
        self.left.extend(parts);
        let are_known = self.left.iter().all(|part| self.expected_ms.contains_key(part));
        self.known_displays = if are_known { self.known_displays.wrapping_add(1) } else { 0 };
    }

    /// Whether parts of a display are left to submit.
    pub fn has_parts_left(&self) -> bool {
        !self.left.is_empty()
    }

    /// Leaves out the denoiser, if it is not done yet. Returns whether parts of it were left.
    pub fn skip_denoiser(&mut self) -> bool {
        let before = self.left.len();
        self.left.retain(|part| !matches!(part, DisplayPart::Denoise(..)));
        self.left.len() < before
    }

    /// The next parts to submit together; none while others are in flight, or if none are left.
    pub fn next_parts(&mut self) -> Option<PartRange> {
        if self.in_flight.is_empty() { self.next_parts_without_waiting() } else { None }
    }

    /// The next parts to submit together, also while others are in flight; none if none are left.
    pub fn next_parts_without_waiting(&mut self) -> Option<PartRange> {
        let is_trial = self.known_displays.is_power_of_two();
        // Of parts that are submitted together all but one may take less than alone, by as much as the latency of a completion.
        let latency_ms = if is_trial { self.shortest_ms.unwrap_or(0.0) } else { 0.0 };
        let factor = if self.is_of_other_view { OTHER_VIEW } else { 1.0 };
        let (mut sum_ms, mut saved_ms) = (0.0, 0.0);
        let fit = self.left.iter().take_while(|part| {
            sum_ms += factor * self.expected_ms.get(part).copied().unwrap_or(f64::INFINITY);
            let fits = sum_ms <= MAX_IN_TRIAL_MS && sum_ms - saved_ms <= MAX_TOGETHER_MS;
            saved_ms += latency_ms;
            fits
        });
        let count = fit.count().max(1).min(self.left.len());
        let parts: Vec<_> = self.left.drain(..count).collect();
        let range = PartRange { first: *parts.first()?, last: *parts.last()? };
        self.is_of_other_view &= !range.are_last();
        self.in_flight.push_back(InFlight { parts, is_of_old_size: false });
        Some(range)
    }

    /// Learns that the submit of `range`, the first in flight, took `ms`. Returns the time of the whole display if it was the last
    /// one, milliseconds.
    pub fn ended(&mut self, range: PartRange, ms: f64) -> Option<f64> {
        let InFlight { parts, is_of_old_size } = self.in_flight.pop_front()?;
        debug_assert_eq!((parts.first(), parts.last()), (Some(&range.first), Some(&range.last)));
        if !is_of_old_size {
            self.learn(&parts, ms);
            self.shortest_ms = Some(self.shortest_ms.map_or(ms, |shortest| shortest.min(ms)));
        }
        self.ended_ms += ms;
        range.are_last().then(|| std::mem::take(&mut self.ended_ms))
    }

    /// Corrects the expected times of `parts`, which took `ms` together. No others: a display without the denoiser says nothing
    /// of the denoiser's times.
    fn learn(&mut self, parts: &[DisplayPart], ms: f64) {
        if let [part] = parts {
            let expected_ms = self.expected_ms.entry(*part).or_default();
            *expected_ms = ms.max(LEAST_REMAINING * *expected_ms);
        } else if ms > MAX_IN_TRIAL_MS {
            // Which of them took longer than expected is not known: the next display shows it.
            self.expected_ms.retain(|part, _| !parts.contains(part));
        } else {
            let sum_ms: f64 = parts.iter().filter_map(|part| self.expected_ms.get(part)).sum();
            let factor = (ms / sum_ms.max(1e-3)).max(LEAST_REMAINING);
            let known = self.expected_ms.iter_mut().filter(|(part, _)| parts.contains(part));
            known.for_each(|(_, expected_ms)| *expected_ms *= factor);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{
        DisplayPart::{Bloom, Denoise, Fill},
        *,
    };

    /// Tone mapping, undivided.
    #[expect(non_upper_case_globals, reason = "reads as the other parts do")]
    const Tone: DisplayPart = DisplayPart::Tone(Rows::ALL);

    /// The parts that a display of parts with these times is submitted in, and what it took in all.
    fn display(
        division: &mut DisplayDivision,
        parts: &[(DisplayPart, f64)],
    ) -> (Vec<PartRange>, f64) {
        division.begin(parts.iter().map(|(part, _)| *part));
        let mut submitted = Vec::new();
        while let Some(together) = division.next_parts() {
            assert_eq!(division.next_parts(), None, "one after the other");
            let ms = parts.iter().filter(|(part, _)| together.contains(*part)).map(|(_, ms)| ms);
            submitted.push(together);
            if let Some(total_ms) = division.ended(together, ms.sum()) {
                assert!(!division.has_parts_left());
                return (submitted, total_ms);
            }
        }
        panic!("no part was the last of {parts:?}");
    }

    /// A stage of the denoiser, undivided.
    fn denoise(stage: u32) -> DisplayPart {
        Denoise(stage, Rows::ALL)
    }

    fn parts(first: DisplayPart, last: DisplayPart) -> PartRange {
        PartRange { first, last }
    }

    #[test]
    fn a_short_display_is_divided_only_until_its_parts_are_known() {
        let mut division = DisplayDivision::default();
        let short = [(Fill, 2.0), (Bloom, 3.0), (Tone, 4.0)];
        let (submitted, total_ms) = display(&mut division, &short);
        assert_eq!(submitted, short.map(|(part, _)| PartRange::only(part)));
        assert_eq!(total_ms, 9.0);
        assert_eq!(display(&mut division, &short), (vec![PartRange::ALL], 9.0));
        // A part that was never measured is alone.
        let denoised = [(Fill, 2.0), (denoise(0), 50.0), (Tone, 4.0)];
        let divided =
            vec![PartRange::only(Fill), PartRange::only(denoise(0)), PartRange::only(Tone)];
        assert_eq!(display(&mut division, &denoised).0, divided);
        assert_eq!(display(&mut division, &denoised).0, [PartRange::ALL]);
    }

    #[test]
    fn long_parts_are_alone_and_short_ones_together() {
        let mut division = DisplayDivision::default();
        let long = [(Fill, 150.0), (Bloom, 40.0), (denoise(0), 50.0), (Tone, 30.0)];
        assert_eq!(display(&mut division, &long).0.len(), 4);
        let divided = vec![PartRange::only(Fill), parts(Bloom, denoise(0)), PartRange::only(Tone)];
        // The shortest part takes 30 ms: no part takes less than its time alone without these.
        let in_trial = vec![PartRange::only(Fill), parts(Bloom, Tone)];
        for known_displays in 1..=20_u32 {
            let expected = if known_displays.is_power_of_two() { &in_trial } else { &divided };
            assert_eq!(
                display(&mut division, &long),
                (expected.clone(), 270.0),
                "{known_displays}"
            );
        }
        division.forget_times();
        assert_eq!(display(&mut division, &long).0.len(), 4);
    }

    #[test]
    fn late_completions_do_not_leave_a_short_display_divided() {
        let mut division = DisplayDivision::default();
        let parts = [Fill, Bloom, denoise(0), denoise(1), denoise(2), denoise(3), denoise(4), Tone];
        let mut submits = Vec::new();
        for _ in 0..12 {
            division.begin(parts);
            let mut count = 0;
            while let Some(together) = division.next_parts() {
                count += 1;
                // However short they are.
                division.ended(together, 96.0);
            }
            submits.push(count);
        }
        assert_eq!(submits[0], 8);
        assert_eq!(submits[8..], [1; 4], "{submits:?}");
    }

    #[test]
    fn a_display_that_takes_longer_than_expected_is_divided_the_next_time() {
        let mut division = DisplayDivision::default();
        let mut times = [(Fill, 5.0), (Tone, 10.0)];
        display(&mut division, &times);
        assert_eq!(display(&mut division, &times).0.len(), 1);
        times[1].1 = 300.0;
        assert_eq!(display(&mut division, &times).0.len(), 1);
        // Fills of coarse and fine lattices alternate.
        for fill_ms in [90.0, 10.0, 90.0] {
            times[0].1 = fill_ms;
            assert_eq!(display(&mut division, &times).0.len(), 2);
        }
    }

    #[test]
    fn the_first_display_of_another_view_is_divided_where_displays_are_slow() {
        let mut division = DisplayDivision::default();
        for (ms, submits) in [(10.0, 1), (15.0, 2), (20.0, 3)] {
            let parts = [(Fill, ms), (Bloom, ms), (Tone, ms)];
            for _ in 0..6 {
                display(&mut division, &parts);
            }
            division.expect_longer();
            assert_eq!(display(&mut division, &parts).0.len(), submits, "{ms} ms");
            assert_eq!(display(&mut division, &parts).0.len(), 1, "{ms} ms");
        }
    }

    #[test]
    fn a_display_without_the_denoiser_says_nothing_of_the_denoiser() {
        let mut division = DisplayDivision::default();
        let denoised = [(Bloom, 2.0), (denoise(0), 90.0), (denoise(1), 80.0), (Tone, 10.0)];
        let divided = vec![
            PartRange::only(Bloom),
            PartRange::only(denoise(0)),
            PartRange::only(denoise(1)),
            PartRange::only(Tone),
        ];
        assert_eq!(display(&mut division, &denoised).0, divided);
        let plain = [(Bloom, 2.0), (Tone, 10.0)];
        for _ in 0..6 {
            assert_eq!(display(&mut division, &plain).0, [parts(Bloom, Tone)]);
        }
        let divided = vec![parts(Bloom, denoise(0)), parts(denoise(1), Tone)];
        assert_eq!(display(&mut division, &denoised).0, divided);
    }

    #[test]
    fn parts_in_flight_at_a_change_of_size_say_nothing_of_the_new_one() {
        let mut division = DisplayDivision::default();
        division.begin([Fill, Tone]);
        assert_eq!(division.next_parts(), Some(PartRange::only(Fill)));
        assert_eq!(division.next_parts_without_waiting(), Some(PartRange::only(Tone)));
        division.forget_times();
        division.begin([Fill, Tone]);
        assert_eq!(division.ended(PartRange::only(Fill), 1.0), None);
        assert_eq!(division.next_parts(), None, "the last part is in flight");
        assert_eq!(division.ended(PartRange::only(Tone), 1.0), Some(2.0));
        assert_eq!(division.next_parts(), Some(PartRange::only(Fill)), "not known yet");
    }

    #[test]
    fn the_rest_of_a_display_does_not_wait_for_what_is_in_flight() {
        let mut division = DisplayDivision::default();
        division.begin([Fill, Bloom, Tone]);
        assert_eq!(division.next_parts(), Some(PartRange::only(Fill)));
        assert_eq!(division.next_parts(), None);
        let rest = [Bloom, Tone].map(PartRange::only);
        assert_eq!(
            [division.next_parts_without_waiting(), division.next_parts_without_waiting()],
            rest.map(Some)
        );
        assert_eq!(division.next_parts_without_waiting(), None);
        assert_eq!(division.ended(PartRange::only(Fill), 1.0), None);
        assert_eq!(division.ended(rest[0], 2.0), None);
        assert_eq!(division.ended(rest[1], 3.0), Some(6.0));
    }

    #[test]
    fn every_row_of_each_pass_is_in_one_submit() {
        let runs = [(0, 2), (2, 4), (4, u32::MAX)].map(|(first, end)| Rows { first, end });
        let passes: [fn(Rows) -> DisplayPart; 3] =
            [|rows| Denoise(0, rows), |rows| Denoise(1, rows), DisplayPart::Tone];
        let all: Vec<_> = passes.iter().flat_map(|part| runs.map(part)).collect();
        for splits in [vec![], vec![3], vec![1, 5], vec![2, 3, 8], (1..9).collect()] {
            let ends = splits.iter().copied().chain([9]);
            let starts = [0].into_iter().chain(splits.iter().copied());
            let mut covered = [0; 3];
            for (start, end) in starts.zip(ends) {
                let range = PartRange { first: all[start], last: all[end - 1] };
                assert_eq!(range.are_last(), end == 9);
                for (part, covered) in passes.iter().zip(&mut covered) {
                    let rows = range.rows_of(part);
                    if !rows.is_empty() {
                        assert_eq!(rows.start, *covered, "{range:?}");
                        *covered = rows.end;
                    }
                }
            }
            assert_eq!(covered, [u32::MAX; 3], "{splits:?}");
        }
        assert_eq!(PartRange::ALL.rows_of(passes[1]), 0..u32::MAX);
        assert!(parts(Fill, Bloom).rows_of(passes[0]).is_empty());
        assert!(PartRange::only(Tone).rows_of(passes[1]).is_empty());
        assert!(PartRange::only(denoise(1)).rows_of(DisplayPart::Tone).is_empty());
    }

    #[test]
    fn runs_have_all_rows_in_order_and_few_pixels() {
        for (size_px, most) in [([64_u32, 48], 6), ([640, 361], 12), ([9000, 17], 1), ([1, 1], 1)] {
            let rows = size_px[1].div_ceil(WORKGROUP_SIDE);
            let runs: Vec<_> = Rows::runs(size_px).collect();
            assert_eq!(runs.len(), rows.div_ceil(most) as usize);
            assert!(runs.windows(2).all(|pair| pair[0].end == pair[1].first), "{runs:?}");
            assert!(runs.iter().all(|run| run.end.min(rows) - run.first <= most), "{runs:?}");
            let (first, last) = (runs[0], runs[runs.len() - 1]);
            assert_eq!([first.first, last.end], [0, u32::MAX]);
        }
    }

    #[test]
    fn a_display_that_skips_the_denoiser_has_all_its_other_parts() {
        let mut division = DisplayDivision::default();
        division.begin([Bloom, denoise(0), denoise(1), Tone]);
        assert_eq!(division.next_parts(), Some(PartRange::only(Bloom)));
        assert!(division.skip_denoiser());
        assert!(!division.skip_denoiser());
        assert_eq!(division.ended(PartRange::only(Bloom), 2.0), None);
        assert_eq!(division.next_parts(), Some(PartRange::only(Tone)));
        assert_eq!(division.ended(PartRange::only(Tone), 3.0), Some(5.0));
    }
}
