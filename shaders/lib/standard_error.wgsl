// How far the mean of a pixel's paths may be from the truth, by the means of its rounds of samples.
// uses: lib/film_mean, lib/luminance, types/film

// Samples of a round.
const SAMPLES_PER_ROUND = 8.0;
// Rounds from which their spread gives an error.
const MIN_ROUNDS = 4.0;

// Whether a pixel has too few rounds for an error.
fn has_few_rounds(index: u32) -> bool {
    return film_bw[index].y < MIN_ROUNDS * SAMPLES_PER_ROUND;
}

// Squared standard error of a pixel's mean luminance; `moment` is its element of `moments`.
fn squared_standard_error(index: u32, moment: f32) -> f32 {
    let count = film_bw[index].y;
    let mean = luminance(sample_mean(index));
    return max(abs(moment) / count - mean * mean, 0.0) / (count / SAMPLES_PER_ROUND - 1.0);
}
