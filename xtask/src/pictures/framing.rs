//! The field of view with which a picture shows a scene smaller.

use anyhow::{Context as _, Result};

/// The vertical field of view, in degrees, in which a scene's own spans the part `span` of the height.
pub fn fov_deg(document: &str, span: f64) -> Result<f64> {
    let fov = number_of(document, "vertical_fov_deg").context("the scene has no field of view")?;
    let half_height = (fov.to_radians() / 2.0).tan() / span;
    Ok(2.0 * half_height.atan().to_degrees())
}

/// The number of a field in the text of a document.
fn number_of(document: &str, field: &str) -> Option<f64> {
    let value = document.split_once(&format!("\"{field}\":"))?.1;
    value.split([',', '}', '\n']).next()?.trim().parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_the_span_is_twice_the_tangent() {
        let fov = fov_deg("\"vertical_fov_deg\": 90}", 0.5).unwrap();
        assert!(((fov.to_radians() / 2.0).tan() - 2.0).abs() < 1e-9, "{fov}");
        assert!(fov_deg("{}", 0.5).is_err());
    }

    #[test]
    fn numbers_are_found_in_documents() {
        let document = "{\n  \"a\": 4,\n  \"vertical_fov_deg\": 41.5,\n  \"b\": 1\n}";
        assert_eq!(number_of(document, "vertical_fov_deg"), Some(41.5));
        assert_eq!(number_of(document, "b"), Some(1.0));
        assert_eq!(number_of(document, "c"), None);
    }
}
