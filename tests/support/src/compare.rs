//! Two pictures, RGBA with eight bits a channel, compared: as a whole, and region by region.

/// Mean and largest difference of two pictures' colour channels, in steps of 1/255.
pub fn difference(a: &[u8], b: &[u8]) -> (f64, u8) {
    assert_eq!(a.len(), b.len(), "pictures of different sizes");
    let steps = || a.iter().zip(b).map(|(a, b)| a.abs_diff(*b));
    let sum: u64 = steps().map(u64::from).sum();
    (sum as f64 / a.len() as f64 * 4.0 / 3.0, steps().max().unwrap_or(0))
}

/// Steps of 1/255 by which a channel differs notably: more than rounding and dither make of a smooth
/// surface, less than a ray that ends elsewhere.
pub const NOTABLE: u8 = 12;

/// Sides of the regions that are compared, pixels: there is one at every pixel.
const REGION: usize = 8;

/// How far two pictures may be apart.
#[derive(Clone, Copy, Debug)]
pub struct Tolerance {
    /// Pixels of any region of 8×8 that may differ notably.
    pub pixels: usize,
    /// Mean difference of any such region, steps of 1/255.
    pub mean: f64,
    /// Part of all pixels that may differ notably; three of them always may.
    pub part: f64,
}

/// For pictures of the same scene by the same kernels: rays that graze the surface end a little
/// otherwise where a cone of other rays went before them, and how the lattice was filled decides
/// which rays these are. Measured: 3 pixels of a region, a mean of 1.0, 0.2 % of a picture.
pub const SAME: Tolerance = Tolerance { pixels: 6, mean: 3.0, part: 0.005 };

/// For pictures that may have pixels of a picture of another size: the rays of both differ by rounding. Measured on parts
/// of the opening scenes: 5 pixels of a region, a mean of 5.3, 0.8 % of a picture.
pub const RESIZED: Tolerance = Tolerance { pixels: 8, mean: 6.5, part: 0.01 };

/// Says where `a` and `b` are further apart than `tolerance`; nothing where they are not.
pub fn complaint(a: &[u8], b: &[u8], size_px: [u32; 2], tolerance: Tolerance) -> Option<String> {
    let [width, height] = size_px.map(|side| side as usize);
    if [a.len(), b.len()] != [4 * width * height; 2] {
        return Some(format!("{} and {} bytes of {width}x{height} pixels", a.len(), b.len()));
    }
    let pairs = || a.as_chunks::<4>().0.iter().zip(b.as_chunks::<4>().0);
    let steps = |(a, b): (&[u8; 4], &[u8; 4])| [0, 1, 2, 3].map(|i| a[i].abs_diff(b[i]));
    let is_notable = |pair| steps(pair).into_iter().any(|step| step > NOTABLE);
    let notable = Sums::new(width, pairs().map(|pair| f64::from(u8::from(is_notable(pair)))));
    let mean =
        Sums::new(width, pairs().map(|pair| steps(pair).map(f64::from).iter().sum::<f64>() / 3.0));

    let (region_width, region_height) = (REGION.min(width), REGION.min(height));
    let area = region_width * region_height;
    let pixels = (tolerance.pixels * area).div_ceil(REGION * REGION);
    for y in 0..=height - region_height {
        for x in 0..=width - region_width {
            let of = |sums: &Sums| sums.of([x, y], [region_width, region_height]);
            let (found, found_mean) = (of(&notable), of(&mean) / area as f64);
            if found > pixels as f64 || found_mean > tolerance.mean {
                return Some(format!(
                    "the region of {region_width}x{region_height} pixels at {x}, {y} has {found} that \
                     differ notably, of {pixels} allowed, and a mean difference of {found_mean:.2}, of \
                     {:.2} allowed",
                    tolerance.mean
                ));
            }
        }
    }
    let found = notable.of([0, 0], [width, height]);
    let most = f64::max(3.0, tolerance.part * (width * height) as f64);
    (found > most).then(|| {
        format!("{found} of {} pixels differ notably, of {most:.0} allowed", width * height)
    })
}

/// Holds two pictures to be the same within a tolerance.
pub fn assert_within(a: &[u8], b: &[u8], size_px: [u32; 2], tolerance: Tolerance, what: &str) {
    if let Some(complaint) = complaint(a, b, size_px, tolerance) {
        panic!("{what}: {complaint}");
    }
}

/// Holds two pictures to be the same but for rays that graze the surface.
pub fn assert_same(a: &[u8], b: &[u8], size_px: [u32; 2], what: &str) {
    assert_within(a, b, size_px, SAME, what);
}

/// Sums over rectangles of a picture (a summed-area table, Crow 1984).
struct Sums {
    stride: usize,
    /// Of all values above and left of a corner.
    corners: Vec<f64>,
}

impl Sums {
    fn new(width: usize, values: impl Iterator<Item = f64>) -> Self {
        let stride = width + 1;
        let mut corners = vec![0.0; stride];
        for (i, value) in values.enumerate() {
            if i % width == 0 {
                corners.push(0.0);
            }
            let at = corners.len();
            corners.push(value + corners[at - 1] + corners[at - stride] - corners[at - stride - 1]);
        }
        Self { stride, corners }
    }

    fn of(&self, [x, y]: [usize; 2], [width, height]: [usize; 2]) -> f64 {
        let at = |x: usize, y: usize| self.corners[y * self.stride + x];
        at(x + width, y + height) + at(x, y) - at(x + width, y) - at(x, y + height)
    }
}
