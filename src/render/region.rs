//! The rectangle of a picture that a view draws, and its eyes.

use crate::scene::StereoLayout;

/// Largest width or height of a region in pixels: WebGPU's default texture limit.
pub const MAX_REGION_PX: u32 = 8192;

/// Most pixels of a region: at eight bytes each they fill a storage binding's 128 MiB.
pub const MAX_REGION_PIXELS: u64 = 128 * 1024 * 1024 / 8;

/// The eyes whose pictures a region shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Eyes {
    /// The camera itself: no stereo.
    #[default]
    Camera,
    /// The left eye, of a picture whose overview shows both eyes beside each other.
    Left,
    /// The right eye, of a picture whose overview shows both eyes beside each other.
    Right,
    /// Both eyes, the left eye at the left.
    Beside,
    /// Both eyes, the left eye above.
    Below,
    /// Both eyes in one picture: the left in red, the right in green and blue.
    Anaglyph,
    /// An anaglyph in pixels twice as wide as high: both eyes share a window's pixels.
    WideAnaglyph,
}

impl Eyes {
    /// Number of eyes: 1 or 2.
    pub fn count(self) -> u32 {
        match self {
            Self::Camera | Self::Left | Self::Right => 1,
            Self::Beside | Self::Below | Self::Anaglyph | Self::WideAnaglyph => 2,
        }
    }

    /// Columns and rows of eyes on the film.
    fn on_film(self) -> [u32; 2] {
        match self {
            Self::Camera | Self::Left | Self::Right => [1, 1],
            Self::Beside | Self::Anaglyph | Self::WideAnaglyph => [2, 1],
            Self::Below => [1, 2],
        }
    }

    /// Columns and rows of eyes on the film of the whole picture.
    pub(super) fn on_sheet(self) -> [u32; 2] {
        match self {
            Self::Left | Self::Right => [2, 1],
            _ => self.on_film(),
        }
    }

    /// Whether both eyes are in one display picture.
    pub fn is_anaglyph(self) -> bool {
        matches!(self, Self::Anaglyph | Self::WideAnaglyph)
    }

    /// Width over height of a pixel: 1 or 2.
    pub fn pixel_aspect(self) -> u32 {
        if self == Self::WideAnaglyph { 2 } else { 1 }
    }

    /// The eyes that a scene's layout shows at once, in square pixels.
    pub fn of(layout: StereoLayout) -> Self {
        match layout {
            StereoLayout::Off => Self::Camera,
            StereoLayout::SideBySide => Self::Beside,
            StereoLayout::TopBottom => Self::Below,
            StereoLayout::Anaglyph => Self::Anaglyph,
        }
    }
}

/// A rectangle of pixels that two pictures share, with the same rays.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Overlap {
    /// Its upper left pixel in the new picture.
    pub first: [u32; 2],
    /// Its upper left pixel in the old picture.
    pub first_in_old: [u32; 2],
    /// Its width and height, in pixels.
    pub size_px: [u32; 2],
}

impl Overlap {
    /// Number of pixels.
    pub fn pixels(&self) -> u64 {
        self.size_px.map(u64::from).iter().product()
    }

    /// The rectangle without `margin_px` columns at its left and as many at its right.
    pub fn inset(&self, margin_px: u32) -> Self {
        let [width, height] = self.size_px;
        let margin_px = margin_px.min(width / 2);
        let shifted = |[x, y]: [u32; 2]| [x + margin_px, y];
        Self {
            first: shifted(self.first),
            first_in_old: shifted(self.first_in_old),
            size_px: [width - 2 * margin_px, height],
        }
    }
}

/// A rectangle of a picture, or the same rectangle of both eyes' pictures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Region {
    /// Width and height of one eye's whole picture, in pixels.
    pub picture_px: [u32; 2],
    /// The rectangle's upper left corner in the picture, in pixels.
    pub origin_px: [u32; 2],
    /// The rectangle's width and height in pixels; see [`Region::fits`].
    pub size_px: [u32; 2],
    /// The eyes.
    pub eyes: Eyes,
}

