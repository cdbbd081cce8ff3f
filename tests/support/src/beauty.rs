//! Measures of a picture that tell a view worth seeing from streaks, fog and glare.

/// Side of the blocks whose contrast is measured, in pixels.
const BLOCK: usize = 16;

/// What is measured of a picture, from display values of 0 to 1.
#[derive(Clone, Copy, Debug)]
pub struct Beauty {
    /// Standard deviation of the luminance in blocks of 16 pixels, averaged.
    pub contrast: f64,
    /// Anisotropy of the whole picture's structure tensor, 0 (none) to 1 (parallel streaks).
    pub anisotropy: f64,
    /// Median of the luminance.
    pub median: f64,
}

impl Beauty {
    /// Height of the pictures that [`Beauty::is_good`] is for, in pixels: in a larger one, a block
    /// of 16 pixels holds less of the view and has less contrast.
    pub const HEIGHT_PX: u32 = 96;

    /// Measures `pixels`, sRGB, of rows of `width` pixels.
    pub fn of(pixels: &[[u8; 3]], width: usize) -> Self {
        let luminance: Vec<f64> = pixels
            .iter()
            .map(|&[r, g, b]| {
                (0.2126 * f64::from(r) + 0.7152 * f64::from(g) + 0.0722 * f64::from(b)) / 255.0
            })
            .collect();
        let height = luminance.len() / width;
        let at = |x: usize, y: usize| luminance[y * width + x];
        let mut deviations = Vec::new();
        for top in (0..=height - BLOCK).step_by(BLOCK) {
            for left in (0..=width - BLOCK).step_by(BLOCK) {
                let block: Vec<f64> =
                    (0..BLOCK * BLOCK).map(|i| at(left + i % BLOCK, top + i / BLOCK)).collect();
                deviations.push(deviation(&block));
            }
        }
        let [mut xx, mut yy, mut xy] = [0.0; 3];
        for y in 1..height - 1 {
            for x in 1..width - 1 {
                let dx = 0.5 * (at(x + 1, y) - at(x - 1, y));
                let dy = 0.5 * (at(x, y + 1) - at(x, y - 1));
                (xx, yy, xy) = (xx + dx * dx, yy + dy * dy, xy + dx * dy);
            }
        }
        let trace: f64 = xx + yy;
        let anisotropy = (xx - yy).hypot(2.0 * xy) / trace.max(f64::MIN_POSITIVE);
        let mut sorted = luminance.clone();
        sorted.sort_by(f64::total_cmp);
        Self {
            contrast: deviations.iter().sum::<f64>() / deviations.len() as f64,
            anisotropy,
            median: sorted[sorted.len() / 2],
        }
    }

    /// Whether the picture is worth seeing.
    pub fn is_good(&self) -> bool {
        self.contrast > 0.06 && self.anisotropy < 0.55 && (0.12..=0.6).contains(&self.median)
    }
}

impl std::fmt::Display for Beauty {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { contrast, anisotropy, median } = self;
        write!(f, "contrast {contrast:.3}, anisotropy {anisotropy:.2}, median {median:.2}")
    }
}

fn deviation(values: &[f64]) -> f64 {
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    (values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / values.len() as f64).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(value: impl Fn(usize, usize) -> u8) -> Vec<[u8; 3]> {
        (0..64 * 48).map(|i| [value(i % 64, i / 64); 3]).collect()
    }

    #[test]
    fn known_pictures_have_known_measures() {
        let grey = Beauty::of(&picture(|_, _| 51), 64);
        assert!(grey.contrast < 1e-12 && (grey.median - 0.2).abs() < 1e-12);
        // Stripes of two pixels: all gradients across.
        let stripes = Beauty::of(&picture(|x, _| if x % 4 < 2 { 0 } else { 255 }), 64);
        assert!((stripes.contrast - 0.5).abs() < 1e-9 && stripes.anisotropy > 0.999);
        let checks =
            Beauty::of(&picture(|x, y| if (x / 2 + y / 2) % 2 == 0 { 40 } else { 140 }), 64);
        assert!(checks.anisotropy < 0.1 && checks.is_good(), "{checks}");
        assert!(!grey.is_good() && !stripes.is_good());
    }
}
