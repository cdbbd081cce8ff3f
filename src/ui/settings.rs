//! Settings of the interface that are stored between visits.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use super::{export_size::ExportSize, hints::Hints, merge::merged, sheet_height::SheetHeight};

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
    /// The texts of the formulas that a person keeps: at most `MAX_KEPT_FORMULAS`, or twice as many after tabs were
    /// merged.
    pub formulas: Vec<String>,
    /// Settings of other versions of the program, which are stored again as they are.
    #[serde(flatten)]
    pub other: Map<String, Value>,
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
            other: Map::new(),
        }
    }
}

impl Settings {
    /// The settings in a stored text; those that cannot be read have their defaults.
    ///
    /// None if the text holds no settings at all.
    pub fn from_json(text: &str) -> Option<Self> {
        let stored: Map<String, Value> = serde_json::from_str(text).ok()?;
        let defaults = serde_json::to_value(Self::default()).unwrap_or_default();
        // A list would be read as the fields of a structure, in their order.
        let is_list_alike = |name: &str, value: &Value| {
            defaults.get(name).is_none_or(|default| value.is_array() == default.is_array())
        };
        let stored = stored.into_iter().filter(|(name, value)| is_list_alike(name, value));
        let readable = stored.filter_map(|(name, value)| {
            let value = if name == "formulas" { texts_of(value) } else { value };
            let alone = Value::Object(Map::from_iter([(name.clone(), value.clone())]));
            serde_json::from_value::<Self>(alone).is_ok().then_some((name, value))
        });
        let mut settings: Self = serde_json::from_value(Value::Object(readable.collect())).ok()?;
        settings.formulas.truncate(2 * MAX_KEPT_FORMULAS);
        Some(settings)
    }

    /// Takes in what another tab has done to the stored formulas since they were `known`.
    pub fn merge_formulas(&mut self, known: &[String], stored: &[String]) {
        self.formulas = merged(known, &self.formulas, stored, String::clone);
    }
}

/// The texts in a list, without what else is in it.
fn texts_of(value: Value) -> Value {
    match value {
        Value::Array(list) => list.into_iter().filter(Value::is_string).collect(),
        other => other,
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
    fn what_can_be_read_of_stored_settings_is_read_and_the_rest_of_a_newer_version_stays() {
        let stored = r#"{"more_open": "yes", "sheet": "floating", "timeline_open": true, "export": [7],
            "formulas": ["a", 7, null, "b"], "sections": {"lights": true}, "palette": {"of": "tomorrow"}}"#;
        let settings = Settings::from_json(stored).expect("an object");
        assert!(settings.timeline_open && settings.sections.is_open("lights"));
        assert_eq!(settings.formulas, ["a", "b"]);
        let Settings { more_open, sheet, export, .. } = Settings::default();
        assert_eq!(
            (settings.more_open, settings.sheet, settings.export),
            (more_open, sheet, export)
        );
        let again = serde_json::to_value(&settings).unwrap();
        assert_eq!(again["palette"]["of"], "tomorrow");
        for damaged in ["", "{", "[]", "null", "7", r#"{"formulas": "#] {
            assert_eq!(Settings::from_json(damaged), None, "{damaged}");
        }
        assert_eq!(Settings::from_json("{}"), Some(Settings::default()));
    }

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
