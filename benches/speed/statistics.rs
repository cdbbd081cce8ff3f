//! Medians, quantiles and means, and work on all cores.

pub use mandelight::gpu::device::in_parallel;
use mandelight_test_support::statistics;

/// The quantile of `values` at `fraction` (0 to 1); 0 if there are none.
pub fn quantile(values: Vec<f64>, fraction: f64) -> f64 {
    statistics::quantile_of_any(values, fraction).unwrap_or(0.0)
}

/// The median; 0 if there are no values.
pub fn median(values: &[f64]) -> f64 {
    quantile(values.to_vec(), 0.5)
}

/// The mean; 0 if there are no values.
pub fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len().max(1) as f64
}

/// The nearest-rank quantile at `fraction` (0 to 1); NaN if there are no values.
pub fn nearest_rank(values: &mut [f64], fraction: f64) -> f64 {
    values.sort_by(f64::total_cmp);
    let index = (fraction * values.len() as f64).ceil() as usize;
    values.get(index.saturating_sub(1)).copied().unwrap_or(f64::NAN)
}
