//! Pictures as distributions of their channels: means, and how far two distributions are apart.

/// Mean of each channel, 0 to 255.
pub fn mean_color(pixels: &[[u8; 3]]) -> [f64; 3] {
    let sum = |channel: usize| pixels.iter().map(|pixel| f64::from(pixel[channel])).sum::<f64>();
    [0, 1, 2].map(|channel| sum(channel) / pixels.len() as f64)
}

/// The greatest difference of two colours' channels.
pub fn apart(a: [f64; 3], b: [f64; 3]) -> f64 {
    [0, 1, 2].map(|channel| (a[channel] - b[channel]).abs()).into_iter().fold(0.0, f64::max)
}

/// Earth mover's distance of two pictures' histograms: the greatest of the channels, which are 0 to 1.
///
/// On a line that is the area between the cumulative histograms.
pub fn earth_movers_distance(a: &[[u8; 3]], b: &[[u8; 3]]) -> f64 {
    let of_channel = |channel: usize| {
        let cumulative = |pixels: &[[u8; 3]]| {
            let mut shares = [0.0; 256];
            for pixel in pixels {
                shares[usize::from(pixel[channel])] += 1.0 / pixels.len() as f64;
            }
            for i in 1..256 {
                shares[i] += shares[i - 1];
            }
            shares
        };
        let pairs = cumulative(a).into_iter().zip(cumulative(b));
        pairs.map(|(a, b)| (a - b).abs()).sum::<f64>() / 255.0
    };
    [0, 1, 2].map(of_channel).into_iter().fold(0.0, f64::max)
}
