//! Medians, quantiles, and work on all cores.

#[path = "../../tests/oracle/quantile.rs"]
mod quantile;

pub use mandelight::gpu::device::in_parallel;

/// The value below which `part` (0 to 1) of `values` lie; 0 of none.
pub fn quantile(values: Vec<f64>, part: f64) -> f64 {
    quantile::quantile(values, part).unwrap_or(0.0)
}

/// The median; 0 of none.
pub fn median(values: &[f64]) -> f64 {
    quantile(values.to_vec(), 0.5)
}

/// The mean; 0 of none.
pub fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len().max(1) as f64
}

/// The smallest value that at least `part` (0 to 1) of `values` don't exceed; NaN of none.
pub fn nearest_rank(values: &mut [f64], part: f64) -> f64 {
    values.sort_by(f64::total_cmp);
    let index = (part * values.len() as f64).ceil() as usize;
    values.get(index.saturating_sub(1)).copied().unwrap_or(f64::NAN)
}