impl Region {
    /// The region that is the whole picture of the camera.
    pub fn whole(size_px: [u32; 2]) -> Self {
        Self { picture_px: size_px, origin_px: [0, 0], size_px, eyes: Eyes::Camera }
    }

    /// The region that a window of this size shows of a scene with `layout`: both eyes share the pixels.
    ///
    /// An anaglyph has half as many columns, to be stretched, since each column holds both eyes.
    pub fn shared_by(self, layout: StereoLayout) -> Self {
        let eyes = match Eyes::of(layout) {
            Eyes::Anaglyph => Eyes::WideAnaglyph,
            eyes => eyes,
        };
        let [columns, rows] = eyes.on_film();
        let [width, height] = self.size_px;
        let one = Self::whole([(width / columns).max(1), (height / rows).max(1)]);
        Self { eyes, ..one }
    }

    /// Width over height of one eye's whole picture.
    pub fn aspect(&self) -> f64 {
        let [width, height] = self.picture_px.map(f64::from);
        width * f64::from(self.eyes.pixel_aspect()) / height
    }

    /// Width and height of the film with all eyes, in pixels.
    pub fn film_px(&self) -> [u32; 2] {
        let [columns, rows] = self.eyes.on_film();
        [self.size_px[0] * columns, self.size_px[1] * rows]
    }

    /// Width and height of the display picture, in pixels.
    pub fn display_px(&self) -> [u32; 2] {
        if self.eyes.is_anaglyph() { self.size_px } else { self.film_px() }
    }

    /// Upper left pixel of the second eye's part of the film; (0, 0) with one eye.
    pub fn second_eye_at(&self) -> [u32; 2] {
        let [columns, rows] = self.eyes.on_film();
        [self.size_px[0] * (columns - 1), self.size_px[1] * (rows - 1)]
    }

    /// The whole picture at the nearest drawable size, with nearly the same aspect.
    pub fn whole_within_limits(size_px: [u32; 2]) -> Self {
        let size = size_px.map(|v| f64::from(v.max(1)));
        let side = f64::from(MAX_REGION_PX) / size[0].max(size[1]);
        let area = (MAX_REGION_PIXELS as f64 / (size[0] * size[1])).sqrt();
        let scale = side.min(area).min(1.0);
        Self::whole(size.map(|v| ((v * scale) as u32).max(1)))
    }

    /// The pixels that had the same rays in `old`; none where all rays differ.
    ///
    /// Both have to be whole pictures of the camera, of one height and not taller than wide: the angle of view then spans
    /// the height.
    pub fn overlap(&self, old: &Self) -> Option<Overlap> {
        let is_plain = |region: &Self| {
            let [width, height] = region.size_px;
            *region == Self::whole([width, height]) && width >= height
        };
        let ([new_width, height], [old_width, old_height]) = (self.size_px, old.size_px);
        // The middles of both are the same: an odd difference would be half a pixel.
        let is_on_pixels = new_width.abs_diff(old_width).is_multiple_of(2);
        if !(is_plain(self) && is_plain(old) && height == old_height && is_on_pixels) {
            return None;
        }
        Some(Overlap {
            first: [new_width.saturating_sub(old_width) / 2, 0],
            first_in_old: [old_width.saturating_sub(new_width) / 2, 0],
            size_px: [new_width.min(old_width), height],
        })
    }

    /// Whether a view can draw the region.
    ///
    /// No side may be 0 or above [`MAX_REGION_PX`], the region has at most [`MAX_REGION_PIXELS`] pixels, and
    /// lies inside its picture.
    pub fn fits(&self) -> bool {
        let [width, height] = self.film_px().map(u64::from);
        let inside = |axis: usize| {
            u64::from(self.origin_px[axis]) + u64::from(self.size_px[axis])
                <= u64::from(self.picture_px[axis])
        };
        self.film_px().iter().all(|side| (1..=MAX_REGION_PX).contains(side))
            && width * height <= MAX_REGION_PIXELS
            && inside(0)
            && inside(1)
    }
}
