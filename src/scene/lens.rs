//! The camera's lens: depth of field.

use serde::{Deserialize, Serialize};

use super::param;

/// Height of the sensor that f-numbers are for: full frame, in millimetres.
const SENSOR_HEIGHT_MM: f64 = 24.0;
/// The view unit, from eye to pivot, as a photographer before a small object has it, in millimetres.
const VIEW_UNIT_MM: f64 = 500.0;

/// A thin lens. What is not at the focus distance is blurred while the picture refines.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Lens {
    /// True if the picture has a depth of field; else the camera is a pinhole.
    pub depth_of_field: bool,
    /// Focal length over the diameter of the aperture, range [`param::F_NUMBER`].
    ///
    /// As of a full-frame camera that is half a metre from the pivot.
    pub f_number: f64,
    /// Distance along the viewing direction at which the picture is sharp, range [`param::FOCUS`], view units.
    pub focus: f64,
    /// Number of the aperture's blades, range [`param::BLADES`]; 2: the aperture is a circle.
    pub blades: u32,
}

impl Default for Lens {
    fn default() -> Self {
        Self {
            depth_of_field: false,
            f_number: param::F_NUMBER.default,
            focus: param::FOCUS.default,
            blades: param::BLADES.default as u32,
        }
    }
}

impl Lens {
    /// The aperture's radius in view units, for half the picture's height at distance 1; 0 for a pinhole.
    pub fn radius(&self, half_height: f64) -> f64 {
        if !self.depth_of_field {
            return 0.0;
        }
        let focal_length_mm = 0.5 * SENSOR_HEIGHT_MM / half_height;
        0.5 * focal_length_mm / self.f_number / VIEW_UNIT_MM
    }
}
