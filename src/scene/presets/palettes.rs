//! Gradients of several presets.

use super::parts::stops;
use crate::scene::surface::GradientStop;

/// Night blue, sand, rust.
pub(super) fn dawn() -> Vec<GradientStop> {
    stops(&[
        (0.0, [0.02, 0.04, 0.09]),
        (0.25, [0.10, 0.28, 0.42]),
        (0.5, [0.93, 0.80, 0.62]),
        (0.75, [0.86, 0.42, 0.18]),
        (0.9, [0.30, 0.10, 0.10]),
    ])
}

/// Greens and straw.
pub(super) fn moss() -> Vec<GradientStop> {
    stops(&[
        (0.0, [0.03, 0.06, 0.04]),
        (0.3, [0.20, 0.33, 0.12]),
        (0.55, [0.80, 0.76, 0.42]),
        (0.78, [0.93, 0.90, 0.78]),
        (0.9, [0.30, 0.24, 0.14]),
    ])
}

/// Deep blue to white.
pub(super) fn ice() -> Vec<GradientStop> {
    stops(&[
        (0.0, [0.01, 0.04, 0.09]),
        (0.3, [0.05, 0.30, 0.45]),
        (0.55, [0.45, 0.76, 0.82]),
        (0.78, [0.96, 0.97, 0.96]),
        (0.9, [0.20, 0.22, 0.42]),
    ])
}

/// Dark red, fire, cream.
pub(super) fn ember() -> Vec<GradientStop> {
    stops(&[
        (0.0, [0.06, 0.01, 0.02]),
        (0.28, [0.48, 0.06, 0.05]),
        (0.52, [0.93, 0.42, 0.10]),
        (0.75, [0.99, 0.86, 0.55]),
        (0.9, [0.20, 0.08, 0.16]),
    ])
}

/// Greys and ivory.
pub(super) fn stone() -> Vec<GradientStop> {
    stops(&[
        (0.0, [0.10, 0.09, 0.09]),
        (0.3, [0.42, 0.37, 0.32]),
        (0.55, [0.80, 0.74, 0.64]),
        (0.78, [0.95, 0.93, 0.88]),
        (0.9, [0.30, 0.33, 0.38]),
    ])
}

/// Violet, pink, cream.
pub(super) fn orchid() -> Vec<GradientStop> {
    stops(&[
        (0.0, [0.05, 0.02, 0.09]),
        (0.28, [0.33, 0.10, 0.38]),
        (0.52, [0.86, 0.46, 0.58]),
        (0.76, [0.98, 0.88, 0.80]),
        (0.9, [0.16, 0.26, 0.40]),
    ])
}

/// Bronze and gold over teal.
pub(super) fn brass() -> Vec<GradientStop> {
    stops(&[
        (0.0, [0.06, 0.04, 0.02]),
        (0.3, [0.42, 0.26, 0.08]),
        (0.55, [0.88, 0.68, 0.30]),
        (0.78, [0.99, 0.94, 0.78]),
        (0.9, [0.16, 0.28, 0.28]),
    ])
}
