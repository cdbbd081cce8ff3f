//! Fits stops to a sampled gradient.

use super::named::srgb_stop;
use crate::scene::{
    GradientStop, MAX_GRADIENT_STOPS,
    color::{gradient_at, srgb_from_linear},
};

/// Greatest difference of an sRGB channel between the samples and the stops, unless the stops run out.
const TOLERANCE: f32 = 1.5 / 255.0;

/// The fewest stops that follow `samples`, which are positions with sRGB colours in order.
///
/// Adds the sample that differs most until none differs by more than one and a half of 255 levels, or until
/// there are [`MAX_GRADIENT_STOPS`].
pub fn fit(samples: &[(f64, [f32; 3])]) -> Vec<GradientStop> {
    let last = samples.len().saturating_sub(1);
    let mut chosen: Vec<_> = if last > 0 { vec![0, last] } else { vec![0] };
    let stop = |&i: &usize| samples.get(i).map(|&(position, color)| srgb_stop(position, color));
    loop {
        let stops: Vec<_> = chosen.iter().filter_map(stop).collect();
        if chosen.len() >= MAX_GRADIENT_STOPS {
            return stops;
        }
        let off = |&(position, color): &(f64, [f32; 3])| {
            // At the end of the gradient its start shows.
            let shown = gradient_at(&stops, position.min(1.0 - 1e-9)).map(srgb_from_linear);
            (0..3).map(|i| (shown[i] - color[i]).abs()).fold(0.0, f32::max)
        };
        let worst = samples
            .iter()
            .map(off)
            .enumerate()
            .filter(|(i, _)| !chosen.contains(i))
            .max_by(|a, b| a.1.total_cmp(&b.1));
        match worst {
            Some((i, off)) if off > TOLERANCE => {
                let place = chosen.partition_point(|&other| other < i);
                chosen.insert(place, i);
            }
            _ => return stops,
        }
    }
}
