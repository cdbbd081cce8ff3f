//! What a view's display picture holds: 8 or 16 bits per channel, the background or none.

/// What a view's display picture holds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct DisplayValues {
    /// True for 16 bits per channel. Each pixel then has two texels: the channels' high bytes, then their low bytes.
    ///
    /// So a picture of 16 bits needs no other texture format, layout or pipeline than one of 8 bits.
    pub is_deep: bool,
    /// True for a transparent background: the display has an alpha channel, straight, not premultiplied.
    pub is_transparent: bool,
}

impl DisplayValues {
    /// Texels per pixel, along x.
    pub fn texels_per_pixel(self) -> u32 {
        if self.is_deep { 2 } else { 1 }
    }
}
