//! Sub-frames of motion blur.
//!
//! A picture with motion blur averages sub-frames: pictures at moments of the shutter time, one after the other. The
//! display of each averages the films so far; the display of the last is the picture.

/// One of the sub-frames of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SubFrame {
    /// Its number, from 0.
    pub index: u32,
    /// Number of sub-frames.
    pub count: u32,
    /// Number of the first of its samples among the picture's.
    pub first_sample: u32,
}

impl SubFrame {
    /// Whether the picture is complete after this sub-frame.
    pub fn is_last(&self) -> bool {
        self.index + 1 >= self.count
    }
}
