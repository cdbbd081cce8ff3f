//! Differences between two display pictures.

use serde::Serialize;

use super::session::SIZE_PX;

/// Side and spacing of the windows of structural similarity, pixels.
const WINDOW_PX: usize = 8;
const STRIDE_PX: usize = 4;

/// The differences between two pictures.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub struct Difference {
    /// Mean difference of the channels, in steps of 1/255, sRGB.
    pub mean: f64,
    /// Mean distance in Oklab (Ottosson 2020), times 100; 2 is just noticeable.
    pub oklab: f64,
    /// One minus the mean structural similarity of luma (Wang et al. 2004), in uniform windows.
    pub structure: f64,
}

impl Difference {
    /// The mean of several differences.
    pub fn mean_of(all: &[Self]) -> Self {
        let count = all.len().max(1) as f64;
        let mean = |of: fn(&Self) -> f64| all.iter().map(of).sum::<f64>() / count;
        Self { mean: mean(|e| e.mean), oklab: mean(|e| e.oklab), structure: mean(|e| e.structure) }
    }

    /// Compares two RGBA pictures of the replay's size.
    pub fn between(a: &[u8], b: &[u8]) -> Self {
        let pixels = (a.len() / 4).max(1) as f64;
        let (a, b) = (a.as_chunks::<4>().0, b.as_chunks::<4>().0);
        let mut steps = 0;
        let mut oklab_sum = 0.0;
        for (a, b) in a.iter().zip(b) {
            steps += (0..3).map(|i| u64::from(a[i].abs_diff(b[i]))).sum::<u64>();
            if a != b {
                let (a, b) = (oklab(*a), oklab(*b));
                oklab_sum += f64::from((0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f32>().sqrt());
            }
        }
        Self {
            mean: steps as f64 / (3.0 * pixels),
            oklab: 100.0 * oklab_sum / pixels,
            structure: 1.0 - similarity(a, b),
        }
    }
}

fn linear(byte: u8) -> f32 {
    let v = f32::from(byte) / 255.0;
    if v <= 0.040_45 { v / 12.92 } else { ((v + 0.055) / 1.055).powf(2.4) }
}

fn oklab([r, g, b, _]: [u8; 4]) -> [f32; 3] {
    let [r, g, b] = [r, g, b].map(linear);
    let l = (0.412_221_47 * r + 0.536_332_55 * g + 0.051_445_995 * b).cbrt();
    let m = (0.211_903_5 * r + 0.680_699_5 * g + 0.107_396_96 * b).cbrt();
    let s = (0.088_302_46 * r + 0.281_718_85 * g + 0.629_978_7 * b).cbrt();
    [
        0.210_454_26 * l + 0.793_617_8 * m - 0.004_072_047 * s,
        1.977_998_5 * l - 2.428_592_2 * m + 0.450_593_7 * s,
        0.025_904_037 * l + 0.782_771_77 * m - 0.808_675_77 * s,
    ]
}

fn luma(pixel: &[u8; 4]) -> f64 {
    let [r, g, b] = [pixel[0], pixel[1], pixel[2]].map(f64::from);
    0.2126 * r + 0.7152 * g + 0.0722 * b
}

fn similarity(a: &[[u8; 4]], b: &[[u8; 4]]) -> f64 {
    let [width, height] = SIZE_PX.map(|side| side as usize);
    let (mut sum, mut count) = (0.0, 0.0);
    for y in (0..=height - WINDOW_PX).step_by(STRIDE_PX) {
        for x in (0..=width - WINDOW_PX).step_by(STRIDE_PX) {
            let rows = (y..y + WINDOW_PX).map(|row| row * width + x);
            sum += window_similarity(rows.flat_map(|at| {
                let (a, b) = (&a[at..at + WINDOW_PX], &b[at..at + WINDOW_PX]);
                a.iter().zip(b).map(|(a, b)| (luma(a), luma(b)))
            }));
            count += 1.0;
        }
    }
    sum / count
}

fn window_similarity(pairs: impl Iterator<Item = (f64, f64)>) -> f64 {
    const C1: f64 = (0.01 * 255.0) * (0.01 * 255.0);
    const C2: f64 = (0.03 * 255.0) * (0.03 * 255.0);
    let n = (WINDOW_PX * WINDOW_PX) as f64;
    let (mut sa, mut sb, mut saa, mut sbb, mut sab) = (0.0, 0.0, 0.0, 0.0, 0.0);
    for (a, b) in pairs {
        sa += a;
        sb += b;
        saa += a * a;
        sbb += b * b;
        sab += a * b;
    }
    let (ma, mb) = (sa / n, sb / n);
    let (va, vb, cov) = (saa / n - ma * ma, sbb / n - mb * mb, sab / n - ma * mb);
    (2.0 * ma * mb + C1) * (2.0 * cov + C2) / ((ma * ma + mb * mb + C1) * (va + vb + C2))
}
