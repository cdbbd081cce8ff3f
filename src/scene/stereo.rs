//! Stereo settings: layout, screen and eyes.
//!
//! The lengths describe the viewer (thesis 4.5, "Stereoscopic 3D"): screen height, distance from
//! eyes to screen, and eye separation. The screen is at the pivot, which fixes the number of scene
//! units per centimetre; objects at the pivot's distance appear on the screen's plane.

use serde::{Deserialize, Serialize};

use super::param;

/// The arrangement of both eyes' pictures.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum StereoLayout {
    /// No stereo: one picture from the camera's position.
    #[default]
    Off,
    /// The left eye's picture on the left, the right eye's on the right.
    SideBySide,
    /// The left eye's picture on top, the right eye's below.
    TopBottom,
    /// Both pictures in one, for glasses with red left and cyan right.
    Anaglyph,
}

impl StereoLayout {
    /// Number of columns and rows of pictures.
    pub fn grid(self) -> [u32; 2] {
        match self {
            Self::Off | Self::Anaglyph => [1, 1],
            Self::SideBySide => [2, 1],
            Self::TopBottom => [1, 2],
        }
    }
}

/// Stereo settings: the viewer's two eyes in front of a screen.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Stereo {
    /// The arrangement of both pictures; off by default.
    pub layout: StereoLayout,
    /// The screen's height, range [`param::SCREEN_HEIGHT`], centimetres. The width follows from
    /// the picture's aspect ratio.
    pub screen_height_cm: f64,
    /// Distance from the eyes to the screen, range [`param::EYE_DISTANCE`], centimetres.
    pub eye_distance_cm: f64,
    /// Distance between the eyes, range [`param::EYE_SEPARATION`], centimetres.
    pub eye_separation_cm: f64,
    /// True swaps both pictures, for cross-eyed viewing.
    pub swap_eyes: bool,
}

impl Default for Stereo {
    fn default() -> Self {
        Self {
            layout: StereoLayout::Off,
            screen_height_cm: param::SCREEN_HEIGHT.default,
            eye_distance_cm: param::EYE_DISTANCE.default,
            eye_separation_cm: param::EYE_SEPARATION.default,
            swap_eyes: false,
        }
    }
}

impl Stereo {
    /// True if each eye has its own picture.
    pub fn is_on(&self) -> bool {
        self.layout != StereoLayout::Off
    }

    /// Half the screen's height at distance 1.
    pub fn half_height(&self) -> f64 {
        0.5 * self.screen_height_cm / self.eye_distance_cm
    }

    /// Distance from the camera to either eye, in view units.
    pub fn half_separation(&self) -> f64 {
        0.5 * self.eye_separation_cm / self.eye_distance_cm
    }
}
