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
