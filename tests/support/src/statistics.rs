//! Quantiles.

/// The value below which `part` (0 to 1) of `values` lie; none of none.
pub fn quantile_of_any(mut values: Vec<f64>, part: f64) -> Option<f64> {
    values.sort_by(f64::total_cmp);
    let place = values.len().saturating_sub(1) as f64 * part;
    values.get(place as usize).copied()
}

/// The value below which `part` (0 to 1) of `values` lie, of which there must be one.
pub fn quantile(values: Vec<f64>, part: f64) -> f64 {
    quantile_of_any(values, part).expect("a value")
}
