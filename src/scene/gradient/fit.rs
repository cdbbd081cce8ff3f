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
    // Indices of the samples that are stops, and the difference of each sample from the gradient of these stops.
    let mut chosen: Vec<_> = if last > 0 { vec![0, last] } else { vec![0] };
    let mut differences = vec![0.0; samples.len()];
    let mut changed = 0..samples.len();
    loop {
        let stops: Vec<_> = chosen
            .iter()
            .filter_map(|&i| samples.get(i))
            .map(|&(position, color)| srgb_stop(position, color))
            .collect();
        if chosen.len() >= MAX_GRADIENT_STOPS {
            return stops;
        }
        for (difference, &(position, color)) in
            differences[changed.clone()].iter_mut().zip(&samples[changed])
        {
            // At the end of the gradient its start shows.
            let shown = gradient_at(&stops, position.min(1.0 - 1e-9)).map(srgb_from_linear);
            *difference = (0..3).map(|i| (shown[i] - color[i]).abs()).fold(0.0, f32::max);
        }
        for &i in &chosen {
            // Samples of one position cannot all be met: each is a stop once.
            differences[i] = 0.0;
        }
        let worst = differences.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1));
        match worst {
            Some((i, &difference)) if difference > TOLERANCE => {
                let place = chosen.partition_point(|&other| other < i);
                chosen.insert(place, i);
                // A stop changes the gradient between its neighbours only.
                changed = chosen[place - 1]..chosen[place + 1];
            }
            _ => return stops,
        }
    }
}
