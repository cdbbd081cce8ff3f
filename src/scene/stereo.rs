//! How a picture is made for two eyes.
//!
//! The lengths are the viewer's, as in the thesis (4.5, "Stereoscopic 3D"): a screen of a known
//! height at a known distance from eyes a known way apart. The screen stands at the pivot, which
//! fixes how many scene units a centimetre is; what lies there is seen on the screen itself.

use serde::{Deserialize, Serialize};

use super::param;

/// How both eyes' pictures are put together.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum StereoLayout {
    /// One picture, seen from the camera itself.
    #[default]
    Off,
    /// The left eye's picture left of the right one's.
    SideBySide,
    /// The left eye's picture above the right one's.
    TopBottom,
    /// One picture for glasses with a red glass at the left and a cyan one at the right.
    Anaglyph,
}

impl StereoLayout {
    /// Columns and rows of pictures that stand beside each other.
    pub fn grid(self) -> [u32; 2] {
        match self {
            Self::Off | Self::Anaglyph => [1, 1],
            Self::SideBySide => [2, 1],
            Self::TopBottom => [1, 2],
        }
    }
}

/// Two eyes in front of a screen.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Stereo {
    /// How both pictures are put together; off by default.
    pub layout: StereoLayout,
    /// The screen's height, in [`param::SCREEN_HEIGHT`], centimetres. Its width follows from the
    /// picture's shape.
    pub screen_height_cm: f64,
    /// From the eyes to the screen, in [`param::EYE_DISTANCE`], centimetres.
    pub eye_distance_cm: f64,
    /// From one eye to the other, in [`param::EYE_SEPARATION`], centimetres.
    pub eye_separation_cm: f64,
    /// Each eye's picture in the place of the other: for pairs that are looked at cross-eyed.
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
    /// True where there are two pictures.
    pub fn is_on(&self) -> bool {
        self.layout != StereoLayout::Off
    }

    /// Half the screen's height at distance one.
    pub fn half_height(&self) -> f64 {
        0.5 * self.screen_height_cm / self.eye_distance_cm
    }

    /// From the camera to either eye, as a part of the distance to the screen: times the view
    /// unit it is a length in the scene.
    pub fn half_separation(&self) -> f64 {
        0.5 * self.eye_separation_cm / self.eye_distance_cm
    }
}
