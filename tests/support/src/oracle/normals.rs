//! Oracle: the gradient of a distance estimate, by differences alone, to a known precision.

use glam::DVec3;
use mandelight::formula::mandelbulb::Mandelbulb;

use super::estimate::distance;

/// Differences at so many spacings, each half the one before.
const SPACINGS: usize = 9;

/// A direction, and how far off it may be, degrees.
pub struct Direction {
    pub unit: DVec3,
    pub uncertain_deg: f64,
}

/// The direction in which the estimate grows fastest at `p`: central differences, extrapolated to
/// spacing zero (Richardson 1911), from the spacings whose results agree best (Ridders 1982). The
/// estimate changes over lengths like `scale`. None where it is flat, as it is inside.
pub fn gradient(fractal: &Mandelbulb, p: DVec3, scale: f64) -> Option<Direction> {
    let difference = |spacing: f64| {
        DVec3::AXES.map(|axis| {
            distance(fractal, p + axis * spacing) - distance(fractal, p - axis * spacing)
        })
    };
    // Row by row of Neville's scheme: element j has an error of order spacing^(2 j + 2).
    let mut row: Vec<DVec3> = Vec::new();
    let mut best: Option<Direction> = None;
    for i in 0..SPACINGS {
        let spacing = 0.1 * scale * 0.5_f64.powi(i as i32);
        let mut next = vec![DVec3::from_array(difference(spacing)) / (2.0 * spacing)];
        let mut weight = 1.0;
        for coarser in &row {
            weight *= 4.0;
            let finer = next[next.len() - 1];
            next.push(finer + (finer - coarser) / (weight - 1.0));
        }
        if let (Some(before), Some(now)) = (row.last(), next.last()) {
            let uncertain_deg = angle_deg(*before, *now);
            if best.as_ref().is_none_or(|best| uncertain_deg < best.uncertain_deg) {
                best = now.try_normalize().map(|unit| Direction { unit, uncertain_deg });
            }
        }
        row = next;
    }
    best
}

/// The angle between two vectors of any length; 180 where one is zero.
pub fn angle_deg(a: DVec3, b: DVec3) -> f64 {
    let (sine, cosine) = (a.cross(b).length(), a.dot(b));
    if sine == 0.0 && cosine <= 0.0 { 180.0 } else { sine.atan2(cosine).to_degrees() }
}
