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

    /// The text that stores the settings in the place of `stored`, the text so far.
    ///
    /// What another version has stored stays: settings of other names, and values of known names as long as the
    /// setting is what this version reads of them.
    ///
    /// # Errors
    /// If a setting has no form in JSON: those of this version have one.
    pub fn to_json_over(&self, stored: &str) -> serde_json::Result<String> {
        let by_name = |settings: &Self| -> serde_json::Result<Map<String, Value>> {
            serde_json::from_value(serde_json::to_value(settings)?)
        };
        let mut values = by_name(self)?;
        if let Some(read) = Self::from_json(stored) {
            let read = by_name(&read)?;
            let mut kept: Map<String, Value> = serde_json::from_str(stored)?;
            kept.retain(|name, _| values.get(name) == read.get(name));
            values.extend(kept);
        }
        serde_json::to_string(&values)
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
    fn what_can_be_read_of_stored_settings_is_read() {
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
        for damaged in ["", "{", "[]", "null", "7", r#"{"formulas": "#] {
            assert_eq!(Settings::from_json(damaged), None, "{damaged}");
        }
        assert_eq!(Settings::from_json("{}"), Some(Settings::default()));
    }

    #[test]
    fn what_another_version_stored_stays_until_its_setting_is_changed() {
        let stored = r#"{"sheet": "floating", "export": {"of": "tomorrow"}, "formulas": ["a", {"of": "tomorrow"}],
            "sections": {"lights": true}, "palette": {"of": "tomorrow"}}"#;
        let value = |text: &str| serde_json::from_str::<Value>(text).expect("JSON");
        let over = |settings: &Settings, stored: &str| settings.to_json_over(stored).expect("JSON");
        let mut settings = Settings::from_json(stored).expect("an object");
        let again = over(&settings, stored);
        for (name, before) in value(stored).as_object().expect("an object") {
            assert_eq!(value(&again)[name], *before, "{name}");
        }
        assert_eq!(value(&again)["panel_open"], true, "and those of this version beside them");

        settings.sheet = SheetHeight::Tall;
        settings.formulas.push("b".to_owned());
        let changed = over(&settings, &again);
        assert_eq!(Settings::from_json(&changed), Some(settings.clone()));
        assert_eq!(value(&changed)["export"]["of"], "tomorrow");
        assert_eq!(value(&changed)["palette"]["of"], "tomorrow");
        // Once changed, a setting may have its default again.
        settings.sheet = SheetHeight::default();
        assert_eq!(Settings::from_json(&over(&settings, &changed)), Some(settings.clone()));
        for nothing in ["", "[]", "{}"] {
            assert_eq!(Settings::from_json(&over(&settings, nothing)), Some(settings.clone()));
        }
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
