//! How much of a narrow window the panel covers, which is a sheet there.

use serde::{Deserialize, Serialize};

/// Height of the heading, in points; the closed sheet shows it alone.
pub const HEADING: f32 = 54.0;
/// Height of the low sheet: heading, lists of scenes, a row of pictures. In points.
pub const LOW: f32 = 222.0;
/// Part of the window that the sheet covers at half height.
pub const HALF_PART: f32 = 0.55;
/// Part of the window that the tall sheet covers; the rest shows what a control changes.
const TALL_PART: f32 = 0.8;

/// How much of the window the open sheet covers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SheetHeight {
    /// The scenes.
    #[default]
    Low,
    /// About half of the window.
    Half,
    /// Most of the window.
    Tall,
}

impl SheetHeight {
    /// All heights, from low to tall.
    pub const ALL: [Self; 3] = [Self::Low, Self::Half, Self::Tall];

    /// The height in a window of the height `window`, in points.
    pub fn points(self, window: f32) -> f32 {
        let points = match self {
            Self::Low => LOW.min(HALF_PART * window),
            Self::Half => HALF_PART * window,
            Self::Tall => TALL_PART * window,
        };
        points.floor().max(HEADING)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn heights_increase_in_every_window() {
        for window in [100.0, 320.0, 568.0, 844.0, 1400.0] {
            let points = SheetHeight::ALL.map(|sheet| sheet.points(window));
            assert!(points.is_sorted(), "{points:?}");
            assert!(points[2] <= window.max(HEADING));
        }
    }
}
