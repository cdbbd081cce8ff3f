//! Which rectangle of a picture a view draws.

/// Largest width or height of one region, pixels: WebGPU's default texture limit.
pub const MAX_REGION_PX: u32 = 8192;

/// Most pixels of one region: eight bytes each are the 128 MiB that a storage binding holds.
pub const MAX_REGION_PIXELS: u64 = 128 * 1024 * 1024 / 8;

/// A rectangle of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Region {
    /// The whole picture, width and height in pixels.
    pub picture_px: [u32; 2],
    /// The rectangle's upper left corner in it.
    pub origin_px: [u32; 2],
    /// The rectangle's width and height; see [`Region::fits`].
    pub size_px: [u32; 2],
}

impl Region {
    /// The region that is the whole picture.
    pub fn whole(size_px: [u32; 2]) -> Self {
        Self { picture_px: size_px, origin_px: [0, 0], size_px }
    }

    /// The whole picture at the nearest size that a view can draw, of nearly the same shape.
    pub fn whole_within_limits(size_px: [u32; 2]) -> Self {
        let size = size_px.map(|v| f64::from(v.max(1)));
        let side = f64::from(MAX_REGION_PX) / size[0].max(size[1]);
        let area = (MAX_REGION_PIXELS as f64 / (size[0] * size[1])).sqrt();
        let scale = side.min(area).min(1.0);
        Self::whole(size.map(|v| ((v * scale) as u32).max(1)))
    }

    /// Whether a view can draw it: no side 0 or above [`MAX_REGION_PX`], at most
    /// [`MAX_REGION_PIXELS`] pixels, and inside its picture.
    pub fn fits(&self) -> bool {
        let [width, height] = self.size_px.map(u64::from);
        let inside = |axis: usize| {
            u64::from(self.origin_px[axis]) + u64::from(self.size_px[axis])
                <= u64::from(self.picture_px[axis])
        };
        self.size_px.iter().all(|side| (1..=MAX_REGION_PX).contains(side))
            && width * height <= MAX_REGION_PIXELS
            && inside(0)
            && inside(1)
    }
}
