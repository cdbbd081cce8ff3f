//! Curves from the value that selects a colour to a position in the gradient, by what is in view.
//!
//! In: how many of a film's hits have which value. Out: a curve that runs once through the gradient over
//! these values.

use crate::gpu::host_shared::Array;

/// Number of bins of a histogram of values.
pub const COLOR_BINS: usize = 1024;
/// Number of a curve's knots.
pub const COLOR_KNOTS: usize = 64;

/// Part of the hits below the curve's first knot, and of those above its last.
const OUTSIDE: f64 = 0.02;
/// Part that the equalised histogram has in a curve; a straight line has the rest.
///
/// Alone, it would draw out the noise of frequent values; a line would leave rare colours to most pixels.
const EQUALIZED: f64 = 0.7;
/// Least range of a curve, over the range of the histogram.
///
/// A nearly constant value would otherwise show its noise in all colours.
const MIN_WIDTH: f64 = 0.01;

/// The curves of the two colour layers.
pub type LayerCurves = [ColorCurve; 2];

/// The positions in the gradient of a range of values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ColorCurve {
    /// The value at the first knot.
    low: f64,
    /// From the value at the first knot to that at the last.
    width: f64,
    /// Positions from 0 to 1, increasing.
    knots: [f64; COLOR_KNOTS],
}

impl ColorCurve {
    /// The straight line over values from 0 to `range`.
    pub fn line(range: f64) -> Self {
        Self { low: 0.0, width: range, knots: std::array::from_fn(at_knot) }
    }

    /// The curve of a histogram of values from 0 to `range`; none if the histogram is empty.
    pub fn of(bins: &[u32], range: f64) -> Option<Self> {
        let counts = bins.iter().scan(0, |sum, &count| {
            *sum += u64::from(count);
            Some(*sum)
        });
        let sums: Vec<_> = [0].into_iter().chain(counts).collect();
        let all = *sums.last()? as f64;
        if all == 0.0 {
            return None;
        }
        let bin_width = range / bins.len() as f64;
        // The part of the hits below a value, linear within a bin.
        let part_below = |value: f64| {
            let place = (value / bin_width).clamp(0.0, bins.len() as f64);
            let bin = (place as usize).min(bins.len() - 1);
            let (before, after) = (sums[bin] as f64, sums[bin + 1] as f64);
            (before + (after - before) * (place - bin as f64)) / all
        };
        let quantile = |part: f64| {
            let wanted = part * all;
            let bin = sums.partition_point(|&sum| (sum as f64) < wanted).saturating_sub(1);
            let bin = bin.min(bins.len() - 1);
            let (before, after) = (sums[bin] as f64, sums[bin + 1] as f64);
            let inside = if after > before { (wanted - before) / (after - before) } else { 0.0 };
            (bin as f64 + inside.clamp(0.0, 1.0)) * bin_width
        };
        let (first, last) = (quantile(OUTSIDE), quantile(1.0 - OUTSIDE));
        let width = (last - first).max(MIN_WIDTH * range);
        let low = 0.5 * (first + last - width);
        let equalized = EQUALIZED * (last - first) / width;
        let knots = std::array::from_fn(|i| {
            let line = at_knot(i);
            let rank = (part_below(low + line * width) - OUTSIDE) / (1.0 - 2.0 * OUTSIDE);
            line + equalized * (rank.clamp(0.0, 1.0) - line)
        });
        Some(Self { low, width, knots })
    }

    /// The curve `part` of the way to `goal`.
    pub fn eased(&self, goal: &Self, part: f64) -> Self {
        let ease = |from: f64, to: f64| from + part * (to - from);
        Self {
            low: ease(self.low, goal.low),
            width: ease(self.width, goal.width),
            knots: std::array::from_fn(|i| ease(self.knots[i], goal.knots[i])),
        }
    }

    /// The value at the first knot, and one over the width, as kernels read them.
    pub fn range(&self) -> [f32; 2] {
        [self.low as f32, (1.0 / self.width) as f32]
    }

    /// The knots of the layers' curves, four in a vector, as kernels read them.
    pub fn packed(layers: &LayerCurves) -> Array<[f32; 4], { 2 * COLOR_KNOTS / 4 }> {
        let knots: Vec<_> = layers.iter().flat_map(|curve| curve.knots).collect();
        Array(std::array::from_fn(|i| std::array::from_fn(|k| knots[4 * i + k] as f32)))
    }
}

/// A knot's place on the way from the first to the last.
fn at_knot(knot: usize) -> f64 {
    knot as f64 / (COLOR_KNOTS - 1) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    fn histogram(count: impl Fn(usize) -> u32) -> Vec<u32> {
        (0..COLOR_BINS).map(count).collect()
    }

    #[test]
    fn equal_counts_give_a_line() {
        let curve = ColorCurve::of(&histogram(|_| 5), 2.0).unwrap();
        assert!((curve.low - 0.04).abs() < 1e-9 && (curve.width - 1.92).abs() < 1e-9);
        for (i, knot) in curve.knots.into_iter().enumerate() {
            assert!((knot - at_knot(i)).abs() < 1e-9);
        }
    }

    #[test]
    fn curves_increase_and_span_the_gradient_over_what_is_there() {
        // Two groups of values, apart.
        let bins =
            histogram(|i| if (200..240).contains(&i) || (600..605).contains(&i) { 9 } else { 0 });
        let curve = ColorCurve::of(&bins, 1024.0).unwrap();
        assert!((200.0..202.0).contains(&curve.low), "{curve:?}");
        assert!((604.0..=605.0).contains(&(curve.low + curve.width)), "{curve:?}");
        assert!(curve.knots.is_sorted() && curve.knots[0] == 0.0);
        assert!((curve.knots[COLOR_KNOTS - 1] - 1.0).abs() < 1e-9);
        // Forty of 45 values lie in the first tenth of the range: the curve is 0.7 of the way from a line to their rank.
        let behind = curve.knots[COLOR_KNOTS / 8];
        assert!((0.6..0.75).contains(&behind), "{behind}");
    }

    #[test]
    fn a_constant_value_is_not_drawn_out() {
        let curve = ColorCurve::of(&histogram(|i| u32::from(i == 512) * 100), 1.0).unwrap();
        assert!((curve.width - MIN_WIDTH).abs() < 1e-12);
        assert_eq!(ColorCurve::of(&histogram(|_| 0), 1.0), None);
    }

    #[test]
    fn counts_scale_out() {
        let of = |factor| ColorCurve::of(&histogram(|i| (i as u32 % 7) * factor), 3.0).unwrap();
        let (one, ten) = (of(1), of(10));
        assert!(one.eased(&ten, 1.0) == ten && one.eased(&ten, 0.0) == one);
        assert!((one.low - ten.low).abs() < 1e-9 && (one.width - ten.width).abs() < 1e-9);
    }
}
