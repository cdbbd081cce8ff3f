//! Settings of the interface that are stored between visits.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::{export_size::ExportSize, hints::Hints, sheet_height::SheetHeight};

/// Settings that are stored between visits and are not part of a scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Settings {
    /// True if the panel is shown.
    pub panel_open: bool,
    /// Height of the panel where the panel is a sheet at the lower edge.
    pub sheet: SheetHeight,
    /// True if the timeline is shown.
    pub timeline_open: bool,
    /// The hints that were followed, of those for a first visit.
    pub hints: Hints,
    /// True if the section "More" is open.
    pub more_open: bool,
    /// The open sections within "More".
    pub sections: Sections,
    /// True if wheel and pinch are drawn to places that stay beautiful.
    pub drawn_to_places: bool,
    /// The size of saved pictures.
    pub export: ExportSize,
    /// The texts of the formulas that a person keeps, at most `MAX_KEPT_FORMULAS`.
    pub formulas: Vec<String>,
}

/// Maximum number of formulas that a browser keeps.
pub const MAX_KEPT_FORMULAS: usize = 100;

impl Default for Settings {
    fn default() -> Self {
        Self {
            panel_open: true,
            sheet: SheetHeight::default(),
            timeline_open: false,
            hints: Hints::default(),
            more_open: false,
            sections: Sections::default(),
            drawn_to_places: true,
            export: ExportSize::default(),
            formulas: Vec::new(),
        }
    }
}

/// The open sections of the panel, by name.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Sections(BTreeMap<String, bool>);

impl Sections {
    /// Whether the section of this name is open; closed at first.
    pub fn is_open(&self, name: &str) -> bool {
        self.0.get(name).copied().unwrap_or_default()
    }

    /// Opens or closes a section.
    pub fn set_open(&mut self, name: &str, is_open: bool) {
        if self.is_open(name) != is_open {
            self.0.insert(name.to_owned(), is_open);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sections_are_stored_by_name() {
        let stored = r#"{"more_open": true, "sections": {"lights": true, "tone": false}}"#;
        let settings: Settings = serde_json::from_str(stored).unwrap();
        assert!(settings.more_open && settings.sections.is_open("lights"));
        assert!(!settings.sections.is_open("tone") && !settings.sections.is_open("bloom"));
        let again = serde_json::to_value(&settings).unwrap();
        assert_eq!(again["sections"]["lights"], true);
    }
}
