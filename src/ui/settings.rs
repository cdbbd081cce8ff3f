//! Settings of the interface that are stored between visits.

use serde::{Deserialize, Serialize};

use super::export_size::ExportSize;

/// Settings that are stored between visits and are not part of a scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Settings {
    /// True if the panel is shown.
    pub panel_open: bool,
    /// True if the timeline is shown.
    pub timeline_open: bool,
    /// True if the section "More" is open.
    pub more_open: bool,
    /// The open sections within "More".
    pub sections: Sections,
    /// The size of saved pictures.
    pub export: ExportSize,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            panel_open: true,
            timeline_open: false,
            more_open: false,
            sections: Sections::default(),
            export: ExportSize::default(),
        }
    }
}

/// The open sections of the panel.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
#[expect(missing_docs, reason = "each field is the section of its name")]
pub struct Sections {
    pub fractal: bool,
    pub camera: bool,
    pub lights: bool,
    pub surface: bool,
    pub indirect: bool,
    pub tone: bool,
    pub bloom: bool,
    pub quality: bool,
    pub export: bool,
}

impl Sections {
    /// All sections open.
    pub fn all() -> Self {
        Self {
            fractal: true,
            camera: true,
            lights: true,
            surface: true,
            indirect: true,
            tone: true,
            bloom: true,
            quality: true,
            export: true,
        }
    }
}
